/* Shortest paths of relations, by breadth-first search from both ends at once.
 *
 * A path leads from label to label by links from nearer to farther ones, and by equalities in both directions.  The
 * states of a search are 2 (label - 1) + strict, where strict says whether the path has an inequality before.  Both
 * searches proceed by whole layers, the one with fewer states in its next layer first; the first state in which they
 * meet is on a shortest path.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#define NO_STATE UINT32_MAX

void
celd_cycle_search_clear (CeldCycleSearch *s)
{
  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    {
      celd_free (s->step[to]);
      celd_free (s->passed[to]);
      celd_free (s->queue[to]);
    }
  *s = (CeldCycleSearch) { 0 };
}

CeldStatus
celd_cycle_search_new (const CeldGraph *graph, CeldCycleSearch *s)
{
  CeldStatus status = CELD_OK;

  *s = (CeldCycleSearch) { .graph = graph, .except = CELD_NO_INDEX };
  for (int to = CELD_FARTHER; to <= CELD_NEARER && status == CELD_OK; to++)
    {
      s->step[to]   = celd_alloc0 (2 * graph->n_labels, sizeof *s->step[to]);
      s->passed[to] = celd_alloc0 (2 * graph->n_links, sizeof *s->passed[to]);
      s->queue[to]  = celd_alloc (2 * graph->n_labels, sizeof *s->queue[to]);
      if (!s->step[to] || !s->passed[to] || !s->queue[to])
        status = CELD_NO_MEMORY;
    }
  return status;
}

/* ------------------------------------------------------------------ one step */

static void
begin (CeldCycleSearch *s)
{
  s->number++;
  s->n[CELD_FARTHER] = s->n[CELD_NEARER] = 0;
  s->met = NO_STATE;
}

static void
visit (CeldCycleSearch *s, CeldSide to, size_t label, size_t strict, uint32_t from, size_t link)
{
  size_t          state = 2 * label + strict;
  CeldSearchStep *step = &s->step[to][state];

  if (step->number == s->number)
    return;
  *step = (CeldSearchStep) { s->number, from, link };
  s->queue[to][s->n[to]++] = (uint32_t) state;
  if (s->step[!to][state].number == s->number && s->met == NO_STATE)
    s->met = (uint32_t) state;
}

static bool
within_limits (const CeldCycleSearch *s, uint32_t label)
{
  uint32_t place;

  if (!s->sequence)
    return true;
  place = s->sequence->place[celd_class_of (&s->sequence->classes, label)];
  return place >= s->limit[CELD_FARTHER] && place <= s->limit[CELD_NEARER];
}

/* Marks a link as taken; false if the search has taken it before. */
static bool
take_link (CeldCycleSearch *s, CeldSide to, size_t link, size_t strict)
{
  uint32_t *passed = &s->passed[to][2 * link + strict];

  if (*passed == s->number)
    return false;
  *passed = s->number;
  return true;
}

/* Adds a state.  Before an inequality the path may have another one or not, so that a search towards nearer labels adds
 * both states. */
static void
add_state (CeldCycleSearch *s, CeldSide to, uint32_t label, size_t strict, bool inequality, uint32_t from, size_t link)
{
  if (!within_limits (s, label))
    return;
  visit (s, to, label, strict, from, link);
  if (to == CELD_NEARER && inequality && s->loose)
    visit (s, to, label, 0, from, link);
}

/* Adds the states after a state; in a search towards nearer labels, those before it. */
static void
expand (CeldCycleSearch *s, CeldSide to, uint32_t state)
{
  const CeldGraph    *g = s->graph;
  const CeldLinkArcs *arcs = &s->arcs[to];
  size_t              label = state / 2, before = state % 2;

  for (const CeldLinkArc *arc = arcs->arc + arcs->first[label]; arc < arcs->arc + arcs->last[label]; arc++)
    {
      bool   several = arc->end == CELD_MANY_ENDS, equal = several && g->equal[arc->link];
      size_t strict = before | (to == CELD_FARTHER && !equal);
      size_t first = several ? g->first[2 * arc->link + (equal ? 0 : to)] : 0;
      size_t end = several ? g->first[2 * arc->link + (equal ? 2 : to + 1)] : 1;

      if (arc->link == s->except || (!equal && !strict) || (several && !take_link (s, to, arc->link, strict)))
        continue;
      for (size_t e = first; e < end; e++)
        add_state (s, to, several ? g->end[e] : arc->end, strict, !equal, state, arc->link);
    }
}

/* ------------------------------------------------------------------ searches */

