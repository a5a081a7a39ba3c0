/* Which end of each of several lines that meet has its head or dot.
 *
 * An arrow has one head, so that a free end decides about the other one, too.  The heads that are decided explain some
 * of the paint where lines meet, and what remains decides about lines without a free end.  Two arrows that begin at one
 * point, and nothing else there, are one line with a corner and a head at both ends.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define CLEAR_SIDE  0.8  /* score of each barb of a head that is beyond doubt */
#define MOST_REST   4.5  /* square widths of paint at a node that are not explained, ... */
#define DOT_REACH   9    /* ... in this distance, if there is a dot: a short branch may lead to another one */
#define MOST_MARGIN 0.33 /* part of a line at each of its ends where other paint may be beside it */

#define UNCLEAR -1 /* none of them, or it is not known which */
#define BOTH    2  /* two arrows, which meet at a corner of the line */

typedef struct
{
  CeldJoinedLines *lines;
  int             *marked; /* of each line: which end has the head or dot; also UNCLEAR or BOTH */
  size_t          *heads;  /* room for all ends of a node */
} Heads;

static bool
is_marked (const Heads *s, size_t end)
{
  return s->marked[end / 2] == (int) (end % 2) || s->marked[end / 2] == BOTH;
}

/* ------------------------------------------------------------------ marks at all ends */

/* Is an end apart from the others of its node?  Else all lines there are unclear, and need not be looked at. */
static bool
may_be_marked (const CeldJoinedLines *s, size_t end)
{
  return celd_joined_widths_apart (s, end) <= CELD_MOST_APART;
}

static CeldStatus
find_marks (CeldJoinedLines *s)
{
  CeldStatus status = CELD_OK;

  celd_free (s->end);
  s->end = celd_alloc0 (2 * s->graph.n_lines, sizeof *s->end);
  if (!s->end)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < 2 * s->graph.n_lines && status == CELD_OK; i++)
    {
      s->end[i].way = celd_joined_way (s, i);
      if (celd_joined_is_free (s, i))
        status = celd_joined_free_tip (s, i, &s->end[i].tip);
      else
        s->end[i].tip = celd_joined_meeting_point (s, celd_joined_node (s, i));
    }
  celd_joined_explain_lines (s);
  for (size_t i = 0; i < 2 * s->graph.n_lines && status == CELD_OK; i++)
    if (celd_joined_is_free (s, i))
      status = celd_joined_read_free_end (s, i);
    else if (may_be_marked (s, i))
      celd_joined_find_mark (s, &s->end[i], false);
  return status;
}

/* Joins the two lines of each node that has no more, and no mark: something else was there.  *joined: whether there
 * were such nodes. */
static CeldStatus
join_through (CeldJoinedLines *s, bool *joined)
{
  CeldStrokeGraph *g = &s->graph;
  size_t           before = g->n_lines;
  bool            *marked = celd_alloc0 (g->n_nodes, sizeof *marked);
  CeldStatus       status = marked ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; marked && i < 2 * g->n_lines; i++)
    marked[celd_joined_node (s, i)] |= s->end[i].mark != CELD_END_BARE;
  for (size_t node = 0; node < g->n_nodes && status == CELD_OK; node++)
    if (!marked[node])
      status = celd_stroke_graph_join (g, (int) node);
  *joined = g->n_lines < before;
  celd_free (marked);
  return status;
}

/* ------------------------------------------------------------------ the marked end of each line */

/* The marked end of a line, as far as it is clear; BOTH only with `corners`. */
static int
marked_end (const CeldJoinedLines *s, size_t k, bool corners)
{
  const CeldJoinedEnd *e = &s->end[2 * k];
  bool               free_end[2] = { celd_joined_is_free (s, 2 * k), celd_joined_is_free (s, 2 * k + 1) };
  CeldPoint          corner;

  if (free_end[0] == free_end[1] && e[0].mark == CELD_END_MARKED && e[1].mark == CELD_END_MARKED)
    return corners && (free_end[0] || s->style != CELD_ARROW_DOT) &&
           celd_stroke_line_corner (&s->graph, k, &corner) ? BOTH : UNCLEAR;
  for (int i = 0; i < 2; i++)
    if (free_end[0] && free_end[1] && e[i].mark == CELD_END_BARE && !e[i].covered && e[!i].covered)
      return !i; /* the head is there, seen or not */
  for (int i = 0; i < 2; i++)
    if (free_end[i] && e[i].mark == CELD_END_MARKED)
      return !free_end[!i] || e[!i].mark == CELD_END_BARE || e[!i].mark == CELD_END_HIDDEN ? i : UNCLEAR;
    else if (free_end[i] && e[i].mark == CELD_END_BARE)
      return e[!i].mark == CELD_END_MARKED || (e[!i].mark == CELD_END_HIDDEN && !e[i].covered) ? !i : UNCLEAR;
  for (int i = 0; i < 2; i++)
    if (e[i].mark == CELD_END_MARKED && e[!i].mark == CELD_END_BARE)
      return i;
  return UNCLEAR;
}

