/* Which relations can hold together (section 3.2: a consistent order exists if there is no oriented loop).
 *
 * Only relations of knots (knots.c) can contradict others.  They are tried by falling weight, then in the order given.
 * One is left out if those kept before it already lead from its farther to its nearer side; an equality, if they lead
 * through an inequality from one of its labels to another (sequence.c tells).  The shortest such path (breadth first)
 * with the relation itself is the cycle that the artist gets to see, equalities that carry it included.  Greedy, so not
 * always the least weight left out, but easy to foresee: a heavier arrow never yields to lighter ones.  For the least,
 * feedback.c chooses what is tried last.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order.h"

#include <stdlib.h>

#define BETWEEN_STEPS 256 /* relations between two reports of progress */
#define NOWHERE SIZE_MAX

/* A search walks labels and links by turns.  Its states are 2 x node + strict: node k < n_labels is a label, node
 * n_labels + i is link i, strict says whether an inequality came before. */
typedef struct
{
  const CeldGraph *graph;
  CeldIndex        down;   /* links that lead down from a label */
  const bool      *use;    /* links that a search may take */
  CeldSequence    *sequence; /* NULL: labels may stand anywhere; else not before the place `floor` */
  uint32_t         floor;
  size_t          *queue;
  size_t           n_queue;
  size_t          *from;   /* the state before; NOWHERE at a start */
  size_t          *seen;   /* number of the search that saw a state last */
  size_t          *goal;   /* of label k: number of the search that looks for it */
  size_t           number; /* of this search, from 1 */
} Search;

static void
search_end (Search *s)
{
  celd_free (s->down.first);
  celd_free (s->down.link);
  celd_free (s->queue);
  celd_free (s->from);
  celd_free (s->seen);
  celd_free (s->goal);
  *s = (Search) { 0 };
}

/* Also after a failure search_end is to follow. */
static CeldStatus
search_new (const CeldGraph *graph, Search *s)
{
  size_t states = 2 * (graph->n_labels + graph->n_links);

  *s = (Search) {
    .graph = graph, .use = graph->kept,
    .queue = celd_alloc (states, sizeof (size_t)), .from = celd_alloc (states, sizeof (size_t)),
    .seen = celd_alloc0 (states, sizeof (size_t)), .goal = celd_alloc0 (graph->n_labels, sizeof (size_t)),
  };
  return s->queue && s->from && s->seen && s->goal ? celd_graph_index (graph, CELD_NEARER, &s->down) : CELD_NO_MEMORY;
}

static void
search_begin (Search *s)
{
  s->number++;
  s->n_queue = 0;
}

static void
visit (Search *s, size_t node, size_t strict, size_t from)
{
  size_t state = 2 * node + strict;

  if (s->seen[state] == s->number)
    return;
  s->seen[state]         = s->number;
  s->from[state]         = from;
  s->queue[s->n_queue++] = state;
}

/* Goes down from what was visited until a goal is reached behind an inequality; its state, or NOWHERE. */
static size_t
descend (Search *s)
{
  const CeldGraph *g = s->graph;

  for (size_t i = 0; i < s->n_queue; i++)
    {
      size_t state = s->queue[i], node = state / 2, strict = state % 2;

      if (node < g->n_labels)
        {
          if (strict && s->goal[node] == s->number)
            return state;
          if (s->sequence && s->sequence->place[celd_class_of (&s->sequence->classes, (uint32_t) node)] < s->floor)
            continue;
          for (size_t j = s->down.first[node]; j < s->down.first[node + 1]; j++)
            if (s->use[s->down.link[j]])
              visit (s, g->n_labels + s->down.link[j], strict || !celd_graph_equal (g, s->down.link[j]), state);
        }
      else
        {
          size_t        link = node - g->n_labels;
          const size_t *f    = &g->first[2 * link];

          for (size_t e = f[0]; e < (celd_graph_equal (g, link) ? f[2] : f[1]); e++)
            visit (s, g->end[e], strict, state);
        }
    }
  return NOWHERE;
}

