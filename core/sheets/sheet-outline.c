/* Where the outline of what is visible of a region vanishes under other regions, and how it would go on; and the width
 * of the line along it.
 *
 * Outlines are traced along the sides of pixels.  An end's direction and curvature are those of a parabola fitted to
 * the outline before it.  The piece next to the end is left out, because lines that meet there merge.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "sheets/sheets.h"

#include <stdlib.h>

/* Lengths as shares of the picture's diagonal; chosen on 16 drawings, where half or twice as much changes little. */
#define FITTED         0.06   /* outline that is fitted at an end, at most */
#define LEAST_MOST     32     /* but not less than this, in sides */
#define LEAST_FITTED   0.012  /* an outline shorter than this gives no direction */
#define LEFT_OUT       0.003  /* next to the end */
#define MOST_CURVATURE 65.0   /* in radians a diagonal */
#define SIDES_A_POINT  4      /* sides of pixels that are averaged to one point of the fit; chosen */
#define MOST_WIDTH     64     /* pixels; thicker ink is no line; chosen */
#define WIDTHS_APART   8      /* sides between places where the line's width is measured; chosen */
#define FACING         0.35   /* radians by which ends that go on to each other may miss each other, at most; chosen */
#define LEAST_HIDDEN   3      /* sides; a shorter hidden piece is an effect of antialiasing; chosen */

/* ------------------------------------------------------------------ tracing */

/* A side of a pixel, from corner (x,y), with the region on its right; hidden: on its left is something that may hide
 * the region, or the frame. */
typedef struct { int x, y; bool hidden; } Side;

/* Of a pixel: does the region cover most of it, and is its upper side traced? */
enum { OWN = 1, TRACED = 2 };

typedef struct
{
  const CeldSheetView *view;
  double               diagonal;
  uint8_t             *mask;     /* OWN and TRACED of each pixel of the region's box with one more on all sides */
  size_t               stride;
  Side                *side;     /* of one loop */
  size_t               n, capacity;
  CeldOutlineEnds     *ends;
  double              *width;    /* of the line, at several places */
  size_t               n_widths, width_capacity;
} Outline;

/* x and y at most a pixel beyond the region's box. */
static bool
is_own (const Outline *o, int x, int y)
{
  return o->mask[(size_t) (y - o->view->seen.y + 1) * o->stride + (size_t) (x - o->view->seen.x + 1)] & OWN;
}

static bool
may_hide (const CeldSheetView *v, int x, int y)
{
  if (x < 0 || y < 0 || x >= v->own->owner.width || y >= v->own->owner.height)
    return true;
  return v->standing[celd_larger_label (v->own, x, y) - 1] == CELD_HIDING;
}

/* Marks the pixels that the region covers most of. */
static CeldStatus
mark_own (Outline *o)
{
  const CeldSheetView *v = o->view;
  CeldRect             box = v->seen;
  uint8_t             *to;

  o->stride = (size_t) box.width + 2;
  o->mask   = celd_alloc0 (o->stride * ((size_t) box.height + 2), 1);
  if (!o->mask)
    return CELD_NO_MEMORY;
  for (int y = box.y; y < box.y + box.height; y++)
    {
      to = o->mask + (size_t) (y - box.y + 1) * o->stride + 1;
      for (int x = box.x; x < box.x + box.width; x++)
        *to++ = celd_larger_label (v->own, x, y) == v->label ? OWN : 0;
    }
  return CELD_OK;
}

