/* Pictures that were given as labels or levels, and are photographs.
 *
 * Labels and levels are flat: a label has many pixels, and most neighbours have one level, or nearly so where depth was
 * made smooth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

#define FEW_LABELS 1000 /* fewer may have any size; chosen */
#define LABEL_AREA 20   /* pixels of a label, more on average; chosen */
#define STEPS      300  /* of the range of levels; neighbours that differ by more than one are a change; chosen */

bool
celd_are_labels (const CeldLabels *labels, const CeldPalette *palette)
{
  return palette->n < FEW_LABELS || LABEL_AREA * palette->n < (size_t) labels->width * (size_t) labels->height;
}

/* From each pixel to the next one in reading order, how many are larger than this. */
static size_t
count_changes (const CeldPlane *levels, float largest)
{
  size_t changes = 0;
  float  before = CELD_AT (levels, 0, 0);

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        changes += fabsf (CELD_AT (levels, x, y) - before) > largest;
        before = CELD_AT (levels, x, y);
      }
  return changes;
}

bool
celd_are_levels (const CeldPlane *levels)
{
  size_t n = (size_t) levels->width * (size_t) levels->height;
  float  least = INFINITY, most = -INFINITY;

  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        least = fminf (least, CELD_AT (levels, x, y));
        most  = fmaxf (most, CELD_AT (levels, x, y));
      }
  return 10 * count_changes (levels, (most - least) / STEPS) < 3 * n; /* chosen */
}
