/* Arrows as SVG path data: parsing never fails but by a place in the text, and ends of arrows are finite.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fuzz.h"

int
LLVMFuzzerTestOneInput (const uint8_t *data, size_t size)
{
  char         *text = fuzz_text (data, size);
  CeldRelations relations = { 0 };
  CeldTextError error = { 0, 0, "", "" };
  CeldStatus    status = celd_arrow_path_parse (text, &relations, &error);

  FUZZ_CHECK (status == CELD_OK || status == CELD_BAD_RELATION);
  FUZZ_CHECK (status == CELD_OK || (relations.n == 0 && error.line >= 1 && error.column >= 1 && error.expected[0]));
  for (size_t i = 0; i < relations.n; i++)
    {
      const CeldRelation *r = &relations.item[i];

      FUZZ_CHECK (isfinite (r->nearer.x) && isfinite (r->nearer.y) && isfinite (r->farther.x));
      FUZZ_CHECK (isfinite (r->farther.y) && r->source == CELD_SOURCE_PATH && r->line >= 1 && r->column >= 1);
    }
  celd_relations_clear (&relations);
  free (text);
  return 0;
}