/* The range of places of a path from the farther ends end[first] .. end[middle - 1] to nearer ones. */
static void
find_limits (CeldCycleSearch *s, size_t first, size_t middle, size_t last)
{
  s->limit[CELD_FARTHER] = UINT32_MAX;
  s->limit[CELD_NEARER]  = 0;
  for (size_t e = first; e < last; e++)
    {
      uint32_t place = s->sequence->place[celd_class_of (&s->sequence->classes, s->graph->end[e])];

      if (e < middle && place > s->limit[CELD_NEARER])
        s->limit[CELD_NEARER] = place;
      if ((e >= middle || s->loose) && place < s->limit[CELD_FARTHER])
        s->limit[CELD_FARTHER] = place;
    }
}

bool
celd_cycle_search_contradiction (CeldCycleSearch *s, size_t i)
{
  const CeldGraph *g = s->graph;
  const size_t    *f = &g->first[2 * i];
  size_t           done[2] = { 0 };

  begin (s);
  s->relation = i;
  s->loose    = g->equal[i];
  if (s->sequence)
    find_limits (s, f[0], s->loose ? f[2] : f[1], f[2]);
  for (size_t e = f[0]; e < (s->loose ? f[2] : f[1]); e++)
    visit (s, CELD_FARTHER, g->end[e], !s->loose, NO_STATE, i);
  for (size_t e = s->loose ? f[0] : f[1]; e < f[2]; e++)
    visit (s, CELD_NEARER, g->end[e], 1, NO_STATE, i);
  while (s->met == NO_STATE && done[CELD_FARTHER] < s->n[CELD_FARTHER] && done[CELD_NEARER] < s->n[CELD_NEARER])
    {
      CeldSide to = s->n[CELD_NEARER] - done[CELD_NEARER] < s->n[CELD_FARTHER] - done[CELD_FARTHER] ? CELD_NEARER
                                                                                                     : CELD_FARTHER;
      size_t   layer = s->n[to];

      while (done[to] < layer && s->met == NO_STATE)
        expand (s, to, s->queue[to][done[to]++]);
    }
  return s->met != NO_STATE;
}

void
celd_cycle_search_behind (CeldCycleSearch *s, size_t first, size_t last)
{
  begin (s);
  s->loose = false;
  for (size_t e = first; e < last; e++)
    visit (s, CELD_FARTHER, s->graph->end[e], 0, NO_STATE, 0);
  for (size_t i = 0; i < s->n[CELD_FARTHER]; i++)
    expand (s, CELD_FARTHER, s->queue[CELD_FARTHER][i]);
}

bool
celd_cycle_search_was_at (const CeldCycleSearch *s, size_t k)
{
  return s->step[CELD_FARTHER][2 * k].number == s->number || s->step[CELD_FARTHER][2 * k + 1].number == s->number;
}

/* A path found for an equality may have a loop that the equality is not part of. */
bool
celd_cycle_search_is_simple (CeldCycleSearch *s)
{
  const CeldSearchStep *step;
  uint32_t             *label = s->queue[0], *link = s->passed[0], number = ++s->number;

  for (size_t k = 0; k < s->graph->n_labels; k++)
    label[k] = number - 1;
  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    for (uint32_t t = s->met; t != NO_STATE; t = step->from)
      {
        step = &s->step[to][t];
        if ((label[t / 2] == number && (to == CELD_FARTHER || t != s->met)) ||
            (step->from != NO_STATE && link[2 * step->link] == number))
          return false;
        label[t / 2] = number;
        if (step->from != NO_STATE)
          link[2 * step->link] = number;
      }
  return true;
}

CeldStatus
celd_cycle_search_cycle (const CeldCycleSearch *s, CeldCycle *cycle)
{
  const CeldSearchStep *down = s->step[CELD_FARTHER], *up = s->step[CELD_NEARER];
  size_t                before = 1, n;

  for (uint32_t t = s->met; down[t].from != NO_STATE; t = down[t].from)
    before++;
  n = before;
  for (uint32_t t = s->met; up[t].from != NO_STATE; t = up[t].from)
    n++;
  *cycle = (CeldCycle) { .item = celd_alloc (n, sizeof (size_t)), .n = n };
  if (!cycle->item)
    return CELD_NO_MEMORY;
  n = before;
  for (uint32_t t = s->met; down[t].from != NO_STATE; t = down[t].from)
    cycle->item[--before] = down[t].link;
  for (uint32_t t = s->met; up[t].from != NO_STATE; t = up[t].from)
    cycle->item[n++] = up[t].link;
  cycle->item[0] = s->relation;
  return CELD_OK;
}
