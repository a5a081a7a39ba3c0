/* Where the lines of a graph of paint meet.
 *
 * Thinned paint near a node follows heads and what else is there.  The lines are therefore led on straight from some
 * distance, and the branches that were removed are lines that lead to the node, too.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define FROM_NODE    2    /* from a node where the direction of a line is measured, ... */
#define TO_NODE      5    /* ... to here, ... */
#define TO_MORE      4    /* ... and pixels more */
#define LEAD_SAMPLES 20   /* of the way from a line to a node, ... */
#define LEAD_LEAST   0.75 /* ... of which at least so much is painted */
#define LEAST_APART  1.3  /* from where lines meet to where each is alone */

bool
celd_joined_is_free (const CeldJoinedLines *lines, size_t end)
{
  int n = 0;

  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    n += celd_joined_node (lines, i) == celd_joined_node (lines, end);
  return n == 1;
}

size_t
celd_joined_lead (const CeldJoinedLines *lines, size_t end)
{
  return (size_t) fmin (FROM_NODE * lines->graph.width, 0.3 * (double) lines->graph.line[end / 2].n);
}

CeldPoint
celd_joined_point (const CeldJoinedLines *lines, size_t end, double steps)
{
  const CeldStrokeLine *line = &lines->graph.line[end / 2];
  size_t                i = (size_t) fmin (steps, (double) (line->n - 1));

  return line->at[end % 2 ? line->n - 1 - i : i];
}

CeldPoint
celd_joined_led_from (const CeldJoinedLines *lines, size_t end)
{
  return celd_joined_point (lines, end, (double) celd_joined_lead (lines, end));
}

CeldPoint
celd_joined_way (const CeldJoinedLines *lines, size_t end)
{
  double    far = fmin (TO_NODE * lines->graph.width + TO_MORE, 0.7 * (double) lines->graph.line[end / 2].n);
  CeldPoint a = celd_joined_point (lines, end, far * FROM_NODE / TO_NODE), b = celd_joined_point (lines, end, far);
  double    length = fmax (1e-9, hypot (b.x - a.x, b.y - a.y));

  return (CeldPoint) { (b.x - a.x) / length, (b.y - a.y) / length };
}

double
celd_joined_turn (const CeldJoinedLines *lines, size_t a, size_t b)
{
  CeldPoint u = celd_joined_way (lines, a), v = celd_joined_way (lines, b);

  return CELD_PI - acos (fmin (1, fmax (-1, u.x * v.x + u.y * v.y)));
}

CeldPoint
celd_joined_meeting_point (const CeldJoinedLines *lines, int node)
{
  CeldLineSums sums = lines->graph.node[node].branches;

  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == node)
      celd_line_sums_add (&sums, celd_joined_led_from (lines, i), celd_joined_way (lines, i), 1);
  return celd_line_sums_point (&sums, lines->graph.node[node].at);
}

bool
celd_joined_is_led_to (const CeldJoinedLines *lines, int node, CeldPoint place)
{
  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (celd_joined_node (lines, i) == node)
      {
        CeldPoint from = celd_joined_led_from (lines, i);
        int       painted = 0;

        for (int k = 0; k < LEAD_SAMPLES; k++)
          {
            double t = (k + 0.5) / LEAD_SAMPLES;

            painted += celd_joined_painted (lines, (CeldPoint) { from.x + t * (place.x - from.x),
                                                                 from.y + t * (place.y - from.y) });
          }
        if (painted < LEAD_LEAST * LEAD_SAMPLES)
          return false;
      }
  return true;
}

double
celd_widths_apart (CeldPoint u, CeldPoint v)
{
  double half = 0.5 * atan2 (fabs (u.x * v.y - u.y * v.x), u.x * v.x + u.y * v.y);

  return fmax (LEAST_APART, 0.5 + 0.5 / tan (half));
}

double
celd_joined_widths_apart (const CeldJoinedLines *lines, size_t end)
{
  double most = 0;

  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (i != end && celd_joined_node (lines, i) == celd_joined_node (lines, end))
      most = fmax (most, celd_widths_apart (celd_joined_way (lines, i), celd_joined_way (lines, end)));
  return most;
}
