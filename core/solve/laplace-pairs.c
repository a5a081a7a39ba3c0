/* Aggregates of the Laplacian solver where cells do not help any more: pairs, and what hangs on them.
 *
 * Few nodes are left, of the most different sizes and weights, and cells that are large enough to join many of them
 * would join too much at once.  So the nodes pair up, each with the one that it moves with best, wherever that lies.
 *
 * Two nodes of diagonals d, d' with the edge w and the sinks s, s' are one aggregate of quality
 * d d' / (d + d') / (w + s s' / (s + s')):  the most that relaxation has to reduce what is left between them, with all
 * other edges left out; 2 on a plain grid, 1 is best.  It bounds the condition of two levels [Napov and Notay, "An
 * algebraic multigrid method with guaranteed convergence rate", SIAM J. Sci. Comput. 34, 2012; theirs for pairs, with
 * plain Jacobi].  A node that finds no partner joins the aggregate of its best neighbour if that weighs much more: many
 * may hang on one, as each moves against it alone.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "solve/laplace-graph.h"
#include "solve/laplace-private.h"

#define GOOD  4                 /* quality of a pair, at most */
#define HEAVY 2                 /* times a node's diagonal: what it may hang on */

/* All edges of each node: start[i] .. start[i + 1] - 1. */
typedef struct
{
  const CeldWeights *graph;
  uint32_t           n;
  size_t            *start;
  uint32_t          *neighbour;
  float             *weight;
  float             *diagonal;
  uint8_t           *paired;
} Links;

typedef void See (Links *links, uint32_t i, uint32_t j, float w);

/* Each edge of the graph once. */
static void
each_edge (Links *links, See *see)
{
  const CeldWeights *g = links->graph;
  uint32_t           w = (uint32_t) g->width, n = celd_weights_cells (g);

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
  links->diagonal[i] += w;
  links->diagonal[j] += w;
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
links_new (const CeldWeights *graph, Links *links)
{
  uint32_t n = celd_weights_cells (graph) + graph->n_extra;

  *links = (Links) {
    .graph = graph, .n = n,
    .start = celd_alloc0 ((size_t) n + 2, sizeof *links->start),
    .diagonal = celd_alloc (n, sizeof *links->diagonal),
    .paired = celd_alloc0 (n, 1),
  };
  if (!links->start || !links->diagonal || !links->paired)
    return CELD_NO_MEMORY;
  memcpy (links->diagonal, graph->sink, n * sizeof *links->diagonal);
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
  celd_free (links->diagonal);
  celd_free (links->paired);
}

static double
quality (const Links *links, uint32_t i, uint32_t j, float w)
{
  double d = (double) links->diagonal[i], e = (double) links->diagonal[j];
  double s = (double) links->graph->sink[i], t = (double) links->graph->sink[j];

  return d * e / (d + e) / ((double) w + (s > 0 && t > 0 ? s * t / (s + t) : 0));
}

/* May i join j: as a pair if j is free, or else where j weighs much more? */
static inline bool
may_join (const Links *links, bool pairs, uint32_t i, uint32_t j)
{
  return pairs ? !links->paired[j] : links->diagonal[j] >= HEAVY * links->diagonal[i];
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
celd_weights_pair (const CeldWeights *graph, uint32_t most, uint32_t *parent)
{
  Links      links;
  CeldStatus status = links_new (graph, &links);
  uint32_t   count = 0;

  for (uint32_t i = 0; i < links.n && status == CELD_OK; i++)
    {
      parent[i] = i;
      count += links.diagonal[i] > graph->sink[i];
    }
  for (double good = GOOD; status == CELD_OK && count > most && good < 1e12; good *= 4)
    {
      count -= join_nodes (&links, true, good, parent);
      count -= join_nodes (&links, false, good, parent);
    }
  links_clear (&links);
  return status;
}
