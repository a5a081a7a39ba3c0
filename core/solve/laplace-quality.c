/* Aggregation by quality in the Laplacian solver: A. Napov and Y. Notay, "An algebraic multigrid method with guaranteed
 * convergence rate", SIAM J. Sci. Comput. 34, 2012, for pairs and plain Jacobi.
 *
 * Dominant nodes: one whose diagonal is more than twice the sum of its edge weights is solved by relaxation alone.  In
 * an aggregate it would hold the others with far more than the edge that joins them: a pixel between a fixed one and a
 * wall, say, would hold all that is behind the wall.  So it is left out of aggregation, and on coarser levels its edges
 * count for the diagonals of its neighbours: prolongation to it is zero.
 *
 * Pairs, where cells leave too many nodes: few nodes are left then, of very different sizes and weights, and cells that
 * are large enough to join many of them would join too many at once.  So nodes are paired, each with the one that it
 * moves with best, wherever that lies.  Two nodes of whole diagonals d, d', joined by an edge w, with diagonals s, s'
 * beyond their edges, have the quality
 *
 *   d d' / (d + d') / (w + s s' / (s + s')),
 *
 * the most that relaxation has to reduce of what is left between them when all other edges are left out; 2 on a plain
 * grid, 1 is best.  It bounds the condition number of the two-level method.  A node without a partner joins the
 * aggregate of its best neighbour if that one's diagonal is much larger; many may, since each moves against it alone.
 *
 * Without the first the exact program takes up to seven times as long (campfire at 1 megapixel), without the second up
 * to 17 times, and may miss its tolerance (bee, campfire at 0.25 megapixels).
 *
 * Cost: O(nodes + edges), and for pairs O(edges) for each doubling of the worst quality.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/laplace-private.h"

#define DOMINANT      2    /* times all edge weights of a node together: its diagonal dominates; chosen */
#define DOMINANT_MARK 0x80 /* top bit, for celd_next_marked */
#define GOOD          4    /* quality of a pair at most, at first; chosen by the bench */
#define HEAVY         2    /* times a node's whole diagonal: of a node that it may join; chosen */

