/* Labels of small graphs against every possible labelling and every possible expansion; what holds for any graph.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "solve/partition.h"

#define MOST_NODES  1600
#define MOST_LINKS  8000
#define MOST_VOTES  2000
#define MOST_LABELS 200

typedef struct
{
  size_t   n, n_links, n_votes, n_labels;
  CeldLink link[MOST_LINKS];
  CeldVote vote[MOST_VOTES];
  uint32_t fixed[MOST_NODES], order[MOST_LABELS];
} Problem;

typedef struct { uint32_t label[MOST_NODES]; int64_t energy, greedy; } Answer;

static CeldPartition
view (const Problem *p)
{
  return (CeldPartition) { p->n, p->link, p->n_links, p->vote, p->n_votes, p->fixed, p->order, p->n_labels };
}

static int64_t
energy_of (const Problem *p, const uint32_t *label)
{
  CeldPartition m = view (p);

  return celd_partition_energy (&m, label);
}

/* What holds for any answer. */
static void
solve (const Problem *p, Answer *answer)
{
  CeldPartition m = view (p);
  int           bad = 0;

  CHECK (celd_partition (&m, NULL, answer->label, &answer->energy, &answer->greedy) == CELD_OK);
  for (size_t k = 0; k < p->n; k++)
    bad += answer->label[k] < 1 || answer->label[k] > p->n_labels ||
           (p->fixed[k] && answer->label[k] != p->fixed[k]);
  CHECK (!bad);
  CHECK (answer->energy == energy_of (p, answer->label));
  CHECK (answer->energy <= answer->greedy);
}

/* Each pair of nodes is linked with a chance of share in 16; one node in `one_fixed` is fixed. */
static void
random_problem (uint32_t *state, size_t n, size_t n_labels, uint32_t share, uint32_t one_fixed, Problem *p)
{
  uint32_t cost = check_random (state, 2) ? 5 : 1000, vote = check_random (state, 2) ? 2 * cost : cost / 2;
  size_t   votes = check_random (state, (uint32_t) (2 * n + n_labels));

  *p = (Problem) { .n = n, .n_labels = n_labels };
  for (uint32_t i = 0; i < n; i++)
    {
      p->fixed[i] = check_random (state, one_fixed) ? 0 : 1 + check_random (state, (uint32_t) n_labels);
      for (uint32_t k = 0; k < i; k++)
        if (check_random (state, 16) < share)
          p->link[p->n_links++] = (CeldLink) { i, k, 1 + check_random (state, cost) };
    }
  while (p->n_votes < votes)
    {
      uint32_t node = check_random (state, (uint32_t) n), label = 1 + check_random (state, (uint32_t) n_labels);

      p->vote[p->n_votes++] = (CeldVote) { node, label, 1 + check_random (state, vote) };
    }
  for (size_t i = 0; i < n_labels; i++)
    {
      size_t other = check_random (state, (uint32_t) i + 1);

      p->order[i]     = p->order[other];
      p->order[other] = (uint32_t) i + 1;
    }
}

/* Over all labellings that obey the fixed nodes. */
static int64_t
least_energy (const Problem *p)
{
  uint32_t label[16];
  int64_t  least = INT64_MAX;
  size_t   k;

  for (k = 0; k < p->n; k++)
    label[k] = p->fixed[k] ? p->fixed[k] : 1;
  do
    {
      int64_t energy = energy_of (p, label);

      if (energy < least)
        least = energy;
      for (k = 0; k < p->n; k++)
        if (p->fixed[k] || label[k] == p->n_labels)
          label[k] = p->fixed[k] ? p->fixed[k] : 1;
        else
          {
            label[k]++;
            break;
          }
    }
  while (k < p->n);
  return least;
}

/* Over all labels and all sets of nodes that may take them. */
static int64_t
least_after_one_expansion (const Problem *p, const uint32_t *label)
{
  int64_t least = INT64_MAX;

  for (uint32_t alpha = 1; alpha <= p->n_labels; alpha++)
    for (uint32_t set = 0; set < UINT32_C (1) << p->n; set++)
      {
        uint32_t tried[16];
        int64_t  energy;

        for (size_t k = 0; k < p->n; k++)
          tried[k] = set >> k & 1 && !p->fixed[k] ? alpha : label[k];
        energy = energy_of (p, tried);
        if (energy < least)
          least = energy;
      }
  return least;
}

