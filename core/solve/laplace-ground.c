/* Nodes of the Laplacian solver that the ground holds.
 *
 * A node whose diagonal beyond its edges is more than all these knows its value nearly by itself: relaxation finds it.
 * In an aggregate it would hold the others with far more than the edge that joins them: a pixel between a fixed one
 * and a wall, say, all that is behind the wall.  So it gets no coarser node, and on coarser levels its edges hold what
 * is at their other ends: prolongation from there is zero.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-graph.h"
#include "solve/laplace-private.h"

#define HELD      2    /* times all edges together */
#define ON_GROUND 0x80

typedef struct
{
  CeldWeights *graph;
  uint8_t     *mark;            /* of each node */
  uint32_t    *count;           /* of each row */
} Ground;

/* Marks nodes of a row by their edges within the grid; `north` is NULL above the first row.  Returns how many. */
CELD_CLONES static uint32_t
mark_grounded (uint32_t w, const float *sink, const float *north, const float *south, const float *east, uint8_t *mark)
{
  uint32_t count = 0;
  int      any = 0;

  for (uint32_t x = 0; x < w; x++)
    any |= sink[x] > 0;
  for (uint32_t x = 0; x < w; x++)
    mark[x] = 0;
  for (uint32_t x = 0; any && x < w; x++)
    {
      float up = north ? north[x] : 0, left = x ? east[x - 1] : 0, sum = (up + left) + (east[x] + south[x]);

      mark[x] = sink[x] > HELD * sum ? ON_GROUND : 0;
      count  += sink[x] > HELD * sum;
    }
  return count;
}

static void
mark_strip (void *data, int strip)
{
  const Ground      *o = data;
  const CeldWeights *g = o->graph;
  uint32_t           w = (uint32_t) g->width;
  int                end = (strip + 1) * CELD_STRIP < g->height ? (strip + 1) * CELD_STRIP : g->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      uint32_t i = (uint32_t) y * w;

      o->count[y] = mark_grounded (w, g->sink + i, y ? g->south + i - w : NULL, g->south + i, g->east + i, o->mark + i);
    }
}

/* Edges of a first node within the grid. */
static float
grid_sum (const CeldWeights *g, uint32_t i)
{
  uint32_t w = (uint32_t) g->width;

  return g->east[i] + g->south[i] + (i % w ? g->east[i - 1] : 0) + (i >= w ? g->south[i - w] : 0);
}

/* Marks extra nodes, and takes marks off first ones that their edges to extra ones hold, too.  sum: of each node, 0. */
static void
mark_extra (const Ground *o, float *sum)
{
  const CeldWeights *g = o->graph;
  uint32_t           n = celd_weights_cells (g);

  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        sum[n + k] += g->weight[e];
        if (g->neighbour[e] < n)
          sum[g->neighbour[e]] += g->weight[e];
      }
  for (uint32_t i = 0; i < n; i++)
    if (o->mark[i] && sum[i] > 0 && !(g->sink[i] > HELD * (sum[i] + grid_sum (g, i))))
      o->mark[i] = 0;
  for (uint32_t i = n; i < n + g->n_extra; i++)
    o->mark[i] = g->sink[i] > HELD * sum[i] ? ON_GROUND : 0;
}

/* Cuts the edge of weight *w, one end of which is on the ground: it holds the other one. */
static inline void
cut (const Ground *o, uint32_t i, uint32_t j, float *w)
{
  if (!o->mark[i])
    o->graph->sink[i] += *w;
  if (!o->mark[j])
    o->graph->sink[j] += *w;
  *w = 0;
}

static void
cut_first (const Ground *o, uint32_t i, uint32_t w)
{
  CeldWeights *g = o->graph;

  if (i % w)
    cut (o, i, i - 1, &g->east[i - 1]);
  if ((i + 1) % w)
    cut (o, i, i + 1, &g->east[i]);
  if (i >= w)
    cut (o, i, i - w, &g->south[i - w]);
  if (i + w < celd_weights_cells (g))
    cut (o, i, i + w, &g->south[i]);
}

static void
cut_row (const Ground *o, int y)
{
  int            w = o->graph->width;
  const uint8_t *mark = o->mark + (size_t) y * (size_t) w;

  for (int x = celd_next_marked (w, mark, 0); x < w; x = celd_next_marked (w, mark, x + 1))
    cut_first (o, (uint32_t) y * (uint32_t) w + (uint32_t) x, (uint32_t) w);
}

/* Edges between extra nodes are listed for either. */
static void
cut_extra (const Ground *o)
{
  CeldWeights *g = o->graph;
  uint32_t     n = celd_weights_cells (g);

  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        uint32_t j = g->neighbour[e];

        if (!o->mark[n + k] && !o->mark[j])
          continue;
        if (j < n)
          cut (o, n + k, j, &g->weight[e]);
        else if (!o->mark[n + k])
          g->sink[n + k] += g->weight[e];
        g->weight[e] = 0;
      }
}

CeldStatus
celd_weights_ground (CeldWeights *graph, const CeldHost *host)
{
  uint32_t   n = celd_weights_cells (graph);
  Ground     o = {
    graph, celd_alloc ((size_t) n + graph->n_extra, 1), celd_alloc ((size_t) graph->height, sizeof *o.count)
  };
  float     *sum = celd_alloc0 (graph->n_extra ? (size_t) n + graph->n_extra : 0, sizeof *sum);
  CeldStatus status = o.mark && o.count && sum ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_parallel_for (host, (graph->height + CELD_STRIP - 1) / CELD_STRIP, mark_strip, &o);
      if (graph->n_extra)
        mark_extra (&o, sum);
      for (int y = 0; y < graph->height; y++)
        if (o.count[y])
          cut_row (&o, y);
      cut_extra (&o);
    }
  celd_free (o.mark);
  celd_free (o.count);
  celd_free (sum);
  return status;
}
