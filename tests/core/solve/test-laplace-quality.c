/* Pairs of nodes in the Laplacian solver's graphs.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"
#include "solve/laplace-private.h"

#include <math.h>

/* A row of n nodes with these edges to the east; end with celd_weighted_graph_clear. */
static CeldWeightedGraph
row_of (int n, const float *edge)
{
  CeldWeightedGraph g = { .width = n, .height = 1 };

  g.east  = celd_alloc0 ((size_t) n, sizeof *g.east);
  g.south = celd_alloc0 ((size_t) n, sizeof *g.south);
  g.diagonal  = celd_alloc0 ((size_t) n, sizeof *g.diagonal);
  for (int i = 0; i + 1 < n; i++)
    g.east[i] = edge[i];
  return g;
}

static int
sets (uint32_t *parent, int n)
{
  int count = 0;

  for (int i = 0; i < n; i++)
    count += celd_root (parent, (uint32_t) i) == (uint32_t) i;
  return count;
}

static void
a_chain_halves (void)
{
  float             edge[9] = { 1, 1, 1, 1, 1, 1, 1, 1, 1 };
  CeldWeightedGraph g = row_of (10, edge);
  uint32_t          parent[10];

  CHECK (celd_pairwise_aggregate (&g, 6, parent) == CELD_OK);
  CHECK (sets (parent, 10) == 5);
  for (uint32_t i = 0; i < 10; i++)
    CHECK (celd_root (parent, i) == i / 2 * 2);
  celd_weighted_graph_clear (&g);
}

/* 2 - 3 is weak beside the first pair, and strong beside all else that 2 and 3 have. */
static void
weights_count_beside_what_a_node_has (void)
{
  float             edge[5] = { 1, 1e-6f, 1e-3f, 1e-6f, 1 };
  CeldWeightedGraph g = row_of (6, edge);
  uint32_t          parent[6];

  CHECK (celd_pairwise_aggregate (&g, 4, parent) == CELD_OK);
  for (uint32_t i = 0; i < 6; i++)
    CHECK (celd_root (parent, i) == i / 2 * 2);
  celd_weighted_graph_clear (&g);
}

/* Extra nodes 1 .. 8, which have an edge to node 0 alone, all join it. */
static void
nodes_round_a_hub_join_it (void)
{
  CeldWeightedGraph g = row_of (1, NULL);
  uint32_t          parent[9];

  g.n_extra   = 8;
  g.start     = celd_alloc0 (9, sizeof *g.start);
  g.neighbour = celd_alloc0 (8, sizeof *g.neighbour);
  g.weight    = celd_alloc0 (8, sizeof *g.weight);
  celd_free (g.diagonal);
  g.diagonal = celd_alloc0 (9, sizeof *g.diagonal);
  for (uint32_t k = 0; k < 8; k++)
    {
      g.start[k + 1] = k + 1;
      g.weight[k]    = k % 2 ? 1e-6f : 1;
    }
  CHECK (celd_pairwise_aggregate (&g, 5, parent) == CELD_OK);
  CHECK (sets (parent, 9) == 1);
  celd_weighted_graph_clear (&g);
}

/* Random weights over six orders of magnitude: aggregates are of a piece, no more than asked for, and never join what
 * has no edge. */
static void
aggregates_are_connected (void)
{
  enum { N = 200 };

  uint32_t seed = 7;

  for (int round = 0; round < 200; round++)
    {
      float             edge[N];
      uint32_t          parent[N], linked = 0;
      CeldWeightedGraph g;

      for (int i = 0; i < N; i++)
        edge[i] = check_random (&seed, 8) ? powf (10, -(float) check_random (&seed, 7)) : 0;
      g = row_of (N, edge);
      for (int i = 0; i < N; i++)
        {
          g.diagonal[i] = check_random (&seed, 4) ? 0 : powf (10, -(float) check_random (&seed, 7));
          linked += g.east[i] > 0 || (i && g.east[i - 1] > 0);
        }
      CHECK (celd_pairwise_aggregate (&g, linked * 6 / 10, parent) == CELD_OK);

      uint32_t count = 0;

      for (uint32_t i = 0; i < N; i++)
        {
          uint32_t root = celd_root (parent, i);

          for (uint32_t j = root; j < i; j++) /* a row: all between are joined, too */
            CHECK (celd_root (parent, j) == root && g.east[j] > 0);
          count += root == i && (g.east[i] > 0 || (i && g.east[i - 1] > 0));
        }
      CHECK (count <= linked * 6 / 10);
      celd_weighted_graph_clear (&g);
    }
}

int
main (void)
{
  RUN (a_chain_halves);
  RUN (weights_count_beside_what_a_node_has);
  RUN (nodes_round_a_hub_join_it);
  RUN (aggregates_are_connected);
  return DONE;
}
