/* Tracing of contour edges: follows the crack edges between paper and ink, with ink on the left; ink is connected by 8
 * neighbours, and outside the picture is paper.  Each point is moved to where ink crosses one half.
 *
 * The thickness of the ink is measured along the normal, which is averaged over some points, so that the steps of
 * pixels have no influence.  Cost: one pass over the picture, and the length of the edges times the thickness of the
 * ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>

#define IS_INK        1     /* bits of a pixel's flags */
#define FOLLOWED      2     /* the edge above the pixel has been followed */
#define NEAR_CORNER   4     /* paper beside an edge that turns sharply nearby */
#define NORMAL_RADIUS 3     /* points to either side over which the normal is measured; chosen */
#define MAX_THICKNESS 512   /* pixels; thicker ink is no contour; chosen */
#define CORNER_COSINE 0.82f /* cosine of the least turn at a corner; chosen */
#define TURN_RADIUS   4     /* points to either side over which the turn is measured; chosen */
#define SKEW_RADIUS   3     /* points beside a corner whose normals are unreliable; chosen */
#define BESIDE_CORNER 8     /* points to either side of a corner that are near it; chosen */

/* The flags have a margin of one pixel. */
typedef struct
{
  const CeldPlane  *ink;
  uint8_t          *flags;
  int               stride;
  CeldContourEdges *edges;
} EdgeTracer;

static uint8_t *
flags_at (const EdgeTracer *t, int x, int y)
{
  return t->flags + (size_t) (y + 1) * (size_t) t->stride + (x + 1);
}

static CeldStatus
read_flags (EdgeTracer *t)
{
  const CeldPlane *ink = t->ink;

  t->stride = ink->width + 2;
  t->flags  = celd_alloc0 ((size_t) ink->height + 2, (size_t) t->stride);
  for (int y = 0; t->flags && y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      *flags_at (t, x, y) = celd_is_paper (CELD_AT (ink, x, y)) ? 0 : IS_INK;
  return t->flags ? CELD_OK : CELD_NO_MEMORY;
}

/* ------------------------------------------------------------------ tracing */

static bool
inside (const CeldPlane *ink, int x, int y)
{
  return x >= 0 && y >= 0 && x < ink->width && y < ink->height;
}

/* The point between the paper at (x,y) and the ink at (u,v) where ink is one half, by linear interpolation. */
static CeldEdgePoint
subpixel_point (const CeldPlane *ink, int x, int y, int u, int v)
{
  bool   known = inside (ink, x, y);
  double bright = known ? fmin ((double) CELD_AT (ink, x, y), 1) : 1, dark = (double) CELD_AT (ink, u, v);
  double along = bright == bright && known ? (bright - 0.5) / (bright - dark) : 0.5;

  return (CeldEdgePoint) { .x = (float) (x + 0.5 + along * (u - x)), .y = (float) (y + 0.5 + along * (v - y)),
                           .thickness = INFINITY, .paper = known ? y * ink->width + x : -1, .across = -1 };
}

/* Follows the loop that includes the edge above the paper at (x,y). */
static CeldStatus
follow (EdgeTracer *t, int x, int y)
{
  CeldContourEdges *e = t->edges;
  CeldEdgeLoop      loop = { .first = e->n_points };
  int               at_x = x, at_y = y, heading = 0;

  do
    {
      int in_x = at_x + celd_right_x[heading], in_y = at_y + celd_right_y[heading];
      int out_x = at_x + celd_left_x[heading], out_y = at_y + celd_left_y[heading];

      if (celd_append (e->point, e->n_points, e->point_capacity,
                       subpixel_point (t->ink, in_x, in_y, out_x, out_y)) != CELD_OK)
        return CELD_NO_MEMORY;
      if (heading == 0)
        *flags_at (t, in_x, in_y) |= FOLLOWED;
      at_x += celd_step_x[heading];
      at_y += celd_step_y[heading];
      if (*flags_at (t, at_x + celd_right_x[heading], at_y + celd_right_y[heading]) & IS_INK)
        heading = (heading + 1) & 3;
      else if (!(*flags_at (t, at_x + celd_left_x[heading], at_y + celd_left_y[heading]) & IS_INK))
        heading = (heading + 3) & 3;
    }
  while (at_x != x || at_y != y || heading != 0);
  loop.n = e->n_points - loop.first;
  return celd_append (e->loop, e->n_loops, e->loop_capacity, loop);
}

static CeldStatus
follow_all (EdgeTracer *t, const CeldHost *host)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y <= t->ink->height && status == CELD_OK; y++)
    {
      const uint8_t *row = flags_at (t, 0, y), *above = row - t->stride;

      for (int x = 0; x < t->ink->width && status == CELD_OK; x++)
        if (!row[x] && above[x] & IS_INK)
          status = follow (t, x, y);
      if (status == CELD_OK && (y & 255) == 255)
        status = celd_progress (host, 0.5 * y / t->ink->height);
    }
  return status;
}

/* ------------------------------------------------------------------ corners */

static float
edge_distance (const CeldEdgePoint *a, const CeldEdgePoint *b)
{
  return hypotf (a->x - b->x, a->y - b->y);
}

/* Does the edge turn sharply at point i? */
static bool
is_corner (const CeldEdgePoint *point, size_t n, size_t i)
{
  const CeldEdgePoint *a = &point[(i + n - TURN_RADIUS % n) % n], *p = &point[i], *b = &point[(i + TURN_RADIUS) % n];
  float                before = edge_distance (a, p), after = edge_distance (p, b);

  return (p->x - a->x) * (b->x - p->x) + (p->y - a->y) * (b->y - p->y) < CORNER_COSINE * before * after;
}

