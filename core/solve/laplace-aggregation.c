/* Aggregation of the Laplacian solver's graphs: strong components within quadtree cells.
 *
 * A node of level l is one strongly connected component of the pixels in a cell of 2^l x 2^l pixels, so that no wall,
 * however thin, is averaged over.  An edge is strong if its weight is at least half that of the strongest edge at
 * either end (as in classical algebraic multigrid; Brandt, McCormick and Ruge 1984).  A weakly attached node, whose
 * edges are all weak beside those of its strongest neighbour, joins that neighbour's aggregate and no other, as soon as
 * the whole strong component of that lies in one cell.  Where cells leave too many nodes, they are aggregated in pairs
 * instead (laplace-quality.c).  Nodes without an edge and dominant ones (laplace-quality.c) have no aggregate:
 * relaxation alone solves them.
 *
 * Aggregates lie within one coarse cell, so rows of cells are independent of each other and go to the host's threads.
 *
 * Cost: O(nodes + edges), nearly.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/laplace-private.h"

#define STRONG_EDGE 0.5f /* times the strongest edge at either end: a strong edge; chosen by the bench */
#define FEWER       0.6  /* aggregates for each node at most, or pairs are tried; chosen by the bench */
#define WHOLE       15   /* doublings after which any cell is the whole picture: 2^15 > CELD_MAX_SIDE */

/* ------------------------------------------------------------------ strongest links */

/* The strongest of the four edges of each grid node of a row; `north` is NULL above the first row.  The edges that
 * lead out of the grid have weight 0. */
CELD_CLONES static void
strongest_of_row (uint32_t first, uint32_t w, const float *north, const float *south, const float *east, float *best,
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

CELD_CLONES static uint32_t
count_linked (uint32_t w, const float *best)
{
  uint32_t linked = 0;

  for (uint32_t x = 0; x < w; x++)
    linked += best[x] > 0;
  return linked;
}

static void
strongest_of_strip (void *data, int strip)
{
  CeldAggregation         *a = data;
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 w = (uint32_t) g->width;
  int                      end = (strip + 1) * CELD_STRIP < g->height ? (strip + 1) * CELD_STRIP : g->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      uint32_t i = (uint32_t) y * w;

      strongest_of_row (i, w, y ? g->south + i - w : NULL, g->south + i, g->east + i, a->best + i, a->link + i);
      a->row_count[y] = count_linked (w, a->best + i);
    }
}

/* A link of node i; returns whether it is the first one. */
static inline bool
add_link (CeldAggregation *a, uint32_t i, uint32_t j, float w)
{
  bool first = !(a->best[i] > 0);

  if (!(w > a->best[i]))
    return false;
  a->best[i] = w;
  a->link[i] = j;
  return first;
}

/* The strongest edge of every node: best and link; returns how many nodes have an edge. */
static uint32_t
find_strongest (CeldAggregation *a)
{
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 n = celd_grid_nodes (g), linked = 0;

  celd_parallel_for (a->host, (g->height + CELD_STRIP - 1) / CELD_STRIP, strongest_of_strip, a);
  for (int y = 0; y < g->height; y++)
    linked += a->row_count[y];
  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        linked += add_link (a, n + k, g->neighbour[e], g->weight[e]);
        linked += add_link (a, g->neighbour[e], n + k, g->weight[e]);
      }
  return linked;
}

/* ------------------------------------------------------------------ aggregates */

/* Are all edges of node i weak beside those of its strongest neighbour? */
static inline bool
is_weakly_attached (const CeldAggregation *a, uint32_t i)
{
  return a->best[i] < STRONG_EDGE * a->best[a->link[i]];
}

static bool
same_cell (const CeldAggregation *a, uint32_t i, uint32_t j)
{
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 n = celd_grid_nodes (g);

  return celd_coarse_cell (g, i < n ? i : g->cell[i - n], a->coarse) ==
         celd_coarse_cell (g, j < n ? j : g->cell[j - n], a->coarse);
}

/* Must the weakly attached node i not yet join its strongest neighbour, because the strong component of that neighbour
 * extends beyond the cell? */
static inline bool
must_wait (const CeldAggregation *a, uint32_t i)
{
  uint32_t to = a->link[i];

  return a->graph->divided && a->graph->divided[to] &&
         (!same_cell (a, i, to) || a->divided[celd_root (a->parent, to)]);
}

