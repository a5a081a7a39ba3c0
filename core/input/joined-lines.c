/* Where the lines of a graph of paint meet.
 *
 * Thinned paint near a node follows heads and what else is there.  The lines are therefore led on straight from some
 * distance, and the branches that were removed are lines that lead to the node, too.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define FROM_NODE    2    /* from a node where the direction of a line is measured, ... */
#define TO_NODE      5    /* ... to here, ... */
#define TO_MORE      4    /* ... and pixels more */
#define FROM_MOST    8    /* the same where a line is not alone before, ... */
#define ALONE        1.2  /* ... because the paint is wider than so many widths of the line, ... */
#define ALONE_MORE   0.5  /* ... and pixels more */
#define LEAD_SAMPLES 20   /* of the way from a line to a node, ... */
#define LEAD_OFF     0.1  /* ... or near paint, ... */
#define LEAD_LEAST   0.75 /* ... of which at least so much is painted */
#define PARTING      0.7  /* radians by which lines turn that part, at most */
#define CROSS_TURN   0.5  /* radians by which lines turn that only cross at a node */
#define LEAST_APART  1.3  /* from where lines meet to where each is alone */
#define TWO_WIDE     1.3  /* times the width of most lines that two have which lie on each other */

size_t
celd_joined_lines_at (const CeldJoinedLines *lines, size_t end)
{
  size_t n = 0;

  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    n += celd_joined_node (lines, i) == celd_joined_node (lines, end);
  return n;
}

bool
celd_joined_is_free (const CeldJoinedLines *lines, size_t end)
{
  return celd_joined_lines_at (lines, end) == 1;
}

bool
celd_joined_part_from (const CeldJoinedLines *lines, size_t end)
{
  for (size_t i = 0; i < 2 * lines->graph.n_lines; i++)
    if (i != end && celd_joined_node (lines, i) == celd_joined_node (lines, end) &&
        celd_joined_turn (lines, end, i) > PARTING)
      return false;
  return celd_joined_lines_at (lines, end) > 2;
}

bool
celd_joined_is_at_frame (const CeldJoinedLines *s, CeldPoint place)
{
  double x = place.x + s->mask.left, y = place.y + s->mask.top, reach = s->graph.width + 1;

  return fmin (x, y) < reach || x > s->stroke->width - reach || y > s->stroke->height - reach;
}

double
celd_joined_width (const CeldJoinedLines *lines, size_t k)
{
  const CeldStrokeLine *line = &lines->graph.line[k];
  double                sum = 0;
  size_t                from = line->n / 4, to = line->n - from;

  for (size_t i = from; i < to; i++)
    sum += 2 * sqrt (lines->mask.squared[celd_joined_pixel (lines, line->at[i])]) - 1;
  return sum / (double) (to - from);
}

CeldPoint
celd_joined_point (const CeldJoinedLines *lines, size_t end, double steps)
{
  const CeldStrokeLine *line = &lines->graph.line[end / 2];
  size_t                i = (size_t) fmin (steps, (double) (line->n - 1));

  return line->at[end % 2 ? line->n - 1 - i : i];
}

/* The first point of a line, from an end, where it is as narrow as elsewhere for a width: where it is alone. */
static size_t
first_alone (const CeldJoinedLines *lines, size_t end)
{
  double width = lines->graph.width, n = (double) lines->graph.line[end / 2].n, run = 0;
  double least = fmin (FROM_NODE * width, 0.3 * n), most = fmin (FROM_MOST * width, 0.3 * n);
  double narrow = 0.5 * ALONE * celd_joined_width (lines, end / 2) + ALONE_MORE;

  for (double i = floor (least); i < most; i++)
    {
      double radius = sqrt (lines->mask.squared[celd_joined_pixel (lines, celd_joined_point (lines, end, i))]) - 0.5;

      run = radius <= narrow ? run + 1 : 0;
      if (run >= width)
        return (size_t) (i + 1 - run);
    }
  return (size_t) least;
}

CeldStatus
celd_joined_leads_find (CeldJoinedLines *lines)
{
  size_t *lead = celd_alloc (2 * lines->graph.n_lines, sizeof *lead);

  for (size_t i = 0; lead && i < 2 * lines->graph.n_lines; i++)
    lead[i] = first_alone (lines, i);
  lines->lead = lead;
  return lead ? CELD_OK : CELD_NO_MEMORY;
}

size_t
celd_joined_lead (const CeldJoinedLines *lines, size_t end)
{
  return lines->lead ? lines->lead[end]
                     : (size_t) fmin (FROM_NODE * lines->graph.width, 0.3 * (double) lines->graph.line[end / 2].n);
}

CeldPoint
celd_joined_led_from (const CeldJoinedLines *lines, size_t end)
{
  return celd_joined_point (lines, end, (double) celd_joined_lead (lines, end));
}

CeldPoint
celd_joined_way (const CeldJoinedLines *lines, size_t end)
{
  double    most = 0.7 * (double) lines->graph.line[end / 2].n;
  double    far = fmin (TO_NODE * lines->graph.width + TO_MORE, most), near = far * FROM_NODE / TO_NODE;
  double    more = lines->lead ? fmax (0, (double) lines->lead[end] - near) : 0;
  CeldPoint a = celd_joined_point (lines, end, near + more);
  CeldPoint b = celd_joined_point (lines, end, fmin (far + more, most));
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
celd_joined_cross_at (const CeldJoinedLines *lines, size_t end)
{
  int node = celd_joined_node (lines, end), straight = 0;

  for (size_t a = 0; a < 2 * lines->graph.n_lines; a++)
    for (size_t b = a + 1; b < 2 * lines->graph.n_lines && celd_joined_node (lines, a) == node; b++)
      straight += celd_joined_node (lines, b) == node && celd_joined_turn (lines, a, b) < CROSS_TURN;
  return celd_joined_lines_at (lines, end) == 4 && straight >= 2;
}

/* Is paint at a point, or near it?  Thin tips are hardly wider than a pixel. */
static bool
is_near_paint (const CeldJoinedLines *lines, CeldPoint p)
{
  double r = 1 + LEAD_OFF * lines->graph.width;

  for (double y = -r; y <= r; y += r)
    for (double x = -r; x <= r; x += r)
      if (celd_joined_painted (lines, (CeldPoint) { p.x + x, p.y + y }))
        return true;
  return false;
}

bool
celd_joined_is_led_to (const CeldJoinedLines *lines, size_t end, CeldPoint place)
{
  CeldPoint from = celd_joined_led_from (lines, end);
  int       painted = 0;

  for (int k = 0; k < LEAD_SAMPLES; k++)
    {
      double    t = (k + 0.5) / LEAD_SAMPLES;
      CeldPoint p = { from.x + t * (place.x - from.x), from.y + t * (place.y - from.y) };

      painted += is_near_paint (lines, p);
    }
  return painted >= LEAD_LEAST * LEAD_SAMPLES;
}

bool
celd_joined_is_wide (const CeldJoinedLines *lines, size_t k)
{
  size_t narrow = 0;

  for (size_t i = 0; i < lines->graph.n_lines; i++)
    narrow += TWO_WIDE * celd_joined_width (lines, i) < celd_joined_width (lines, k);
  return 2 * narrow > lines->graph.n_lines;
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