/* Decides about lines, and explains the paint of their heads; false if there was nothing new. */
static bool
decide (Heads *s, bool corners)
{
  CeldJoinedLines *lines = s->lines;
  bool             any = false;

  for (size_t k = 0; k < lines->graph.n_lines; k++)
    if (s->marked[k] == UNCLEAR && (s->marked[k] = marked_end (lines, k, corners)) != UNCLEAR)
      {
        any = true;
        for (size_t i = 2 * k; i < 2 * k + 2 && lines->style != CELD_ARROW_DOT; i++)
          if (is_marked (s, i) && !celd_joined_is_free (lines, i))
            celd_joined_explain_head (lines, &lines->end[i]);
      }
  return any;
}

/* Decides, and looks again at the ends of the other lines, until there is nothing new. */
static void
decide_all (Heads *s)
{
  CeldJoinedLines *lines = s->lines;

  while (decide (s, false) || decide (s, true))
    for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
      if (lines->style != CELD_ARROW_DOT && s->marked[i / 2] == UNCLEAR && !celd_joined_is_free (lines, i) &&
          may_be_marked (lines, i))
        {
          lines->end[i].tip = celd_joined_meeting_point (lines, celd_joined_node (lines, i));
          celd_joined_find_mark (lines, &lines->end[i], false);
        }
}

/* ------------------------------------------------------------------ places of nodes */

/* The place of a node: where the heads that end there agree best with the paint, or its dot is, else where its lines
 * meet. */
static CeldPoint
place_of (const Heads *s, int node)
{
  const CeldJoinedLines *lines = s->lines;
  CeldJoinedEnd          dot = { .tip = celd_joined_meeting_point (lines, node) };
  size_t                 n = 0;

  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == node && is_marked (s, i))
      s->heads[n++] = i;
  if (lines->style == CELD_ARROW_DOT)
    celd_joined_find_mark (lines, &dot, false);
  else if (n)
    return celd_joined_common_tip (lines, s->heads, n, dot.tip);
  return dot.tip;
}

/* Moves the ends at a node to a place; false if the paint there is not that of its lines and heads. */
static bool
place_node (Heads *s, int node)
{
  CeldJoinedLines *lines = s->lines;
  CeldPoint        place = place_of (s, node), met = celd_joined_meeting_point (lines, node);

  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == node)
      {
        lines->end[i].tip = place;
        if (celd_joined_widths_apart (lines, i) > CELD_MOST_APART)
          return false;
      }
  if (!celd_joined_is_led_to (lines, node, place) ||
      hypot (place.x - met.x, place.y - met.y) > CELD_MOST_MOVED * lines->graph.width)
    return false;
  if (lines->style == CELD_ARROW_DOT)
    return celd_joined_rest (lines, place, DOT_REACH) <= MOST_REST;
  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == node && is_marked (s, i))
      celd_joined_find_barbs (lines, &lines->end[i]);
  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == node && is_marked (s, i))
      celd_joined_explain_head (lines, &lines->end[i]);
  return celd_joined_rest (lines, place, CELD_HEAD_REACH) <= MOST_REST;
}

/* Is a line long enough for what it is said to be, without a corner unless it is two arrows, and is there no other
 * paint along it?  The ends of a line without a free end must be apart. */
