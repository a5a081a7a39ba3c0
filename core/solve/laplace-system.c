/* A Laplacian system as it is given: boundary conditions.
 *
 * An edge between a free and a fixed (Dirichlet) pixel is cut: its weight is added to the free one's diagonal, and it
 * is noted, so that each solution adds weight times fixed value to the right-hand side.  Over the frame there are no
 * edges (Neumann).  What is not a positive number is no weight.  The free pixels are left as a weighted graph.
 *
 * Cost: O(pixels), on the host's threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/laplace-private.h"

#define NEAR_FIXED 0x80
#define WEAK       1e-3f /* least over largest weight, below which weights differ much; chosen by the bench */

typedef struct
{
  const float       *east, *south, *diagonal;   /* the caller's */
  const uint8_t     *fixed;
  CeldLaplace       *laplace;
  CeldWeightedGraph *graph;
  uint8_t           *mark;                      /* of each strip: a row */
  uint32_t          *least, *most;              /* of each row: bits of its weights; those of `least` less 1 */
} Copy;

CELD_CLONES static void
copy_weights (size_t w, const float *restrict weight, float *restrict out)
{
  for (size_t x = 0; x < w; x++)
    out[x] = weight[x] > 0 ? weight[x] : 0;
}

CELD_CLONES static void
measure_weights (size_t w, const CeldBits *bits, uint32_t *least, uint32_t *most)
{
  uint32_t low = *least, high = *most;

  for (size_t x = 0; x < w; x++)
    {
      low  = bits[x] - 1 < low ? bits[x] - 1 : low; /* that of 0 is the largest */
      high = bits[x] > high ? bits[x] : high;
    }
  *least = low;
  *most  = high;
}

/* Marks the pixels that are fixed, or beside a fixed one. */
CELD_CLONES static void
mark_beside (size_t w, const uint8_t *above, const uint8_t *here, const uint8_t *below, uint8_t *restrict mark)
{
  for (size_t x = 0; x < w; x++)
    mark[x] = above[x] | here[x] | below[x];
  for (size_t x = 1; x < w; x++)
    mark[x] |= here[x - 1];
  for (size_t x = 0; x + 1 < w; x++)
    mark[x] |= here[x + 1];
  for (size_t x = 0; x < w; x++)
    mark[x] = mark[x] ? NEAR_FIXED : 0;
}

static void
mark_fixed (const Copy *c, int y, uint8_t *mark)
{
  size_t         w = (size_t) c->laplace->width;
  const uint8_t *here = c->fixed + (size_t) y * w;

  mark_beside (w, y ? here - w : here, here, y + 1 < c->laplace->height ? here + w : here, mark);
}

/* The fixed neighbours of a free pixel, with a weight; returns how many. */
static int
find_held (const Copy *c, int x, int y, CeldDirichletLink *held)
{
  int    w = c->laplace->width, h = c->laplace->height, n = 0;
  size_t p = (size_t) y * (size_t) w + (size_t) x;

#define HOLD(is, q, weight) \
  if ((is) && c->fixed[q] && (weight) > 0) \
    held[n++] = (CeldDirichletLink) { (uint32_t) p, (uint32_t) (q), weight }
  HOLD (y > 0, p - (size_t) w, c->south[p - (size_t) w]);
  HOLD (x > 0, p - 1, c->east[p - 1]);
  HOLD (x + 1 < w, p + 1, c->east[p]);
  HOLD (y + 1 < h, p + (size_t) w, c->south[p]);
#undef HOLD
  return n;
}

/* Cuts the edges of fixed pixels in a row; counts those that have a free end in held_row of the next row. */
static void
cut_row (const Copy *c, int y, uint8_t *mark)
{
  CeldWeightedGraph *g = c->graph;
  int                w = g->width;
  size_t             i = (size_t) y * (size_t) w;
  CeldDirichletLink  held[4];

  mark_fixed (c, y, mark);
  for (int x = celd_next_marked (w, mark, 0); x < w; x = celd_next_marked (w, mark, x + 1))
    {
      size_t p = i + (size_t) x;
      int    n = c->fixed[p] ? 0 : find_held (c, x, y, held);

      if (c->fixed[p])
        g->diagonal[p] = 0;
      for (int k = 0; k < n; k++)
        g->diagonal[p] += held[k].weight;
      if (c->fixed[p] || (x + 1 < w && c->fixed[p + 1]))
        g->east[p] = 0;
      if (c->fixed[p] || (y + 1 < g->height && c->fixed[p + (size_t) w]))
        g->south[p] = 0;
      c->laplace->held_row[y + 1] += (size_t) n;
    }
}