static void
small_graphs_against_every_labelling (void)
{
  static Problem p;
  Answer         a;
  uint32_t       state = 2, better = 0, best = 0, rounds = 600;

  for (uint32_t i = 0; i < rounds; i++)
    {
      size_t  n_labels = 1 + i % 4, n = 1 + check_random (&state, n_labels < 4 ? 8 : 6);
      int64_t least;

      random_problem (&state, n, n_labels, 2 + i % 14, i % 3 ? 6 : 100, &p);
      solve (&p, &a);
      least = least_energy (&p);
      if (n_labels < 3)
        CHECK (a.greedy == least);
      CHECK (a.energy >= least && a.energy <= 2 * least);
      better += a.energy < a.greedy;
      best   += a.energy == least;
    }
  CHECK (better > 10); /* or expansion is not tried here at all */
  CHECK (best > rounds * 9 / 10);
}

/* What a node costs in the cut of order[i] from the labels after it: on the side of order[i] or on the other. */
static int64_t
cost_of_side (const Problem *p, size_t i, uint32_t label, int64_t cost, bool first)
{
  size_t rank = 0;

  while (p->order[rank] != label)
    rank++;
  return (rank == i && !first) || (rank > i && first) ? cost : 0;
}

static int64_t
cost_of_cut (const Problem *p, size_t i, const uint32_t *label, uint32_t set)
{
  int64_t sum = 0;

  for (size_t k = 0; k < p->n_links; k++)
    {
      uint32_t a = p->link[k].a, b = p->link[k].b;

      if (!label[a] && !label[b])
        sum += (set >> a & 1) != (set >> b & 1) ? p->link[k].cost : 0;
      else if (!label[a] && p->fixed[b])
        sum += cost_of_side (p, i, p->fixed[b], p->link[k].cost, set >> a & 1);
      else if (!label[b] && p->fixed[a])
        sum += cost_of_side (p, i, p->fixed[a], p->link[k].cost, set >> b & 1);
    }
  for (size_t k = 0; k < p->n_votes; k++)
    if (!label[p->vote[k].node])
      sum += cost_of_side (p, i, p->vote[k].label, p->vote[k].cost, set >> p->vote[k].node & 1);
  return sum;
}

/* One label after the other takes the smallest of the sets that are cheapest to cut off from the labels after it; no
 * shortcuts. */
static int64_t
greedy_by_definition (const Problem *p)
{
  uint32_t label[16];

  memcpy (label, p->fixed, p->n * sizeof *label);
  for (size_t i = 0; i < p->n_labels; i++)
    {
      uint32_t best = 0;
      int64_t  least = INT64_MAX;
      int      fewest = 0;

      for (uint32_t set = 0; set < UINT32_C (1) << p->n; set++)
        {
          int64_t cost = cost_of_cut (p, i, label, set);
          int     nodes = 0;

          for (size_t k = 0; k < p->n; k++)
            nodes += (int) (set >> k & 1);
          if (cost > least || (cost == least && nodes >= fewest))
            continue;
          least  = cost;
          best   = set;
          fewest = nodes;
        }
      for (size_t k = 0; k < p->n; k++)
        if (!label[k] && (best >> k & 1 || i + 1 == p->n_labels))
          label[k] = p->order[i];
    }
  return energy_of (p, label);
}

static void
cuts_are_those_of_the_definition (void)
{
  static Problem p;
  Answer         a;
  uint32_t       state = 12;

  for (uint32_t i = 0; i < 400; i++)
    {
      random_problem (&state, 1 + check_random (&state, 8), 2 + i % 5, 3 + i % 9, i % 2 ? 8 : 1000, &p);
      solve (&p, &a);
      CHECK (a.greedy == greedy_by_definition (&p));
    }
}

