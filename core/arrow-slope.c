/* Strokes whose opacity or width says which end is nearer.
 *
 * The stroke is followed from one end to the other.  It must be a single line: a pixel off the way between the ends
 * belongs to another stroke that touches this one.  The thirds of the way decide; pieces of the way must then fall
 * about steadily from the strong end to the weak one, because two strokes that touch with their ends look like one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "arrows.h"

#include <math.h>

#define LEAST_SIGNAL 0.2  /* least difference of the outer thirds, as a share of the larger value */
#define SLACK        0.1  /* the middle third may leave their range by this share: ends are round and soft */
#define MOST_PIECES  12
#define MOST_RISE    0.25 /* of a later piece above an earlier one: a share of the whole fall, */
#define NOISE        0.05 /* and of the largest value */
#define SHORTEST     6    /* pixels */

/* Mean opacity of a stroke between two distances, strong pixels first: soft edges say little. */
static double
strength (const CeldTrail *trail, const CeldArrowLayer *layer, double from, double to)
{
  double sum = 0, weights = 0;

  for (size_t i = 0; i < trail->n; i++)
    {
      uint32_t p = trail->pixel[i];
      double   a;

      if (trail->distance[p] < from || trail->distance[p] > to)
        continue;
      a = celd_arrow_opacity (layer, celd_trail_x (trail, p), celd_trail_y (trail, p));
      sum     += a * a;
      weights += a;
    }
  return weights > 0 ? sum / weights : 0;
}

/* Opacity or width of pieces of the way, equally long, without the outermost pixels: ends are round. */
static void
measure (const CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, double margin, int n, double *value)
{
  double piece = (celd_trail_length (trail) - 2 * margin) / n;

  for (int i = 0; i < n; i++)
    {
      double from = margin + i * piece, to = from + piece;

      value[i] = style == CELD_ARROW_FADE ? strength (trail, layer, from, to) : celd_trail_width (trail, from, to);
    }
}

/* The most that a value lies above an earlier one, going on or back. */
static double
largest_rise (const double *value, int n, bool back)
{
  double least = INFINITY, rise = 0;

  for (int i = 0; i < n; i++)
    {
      double v = value[back ? n - 1 - i : i];

      least = fmin (least, v);
      rise  = fmax (rise, v - least);
    }
  return rise;
}

/* Is all paint on the way between the two ends?  The trail is followed from `start` when it returns. */
static bool
is_single (CeldTrail *trail, uint32_t start, uint32_t last, double widest)
{
  double length = celd_trail_length (trail);
  size_t off = 0;

  for (size_t i = 0; i < trail->n; i++)
    trail->kept[i] = trail->distance[trail->pixel[i]];
  celd_trail_follow (trail, &last, 1);
  for (size_t i = 0; i < trail->n; i++)
    off += trail->kept[i] + trail->distance[trail->pixel[i]] > length + 2 * widest + 4;
  celd_trail_follow (trail, &start, 1);
  for (size_t i = 0; i < trail->n; i++)
    {
      double    d = trail->distance[trail->pixel[i]];
      CeldPoint p = celd_trail_point (trail, trail->pixel[i]), c = celd_trail_centre (trail, d - 1, d + 1);

      off += hypot (p.x - c.x, p.y - c.y) > 0.8 * widest + 2;
    }
  return 50 * off < trail->n;
}

bool
celd_arrow_slope (CeldTrail *trail, const CeldArrowLayer *layer, CeldArrowStyle style, CeldEnds *ends)
{
  uint32_t  start = celd_trail_follow (trail, trail->pixel, 1), last = celd_trail_follow (trail, &start, 1);
  double    length = celd_trail_length (trail), value[MOST_PIECES], widths[MOST_PIECES] = { 0 }, third[3];
  double    most, least, w, margin;
  int       n = (int) fmax (4, fmin (MOST_PIECES, length / 4));
  CeldPoint first, end;

  if (length < SHORTEST)
    return false;
  measure (trail, layer, CELD_ARROW_TAPER, 0, n, widths);
  for (int i = 0; i < n; i++)
    widths[0] = fmax (widths[0], widths[i]);
  if (length < 1.5 * widths[0] || !is_single (trail, start, last, widths[0]))
    return false;
  margin = fmin (0.3 * widths[0], length / 8);
  measure (trail, layer, style, 0, 3, third);
  measure (trail, layer, style, margin, n, value);
  most  = fmax (third[0], third[2]);
  least = fmin (third[0], third[2]);
  if (most - least < LEAST_SIGNAL * most || third[1] < least - SLACK * most || third[1] > most + SLACK * most)
    return false;
  most = least = value[0];
  for (int i = 1; i < n; i++)
    {
      most  = fmax (most, value[i]);
      least = fmin (least, value[i]);
    }
  if (largest_rise (value, n, third[0] < third[2]) > MOST_RISE * (most - least) + NOISE * most)
    return false;
  w     = fmax (1, fmin (celd_trail_width (trail, 0, length), length / 3));
  first = celd_trail_centre (trail, 0, w);
  end   = celd_trail_centre (trail, length - w, length);
  *ends = third[0] > third[2] ? (CeldEnds) { first, end } : (CeldEnds) { end, first };
  return true;
}