/* ------------------------------------------------------------------ dominant nodes */

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

      mark[x] = diagonal[x] > DOMINANT * sum ? DOMINANT_MARK : 0;
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
    o->mark[i] = g->diagonal[i] > DOMINANT * sum[i] ? DOMINANT_MARK : 0;
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
  uint32_t   n = celd_grid_nodes (graph);
  Dominance  o = {
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

/* ------------------------------------------------------------------ pairs */

/* All edges of each node: start[i] .. start[i + 1] - 1. */
typedef struct
{
  const CeldWeightedGraph *graph;
  uint32_t                 n;
  size_t                  *start;
  uint32_t                *neighbour;
  float                   *weight;
  float                   *whole; /* diagonal of each node with its edges */
  uint8_t                 *paired;
} Links;

typedef void See (Links *links, uint32_t i, uint32_t j, float w);

/* Each edge of the graph once. */
static void
each_edge (Links *links, See *see)
{
  const CeldWeightedGraph *g = links->graph;
  uint32_t                 w = (uint32_t) g->width, n = celd_grid_nodes (g);

  for (uint32_t i = 0; i < n; i++)
    {
      if ((i + 1) % w && g->east[i] > 0)
        see (links, i, i + 1, g->east[i]);
      if (i + w < n && g->south[i] > 0)
        see (links, i, i + w, g->south[i]);
    }
  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      if (g->neighbour[e] < n + k && g->weight[e] > 0)
        see (links, n + k, g->neighbour[e], g->weight[e]);
}

static void
count_edge (Links *links, uint32_t i, uint32_t j, float w)
{
  links->start[i + 2]++;
  links->start[j + 2]++;
  links->whole[i] += w;
  links->whole[j] += w;
}

static void
list_edge (Links *links, uint32_t i, uint32_t j, float w)
{
  size_t at = links->start[i + 1]++, back = links->start[j + 1]++;

  links->neighbour[at]   = j;
  links->neighbour[back] = i;
  links->weight[at] = links->weight[back] = w;
}

static CeldStatus
links_new (const CeldWeightedGraph *graph, Links *links)
{
  uint32_t n = celd_grid_nodes (graph) + graph->n_extra;

  *links = (Links) {
    .graph = graph, .n = n,
    .start = celd_alloc0 ((size_t) n + 2, sizeof *links->start),
    .whole = celd_alloc (n, sizeof *links->whole),
    .paired = celd_alloc0 (n, 1),
  };
  if (!links->start || !links->whole || !links->paired)
    return CELD_NO_MEMORY;
  memcpy (links->whole, graph->diagonal, n * sizeof *links->whole);
  each_edge (links, count_edge);
  for (uint32_t i = 0; i < n; i++)
    links->start[i + 2] += links->start[i + 1];
  links->neighbour = celd_alloc (links->start[n + 1], sizeof *links->neighbour);
  links->weight    = celd_alloc (links->start[n + 1], sizeof *links->weight);
  if (!links->neighbour || !links->weight)
    return CELD_NO_MEMORY;
  each_edge (links, list_edge);
  return CELD_OK;
}

static void
links_clear (Links *links)
{
  celd_free (links->start);
  celd_free (links->neighbour);
  celd_free (links->weight);
  celd_free (links->whole);
  celd_free (links->paired);
}

static double
quality (const Links *links, uint32_t i, uint32_t j, float w)
{
  double d = (double) links->whole[i], e = (double) links->whole[j];
  double s = (double) links->graph->diagonal[i], t = (double) links->graph->diagonal[j];

  return d * e / (d + e) / ((double) w + (s > 0 && t > 0 ? s * t / (s + t) : 0));
}

/* May i join j: as a pair if j is free, or else where j weighs much more? */
static inline bool
may_join (const Links *links, bool pairs, uint32_t i, uint32_t j)
{
  return pairs ? !links->paired[j] : links->whole[j] >= HEAVY * links->whole[i];
}

/* The neighbour that makes the best aggregate with i, of quality `good` at most; i itself if there is none. */
static uint32_t
best_for (const Links *links, bool pairs, double good, uint32_t i)
{
  uint32_t best = i;

  for (size_t e = links->start[i]; e < links->start[i + 1]; e++)
    if (may_join (links, pairs, i, links->neighbour[e]))
      {
        double q = quality (links, i, links->neighbour[e], links->weight[e]);

        best = q < good ? links->neighbour[e] : best;
        good = q < good ? q : good;
      }
  return best;
}

/* Free nodes in the order of their numbers: in pairs, or each to its best neighbour's aggregate.  Returns how many
 * aggregates that makes less. */
static uint32_t
join_nodes (Links *links, bool pairs, double good, uint32_t *parent)
{
  uint32_t joined = 0;

  for (uint32_t i = 0; i < links->n; i++)
    {
      uint32_t best = links->paired[i] ? i : best_for (links, pairs, good, i);

      if (best == i)
        continue;
      celd_join (parent, i, best);
      links->paired[i] = 1;
      if (pairs)
        links->paired[best] = 1;
      joined++;
    }
  return joined;
}

CeldStatus
celd_pairwise_aggregate (const CeldWeightedGraph *graph, uint32_t most, uint32_t *parent)
{
  Links      links;
  CeldStatus status = links_new (graph, &links);
  uint32_t   count = 0;

  for (uint32_t i = 0; i < links.n && status == CELD_OK; i++)
    {
      parent[i] = i;
      count += links.whole[i] > graph->diagonal[i];
    }
  for (double good = GOOD; status == CELD_OK && count > most && good < 1e12; good *= 4)
    {
      count -= join_nodes (&links, true, good, parent);
      count -= join_nodes (&links, false, good, parent);
    }
  links_clear (&links);
  return status;
}
