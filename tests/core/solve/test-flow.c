/* Minimum cuts of graphs of any shape against every possible cut, and against the solver for grids.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#define MOST_NODES 2500
#define MOST_LINKS 8000

typedef struct
{
  size_t   n, n_links;
  CeldLink link[MOST_LINKS];
  int64_t  terminal[MOST_NODES];
} Problem;

static CeldStatus
solve (const Problem *p, const CeldHost *host, uint8_t *side, int64_t *flow)
{
  return celd_flow (p->n, p->link, p->n_links, p->terminal, host, side, flow);
}

/* Each pair of nodes is linked with a chance of share in 16. */
static void
random_problem (uint32_t *state, size_t n, uint32_t share, uint32_t cost, uint32_t terminal, Problem *p)
{
  p->n       = n;
  p->n_links = 0;
  for (uint32_t i = 0; i < n; i++)
    {
      p->terminal[i] = check_random (state, 3) ? (int64_t) check_random (state, 2 * terminal + 1) - terminal : 0;
      for (uint32_t k = 0; k < i; k++)
        if (check_random (state, 16) < share)
          p->link[p->n_links++] = (CeldLink) { i, k, 1 + check_random (state, cost) };
    }
}

/* What it costs to have just the nodes of `side` with the source. */
static int64_t
cut_value (const Problem *p, const uint8_t *side)
{
  int64_t value = 0;

  for (size_t k = 0; k < p->n_links; k++)
    value += side[p->link[k].a] != side[p->link[k].b] ? p->link[k].cost : 0;
  for (size_t i = 0; i < p->n; i++)
    value += p->terminal[i] > 0 && !side[i] ? p->terminal[i] : p->terminal[i] < 0 && side[i] ? -p->terminal[i] : 0;
  return value;
}

/* The least cut, and of several the one with the fewest nodes on the source side: minimum cuts are closed under
 * intersection, so there is one that lies in all others. */
static int64_t
best_of_all_cuts (const Problem *p, uint8_t *best)
{
  int64_t least = INT64_MAX;
  size_t  fewest = 0;

  for (uint32_t cut = 0; cut < UINT32_C (1) << p->n; cut++)
    {
      uint8_t side[16];
      size_t  nodes = 0;
      int64_t value;

      for (size_t i = 0; i < p->n; i++)
        nodes += side[i] = (uint8_t) (cut >> i & 1);
      value = cut_value (p, side);
      if (value > least || (value == least && nodes >= fewest))
        continue;
      least  = value;
      fewest = nodes;
      memcpy (best, side, p->n);
    }
  return least;
}

static void
small_graphs_against_every_cut (void)
{
  static Problem p;
  uint32_t       state = 3;

  for (uint32_t i = 0; i < 600; i++)
    {
      uint8_t side[16] = { 0 }, best[16] = { 0 };
      int64_t flow = -1, least;

      random_problem (&state, 1 + i % 13 + (i % 200 == 0), 1 + i % 15, i % 3 ? 4 : 1000, i % 5 ? 10 : 2000, &p);
      least = best_of_all_cuts (&p, best);
      CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
      CHECK (flow == least);
      CHECK (cut_value (&p, side) == flow);
      CHECK (!memcmp (side, best, p.n));
    }
}

/* A grid is a graph: the same flow and the same side as from celd_maxflow, whose source side is the smallest, too. */
static void
grids_against_the_grid_solver (void)
{
  static Problem p;
  static int32_t east[MOST_NODES], south[MOST_NODES], terminal[MOST_NODES];
  static uint8_t side[MOST_NODES], wanted[MOST_NODES];
  uint32_t       state = 5;

  for (uint32_t round = 0; round < 60; round++)
    {
      int     w = 5 + (int) check_random (&state, 45), h = 5 + (int) check_random (&state, 45), n = w * h;
      int64_t flow = -1, wanted_flow = -2;

      p.n       = (size_t) n;
      p.n_links = 0;
      for (int i = 0; i < n; i++)
        {
          east[i]     = (int32_t) check_random (&state, round % 2 ? 3 : 2000);
          south[i]    = (int32_t) check_random (&state, round % 2 ? 3 : 2000);
          terminal[i] = check_random (&state, 2 + round) ? 0 : (int32_t) check_random (&state, 20001) - 10000;
          p.terminal[i] = terminal[i];
          if (i % w + 1 < w && east[i])
            p.link[p.n_links++] = (CeldLink) { (uint32_t) i, (uint32_t) (i + 1), east[i] };
          if (i / w + 1 < h && south[i])
            p.link[p.n_links++] = (CeldLink) { (uint32_t) (i + w), (uint32_t) i, south[i] };
        }
      CHECK (celd_maxflow (w, h, east, south, terminal, NULL, wanted, &wanted_flow) == CELD_OK);
      CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
      CHECK (flow == wanted_flow);
      CHECK (!memcmp (side, wanted, p.n));
    }
}

