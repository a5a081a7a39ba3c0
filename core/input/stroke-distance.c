/* Geodesic distances along a painted stroke.
 *
 * Steps to the eight neighbours cost 1 or sqrt 2, so that a distance is up to 8 % too long, by about the same factor
 * for pixels side by side.
 *
 * Cost: a pass over the pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrows.h"

#include <float.h>
#include <math.h>

#define DIAGONAL_STEP 1.41421356f
#define NOT_REACHED   FLT_MAX /* distance of a pixel of the stroke; other pixels of the plane have INFINITY */

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

/* Pixels to go on from, by whole distances: a step from ring r leads to ring r + 1 or r + 2.  Each may have a pixel
 * once. */
typedef struct { uint32_t *pixel[3]; size_t n[3]; } Rings;

/* Lowers the distances of the neighbours of a pixel to what a step from there costs. */
static void
step_from (CeldArrowStroke *stroke, uint32_t pixel, Rings *rings)
{
  const uint32_t row = (uint32_t) row_length (stroke);
  const uint32_t beside[8] = { pixel - row, pixel - 1, pixel + 1, pixel + row,
                               pixel - row - 1, pixel - row + 1, pixel + row - 1, pixel + row + 1 };

  for (int i = 0; i < 8; i++)
    {
      float *there = &stroke->distance[beside[i]], reached = stroke->distance[pixel] + (i < 4 ? 1 : DIAGONAL_STEP);
      size_t ring = (size_t) reached;

      if (reached >= *there || *there > NOT_REACHED)
        continue;
      if (*there >= (float) (ring + 1)) /* it is not in that ring yet */
        rings->pixel[ring % 3][rings->n[ring % 3]++] = beside[i];
      *there = reached;
    }
}

/* Fills in the distances from n starts; those of other pixels of the stroke are NOT_REACHED (Dijkstra's method, with a
 * ring for a bucket). */
static void
spread (CeldArrowStroke *stroke, const uint32_t *start, size_t n)
{
  Rings  rings = { .pixel = { stroke->rings, stroke->rings + stroke->n, stroke->rings + 2 * stroke->n } };
  size_t ring = 0;

  for (size_t i = 0; i < n; i++)
    if (stroke->distance[start[i]] > 0)
      {
        rings.pixel[0][rings.n[0]++] = start[i];
        stroke->distance[start[i]]   = 0;
      }
  for (; rings.n[0] || rings.n[1] || rings.n[2]; ring = (ring + 1) % 3)
    {
      for (size_t i = 0; i < rings.n[ring]; i++)
        step_from (stroke, rings.pixel[ring][i], &rings);
      rings.n[ring] = 0;
    }
}

/* Fills in the sums.  A stroke in several pieces, some of which are not reached, gets a length too short for an arrow. */
static void
sum_by_distance (CeldArrowStroke *stroke, float farthest)
{
  float longest = farthest < NOT_REACHED ? farthest : 0;

  stroke->n_sums = (size_t) longest + 2;
  for (size_t i = 0; i < stroke->n_sums; i++)
    stroke->sums[i] = (CeldStrokeSums) { 0 };
  for (size_t i = 0; i < stroke->n; i++)
    {
      CeldPoint       p = celd_stroke_point (stroke, stroke->pixel[i]);
      CeldStrokeSums *f = &stroke->sums[(size_t) fminf (stroke->distance[stroke->pixel[i]], longest) + 1];

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
    stroke->distance[stroke->pixel[i]] = NOT_REACHED;
  spread (stroke, start, n);
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