static bool
is_plausible (const Heads *s, size_t k)
{
  const CeldJoinedLines *lines = s->lines;
  const CeldStrokeLine  *line = &lines->graph.line[k];
  const CeldJoinedEnd   *e = &lines->end[2 * k];
  bool                   met = !celd_joined_is_free (lines, 2 * k) && !celd_joined_is_free (lines, 2 * k + 1);
  CeldPoint              corner;

  if (celd_stroke_line_length (line) < (met ? 2 * CELD_HEAD_REACH : CELD_LEAST_LINE) * lines->graph.width)
    return false;
  if (s->marked[k] != UNCLEAR && celd_stroke_line_corner (&lines->graph, k, &corner))
    for (int i = 0; i < 2; i++)
      if (s->marked[k] != BOTH ||
          hypot (e[i].tip.x - corner.x, e[i].tip.y - corner.y) < CELD_LEAST_LINE * lines->graph.width)
        return false;
  return celd_joined_is_alone (lines, k, (size_t) fmin (CELD_HEAD_REACH * lines->graph.width,
                                                        MOST_MARGIN * (double) line->n));
}

/* Places all nodes.  The lines of those that are unclear, and those that cannot be arrows, are unclear. */
static void
place_nodes (Heads *s)
{
  CeldJoinedLines *lines = s->lines;

  celd_joined_explain_lines (lines);
  for (size_t i = 0; i < 2 * lines->graph.n_lines && lines->style == CELD_ARROW_DOT; i++)
    if (lines->end[i].mark == CELD_END_MARKED)
      celd_joined_explain_dot (lines, &lines->end[i]);
  for (size_t node = 0; node < lines->graph.n_nodes; node++)
    {
      size_t n = 0;
      bool   clear;

      for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
        n += celd_joined_node (lines, i) == (int) node;
      clear = n < 2 || place_node (s, (int) node);
      for (size_t i = 0; i < 2 * lines->graph.n_lines && !clear; i++)
        if (celd_joined_node (lines, i) == (int) node)
          s->marked[i / 2] = UNCLEAR;
    }
  for (size_t k = 0; k < lines->graph.n_lines; k++)
    if (!is_plausible (s, k))
      s->marked[k] = UNCLEAR;
}

/* ------------------------------------------------------------------ arrows */

/* The arrows of a line.  A head is the farther end, a dot the nearer one. */
static CeldLineArrows
arrows_of (const Heads *s, size_t k)
{
  const CeldJoinedEnd *e = &s->lines->end[2 * k];
  CeldLineArrows       a = { .n = s->marked[k] == UNCLEAR ? 0 : s->marked[k] == BOTH ? 2 : 1 };
  CeldPoint            corner = e[0].tip;

  if (a.n == 2)
    celd_stroke_line_corner (&s->lines->graph, k, &corner);
  for (int i = 0; i < a.n; i++)
    {
      CeldPoint marked = a.n == 2 ? e[i].tip : e[s->marked[k]].tip, other = a.n == 2 ? corner : e[!s->marked[k]].tip;

      a.nearer[i]  = s->lines->style == CELD_ARROW_DOT ? marked : other;
      a.farther[i] = s->lines->style == CELD_ARROW_DOT ? other : marked;
    }
  for (int i = 0; i < 2; i++)
    {
      bool here = is_marked (s, 2 * k + (size_t) i);

      a.role[i] = !a.n ? 0 : here == (s->lines->style != CELD_ARROW_DOT) ? 1 : -1;
      a.seen[i] = s->lines->style == CELD_ARROW_DOT ||
                  (here && fmin (e[i].barb_score[0], e[i].barb_score[1]) >= CLEAR_SIDE);
    }
  return a;
}

CeldStatus
celd_joined_heads_read (CeldJoinedLines *lines, CeldLineArrows *arrows)
{
  Heads      s = { .lines = lines };
  bool       joined = true;
  CeldStatus status = CELD_OK;

  while (status == CELD_OK && joined)
    {
      status = find_marks (lines);
      if (status == CELD_OK)
        status = join_through (lines, &joined);
    }
  s.marked = celd_alloc (lines->graph.n_lines, sizeof *s.marked);
  s.heads  = celd_alloc (2 * lines->graph.n_lines, sizeof *s.heads);
  if (status == CELD_OK && (!s.marked || !s.heads))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      for (size_t k = 0; k < lines->graph.n_lines; k++)
        s.marked[k] = UNCLEAR;
      decide_all (&s);
      place_nodes (&s);
      for (size_t k = 0; k < lines->graph.n_lines; k++)
        arrows[k] = arrows_of (&s, k);
    }
  celd_free (s.marked);
  celd_free (s.heads);
  return status;
}