static void
no_expansion_lowers_the_energy (void)
{
  static Problem p;
  Answer         a;
  uint32_t       state = 4;

  for (uint32_t i = 0; i < 1500; i++)
    {
      random_problem (&state, 4 + check_random (&state, 6), 3 + i % 3, 2 + i % 9, i % 2 ? 8 : 1000, &p);
      solve (&p, &a);
      CHECK (least_after_one_expansion (&p, a.label) == a.energy);
    }
}

/* How many nodes would take alpha: the expansion as one cut of its own, with nothing known from the ones before, in
 * units of half the costs.  Nodes that are alpha or fixed are left out. */
static size_t
nodes_that_would_take (const Problem *p, const uint32_t *label, uint32_t alpha)
{
  static CeldLink link[MOST_LINKS];
  static int64_t  terminal[MOST_NODES];
  static uint8_t  side[MOST_NODES];
  size_t          n_links = 0, n = 0;

  memset (terminal, 0, sizeof terminal);
  for (size_t k = 0; k < p->n_links; k++)
    for (int turn = 0; turn < 2; turn++)
      {
        int64_t  cost = p->link[k].cost;
        uint32_t a = turn ? p->link[k].b : p->link[k].a, b = turn ? p->link[k].a : p->link[k].b;
        bool     same = label[a] == label[b];

        if (label[a] == alpha || p->fixed[a])
          continue;
        if (label[b] == alpha)
          terminal[a] += 2 * cost;
        else if (p->fixed[b])
          terminal[a] -= same ? 2 * cost : 0;
        else
          {
            terminal[a] += same ? 0 : cost;
            if (!turn)
              link[n_links++] = (CeldLink) { a, b, same ? 2 * cost : cost };
          }
      }
  for (size_t k = 0; k < p->n_votes; k++)
    {
      const CeldVote *vote = &p->vote[k];

      if (label[vote->node] == alpha || p->fixed[vote->node])
        continue;
      terminal[vote->node] += vote->label == alpha ? 2 * vote->cost : 0;
      terminal[vote->node] -= vote->label == label[vote->node] ? 2 * vote->cost : 0;
    }
  CHECK (celd_flow (p->n, link, n_links, terminal, NULL, side, NULL) == CELD_OK);
  for (size_t k = 0; k < p->n; k++)
    n += side[k];
  return n;
}

/* Graphs as they come from drawings, too large to try all expansions. */
static void
no_expansion_lowers_the_energy_of_large_graphs (void)
{
  static Problem p;
  static Answer  a;
  uint32_t       state = 6;

  for (uint32_t i = 0; i < 60; i++)
    {
      uint32_t n = 60 + 10 * i, n_labels = 3 + check_random (&state, i % 2 ? 12 : 60), taken = 0;

      random_problem (&state, n, n_labels, 0, 30, &p);
      for (uint32_t k = 1; k < n; k++)
        for (uint32_t links = 1 + check_random (&state, 4); links; links--)
          if (k >= links * links)
            p.link[p.n_links++] = (CeldLink) { k, k - links * links, 1 + check_random (&state, 50) };
      p.n_votes = 0;
      for (uint32_t k = 0; k < n; k += 1 + i % 3)
        p.vote[p.n_votes++] = (CeldVote) { k, 1 + check_random (&state, n_labels), 1 + check_random (&state, 120) };
      solve (&p, &a);
      for (uint32_t alpha = 1; alpha <= n_labels; alpha++)
        taken += (uint32_t) nodes_that_would_take (&p, a.label, alpha);
      CHECK (!taken);
    }
}

/* Two nodes that the votes for A and B hold weakly, dear to part from each other and cheap to part from the rest: cut
 * one label after the other, C stays out; expansion gives it both. */
static void
expansion_takes_what_cuts_leave (void)
{
  static Problem p = { .n = 3, .n_links = 3, .n_votes = 4, .n_labels = 3, .order = { 1, 2, 3 } };
  Answer         a;
  const CeldLink link[3] = { { 0, 1, 30 }, { 0, 2, 1 }, { 1, 2, 1 } };
  const CeldVote vote[4] = { { 0, 1, 28 }, { 1, 2, 27 }, { 0, 3, 26 }, { 1, 3, 26 } };

  memcpy (p.link, link, sizeof link);
  memcpy (p.vote, vote, sizeof vote);
  solve (&p, &a);
  CHECK (a.label[0] == 3 && a.label[1] == 3 && a.label[2] == 3);
  CHECK (a.energy == 28 + 27 && a.greedy >= a.energy);
}

