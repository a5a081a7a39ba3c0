/* Pictures that were given as labels, levels or depth, and are photographs.
 *
 * Labels and levels are flat: a label has many pixels, and most neighbours have one level, or nearly so where depth was
 * made smooth.  Smooth depth may slope, but hardly anywhere changes its slope: a photograph has grain and texture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

#define FEW_LABELS 1000 /* fewer may have any size; chosen */
#define LABEL_AREA 20   /* pixels of a label, more on average; chosen */
#define BENDS      150  /* of the range of depth; a slope that changes by more than one in a pixel is a bend, which rounding
                         * to 8 bits is not; chosen */
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

static float
range_of (const CeldPlane *plane)
{
  float least, most;

  celd_level_range (plane, &least, &most);
  return most - least;
}

bool
celd_are_levels (const CeldPlane *levels)
{
  size_t n = (size_t) levels->width * (size_t) levels->height;

  return 10 * count_changes (levels, range_of (levels) / STEPS) < 3 * n; /* chosen */
}

bool
celd_is_depth (const CeldPlane *depth)
{
  size_t n = (size_t) depth->width * (size_t) depth->height, bends = 0;
  float  largest = range_of (depth) / BENDS;

  for (int y = 0; y < depth->height; y++)
    for (int x = 1; x + 1 < depth->width; x++)
      bends += fabsf (CELD_AT (depth, x - 1, y) - 2 * CELD_AT (depth, x, y) + CELD_AT (depth, x + 1, y)) > largest;
  return 10 * bends < 3 * n; /* as for levels */
}
