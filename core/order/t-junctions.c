/* Junctions, where three regions meet, and how their outlines turn there.
 *
 * Where one contour ends at another, the two make a T: the outline of the region beyond the bar continues without a
 * corner, those of both others have one.  Wide ink rounds corners, so that directions are measured at some distance: a
 * parabola is fitted to each arm of the outline and continued to the junction, so that a curved bar has no corner.  An
 * arm that does not fit a parabola is shortened, as long as it still has a direction.
 *
 * Cost: one pass over the picture, and a look-up in a grid of cells for each junction.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "order/order.h"

#include <math.h>

#define CELL_SIDE             16   /* pixels, of the grid in which points of outlines are looked up; chosen */
#define JUNCTION_RADIUS       4.0  /* stroke widths from a junction to the outlines round it, at most; chosen */
#define SAME_JUNCTION         2.0  /* stroke widths between junctions of the same regions that count as one; chosen */
#define CORNER_RADIUS         0.75 /* stroke widths at a junction, where corners are rounded; not measured; chosen */
#define LONGEST_JUNCTION_ARM  4.0  /* stroke widths; chosen */
#define SHORTEST_JUNCTION_ARM 1.5  /* stroke widths; chosen */
#define ARM_STEP              0.7  /* factor by which an arm is shortened; chosen */
#define FIT_PIXELS            0.35 /* root mean square distance from the parabola, pixels, ...; chosen */
#define FIT_STROKE            0.04 /* ... plus this fraction of the stroke width; chosen */

typedef struct
{
  const CeldRegionOutlines *outlines;
  double                    stroke;  /* width in pixels */
  size_t                   *first;   /* points of cell k: where[first[k]] to where[first[k + 1] - 1] */
  size_t                   *where;   /* points by cell */
  uint32_t                 *loop;    /* of each point */
  int                       columns, rows;
  CeldJunction             *junction;
  size_t                    n, junction_capacity;
} Search;

/* ------------------------------------------------------------------ looking up outlines */

static size_t
cell_of (const Search *s, CeldOutlinePoint p)
{
  int column = (int) p.x / CELL_SIDE, row = (int) p.y / CELL_SIDE;

  column = column < s->columns ? column : s->columns - 1;
  row    = row < s->rows ? row : s->rows - 1;
  return (size_t) row * (size_t) s->columns + (size_t) column;
}

/* Sorts the points of all outlines into cells. */
static CeldStatus
sort_points (Search *s)
{
  const CeldRegionOutlines *r = s->outlines;
  size_t                    cells;

  s->columns = (r->width + CELL_SIDE - 1) / CELL_SIDE;
  s->rows    = (r->height + CELL_SIDE - 1) / CELL_SIDE;
  cells      = (size_t) s->columns * (size_t) s->rows;
  s->first   = celd_alloc0 (cells + 2, sizeof *s->first);
  s->where   = celd_alloc (r->n_points, sizeof *s->where);
  s->loop    = celd_alloc (r->n_points, sizeof *s->loop);
  if (!s->first || !s->where || !s->loop)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < r->n_loops; k++)
    for (size_t i = r->loop[k].first; i < r->loop[k].first + r->loop[k].n; i++)
      {
        s->loop[i] = (uint32_t) k;
        s->first[cell_of (s, r->point[i]) + 2]++;
      }
  for (size_t k = 2; k < cells + 2; k++)
    s->first[k] += s->first[k - 1];
  for (size_t i = 0; i < r->n_points; i++)
    s->where[s->first[cell_of (s, r->point[i]) + 1]++] = i;
  return CELD_OK;
}