static void
unreached_components_get_the_first_label (void)
{
  static Problem p = { .n = 5, .n_links = 2, .n_votes = 1, .n_labels = 3, .order = { 2, 3, 1 } };
  Answer         a;

  p.link[0] = (CeldLink) { 0, 1, 5 };
  p.link[1] = (CeldLink) { 3, 4, 5 };
  p.vote[0] = (CeldVote) { 1, 3, 1 };
  solve (&p, &a);
  CHECK (a.label[0] == 3 && a.label[1] == 3);
  CHECK (a.label[2] == 2 && a.label[3] == 2 && a.label[4] == 2);
  CHECK (a.energy == 0);
  p.fixed[4] = 1;
  solve (&p, &a);
  CHECK (a.label[2] == 2 && a.label[3] == 1 && a.label[4] == 1);
}

static void
trivial_problems_are_solved (void)
{
  static Problem p = { .n = 3, .n_links = 1, .n_votes = 1, .n_labels = 1, .order = { 1 } };
  static Problem q = { .n = 2, .n_votes = 3, .n_labels = 2, .order = { 1, 2 } };
  Answer         a;

  p.link[0] = (CeldLink) { 0, 1, 5 };
  p.vote[0] = (CeldVote) { 2, 1, 1 };
  solve (&p, &a);
  CHECK (a.label[0] == 1 && a.label[1] == 1 && a.label[2] == 1 && a.energy == 0);
  q.vote[0] = (CeldVote) { 0, 1, 4 };
  q.vote[1] = (CeldVote) { 0, 2, 3 }; /* together more than the other label has */
  q.vote[2] = (CeldVote) { 0, 2, 2 };
  solve (&q, &a);
  CHECK (a.label[0] == 2 && a.label[1] == 1 && a.energy == 4);
  q.n = q.n_votes = 0;
  solve (&q, &a);
  CHECK (a.energy == 0);
}

/* Every node is fixed, some against its vote. */
static void
fixed_nodes_keep_their_label (void)
{
  static Problem p = { .n = 3, .n_links = 2, .n_votes = 1, .n_labels = 2, .fixed = { 1, 2, 2 }, .order = { 2, 1 } };
  Answer         a;

  p.link[0] = (CeldLink) { 0, 1, 5 };
  p.link[1] = (CeldLink) { 1, 2, 7 };
  p.vote[0] = (CeldVote) { 2, 1, 11 };
  solve (&p, &a);
  CHECK (a.energy == 16 && a.greedy == 16);
}

/* A board of 6 x 6 fields with dear borders inside and cheap ones between, with so many labels that they are cut in
 * halves first. */
static void
every_field_its_own_label (void)
{
  static Problem p = { .n = 1296, .n_labels = 36 };
  static Answer  a;
  int            bad = 0;

  for (uint32_t i = 0; i < 1296; i++)
    {
      uint32_t x = i % 36, y = i / 36;

      if (x < 35)
        p.link[p.n_links++] = (CeldLink) { i, i + 1, x % 6 == 5 ? 1 : 100 };
      if (y < 35)
        p.link[p.n_links++] = (CeldLink) { i + 36, i, y % 6 == 5 ? 1 : 100 };
      if (x % 6 == 3 && y % 6 == 2)
        p.vote[p.n_votes++] = (CeldVote) { i, y / 6 * 6 + x / 6 + 1, 40 };
    }
  for (uint32_t k = 0; k < 36; k++)
    p.order[k] = k * 7 % 36 + 1;
  solve (&p, &a);
  for (uint32_t i = 0; i < 1296; i++)
    bad += a.label[i] != i / 36 / 6 * 6 + i % 36 / 6 + 1;
  CHECK (!bad);
  CHECK (a.energy == 2 * 5 * 36);
}

