/* How wide the strokes of a drawing are.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#define LONGEST_RUN 256 /* pixels; longer runs count as this long */

/* Counts runs of ink by length, along n lines of `length` pixels. */
static void
count_runs (const CeldPlane *ink, bool columns, size_t runs[LONGEST_RUN + 1])
{
  int n = columns ? ink->width : ink->height, length = columns ? ink->height : ink->width;

  for (int i = 0; i < n; i++)
    for (int j = 0, run = 0; j <= length; j++)
      if (j < length && !celd_is_paper (columns ? CELD_AT (ink, i, j) : CELD_AT (ink, j, i)))
        run++;
      else if (run)
        {
          runs[run < LONGEST_RUN ? run : LONGEST_RUN]++;
          run = 0;
        }
}

int
celd_stroke_width (const CeldPlane *ink)
{
  size_t runs[LONGEST_RUN + 1] = { 0 }, all = 0, below = 0;
  int    width = 0;

  count_runs (ink, false, runs);
  count_runs (ink, true, runs);
  for (int i = 1; i <= LONGEST_RUN; i++)
    all += runs[i];
  while (width < LONGEST_RUN && 2 * below < all)
    below += runs[++width];
  return width;
}
