/* Is the end of an arrow hidden by arrows of other colours?
 *
 * An arrow that is read by its colour ends where its paint does.  If most of the paint there is hidden, or other paint
 * goes on in its direction, or nearly so, its end may lie elsewhere.  Its place is known all the same if another arrow
 * ends there too.
 *
 * Cost: two passes over the paint of the arrow.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/input.h"

#include <math.h>

/* All chosen; widths are those of the shaft. */
#define HIDING           0.8 /* widths of other paint in front of an end, at least, and ... */
#define HIDING_LEAST     3   /* ... as many pixels more, that may hide it */
#define BEHIND           3   /* widths from an end up to which the direction of its arrow is measured, and ... */
#define BEHIND_LEAST     10  /* ... as many pixels at least */
#define ASIDE            0.4 /* radians on either side of the direction in which the arrow may go on */
#define RAYS             5   /* in that range, along which paint is looked for */
#define SAME_PLACE       0.7 /* widths between the ends of two arrows that end at one place, and ... */
#define SAME_PLACE_LEAST 2   /* ... as many pixels */

/* The direction in which the paint of an arrow that is seen reaches its end. */
static CeldPoint
direction_at (const CeldArrowStroke *stroke, const bool *seen, CeldPoint at, double width)
{
  CeldPoint sum = { 0, 0 };
  double    length;

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);

      if (!seen[i] || hypot (p.x - at.x, p.y - at.y) > fmax (BEHIND_LEAST, BEHIND * width))
        continue;
      sum.x += at.x - p.x;
      sum.y += at.y - p.y;
    }
  length = hypot (sum.x, sum.y);
  return length > 0 ? (CeldPoint) { sum.x / length, sum.y / length } : (CeldPoint) { 0, 0 };
}

/* How far the paint of an arrow that is seen reaches beyond its end in a direction; *width: its width there. */
static double
reach_beyond (const CeldArrowStroke *stroke, const bool *seen, CeldPoint at, CeldPoint way, double *width)
{
  double most = 0, n = 0, near = fmax (6, 2 * *width);

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p  = celd_stroke_point (stroke, stroke->pixel[i]);
      double    dx = p.x - at.x, dy = p.y - at.y;

      n += hypot (dx, dy) <= near;
      if (seen[i] && fabs (dx * way.y - dy * way.x) <= 1)
        most = fmax (most, dx * way.x + dy * way.y);
    }
  *width = fmin (*width, n / near);
  return most;
}

static bool
is_painted (const CeldStrokeMask *c, double x, double y)
{
  return x >= 0 && y >= 0 && x < c->width && y < c->height && c->painted[(size_t) y * (size_t) c->width + (size_t) x];
}

/* Is most of the paint of an arrow at its end seen? */
static bool
is_seen (const CeldArrowStroke *stroke, const bool *seen, CeldPoint at, double width)
{
  size_t near = 0, hidden = 0;

  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint p = celd_stroke_point (stroke, stroke->pixel[i]);

      if (hypot (p.x - at.x, p.y - at.y) > width)
        continue;
      near++;
      hidden += !seen[i];
    }
  return 2 * hidden < near;
}

CeldArrowEnd
celd_arrow_end (const CeldStrokeMask *component, const CeldArrowStroke *stroke, const bool *seen, CeldPoint at,
                CeldPoint other)
{
  CeldArrowEnd end = { at, fmax (1.5, (double)stroke->n / fmax (1, hypot (at.x - other.x, at.y - other.y))), true };
  CeldPoint    way = direction_at (stroke, seen, at, end.width);

  end.visible = is_seen (stroke, seen, at, end.width);

  for (int ray = 0; ray < RAYS; ray++)
    {
      double    width = end.width, a = ASIDE * (2. * ray / (RAYS - 1) - 1), d = 0, start, most;
      CeldPoint turned = { way.x * cos (a) - way.y * sin (a), way.x * sin (a) + way.y * cos (a) };

      start = reach_beyond (stroke, seen, at, turned, &width) + 1;
      most  = HIDING * width + HIDING_LEAST;
      while (d <= most && is_painted (component, at.x - component->left + (start + d) * turned.x,
                                      at.y - component->top + (start + d) * turned.y))
        d += 0.5;
      end.visible &= d <= most;
    }
  return end;
}

bool
celd_arrow_end_known (const CeldArrowEnd *ends, size_t n, size_t k)
{
  bool known = ends[k].visible;

  for (size_t i = 0; i < n && !known; i++)
    known = i / 2 != k / 2 && hypot (ends[i].at.x - ends[k].at.x, ends[i].at.y - ends[k].at.y) <=
                                SAME_PLACE * fmin (ends[i].width, ends[k].width) + SAME_PLACE_LEAST;
  return known;
}
