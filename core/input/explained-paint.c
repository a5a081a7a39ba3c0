/* The paint of joined lines that is explained: that of the lines, and what other colours hide.
 *
 * Paint that nothing explains may be of another arrow, so that what is beside it is unclear.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/joined-arrows.h"

#include <math.h>
#include <string.h>

/* All chosen; lengths are widths of the paint. */
#define EDGE_MORE  1.5 /* pixels more than the radius of a wide line that belong to it */
#define REST_ALONG 2.5 /* from the middle of a line, where no other paint may be, ... */
#define MOST_ALONG 1   /* ... but so many square widths */

static void
explain_hidden (const CeldJoinedLines *s)
{
  size_t n = (size_t) s->mask.width * (size_t) s->mask.height;

  if (s->hidden)
    memcpy (s->explained, s->hidden, n);
  else
    memset (s->explained, 0, n);
}

/* Row by row: discs along a broad line are many and large. */
static void
explain_disc (const CeldJoinedLines *s, CeldPoint c, double r)
{
  for (int y = (int) fmax (0, ceil (c.y - r - 0.5)); y + 0.5 <= c.y + r && y < s->mask.height; y++)
    {
      double half = sqrt (fmax (0, r * r - (y + 0.5 - c.y) * (y + 0.5 - c.y)));
      int    left = (int) fmax (0, ceil (c.x - half - 0.5)), end = (int) fmin (s->mask.width, floor (c.x + half + 0.5));

      if (left < end)
        memset (s->explained + (size_t) y * (size_t) s->mask.width + left, 1, (size_t) (end - left));
    }
}

/* Marks the paint of a straight line as explained. */
static void
explain (const CeldJoinedLines *s, CeldPoint from, CeldPoint to)
{
  double r = CELD_LINE_BODY * s->graph.width + 1, length = hypot (to.x - from.x, to.y - from.y);

  for (double d = 0; d <= length; d += 0.5)
    explain_disc (s, (CeldPoint) { from.x + (to.x - from.x) * d / fmax (length, 1),
                                   from.y + (to.y - from.y) * d / fmax (length, 1) }, r);
}

void
celd_joined_explain_lines (const CeldJoinedLines *s)
{
  explain_hidden (s);
  for (size_t k = 0; k < s->graph.n_lines; k++)
    {
      const CeldStrokeLine *line = &s->graph.line[k];
      size_t                skip = celd_joined_lead (s, 2 * k);

      for (size_t i = skip; i + skip + 1 < line->n; i++)
        explain (s, line->at[i], line->at[i + 1]);
    }
}

static void
explain_wide_disc (const CeldJoinedLines *s, CeldPoint c)
{
  if (celd_joined_inside (s, c))
    explain_disc (s, c, sqrt (s->mask.squared[celd_joined_pixel (s, c)]) + EDGE_MORE);
}

/* Marks paint between a line and the place where it meets others. */
static void
explain_led (const CeldJoinedLines *s, CeldPoint from, CeldPoint place)
{
  double n = ceil (celd_points_apart (from, place) + 1);

  for (double i = 0; i <= n; i++)
    explain_wide_disc (s, (CeldPoint) { from.x + (place.x - from.x) * i / n, from.y + (place.y - from.y) * i / n });
}

void
celd_joined_explain_wide_lines (const CeldJoinedLines *s)
{
  explain_hidden (s);
  for (size_t k = 0; k < s->graph.n_lines; k++)
    for (size_t i = 0; i < s->graph.line[k].n; i++)
      explain_wide_disc (s, s->graph.line[k].at[i]);
  for (size_t i = 0; i < 2 * s->graph.n_lines; i++)
    explain_led (s, celd_joined_point (s, i, 0), celd_joined_meeting_point (s, celd_joined_node (s, i)));
}

int
celd_joined_paint_at (const CeldJoinedLines *s, CeldPoint p)
{
  if (!celd_joined_inside (s, p))
    return 0;
  return s->explained[celd_joined_pixel (s, p)] ? -1 : s->mask.painted[celd_joined_pixel (s, p)];
}

double
celd_joined_hidden_share (const CeldJoinedLines *s, CeldPoint c, double r)
{
  double hidden = 0, n = 0;

  if (!s->hidden)
    return 0;
  for (double y = c.y - r; y <= c.y + r; y++)
    for (double x = c.x - r; x <= c.x + r; x++)
      if (hypot (x - c.x, y - c.y) <= r)
        {
          CeldPoint p = { x, y };

          hidden += celd_joined_inside (s, p) && s->hidden[celd_joined_pixel (s, p)];
          n++;
        }
  return hidden / n;
}

/* The paint that is not explained within `reach` widths of a place, in square widths. */
static double
rest_near (const CeldJoinedLines *s, CeldPoint place, double reach)
{
  double r = reach * s->graph.width, rest = 0;

  for (double y = place.y - r; y <= place.y + r; y++)
    for (double x = place.x - r; x <= place.x + r; x++)
      rest += hypot (x - place.x, y - place.y) <= r && celd_joined_paint_at (s, (CeldPoint) { x, y }) > 0;
  return rest / (s->graph.width * s->graph.width);
}

bool
celd_joined_is_alone (const CeldJoinedLines *s, size_t k, size_t margin)
{
  const CeldStrokeLine *line = &s->graph.line[k];

  for (size_t i = margin; i + margin < line->n; i += 1 + (size_t) s->graph.width)
    if (rest_near (s, line->at[i], REST_ALONG) > MOST_ALONG)
      return false;
  return true;
}
