/* Which relations can hold together (section 3.2: a consistent order exists if there is no oriented loop).
 *
 * Only relations of knots (knots.c) can contradict others.  They are tried by falling weight, then in the order given.
 * One is left out if those kept before it already lead from its farther to its nearer side; an equality, if they lead
 * through an inequality from one of its labels to another (sequence.c tells).  The shortest such path (breadth first)
 * with the relation itself is the cycle that the artist gets to see, equalities that carry it included.  Greedy, so not
 * always the least weight left out, but easy to foresee: a heavier arrow never yields to lighter ones.  For the
 * least weight in sum feedback-arc-set.c chooses what is tried last.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#include <stdlib.h>

#define BETWEEN_STEPS 256 /* relations between two reports of progress */

/* A relation to be tried: by rising round, falling weight, and in the order given. */
typedef struct { int round; double weight; size_t relation; } Candidate;

/* One more cycle, the one that a search has found. */
static CeldStatus
add_cycle (const CeldSearch *s, size_t knot, CeldOrder *order)
{
  CeldCycle *cycles = celd_grow (order->cycle, order->n_cycles + 1, sizeof *cycles);
  CeldStatus status;

  if (!cycles)
    return CELD_NO_MEMORY;
  order->cycle = cycles;
  status = celd_search_cycle (s, &cycles[order->n_cycles]);
  if (status == CELD_OK)
    cycles[order->n_cycles++].knot = knot;
  return status;
}

/* The background goes behind every label that it is neither in front of nor equal to.  With several background labels
 * (separate regions of its colour), those behind one of them are left as they are, so that no cycle can close. */
static CeldStatus
complete_background (CeldGraph *g, CeldSearch *s)
{
  size_t    *f      = &g->first[2 * (g->n_links - 1)];
  CeldIndex  down;
  CeldStatus status;

  if (f[0] == f[1])
    return CELD_OK;
  status = celd_graph_index (g, CELD_NEARER, g->kept, &down);
  if (status != CELD_OK)
    return status;
  s->ways[CELD_FARTHER] = celd_index_ways (&down);
  celd_search_behind (s, f[0], f[1]);
  celd_index_clear (&down);
  for (size_t k = 0; k < g->n_labels && status == CELD_OK; k++)
    if (!celd_search_was_at (s, k))
      status = celd_graph_add (g, (uint32_t) k + 1);
  f[2] = g->n_ends;
  g->kept[g->n_links - 1] = true;
  return status;
}

/* By falling weight, then in the order given, each round by itself. */
static int
compare_turns (const void *one, const void *two)
{
  const Candidate *a = one, *b = two;

  if (a->round != b->round)
    return a->round < b->round ? -1 : 1;
  if (a->weight != b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

/* All relations of knots in the order in which they are tried; none of them counts yet. */
static size_t
take_turns (CeldGraph *g, const CeldKnots *knots, Candidate *turns)
{
  size_t n = 0;

  for (size_t i = 0; i < g->relations->n; i++)
    if (g->kept[i] && knots->link[i])
      {
        double weight = g->relations->item[i].weight;

        g->kept[i] = false;
        turns[n++] = (Candidate) { 0, weight > 0 ? weight : 0, i }; /* NaN has no place in a sort */
      }
  qsort (turns, n, sizeof *turns, compare_turns);
  return n;
}

static bool
is_suggestion (const CeldGraph *g, size_t link)
{
  return g->relations->item[link].source == CELD_SOURCE_SUGGESTION;
}

/* Marks a set of the least total weight whose removal breaks all cycles; in knots too large for that it marks nothing,
 * and relations are tried by weight alone. */
static CeldStatus
find_lightest (const CeldGraph *g, const CeldKnots *knots, const CeldKnot *knot, const CeldHost *host, bool *broken)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < knots->n && status == CELD_OK; k++)
    {
      status = celd_feedback_arc_set (g, knots, &knot[k], (uint32_t) k + 1, broken);
      if (status == CELD_OK)
        status = celd_progress (host, (double) (k + 1) / (double) knots->n);
    }
  return status;
}

/* Lets relations that are best left out be tried after the others, and suggestions after them. */
static CeldStatus
put_off (CeldGraph *g, const CeldKnots *knots, const CeldHost *host, const CeldKnot *knot, Candidate *turns, size_t n)
{
  bool      *broken = celd_alloc0 (g->n_links, sizeof *broken);
  CeldStatus status = broken ? find_lightest (g, knots, knot, host, broken) : CELD_NO_MEMORY;

  for (size_t t = 0; t < n && status == CELD_OK; t++)
    turns[t].round = is_suggestion (g, turns[t].relation) ? 2 : broken[turns[t].relation];
  if (status == CELD_OK)
    qsort (turns, n, sizeof *turns, compare_turns);
  celd_free (broken);
  return status;
}

