/* Minimum cuts against every possible cut of tiny grids and against a textbook solver on larger ones.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/maxflow.h"

#define MOST 400

typedef struct { int width, height; int32_t east[MOST], south[MOST], terminal[MOST]; } Problem;

static Problem
random_problem (uint32_t *state, int width, int height, uint32_t capacity, uint32_t terminal, uint32_t one_in)
{
  Problem p = { .width = width, .height = height };

  for (int i = 0; i < width * height; i++)
    {
      p.east[i]  = check_random (state, 4) ? (int32_t) check_random (state, capacity) : 0;
      p.south[i] = check_random (state, 4) ? (int32_t) check_random (state, capacity) : 0;
      if (!check_random (state, one_in))
        p.terminal[i] = (int32_t) check_random (state, 2 * terminal + 1) - (int32_t) terminal;
    }
  return p;
}

/* What it costs to have just the nodes of `side` with the source. */
static int64_t
cut_value (const Problem *p, const uint8_t *side)
{
  int64_t value = 0;

  for (int i = 0; i < p->width * p->height; i++)
    {
      if (i % p->width + 1 < p->width && side[i] != side[i + 1])
        value += p->east[i];
      if (i / p->width + 1 < p->height && side[i] != side[i + p->width])
        value += p->south[i];
      if (p->terminal[i] > 0 && !side[i])
        value += p->terminal[i];
      if (p->terminal[i] < 0 && side[i])
        value -= p->terminal[i];
    }
  return value;
}

static int64_t
least_of_all_cuts (const Problem *p)
{
  int     n     = p->width * p->height;
  int64_t least = INT64_MAX;

  for (uint32_t cut = 0; cut < UINT32_C (1) << n; cut++)
    {
      uint8_t side[16];
      int64_t value;

      for (int i = 0; i < n; i++)
        side[i] = (uint8_t) (cut >> i & 1);
      value = cut_value (p, side);
      if (value < least)
        least = value;
    }
  return least;
}

/* Edmonds-Karp on a list of arcs: arc a leads from one node to to[a], a ^ 1 is its reverse. */
typedef struct { int n, to[6 * MOST + 2 * MOST]; int64_t left[8 * MOST]; int first[MOST + 2], next[8 * MOST]; } Network;

static void
add_arc (Network *g, int p, int q, int64_t forth, int64_t back)
{
  g->to[g->n] = q, g->left[g->n] = forth, g->next[g->n] = g->first[p], g->first[p] = g->n++;
  g->to[g->n] = p, g->left[g->n] = back, g->next[g->n] = g->first[q], g->first[q] = g->n++;
}

static int64_t
shortest_augmentation (Network *g, int source, int sink, int nodes)
{
  int     by[MOST + 2], queue[MOST + 2], n = 0;
  int64_t amount = INT64_MAX;

  for (int i = 0; i < nodes; i++)
    by[i] = -1;
  queue[n++] = source;
  for (int i = 0; i < n && by[sink] < 0; i++)
    for (int a = g->first[queue[i]]; a >= 0; a = g->next[a])
      if (g->left[a] > 0 && g->to[a] != source && by[g->to[a]] < 0)
        by[g->to[a]] = a, queue[n++] = g->to[a];
  if (by[sink] < 0)
    return 0;
  for (int q = sink; q != source; q = g->to[by[q] ^ 1])
    if (g->left[by[q]] < amount)
      amount = g->left[by[q]];
  for (int q = sink; q != source; q = g->to[by[q] ^ 1])
    g->left[by[q]] -= amount, g->left[by[q] ^ 1] += amount;
  return amount;
}

static int64_t
textbook_flow (const Problem *p)
{
  static Network g;
  int            n = p->width * p->height;
  int64_t        flow = 0, more;

  g.n = 0;
  for (int i = 0; i < n + 2; i++)
    g.first[i] = -1;
  for (int i = 0; i < n; i++)
    {
      if (i % p->width + 1 < p->width)
        add_arc (&g, i, i + 1, p->east[i], p->east[i]);
      if (i / p->width + 1 < p->height)
        add_arc (&g, i, i + p->width, p->south[i], p->south[i]);
      if (p->terminal[i] > 0)
        add_arc (&g, n, i, p->terminal[i], 0);
      if (p->terminal[i] < 0)
        add_arc (&g, i, n + 1, -p->terminal[i], 0);
    }
  while ((more = shortest_augmentation (&g, n, n + 1, n + 2)) > 0)
    flow += more;
  return flow;
}

