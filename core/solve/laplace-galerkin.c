/* The coarse matrix of the Laplacian solver by Galerkin's rule P'AP, once every node has its aggregate.
 *
 * Prolongation P is constant on aggregates, so that a coarse weight is the sum of the edges between two aggregates and
 * a coarse diagonal the sum over one: plain sums, never differences.  The first aggregate of a coarse cell takes the
 * number of the cell and is its grid node; others are extra nodes behind the cells, row by row.
 *
 * Grid nodes go row by row to the host's threads; edges of extra nodes, which are few, follow one by one.
 *
 * Cost: O(nodes + edges).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/laplace-private.h"

/* ------------------------------------------------------------------ a graph */

void
celd_weighted_graph_clear (CeldWeightedGraph *g)
{
  celd_free (g->east);
  celd_free (g->south);
  celd_free (g->diagonal);
  celd_free (g->cell);
  celd_free (g->row_extra);
  celd_free (g->divided);
  celd_free (g->start);
  celd_free (g->neighbour);
  celd_free (g->weight);
  *g = (CeldWeightedGraph) { 0 };
}

/* ------------------------------------------------------------------ numbers of the aggregates */

/* Numbers the aggregate of node i, which lies in a coarse cell; *count is the next number of an extra one. */
static inline void
number_node (CeldAggregation *a, uint32_t i, uint32_t cell, uint32_t *count)
{
  uint32_t root = celd_root (a->parent, i);

  if (!(a->best[i] > 0))
    a->link[i] = CELD_NO_NODE;
  else if (root != i)
    a->link[i] = a->link[root]; /* a root comes before its members */
  else if (!a->taken[cell])
    {
      a->taken[cell] = 1;
      a->link[i]  = cell;
    }
  else
    a->link[i] = (*count)++;
}

/* The nodes of a row of coarse cells.  Extra aggregates count from the first one of the row. */
static void
number_row (void *data, int row)
{
  CeldAggregation         *a = data;
  const CeldWeightedGraph *g = a->graph;
  CeldWeightedGraph       *coarse = a->coarse;
  CeldNodeRange            nodes = celd_nodes_of_row (g, coarse, row);
  uint32_t                 w = (uint32_t) g->width, n = celd_grid_nodes (g), cells = celd_grid_nodes (coarse);
  uint32_t                 cell = (uint32_t) row * (uint32_t) coarse->width, side = 1u << coarse->doublings;
  uint32_t                 count = cells;

  for (uint32_t x0 = 0, c = cell; x0 < w; x0 += side, c++)
    for (uint32_t y = nodes.from; y < nodes.to; y++)
      for (uint32_t x = x0; x < x0 + side && x < w; x++)
        number_node (a, y * w + x, c, &count);
  for (uint32_t k = nodes.extra; k < nodes.extra_end; k++)
    number_node (a, n + k, celd_coarse_cell (g, g->cell[k], coarse), &count);
  a->row_count[row] = count - cells;
}

/* Extra aggregates of a row come after those of the rows before. */
static void
shift_row (void *data, int row)
{
  CeldAggregation         *a = data;
  const CeldWeightedGraph *g = a->graph;
  CeldNodeRange            nodes = celd_nodes_of_row (g, a->coarse, row);
  uint32_t                 w = (uint32_t) g->width, n = celd_grid_nodes (g), cells = celd_grid_nodes (a->coarse);
  uint32_t                 before = a->coarse->row_extra[row];

  if (!before || before == a->coarse->row_extra[row + 1])
    return;
  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    a->link[i] += a->link[i] >= cells && a->link[i] != CELD_NO_NODE ? before : 0;
  for (uint32_t i = n + nodes.extra; i < n + nodes.extra_end; i++)
    a->link[i] += a->link[i] >= cells && a->link[i] != CELD_NO_NODE ? before : 0;
}

/* Parts of strong components that go on beyond their cells are parts on the coarse level, too. */
static void
carry_row (void *data, int row)
{
  CeldAggregation *a = data;
  CeldNodeRange    nodes = celd_nodes_of_row (a->graph, a->coarse, row);
  uint32_t         w = (uint32_t) a->graph->width, n = celd_grid_nodes (a->graph);

  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    if (a->divided[i] && a->link[i] != CELD_NO_NODE)
      a->coarse->divided[a->link[i]] = 1;
  for (uint32_t i = n + nodes.extra; i < n + nodes.extra_end; i++)
    if (a->divided[i] && a->link[i] != CELD_NO_NODE)
      a->coarse->divided[a->link[i]] = 1;
}

