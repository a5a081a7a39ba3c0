/* One level for each region: the median of its pixels.  Expanded levels differ from it in ink that a nearer region
 * owns, which is less than half of a region unless that is narrower than its lines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <stdlib.h>

static int
compare (const void *first, const void *second)
{
  const float *a = first, *b = second;

  return (*a > *b) - (*a < *b);
}

/* Where the levels of each region begin among those of all, one after the other: first[l] .. first[l + 1] - 1. */
static void
count_regions (const CeldLabels *regions, size_t n, size_t *first)
{
  for (int y = 0; y < regions->height; y++)
    for (int x = 0; x < regions->width; x++)
      first[CELD_AT (regions, x, y) + 1]++;
  for (size_t l = 0; l <= n; l++)
    first[l + 1] += first[l];
}

/* Moves each first[l] to the end of its region, which is where the next one begins. */
static void
collect_levels (const CeldLabels *regions, const CeldPlane *levels, size_t *first, float *level)
{
  for (int y = 0; y < regions->height; y++)
    for (int x = 0; x < regions->width; x++)
      {
        float l = CELD_AT (levels, x, y);

        level[first[CELD_AT (regions, x, y)]++] = l == l ? l : 0;
      }
}

CeldStatus
celd_flatten_levels (const CeldLabels *regions, size_t n, CeldPlane *levels)
{
  size_t *first;
  float  *level, *median;

  if (!CELD_SAME_SIZE (regions, levels))
    return CELD_BAD_SIZE;
  if (celd_labels_beyond (regions, n))
    return CELD_BAD_VALUE;
  first  = celd_alloc0 (n + 2, sizeof *first);
  level  = celd_alloc ((size_t) levels->width * (size_t) levels->height, sizeof *level);
  median = celd_alloc0 (n + 1, sizeof *median);
  if (first && level && median)
    {
      count_regions (regions, n, first);
      collect_levels (regions, levels, first, level);
      for (size_t l = 0, begin = 0; l <= n; begin = first[l++])
        {
          qsort (level + begin, first[l] - begin, sizeof *level, compare);
          if (first[l] > begin)
            median[l] = level[begin + (first[l] - begin) / 2];
        }
      for (int y = 0; y < levels->height; y++)
        for (int x = 0; x < levels->width; x++)
          CELD_AT (levels, x, y) = median[CELD_AT (regions, x, y)];
    }
  celd_free (first);
  celd_free (level);
  celd_free (median);
  return first && level && median ? CELD_OK : CELD_NO_MEMORY;
}
