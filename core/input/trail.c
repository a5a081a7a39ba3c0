/* Geodesic distances along a painted stroke.
 *
 * Steps to the eight neighbours cost 1 or sqrt 2, so a distance is up to 8 % too long, the same for all pixels side by
 * side.  The pixels are swept in reading order and back until nothing changes: strokes are thin, a few sweeps do, one
 * more for each turn of a winding one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/trail.h"

#include <math.h>

/* Pixels in a row of a plane with its border. */
static size_t
row_length (const CeldTrail *trail)
{
  return (size_t) trail->width + 2;
}

int
celd_trail_x (const CeldTrail *trail, uint32_t pixel)
{
  return (int) (pixel % row_length (trail)) - 1;
}

int
celd_trail_y (const CeldTrail *trail, uint32_t pixel)
{
  return (int) (pixel / row_length (trail)) - 1;
}

CeldPoint
celd_trail_point (const CeldTrail *trail, uint32_t pixel)
{
  return (CeldPoint) { celd_trail_x (trail, pixel) + 0.5, celd_trail_y (trail, pixel) + 0.5 };
}

bool
celd_trail_painted (const CeldTrail *trail, CeldPoint p)
{
  const float *d, *above, *below;

  if (!(p.x >= 0 && p.y >= 0 && p.x < trail->width && p.y < trail->height))
    return false;
  d     = &trail->distance[((size_t) p.y + 1) * row_length (trail) + (size_t) p.x + 1];
  above = d - row_length (trail);
  below = d + row_length (trail);
  return isfinite (*d) || isfinite (d[-1]) || isfinite (d[1]) || isfinite (*above) || isfinite (*below);
}

/* Lowers the distance of a pixel to what its neighbours allow. */
static bool
relax (CeldTrail *trail, uint32_t pixel)
{
  const float diagonal = 1.41421356f;
  float      *d = &trail->distance[pixel], *above = d - row_length (trail), *below = d + row_length (trail);
  float       straight = fminf (fminf (d[-1], d[1]), fminf (*above, *below)) + 1;
  float       slanted  = fminf (fminf (above[-1], above[1]), fminf (below[-1], below[1])) + diagonal;
  float       least    = fminf (straight, slanted);

  if (!(least < *d))
    return false;
  *d = least;
  return true;
}

static void
sweep_until_settled (CeldTrail *trail)
{
  bool changed;

  do
    {
      changed = false;
      for (size_t i = 0; i < trail->n; i++)
        changed |= relax (trail, trail->pixel[i]);
      for (size_t i = trail->n; changed && i-- > 0;)
        relax (trail, trail->pixel[i]);
    }
  while (changed);
}

static void
gather_fronts (CeldTrail *trail, float longest)
{
  trail->n_fronts = (size_t) longest + 2;
  for (size_t i = 0; i < trail->n_fronts; i++)
    trail->front[i] = (CeldFront) { 0 };
  for (size_t i = 0; i < trail->n; i++)
    {
      CeldPoint  p = celd_trail_point (trail, trail->pixel[i]);
      CeldFront *f = &trail->front[(size_t) trail->distance[trail->pixel[i]] + 1];

      f->count++;
      f->x += p.x;
      f->y += p.y;
    }
  for (size_t i = 1; i < trail->n_fronts; i++)
    {
      CeldFront *f = &trail->front[i];

      f->count += f[-1].count;
      f->x     += f[-1].x;
      f->y     += f[-1].y;
    }
}

uint32_t
celd_trail_follow (CeldTrail *trail, const uint32_t *start, size_t n)
{
  uint32_t farthest = trail->pixel[0];

  for (size_t i = 0; i < trail->n; i++)
    trail->distance[trail->pixel[i]] = INFINITY;
  for (size_t i = 0; i < n; i++)
    trail->distance[start[i]] = 0;
  sweep_until_settled (trail);
  for (size_t i = 0; i < trail->n; i++)
    if (trail->distance[trail->pixel[i]] > trail->distance[farthest])
      farthest = trail->pixel[i];
  gather_fronts (trail, trail->distance[farthest]);
  return farthest;
}

double
celd_trail_length (const CeldTrail *trail)
{
  return (double) trail->n_fronts - 1;
}

/* The sums below a distance, between two fronts in proportion. */
static CeldFront
below (const CeldTrail *trail, double distance)
{
  double    d = fmax (0, fmin (distance, celd_trail_length (trail)));
  size_t    i = d < celd_trail_length (trail) ? (size_t) d : trail->n_fronts - 2;
  CeldFront a = trail->front[i], b = trail->front[i + 1];
  double    t = d - (double) i;

  return (CeldFront) { a.count + t * (b.count - a.count), a.x + t * (b.x - a.x), a.y + t * (b.y - a.y) };
}

double
celd_trail_width (const CeldTrail *trail, double from, double to)
{
  return (below (trail, to).count - below (trail, from).count) / (to - from);
}

CeldPoint
celd_trail_centre (const CeldTrail *trail, double from, double to)
{
  CeldFront a = below (trail, from), b = below (trail, to);
  double    count = b.count - a.count;

  if (!(count > 0)) /* nothing between: there are pixels at the start */
    return (CeldPoint) { b.x / b.count, b.y / b.count };
  return (CeldPoint) { (b.x - a.x) / count, (b.y - a.y) / count };
}
