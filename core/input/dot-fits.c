/* Whether there is a dot where lines meet or end.
 *
 * The paint is wider there than its lines alone would be: many that meet look like a disc, too.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

/* All chosen; lengths are widths of the paint. */
#define DOT_FREE     3    /* from a free end to the middle of its dot, at most, ... */
#define DOT_HUB      1.5  /* ... and from where lines meet */
#define DOT_LEAST    0.95 /* radius of a dot */
#define NO_DOT       0.8  /* radius of the paint where there is none, ... */
#define NO_DOT_LINES 1.1  /* ... and how many times that of the lines alone; ... */
#define DOT_MORE     0.2  /* ... by which the radius of a dot is larger */
#define DOT_SLACK    0.5  /* pixels more than the width of a line, which is known no better */
#define LINE_SEEN    4    /* beyond which a line is of no interest where it meets others */
#define DOT_COST     3    /* of a dot that is not there, or of none where there is one */
#define DOT_HIDDEN   2    /* from an end without a dot to where paint of other colours may hide one */
#define MOST_HIDDEN  0.5  /* part of a dot; of one of which more is hidden, ... */
#define LEAST_RING   1    /* ... so many square widths beside its line are seen */
#define DOT_EDGE     1.5  /* pixels beyond the radius of a dot that belong to it */

/* The widest place of the paint within `reach` pixels of a point; *radius: of the paint there. */
static CeldPoint
widest_place (const CeldJoinedLines *s, CeldPoint near, double reach, double *radius)
{
  CeldPoint widest = near;

  *radius = 0;
  for (double y = near.y - reach; y <= near.y + reach; y++)
    for (double x = near.x - reach; x <= near.x + reach; x++)
      {
        CeldPoint p = { x, y };
        double    r = celd_joined_inside (s, p) ? sqrt (s->mask.squared[celd_joined_pixel (s, p)]) - 0.5 : 0;

        if (r > *radius && celd_points_apart (p, near) <= reach)
          {
            *radius = r;
            widest  = p;
          }
      }
  return widest;
}

/* Pixel i of a square of some side round a place. */
static CeldPoint
square_point (CeldPoint middle, size_t side, size_t i)
{
  return (CeldPoint) { middle.x + (double) (i % side) + 0.5 - 0.5 * (double) side,
                       middle.y + (double) (i / side) + 0.5 - 0.5 * (double) side };
}

/* Which pixels of a square round a place the lines of a node leave bare. */
static void
find_bare (const CeldJoinedLines *s, const CeldNodeMarks *node, CeldPoint meeting, size_t side, uint8_t *bare)
{
  memset (bare, 1, side * side);
  for (int e = 0; e < node->n; e++)
    {
      CeldPoint from = celd_joined_led_from (s, node->end[e]);
      double    half = 0.5 * (celd_joined_width (s, node->end[e] / 2) + DOT_SLACK);

      from = celd_moved (from, celd_joined_way (s, node->end[e]), LINE_SEEN * s->graph.width);
      for (size_t i = 0; i < side * side; i++)
        if (celd_distance_to_part (square_point (meeting, side, i), from, meeting) <= half)
          bare[i] = false;
    }
}

/* The radius of the paint at its widest place within `reach` pixels of where lines meet, if there were only lines. */
static CeldStatus
widest_of_lines (const CeldJoinedLines *s, const CeldNodeMarks *node, CeldPoint meeting, double reach, double *radius)
{
  size_t     side = 2 * (size_t) ceil (reach + 2 * s->graph.width) + 1, n = side * side;
  uint8_t   *bare = celd_alloc (n, sizeof *bare);
  int32_t   *squared = celd_alloc (n, sizeof *squared);
  CeldStatus status = bare && squared ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      find_bare (s, node, meeting, side, bare);
      status = celd_distance ((int) side, (int) side, bare, NULL, squared);
    }
  *radius = 0;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    if (celd_points_apart (square_point (meeting, side, i), meeting) <= reach)
      *radius = fmax (*radius, sqrt (squared[i]) - 0.5);
  celd_free (bare);
  celd_free (squared);
  return status;
}

/* The width of the widest line of a node. */
static double
widest_line (const CeldJoinedLines *s, const CeldNodeMarks *node)
{
  double width = 0;

  for (int e = 0; e < node->n; e++)
    width = fmax (width, celd_joined_width (s, node->end[e] / 2) + DOT_SLACK);
  return width;
}

/* Is a dot seen where the paint has some radius, and the lines alone would have another one?  From 0, no, to 1, yes. */
static double
is_seen (const CeldJoinedLines *s, const CeldNodeMarks *node, double radius, double lines)
{
  double width = widest_line (s, node), none = fmax (NO_DOT * width, NO_DOT_LINES * lines);
  double dot = fmax (DOT_LEAST * width, none + DOT_MORE * width);

  return fmin (1, fmax (0, (radius - none) / (dot - none)));
}

/* It is where the paint is widest, or if other colours hide that, where there is paint beside the line.  Else one that is
 * hidden may be there or not. */
CeldStatus
celd_dot_find (const CeldJoinedLines *s, CeldPoint meeting, CeldPaintWindow *w, CeldNodeMarks *marks)
{
  double     reach = (marks->n == 1 ? DOT_FREE : DOT_HUB) * s->graph.width, weight = DOT_COST, radius, lines, seen, hidden;
  CeldPoint  middle = widest_place (s, meeting, reach, &radius);
  CeldStatus status = widest_of_lines (s, marks, meeting, reach, &lines);

  if (status != CELD_OK)
    return status;
  seen = is_seen (s, marks, radius, lines);
  if (seen < 0.5)
    middle = marks->tip[0];
  celd_window_lead (s, marks, middle, w);
  hidden = celd_joined_hidden_share (s, middle, seen < 0.5 ? DOT_HIDDEN * s->graph.width : radius);
  if (hidden > (seen < 0.5 ? 0 : MOST_HIDDEN))
    {
      if (celd_window_rest (w, middle, 0, DOT_FREE * s->graph.width) >= LEAST_RING)
        {
          seen   = 1;
          radius = DOT_FREE * s->graph.width;
        }
      else
        weight = 0;
    }
  for (unsigned set = 0; set < 1u << marks->n; set++)
    {
      marks->cost[set] = weight * (set ? 1 - seen : seen) + celd_window_rest (w, middle, radius + DOT_EDGE, INFINITY);
      marks->tip[set]  = middle;
    }
  return CELD_OK;
}
