/* Relations text: parsing never fails but by a place inside the text, what is read is in range, a relation that was not
 * read leaves the list alone, and the text of a part reads like the part of the text.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fuzz.h"

static void
check_relations (const CeldRelations *relations, const char *text)
{
  int lines = 1;

  for (const char *c = text; *c; c++)
    lines += *c == '\n' || *c == '\r';
  for (size_t i = 0; i < relations->n; i++)
    {
      const CeldRelation *r = &relations->item[i];

      FUZZ_CHECK (r->weight > 0 && isfinite (r->weight) && r->gap > 0 && isfinite (r->gap));
      FUZZ_CHECK (r->line >= 1 && r->line <= lines && r->column >= 1);
      FUZZ_CHECK (r->source == CELD_SOURCE_TEXT && !r->id);
      for (int end = 0; end < 2; end++)
        {
          const CeldTerm *t = end ? &r->farther : &r->nearer;

          FUZZ_CHECK (t->by_colour || (isfinite (t->x) && isfinite (t->y)));
        }
    }
}

/* A line more, which is good, adds one relation. */
static void
check_one_more (const char *text, size_t n)
{
  char         *longer = malloc (strlen (text) + 16);
  CeldRelations relations = { 0 };
  CeldStatus    status;

  strcpy (longer, text);
  strcat (longer, "\n1,2 > 3,4");
  status = celd_relations_parse (longer, &relations, NULL);
  FUZZ_CHECK (status == CELD_OK && relations.n == n + 1);
  FUZZ_CHECK (relations.item[n].nearer.x == 1 && relations.item[n].farther.y == 4);
  celd_relations_clear (&relations);
  free (longer);
}

int
LLVMFuzzerTestOneInput (const uint8_t *data, size_t size)
{
  char         *text = fuzz_text (data, size);
  CeldRelations relations = { 0 };
  CeldTextError error = { 0, 0, "", "" };
  CeldStatus    status = celd_relations_parse (text, &relations, &error);

  FUZZ_CHECK (status == CELD_OK || status == CELD_BAD_RELATION);
  if (status == CELD_OK)
    {
      check_relations (&relations, text);
      check_one_more (text, relations.n);
    }
  else
    {
      FUZZ_CHECK (relations.n == 0 && error.line >= 1 && error.column >= 1);
      FUZZ_CHECK (error.expected[0] && memchr (error.expected, 0, sizeof error.expected));
      FUZZ_CHECK (memchr (error.found, 0, sizeof error.found));
    }
  celd_relations_clear (&relations);
  free (text);
  return 0;
}