/* The flow is the value of the cut, and of the one looked for. */
static void
check_cut (const Problem *p, int64_t wanted)
{
  uint8_t side[MOST];
  int64_t flow = -1;

  CHECK (celd_maxflow (p->width, p->height, p->east, p->south, p->terminal, NULL, side, &flow) == CELD_OK);
  CHECK (flow == wanted);
  CHECK (cut_value (p, side) == flow);
}

static void
tiny_grids_against_every_cut (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 7 }, { 8, 1 }, { 2, 2 }, { 3, 3 }, { 4, 3 }, { 2, 6 }, { 5, 2 } };
  uint32_t         state = 1;

  for (int i = 0; i < 400; i++)
    {
      const int *s = size[i % 8];
      Problem    p = random_problem (&state, s[0], s[1], i % 3 ? 4 : 1000, i % 5 ? 10 : 3000, 1 + (uint32_t) i % 4);

      check_cut (&p, least_of_all_cuts (&p));
    }
}

static void
larger_grids_against_the_textbook (void)
{
  uint32_t state = 7;

  for (int i = 0; i < 60; i++)
    {
      Problem p = random_problem (&state, 20, 20, i % 2 ? 3 : 5000, i % 3 ? 40 : 20000, 2 + 8 * ((uint32_t) i % 3));

      check_cut (&p, textbook_flow (&p));
    }
}

/* A row of nodes between source and sink: the cut is at the weakest edge, and of two weakest at the first. */
static void
source_side_is_the_smallest (void)
{
  const int32_t east[6] = { 9, 4, 7, 4, 9, 0 }, south[6] = { 0 }, terminal[6] = { 50, 0, 0, 0, 0, -50 };
  uint8_t       side[6];
  int64_t       flow;

  CHECK (celd_maxflow (6, 1, east, south, terminal, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 4);
  CHECK (side[0] && side[1] && !side[2] && !side[3] && !side[4] && !side[5]);
}

static void
no_terminal_no_source_side (void)
{
  const int32_t capacity[4] = { 5, 5, 5, 5 }, terminal[4] = { 0 }, sinks[4] = { 0, -3, 0, 0 };
  uint8_t       side[4] = { 9, 9, 9, 9 };
  int64_t       flow = 9;

  CHECK (celd_maxflow (2, 2, capacity, capacity, terminal, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 0 && !side[0] && !side[1] && !side[2] && !side[3]);
  CHECK (celd_maxflow (2, 2, capacity, capacity, sinks, NULL, side, NULL) == CELD_OK);
  CHECK (!side[0] && !side[1] && !side[2] && !side[3]);
}

static void
largest_capacities_do_not_overflow (void)
{
  const int32_t most = (1 << 30) - 1, capacity[4] = { most, most, most, most };
  const int32_t terminal[4] = { most, most, -most, -most };
  uint8_t       side[4];
  int64_t       flow;

  CHECK (celd_maxflow (2, 2, capacity, capacity, terminal, NULL, side, &flow) == CELD_OK);
  CHECK (flow == 2 * (int64_t) most);
}

static void
cancel_and_bad_sizes_leave_results (void)
{
  const int32_t  capacity[4] = { 5, 5, 5, 5 }, terminal[4] = { 1, 0, 0, -1 };
  const CeldHost host = { check_refuse, NULL, NULL };
  uint8_t        side[4] = { 9, 9, 9, 9 };
  int64_t        flow = 77;

  CHECK (celd_maxflow (2, 2, capacity, capacity, terminal, &host, side, &flow) == CELD_CANCELLED);
  CHECK (celd_maxflow (0, 2, capacity, capacity, terminal, NULL, side, &flow) == CELD_BAD_SIZE);
  CHECK (celd_maxflow (2, CELD_MAX_SIDE + 1, capacity, capacity, terminal, NULL, side, &flow) == CELD_BAD_SIZE);
  CHECK (side[0] == 9 && side[3] == 9 && flow == 77);
}

int
main (void)
{
  RUN (tiny_grids_against_every_cut);
  RUN (larger_grids_against_the_textbook);
  RUN (source_side_is_the_smallest);
  RUN (no_terminal_no_source_side);
  RUN (largest_capacities_do_not_overflow);
  RUN (cancel_and_bad_sizes_leave_results);
  return DONE;
}
