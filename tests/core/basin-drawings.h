/* Random drawings for the tests of basin graphs, and the comparison of two graphs.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef BASIN_DRAWINGS_H
#define BASIN_DRAWINGS_H

#include "check.h"
#include "segment/basins.h"

#define THRESHOLD 0.25f /* of the ink */

/* Grain, lines and boxes; `kind` says how much of each. */
static inline void
draw (uint32_t *state, int kind, CeldPlane *ink)
{
  int w = ink->width, h = ink->height;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      CELD_AT (ink, x, y) = kind == 0 ? (float) check_random (state, 100) / 99.f
                          : check_random (state, 40) ? 1 : kind == 1 ? (float) check_random (state, 100) / 99.f : 1;
  for (int k = 0; k < kind * 2; k++)
    {
      int x = (int) check_random (state, (uint32_t) w), y = (int) check_random (state, (uint32_t) h);
      int dx = (int) check_random (state, 3) - 1, dy = (int) check_random (state, 3) - 1;

      for (; (dx || dy) && x >= 0 && y >= 0 && x < w && y < h; x += dx, y += dy)
        CELD_AT (ink, x, y) = (float) check_random (state, 3) / 5.f;
    }
  for (int k = 2; k < kind; k++)
    {
      int left = (int) check_random (state, (uint32_t) w), top = (int) check_random (state, (uint32_t) h);
      int right = left + (int) check_random (state, 20), bottom = top + (int) check_random (state, 20);

      for (int y = top; y < bottom && y < h; y++)
        for (int x = left; x < right && x < w; x++)
          CELD_AT (ink, x, y) = k & 1 ? 0.f : 1.f;
    }
}

/* Changes the pixels of a rectangle, which may reach beyond the frame: a box, its outline, or grain. */
static inline CeldRect
edit (uint32_t *state, CeldPlane *ink)
{
  uint32_t kind = check_random (state, 5);
  CeldRect r = { (int) check_random (state, (uint32_t) ink->width + 2) - 2,
                 (int) check_random (state, (uint32_t) ink->height + 2) - 2, 1 + (int) check_random (state, 12),
                 1 + (int) check_random (state, 12) };

  for (int y = r.y; y < r.y + r.height; y++)
    for (int x = r.x; x < r.x + r.width; x++)
      {
        bool rim = x == r.x || y == r.y || x == r.x + r.width - 1 || y == r.y + r.height - 1;

        if (x < 0 || y < 0 || x >= ink->width || y >= ink->height || (kind == 2 && !rim))
          continue;
        CELD_AT (ink, x, y) = kind == 0 ? 1 : kind == 4 ? (float) check_random (state, 100) / 99.f : 0;
      }
  return r;
}

/* A grid of cells with walls of `wall` pixels: room for changes that reach a small part of it. */
static inline void
draw_cells (uint32_t *state, int cell, int wall, CeldPlane *ink)
{
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      CELD_AT (ink, x, y) = x % cell < wall || y % cell < wall ? 0.f : 1.f;
  for (int k = 0; k < ink->width * ink->height / 1000; k++)
    edit (state, ink);
}

/* Differences between two graphs of one drawing, in any field. */
static inline int
differences (const CeldBasins *p, const CeldBasins *q)
{
  int n = p->width != q->width || p->height != q->height || p->stroke != q->stroke || p->n != q->n ||
          p->n_boundaries != q->n_boundaries || p->n_merged != q->n_merged || p->n_enclosures != q->n_enclosures ||
          p->n_components != q->n_components || memcmp (&p->costs, &q->costs, sizeof p->costs);

  for (size_t k = 0; k < p->n && !n; k++)
    {
      const CeldBasin *a = &p->basin[k], *b = &q->basin[k];

      n += a->x != b->x || a->y != b->y || a->squared != b->squared || a->solid != b->solid || a->area != b->area ||
           p->merged[k] != q->merged[k] || p->enclosure[k] != q->enclosure[k] || p->component[k] != q->component[k];
    }
  for (size_t k = 0; k < p->n_boundaries && !n; k++)
    {
      const CeldBasinBoundary *a = &p->boundary[k], *b = &q->boundary[k];

      n += a->a != b->a || a->b != b->b || a->opening != b->opening || a->saddle != b->saddle || a->frame != b->frame ||
           a->south != b->south || a->x != b->x || a->y != b->y || a->cost != b->cost;
    }
  for (int y = 0; y <= p->height && !n; y++)
    n += p->row[y] != q->row[y];
  for (size_t i = 0; !n && i < p->row[p->height]; i++)
    n += p->run[i].x != q->run[i].x || p->run[i].basin != q->run[i].basin;
  for (int i = 0; !n && i < p->width * p->height; i++)
    {
      int x = i % p->width, y = i / p->width;

      n += celd_paper_count (p, y, x, x + 1) != celd_paper_count (q, y, x, x + 1);
    }
  return n;
}

#endif
