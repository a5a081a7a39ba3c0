/* Relations without which the others can hold, of little weight in sum, for knots of any size.
 *
 * Small knots are solved exactly (feedback-exact.c).  In larger ones relations are tried by weight first, as for a
 * report, which leaves a sequence of classes of equal depth; then each class in turn moves to the place where the
 * weight of broken relations is the least ("sifting"), until none moves any more.  The better of the two counts.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#include <stdlib.h>
#include <string.h>

#define MOST_ROUNDS 16

/* What a class wants of another one, which stands at `place` at the moment. */
typedef struct { uint32_t class, place; bool before; double weight; } Wish;

typedef struct
{
  const CeldGraph *graph;
  const bool      *in;             /* is the link in a knot that is to be sifted? */
  CeldSequence  sequence;
  uint32_t     *at;             /* classes by place */
  uint32_t     *place;
  size_t        n;
  size_t       *first;          /* of class c: wish[first[c]] .. before first[c + 1] */
  Wish         *wish, *sorted;
} Sift;

static void
sift_clear (Sift *s)
{
  celd_sequence_clear (&s->sequence);
  celd_free (s->at);
  celd_free (s->place);
  celd_free (s->first);
  celd_free (s->wish);
  celd_free (s->sorted);
}

/* ------------------------------------------------------------------ classes by place, and their wishes */

/* Numbers the places of classes without a hole. */
static void
line_up (Sift *s)
{
  const CeldSequence *q = &s->sequence;

  for (size_t p = 0; p < s->graph->n_labels; p++)
    if (q->at[p] != UINT32_MAX)
      {
        s->at[s->n] = q->at[p];
        s->place[q->at[p]] = (uint32_t) s->n++;
      }
}

/* Counts wishes (pass 0) or writes them (pass 1: first[c + 1] moves on to where those of class c end). */
static void
go_through_wishes (Sift *s, int pass)
{
  const CeldGraph *g = s->graph;

  for (size_t i = 0; i < g->relations->n; i++)
    for (size_t far = g->first[2 * i]; s->in[i] && !celd_graph_equal (g, i) && far < g->first[2 * i + 1]; far++)
      for (size_t near = g->first[2 * i + 1]; near < g->first[2 * i + 2]; near++)
        {
          uint32_t a = celd_class_of (&s->sequence.classes, g->end[far]);
          uint32_t b = celd_class_of (&s->sequence.classes, g->end[near]);

          if (a == b)
            continue;
          if (pass == 0)
            {
              s->first[a + 2]++;
              s->first[b + 2]++;
            }
          else
            {
              s->wish[s->first[a + 1]++] = (Wish) { b, 0, true, celd_link_cost (g, i) };
              s->wish[s->first[b + 1]++] = (Wish) { a, 0, false, celd_link_cost (g, i) };
            }
        }
}

static CeldStatus
list_wishes (Sift *s)
{
  size_t n = s->graph->n_labels;

  go_through_wishes (s, 0);
  for (size_t k = 2; k < n + 2; k++)
    s->first[k] += s->first[k - 1];
  s->wish   = celd_alloc (s->first[n + 1], sizeof *s->wish);
  s->sorted = celd_alloc (s->first[n + 1], sizeof *s->sorted);
  if (!s->wish || !s->sorted)
    return CELD_NO_MEMORY;
  go_through_wishes (s, 1);
  return CELD_OK;
}

/* ------------------------------------------------------------------ sifting */

static int
compare_wishes (const void *one, const void *two)
{
  const Wish *a = one, *b = two;

  return a->place < b->place ? -1 : a->place > b->place;
}

/* Moves a class to a place; those between move on by one. */
static void
move_to (Sift *s, uint32_t class, uint32_t to)
{
  uint32_t from = s->place[class];

  for (; from < to; from++)
    s->place[s->at[from] = s->at[from + 1]] = from;
  for (; from > to; from--)
    s->place[s->at[from] = s->at[from - 1]] = from;
  s->at[to] = class;
  s->place[class] = to;
}