/* The point of a label's outlines that is nearest to (x,y); SIZE_MAX if none is near. */
static size_t
nearest_point (const Search *s, uint32_t label, double x, double y)
{
  double radius = JUNCTION_RADIUS * s->stroke + 4, least = radius * radius;
  int    left = (int) fmax (0, (x - radius) / CELL_SIDE), top = (int) fmax (0, (y - radius) / CELL_SIDE);
  int    right = (int) fmin (s->columns - 1, (x + radius) / CELL_SIDE);
  int    bottom = (int) fmin (s->rows - 1, (y + radius) / CELL_SIDE);
  size_t found = SIZE_MAX;

  for (int row = top; row <= bottom; row++)
    for (int column = left; column <= right; column++)
      {
        size_t cell = (size_t) row * (size_t) s->columns + (size_t) column;

        for (size_t k = s->first[cell]; k < s->first[cell + 1]; k++)
          {
            CeldOutlinePoint p = s->outlines->point[s->where[k]];
            double           dx = (double) p.x - x, dy = (double) p.y - y;

            if (dx * dx + dy * dy < least && s->outlines->loop[s->loop[s->where[k]]].label == label)
              {
                least = dx * dx + dy * dy;
                found = s->where[k];
              }
          }
      }
  return found;
}

/* ------------------------------------------------------------------ arms */

/* Sums over points for fitting parabolas x(s), y(s) by least squares: s^k, x s^k, y s^k, x^2 + y^2. */
typedef struct { double s[5], x[3], y[3], squares; } Sums;

static void
sum_up (Sums *sums, double s, double x, double y)
{
  double power = 1;

  for (int k = 0; k < 5; k++, power *= s)
    {
      sums->s[k] += power;
      if (k < 3)
        {
          sums->x[k] += power * x;
          sums->y[k] += power * y;
        }
    }
  sums->squares += x * x + y * y;
}

/* Solves the normal equations for the parabola c[0] + c[1] s + c[2] s^2 by Cramer's rule. */
static void
fit_parabola (const double s[5], const double v[3], double c[3])
{
  double m00 = s[2] * s[4] - s[3] * s[3], m01 = s[1] * s[4] - s[3] * s[2], m02 = s[1] * s[3] - s[2] * s[2];
  double m11 = s[0] * s[4] - s[2] * s[2], m12 = s[0] * s[3] - s[1] * s[2], m22 = s[0] * s[2] - s[1] * s[1];
  double det = s[0] * m00 - s[1] * m01 + s[2] * m02;

  c[0] = (m00 * v[0] - m01 * v[1] + m02 * v[2]) / det;
  c[1] = (-m01 * v[0] + m11 * v[1] - m12 * v[2]) / det;
  c[2] = (m02 * v[0] - m12 * v[1] + m22 * v[2]) / det;
}

/* The direction at point i of the arm that follows it on the outline, or that precedes it; false if the arm is too
 * short or does not fit a parabola. */
static bool
fit_arm (const Search *s, size_t i, bool back, double length, double *dx, double *dy)
{
  const CeldOutlineLoop  *loop = &s->outlines->loop[s->loop[i]];
  const CeldOutlinePoint *point = s->outlines->point;
  double                  x0 = (double) point[i].x, y0 = (double) point[i].y;
  double                  gap = CORNER_RADIUS * s->stroke + 1, at = 0;
  Sums                    sums = { 0 };
  size_t                  k = i - loop->first;
  double                  cx[3], cy[3], rest, most = FIT_PIXELS + FIT_STROKE * s->stroke;

  for (size_t steps = 0; steps < loop->n / 2 && at < gap + length; steps++)
    {
      size_t next = back ? (k ? k : loop->n) - 1 : k + 1 < loop->n ? k + 1 : 0;
      double x = (double) point[loop->first + next].x, y = (double) point[loop->first + next].y;

      at += hypot (x - (double) point[loop->first + k].x, y - (double) point[loop->first + k].y);
      k   = next;
      if (at >= gap)
        sum_up (&sums, at, x - x0, y - y0);
    }
  if (at < gap + length || sums.s[0] < 4)
    return false;
  fit_parabola (sums.s, sums.x, cx);
  fit_parabola (sums.s, sums.y, cy);
  rest = sums.squares;
  for (int n = 0; n < 3; n++)
    rest -= cx[n] * sums.x[n] + cy[n] * sums.y[n];
  *dx = cx[1];
  *dy = cy[1];
  return rest <= most * most * sums.s[0] && hypot (*dx, *dy) > 0.1;
}