/* Keeps relations by turns as long as they contradict nothing. */
static CeldStatus
try_turns (CeldGraph *g, const CeldKnots *knots, const Candidate *turns, size_t n, const CeldHost *host,
           CeldSearch *search, CeldOrder *order)
{
  CeldSequence sequence;
  CeldStatus   status = celd_sequence_new (g, &sequence);

  search->sequence = &sequence;
  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    search->ways[to] = celd_sequence_ways (&sequence, (CeldSide) to);
  for (size_t t = 0; t < n && status == CELD_OK; t++)
    {
      size_t i = turns[t].relation;

      g->kept[i] = celd_sequence_admit (&sequence, i);
      if (!g->kept[i] && celd_search_contradiction (search, i))
        status = add_cycle (search, knots->link[i] - 1, order);
      if (status == CELD_OK && t % BETWEEN_STEPS == 0)
        status = celd_progress (host, (double) t / (double) n);
    }
  search->sequence = NULL;
  celd_sequence_clear (&sequence);
  return status;
}

/* Frees the graph from contradictions. */
static CeldStatus
break_knots (CeldGraph *g, const CeldKnots *knots, CeldOnCycle on_cycle, const CeldHost *host,
             CeldSearch *search, CeldOrder *order)
{
  CeldHostPart   part[2];
  CeldHost   choose = celd_host_part (&part[0], host, 0, 0.5);
  CeldHost   try = celd_host_part (&part[1], host, on_cycle == CELD_ON_CYCLE_REPORT ? 0 : 0.5, 1);
  Candidate  *turns = celd_alloc (g->n_links, sizeof *turns);
  size_t     n = turns ? take_turns (g, knots, turns) : 0;
  CeldStatus status = turns ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && on_cycle != CELD_ON_CYCLE_REPORT)
    status = put_off (g, knots, &choose, order->knot, turns, n);
  if (status == CELD_OK)
    status = try_turns (g, knots, turns, n, &try, search, order);
  celd_free (turns);
  return status;
}

/* The shortest cycle through the newest relation of a knot that has one. */
static CeldStatus
find_newest_cycle (CeldSearch *s, CeldKnot *knot)
{
  CeldStatus status = CELD_OK;

  for (size_t k = knot->n; k-- > 0 && !knot->newest.n && status == CELD_OK; )
    {
      s->except = knot->item[k];
      if (celd_search_contradiction (s, knot->item[k]) && celd_search_is_simple (s))
        status = celd_search_cycle (s, &knot->newest);
    }
  s->except = CELD_NO_INDEX;
  return status;
}

/* The same for all knots: no path leads from one to another and back. */
static CeldStatus
find_newest_cycles (CeldSearch *s, const bool *use, CeldOrder *order)
{
  CeldIndex  index[2] = { { 0 } };
  CeldStatus status = celd_graph_index (s->graph, CELD_NEARER, use, &index[CELD_FARTHER]);

  if (status == CELD_OK)
    status = celd_graph_index (s->graph, CELD_FARTHER, use, &index[CELD_NEARER]);
  for (int to = CELD_FARTHER; to <= CELD_NEARER && status == CELD_OK; to++)
    s->ways[to] = celd_index_ways (&index[to]);
  for (size_t k = 0; k < order->n_knots && status == CELD_OK; k++)
    status = find_newest_cycle (s, &order->knot[k]);
  celd_index_clear (&index[CELD_FARTHER]);
  celd_index_clear (&index[CELD_NEARER]);
  return status;
}

/* The relations of each knot, and its newest cycle. */
static CeldStatus
describe_knots (CeldSearch *s, const CeldKnots *knots, CeldOrder *order)
{
  size_t     n_links = s->graph->n_links;
  bool      *use = celd_alloc0 (n_links, sizeof *use);
  CeldStatus status = use ? CELD_OK : CELD_NO_MEMORY;

  order->knot = celd_alloc0 (knots->n, sizeof *order->knot);
  order->n_knots = order->knot ? knots->n : 0;
  if (!order->knot)
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < n_links && status == CELD_OK; i++)
    if (knots->link[i])
      {
        CeldKnot *knot = &order->knot[knots->link[i] - 1];
        size_t   *item = celd_grow (knot->item, knot->n + 1, sizeof *item);

        if (!item)
          status = CELD_NO_MEMORY;
        else
          {
            knot->item = item;
            item[knot->n++] = i;
            use[i] = true;
          }
      }
  if (status == CELD_OK)
    status = find_newest_cycles (s, use, order);
  celd_free (use);
  return status;
}

CeldStatus
celd_graph_settle (CeldGraph *g, CeldOnCycle on_cycle, const CeldHost *host, CeldOrder *order)
{
  CeldSearch search;
  CeldKnots  knots = { 0 };
  CeldStatus status = celd_search_new (g, &search);

  if (status == CELD_OK)
    status = celd_knots_find (g, &knots);
  if (status == CELD_OK && knots.n)
    status = describe_knots (&search, &knots, order);
  if (status == CELD_OK && knots.n)
    status = break_knots (g, &knots, on_cycle, host, &search, order);
  if (status == CELD_OK)
    status = complete_background (g, &search);
  celd_knots_clear (&knots);
  celd_search_clear (&search);
  return status;
}
