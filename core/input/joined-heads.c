/* The arrows of lines that meet, by their heads or dots.
 *
 * An arrow has one head.  What each choice of heads costs at a node (head-fits.c), and where arrows may pass, gives the
 * choice for all lines that costs least (head-choice.c).  An arrow is read if every other choice for its lines costs
 * clearly more, and if that choice explains the paint at both ends and its lines lead there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; costs are square widths of paint. */
#define PASS_TURN      0.6  /* radians by which an arrow may turn where it passes others, ... */
#define FREE_TURN      0.35 /* ... and by which it may turn for a cost of 1; ... */
#define CORNER_JOIN    0.4  /* radians by which lines turn at a corner that are two arrows, at least */
#define MOST_BEND      1.3  /* ... the same at the corner of a line */
#define FREE_BEND      0.7
#define CLEAR_HEAD     0.6  /* cost by which other heads of the lines of an arrow must be worse, ... */
#define CLEAR_DOT      1    /* ... or dots, ... */
#define CLEAR_PASS     1    /* ... and any pass that is changed */
#define MOST_REST      1.5  /* cost of a node where all is clear, ... */
#define MORE_REST      1    /* ... and for each head more than one: the paint of heads on each other fits none exactly */
#define LEAST_SHOWN    0.5  /* cost that a node would have without its heads or dots, if many lines meet there */
#define MOST_OFF       1.5  /* widths by which a line may pass the place where it ends, ... */
#define MEAN_OFF       0.85 /* ... and all lines of a node, as the root of the mean square: two nodes may look like one */
#define LINES_OFF      1    /* widths from the place of heads where many lines meet to where these lead, at most */
#define TIP_RADIUS     1.3  /* widths from the tip of a head to where there is no paint, at most */
#define BARE_MARGIN    0.75 /* cost by which a free end must be better without a head */
#define SHORTEST_ARROW 6    /* widths that the line of an arrow is long */
#define OTHERS         1.5  /* widths from a free end to paint of other colours that may hide a head */

#define NO_END SIZE_MAX

/* ------------------------------------------------------------------ nodes and passes */

/* Where the paint of a line ends beyond a free end, straight on. */
static CeldPoint
last_paint (const CeldJoinedLines *lines, size_t end)
{
  CeldPoint way = celd_joined_way (lines, end), p = celd_joined_led_from (lines, end);
  double    d = 0;

  while (celd_joined_painted (lines, celd_moved (p, way, -d - 1)))
    d++;
  return celd_moved (p, way, 0.5 * lines->graph.width - d);
}

/* Where the lines of each node meet, or the one that is free there ends; NAN if there are none. */
static void
find_meeting_points (const CeldJoinedLines *lines, CeldPoint *meeting)
{
  for (size_t k = 0; k < lines->graph.n_nodes; k++)
    meeting[k] = (CeldPoint) { NAN, NAN };
  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    {
      int node = celd_joined_node (lines, i);

      meeting[node] = celd_joined_is_free (lines, i) ? last_paint (lines, i) : celd_joined_meeting_point (lines, node);
    }
}

static CeldStatus
node_marks_new (const CeldJoinedLines *lines, size_t node, const CeldPoint *meeting, CeldNodeMarks *marks)
{
  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == (int) node && marks->n++ < CELD_MOST_MARKS)
      marks->end[marks->n - 1] = i;
  if (!marks->n || marks->n > CELD_MOST_MARKS)
    {
      marks->n = 0; /* nothing is known there */
      return CELD_OK;
    }
  marks->cost = celd_alloc ((size_t) 1 << marks->n, sizeof *marks->cost);
  marks->tip  = celd_alloc ((size_t) 1 << marks->n, sizeof *marks->tip);
  return marks->cost && marks->tip ? celd_node_marks_find (lines, node, meeting, marks) : CELD_NO_MEMORY;
}

static CeldStatus
find_node_marks (CeldHeadChoice *s)
{
  size_t     n = s->lines->graph.n_nodes;
  CeldPoint *meeting = celd_alloc (n, sizeof *meeting);
  CeldStatus status = meeting ? CELD_OK : CELD_NO_MEMORY;

  if (meeting)
    find_meeting_points (s->lines, meeting);
  celd_joined_explain_lines (s->lines);
  for (size_t k = 0; k < n && status == CELD_OK; k++)
    status = node_marks_new (s->lines, k, meeting, &s->node[k]);
  celd_free (meeting);
  return status;
}

