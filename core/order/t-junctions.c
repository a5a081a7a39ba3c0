/* The corners of outlines where three regions meet.
 *
 * Where one contour ends at another, the outline of the region on the far side of the bar of this T runs on as if there
 * were nothing; both others have a corner.  How sharply an outline trials is measured clear of the junction, where wide
 * ink rounds it: a parabola is fitted to each arm and continued to the junction, so that a round bar has no corner.
 * An arm that the parabola does not fit is shortened, down to what still has a direction.
 *
 * Everything is in stroke widths; places are as exact as antialiasing makes them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "order/suggest.h"

#include <math.h>

#define CELL     16             /* pixels: side of the cells in which outlines are looked up */
#define JUNCTION_RADIUS 4.0 /* stroke widths from a junction to the outlines round it, at most */
#define SAME_PLACE 2.0 /* stroke widths: junctions of the same regions as close as this are one */
#define GAP      0.75           /* stroke widths round the corner that are not looked at */
#define ARM      4.0            /* stroke widths of an arm */
#define SHORTEST 1.5
#define ROUGH    0.35           /* pixels that an outline may stray from a parabola, and a share of the stroke width */
#define ROUGH_BY 0.04

typedef struct
{
  const CeldRegionOutlines *outlines;
  double          stroke;
  size_t         *first;        /* of cell k: where[first[k]] .. before where[first[k + 1]] */
  size_t         *where;        /* points by cell */
  uint32_t       *loop;         /* of each point */
  int             columns, rows;
  CeldJunction  *corner;
  size_t          n;
  size_t          corner_capacity;
} Search;

/* ------------------------------------------------------------------ looking up outlines */

static size_t
cell_of (const Search *s, CeldOutlinePoint p)
{
  int column = (int) p.x / CELL, row = (int) p.y / CELL;

  column = column < s->columns ? column : s->columns - 1;
  row    = row < s->rows ? row : s->rows - 1;
  return (size_t) row * (size_t) s->columns + (size_t) column;
}

