/* The opacity or width of a line along its points.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* All chosen; lengths are widths of the paint. */
#define DISC        0.25 /* radius of the paint whose opacity is that of a point */
#define WAY         1.5  /* to either side of a point for the direction across which width is measured */
#define SOFT_EDGE   2    /* pixels beyond the radius of a line where its soft edge ends */
#define SMOOTH      0.5  /* to either side of a point of which the mean is taken */
#define FREE_END    0.7  /* at a free end, which is round, and says nothing */
#define MOST_UNSEEN 0.3  /* part of a line that others hide */

/* The opacity at a point; 0 outside the picture, beyond which the border of the mask may lie; NAN where others hide what
 * is there. */
static double
opacity_at (const CeldJoinedLines *s, const CeldArrowLayer *layer, CeldPoint p)
{
  CeldPoint q = { p.x + s->mask.left, p.y + s->mask.top };

  if (!celd_joined_inside (s, p) || q.x < 0 || q.y < 0 || q.x >= s->stroke->width || q.y >= s->stroke->height)
    return 0;
  if (s->hidden && s->hidden[celd_joined_pixel (s, p)])
    return NAN;
  return celd_arrow_opacity (layer, (int) q.x, (int) q.y);
}

static double
disc_opacity (const CeldJoinedLines *s, const CeldArrowLayer *layer, CeldPoint c)
{
  double r = fmax (1, DISC * s->graph.width), sum = 0;
  int    n = 0;

  for (double y = -floor (r); y <= r; y++)
    for (double x = -floor (r); x <= r; x++)
      if (hypot (x, y) <= r)
        {
          sum += opacity_at (s, layer, (CeldPoint) { c.x + x, c.y + y });
          n++;
        }
  return sum / n;
}

/* The width of a line at a point: the sum of opacities across, which a soft edge leaves as it is. */
static double
width_at (const CeldJoinedLines *s, const CeldArrowLayer *layer, const CeldStrokeLine *line, size_t i)
{
  size_t    reach = (size_t) ceil (WAY * s->graph.width);
  CeldPoint a = line->at[i > reach ? i - reach : 0], b = line->at[i + reach < line->n ? i + reach : line->n - 1];
  CeldPoint c = line->at[i];
  double    length = fmax (1e-9, celd_points_apart (a, b)), x = (b.y - a.y) / length, y = (a.x - b.x) / length, sum = 0;
  double    r = sqrt (s->mask.squared[celd_joined_pixel (s, c)]) + SOFT_EDGE;

  for (double t = -r; t <= r; t += 0.5)
    sum += 0.5 * opacity_at (s, layer, (CeldPoint) { c.x + t * x, c.y + t * y });
  return sum;
}

double
celd_line_value (const CeldJoinedLines *s, const CeldArrowLayer *layer, size_t k, size_t i)
{
  const CeldStrokeLine *line = &s->graph.line[k];

  return s->style == CELD_ARROW_FADE ? disc_opacity (s, layer, line->at[i]) : width_at (s, layer, line, i);
}

/* The points of a line that are of no other one: *first, and how many. */
static size_t
points_alone (const CeldJoinedLines *s, size_t k, size_t *first)
{
  size_t n = s->graph.line[k].n, margin[2];

  for (size_t i = 0; i < 2; i++)
    {
      double apart = celd_joined_widths_apart (s, 2 * k + i);

      margin[i] = (size_t) ceil (s->graph.width * (apart > 0 ? fmin (apart, CELD_MOST_SHARED) : FREE_END)) + 1;
    }
  *first = margin[0];
  return n > margin[0] + margin[1] ? n - margin[0] - margin[1] : 0;
}

CeldStatus
celd_line_values_new (const CeldJoinedLines *s, const CeldArrowLayer *layer, size_t k, double most, CeldLineValues *v)
{
  size_t  reach = (size_t) ceil (SMOOTH * s->graph.width), all, hidden = 0;
  double *raw;

  *v  = (CeldLineValues) { .lines = s, .line = &s->graph.line[k] };
  all = points_alone (s, k, &v->first);
  v->value = celd_alloc (2 * all, sizeof *v->value);
  if (!v->value)
    return CELD_NO_MEMORY;
  raw = v->value + all;
  for (size_t i = 0, first = v->first; i < all; i++)
    {
      double value = celd_line_value (s, layer, k, first + i) / most;
      bool   seen = !isnan (value);

      if (seen || v->n)
        {
          raw[v->n] = seen ? value : raw[v->n - 1];
          v->n++;
        }
      else
        v->first++;
      hidden += !seen;
    }
  v->n = (double) hidden > MOST_UNSEEN * (double) all ? 0 : v->n;
  for (size_t i = 0; i < v->n; i++)
    {
      size_t from = i > reach ? i - reach : 0, to = i + reach < v->n ? i + reach + 1 : v->n;

      v->value[i] = 0;
      for (size_t j = from; j < to; j++)
        v->value[i] += raw[j] / (double) (to - from);
    }
  return CELD_OK;
}

void
celd_line_colours (const CeldLineValues *v, const CeldArrowLayer *layer, CeldPaintColour colour[2])
{
  const CeldJoinedLines *s = v->lines;
  size_t                 third = v->n / 3;

  for (size_t i = 0; i < v->n; i++)
    if ((i < third || i >= v->n - third) && !isnan (opacity_at (s, layer, v->line->at[v->first + i])))
      celd_paint_colour_add (&colour[i >= third], layer, (int) v->line->at[v->first + i].x + s->mask.left,
                             (int) v->line->at[v->first + i].y + s->mask.top);
}

void
celd_line_values_fit (const CeldLineValues *v, size_t from, size_t to, double *level, double *slope)
{
  double n = (double) (to - from), middle = (double) from + 0.5 * (n - 1), mean = 0, xv = 0, xx = 0;

  for (size_t i = from; i < to; i++)
    {
      double x = (double) i - middle;

      mean += v->value[i] / n;
      xv += x * v->value[i];
      xx += x * x;
    }
  *slope = xx > 0 ? xv / xx : 0;
  *level = mean - *slope * middle;
}