/* An edge within a coarse cell.  The first sweep joins nodes by strong edges; the second one (attach) joins weakly
 * attached nodes to their strongest neighbours.  A strong component that goes on beyond the cell moves as one only on a
 * coarser level; a node joined to one of its parts could not move against it on any level, so such nodes join each
 * other instead.  Returns whether there is a weakly attached node. */
static inline bool
join_edge (CeldAggregation *a, bool attach, uint32_t i, uint32_t j, float w)
{
  bool weak_i, weak_j, waits_i, waits_j, strong;

  if (!(w > 0))
    return false;
  weak_i = is_weakly_attached (a, i);
  weak_j = is_weakly_attached (a, j);
  strong = w >= STRONG_EDGE * a->best[i] && w >= STRONG_EDGE * a->best[j];
  if (!attach)
    {
      if (!weak_i && !weak_j && strong)
        celd_join (a->parent, i, j);
      return weak_i || weak_j;
    }
  waits_i = weak_i && must_wait (a, i);
  waits_j = weak_j && must_wait (a, j);
  if ((weak_i && a->link[i] == j && !waits_i) || (weak_j && a->link[j] == i && !waits_j) ||
      (strong && (waits_i || waits_j) && weak_i == waits_i && weak_j == waits_j))
    celd_join (a->parent, i, j);
  return false;
}

/* Joins the grid nodes of a fine row with their neighbours in the same cells. */
static inline bool
join_row (CeldAggregation *a, bool attach, uint32_t y)
{
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 w = (uint32_t) g->width, i = y * w, side = 1u << a->coarse->doublings;
  bool                     below = (y + 1) % side && y + 1 < (uint32_t) g->height, found = false;

  for (uint32_t x = 0; x < w; x++, i++)
    {
      if ((x + 1) % side && x + 1 < w)
        found |= join_edge (a, attach, i, i + 1, g->east[i]);
      if (below)
        found |= join_edge (a, attach, i, i + w, g->south[i]);
    }
  return found;
}

/* Joins an extra node with its neighbours in its coarse cell. */
static inline bool
join_extra (CeldAggregation *a, bool attach, uint32_t k)
{
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 n = celd_grid_nodes (g);
  bool                     found = false;

  for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
    if (same_cell (a, n + k, g->neighbour[e]))
      found |= join_edge (a, attach, n + k, g->neighbour[e], g->weight[e]);
  return found;
}

/* One sweep over the nodes of a row of coarse cells. */
static inline bool
join_nodes (CeldAggregation *a, bool attach, const CeldNodeRange *nodes)
{
  bool found = false;

  for (uint32_t y = nodes->from; y < nodes->to; y++)
    found |= join_row (a, attach, y);
  for (uint32_t k = nodes->extra; k < nodes->extra_end; k++)
    found |= join_extra (a, attach, k);
  return found;
}

/* Marks the strong components of a row of coarse cells that go on beyond their cell; edges of extra nodes come
 * before. */
static void
mark_divided (CeldAggregation *a, const CeldNodeRange *nodes)
{
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 w = (uint32_t) g->width, n = celd_grid_nodes (g), side = 1u << a->coarse->doublings;

#define DIVIDES(weight) (g->divided[i] && (weight) > 0 && (weight) >= STRONG_EDGE * a->best[i])
  for (uint32_t y = nodes->from; y < nodes->to; y++)
    for (uint32_t x = 0, i = y * w; x < w; x++, i++)
      if ((x % side == 0 && x > 0 && DIVIDES (g->east[i - 1])) || ((x + 1) % side == 0 && DIVIDES (g->east[i])) ||
          (y % side == 0 && y > 0 && DIVIDES (g->south[i - w])) || ((y + 1) % side == 0 && DIVIDES (g->south[i])))
        a->divided[i] = 1;
#undef DIVIDES
  for (uint32_t i = nodes->from * w; i < nodes->to * w; i++)
    if (a->divided[i])
      a->divided[celd_root (a->parent, i)] = 1;
  for (uint32_t i = n + nodes->extra; i < n + nodes->extra_end; i++)
    if (a->divided[i])
      a->divided[celd_root (a->parent, i)] = 1;
}