static void
copy_strip (void *data, int strip)
{
  const Copy        *c = data;
  CeldWeightedGraph *g = c->graph;
  size_t             w = (size_t) g->width;
  int                end = (strip + 1) * CELD_STRIP < g->height ? (strip + 1) * CELD_STRIP : g->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      size_t i = (size_t) y * w;

      copy_weights (w, c->east + i, g->east + i);
      g->east[i + w - 1] = 0;
      if (y + 1 < g->height)
        copy_weights (w, c->south + i, g->south + i);
      else
        memset (g->south + i, 0, w * sizeof *g->south);
      if (c->diagonal)
        copy_weights (w, c->diagonal + i, g->diagonal + i);
      else
        memset (g->diagonal + i, 0, w * sizeof *g->diagonal);
      if (c->fixed)
        cut_row (c, y, c->mark + (size_t) strip * w);
      c->least[y] = UINT32_MAX;
      c->most[y]  = 0;
      measure_weights (w, (const CeldBits *) (g->east + i), &c->least[y], &c->most[y]);
      measure_weights (w, (const CeldBits *) (g->south + i), &c->least[y], &c->most[y]);
      measure_weights (w, (const CeldBits *) (g->diagonal + i), &c->least[y], &c->most[y]);
    }
}

/* Notes the edges between free and fixed pixels of a strip. */
static void
hold_strip (void *data, int strip)
{
  const Copy  *c = data;
  CeldLaplace *l = c->laplace;
  uint8_t     *mark = c->mark + (size_t) strip * (size_t) l->width;
  int          end = (strip + 1) * CELD_STRIP < l->height ? (strip + 1) * CELD_STRIP : l->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      CeldDirichletLink *held = l->held + l->held_row[y];

      if (l->held_row[y] == l->held_row[y + 1])
        continue;
      mark_fixed (c, y, mark);
      for (int x = celd_next_marked (l->width, mark, 0); x < l->width; x = celd_next_marked (l->width, mark, x + 1))
        if (!c->fixed[(size_t) y * (size_t) l->width + (size_t) x])
          held += find_held (c, x, y, held);
    }
}

/* Do weights differ very much? */
static bool
differ (const Copy *c)
{
  uint32_t bits[2] = { UINT32_MAX, 0 };
  float    least, most;

  for (int y = 0; y < c->laplace->height; y++)
    {
      bits[0] = c->least[y] < bits[0] ? c->least[y] : bits[0];
      bits[1] = c->most[y] > bits[1] ? c->most[y] : bits[1];
    }
  bits[0]++;
  memcpy (&least, &bits[0], sizeof least);
  memcpy (&most, &bits[1], sizeof most);
  return bits[1] && least < WEAK * most;
}

CeldStatus
celd_system_read (const float *east, const float *south, const float *diagonal, const uint8_t *fixed,
                  const CeldHost *host, CeldLaplace *l, CeldWeightedGraph *g)
{
  size_t     w = (size_t) l->width, h = (size_t) l->height, n = w * h, strips = (h + CELD_STRIP - 1) / CELD_STRIP;
  Copy       c = { east, south, diagonal, fixed, l, g, celd_alloc (strips, w), celd_alloc (h, sizeof *c.least),
                   celd_alloc (h, sizeof *c.most) };
  CeldStatus status = CELD_NO_MEMORY;

  *g = (CeldWeightedGraph) { .width = l->width, .height = l->height, .east = celd_alloc (n, sizeof *g->east),
                       .south = celd_alloc (n, sizeof *g->south), .diagonal = celd_alloc (n, sizeof *g->diagonal) };
  l->held_row = celd_alloc0 (h + 1, sizeof *l->held_row);
  if (!c.mark || !c.least || !c.most || !g->east || !g->south || !g->diagonal || !l->held_row)
    goto done;
  celd_parallel_for (host, (int) strips, copy_strip, &c);
  for (size_t y = 0; y < h; y++)
    l->held_row[y + 1] += l->held_row[y];
  l->weak = g->weak = differ (&c);
  l->held = celd_alloc (l->held_row[h], sizeof *l->held);
  if (!l->held)
    goto done;
  celd_parallel_for (host, (int) strips, hold_strip, &c);
  status = CELD_OK;

done:
  celd_free (c.mark);
  celd_free (c.least);
  celd_free (c.most);
  return status;
}
