/* The graphs of the Laplacian solver: component-split quadtree aggregation.
 *
 * A node of level l is one strongly connected component of pixels inside one cell of 2^l x 2^l pixels: no wall, however
 * thin, is averaged over.  A node whose links are all weak beside those of its strongest neighbour hangs on that
 * neighbour's aggregate as a leaf and joins nothing else, as soon as all of that is in the cell.  Where cells join too
 * little, nodes pair up instead (laplace-pairs.c).  Prolongation is constant on aggregates, so that coarse weights are
 * plain sums, never differences.  Nodes without an edge have no coarser node: relaxation solves them; nor have those
 * that the ground holds (laplace-ground.c).
 *
 * Aggregates lie within one cell, so rows of cells are independent of each other and go to the host's threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "solve/laplace-graph.h"
#include "solve/laplace-private.h"

#define STRONG      0.5f /* of the strongest link of either end: a strong link */
#define FEWER       0.6  /* share of nodes that cells may leave at most */
#define WHOLE       15   /* doublings after which every cell is the whole picture: 2^15 > CELD_MAX_SIDE */

void
celd_weights_clear (CeldWeights *g)
{
  celd_free (g->east);
  celd_free (g->south);
  celd_free (g->sink);
  celd_free (g->cell);
  celd_free (g->row_extra);
  celd_free (g->part);
  celd_free (g->start);
  celd_free (g->neighbour);
  celd_free (g->weight);
  *g = (CeldWeights) { 0 };
}

/* ------------------------------------------------------------------ aggregates */

/* Are all links of node i weak beside those of its strongest neighbour? */
static inline bool
is_leaf (const CeldAggregation *a, uint32_t i)
{
  return a->best[i] < STRONG * a->best[a->link[i]];
}

static bool
same_cell (const CeldAggregation *a, uint32_t i, uint32_t j)
{
  const CeldWeights *g = a->graph;
  uint32_t           n = celd_weights_cells (g);

  return celd_weights_above (g, i < n ? i : g->cell[i - n], a->coarse) ==
         celd_weights_above (g, j < n ? j : g->cell[j - n], a->coarse);
}

/* Must this leaf not hang on its strongest neighbour, because that goes on beyond the cell? */
static inline bool
waits (const CeldAggregation *a, uint32_t i)
{
  uint32_t host = a->link[i];

  return a->graph->part && a->graph->part[host] &&
         (!same_cell (a, i, host) || a->open[celd_root (a->parent, host)]);
}

/* An edge within a coarse cell.  The first sweep joins what it links strongly; the second one leaves, which hang on
 * their strongest neighbours.  What goes on beyond the cell is moved as one only on a coarser level, and what hung on
 * it could not move against it on any: its leaves are like other nodes.  Returns whether there are any. */
static inline bool
join_edge (CeldAggregation *a, bool leaves, uint32_t i, uint32_t j, float w)
{
  bool leaf_i, leaf_j, wait_i, wait_j, strong = w >= STRONG * a->most; /* for whomever */

  if (strong && w > 0 && !leaves)
    celd_join (a->parent, i, j);
  if (strong || !(w > 0))
    return false;
  leaf_i = is_leaf (a, i);
  leaf_j = is_leaf (a, j);
  strong = w >= STRONG * a->best[i] && w >= STRONG * a->best[j];
  if (!leaves)
    {
      if (!leaf_i && !leaf_j && strong)
        celd_join (a->parent, i, j);
      return leaf_i || leaf_j;
    }
  wait_i = leaf_i && waits (a, i);
  wait_j = leaf_j && waits (a, j);
  if ((leaf_i && a->link[i] == j && !wait_i) || (leaf_j && a->link[j] == i && !wait_j) ||
      (strong && (wait_i || wait_j) && leaf_i == wait_i && leaf_j == wait_j))
    celd_join (a->parent, i, j);
  return false;
}