/* The end of a path of relations in use that relation i contradicts, or NOWHERE. */
static size_t
contradicting_path (Search *s, size_t i)
{
  const CeldGraph *g     = s->graph;
  const size_t    *f     = &g->first[2 * i];
  bool             equal = celd_graph_equal (g, i);

  search_begin (s);
  s->floor = UINT32_MAX;
  for (size_t e = equal ? f[0] : f[1]; e < f[2]; e++)
    {
      uint32_t place = s->sequence ? s->sequence->place[celd_class_of (&s->sequence->classes, g->end[e])] : 0;

      s->floor = place < s->floor ? place : s->floor;
      s->goal[g->end[e]] = s->number;
    }
  for (size_t e = f[0]; e < (equal ? f[2] : f[1]); e++)
    visit (s, g->end[e], !equal, NOWHERE);
  return descend (s);
}

/* Relation i and the links of the path that ends in `state`. */
static CeldStatus
read_cycle (const Search *s, size_t i, size_t state, CeldCycle *cycle)
{
  size_t n_labels = s->graph->n_labels, n = 1;

  for (size_t t = state; t != NOWHERE; t = s->from[t])
    n += t / 2 >= n_labels;
  *cycle = (CeldCycle) { .item = celd_alloc (n, sizeof (size_t)) };
  if (!cycle->item)
    return CELD_NO_MEMORY;
  cycle->n = n;
  for (size_t t = state; t != NOWHERE; t = s->from[t])
    if (t / 2 >= n_labels)
      cycle->item[--n] = t / 2 - n_labels;
  cycle->item[0] = i;
  return CELD_OK;
}

/* One more cycle: of relation i, by the path that ends in `state`. */
static CeldStatus
add_cycle (const Search *s, size_t i, size_t state, size_t knot, CeldOrder *order)
{
  CeldCycle *cycles = celd_grow (order->cycle, order->n_cycles + 1, sizeof *cycles);
  CeldStatus status;

  if (!cycles)
    return CELD_NO_MEMORY;
  order->cycle = cycles;
  status = read_cycle (s, i, state, &cycles[order->n_cycles]);
  if (status == CELD_OK)
    cycles[order->n_cycles++].knot = knot;
  return status;
}

/* The background goes behind every label that it is neither in front of nor equal to.  With several background labels
 * (separate regions of its colour), those behind one of them are left as they are, so that no cycle can close. */
static CeldStatus
complete_background (CeldGraph *g, Search *s)
{
  size_t    *f      = &g->first[2 * (g->n_links - 1)];
  CeldStatus status = CELD_OK;

  if (f[0] == f[1])
    return CELD_OK;
  search_begin (s);
  for (size_t e = f[0]; e < f[1]; e++)
    visit (s, g->end[e], 0, NOWHERE);
  descend (s);
  for (size_t k = 0; k < g->n_labels && status == CELD_OK; k++)
    if (s->seen[2 * k] != s->number && s->seen[2 * k + 1] != s->number)
      status = celd_graph_add (g, (uint32_t) k + 1);
  f[2] = g->n_ends;
  g->kept[g->n_links - 1] = true;
  return status;
}