/* Traces the loop that includes the upper side of pixel (x,y). */
static CeldStatus
trace_loop (Outline *o, int x, int y)
{
  int from_x = x, from_y = y, d = 0;

  o->n = 0;
  do
    {
      Side side = { x, y, may_hide (o->view, x + celd_left_x[d], y + celd_left_y[d]) };

      if (celd_append (o->side, o->n, o->capacity, side) != CELD_OK)
        return CELD_NO_MEMORY;
      if (d == 0)
        o->mask[(size_t) (y - o->view->seen.y + 1) * o->stride + (size_t) (x - o->view->seen.x + 1)] |= TRACED;
      x += celd_step_x[d];
      y += celd_step_y[d];
      if (!is_own (o, x + celd_right_x[d], y + celd_right_y[d]))
        d = (d + 1) % 4;
      else if (is_own (o, x + celd_left_x[d], y + celd_left_y[d]))
        d = (d + 3) % 4;
    }
  while (x != from_x || y != from_y || d != 0);
  return CELD_OK;
}

/* ------------------------------------------------------------------ pieces of a loop */

static Side *
side_at (const Outline *o, size_t i)
{
  return &o->side[i % o->n];
}

/* Index of a side where a piece begins; n if the loop is all of one kind. */
static size_t
find_change (const Outline *o)
{
  for (size_t i = 0; i < o->n; i++)
    if (o->side[i].hidden != side_at (o, i + o->n - 1)->hidden)
      return i;
  return o->n;
}

static size_t
piece_length (const Outline *o, size_t from)
{
  size_t length = 1;

  while (length < o->n && side_at (o, from + length)->hidden == side_at (o, from)->hidden)
    length++;
  return length;
}

static void
drop_short_pieces (const Outline *o)
{
  size_t start = find_change (o);

  for (size_t i = 0, length; start < o->n && i < o->n; i += length)
    {
      length = piece_length (o, start + i);
      if (side_at (o, start + i)->hidden && length < LEAST_HIDDEN)
        for (size_t k = 0; k < length; k++)
          side_at (o, start + i + k)->hidden = false;
    }
}

/* ------------------------------------------------------------------ how the outline goes on at an end */

typedef struct { double n, s, s2, s3, s4, x, xs, xs2, y, ys, ys2; } FitSums;

/* The middle of some sides, `along` of them from side `at` on in a direction. */
static void
point_at (const Outline *o, size_t at, int direction, size_t along, double *x, double *y)
{
  *x = *y = 0;
  for (size_t k = along; k < along + SIDES_A_POINT; k++)
    {
      const Side *side = side_at (o, direction > 0 ? at + k : at + o->n - k % o->n);
      const Side *next = side_at (o, direction > 0 ? at + k + 1 : at + o->n - k % o->n + 1);

      *x += (side->x + next->x) / (2.0 * SIDES_A_POINT);
      *y += (side->y + next->y) / (2.0 * SIDES_A_POINT);
    }
}

static void
add_point (double s, double x, double y, FitSums *sums)
{
  sums->n   += 1;
  sums->s   += s;
  sums->s2  += s * s;
  sums->s3  += s * s * s;
  sums->s4  += s * s * s * s;
  sums->x   += x;
  sums->xs  += x * s;
  sums->xs2 += x * s * s;
  sums->y   += y;
  sums->ys  += y * s;
  sums->ys2 += y * s * s;
}

/* Slope and second derivative at s = 0 of the parabola through sums of values: least squares by Cramer's rule; without
 * enough points those of a straight line. */
static void
fit (const FitSums *m, double v, double vs, double vs2, double *slope, double *bend)
{
  double a = m->s2 * m->s4 - m->s3 * m->s3, b = m->s * m->s4 - m->s2 * m->s3, c = m->s * m->s3 - m->s2 * m->s2;
  double determinant = m->n * a - m->s * b + m->s2 * c;

  *bend  = 0;
  *slope = (m->n * vs - m->s * v) / fmax (m->n * m->s2 - m->s * m->s, 1e-9);
  if (m->n < 5 || !(determinant > 1e-9 * m->n * m->s2 * m->s4))
    return;
  *slope = (m->n * (vs * m->s4 - vs2 * m->s3) - v * b + m->s2 * (m->s * vs2 - m->s2 * vs)) / determinant;
  *bend  = 2 * (m->n * (m->s2 * vs2 - m->s3 * vs) - m->s * (m->s * vs2 - m->s2 * vs) + v * c) / determinant;
}

