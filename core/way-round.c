/* Is there a short way round the end of a cut?  A cut that ends nearby parts nothing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#define REACH  7 /* pixels that the way may go away from the cut */
#define WINDOW (2 * REACH + 1)

/* A picture in which neighbours are joined where weights are above 0. */
typedef struct { int width, height; const float *east, *south; } Grid;

/* Is the pixel (x,y) joined to its neighbour in the direction 0 right, 1 down, 2 left, 3 up? */
static bool
joined (const Grid *g, int x, int y, int direction)
{
  size_t i = (size_t) y * (size_t) g->width + (size_t) x;

  switch (direction)
    {
    case 0:  return x + 1 < g->width && g->east[i] > 0;
    case 1:  return y + 1 < g->height && g->south[i] > 0;
    case 2:  return x > 0 && g->east[i - 1] > 0;
    default: return y > 0 && g->south[i - (size_t) g->width] > 0;
    }
}

bool
celd_way_round (int width, int height, const float *east, const float *south, int x, int y, bool right)
{
  static const int step[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  Grid             g = { width, height, east, south };
  bool             seen[WINDOW][WINDOW] = { { false } };
  int              queue[WINDOW * WINDOW][2] = { { REACH, REACH } }, last = 1; /* places in the window round (x,y) */
  bool            *goal = &seen[REACH + !right][REACH + right];

  seen[REACH][REACH] = true;
  for (int first = 0; first < last && !*goal; first++)
    for (int k = 0; k < 4; k++)
      {
        int u = queue[first][0], v = queue[first][1], s = u + step[k][0], t = v + step[k][1];

        if (s < 0 || t < 0 || s >= WINDOW || t >= WINDOW || seen[t][s] || !joined (&g, x + u - REACH, y + v - REACH, k))
          continue;
        seen[t][s]     = true;
        queue[last][0] = s;
        queue[last][1] = t;
        last++;
      }
  return *goal;
}