/* Finds the pairs of ends where an arrow may pass; only two lines meet at a corner. */
static CeldStatus
find_passes (CeldHeadChoice *s)
{
  const CeldJoinedLines *lines = s->lines;
  CeldStatus             status = CELD_OK;

  for (size_t a = 0; a < 2 * lines->graph.n_lines; a++)
    for (size_t b = a + 1; b < 2 * lines->graph.n_lines && status == CELD_OK; b++)
      {
        bool   corner = s->node[celd_joined_node (lines, a)].n == 2;
        double turn, cost;

        if (a / 2 == b / 2 || celd_joined_node (lines, a) != celd_joined_node (lines, b))
          continue;
        turn = celd_joined_turn (lines, a, b);
        cost = pow (turn / (corner ? FREE_BEND : FREE_TURN), 2);
        if (turn <= (corner ? MOST_BEND : PASS_TURN))
          status = celd_append (s->pass, s->n_passes, s->pass_capacity, ((CeldArrowPass) { { a, b }, cost, false }));
      }
  return status;
}

/* ------------------------------------------------------------------ arrows */

/* The least length of a line that is an arrow, in widths: if other colours hide what two heads may be, room for both. */
static double
least_length (const CeldJoinedLines *lines, size_t k)
{
  return lines->hidden && !celd_joined_is_free (lines, 2 * k) && !celd_joined_is_free (lines, 2 * k + 1)
           ? 2 * CELD_HEAD_REACH : SHORTEST_ARROW;
}

/* Is a line long enough for an arrow, or a part of one that has its head elsewhere? */
static bool
is_long_enough (const CeldHeadChoice *s, size_t k)
{
  return (s->heads[s->chain[k]] && !s->marked[2 * k] && !s->marked[2 * k + 1]) ||
         celd_stroke_line_length (&s->lines->graph.line[k]) >= least_length (s->lines, k) * s->lines->graph.width;
}

/* Do lines end at a node that are not one arrow, with two heads, or too short for their head?  What is next to such a
 * line may be part of another arrow. */
static bool
is_near_doubt (const CeldHeadChoice *s, int node)
{
  for (size_t i = 0; i < 2 * s->lines->graph.n_lines; i++)
    if (celd_joined_node (s->lines, i) == node &&
        (s->heads[s->chain[i / 2]] > 1 || (s->heads[s->chain[i / 2]] && !is_long_enough (s, i / 2))))
      return true;
  return false;
}

/* Are the lines of an arrow clearly better than other choices? */
static bool
is_clear (const CeldHeadChoice *s, size_t chain)
{
  double least = s->lines->style == CELD_ARROW_DOT ? CLEAR_DOT : CLEAR_HEAD;

  for (size_t k = 0; k < s->lines->graph.n_lines; k++)
    if (s->chain[k] == chain &&
        (s->margin[k] < least || s->pass_margin[k] < CLEAR_PASS ||
         is_near_doubt (s, s->lines->graph.line[k].node[0]) || is_near_doubt (s, s->lines->graph.line[k].node[1])))
      return false;
  return true;
}

/* The outer end of an arrow that has a head, or the one that has none; NO_END if it is a ring. */
static size_t
outer_end (const CeldHeadChoice *s, size_t chain, bool marked)
{
  for (size_t i = 0; i < 2 * s->lines->graph.n_lines; i++)
    if (s->chain[i / 2] == chain && !s->passed[i] && s->marked[i] == marked)
      return i;
  return NO_END;
}

/* Do lines part at a node that lie on each other before it?  They end farther on. */
static bool
is_fork (const CeldHeadChoice *s, const CeldNodeMarks *node)
{
  for (int e = 0; e < node->n; e++)
    if (celd_joined_part_from (s->lines, node->end[e]))
      return true;
  return false;
}

/* How far a place is from the straight line on which an end is led on, in widths. */
static double
widths_off (const CeldHeadChoice *s, size_t end, CeldPoint place)
{
  CeldPoint from = celd_joined_led_from (s->lines, end), way = celd_joined_way (s->lines, end);

  return fabs ((place.x - from.x) * way.y - (place.y - from.y) * way.x) / s->lines->graph.width;
}

