/* Geodesic distances along a painted stroke.
 *
 * Steps to the eight neighbours cost 1 or sqrt 2, so that a distance is up to 8 % too long, by about the same factor
 * for pixels side by side.  The pixels are swept in reading order and back until nothing changes.  Strokes are thin, so
 * that this takes a few sweeps, and one more for each turn of a winding stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/input.h"

#include <math.h>

/* Pixels in a row of a plane with its border. */
static size_t
row_length (const CeldArrowStroke *stroke)
{
  return (size_t) stroke->width + 2;
}

int
celd_stroke_x (const CeldArrowStroke *stroke, uint32_t pixel)
{
  return (int) (pixel % row_length (stroke)) - 1;
}

int
celd_stroke_y (const CeldArrowStroke *stroke, uint32_t pixel)
{
  return (int) (pixel / row_length (stroke)) - 1;
}

CeldPoint
celd_stroke_point (const CeldArrowStroke *stroke, uint32_t pixel)
{
  return (CeldPoint) { celd_stroke_x (stroke, pixel) + 0.5, celd_stroke_y (stroke, pixel) + 0.5 };
}

bool
celd_stroke_painted (const CeldArrowStroke *stroke, CeldPoint p)
{
  const float *d, *above, *below;

  if (!(p.x >= 0 && p.y >= 0 && p.x < stroke->width && p.y < stroke->height))
    return false;
  d     = &stroke->distance[((size_t) p.y + 1) * row_length (stroke) + (size_t) p.x + 1];
  above = d - row_length (stroke);
  below = d + row_length (stroke);
  return isfinite (*d) || isfinite (d[-1]) || isfinite (d[1]) || isfinite (*above) || isfinite (*below);
}

/* Lowers the distance of a pixel to what its neighbours allow. */
static bool
relax (CeldArrowStroke *stroke, uint32_t pixel)
{
  const float diagonal = 1.41421356f;
  float      *d = &stroke->distance[pixel], *above = d - row_length (stroke), *below = d + row_length (stroke);
  float       straight = fminf (fminf (d[-1], d[1]), fminf (*above, *below)) + 1;
  float       slanted  = fminf (fminf (above[-1], above[1]), fminf (below[-1], below[1])) + diagonal;
  float       least    = fminf (straight, slanted);

  if (!(least < *d))
    return false;
  *d = least;
  return true;
}

static void
sweep_until_settled (CeldArrowStroke *stroke)
{
  bool changed;

  do
    {
      changed = false;
      for (size_t i = 0; i < stroke->n; i++)
        changed |= relax (stroke, stroke->pixel[i]);
      for (size_t i = stroke->n; changed && i-- > 0;)
        relax (stroke, stroke->pixel[i]);
    }
  while (changed);
}

/* Fills in the sums. */
static void
sum_by_distance (CeldArrowStroke *stroke, float longest)
{
  stroke->n_sums = (size_t) longest + 2;
  for (size_t i = 0; i < stroke->n_sums; i++)
    stroke->sums[i] = (CeldStrokeSums) { 0 };
  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint       p = celd_stroke_point (stroke, stroke->pixel[i]);
      CeldStrokeSums *f = &stroke->sums[(size_t) stroke->distance[stroke->pixel[i]] + 1];

      f->count++;
      f->x += p.x;
      f->y += p.y;
    }
  for (size_t i = 1; i < stroke->n_sums; i++)
    {
      CeldStrokeSums *f = &stroke->sums[i];

      f->count += f[-1].count;
      f->x     += f[-1].x;
      f->y     += f[-1].y;
    }
}

uint32_t
celd_stroke_follow (CeldArrowStroke *stroke, const uint32_t *start, size_t n)
{
  uint32_t farthest = stroke->pixel[0];

  for (size_t i = 0; i < stroke->n; i++)
    stroke->distance[stroke->pixel[i]] = INFINITY;
  for (size_t i = 0; i < n; i++)
    stroke->distance[start[i]] = 0;
  sweep_until_settled (stroke);
  for (size_t i = 0; i < stroke->n; i++)
    if (stroke->distance[stroke->pixel[i]] > stroke->distance[farthest])
      farthest = stroke->pixel[i];
  sum_by_distance (stroke, stroke->distance[farthest]);
  return farthest;
}

double
celd_stroke_length (const CeldArrowStroke *stroke)
{
  return (double) stroke->n_sums - 1;
}

/* The sums below a distance, interpolated linearly between whole distances. */
static CeldStrokeSums
below (const CeldArrowStroke *stroke, double distance)
{
  double         d = fmax (0, fmin (distance, celd_stroke_length (stroke)));
  size_t         i = d < celd_stroke_length (stroke) ? (size_t) d : stroke->n_sums - 2;
  CeldStrokeSums a = stroke->sums[i], b = stroke->sums[i + 1];
  double         t = d - (double) i;

  return (CeldStrokeSums) { a.count + t * (b.count - a.count), a.x + t * (b.x - a.x), a.y + t * (b.y - a.y) };
}

double
celd_stroke_mean_width (const CeldArrowStroke *stroke, double from, double to)
{
  return (below (stroke, to).count - below (stroke, from).count) / (to - from);
}

CeldPoint
celd_stroke_centroid (const CeldArrowStroke *stroke, double from, double to)
{
  CeldStrokeSums a = below (stroke, from), b = below (stroke, to);
  double         count = b.count - a.count;

  if (!(count > 0)) /* nothing between: there are pixels at the start */
    return (CeldPoint) { b.x / b.count, b.y / b.count };
  return (CeldPoint) { (b.x - a.x) / count, (b.y - a.y) / count };
}