CeldStatus
celd_number_aggregates (CeldAggregation *a)
{
  CeldWeightedGraph *coarse = a->coarse;

  if (!(a->taken = celd_alloc0 (celd_grid_nodes (coarse), 1)))
    return CELD_NO_MEMORY;
  celd_parallel_for (a->host, coarse->height, number_row, a);
  celd_free (a->taken);
  for (int row = 0; row < coarse->height; row++)
    coarse->row_extra[row + 1] = coarse->row_extra[row] + a->row_count[row];
  coarse->n_extra = coarse->row_extra[coarse->height];
  celd_parallel_for (a->host, coarse->height, shift_row, a);
  if (!a->graph->divided)
    return CELD_OK;
  if (!(coarse->divided = celd_alloc0 ((size_t) celd_grid_nodes (coarse) + coarse->n_extra, 1)))
    return CELD_NO_MEMORY;
  celd_parallel_for (a->host, coarse->height, carry_row, a);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the coarse matrix */

/* An edge from an extra node. */
typedef struct { uint32_t from, to; float weight; } ExtraEdge;

typedef struct
{
  const CeldWeightedGraph *fine;
  const uint32_t          *coarser;
  CeldWeightedGraph       *coarse;
  ExtraEdge               *edge;
  size_t                   n;
  size_t                   edge_capacity;
} Contraction;

/* ------------------------------------------------------------------ edges of grid nodes */

/* An edge of weight w between what have become i and j, if both are grid nodes and differ. */
static inline void
add_edge (const Contraction *c, uint32_t i, uint32_t j, float w)
{
  CeldWeightedGraph *g = c->coarse;
  uint32_t           low = i < j ? i : j, high = i < j ? j : i;

  if (low == high || high >= celd_grid_nodes (g) || !(w > 0))
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

/* The diagonal of node i, which lies in a coarse cell. */
static inline void
add_diagonal (const Contraction *c, uint32_t i, uint32_t cell)
{
  uint32_t n = celd_grid_nodes (c->coarse), to = c->coarser[i];

  if (to == CELD_NO_NODE)
    return;
  c->coarse->diagonal[to] += c->fine->diagonal[i];
  if (to >= n)
    c->coarse->cell[to - n] = cell;
}

static void
contract_row (void *data, int row)
{
  const Contraction       *c = data;
  const CeldWeightedGraph *fine = c->fine;
  CeldNodeRange            nodes = celd_nodes_of_row (fine, c->coarse, row);
  uint32_t                 w = (uint32_t) fine->width, n = celd_grid_nodes (fine);
  uint32_t                 first = (uint32_t) row * (uint32_t) c->coarse->width;

  for (uint32_t y = nodes.from; y < nodes.to; y++)
    for (uint32_t x = 0; x < w; x++)
      {
        add_cell (c, x, y);
        add_diagonal (c, y * w + x, first + (x >> c->coarse->doublings));
      }
  for (uint32_t k = nodes.extra; k < nodes.extra_end; k++)
    add_diagonal (c, n + k, celd_coarse_cell (fine, fine->cell[k], c->coarse));
}

/* ------------------------------------------------------------------ edges of extra nodes */

/* What an edge of weight w between what have become i and j is to i, if that is an extra node. */
static inline CeldStatus
push_edge (Contraction *c, uint32_t i, uint32_t j, float w)
{
  uint32_t n = celd_grid_nodes (c->coarse);

  if (i == j || i < n || i == CELD_NO_NODE || !(w > 0))
    return CELD_OK;
  return celd_append (c->edge, c->n, c->edge_capacity, (ExtraEdge) { i - n, j, w });
}

/* The edges of a grid node that has become an extra one. */
static CeldStatus
push_grid (Contraction *c, uint32_t x, uint32_t y)
{
  const CeldWeightedGraph *g = c->fine;
  const uint32_t          *to = c->coarser;
  uint32_t                 w = (uint32_t) g->width, i = y * w + x;
  CeldStatus               status = CELD_OK;

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

/* The edges of an extra node: each once to grid nodes, and for either end to extra ones. */
static CeldStatus
push_extra (Contraction *c, uint32_t k)
{
  const CeldWeightedGraph *g = c->fine;
  uint32_t                 n = celd_grid_nodes (g), i = c->coarser[n + k];
  CeldStatus               status = CELD_OK;

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
  CeldNodeRange nodes = celd_nodes_of_row (c->fine, c->coarse, row);
  uint32_t      w = (uint32_t) c->fine->width, n = celd_grid_nodes (c->coarse);
  CeldStatus    status = CELD_OK;

  if (c->coarse->row_extra[row] < c->coarse->row_extra[row + 1])
    for (uint32_t y = nodes.from; y < nodes.to; y++)
      for (uint32_t x = 0; x < w && status == CELD_OK; x++)
        if (c->coarser[y * w + x] >= n)
          status = push_grid (c, x, y);
  for (uint32_t k = nodes.extra; k < nodes.extra_end && status == CELD_OK; k++)
    status = push_extra (c, k);
  return status;
}

/* Sorts the edges of extra nodes by their node, equal ones summed up.  place: workspace, one for each coarse node. */
static CeldStatus
list_edges (const Contraction *c, uint32_t *place)
{
  CeldWeightedGraph *g = c->coarse;
  uint32_t           kept = 0, from = 0;

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
  for (uint32_t i = 0; i < celd_grid_nodes (g) + g->n_extra; i++)
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
celd_galerkin (const CeldWeightedGraph *fine, const uint32_t *coarser, const CeldHost *host, CeldWeightedGraph *coarse)
{
  uint32_t    n = celd_grid_nodes (coarse);
  uint32_t   *place = celd_alloc ((size_t) n + coarse->n_extra, sizeof *place);
  Contraction c = { fine, coarser, coarse, NULL, 0, 0 };
  CeldStatus  status = CELD_NO_MEMORY;

  coarse->east  = celd_alloc0 (n, sizeof *coarse->east);
  coarse->south = celd_alloc0 (n, sizeof *coarse->south);
  coarse->diagonal  = celd_alloc0 ((size_t) n + coarse->n_extra, sizeof *coarse->diagonal);
  coarse->cell  = celd_alloc (coarse->n_extra, sizeof *coarse->cell);
  if (place && coarse->east && coarse->south && coarse->diagonal && coarse->cell)
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
