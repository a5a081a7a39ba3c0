/* Classes of labels in a sequence from far to near that every relation admitted so far respects [Pearce & Kelly 2006].
 *
 * One more relation only moves classes that lie between its ends: those that lead to its farther side, and those that
 * its nearer side leads to, share out their places anew, the former first.  A relation whose ends stand right costs
 * nothing, and one that contradicts is found on a search that never leaves the places between its ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ work space */

void
celd_sequence_clear (CeldSequence *s)
{
  celd_classes_clear (&s->classes);
  celd_free (s->up.first);
  celd_free (s->up.link);
  celd_free (s->down.first);
  celd_free (s->down.link);
  celd_free (s->admitted);
  celd_free (s->place);
  celd_free (s->seen);
  celd_free (s->goal);
  celd_free (s->list);
  celd_free (s->places);
  *s = (CeldSequence) { 0 };
}

CeldStatus
celd_sequence_new (const CeldGraph *graph, CeldSequence *s)
{
  size_t     n = graph->n_labels;
  CeldStatus status;

  *s = (CeldSequence) {
    .graph = graph, .admitted = celd_alloc0 (graph->n_links, sizeof (bool)),
    .place = celd_alloc (n, sizeof (uint32_t)), .seen = celd_alloc0 (n, sizeof (size_t)),
    .goal = celd_alloc0 (n, sizeof (size_t)), .list = celd_alloc (2 * n, sizeof (uint64_t)),
    .places = celd_alloc (2 * n, sizeof (uint32_t)),
  };
  status = s->admitted && s->place && s->seen && s->goal && s->list && s->places
         ? celd_classes_new (n, &s->classes) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_graph_index (graph, CELD_FARTHER, &s->up);
  if (status == CELD_OK)
    status = celd_graph_index (graph, CELD_NEARER, &s->down);
  for (uint32_t k = 0; status == CELD_OK && k < n; k++)
    s->place[k] = k;
  return status;
}

/* ------------------------------------------------------------------ searches between two places */

/* Classes to move, each with its place in front of its number, so that sorting is by place. */
static uint64_t
entry_of (const CeldSequence *s, uint32_t class)
{
  return (uint64_t) s->place[class] << 32 | class;
}

static uint32_t
class_at (const CeldSequence *s, size_t i)
{
  return (uint32_t) s->list[i];
}

static void
find (CeldSequence *s, uint32_t class)
{
  if (s->seen[class] == s->number)
    return;
  s->seen[class] = s->number;
  s->list[s->n++] = entry_of (s, class);
}

/* Follows admitted inequalities from a class, upwards or downwards, no farther than the place `limit`; true if it meets
 * a goal. */
static bool
follow (CeldSequence *s, uint32_t class, CeldSide to, uint32_t limit)
{
  const CeldGraph *g = s->graph;
  const CeldIndex *index = to == CELD_NEARER ? &s->up : &s->down;
  uint32_t         k = class;

  do
    {
      for (size_t j = index->first[k]; j < index->first[k + 1]; j++)
        {
          size_t link = index->link[j];

          if (!s->admitted[link] || celd_graph_equal (g, link))
            continue;
          for (size_t e = g->first[2 * link + to]; e < g->first[2 * link + to + 1]; e++)
            {
              uint32_t c = celd_class_of (&s->classes, g->end[e]);

              if (to == CELD_NEARER ? s->place[c] > limit : s->place[c] < limit)
                continue;
              if (to == CELD_NEARER && s->goal[c] == s->number)
                return true;
              find (s, c);
            }
        }
      k = s->classes.next[k];
    }
  while (k != class);
  return false;
}

/* Everything that the entries from `first` on lead to, behind them in the list; true if a goal is among it. */
static bool
search (CeldSequence *s, size_t first, CeldSide to, uint32_t limit)
{
  for (size_t i = first; i < s->n; i++)
    if (follow (s, class_at (s, i), to, limit))
      return true;
  return false;
}

/* ------------------------------------------------------------------ one more relation */

static int
compare_entries (const void *one, const void *two)
{
  uint64_t a = *(const uint64_t *) one, b = *(const uint64_t *) two;

  return a < b ? -1 : a > b;
}

static int
compare_places (const void *one, const void *two)
{
  uint32_t a = *(const uint32_t *) one, b = *(const uint32_t *) two;

  return a < b ? -1 : a > b;
}

/* Deals the places of the classes in list[0..n-1] out to them in rising order. */
static void
deal_places (CeldSequence *s, size_t n)
{
  for (size_t i = 0; i < n; i++)
    s->places[i] = (uint32_t) (s->list[i] >> 32);
  qsort (s->places, n, sizeof *s->places, compare_places);
  for (size_t i = 0; i < n; i++)
    s->place[class_at (s, i)] = s->places[i];
}

