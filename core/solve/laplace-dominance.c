/* Nodes of the Laplacian solver's graphs whose diagonal dominates their edges.
 *
 * A node whose diagonal is more than twice the sum of its edge weights is solved by relaxation alone.  In an aggregate
 * it would hold the others with far more than the edge that joins them: a pixel between a fixed one and a wall, say,
 * would hold all that is behind the wall.  So it is left out of aggregation (as in A. Napov and Y. Notay, "An algebraic
 * multigrid method with guaranteed convergence rate", SIAM J. Sci. Comput. 34, 2012), and on coarser levels its edges
 * count for the diagonals of its neighbours: prolongation to it is zero.
 *
 * Without this the exact program takes up to seven times as long (campfire at 1 megapixel).  Cost: O(nodes + edges).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-aggregation.h"

#define DOMINANT  2    /* times all edge weights of a node together: its diagonal dominates; chosen */
#define MARK      0x80

typedef struct
{
  CeldWeightedGraph *graph;
  uint8_t           *mark;      /* of each node */
  uint32_t          *count;     /* of each row */
} Dominance;

/* Marks nodes of a row by their edges within the grid; `north` is NULL above the first row.  Returns how many. */
CELD_CLONES static uint32_t
mark_dominant (uint32_t w, const float *diagonal, const float *north, const float *south, const float *east,
               uint8_t *mark)
{
  uint32_t count = 0;
  int      any = 0;

  for (uint32_t x = 0; x < w; x++)
    any |= diagonal[x] > 0;
  for (uint32_t x = 0; x < w; x++)
    mark[x] = 0;
  for (uint32_t x = 0; any && x < w; x++)
    {
      float up = north ? north[x] : 0, left = x ? east[x - 1] : 0, sum = (up + left) + (east[x] + south[x]);

      mark[x] = diagonal[x] > DOMINANT * sum ? MARK : 0;
      count  += diagonal[x] > DOMINANT * sum;
    }
  return count;
}

static void
mark_strip (void *data, int strip)
{
  const Dominance         *o = data;
  const CeldWeightedGraph *g = o->graph;
  uint32_t                 w = (uint32_t) g->width;
  int                      end = (strip + 1) * CELD_STRIP < g->height ? (strip + 1) * CELD_STRIP : g->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      uint32_t i = (uint32_t) y * w;

      o->count[y] = mark_dominant (w, g->diagonal + i, y ? g->south + i - w : NULL, g->south + i, g->east + i,
                                   o->mark + i);
    }
}

/* The edge weights of a grid node within the grid. */
static float
grid_sum (const CeldWeightedGraph *g, uint32_t i)
{
  uint32_t w = (uint32_t) g->width;

  return g->east[i] + g->south[i] + (i % w ? g->east[i - 1] : 0) + (i >= w ? g->south[i - w] : 0);
}

/* Marks extra nodes, and takes marks off grid nodes that do not dominate their edges to extra ones.  sum: of each node,
 * 0 before. */
static void
mark_extra (const Dominance *o, float *sum)
{
  const CeldWeightedGraph *g = o->graph;
  uint32_t                 n = celd_grid_nodes (g);

  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        sum[n + k] += g->weight[e];
        if (g->neighbour[e] < n)
          sum[g->neighbour[e]] += g->weight[e];
      }
  for (uint32_t i = 0; i < n; i++)
    if (o->mark[i] && sum[i] > 0 && !(g->diagonal[i] > DOMINANT * (sum[i] + grid_sum (g, i))))
      o->mark[i] = 0;
  for (uint32_t i = n; i < n + g->n_extra; i++)
    o->mark[i] = g->diagonal[i] > DOMINANT * sum[i] ? MARK : 0;
}

/* Cuts the edge of weight *w, which has a marked end: it goes to the diagonal of the other end. */
static inline void
cut (const Dominance *o, uint32_t i, uint32_t j, float *w)
{
  if (!o->mark[i])
    o->graph->diagonal[i] += *w;
  if (!o->mark[j])
    o->graph->diagonal[j] += *w;
  *w = 0;
}

static void
cut_grid (const Dominance *o, uint32_t i, uint32_t w)
{
  CeldWeightedGraph *g = o->graph;

  if (i % w)
    cut (o, i, i - 1, &g->east[i - 1]);
  if ((i + 1) % w)
    cut (o, i, i + 1, &g->east[i]);
  if (i >= w)
    cut (o, i, i - w, &g->south[i - w]);
  if (i + w < celd_grid_nodes (g))
    cut (o, i, i + w, &g->south[i]);
}

static void
cut_row (const Dominance *o, int y)
{
  int            w = o->graph->width;
  const uint8_t *mark = o->mark + (size_t) y * (size_t) w;

  for (int x = celd_next_marked (w, mark, 0); x < w; x = celd_next_marked (w, mark, x + 1))
    cut_grid (o, (uint32_t) y * (uint32_t) w + (uint32_t) x, (uint32_t) w);
}

/* Edges between extra nodes are listed for either. */
static void
cut_extra (const Dominance *o)
{
  CeldWeightedGraph *g = o->graph;
  uint32_t           n = celd_grid_nodes (g);

  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        uint32_t j = g->neighbour[e];

        if (!o->mark[n + k] && !o->mark[j])
          continue;
        if (j < n)
          cut (o, n + k, j, &g->weight[e]);
        else if (!o->mark[n + k])
          g->diagonal[n + k] += g->weight[e];
        g->weight[e] = 0;
      }
}

CeldStatus
celd_leave_out_dominant (CeldWeightedGraph *graph, const CeldHost *host)
{
  uint32_t  n = celd_grid_nodes (graph);
  Dominance o = {
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
