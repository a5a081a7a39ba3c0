/* The coarse graph of the Laplacian solver, once every node knows its aggregate.
 *
 * Edges between first nodes of cells go row by row to the host's threads; those of extra nodes, which are few, follow
 * one by one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-graph.h"
#include "solve/laplace-private.h"

/* An edge from an extra node. */
typedef struct { uint32_t from, to; float weight; } Edge;

typedef struct
{
  const CeldWeights *fine;
  const uint32_t    *coarser;
  CeldWeights       *coarse;
  Edge              *edge;
  size_t             n;
} Contraction;

/* ------------------------------------------------------------------ edges of first nodes */

/* An edge of weight w between what have become i and j, if both are first nodes and differ. */
static inline void
add_edge (const Contraction *c, uint32_t i, uint32_t j, float w)
{
  CeldWeights *g = c->coarse;
  uint32_t     low = i < j ? i : j, high = i < j ? j : i;

  if (low == high || high >= celd_weights_cells (g) || !(w > 0))
    return;
  if (high == low + 1 && g->width > 1)
    g->east[low] += w;
  else
    g->south[low] += w;
}

/* The edges of a fine cell to the east and to the south. */
static inline void
add_cell (const Contraction *c, uint32_t x, uint32_t y)
{
  uint32_t w = (uint32_t) c->fine->width, i = y * w + x;

  if (x + 1 < w)
    add_edge (c, c->coarser[i], c->coarser[i + 1], c->fine->east[i]);
  if (y + 1 < (uint32_t) c->fine->height)
    add_edge (c, c->coarser[i], c->coarser[i + w], c->fine->south[i]);
}

/* The sink of node i, which lies in a coarse cell. */
static inline void
add_sink (const Contraction *c, uint32_t i, uint32_t cell)
{
  uint32_t n = celd_weights_cells (c->coarse), to = c->coarser[i];

  if (to == CELD_NO_NODE)
    return;
  c->coarse->sink[to] += c->fine->sink[i];
  if (to >= n)
    c->coarse->cell[to - n] = cell;
}

static void
contract_row (void *data, int row)
{
  const Contraction *c = data;
  const CeldWeights *fine = c->fine;
  CeldNodes          nodes = celd_weights_nodes (fine, c->coarse, row);
  uint32_t           w = (uint32_t) fine->width, n = celd_weights_cells (fine);
  uint32_t           first = (uint32_t) row * (uint32_t) c->coarse->width;

  for (uint32_t y = nodes.from; y < nodes.to; y++)
    for (uint32_t x = 0; x < w; x++)
      {
        add_cell (c, x, y);
        add_sink (c, y * w + x, first + (x >> c->coarse->doublings));
      }
  for (uint32_t k = nodes.extra; k < nodes.extra_end; k++)
    add_sink (c, n + k, celd_weights_above (fine, fine->cell[k], c->coarse));
}

/* ------------------------------------------------------------------ edges of extra nodes */

/* What an edge of weight w between what have become i and j is to i, if that is an extra node. */
static inline CeldStatus
push_edge (Contraction *c, uint32_t i, uint32_t j, float w)
{
  uint32_t n = celd_weights_cells (c->coarse);
  Edge    *edge;

  if (i == j || i < n || i == CELD_NO_NODE || !(w > 0))
    return CELD_OK;
  if (!(edge = celd_grow (c->edge, c->n + 1, sizeof *edge)))
    return CELD_NO_MEMORY;
  c->edge         = edge;
  c->edge[c->n++] = (Edge) { i - n, j, w };
  return CELD_OK;
}

/* The edges of a first node that has become an extra one. */
static CeldStatus
push_first (Contraction *c, uint32_t x, uint32_t y)
{
  const CeldWeights *g = c->fine;
  const uint32_t    *to = c->coarser;
  uint32_t           w = (uint32_t) g->width, i = y * w + x;
  CeldStatus         status = CELD_OK;

  if (x > 0)
    status = push_edge (c, to[i], to[i - 1], g->east[i - 1]);
  if (x + 1 < w && status == CELD_OK)
    status = push_edge (c, to[i], to[i + 1], g->east[i]);
  if (y > 0 && status == CELD_OK)
    status = push_edge (c, to[i], to[i - w], g->south[i - w]);
  if (y + 1 < (uint32_t) g->height && status == CELD_OK)
    status = push_edge (c, to[i], to[i + w], g->south[i]);
  return status;
}