/* Graphs too large to try every cut: flow and cut are equal, so that both are best. */
static void
flow_equals_cut (void)
{
  static Problem p;
  static uint8_t side[MOST_NODES];
  uint32_t       state = 8;

  for (uint32_t i = 0; i < 40; i++)
    {
      int64_t flow = -1;

      random_problem (&state, 60 + i, 1 + i % 3, 1 + 100 * (i % 4), 40 + 300 * (i % 5), &p);
      CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
      CHECK (cut_value (&p, side) == flow);
    }
}

/* A star, which makes its middle a node with very many arcs, between a chain to the source and one to the sink. */
static void
hubs_and_chains (void)
{
  static Problem p = { .n = 2201 };
  static uint8_t side[MOST_NODES];
  int64_t        flow;

  for (uint32_t i = 0; i < 1000; i++)
    p.link[p.n_links++] = (CeldLink) { 0, 1 + i, 3 };
  for (uint32_t i = 0; i < 1200; i++)
    p.link[p.n_links++] = (CeldLink) { i ? 1000 + i : 0, 1001 + i, i == 700 ? 800 : 5000 };
  for (uint32_t i = 0; i < 1000; i++)
    p.terminal[1 + i] = 1;
  p.terminal[2200] = -9000;
  CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 800);
  CHECK (side[0] && side[1000] && side[1700] && !side[1701] && !side[2200]);
}

static void
source_side_is_the_smallest (void)
{
  static Problem p = {
    6, 5, { { 0, 1, 9 }, { 2, 1, 4 }, { 2, 3, 7 }, { 3, 4, 4 }, { 5, 4, 9 } }, { 50, 0, 0, 0, 0, -50 }
  };
  uint8_t        side[6];
  int64_t        flow;

  CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 4);
  CHECK (side[0] && side[1] && !side[2] && !side[3] && !side[4] && !side[5]);
}

static void
no_terminals_no_links_no_nodes (void)
{
  static Problem p = { 3, 1, { { 0, 1, 9 } }, { 0 } };
  uint8_t        side[3] = { 9, 9, 9 };
  int64_t        flow = 9;

  CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 0 && !side[0] && !side[1] && !side[2]);
  p.terminal[1] = 4;
  p.terminal[2] = -4;
  CHECK (solve (&p, NULL, side, NULL) == CELD_OK);
  CHECK (side[0] && side[1] && !side[2]);
  CHECK (celd_flow (0, NULL, 0, NULL, NULL, NULL, &flow) == CELD_OK && flow == 0);
}

/* All costs and terminals together make 2^60. */
static void
largest_sum_does_not_overflow (void)
{
  const int64_t  most = INT64_C (1) << 60;
  static Problem p = { 3, 2, { { 0, 1, 0 }, { 2, 1, 0 } }, { 0 } };
  uint8_t        side[3];
  int64_t        flow;

  p.link[0].cost = p.link[1].cost = most / 4;
  p.terminal[0]  = most / 4;
  p.terminal[2]  = -most / 4;
  CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
  CHECK (flow == most / 4 && !side[0] && !side[1] && !side[2]);
  p.link[0].cost = most - 2;
  p.link[1].cost = p.terminal[0] = 1;
  p.terminal[2]  = 0;
  CHECK (solve (&p, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 0 && side[0] && side[1] && side[2]);
}

static void
cancel_leaves_results (void)
{
  static Problem p = { 2, 1, { { 0, 1, 5 } }, { 1, -1 } };
  const CeldHost host = { check_refuse, NULL, NULL };
  uint8_t        side[2] = { 9, 9 };
  int64_t        flow = 77;

  CHECK (solve (&p, &host, side, &flow) == CELD_CANCELLED);
  CHECK (side[0] == 9 && side[1] == 9 && flow == 77);
}

int
main (void)
{
  RUN (small_graphs_against_every_cut);
  RUN (grids_against_the_grid_solver);
  RUN (flow_equals_cut);
  RUN (hubs_and_chains);
  RUN (source_side_is_the_smallest);
  RUN (no_terminals_no_links_no_nodes);
  RUN (largest_sum_does_not_overflow);
  RUN (cancel_leaves_results);
  return DONE;
}
