/* Where the ends of lines that fade or taper are.
 *
 * Lines are led on straight to where most of those of a node meet, because thinned paint ends where strokes part, and
 * cuts corners.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define OFF         1   /* from a line, and a pixel more, to where it meets others, at most, ... */
#define MOVED       5.5 /* ... and from there to their node */
#define KEPT        0.7 /* part of the lines of a node that meet, at least */
#define IN_LINE     0.6 /* radians by which two lines turn, at most, where the way along them decides */
#define LEAST_OUTER 1.6 /* radians by which arrows would turn from line to line, if all lead away from a place */
#define ALONG_FRAME 3   /* of a line at the frame of the picture, at most */

/* How far a line that is led on straight passes from a place; 1 is the most. */
static double
off_line (const CeldJoinedLines *s, size_t end, CeldPoint place)
{
  CeldPoint from = celd_joined_led_from (s, end), way = celd_joined_way (s, end);

  return fabs ((place.x - from.x) * way.y - (place.y - from.y) * way.x) / (OFF * s->graph.width + 1);
}

/* Where lines of a node meet that are led on straight, without those that pass far from there, which may be bent.
 * *kept: the part of the lines that meet there. */
static CeldPoint
meeting_point (const CeldJoinedLines *s, size_t end, double *kept)
{
  int          node = celd_joined_node (s, end);
  CeldPoint    place = celd_joined_meeting_point (s, node);
  CeldLineSums sums = { 0 };
  int          n = 0, near = 0;

  for (size_t i = 0; i < 2 * s->graph.n_lines; i++)
    if (celd_joined_node (s, i) == node)
      {
        n++;
        if (off_line (s, i, place) <= 1)
          celd_line_sums_add (&sums, celd_joined_led_from (s, i), celd_joined_way (s, i), 1);
      }
  place = celd_line_sums_point (&sums, s->graph.node[node].at);
  for (size_t i = 0; i < 2 * s->graph.n_lines; i++)
    near += celd_joined_node (s, i) == node && off_line (s, i, place) <= 1;
  *kept = off_line (s, end, place) <= 1 ? (double) near / n : 0;
  return place;
}

/* How far paint goes on from a place in a direction, but for the half of a round end. */
static double
paint_ahead (const CeldJoinedLines *s, CeldPoint place, CeldPoint way)
{
  double d = 0, most = way.x * way.x + way.y * way.y > 0 ? s->mask.width + s->mask.height : 0;

  while (d < most && celd_joined_painted (s, celd_moved (place, way, d + 1)))
    d++;
  return fmax (0, d - 0.5 * s->graph.width);
}

/* Do all lines of a node lead away from it in about one direction? */
static bool
is_outer (const CeldJoinedLines *s, int node)
{
  for (size_t i = 0; i < 2 * s->graph.n_lines; i++)
    for (size_t k = 0; k < i && celd_joined_node (s, i) == node; k++)
      if (celd_joined_node (s, k) == node && celd_joined_turn (s, i, k) < LEAST_OUTER)
        return false;
  return true;
}

/* A place where lines meet that all lead away from it, or farther out: as far as the paint of one of them goes on. */
static CeldPoint
outermost (const CeldJoinedLines *s, int node, CeldPoint place)
{
  CeldPoint farthest = place;
  double    most = 0;

  for (size_t i = 0; i < 2 * s->graph.n_lines && is_outer (s, node); i++)
    if (celd_joined_node (s, i) == node)
      {
        CeldPoint way = celd_joined_way (s, i), on = { -way.x, -way.y };
        double    ahead = paint_ahead (s, place, on);

        if (ahead > most)
          {
            most     = ahead;
            farthest = celd_moved (place, on, ahead);
          }
      }
  return farthest;
}

bool
celd_joined_runs_along_frame (const CeldJoinedLines *s, size_t k)
{
  size_t n = 0;

  for (size_t i = 0; i < s->graph.line[k].n; i++)
    n += celd_joined_is_at_frame (s, s->graph.line[k].at[i]);
  return (double) n > ALONG_FRAME * s->graph.width;
}

/* Does another line go on about straight from an end?  Then where they would meet says nothing. */
static bool
is_in_line (const CeldJoinedLines *s, size_t end)
{
  for (size_t i = 0; i < 2 * s->graph.n_lines; i++)
    if (i != end && celd_joined_node (s, i) == celd_joined_node (s, end) && celd_joined_turn (s, end, i) < IN_LINE)
      return true;
  return false;
}

bool
celd_joined_place (const CeldJoinedLines *s, size_t end, CeldPoint *place)
{
  int       node = celd_joined_node (s, end);
  CeldPoint meeting;
  double    kept;

  *place = s->graph.node[node].at;
  if (s->graph.node[node].vague)
    return false;
  if (celd_joined_is_free (s, end))
    return !celd_joined_is_at_frame (s, *place);
  if (s->graph.node[node].tip)
    return true;
  meeting = meeting_point (s, end, &kept);
  if (celd_joined_lines_at (s, end) == 2 && (kept < KEPT || is_in_line (s, end)))
    return true;
  if (kept < KEPT || celd_joined_widths_apart (s, end) > CELD_MOST_SHARED || !celd_joined_is_led_to (s, end, meeting) ||
      celd_points_apart (*place, meeting) > MOVED * s->graph.width || (s->hidden && s->graph.node[node].branched))
    return false;
  *place = outermost (s, node, meeting);
  return true;
}