/* The same problem told otherwise: nodes numbered otherwise, links turned round, everything shuffled, votes in two
 * parts, all costs times `factor`. */
static void
retell (uint32_t *state, const Problem *p, int64_t factor, uint32_t *number, Problem *q)
{
  *q = (Problem) { .n = p->n, .n_labels = p->n_labels };
  memcpy (q->order, p->order, sizeof q->order);
  for (uint32_t k = 0; k < p->n; k++)
    {
      uint32_t other = check_random (state, k + 1);

      number[k]     = number[other];
      number[other] = k;
    }
  for (size_t k = 0; k < p->n; k++)
    q->fixed[number[k]] = p->fixed[k];
  for (size_t k = 0; k < p->n_links; k++)
    {
      CeldLink *other = &q->link[check_random (state, (uint32_t) k + 1)];

      q->link[q->n_links++] = *other;
      *other = (CeldLink) { number[p->link[k].b], number[p->link[k].a], factor * p->link[k].cost };
    }
  for (size_t k = p->n_votes; k--; )
    {
      CeldVote vote = { number[p->vote[k].node], p->vote[k].label, factor };

      q->vote[q->n_votes++] = vote;
      vote.cost = factor * (p->vote[k].cost - 1);
      if (vote.cost)
        q->vote[q->n_votes++] = vote;
    }
}

static void
the_order_of_input_does_not_matter (void)
{
  static Problem p, q;
  static Answer  a, b;
  uint32_t       number[MOST_NODES], state = 9;

  for (uint32_t i = 0; i < 100; i++)
    {
      int64_t factor = 1 + i % 3;
      int     bad = 0;

      random_problem (&state, 10 + i, 3 + i % 30, 4, 10, &p);
      retell (&state, &p, factor, number, &q);
      solve (&p, &a);
      solve (&q, &b);
      CHECK (b.energy == factor * a.energy && b.greedy == factor * a.greedy);
      for (size_t k = 0; k < p.n; k++)
        bad += a.label[k] != b.label[number[k]];
      CHECK (!bad);
    }
}

/* All costs together make 2^60. */
static void
largest_sum_does_not_overflow (void)
{
  static Problem p = { .n = 4, .n_links = 4, .n_votes = 3, .n_labels = 3, .order = { 3, 2, 1 } };
  const int64_t  part = INT64_C (1) << 57;
  Answer         a;

  for (uint32_t k = 0; k < 4; k++)
    p.link[k] = (CeldLink) { k, (k + 1) % 4, k ? part : 1 };
  for (uint32_t k = 0; k < 3; k++)
    p.vote[k] = (CeldVote) { k, k + 1, 2 * part - (k == 0) };
  solve (&p, &a);
  CHECK (a.label[0] == 1 && a.label[1] == 2 && a.label[2] == 3);
  CHECK (a.energy == 2 * part + 1);
}

static void
cancel_leaves_results (void)
{
  static Problem p = { .n = 2, .n_labels = 1, .order = { 1 } };
  CeldPartition  m = view (&p);
  const CeldHost host = { check_refuse, NULL, NULL };
  uint32_t       label[2] = { 7, 7 };
  int64_t        energy = 5, greedy = 6;

  CHECK (celd_partition (&m, &host, label, &energy, &greedy) == CELD_CANCELLED);
  CHECK (label[0] == 7 && label[1] == 7 && energy == 5 && greedy == 6);
}

int
main (void)
{
  RUN (small_graphs_against_every_labelling);
  RUN (cuts_are_those_of_the_definition);
  RUN (no_expansion_lowers_the_energy);
  RUN (no_expansion_lowers_the_energy_of_large_graphs);
  RUN (expansion_takes_what_cuts_leave);
  RUN (unreached_components_get_the_first_label);
  RUN (trivial_problems_are_solved);
  RUN (fixed_nodes_keep_their_label);
  RUN (every_field_its_own_label);
  RUN (the_order_of_input_does_not_matter);
  RUN (largest_sum_does_not_overflow);
  RUN (cancel_leaves_results);
  return DONE;
}