/* The places of the classes of end[first] .. end[last - 1]. */
static void
span_of (CeldSequence *s, size_t first, size_t last, uint32_t *least, uint32_t *most)
{
  *least = UINT32_MAX;
  *most  = 0;
  for (size_t e = first; e < last; e++)
    {
      uint32_t place = s->place[celd_class_of (&s->classes, s->graph->end[e])];

      *least = place < *least ? place : *least;
      *most  = place > *most ? place : *most;
    }
}

/* Adds the classes of ends between two places to the list. */
static void
begin_from (CeldSequence *s, size_t first, size_t last, uint32_t least, uint32_t most)
{
  for (size_t e = first; e < last; e++)
    {
      uint32_t c = celd_class_of (&s->classes, s->graph->end[e]);

      if (s->place[c] >= least && s->place[c] <= most)
        find (s, c);
    }
}

static void
set_goals (CeldSequence *s, size_t first, size_t last)
{
  for (size_t e = first; e < last; e++)
    s->goal[celd_class_of (&s->classes, s->graph->end[e])] = s->number;
}

/* Is a class of the list both in front and behind? */
static bool
meets_goal (const CeldSequence *s)
{
  for (size_t i = 0; i < s->n; i++)
    if (s->goal[class_at (s, i)] == s->number)
      return true;
  return false;
}

/* What is behind the farther ends and out of place, then what is before the nearer ends. */
static bool
admit_inequality (CeldSequence *s, const size_t *f)
{
  uint32_t least, most, unused;
  size_t   n_before;

  span_of (s, f[0], f[1], &unused, &most);
  span_of (s, f[1], f[2], &least, &unused);
  if (most < least)
    return true;
  s->number++;
  s->n = 0;
  set_goals (s, f[0], f[1]);
  begin_from (s, f[1], f[2], least, most);
  if (meets_goal (s) || search (s, 0, CELD_NEARER, most))
    return false;
  n_before = s->n;
  begin_from (s, f[0], f[1], least, most);
  search (s, n_before, CELD_FARTHER, least);
  qsort (s->list, n_before, sizeof *s->list, compare_entries);
  qsort (s->list + n_before, s->n - n_before, sizeof *s->list, compare_entries);
  /* the second part goes first: turn the list */
  for (size_t i = 0; i < n_before; i++)
    s->list[s->n + i] = s->list[i];
  for (size_t i = 0; i < s->n; i++)
    s->list[i] = s->list[n_before + i];
  deal_places (s, s->n);
  return true;
}

static void
join_all (CeldSequence *s, const size_t *f)
{
  uint32_t place = UINT32_MAX, unused;

  span_of (s, f[0], f[2], &place, &unused);
  for (size_t e = f[0] + 1; e < f[2]; e++)
    celd_classes_join (&s->classes, s->graph->end[e - 1], s->graph->end[e]);
  s->place[celd_class_of (&s->classes, s->graph->end[f[0]])] = place;
}

/* The classes of an equality come to stand side by side, what is behind any of them before all of them. */
static bool
admit_equality (CeldSequence *s, const size_t *f)
{
  uint32_t least, most;
  size_t   n_own, n_up, n_down;

  span_of (s, f[0], f[2], &least, &most);
  if (least == most)
    return true;
  s->number++;
  s->n = 0;
  set_goals (s, f[0], f[2]);
  begin_from (s, f[0], f[2], least, most);
  n_own = s->n;
  if (search (s, 0, CELD_NEARER, most))
    return false;
  n_up = s->n - n_own;
  for (size_t i = 0; i < n_own; i++)
    follow (s, class_at (s, i), CELD_FARTHER, least);
  search (s, n_own + n_up, CELD_FARTHER, least);
  n_down = s->n - n_own - n_up;
  qsort (s->list + n_own, n_up, sizeof *s->list, compare_entries);
  qsort (s->list + n_own + n_up, n_down, sizeof *s->list, compare_entries);
  /* own, up, down -> down, own, up */
  for (size_t i = s->n; i-- > 0; )
    s->list[i + n_down] = s->list[i];
  for (size_t i = 0; i < n_down; i++)
    s->list[i] = s->list[s->n + i];
  deal_places (s, s->n);
  join_all (s, f);
  return true;
}

bool
celd_sequence_admit (CeldSequence *s, size_t link)
{
  const size_t *f = &s->graph->first[2 * link];

  s->admitted[link] = celd_graph_equal (s->graph, link) ? admit_equality (s, f) : admit_inequality (s, f);
  return s->admitted[link];
}
