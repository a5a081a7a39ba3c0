/* LazyBrush [SDC09b] (section 3.2) in one call, for those who keep nothing: every pixel gets the label of a scribble,
 * borders run through ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/segment.h"

#include <string.h>

CeldStatus
celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
              const CeldSettings *settings, const CeldHost *host,
              CeldLabels *labels, CeldPalette *palette, CeldProblems *problems)
{
  CeldSegmenter *segmenter = NULL;
  CeldSeedRows   rows = { 0 };
  CeldLabels     result = { 0 };
  CeldRect       changed;
  CeldHostPart       part[2];
  CeldHost       build = celd_host_part (&part[0], host, 0, 0.3), solve = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus     status;

  if (!CELD_SAME_SIZE (ink, seeds) || !CELD_SAME_SIZE (ink, labels))
    return CELD_BAD_SIZE;
  status = celd_settings_check (settings);
  if (status != CELD_OK)
    return status;
  segmenter = celd_segmenter_new ();
  status = segmenter ? celd_segmenter_set_ink (segmenter, ink, NULL, settings, &build) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_seed_rows_read (seeds, &rows);
  if (status == CELD_OK)
    status = celd_labels_new (ink->width, ink->height, &result);
  if (status == CELD_OK)
    status = celd_segmenter_solve (segmenter, &rows, relations, settings, &solve, palette, problems, &result, &changed);
  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    memcpy (&CELD_AT (labels, 0, y), &CELD_AT (&result, 0, y), (size_t) ink->width * sizeof *labels->data);
  celd_segmenter_free (segmenter);
  celd_seed_rows_clear (&rows);
  celd_free (result.data);
  return status;
}
