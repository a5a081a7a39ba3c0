/* Relations as a picture of arrows, such as an artist would paint them: a shaft, and a filled head at the farther end.
 *
 * Green is certain, orange a guess.  Arrows that touch would be one stroke: the heavier is painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <math.h>
#include <stdlib.h>

#define HEAD  4.0               /* length of the head in widths of the shaft */
#define SPAN  2.0               /* half its breadth */
#define SLIM  9.0               /* an arrow is at least so many widths long, or its lines are thinner */
#define THIN  1.5               /* pixels: the thinnest lines */

typedef struct { double x, y, dx, dy, length, width; } Arrow; /* from its tail, in a direction of length 1 */

static const double guess[3] = { 245, 150, 0 }, certain[3] = { 0, 130, 60 };

/* How far a place lies outside the arrow, negative inside; `along` and `off` its axis. */
static double
outside (const Arrow *a, double along, double off)
{
  double head = HEAD * a->width, neck = a->length - head, slope = hypot (head, SPAN * a->width);
  double shaft = hypot (fmax (0, fmax (-along, along - neck)), off) - a->width / 2;
  double flank = ((along - a->length) * SPAN * a->width + fabs (off) * head) / slope; /* of the head's two long sides */

  return fmin (shaft, fmax (flank, neck - along));
}

static void
blend (uint8_t *rgba, const double colour[3], double opacity)
{
  double below = rgba[3] / 255.0 * (1 - opacity), alpha = opacity + below;

  for (int k = 0; k < 3; k++)
    rgba[k] = (uint8_t) lround ((opacity * colour[k] + below * rgba[k]) / alpha);
  rgba[3] = (uint8_t) lround (255 * alpha);
}

static void
paint_arrow (const Arrow *a, double confidence, CeldPaint *paint)
{
  double reach = SPAN * a->width + 1, end_x = a->x + a->length * a->dx, end_y = a->y + a->length * a->dy, colour[3];
  int    left = (int) fmax (floor (fmin (a->x, end_x) - reach), 0);
  int    top = (int) fmax (floor (fmin (a->y, end_y) - reach), 0);
  int    right = (int) fmin (ceil (fmax (a->x, end_x) + reach), paint->width);
  int    bottom = (int) fmin (ceil (fmax (a->y, end_y) + reach), paint->height);

  for (int k = 0; k < 3; k++)
    colour[k] = guess[k] + confidence * (certain[k] - guess[k]);
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      {
        double u = x + 0.5 - a->x, v = y + 0.5 - a->y;
        double opacity = 0.5 - outside (a, u * a->dx + v * a->dy, u * a->dy - v * a->dx);

        if (opacity > 0)
          blend (CELD_RGBA (paint, x, y), colour, fmin (1, opacity));
      }
}

/* The arrow of a relation; length 0 if it has none. */
static Arrow
arrow_of (const CeldRelation *r, double width)
{
  double dx = r->farther.x - r->nearer.x, dy = r->farther.y - r->nearer.y, length = hypot (dx, dy);

  if (r->equal || r->nearer.by_colour || r->farther.by_colour || !(length >= 1) || !(length <= 4 * CELD_MAX_SIDE))
    return (Arrow) { 0 };
  return (Arrow) {
    r->nearer.x + 0.5, r->nearer.y + 0.5, dx / length, dy / length, length, fmax (THIN, fmin (width, length / SLIM))
  };
}

/* How far apart the axes of two arrows are, at least. */
static double
between (const Arrow *a, const Arrow *b)
{
  double least = INFINITY, step = fmin (a->width, b->width);

  for (double t = 0; t < a->length + step; t += step)
    {
      double at = fmin (t, a->length), u = a->x + at * a->dx - b->x, v = a->y + at * a->dy - b->y;
      double along = fmax (0, fmin (b->length, u * b->dx + v * b->dy));

      least = fmin (least, hypot (u - along * b->dx, v - along * b->dy));
    }
  return least;
}

static bool
is_free (const Arrow *a, const Arrow *painted, size_t n)
{
  for (size_t i = 0; i < n; i++)
    {
      const Arrow *b = &painted[i];
      double       far = SPAN * (a->width + b->width) + 2; /* heads side by side, and a pixel of air each */

      if (hypot (a->x - b->x, a->y - b->y) < a->length + b->length + far && between (a, b) < far)
        return false;
    }
  return true;
}

typedef struct { double weight; size_t relation; } RankedRelation;

/* By falling weight, then in the order given. */
static int
compare_ranked (const void *one, const void *two)
{
  const RankedRelation *a = one, *b = two;

  if (a->weight != b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

CeldStatus
celd_relations_paint (const CeldRelations *relations, double width, CeldPaint *paint)
{
  RankedRelation  *ranked = celd_alloc (relations->n, sizeof *ranked);
  Arrow *painted = celd_alloc (relations->n, sizeof *painted);
  size_t n = 0;

  if (ranked && painted)
    {
      for (size_t i = 0; i < relations->n; i++)
        ranked[i] = (RankedRelation) { relations->item[i].weight > 0 ? relations->item[i].weight : 0, i };
      qsort (ranked, relations->n, sizeof *ranked, compare_ranked);
      for (size_t i = 0; i < relations->n; i++)
        {
          Arrow a = arrow_of (&relations->item[ranked[i].relation], width);

          if (!(a.length > 0) || !is_free (&a, painted, n))
            continue;
          painted[n++] = a;
          paint_arrow (&a, fmin (1, ranked[i].weight), paint);
        }
    }
  celd_free (ranked);
  celd_free (painted);
  return ranked && painted ? CELD_OK : CELD_NO_MEMORY;
}
