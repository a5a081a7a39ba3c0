/* How sure the labels of a frame between two keys are, which was made from both sides.
 *
 * A label is as sure as the better side is of it, times the share of its pixels that it has there; and no more than the
 * sides agree, since one of them is wrong where they do not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

/* Pixels of a label: in the frame, of these on each side, on both sides, and on either. */
typedef struct { size_t n, same[2], both, either; } Count;

static void
count_pixels (const CeldLabels *const side[2], const CeldLabels *labels, Count *count)
{
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        uint32_t label = CELD_AT (labels, x, y), first = CELD_AT (side[0], x, y), second = CELD_AT (side[1], x, y);

        count[label].n++;
        count[label].same[0] += first == label;
        count[label].same[1] += second == label;
        count[first].both += first == second;
        count[first].either++;
        count[second].either += first != second;
      }
}

static double
rate (const Count *count, double first, double second)
{
  double share[2], sure;

  for (int k = 0; k < 2; k++)
    share[k] = count->n ? (double) count->same[k] / (double) count->n : 1;
  sure = fmax (first * share[0], second * share[1]);
  return count->either ? fmin (sure, (double) count->both / (double) count->either) : sure;
}

CeldStatus
celd_rate_blended (const CeldLabels *const side[2], const double *const side_sure[2], const CeldLabels *labels,
                   size_t n, double *sure)
{
  Count *count;

  if (!CELD_SAME_SIZE (side[0], labels) || !CELD_SAME_SIZE (side[1], labels))
    return CELD_BAD_SIZE;
  if (celd_labels_beyond (side[0], n) || celd_labels_beyond (side[1], n) || celd_labels_beyond (labels, n))
    return CELD_BAD_VALUE;
  count = celd_alloc0 (n + 1, sizeof *count);
  if (!count)
    return CELD_NO_MEMORY;
  count_pixels (side, labels, count);
  for (size_t l = 1; l <= n; l++)
    sure[l] = rate (&count[l], side_sure[0][l], side_sure[1][l]);
  celd_free (count);
  return CELD_OK;
}