static void
find_corners (CeldEdgePoint *point, size_t n)
{
  for (size_t i = 0; i < n; i++)
    point[i].step = edge_distance (&point[i], &point[(i + 1) % n]);
  for (size_t i = 0; i < n; i++)
    if (is_corner (point, n, i))
      {
        point[i].corner = true;
        for (size_t k = 0; k <= SKEW_RADIUS; k++)
          point[(i + k) % n].skewed = point[(i + n - k % n) % n].skewed = true;
      }
}

/* Marks the paper along the edge near its corners. */
static void
mark_corners (const EdgeTracer *t, const CeldEdgePoint *point, size_t n)
{
  for (size_t i = 0; i < n; i++)
    if (point[i].corner)
      for (size_t k = 0; k <= 2 * BESIDE_CORNER; k++)
        {
          int32_t paper = point[(i + k + n - BESIDE_CORNER % n) % n].paper;

          if (paper >= 0)
            *flags_at (t, paper % t->ink->width, paper / t->ink->width) |= NEAR_CORNER;
        }
}

/* ------------------------------------------------------------------ normals and thickness */

static void
find_normals (CeldEdgePoint *point, size_t n)
{
  for (size_t i = 0; i < n; i++)
    {
      const CeldEdgePoint *a = &point[(i + n - NORMAL_RADIUS % n) % n], *b = &point[(i + NORMAL_RADIUS) % n];
      float                x = b->x - a->x, y = b->y - a->y, length = hypotf (x, y);

      if (!(length > 0))
        {
          a      = &point[(i + n - 1) % n];
          x      = point[i].x - a->x;
          y      = point[i].y - a->y;
          length = fmaxf (hypotf (x, y), 1e-6f);
        }
      point[i].nx = y / length;
      point[i].ny = -x / length;
    }
}

static float
clamp (float value, int last)
{
  return value < 0 ? 0 : value > (float) last ? (float) last : value;
}

/* Ink at a point, bilinear. */
static float
ink_at (const CeldPlane *ink, float x, float y)
{
  float u = clamp (x - 0.5f, ink->width - 1), v = clamp (y - 0.5f, ink->height - 1);
  int   left = (int) u, top = (int) v, right = left + (left + 1 < ink->width), below = top + (top + 1 < ink->height);
  float a = u - (float) left, b = v - (float) top;
  float above = CELD_AT (ink, left, top) * (1 - a) + CELD_AT (ink, right, top) * a;

  return above * (1 - b) + (CELD_AT (ink, left, below) * (1 - a) + CELD_AT (ink, right, below) * a) * b;
}

/* The distance between `from` and `to` along the normal at which ink becomes paper, by bisection. */
static float
find_crossing (const CeldPlane *ink, const CeldEdgePoint *p, float from, float to)
{
  for (int i = 0; i < 5; i++)
    {
      float middle = (from + to) / 2;

      if (celd_is_paper (ink_at (ink, p->x + middle * p->nx, p->y + middle * p->ny)))
        to = middle;
      else
        from = middle;
    }
  return (from + to) / 2;
}

static void
measure_thickness (const EdgeTracer *t, CeldEdgePoint *p)
{
  for (float s = 1; s < MAX_THICKNESS; s++)
    {
      int x = celd_floor (p->x + s * p->nx), y = celd_floor (p->y + s * p->ny);

      if (!inside (t->ink, x, y))
        return;
      if (!(*flags_at (t, x, y) & IS_INK))
        {
          p->across       = y * t->ink->width + x;
          p->faces_corner = *flags_at (t, x, y) & NEAR_CORNER;
          p->thickness    = fmaxf (find_crossing (t->ink, p, s - 1, s + 0.5f), 0.5f);
          return;
        }
    }
}

static CeldStatus
measure_all (const EdgeTracer *t, const CeldHost *host)
{
  CeldContourEdges *e = t->edges;

  for (size_t k = 0; k < e->n_loops; k++)
    {
      find_corners (&e->point[e->loop[k].first], e->loop[k].n);
      find_normals (&e->point[e->loop[k].first], e->loop[k].n);
      mark_corners (t, &e->point[e->loop[k].first], e->loop[k].n);
    }
  for (size_t i = 0; i < e->n_points; i++)
    measure_thickness (t, &e->point[i]);
  return celd_progress (host, 1);
}

CeldStatus
celd_contour_edges_new (const CeldPlane *ink, const CeldHost *host, CeldContourEdges *edges)
{
  CeldContourEdges made = { .width = ink->width, .height = ink->height, .stroke = celd_stroke_width (ink) };
  EdgeTracer       t = { .ink = ink, .edges = &made };
  CeldStatus       status = read_flags (&t);

  if (status == CELD_OK)
    status = follow_all (&t, host);
  if (status == CELD_OK)
    status = measure_all (&t, host);
  celd_free (t.flags);
  if (status == CELD_OK)
    *edges = made;
  else
    celd_contour_edges_clear (&made);
  return status;
}

void
celd_contour_edges_clear (CeldContourEdges *edges)
{
  celd_free (edges->point);
  celd_free (edges->loop);
  celd_free (edges->piece);
  *edges = (CeldContourEdges) { 0 };
}
