/* A topological order of classes of labels, from far to near, to which relations are added one by one.
 *
 * A relation whose ends are already in the right order costs nothing.  Otherwise two searches start, one from its
 * nearer side by rising places and one from its farther side by falling places; the search that has done less work
 * continues until their places cross (topological search [Haeupler, Kavitha, Mathew, Sen & Tarjan 2012]).  If the
 * searches meet, the relation contradicts those before.  If not, classes below the crossing that the first search has
 * reached move up to it, and classes above it that the second one has reached move to just below these; no class
 * outside the places of the relation's ends moves.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#define NO_CLASS UINT32_MAX /* at a place whose class has joined another one */

/* ------------------------------------------------------------------ work space */

void
celd_incremental_order_clear (CeldIncrementalOrder *s)
{
  celd_equivalence_clear (&s->classes);
  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    {
      celd_arc_index_clear (&s->arc[to]);
      celd_free (s->last[to]);
      celd_free (s->mark[to]);
    }
  celd_free (s->at);
  celd_free (s->place);
  celd_free (s->moved);
  *s = (CeldIncrementalOrder) { 0 };
}

CeldStatus
celd_incremental_order_new (const CeldGraph *graph, CeldIncrementalOrder *s)
{
  size_t     n = graph->n_labels;
  CeldStatus status;

  *s = (CeldIncrementalOrder) { .graph = graph, .at = celd_alloc (n, sizeof *s->at),
                                .place = celd_alloc (n, sizeof *s->place),
                        .moved = celd_alloc (n, sizeof *s->moved) };
  status = s->at && s->place && s->moved ? celd_equivalence_new (n, &s->classes) : CELD_NO_MEMORY;
  for (int to = CELD_FARTHER; to <= CELD_NEARER && status == CELD_OK; to++)
    {
      s->last[to] = celd_alloc (n, sizeof *s->last[to]);
      s->mark[to] = celd_alloc0 (n, sizeof *s->mark[to]);
      status = s->last[to] && s->mark[to]
             ? celd_graph_index (graph, to == CELD_NEARER ? CELD_FARTHER : CELD_NEARER, NULL, &s->arc[to])
             : CELD_NO_MEMORY;
      for (size_t k = 0; k < n && status == CELD_OK; k++)
        s->last[to][k] = s->arc[to].first[k];
    }
  for (uint32_t k = 0; status == CELD_OK && k < n; k++)
    s->at[k] = s->place[k] = k;
  return status;
}

/* ------------------------------------------------------------------ searches between two places */

/* The places of the classes of end[first] .. end[last - 1]. */
static void
span_of (CeldIncrementalOrder *s, size_t first, size_t last, uint32_t *least, uint32_t *most)
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

static bool
mark_one (CeldIncrementalOrder *s, CeldSide to, uint32_t label)
{
  uint32_t place = s->place[celd_class_of (&s->classes, label)];

  if (place < s->window[0] || place > s->window[1])
    return false;
  s->mark[to][place] = s->number;
  return s->mark[!to][place] == s->number;
}

/* Marks the places of the classes of end[first] .. end[last - 1] that are not out of the window; true if the other
 * search has been at one of them. */
static bool
mark (CeldIncrementalOrder *s, CeldSide to, size_t first, size_t last)
{
  bool met = false;

  for (size_t e = first; e < last; e++)
    met |= mark_one (s, to, s->graph->end[e]);
  return met;
}

/* Follows admitted inequalities from the class at a place to one side, and counts them; true if the searches meet. */
static bool
follow (CeldIncrementalOrder *s, uint32_t place, CeldSide to, size_t *work)
{
  const CeldGraph *g = s->graph;
  CeldLinkArcs     arcs = celd_incremental_order_arcs (s, to);
  bool             met = false;
  uint32_t         k = s->at[place];

  do
    {
      for (const CeldLinkArc *arc = arcs.arc + arcs.first[k]; arc < arcs.arc + arcs.last[k]; arc++)
        if (arc->end != CELD_MANY_ENDS)
          met |= mark_one (s, to, arc->end);
        else if (!g->equal[arc->link])
          met |= mark (s, to, g->first[2 * arc->link + to], g->first[2 * arc->link + to + 1]);
      *work += arcs.last[k] - arcs.first[k];
      k = s->classes.next[k];
    }
  while (k != s->at[place] && !met);
  return met;
}

/* Goes through the window from both ends until the searches meet (false), or their places cross: from *crossing on up,
 * everything that leads to a mark downwards is marked, and so upwards below it. */