/* Does an end lead to a place, and do the others of its node, alone and together? */
static bool
leads_to (const CeldHeadChoice *s, size_t end, const CeldNodeMarks *node, CeldPoint place)
{
  CeldPoint meeting = celd_joined_meeting_point (s->lines, celd_joined_node (s->lines, end));
  double    squares = 0;

  if (node->n > 2 && s->lines->style == CELD_ARROW_HEAD &&
      celd_points_apart (meeting, place) > LINES_OFF * s->lines->graph.width)
    return false;
  for (int e = 0; e < node->n; e++)
    squares += pow (widths_off (s, node->end[e], place), 2);
  return node->n == 1 || (widths_off (s, end, place) <= MOST_OFF && squares <= node->n * MEAN_OFF * MEAN_OFF);
}

/* What a node may cost with a set of heads; or of dots, which are one. */
static double
most_rest (const CeldHeadChoice *s, const CeldNodeMarks *node, unsigned set)
{
  int heads = 0;

  for (int e = 0; e < node->n && s->lines->style == CELD_ARROW_HEAD; e++)
    heads += set >> e & 1 ? 1 : 0;
  return MOST_REST + (heads > 1 ? MORE_REST * (heads - 1) : 0);
}

/* Is a head too far behind its tip, where the paint is still wide? */
static bool
is_inside_head (const CeldJoinedLines *s, CeldPoint tip, unsigned set)
{
  return set && s->style == CELD_ARROW_HEAD && celd_joined_inside (s, tip) &&
         sqrt (s->mask.squared[celd_joined_pixel (s, tip)]) - 0.5 > TIP_RADIUS * s->graph.width;
}

/* Does nothing show where lines end that meet at a node?  Two go on almost straight there, or may just cross, or
 * part. */
static bool
is_on_the_way (const CeldHeadChoice *s, const CeldNodeMarks *node, unsigned set)
{
  return (node->n == 2 && !set && celd_joined_turn (s->lines, node->end[0], node->end[1]) < CORNER_JOIN) ||
         (!set && celd_joined_cross_at (s->lines, node->end[0])) || is_fork (s, node);
}

/* Is there paint of heads where many lines meet?  Else those that cross may look like them, if nothing is hidden. */
static bool
shows_heads (const CeldHeadChoice *s, const CeldNodeMarks *node, unsigned set)
{
  return !set || node->n <= 2 || s->lines->hidden || node->cost[0] >= LEAST_SHOWN;
}

/* Finds the place of an end; false if it is not apart from others, or if paint is there that nothing explains, or if the
 * lines there may go on. */
static bool
find_place (const CeldHeadChoice *s, size_t end, CeldPoint *place)
{
  const CeldNodeMarks *node = &s->node[celd_joined_node (s->lines, end)];
  unsigned             set = celd_head_choice_at (s, celd_joined_node (s->lines, end));

  if (!node->cost || node->cost[set] > most_rest (s, node, set) || !shows_heads (s, node, set) ||
      is_on_the_way (s, node, set) || celd_joined_widths_apart (s->lines, end) > CELD_MOST_APART)
    return false;
  *place = node->tip[set];
  return leads_to (s, end, node, *place) && !is_inside_head (s->lines, *place, set);
}

/* Is it clear that there is no head or dot at an end, if it is free?  One that other colours hide is not looked for. */
static bool
is_bare (const CeldHeadChoice *s, size_t end)
{
  const CeldNodeMarks *node = &s->node[celd_joined_node (s->lines, end)];
  CeldPoint            tip = node->tip[0];

  return node->n > 1 || (!celd_joined_is_at_frame (s->lines, tip) &&
                         (celd_joined_hidden_share (s->lines, tip, OTHERS * s->lines->graph.width) > 0 ||
                          node->cost[0] + BARE_MARGIN <= node->cost[1]));
}

/* Are all lines of an arrow long enough? */
static bool
has_room (const CeldHeadChoice *s, size_t chain)
{
  for (size_t k = 0; k < s->lines->graph.n_lines; k++)
    if (s->chain[k] == chain && !is_long_enough (s, k))
      return false;
  return true;
}

