/* Where arrows that fade or taper go on from one line to another, and where that is in doubt.
 *
 * An arrow passes a node if two lines go straight on there with the same value, each of which is likelier than others;
 * and a short line between crossings of which nothing is known.  An end that passes no node is in doubt if a line is
 * straight on that may be more of its arrow, or if what seems to end there may go on a little beyond.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; values are parts of the largest one of the connected paint. */
#define STRAIGHT        0.5 /* radians by which an arrow may turn where it passes others */
#define LIKELIER        0.2 /* radians by which a way on must be straighter than another one */
#define OTHER           0.2 /* between values of different arrows, at least */
#define WEAK_TIP        0.5 /* of a tip, at most, if another line is straight on: a stronger arrow goes on, ... */
#define STRONG_TAIL     0.6 /* ... and one that is weaker than this does not begin there */
#define STRONG_TIP      0.5 /* of two tips that meet, at least, if they do not end there */
#define LONGEST_UNKNOWN 10  /* widths of a line of which nothing is known and which an arrow may pass */
#define HUB             4   /* ends at one place, at least, that show by themselves that arrows end there */
#define TURNED_ASIDE    1.2 /* radians by which a line turns that does not go on from one that others cross */

/* Does an arrow that goes on from one end to another of its node hardly turn there?  *turn: by how much it does. */
static bool
is_straight (const CeldProfileReading *r, size_t a, size_t b, double *turn)
{
  if (a == b || celd_joined_node (r->lines, a) != celd_joined_node (r->lines, b))
    return false;
  *turn = celd_joined_turn (r->lines, a, b);
  return *turn < STRAIGHT;
}

/* May both ends be of one arrow, by their directions? */
static bool
may_pass (const CeldProfileReading *r, size_t a, size_t b)
{
  return !(celd_is_tip (r, a) && celd_is_tip (r, b)) && !(celd_is_tail (r, a) && celd_is_tail (r, b));
}

/* Is a line so short that nothing is known of it, as between crossings? */
static bool
is_gap (const CeldProfileReading *r, size_t end)
{
  return !r->profile[end / 2].known &&
         celd_stroke_line_length (&r->lines->graph.line[end / 2]) < LONGEST_UNKNOWN * r->lines->graph.width;
}

/* Have both ends the same value, or, with `gaps`, is one of a gap? */
static bool
may_be_same (const CeldProfileReading *r, size_t a, size_t b, bool gaps)
{
  if (gaps)
    return is_gap (r, a) || is_gap (r, b);
  return r->profile[a / 2].known && r->profile[b / 2].known &&
         fabs (celd_value_at (r, a) - celd_value_at (r, b)) <= CELD_SAME_VALUE;
}

/* The end at which the arrow of another end is likeliest to go on; CELD_NO_END = at none. */
static size_t
likeliest (CeldProfileReading *r, size_t end, bool gaps)
{
  size_t best = CELD_NO_END;
  double least = INFINITY, turn;

  for (size_t i = 0; i < 2 * r->lines->graph.n_lines; i++)
    {
      if (r->next[i] != CELD_NO_END || !is_straight (r, end, i, &turn) || !may_pass (r, end, i) ||
          !may_be_same (r, end, i, gaps))
        continue;
      if (fabs (turn - least) < LIKELIER)
        r->doubt[end] = true;
      if (turn < least)
        {
          least = turn;
          best  = i;
        }
    }
  return best;
}

/* Is a value one that an arrow has on its way, but hardly where it begins or ends? */
static bool
is_between (const CeldProfileReading *r, size_t end)
{
  return (celd_is_tip (r, end) && celd_value_at (r, end) > WEAK_TIP) ||
         (celd_is_tail (r, end) && celd_value_at (r, end) < STRONG_TAIL);
}

/* Are two tips so strong that they do not end there?  Arrows of opposite directions that lie on each other look so. */
static bool
lie_on_each_other (const CeldProfileReading *r, size_t a, size_t b)
{
  return celd_is_tip (r, a) && celd_is_tip (r, b) && fmax (celd_value_at (r, a), celd_value_at (r, b)) > STRONG_TIP;
}

/* May the arrow of an end that does not pass go on at another one after all, by its value, or by that one's? */
static bool
may_go_on (const CeldProfileReading *r, size_t end)
{
  double value = celd_value_at (r, end), turn;
  bool   two = celd_joined_lines_at (r->lines, end) == 2;

  for (size_t i = 0; i < 2 * r->lines->graph.n_lines; i++)
    if (is_straight (r, end, i, &turn) &&
        (!r->profile[i / 2].known || (!two && is_between (r, end)) || (two && lie_on_each_other (r, end, i)) ||
         (r->next[i] == CELD_NO_END && may_pass (r, end, i) && fabs (value - celd_value_at (r, i)) < OTHER)))
      return true;
  return false;
}

/* Does another arrow pass where an end is?  What seems to end there may go on a little beyond, but hardly if many do. */
static bool
is_crossed (const CeldProfileReading *r, size_t end)
{
  bool crossed = false, on = false;
  int  ends = 1;

  for (size_t i = 0; i < 2 * r->lines->graph.n_lines; i++)
    if (i != end && celd_joined_node (r->lines, i) == celd_joined_node (r->lines, end))
      {
        crossed |= r->next[i] != CELD_NO_END;
        ends += r->next[i] == CELD_NO_END;
        on |= celd_joined_turn (r->lines, end, i) < TURNED_ASIDE;
      }
  return crossed && on && ends < HUB;
}

bool
celd_joined_meets_doubt (const CeldProfileReading *r, size_t end)
{
  double turn;

  for (size_t i = 0; i < 2 * r->lines->graph.n_lines; i++)
    if (is_straight (r, end, i, &turn) && r->doubt[i] && r->next[i] == CELD_NO_END && may_pass (r, end, i))
      return true;
  return false;
}

/* Finds passes of ends that have none yet: of two that are each other's likeliest. */
static CeldStatus
find_likeliest (CeldProfileReading *r, bool gaps)
{
  size_t  n = 2 * r->lines->graph.n_lines;
  size_t *best = celd_alloc (n, sizeof *best);

  if (!best)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < n; i++)
    best[i] = r->next[i] == CELD_NO_END ? likeliest (r, i, gaps) : CELD_NO_END;
  for (size_t i = 0; i < n; i++)
    if (best[i] != CELD_NO_END && best[best[i]] == i)
      r->next[i] = best[i];
    else if (best[i] != CELD_NO_END && !gaps)
      r->doubt[i] = true;
  celd_free (best);
  return CELD_OK;
}

/* Lines that lie on each other part at a node: no arrow begins or ends there. */
static void
doubt_node (CeldProfileReading *r, int node)
{
  for (size_t i = 0; i < 2 * r->lines->graph.n_lines; i++)
    r->doubt[i] |= celd_joined_node (r->lines, i) == node;
}

CeldStatus
celd_joined_passes_find (CeldProfileReading *r)
{
  size_t     n = 2 * r->lines->graph.n_lines;
  CeldStatus status;

  for (size_t i = 0; i < n; i++)
    r->next[i] = CELD_NO_END;
  status = find_likeliest (r, false);
  if (status == CELD_OK)
    status = find_likeliest (r, true);
  for (size_t i = 0; i < n; i++)
    if (r->next[i] == CELD_NO_END)
      r->doubt[i] |= may_go_on (r, i) || is_crossed (r, i);
  for (size_t i = 0; i < n; i++)
    if (celd_joined_part_from (r->lines, i))
      doubt_node (r, celd_joined_node (r->lines, i));
  return status;
}