/* By falling weight, then in the order given, each round by itself. */
static int
compare_turns (const void *one, const void *two)
{
  const CeldTurn *a = one, *b = two;

  if (a->round != b->round)
    return a->round < b->round ? -1 : 1;
  if (a->weight != b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

/* All relations of knots in the order in which they are tried; none of them counts yet. */
static size_t
take_turns (CeldGraph *g, const CeldKnots *knots, CeldTurn *turns)
{
  size_t n = 0;

  for (size_t i = 0; i < g->relations->n; i++)
    if (g->kept[i] && knots->link[i])
      {
        double weight = g->relations->item[i].weight;

        g->kept[i] = false;
        turns[n++] = (CeldTurn) { 0, weight > 0 ? weight : 0, i }; /* NaN has no place in a sort */
      }
  qsort (turns, n, sizeof *turns, compare_turns);
  return n;
}

static bool
is_suggestion (const CeldGraph *g, size_t link)
{
  return g->relations->item[link].source == CELD_SOURCE_SUGGESTION;
}

/* Has those relations tried last that feedback.c chooses, and behind them suggestions. */
static CeldStatus
put_off (CeldGraph *g, const CeldKnots *knots, const CeldRun *run, const CeldKnot *knot, CeldTurn *turns, size_t n)
{
  bool      *broken = celd_alloc0 (g->n_links, sizeof *broken);
  CeldStatus status = broken ? celd_feedback (g, knots, knot, turns, n, run, broken) : CELD_NO_MEMORY;

  for (size_t t = 0; t < n && status == CELD_OK; t++)
    turns[t].round = is_suggestion (g, turns[t].relation) ? 2 : broken[turns[t].relation];
  if (status == CELD_OK)
    qsort (turns, n, sizeof *turns, compare_turns);
  celd_free (broken);
  return status;
}

/* Keeps relations by turns as long as they contradict nothing. */
static CeldStatus
try_turns (CeldGraph *g, const CeldKnots *knots, const CeldTurn *turns, size_t n, const CeldRun *run, Search *search,
           CeldOrder *order)
{
  CeldSequence sequence;
  CeldStatus   status = celd_sequence_new (g, &sequence);

  search->sequence = &sequence;
  for (size_t t = 0; t < n && status == CELD_OK; t++)
    {
      size_t i = turns[t].relation;

      g->kept[i] = celd_sequence_admit (&sequence, i);
      if (!g->kept[i])
        status = add_cycle (search, i, contradicting_path (search, i), knots->link[i] - 1, order);
      if (status == CELD_OK && t % BETWEEN_STEPS == 0)
        status = celd_step (run, (double) t / (double) n);
    }
  search->sequence = NULL;
  celd_sequence_clear (&sequence);
  return status;
}

/* Frees the graph from contradictions. */
static CeldStatus
break_knots (CeldGraph *g, const CeldKnots *knots, CeldOnCycle on_cycle, const CeldRun *run, Search *search,
             CeldOrder *order)
{
  CeldPart   part[2];
  CeldRun    choose = celd_run_part (&part[0], run, 0, 0.5);
  CeldRun    try = celd_run_part (&part[1], run, on_cycle == CELD_ON_CYCLE_REPORT ? 0 : 0.5, 1);
  CeldTurn  *turns = celd_alloc (g->n_links, sizeof *turns);
  size_t     n = turns ? take_turns (g, knots, turns) : 0;
  CeldStatus status = turns ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && on_cycle != CELD_ON_CYCLE_REPORT)
    status = put_off (g, knots, &choose, order->knot, turns, n);
  if (status == CELD_OK)
    status = try_turns (g, knots, turns, n, &try, search, order);
  celd_free (turns);
  return status;
}

/* Is the path that ends in `state` free of loops?  An equality may be led round one that it has no part in. */
static bool
is_simple (Search *s, size_t state)
{
  search_begin (s);
  for (size_t t = state; t != NOWHERE; t = s->from[t])
    {
      size_t node = t / 2;

      if (s->seen[2 * node] == s->number)
        return false;
      s->seen[2 * node] = s->number;
    }
  return true;
}

/* The shortest cycle through the newest relation of a knot that has one; use[] is true for the knot's relations. */
static CeldStatus
find_newest_cycle (Search *s, bool *use, CeldKnot *knot)
{
  CeldStatus status = CELD_OK;

  s->use = use;
  for (size_t k = knot->n; k-- > 0 && !knot->newest.n && status == CELD_OK; )
    {
      size_t i = knot->item[k], end;

      use[i] = false;
      end = contradicting_path (s, i);
      if (end != NOWHERE && is_simple (s, end))
        status = read_cycle (s, i, end, &knot->newest);
      use[i] = true;
    }
  s->use = s->graph->kept;
  return status;
}

/* The relations of each knot, and its newest cycle. */
static CeldStatus
describe_knots (Search *s, const CeldKnots *knots, CeldOrder *order)
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
  for (size_t k = 0; k < knots->n && status == CELD_OK; k++) /* no path leads from one knot to another and back */
    status = find_newest_cycle (s, use, &order->knot[k]);
  celd_free (use);
  return status;
}

CeldStatus
celd_graph_settle (CeldGraph *g, CeldOnCycle on_cycle, const CeldRun *run, CeldOrder *order)
{
  Search     search;
  CeldKnots  knots = { 0 };
  CeldStatus status = search_new (g, &search);

  if (status == CELD_OK)
    status = celd_knots_find (g, &knots);
  if (status == CELD_OK && knots.n)
    status = describe_knots (&search, &knots, order);
  if (status == CELD_OK && knots.n)
    status = break_knots (g, &knots, on_cycle, run, &search, order);
  if (status == CELD_OK)
    status = complete_background (g, &search);
  celd_knots_clear (&knots);
  search_end (&search);
  return status;
}