static bool
search (CeldIncrementalOrder *s, uint32_t *crossing)
{
  uint32_t up = s->window[0], down = s->window[1] + 1; /* places below `up` and from `down` on are done */
  size_t   work[2] = { 0 };

  while (up < down)
    if (work[CELD_NEARER] <= work[CELD_FARTHER])
      {
        if (s->mark[CELD_NEARER][up] == s->number && follow (s, up, CELD_NEARER, &work[CELD_NEARER]))
          return false;
        up++;
      }
    else
      {
        down--;
        if (s->mark[CELD_FARTHER][down] == s->number && follow (s, down, CELD_FARTHER, &work[CELD_FARTHER]))
          return false;
      }
  *crossing = up;
  return true;
}

/* ------------------------------------------------------------------ one more relation */

/* Appends the classes at the places from `first` to before `end` that the search to a side has marked, or not. */
static uint32_t
gather (CeldIncrementalOrder *s, uint32_t n, uint32_t first, uint32_t end, CeldSide to, bool marked)
{
  for (uint32_t p = first; p < end; p++)
    if (s->at[p] != NO_CLASS && (s->mark[to][p] == s->number) == marked)
      s->moved[n++] = s->at[p];
  return n;
}

/* Gives the window its new sequence: what stays below the crossing, what moves down to it, the class `own` unless
 * it is NO_CLASS, what moves up to it, what stays above; empty places come last. */
static void
deal_places (CeldIncrementalOrder *s, uint32_t crossing, uint32_t own)
{
  uint32_t first = s->window[0], end = s->window[1] + 1, n = gather (s, 0, first, crossing, CELD_NEARER, false);

  n = gather (s, n, crossing, end, CELD_FARTHER, true);
  if (own != NO_CLASS)
    s->moved[n++] = own;
  n = gather (s, n, first, crossing, CELD_NEARER, true);
  n = gather (s, n, crossing, end, CELD_FARTHER, false);
  for (uint32_t i = 0; i < end - first; i++)
    {
      s->at[first + i] = i < n ? s->moved[i] : NO_CLASS;
      if (i < n)
        s->place[s->moved[i]] = first + i;
    }
}

static bool
admit_inequality (CeldIncrementalOrder *s, const size_t *f)
{
  uint32_t unused, crossing;

  span_of (s, f[0], f[1], &unused, &s->window[1]);
  span_of (s, f[1], f[2], &s->window[0], &unused);
  if (s->window[1] < s->window[0])
    return true;
  s->number++;
  mark (s, CELD_NEARER, f[1], f[2]);
  if (mark (s, CELD_FARTHER, f[0], f[1]) || !search (s, &crossing))
    return false;
  deal_places (s, crossing, NO_CLASS);
  return true;
}

/* The classes become one, which has no place yet. */
static uint32_t
join_all (CeldIncrementalOrder *s, const size_t *f)
{
  for (size_t e = f[0]; e < f[2]; e++)
    s->at[s->place[celd_class_of (&s->classes, s->graph->end[e])]] = NO_CLASS;
  for (size_t e = f[0] + 1; e < f[2]; e++)
    celd_equivalence_join (&s->classes, s->graph->end[e - 1], s->graph->end[e]);
  return celd_class_of (&s->classes, s->graph->end[f[0]]);
}

/* Both searches begin at all classes, which become one at the crossing; all but one of their places stay empty. */
static bool
admit_equality (CeldIncrementalOrder *s, const size_t *f)
{
  uint32_t crossing;

  span_of (s, f[0], f[2], &s->window[0], &s->window[1]);
  if (s->window[0] == s->window[1])
    return true;
  s->number++;
  mark (s, CELD_NEARER, f[0], f[2]);
  mark (s, CELD_FARTHER, f[0], f[2]);
  if (!search (s, &crossing))
    return false;
  deal_places (s, crossing, join_all (s, f));
  return true;
}

/* From now on searches take the link. */
static void
add_arcs (CeldIncrementalOrder *s, size_t link)
{
  const size_t *f = &s->graph->first[2 * link];
  bool          equal = s->graph->equal[link];

  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    for (size_t e = to == CELD_NEARER || equal ? f[0] : f[1]; e < (to == CELD_FARTHER || equal ? f[2] : f[1]); e++)
      s->arc[to].arc[s->last[to][s->graph->end[e]]++] = celd_graph_arc (s->graph, link, (CeldSide) to);
}

bool
celd_incremental_order_admit (CeldIncrementalOrder *s, size_t link)
{
  const size_t *f = &s->graph->first[2 * link];
  bool          fits = s->graph->equal[link] ? admit_equality (s, f) : admit_inequality (s, f);

  if (fits)
    add_arcs (s, link);
  return fits;
}
