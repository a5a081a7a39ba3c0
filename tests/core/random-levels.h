/* Random pictures of levels, ink and anchors, and what is connected on them, pixel by pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef RANDOM_LEVELS_H
#define RANDOM_LEVELS_H

#include "depth/depth.h"
#include "check.h"

enum { W = 31, H = 22, N = W * H };

typedef struct { float level[N], ink[N]; uint8_t fixed[N]; } Picture;

static inline void
random_box (uint32_t *r, int most, int box[4])
{
  box[0] = (int) check_random (r, W);
  box[1] = (int) check_random (r, H);
  box[2] = box[0] + 1 + (int) check_random (r, (uint32_t) most);
  box[3] = box[1] + 1 + (int) check_random (r, (uint32_t) most);
  box[2] = box[2] < W ? box[2] : W;
  box[3] = box[3] < H ? box[3] : H;
}

#define FOR_BOX(box, x, y) \
  for (int y = (box)[1]; y < (box)[3]; y++) \
    for (int x = (box)[0]; x < (box)[2]; x++)

/* Boxes of levels over a page, their outlines partly inked, and a few fixed spots. */
static inline void
random_picture (uint32_t *r, Picture *p)
{
  int box[4];

  for (int i = 0; i < N; i++)
    {
      p->level[i] = 1;
      p->ink[i]   = 1;
      p->fixed[i] = CELD_FREE;
    }
  for (int k = 0; k < 6; k++)
    {
      float level = (float) check_random (r, 4);

      random_box (r, 14, box);
      FOR_BOX (box, x, y)
        p->level[y * W + x] = level;
      random_box (r, 14, box);
      FOR_BOX (box, x, y)
        if (x == box[0] || y == box[1] || x == box[2] - 1 || y == box[3] - 1)
          p->ink[y * W + x] = check_random (r, 5) ? 0.1f : 0.6f;
    }
  for (int k = 0; k < 5; k++)
    {
      random_box (r, 3, box);
      FOR_BOX (box, x, y)
        p->fixed[y * W + x] = CELD_ANCHOR;
    }
}

static inline CeldPlane
ink_of (Picture *p)
{
  return (CeldPlane) { W, H, W, p->ink };
}

/* v_pq as documented: 1 in one level, else the least ink as far as `reach` round both pixels. */
static inline float
plain_weight (const Picture *p, int threshold_percent, int reach, int a, int b)
{
  float least = 1;

  if (p->level[a] == p->level[b])
    return 1;
  for (int i = 0; i < N; i++)
    {
      int to_a = abs (i % W - a % W) > abs (i / W - a / W) ? abs (i % W - a % W) : abs (i / W - a / W);
      int to_b = abs (i % W - b % W) > abs (i / W - b / W) ? abs (i % W - b % W) : abs (i / W - b / W);

      if ((to_a <= reach || to_b <= reach) && p->ink[i] < least)
        least = p->ink[i];
    }
  return least * 100 <= (float) threshold_percent ? 0 : least;
}

/* The neighbours of pixel i; returns how many. */
static inline int
neighbours (int i, int near[4])
{
  int n = 0;

  if (i % W > 0)
    near[n++] = i - 1;
  if (i % W + 1 < W)
    near[n++] = i + 1;
  if (i >= W)
    near[n++] = i - W;
  if (i + W < N)
    near[n++] = i + W;
  return n;
}

/* Numbers what `weight` (N x 4, by neighbours) joins without the fixed pixels (NULL: none), from 1 in reading order;
 * 0 for fixed ones. */
static inline int
flood_parts (const uint8_t *fixed, float weight[N][4], int part[N])
{
  int n = 0, near[4];

  memset (part, 0, N * sizeof *part);
  for (int start = 0; start < N; start++)
    {
      bool grew = !part[start] && !(fixed && fixed[start]);

      if (grew)
        part[start] = ++n;
      while (grew)
        {
          grew = false;
          for (int i = 0; i < N; i++)
            for (int k = 0, all = neighbours (i, near); k < all && part[i] == n; k++)
              if (!part[near[k]] && !(fixed && fixed[near[k]]) && weight[i][k] > 0)
                {
                  part[near[k]] = n;
                  grew = true;
                }
        }
    }
  return n;
}

#endif