/* Are they without other paint on them or along them? */
static bool
is_alone (const CeldHeadChoice *s, size_t chain)
{
  const CeldJoinedLines *lines = s->lines;

  for (size_t k = 0; k < lines->graph.n_lines; k++)
    if (s->chain[k] == chain &&
        (celd_joined_is_wide (lines, k) ||
         !celd_joined_is_alone (lines, k, (size_t) (CELD_NODE_REACH * lines->graph.width))))
      return false;
  return true;
}

/* Finds the ends of the arrow of a chain of lines, or why it has none. */
static CeldArrowReason
find_ends (const CeldHeadChoice *s, size_t chain, CeldPoint *marked, CeldPoint *bare)
{
  size_t head = outer_end (s, chain, true), tail = outer_end (s, chain, false);

  if (s->heads[chain] != 1)
    return CELD_REASON_ALIKE;
  if (head == NO_END || tail == NO_END || !is_clear (s, chain))
    return CELD_REASON_MEETING;
  if (!has_room (s, chain))
    return CELD_REASON_SHORT;
  if (!is_alone (s, chain) || !find_place (s, head, marked) || !find_place (s, tail, bare))
    return CELD_REASON_MEETING;
  if (!is_bare (s, tail))
    return celd_joined_is_at_frame (s->lines, *bare) ? CELD_REASON_FRAME : CELD_REASON_ALIKE;
  return CELD_REASON_NONE;
}

/* The arrow of a chain of lines.  A head is the farther end, a dot the nearer one. */
static CeldLineArrow
arrow_of (const CeldHeadChoice *s, size_t chain)
{
  bool          dot = s->lines->style == CELD_ARROW_DOT;
  CeldPoint     marked = { 0, 0 }, bare = { 0, 0 };
  CeldLineArrow arrow = { .first = chain };

  arrow.unclear = find_ends (s, chain, &marked, &bare);
  arrow.nearer  = dot ? marked : bare;
  arrow.farther = dot ? bare : marked;
  return arrow;
}

static CeldStatus
choice_new (CeldJoinedLines *lines, CeldHeadChoice *s)
{
  size_t n = lines->graph.n_lines;

  *s = (CeldHeadChoice) {
    .lines  = lines,
    .node   = celd_alloc0 (lines->graph.n_nodes, sizeof *s->node),
    .marked = celd_alloc0 (2 * n, sizeof *s->marked),
    .passed = celd_alloc0 (2 * n, sizeof *s->passed),
    .chain  = celd_alloc0 (n, sizeof *s->chain),
    .heads  = celd_alloc0 (n, sizeof *s->heads),
    .margin = celd_alloc0 (n, sizeof *s->margin),
    .pass_margin = celd_alloc0 (n, sizeof *s->pass_margin),
    .short_line = celd_alloc0 (n, sizeof *s->short_line),
  };
  return s->node && s->marked && s->passed && s->chain && s->heads && s->margin && s->pass_margin &&
         s->short_line ? CELD_OK : CELD_NO_MEMORY;
}

static void
choice_clear (CeldHeadChoice *s)
{
  for (size_t k = 0; s->node && k < s->lines->graph.n_nodes; k++)
    {
      celd_free (s->node[k].cost);
      celd_free (s->node[k].tip);
    }
  celd_free (s->node);
  celd_free (s->pass);
  celd_free (s->marked);
  celd_free (s->passed);
  celd_free (s->chain);
  celd_free (s->heads);
  celd_free (s->margin);
  celd_free (s->pass_margin);
  celd_free (s->short_line);
}

CeldStatus
celd_joined_heads_read (CeldJoinedLines *lines, CeldLineArrow **arrows)
{
  CeldHeadChoice s;
  CeldStatus     status = choice_new (lines, &s);

  *arrows = celd_alloc0 (lines->graph.n_lines, sizeof **arrows);
  if (!*arrows)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_joined_leads_find (lines);
  if (status == CELD_OK)
    status = find_node_marks (&s);
  if (status == CELD_OK)
    status = find_passes (&s);
  if (status == CELD_OK)
    status = celd_head_choice_find (&s);
  for (size_t k = 0; k < lines->graph.n_lines && status == CELD_OK; k++)
    (*arrows)[k] = s.chain[k] == k ? arrow_of (&s, k) : (CeldLineArrow) { .first = s.chain[k] };
  choice_clear (&s);
  return status;
}