static CeldStatus
sort_points (Search *s)
{
  const CeldRegionOutlines *r = s->outlines;
  size_t          cells;

  s->columns = (r->width + CELL - 1) / CELL;
  s->rows    = (r->height + CELL - 1) / CELL;
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

/* The place on a label's outlines that is nearest to (x,y), SIZE_MAX if none is within reach. */
static size_t
nearest (const Search *s, uint32_t label, double x, double y)
{
  double reach = JUNCTION_RADIUS * s->stroke + 4, least = reach * reach;
  int    left = (int) fmax (0, (x - reach) / CELL), top = (int) fmax (0, (y - reach) / CELL);
  int    right = (int) fmin (s->columns - 1, (x + reach) / CELL), bottom = (int) fmin (s->rows - 1, (y + reach) / CELL);
  size_t found = SIZE_MAX;

  for (int row = top; row <= bottom; row++)
    for (int column = left; column <= right; column++)
      {
        size_t cell = (size_t) row * (size_t) s->columns + (size_t) column;

        for (size_t k = s->first[cell]; k < s->first[cell + 1]; k++)
          {
            CeldOutlinePoint p = s->outlines->point[s->where[k]];
            double       dx = (double) p.x - x, dy = (double) p.y - y;

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

/* Sums for fitting parabolas x(s), y(s). */
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

/* c0, c1, c2 of the parabola with these sums; by Cramer's rule. */
static void
solve (const double s[5], const double v[3], double c[3])
{
  double m00 = s[2] * s[4] - s[3] * s[3], m01 = s[1] * s[4] - s[3] * s[2], m02 = s[1] * s[3] - s[2] * s[2];
  double m11 = s[0] * s[4] - s[2] * s[2], m12 = s[0] * s[3] - s[1] * s[2], m22 = s[0] * s[2] - s[1] * s[1];
  double det = s[0] * m00 - s[1] * m01 + s[2] * m02;

  c[0] = (m00 * v[0] - m01 * v[1] + m02 * v[2]) / det;
  c[1] = (-m01 * v[0] + m11 * v[1] - m12 * v[2]) / det;
  c[2] = (m02 * v[0] - m12 * v[1] + m22 * v[2]) / det;
}

/* The direction at place i of the arm that leaves it, to the front or to the back; false if it cannot be told. */
static bool
fit_arm (const Search *s, size_t i, bool back, double length, double *dx, double *dy)
{
  const CeldOutlineLoop  *loop = &s->outlines->loop[s->loop[i]];
  const CeldOutlinePoint *point = s->outlines->point;
  double              gap = GAP * s->stroke + 1, at = 0, x0 = (double) point[i].x, y0 = (double) point[i].y;
  Sums                sums = { 0 };
  size_t              k = i - loop->first;
  double              cx[3], cy[3], rest, rough = ROUGH + ROUGH_BY * s->stroke;

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
  solve (sums.s, sums.x, cx);
  solve (sums.s, sums.y, cy);
  rest = sums.squares;
  for (int n = 0; n < 3; n++)
    rest -= cx[n] * sums.x[n] + cy[n] * sums.y[n];
  *dx = cx[1];
  *dy = cy[1];
  return rest <= rough * rough * sums.s[0] && hypot (*dx, *dy) > 0.1;
}

/* The longest arm that a parabola fits. */
static bool
find_arm (const Search *s, size_t i, bool back, double *dx, double *dy)
{
  for (double length = ARM; length >= SHORTEST; length *= 0.7)
    if (fit_arm (s, i, back, fmax (length * s->stroke, 2 * length), dx, dy))
      return true;
  return false;
}

static float
turn_at (const Search *s, size_t i)
{
  double ax, ay, bx, by;

  if (i == SIZE_MAX || !find_arm (s, i, true, &ax, &ay) || !find_arm (s, i, false, &bx, &by))
    return NAN;
  return (float) atan2 (ay * bx - ax * by, -(ax * bx + ay * by));
}

/* ------------------------------------------------------------------ junctions */

static bool
is_known (const Search *s, const uint32_t label[3], double x, double y)
{
  double near = SAME_PLACE * s->stroke + 2;

  for (size_t k = s->n; k-- > 0 && (double) s->corner[k].y > y - near;)
    if (!memcmp (s->corner[k].label, label, sizeof s->corner[k].label) &&
        hypot ((double) s->corner[k].x - x, (double) s->corner[k].y - y) < near)
      return true;
  return false;
}

static CeldStatus
add_junction (Search *s, uint32_t a, uint32_t b, uint32_t c, int x, int y)
{
  uint32_t       low = a < b ? a : b, high = a < b ? b : a;
  CeldJunction  corner = { (float) x, (float) y, { low < c ? low : c, 0, high > c ? high : c }, { 0 } };

  corner.label[1] = c < low ? low : c > high ? high : c;
  if (is_known (s, corner.label, x, y))
    return CELD_OK;
  for (int k = 0; k < 3; k++)
    corner.turn[k] = turn_at (s, nearest (s, corner.label[k], x, y));
  return celd_append (s->corner, s->n, s->corner_capacity, corner);
}

/* All threes among the four labels round a corner of pixels. */
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
celd_junctions_find (const CeldLabels *labels, size_t n_labels, const CeldRegionOutlines *outlines, const CeldHost *host,
                       CeldJunction **corners, size_t *n)
{
  Search     s = { .outlines = outlines, .stroke = outlines->stroke };
  CeldStatus status = sort_points (&s);

  if (status == CELD_OK)
    status = search (&s, labels, n_labels, host);
  if (status == CELD_OK)
    {
      *corners = s.corner;
      *n       = s.n;
    }
  else
    celd_free (s.corner);
  celd_free (s.first);
  celd_free (s.where);
  celd_free (s.loop);
  return status;
}