/* Adds the end at side `at`, the last visible one, from which the visible piece of a length leads in a direction. */
static CeldStatus
add_end (const Outline *o, size_t at, int direction, size_t length, double gap)
{
  size_t         most = (size_t) fmax (LEAST_MOST, FITTED * o->diagonal), skipped = (size_t) (LEFT_OUT * o->diagonal);
  CeldOutlineEnd end = { .gap = gap };
  FitSums           sums = { 0 };
  double         s = 0, x, y, last_x = 0, last_y = 0, vx, vy, ax, ay, speed;

  length  = length < most ? length : most;
  skipped = skipped < length / 3 ? skipped : length / 3;
  if ((double) length < LEAST_FITTED * o->diagonal || length < 2 * SIDES_A_POINT)
    return CELD_OK;
  for (size_t k = skipped; k + SIDES_A_POINT <= length; k += SIDES_A_POINT)
    {
      point_at (o, at, direction, k, &x, &y);
      s += k > skipped ? hypot (x - last_x, y - last_y) : 0;
      add_point (s, x, y, &sums);
      last_x = x;
      last_y = y;
    }
  fit (&sums, sums.x, sums.xs, sums.xs2, &vx, &ax);
  fit (&sums, sums.y, sums.ys, sums.ys2, &vy, &ay);
  speed = hypot (vx, vy);
  if (!(speed > 0))
    return CELD_OK;
  point_at (o, at, direction, 0, &end.x, &end.y);
  end.direction = atan2 (-vy, -vx);
  end.curvature = -(vx * ay - vy * ax) / (speed * speed * speed);
  end.curvature = fmin (fmax (end.curvature, -MOST_CURVATURE / o->diagonal), MOST_CURVATURE / o->diagonal);
  return celd_append (o->ends->item, o->ends->n, o->ends->capacity, end);
}

/* Adds both ends of the hidden piece from side `from` on. */
static CeldStatus
add_ends (const Outline *o, size_t from, size_t length)
{
  const Side *in = side_at (o, from), *out = side_at (o, from + length);
  double      gap = hypot (out->x - in->x, out->y - in->y);
  size_t      before = 1, after = piece_length (o, from + length);
  CeldStatus  status;

  while (before < o->n && !side_at (o, from + 2 * o->n - before - 1)->hidden)
    before++;
  status = add_end (o, from + o->n - 1, -1, before, gap);
  return status == CELD_OK ? add_end (o, from + length, 1, after, gap) : status;
}

/* ------------------------------------------------------------------ the line along the outline */

/* Amount of ink of the region from (x,y) on along the unit vector (dx,dy), in pixels. */
static double
line_width (const Outline *o, double x, double y, double dx, double dy)
{
  double width = 0;

  for (double s = 0.25; s < MOST_WIDTH; s += 0.5)
    {
      int   px = (int) floor (x + dx * s), py = (int) floor (y + dy * s);
      float ink;

      if (!is_own (o, px, py))
        break;
      ink = CELD_AT (o->view->ink, px, py);
      if (celd_is_paper (ink) && s > 1.5)
        break;
      width += 0.5 * (1 - (ink > 0 ? ink < 1 ? (double) ink : 1 : 0));
    }
  return width;
}

static CeldStatus
measure_widths (Outline *o)
{
  for (size_t i = 0; i < o->n; i += WIDTHS_APART)
    {
      const Side *here = side_at (o, i), *back = side_at (o, i + o->n - 3 % o->n), *on = side_at (o, i + 3);
      double      dx = on->x - back->x, dy = on->y - back->y, length = hypot (dx, dy);

      if (here->hidden || back->hidden || on->hidden || !(length > 0))
        continue;
      if (celd_append (o->width, o->n_widths, o->width_capacity,
                       line_width (o, here->x, here->y, -dy / length, dx / length)) != CELD_OK)
        return CELD_NO_MEMORY;
    }
  return CELD_OK;
}

