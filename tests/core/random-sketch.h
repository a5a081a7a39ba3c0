/* Random canvases, and what is connected on them, pixel by pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef RANDOM_SKETCH_H
#define RANDOM_SKETCH_H

#include "sketch.h"

enum { W = 23, H = 17 };

/* Connected strokes by flooding, numbered from 1 in reading order; returns how many. */
static inline uint32_t
flood (const CeldLabels *painted, uint32_t stroke[W * H])
{
  uint32_t n = 0;

  memset (stroke, 0, W * H * sizeof *stroke);
  for (int p = 0; p < W * H; p++)
    {
      bool grew = painted->data[p] && !stroke[p];

      if (grew)
        stroke[p] = ++n;
      while (grew)
        {
          grew = false;
          for (int q = 0; q < W * H; q++)
            for (int v = q / W - 1; v <= q / W + 1 && stroke[q] == n; v++)
              for (int u = q % W - 1; u <= q % W + 1; u++)
                if (u >= 0 && v >= 0 && u < W && v < H && !stroke[v * W + u] &&
                    painted->data[v * W + u] == painted->data[q])
                  {
                    stroke[v * W + u] = n;
                    grew = true;
                  }
        }
    }
  return n;
}

/* The label's pixel at which a ray from pixel p ends that passes at most so many pixels of other paint and of ink; -1:
 * none. */
static inline int
ray_end (const CeldLabels *painted, const CeldPlane *ink, int p, int dx, int dy, int most_paint, int most_ink)
{
  for (int x = p % W + dx, y = p / W + dy; x >= 0 && y >= 0 && x < W && y < H; x += dx, y += dy)
    {
      uint32_t label = painted->data[y * W + x];

      if (label == painted->data[p])
        return y * W + x;
      if (label ? !most_paint-- : celd_is_paper (ink->data[y * W + x]) || !most_ink--)
        return -1;
    }
  return -1;
}

/* Gives strokes that other paint or ink cut in two the lesser of their numbers, with a brush and lines of one pixel. */
static inline void
join_severed (const CeldLabels *painted, const CeldPlane *ink, uint32_t stroke[W * H])
{
  for (int p = 0; p < W * H; p++)
    for (int k = 0; k < 9 && painted->data[p]; k++)
      {
        int      q = k == 4 ? -1 : ray_end (painted, ink, p, k % 3 - 1, k / 3 - 1, 3, 2);
        uint32_t a = q < 0 ? 0 : stroke[p], b = q < 0 ? 0 : stroke[q];

        for (int r = 0; r < W * H && a != b; r++)
          stroke[r] = stroke[r] == (a > b ? a : b) ? (a < b ? a : b) : stroke[r];
      }
}

/* Pieces in columns and rows between lines, and boxes of paint over them. */
static inline void
random_sketch (uint32_t *state, int boxes, char paper[H][W + 1], char painted[H][W + 1])
{
  int column = 3 + (int) check_random (state, W - 6), row = 3 + (int) check_random (state, H - 6);

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        paper[y][x] = x == column || y == row || !check_random (state, 30) ? '#'
                    : (char) ('1' + (x > column) + 2 * (y > row));
        painted[y][x] = '.';
      }
  for (int k = 0; k < boxes; k++)
    {
      int left = (int) check_random (state, W), top = (int) check_random (state, H);
      int w = 1 + (int) check_random (state, 9), h = 1 + (int) check_random (state, 5);

      for (int y = top; y < top + h && y < H; y++)
        for (int x = left; x < left + w && x < W; x++)
          painted[y][x] = (char) ('A' + k % 3);
    }
}

#endif