/* The edges of an extra node: each once to first nodes, and for either end to extra ones. */
static CeldStatus
push_extra (Contraction *c, uint32_t k)
{
  const CeldWeights *g = c->fine;
  uint32_t           n = celd_weights_cells (g), i = c->coarser[n + k];
  CeldStatus         status = CELD_OK;

  for (uint32_t e = g->start[k]; e < g->start[k + 1] && status == CELD_OK; e++)
    {
      uint32_t j = c->coarser[g->neighbour[e]];

      status = push_edge (c, i, j, g->weight[e]);
      if (g->neighbour[e] < n && status == CELD_OK)
        status = push_edge (c, j, i, g->weight[e]);
      if (g->neighbour[e] < n + k)
        add_edge (c, i, j, g->weight[e]);
    }
  return status;
}

static CeldStatus
push_row (Contraction *c, int row)
{
  CeldNodes  nodes = celd_weights_nodes (c->fine, c->coarse, row);
  uint32_t   w = (uint32_t) c->fine->width, n = celd_weights_cells (c->coarse);
  CeldStatus status = CELD_OK;

  if (c->coarse->row_extra[row] < c->coarse->row_extra[row + 1])
    for (uint32_t y = nodes.from; y < nodes.to; y++)
      for (uint32_t x = 0; x < w && status == CELD_OK; x++)
        if (c->coarser[y * w + x] >= n)
          status = push_first (c, x, y);
  for (uint32_t k = nodes.extra; k < nodes.extra_end && status == CELD_OK; k++)
    status = push_extra (c, k);
  return status;
}

/* Sorts the edges of extra nodes by their node, equal ones summed up.  place: workspace, one for each coarse node. */
static CeldStatus
list_edges (const Contraction *c, uint32_t *place)
{
  CeldWeights *g = c->coarse;
  uint32_t     kept = 0, from = 0;

  g->start     = celd_alloc0 ((size_t) g->n_extra + 2, sizeof *g->start);
  g->neighbour = celd_alloc (c->n, sizeof *g->neighbour);
  g->weight    = celd_alloc (c->n, sizeof *g->weight);
  if (!g->start || !g->neighbour || !g->weight)
    return CELD_NO_MEMORY;
  for (size_t e = 0; e < c->n; e++)
    g->start[c->edge[e].from + 2]++;
  for (uint32_t k = 0; k < g->n_extra; k++)
    g->start[k + 2] += g->start[k + 1];
  for (size_t e = 0; e < c->n; e++)
    {
      uint32_t at = g->start[c->edge[e].from + 1]++;

      g->neighbour[at] = c->edge[e].to;
      g->weight[at]    = c->edge[e].weight;
    }
  for (uint32_t i = 0; i < celd_weights_cells (g) + g->n_extra; i++)
    place[i] = CELD_NO_NODE;
  for (uint32_t k = 0; k < g->n_extra; k++)
    {
      uint32_t end = g->start[k + 1], first = kept;

      for (uint32_t e = from; e < end; e++)
        {
          uint32_t *at = &place[g->neighbour[e]];

          if (*at == CELD_NO_NODE || *at < first)
            {
              *at = kept;
              g->neighbour[kept] = g->neighbour[e];
              g->weight[kept++]  = g->weight[e];
            }
          else
            g->weight[*at] += g->weight[e];
        }
      from = end;
      g->start[k + 1] = kept;
    }
  return CELD_OK;
}

CeldStatus
celd_weights_contract (const CeldWeights *fine, const uint32_t *coarser, const CeldHost *host, CeldWeights *coarse)
{
  uint32_t    n = celd_weights_cells (coarse);
  uint32_t   *place = celd_alloc ((size_t) n + coarse->n_extra, sizeof *place);
  Contraction c = { fine, coarser, coarse, NULL, 0 };
  CeldStatus  status = CELD_NO_MEMORY;

  coarse->east  = celd_alloc0 (n, sizeof *coarse->east);
  coarse->south = celd_alloc0 (n, sizeof *coarse->south);
  coarse->sink  = celd_alloc0 ((size_t) n + coarse->n_extra, sizeof *coarse->sink);
  coarse->cell  = celd_alloc (coarse->n_extra, sizeof *coarse->cell);
  if (place && coarse->east && coarse->south && coarse->sink && coarse->cell)
    {
      status = CELD_OK;
      celd_parallel_for (host, coarse->height, contract_row, &c);
    }
  for (int row = 0; row < coarse->height && status == CELD_OK; row++)
    status = push_row (&c, row);
  if (status == CELD_OK)
    status = list_edges (&c, place);
  celd_free (place);
  celd_free (c.edge);
  return status;
}