/* Moves a class to where it breaks least; false if it stands well. */
static bool
sift (Sift *s, uint32_t class)
{
  size_t   n = s->first[class + 1] - s->first[class];
  uint32_t own = s->place[class], best_place = own;
  double   cost = 0, here = 0, best;

  memcpy (s->sorted, s->wish + s->first[class], n * sizeof *s->sorted);
  for (size_t i = 0; i < n; i++)
    {
      Wish *w = &s->sorted[i];

      w->place = s->place[w->class];
      cost += w->before ? 0 : w->weight; /* in front of everything that it is to be behind */
      here += w->before == (w->place < own) ? w->weight : 0;
    }
  qsort (s->sorted, n, sizeof *s->sorted, compare_wishes);
  best = here * (1 - 1e-12); /* rounding is no reason to move */
  if (cost < best && n)
    {
      best = cost;
      best_place = s->sorted[0].place > own ? own : s->sorted[0].place;
    }
  for (size_t i = 0; i < n; i++)
    {
      cost += s->sorted[i].before ? s->sorted[i].weight : -s->sorted[i].weight;
      if (cost < best && (i + 1 == n || s->sorted[i + 1].place != s->sorted[i].place))
        {
          best = cost;
          best_place = s->sorted[i].place + (s->sorted[i].place < own);
        }
    }
  if (best_place != own)
    move_to (s, class, best_place);
  return best_place != own;
}

/* ------------------------------------------------------------------ what is broken */

static bool
is_broken (Sift *s, size_t link)
{
  const CeldGraph *g = s->graph;
  const size_t    *f = &g->first[2 * link];
  uint32_t         highest = 0, lowest = UINT32_MAX;

  for (size_t e = f[0]; e < f[2]; e++)
    {
      uint32_t place = s->place[celd_class_of (&s->sequence.classes, g->end[e])];

      if (celd_graph_equal (g, link) || e < f[1])
        highest = place > highest ? place : highest;
      if (celd_graph_equal (g, link) || e >= f[1])
        lowest = place < lowest ? place : lowest;
    }
  return celd_graph_equal (g, link) ? highest != lowest : highest >= lowest;
}

/* Marks what is broken of the knot if that weighs less than what is marked. */
static void
choose (Sift *s, const CeldKnot *knot, bool *broken)
{
  double before = 0, now = 0;

  for (size_t i = 0; i < knot->n; i++)
    {
      before += broken[knot->item[i]] ? celd_link_cost (s->graph, knot->item[i]) : 0;
      now += is_broken (s, knot->item[i]) ? celd_link_cost (s->graph, knot->item[i]) : 0;
    }
  for (size_t i = 0; i < knot->n && now < before; i++)
    broken[knot->item[i]] = is_broken (s, knot->item[i]);
}

/* Tries the links by turns, then sifts. */
static CeldStatus
sift_knots (const CeldGraph *g, const CeldTurn *turn, size_t n_turns, const bool *in, const CeldHost *host, bool *broken,
            Sift *s)
{
  CeldStatus status;

  *s = (Sift) { .graph = g, .in = in, .at = celd_alloc (g->n_labels, sizeof *s->at),
                .place = celd_alloc (g->n_labels, sizeof *s->place),
                .first = celd_alloc0 (g->n_labels + 2, sizeof *s->first) };
  status = s->at && s->place && s->first ? celd_sequence_new (g, &s->sequence) : CELD_NO_MEMORY;
  for (size_t t = 0; t < n_turns && status == CELD_OK; t++)
    if (in[turn[t].relation])
      broken[turn[t].relation] = !celd_sequence_admit (&s->sequence, turn[t].relation);
  if (status == CELD_OK)
    {
      line_up (s);
      status = list_wishes (s);
    }
  for (int round = 0, moved = 1; round < MOST_ROUNDS && moved && status == CELD_OK; round++)
    {
      moved = 0;
      for (uint32_t k = 0; k < g->n_labels; k++)
        if (celd_class_of (&s->sequence.classes, k) == k)
          moved |= sift (s, k);
      status = celd_progress (host, (double) (round + 1) / MOST_ROUNDS);
    }
  return status;
}

CeldStatus
celd_feedback (const CeldGraph *graph, const CeldKnots *knots, const CeldKnot *knot, const CeldTurn *turn,
               size_t n_turns, const CeldHost *host, bool *broken)
{
  bool      *in = celd_alloc0 (graph->n_links, sizeof *in), any = false;
  Sift       s = { 0 };
  CeldStatus status = in ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < knots->n && status == CELD_OK; k++)
    {
      bool done;

      status = celd_feedback_exact (graph, knots, &knot[k], (uint32_t) k + 1, broken, &done);
      for (size_t i = 0; i < knot[k].n && status == CELD_OK; i++)
        in[knot[k].item[i]] = !done;
      any |= !done;
    }
  if (status == CELD_OK && any)
    status = sift_knots (graph, turn, n_turns, in, host, broken, &s);
  for (size_t k = 0; k < knots->n && status == CELD_OK && any; k++)
    if (in[knot[k].item[0]])
      choose (&s, &knot[k], broken);
  sift_clear (&s);
  celd_free (in);
  return status;
}