/* Marks nodes that strong edges of extra nodes join beyond their cells. */
static void
mark_divided_by_extra (CeldAggregation *a)
{
  const CeldWeightedGraph *g = a->graph;
  uint32_t                 n = celd_grid_nodes (g);

  memset (a->divided, 0, g->divided ? (size_t) n + g->n_extra : 0);
  for (uint32_t k = 0; k < g->n_extra && g->divided; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      {
        uint32_t i = n + k, j = g->neighbour[e];
        float    w = g->weight[e];

        if (!(w > 0) || same_cell (a, i, j))
          continue;
        a->divided[i] |= g->divided[i] && w >= STRONG_EDGE * a->best[i];
        a->divided[j] |= g->divided[j] && w >= STRONG_EDGE * a->best[j];
      }
}

/* Aggregates of a row of coarse cells, and how many there are. */
static void
aggregate_row (void *data, int row)
{
  CeldAggregation         *a = data;
  const CeldWeightedGraph *g = a->graph;
  CeldNodeRange            nodes = celd_nodes_of_row (g, a->coarse, row);
  uint32_t                 w = (uint32_t) g->width, n = celd_grid_nodes (g), count = 0;

  for (uint32_t i = nodes.from * w; i < nodes.to * w; i++)
    a->parent[i] = i;
  for (uint32_t k = nodes.extra; k < nodes.extra_end; k++)
    a->parent[n + k] = n + k;
  if (join_nodes (a, false, &nodes))
    {
      if (g->divided)
        mark_divided (a, &nodes);
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
  mark_divided_by_extra (a);
  celd_parallel_for (a->host, a->coarse->height, aggregate_row, a);
  for (int row = 0; row < a->coarse->height; row++)
    count += a->row_count[row];
  return count;
}

/* Aggregates in pairs, without regard to cells: the whole picture is one. */
static CeldStatus
pair_up (CeldAggregation *a, uint32_t most)
{
  a->coarse->doublings = WHOLE;
  a->coarse->width = a->coarse->height = 1;
  memset (a->divided, 0, (size_t) celd_grid_nodes (a->graph) + a->graph->n_extra);
  return celd_pairwise_aggregate (a->graph, most, a->parent);
}

/* ------------------------------------------------------------------ coarsening */

static CeldStatus
aggregation_new (const CeldWeightedGraph *fine, CeldWeightedGraph *coarse, const CeldHost *host, CeldAggregation *a)
{
  uint32_t n = celd_grid_nodes (fine) + fine->n_extra;

  *coarse = (CeldWeightedGraph) { 0 };
  *a = (CeldAggregation) {
    .graph = fine, .coarse = coarse, .host = host,
    .best = celd_alloc (n, sizeof *a->best),
    .link = celd_alloc (n, sizeof *a->link),
    .parent = celd_alloc (n, sizeof *a->parent),
    .divided = celd_alloc (n, 1),
    .row_count = celd_alloc ((size_t) fine->height, sizeof *a->row_count),
  };
  if (!a->best || !a->link || !a->parent || !a->divided || !a->row_count)
    return CELD_NO_MEMORY;
  memset (a->best + celd_grid_nodes (fine), 0, fine->n_extra * sizeof *a->best);
  return CELD_OK;
}

/* Each pixel is a part of its strong component. */
static CeldStatus
begin_divided (CeldWeightedGraph *pixels)
{
  uint32_t n = celd_grid_nodes (pixels);

  if (!(pixels->divided = celd_alloc (n, 1)))
    return CELD_NO_MEMORY;
  memset (pixels->divided, 1, n);
  return CELD_OK;
}

CeldStatus
celd_coarsen (CeldWeightedGraph *fine, const CeldHost *host, CeldWeightedGraph *coarse, uint32_t **coarser)
{
  CeldAggregation a;
  CeldStatus      status = aggregation_new (fine, coarse, host, &a);
  uint32_t        most;

  if (status == CELD_OK && fine->weak)
    status = begin_divided (fine);
  if (status == CELD_OK)
    status = celd_leave_out_dominant (fine, host);
  if (status != CELD_OK)
    goto done;
  most = (uint32_t) (FEWER * find_strongest (&a));
  if (celd_grid_nodes (fine) == 1 || aggregate (&a) > most)
    status = pair_up (&a, most);
  if (status != CELD_OK)
    goto done;
  coarse->row_extra = celd_alloc0 ((size_t) coarse->height + 1, sizeof *coarse->row_extra);
  status = coarse->row_extra ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_number_aggregates (&a);
  if (status == CELD_OK)
    status = celd_galerkin (fine, a.link, host, coarse);

done:
  if (status == CELD_OK)
    *coarser = a.link;
  else
    {
      celd_free (a.link);
      celd_weighted_graph_clear (coarse);
    }
  celd_free (a.best);
  celd_free (a.parent);
  celd_free (a.divided);
  celd_free (a.row_count);
  return status;
}