/* The direction of the longest arm that fits a parabola. */
static bool
find_arm (const Search *s, size_t i, bool back, double *dx, double *dy)
{
  for (double length = LONGEST_JUNCTION_ARM; length >= SHORTEST_JUNCTION_ARM; length *= ARM_STEP)
    if (fit_arm (s, i, back, fmax (length * s->stroke, 2 * length), dx, dy))
      return true;
  return false;
}

/* The angle by which the outline turns at point i, as in CeldJunction. */
static float
turn_at (const Search *s, size_t i)
{
  double ax, ay, bx, by;

  if (i == SIZE_MAX || !find_arm (s, i, true, &ax, &ay) || !find_arm (s, i, false, &bx, &by))
    return NAN;
  return (float) atan2 (ay * bx - ax * by, -(ax * bx + ay * by));
}

/* ------------------------------------------------------------------ junctions */

/* Is there a junction of these labels already near (x,y)? */
static bool
is_known (const Search *s, const uint32_t label[3], double x, double y)
{
  double near = SAME_JUNCTION * s->stroke + 2;

  for (size_t k = s->n; k-- > 0 && (double) s->junction[k].y > y - near;)
    if (!memcmp (s->junction[k].label, label, sizeof s->junction[k].label) &&
        hypot ((double) s->junction[k].x - x, (double) s->junction[k].y - y) < near)
      return true;
  return false;
}

static CeldStatus
add_junction (Search *s, uint32_t a, uint32_t b, uint32_t c, int x, int y)
{
  uint32_t     low = a < b ? a : b, high = a < b ? b : a;
  CeldJunction junction = { (float) x, (float) y, { low < c ? low : c, 0, high > c ? high : c }, { 0 } };

  junction.label[1] = c < low ? low : c > high ? high : c;
  if (is_known (s, junction.label, x, y))
    return CELD_OK;
  for (int k = 0; k < 3; k++)
    junction.turn[k] = turn_at (s, nearest_point (s, junction.label[k], x, y));
  return celd_append (s->junction, s->n, s->junction_capacity, junction);
}

/* Adds a junction for all sets of three different labels among the four round a corner of pixels. */
static CeldStatus
try_corner (Search *s, const uint32_t four[4], int x, int y)
{
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 4; i++)
    for (int j = i + 1; j < 4; j++)
      for (int k = j + 1; k < 4 && status == CELD_OK; k++)
        if (four[i] && four[j] && four[k] && four[i] != four[j] && four[j] != four[k] && four[i] != four[k])
          status = add_junction (s, four[i], four[j], four[k], x, y);
  return status;
}

static CeldStatus
search (Search *s, const CeldLabels *labels, size_t n_labels, const CeldHost *host)
{
  CeldStatus status = CELD_OK;

  for (int y = 1; y < labels->height && status == CELD_OK; y++)
    {
      const uint32_t *above = &CELD_AT (labels, 0, y - 1), *row = &CELD_AT (labels, 0, y);

      for (int x = 1; x < labels->width && status == CELD_OK; x++)
        {
          uint32_t four[4] = { above[x - 1], above[x], row[x - 1], row[x] };

          if ((four[0] == four[1] && four[2] == four[3]) || (four[0] == four[2] && four[1] == four[3]))
            continue;
          for (int k = 0; k < 4; k++)
            if (!four[k] || four[k] > n_labels)
              four[k] = four[(k + 1) & 3];
          status = try_corner (s, four, x, y);
        }
      if (status == CELD_OK && (y & 255) == 255)
        status = celd_progress (host, (double) y / labels->height);
    }
  return status;
}

CeldStatus
celd_junctions_find (const CeldLabels *labels, size_t n_labels, const CeldRegionOutlines *outlines,
                     const CeldHost *host, CeldJunction **junctions, size_t *n)
{
  Search     s = { .outlines = outlines, .stroke = outlines->stroke };
  CeldStatus status = sort_points (&s);

  if (status == CELD_OK)
    status = search (&s, labels, n_labels, host);
  if (status == CELD_OK)
    {
      *junctions = s.junction;
      *n         = s.n;
    }
  else
    celd_free (s.junction);
  celd_free (s.first);
  celd_free (s.where);
  celd_free (s.loop);
  return status;
}