/* Joins the first nodes of a fine row with their neighbours in the same cells. */
static inline bool
join_row (CeldAggregation *a, bool leaves, uint32_t y)
{
  const CeldWeights *g = a->graph;
  uint32_t           w = (uint32_t) g->width, i = y * w, side = 1u << a->coarse->doublings;
  bool               below = (y + 1) % side && y + 1 < (uint32_t) g->height, found = false;

  for (uint32_t x = 0; x < w; x++, i++)
    {
      if ((x + 1) % side && x + 1 < w)
        found |= join_edge (a, leaves, i, i + 1, g->east[i]);
      if (below)
        found |= join_edge (a, leaves, i, i + w, g->south[i]);
    }
  return found;
}

/* Joins an extra node with its neighbours in its coarse cell. */
static inline bool
join_extra (CeldAggregation *a, bool leaves, uint32_t k)
{
  const CeldWeights *g = a->graph;
  uint32_t           n = celd_weights_cells (g);
  bool               found = false;

  for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
    if (same_cell (a, n + k, g->neighbour[e]))
      found |= join_edge (a, leaves, n + k, g->neighbour[e], g->weight[e]);
  return found;
}

/* One sweep over the nodes of a row of coarse cells. */
static inline bool
join_nodes (CeldAggregation *a, bool leaves, const CeldNodes *nodes)
{
  bool found = false;

  for (uint32_t y = nodes->from; y < nodes->to; y++)
    found |= join_row (a, leaves, y);
  for (uint32_t k = nodes->extra; k < nodes->extra_end; k++)
    found |= join_extra (a, leaves, k);
  return found;
}

/* Marks what goes on beyond its cell in a row; edges of extra nodes have been seen. */
static void
mark_open (CeldAggregation *a, const CeldNodes *nodes)
{
  const CeldWeights *g = a->graph;
  uint32_t           w = (uint32_t) g->width, n = celd_weights_cells (g), side = 1u << a->coarse->doublings;

#define OPENS(weight) (g->part[i] && (weight) > 0 && (weight) >= STRONG * a->best[i])
  for (uint32_t y = nodes->from; y < nodes->to; y++)
    for (uint32_t x = 0, i = y * w; x < w; x++, i++)
      if ((x % side == 0 && x > 0 && OPENS (g->east[i - 1])) || ((x + 1) % side == 0 && OPENS (g->east[i])) ||
          (y % side == 0 && y > 0 && OPENS (g->south[i - w])) || ((y + 1) % side == 0 && OPENS (g->south[i])))
        a->open[i] = 1;
#undef OPENS
  for (uint32_t i = nodes->from * w; i < nodes->to * w; i++)
    if (a->open[i])
      a->open[celd_root (a->parent, i)] = 1;
  for (uint32_t i = n + nodes->extra; i < n + nodes->extra_end; i++)
    if (a->open[i])
      a->open[celd_root (a->parent, i)] = 1;
}

/* Marks what edges of extra nodes lead beyond their cells. */
static void
mark_open_extra (CeldAggregation *a)
{
  const CeldWeights *g = a->graph;
  uint32_t           n = celd_weights_cells (g);

  memset (a->open, 0, g->part ? (size_t) n + g->n_extra : 0);
  for (uint32_t k = 0; k < g->n_extra && g->part; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        uint32_t i = n + k, j = g->neighbour[e];
        float    w = g->weight[e];

        if (!(w > 0) || same_cell (a, i, j))
          continue;
        a->open[i] |= g->part[i] && w >= STRONG * a->best[i];
        a->open[j] |= g->part[j] && w >= STRONG * a->best[j];
      }
}

/* Aggregates of a row of coarse cells, and how many there are. */
static void
aggregate_row (void *data, int row)
{
  CeldAggregation   *a = data;
  const CeldWeights *g = a->graph;
  CeldNodes          nodes = celd_weights_nodes (g, a->coarse, row);
  uint32_t           w = (uint32_t) g->width, n = celd_weights_cells (g), count = 0;

  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    a->parent[i] = i;
  for (uint32_t k = nodes.extra; k < nodes.extra_end; k++)
    a->parent[n + k] = n + k;
  if (join_nodes (a, false, &nodes))
    {
      if (g->part)
        mark_open (a, &nodes);
      join_nodes (a, true, &nodes);
    }
  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    count += (a->parent[i] == i) & (a->best[i] > 0);
  for (uint32_t k = n + nodes.extra; k < n + nodes.extra_end; k++)
    count += (a->parent[k] == k) & (a->best[k] > 0);
  a->row_count[row] = count;
}

