/* The strongest link of each node of a graph of the Laplacian solver, by which they aggregate (laplace-graph.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-graph.h"
#include "solve/laplace-private.h"

/* The strongest of the four edges of each first node of a row; `north` is NULL above the first row.  The edges that
 * lead out of the grid have weight 0. */
CELD_CLONES static void
see_row (uint32_t first, uint32_t w, const float *north, const float *south, const float *east, float *best,
         uint32_t *link)
{
  for (uint32_t x = 0; x < w; x++)
    {
      float    up = north ? north[x] : 0, left = x ? east[x - 1] : 0, most = east[x];
      uint32_t i = first + x, j = i + 1;

      j    = south[x] > most ? i + w : j;
      most = south[x] > most ? south[x] : most;
      j    = left > most ? i - 1 : j;
      most = left > most ? left : most;
      j    = up > most ? i - w : j;
      most = up > most ? up : most;
      best[x] = most;
      link[x] = j;
    }
}

CELD_CLONES static void
measure_links (uint32_t w, const CeldBits *best, uint32_t *most, uint32_t *count)
{
  uint32_t largest = 0, linked = 0;

  for (uint32_t x = 0; x < w; x++)
    {
      largest = best[x] > largest ? best[x] : largest;
      linked += best[x] > 0;
    }
  *most  = largest;
  *count = linked;
}

static void
see_strip (void *data, int strip)
{
  CeldAggregation   *a = data;
  const CeldWeights *g = a->graph;
  uint32_t           w = (uint32_t) g->width;
  int                end = (strip + 1) * CELD_STRIP < g->height ? (strip + 1) * CELD_STRIP : g->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      uint32_t i = (uint32_t) y * w;

      see_row (i, w, y ? g->south + i - w : NULL, g->south + i, g->east + i, a->best + i, a->link + i);
      measure_links (w, (const CeldBits *) (a->best + i), &a->row_most[y], &a->row_count[y]);
    }
}

/* A link of node i; returns whether it is the first one. */
static inline bool
see_link (CeldAggregation *a, uint32_t i, uint32_t j, float w)
{
  bool first = !(a->best[i] > 0);

  if (!(w > a->best[i]))
    return false;
  a->best[i] = w;
  a->link[i] = j;
  return first;
}

uint32_t
celd_weights_see (CeldAggregation *a)
{
  const CeldWeights *g = a->graph;
  uint32_t           n = celd_weights_cells (g), linked = 0, most = 0;

  celd_parallel_for (a->host, (g->height + CELD_STRIP - 1) / CELD_STRIP, see_strip, a);
  for (int y = 0; y < g->height; y++)
    {
      most = a->row_most[y] > most ? a->row_most[y] : most;
      linked += a->row_count[y];
    }
  memcpy (&a->most, &most, sizeof most);
  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        linked += see_link (a, n + k, g->neighbour[e], g->weight[e]);
        linked += see_link (a, g->neighbour[e], n + k, g->weight[e]);
        a->most = g->weight[e] > a->most ? g->weight[e] : a->most;
      }
  return linked;
}
