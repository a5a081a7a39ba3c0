/* Pairwise aggregation in the Laplacian solver, where cells leave too many nodes.
 *
 * Few nodes are left then, of very different sizes and weights, and cells that are large enough to join many of them
 * would join too many at once.  So nodes are paired, each with the one that it moves with best, wherever that lies:
 * pairwise aggregation by quality (A. Napov and Y. Notay, "An algebraic multigrid method with guaranteed convergence
 * rate", SIAM J. Sci. Comput. 34, 2012, for pairs and plain Jacobi).  Two nodes of whole diagonals d, d', joined by an
 * edge w, with diagonals s, s' beyond their edges, have the quality
 *
 *   d d' / (d + d') / (w + s s' / (s + s')),
 *
 * the most that relaxation has to reduce of what is left between them when all other edges are left out; 2 on a plain
 * grid, 1 is best.  It bounds the condition number of the two-level method.  A node without a partner joins the
 * aggregate of its best neighbour if that one's diagonal is much larger; many may, since each moves against it alone.
 *
 * Without this the exact program takes up to 17 times as long and may miss its tolerance (bee, campfire at 0.25
 * megapixels).  Cost: O(edges) for each doubling of the worst quality.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "solve/laplace-aggregation.h"

#define GOOD  4                 /* quality of a pair at most, at first; chosen by the bench */
#define HEAVY 2                 /* times a node's whole diagonal: of a node that it may join; chosen */

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