/* Aggregates in cells of 2 x 2; returns how many there are. */
static uint32_t
aggregate (CeldAggregation *a)
{
  uint32_t count = 0;

  a->coarse->doublings = 1;
  a->coarse->width  = (a->graph->width + 1) / 2;
  a->coarse->height = (a->graph->height + 1) / 2;
  mark_open_extra (a);
  celd_parallel_for (a->host, a->coarse->height, aggregate_row, a);
  for (int row = 0; row < a->coarse->height; row++)
    count += a->row_count[row];
  return count;
}

/* In pairs, without regard to cells: the whole picture is one. */
static CeldStatus
pair_up (CeldAggregation *a, uint32_t most)
{
  a->coarse->doublings = WHOLE;
  a->coarse->width = a->coarse->height = 1;
  memset (a->open, 0, (size_t) celd_weights_cells (a->graph) + a->graph->n_extra);
  return celd_weights_pair (a->graph, most, a->parent);
}

/* ------------------------------------------------------------------ coarsening */

static CeldStatus
aggregation_new (const CeldWeights *fine, CeldWeights *coarse, const CeldHost *host, CeldAggregation *a)
{
  uint32_t n = celd_weights_cells (fine) + fine->n_extra;

  *coarse = (CeldWeights) { 0 };
  *a = (CeldAggregation) {
    .graph = fine, .coarse = coarse, .host = host,
    .best = celd_alloc (n, sizeof *a->best),
    .link = celd_alloc (n, sizeof *a->link),
    .parent = celd_alloc (n, sizeof *a->parent),
    .open = celd_alloc (n, 1),
    .row_most = celd_alloc ((size_t) fine->height, sizeof *a->row_most),
    .row_count = celd_alloc ((size_t) fine->height, sizeof *a->row_count),
  };
  if (!a->best || !a->link || !a->parent || !a->open || !a->row_most || !a->row_count)
    return CELD_NO_MEMORY;
  memset (a->best + celd_weights_cells (fine), 0, fine->n_extra * sizeof *a->best);
  return CELD_OK;
}

/* Pixels are parts of whatever they belong to. */
static CeldStatus
begin_parts (CeldWeights *pixels)
{
  uint32_t n = celd_weights_cells (pixels);

  if (!(pixels->part = celd_alloc (n, 1)))
    return CELD_NO_MEMORY;
  memset (pixels->part, 1, n);
  return CELD_OK;
}

CeldStatus
celd_weights_coarsen (CeldWeights *fine, const CeldHost *host, CeldWeights *coarse, uint32_t **coarser)
{
  CeldAggregation a;
  CeldStatus      status = aggregation_new (fine, coarse, host, &a);
  uint32_t        most;

  if (status == CELD_OK && fine->weak)
    status = begin_parts (fine);
  if (status == CELD_OK)
    status = celd_weights_ground (fine, host);
  if (status != CELD_OK)
    goto done;
  most = (uint32_t) (FEWER * celd_weights_see (&a));
  if (celd_weights_cells (fine) == 1 || aggregate (&a) > most)
    status = pair_up (&a, most);
  if (status != CELD_OK)
    goto done;
  coarse->row_extra = celd_alloc0 ((size_t) coarse->height + 1, sizeof *coarse->row_extra);
  status = coarse->row_extra ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_weights_number (&a);
  if (status == CELD_OK)
    status = celd_weights_contract (fine, a.link, host, coarse);

done:
  if (status == CELD_OK)
    *coarser = a.link;
  else
    {
      celd_free (a.link);
      celd_weights_clear (coarse);
    }
  celd_free (a.best);
  celd_free (a.parent);
  celd_free (a.open);
  celd_free (a.row_most);
  celd_free (a.row_count);
  return status;
}
