/* Which relations can hold together (section 3.2: a consistent order exists if there is no oriented loop).
 *
 * Relations are tried by falling weight, then in the order given.  One is left out if those kept before it already lead
 * from its farther to its nearer side; an equality, if they lead through an inequality from one of its labels to
 * another.  The shortest such path (breadth first) with the relation itself is the cycle that the artist gets to see,
 * equalities that carry it included.  Greedy, so not always the fewest left out, but easy to foresee: a heavier arrow
 * never yields to lighter ones.  Cost: relations x the part of the graph behind each.
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
    .graph = graph,
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
          for (size_t j = s->down.first[node]; j < s->down.first[node + 1]; j++)
            if (g->kept[s->down.link[j]])
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

/* The end of a path of kept relations that relation i contradicts, or NOWHERE. */
static size_t
contradicting_path (Search *s, size_t i)
{
  const CeldGraph *g     = s->graph;
  const size_t    *f     = &g->first[2 * i];
  bool             equal = celd_graph_equal (g, i);

  search_begin (s);
  for (size_t e = equal ? f[0] : f[1]; e < f[2]; e++)
    s->goal[g->end[e]] = s->number;
  for (size_t e = f[0]; e < (equal ? f[2] : f[1]); e++)
    visit (s, g->end[e], !equal, NOWHERE);
  return descend (s);
}

/* Relation i and the links of the path that ends in `state`, as one more cycle. */
static CeldStatus
add_cycle (const Search *s, size_t i, size_t state, CeldOrder *order)
{
  size_t     n_labels = s->graph->n_labels, n = 1;
  CeldCycle *cycles, cycle;

  for (size_t t = state; t != NOWHERE; t = s->from[t])
    n += t / 2 >= n_labels;
  cycle = (CeldCycle) { celd_alloc (n, sizeof (size_t)), n };
  if (!cycle.item)
    return CELD_NO_MEMORY;
  for (size_t t = state; t != NOWHERE; t = s->from[t])
    if (t / 2 >= n_labels)
      cycle.item[--n] = t / 2 - n_labels;
  cycle.item[0] = i;
  cycles = celd_grow (order->cycle, order->n_cycles + 1, sizeof *cycles);
  if (!cycles)
    {
      celd_free (cycle.item);
      return CELD_NO_MEMORY;
    }
  order->cycle = cycles;
  cycles[order->n_cycles++] = cycle;
  return CELD_OK;
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

typedef struct { double weight; size_t relation; } Turn;

/* By falling weight, then in the order given. */
static int
compare_turns (const void *one, const void *two)
{
  const Turn *a = one, *b = two;

  if (a->weight != b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

/* All resolved relations in the order in which they are tried; none of them counts yet. */
static size_t
take_turns (CeldGraph *g, Turn *turns)
{
  size_t n = 0;

  for (size_t i = 0; i < g->relations->n; i++)
    if (g->kept[i])
      {
        double weight = g->relations->item[i].weight;

        g->kept[i] = false;
        turns[n++] = (Turn) { weight > 0 ? weight : 0, i }; /* NaN has no place in a sort */
      }
  qsort (turns, n, sizeof *turns, compare_turns);
  return n;
}

CeldStatus
celd_graph_settle (CeldGraph *g, const CeldRun *run, CeldOrder *order)
{
  Turn      *turns  = celd_alloc (g->n_links, sizeof *turns);
  Search     search = { 0 };
  CeldStatus status = turns ? search_new (g, &search) : CELD_NO_MEMORY;
  size_t     n      = status == CELD_OK ? take_turns (g, turns) : 0;

  for (size_t t = 0; t < n && status == CELD_OK; t++)
    {
      size_t i = turns[t].relation, end = contradicting_path (&search, i);

      g->kept[i] = end == NOWHERE;
      if (!g->kept[i])
        status = add_cycle (&search, i, end, order);
      if (status == CELD_OK && t % BETWEEN_STEPS == 0)
        status = celd_step (run, (double) t / (double) n);
    }
  if (status == CELD_OK)
    status = complete_background (g, &search);
  search_end (&search);
  celd_free (turns);
  return status;
}
