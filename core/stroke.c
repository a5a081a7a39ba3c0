/* How wide the strokes of a drawing are, and what a point on one of them means: the paper beside it.
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

bool
celd_paper_near (const CeldPlane *ink, int reach, int *x, int *y)
{
  int  px = *x, py = *y, least = reach * reach + 1;
  bool found = false;

  for (int v = py - reach < 0 ? 0 : py - reach; v <= py + reach && v < ink->height; v++)
    for (int u = px - reach < 0 ? 0 : px - reach; u <= px + reach && u < ink->width; u++)
      {
        int squared = (u - px) * (u - px) + (v - py) * (v - py);

        if (squared >= least || !celd_is_paper (CELD_AT (ink, u, v)))
          continue;
        least = squared;
        found = true;
        *x    = u;
        *y    = v;
      }
  return found;
}