static int
compare_widths (const void *a, const void *b)
{
  double one = *(const double *) a, other = *(const double *) b;

  return (one > other) - (one < other);
}

/* ------------------------------------------------------------------ */

static CeldStatus
find_ends (const Outline *o)
{
  size_t     start;
  CeldStatus status = CELD_OK;

  drop_short_pieces (o);
  start = find_change (o);
  for (size_t i = 0, length; start < o->n && i < o->n && status == CELD_OK; i += length)
    {
      length = piece_length (o, start + i);
      if (side_at (o, start + i)->hidden)
        status = add_ends (o, start + i, length);
    }
  return status;
}

/* Does an end point at a place? */
static bool
points_at (const CeldOutlineEnd *end, double x, double y)
{
  double dx = x - end->x, dy = y - end->y;

  return dx * cos (end->direction) + dy * sin (end->direction) > cos (FACING) * hypot (dx, dy);
}

/* Is everything between two ends hidden?  The ends themselves lie a few pixels before what hides them. */
static bool
is_hidden_between (const Outline *o, const CeldOutlineEnd *from, const CeldOutlineEnd *to)
{
  double length = hypot (to->x - from->x, to->y - from->y), before = 2.0 * SIDES_A_POINT;

  for (double s = before; s < length - before; s += 1)
    if (!may_hide (o->view, (int) floor (from->x + (to->x - from->x) * s / length),
                   (int) floor (from->y + (to->y - from->y) * s / length)))
      return false;
  return true;
}

/* Where ends of different pieces go on to each other, the gap is what lies between them. */
static void
find_facing (const Outline *o)
{
  CeldOutlineEnds *ends = o->ends;

  for (size_t i = 0; i < ends->n; i++)
    {
      CeldOutlineEnd *end = &ends->item[i];
      double          nearest = INFINITY;

      for (size_t k = 0; k < ends->n; k++)
        {
          const CeldOutlineEnd *other = &ends->item[k];
          double                distance = hypot (other->x - end->x, other->y - end->y);

          if (distance < nearest && points_at (end, other->x, other->y) && points_at (other, end->x, end->y) &&
              is_hidden_between (o, end, other))
            nearest = distance;
        }
      end->gap = nearest < INFINITY && nearest > end->gap ? nearest : end->gap;
    }
}

/* Finds the ends on the loop that includes the upper side of pixel (x,y), and measures its line. */
static CeldStatus
examine_loop (Outline *o, int x, int y)
{
  CeldStatus status = trace_loop (o, x, y);

  if (status == CELD_OK)
    status = find_ends (o);
  return status == CELD_OK ? measure_widths (o) : status;
}

CeldStatus
celd_outline_ends_find (const CeldSheetView *view, CeldOutlineEnds *ends, double *pen)
{
  CeldRect   box = view->seen;
  Outline    o = { .view = view, .ends = ends };
  CeldStatus status;

  o.diagonal = hypot (view->own->owner.width, view->own->owner.height);
  status     = mark_own (&o);
  for (int y = 0; y < box.height && status == CELD_OK; y++)
    {
      const uint8_t *row = o.mask + (size_t) (y + 1) * o.stride + 1, *above = row - o.stride;

      for (int x = 0; x < box.width && status == CELD_OK; x++)
        if (row[x] == OWN && !(above[x] & OWN))
          status = examine_loop (&o, box.x + x, box.y + y);
    }
  if (status == CELD_OK)
    find_facing (&o);
  if (o.n_widths)
    qsort (o.width, o.n_widths, sizeof *o.width, compare_widths);
  *pen = o.n_widths ? o.width[o.n_widths / 2] : 0;
  celd_free (o.mask);
  celd_free (o.side);
  celd_free (o.width);
  return status;
}
