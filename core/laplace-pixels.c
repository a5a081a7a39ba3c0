/* Passes of the Laplacian solver over the pixels, a strip of rows at a time, on the host's threads.
 *
 * The cycle relaxes by red-black Gauss-Seidel: red, black, coarse correction, black, red.  Red pixels are those with
 * x + y even.  A black value is made anew from red ones each time, so that only red ones are ever guessed, corrected
 * and restricted.  What a pass sums up it sums row by row, so that the result does not depend on threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"

#include <math.h>
#include <string.h>

#define STRIP   32   /* rows in one piece of work; even, so that no cell of 2 x 2 pixels is divided */
#define STRETCH 1.4f /* of the coarse correction, which is too short where it is constant on aggregates */

enum { RED, BLACK };

/* What the strips of a pass need. */
typedef struct
{
  const CeldLaplace *laplace;
  CeldSolution      *s;
  float             *coarse;    /* vector on the first coarse level */
  double             factor;
  int                colour;
} Pass;

/* One row of the grid: its first pixel, the edges up and down, and how far the rows above and below are. */
typedef struct
{
  size_t       first;
  ptrdiff_t    up, down;        /* 0 at the frame, where the edges have weight 0 */
  const float *north, *south, *east;
} Row;

static Row
row_at (const CeldLaplace *l, int y)
{
  size_t width = (size_t) l->width, first = (size_t) y * width;
  bool   top = y == 0, bottom = y + 1 == l->height;

  return (Row) {
    .first = first,
    .up    = top ? 0 : -(ptrdiff_t) width,
    .down  = bottom ? 0 : (ptrdiff_t) width,
    .north = top ? l->nothing : l->south + first - width,
    .south = bottom ? l->nothing : l->south + first,
    .east  = l->east + first,
  };
}

static int
first_row (int strip)
{
  return strip * STRIP;
}

static int
end_row (const CeldLaplace *l, int strip)
{
  return l->height - strip * STRIP < STRIP ? l->height : (strip + 1) * STRIP;
}

static void
each_strip (Pass *pass, const CeldRun *run, void (*body) (void *pass, int strip))
{
  celd_each (run, (pass->laplace->height + STRIP - 1) / STRIP, body, pass);
}

/* ------------------------------------------------------------------ the matrix */

/* Sum over the neighbours of pixel x of the row of weight times v; v is at the row's first pixel. */
static inline float
pull (const Row *row, int x, int width, const float *v)
{
  float sum = row->north[x] * v[x + row->up] + row->south[x] * v[x + row->down];

  if (x > 0)
    sum += row->east[x - 1] * v[x - 1];
  if (x + 1 < width)
    sum += row->east[x] * v[x + 1];
  return sum;
}

/* out = A v in one row; differences first, so that flat parts give exactly nothing. */
static void
apply_row (const CeldLaplace *l, int y, const double *v, double *out)
{
  Row           row = row_at (l, y);
  const double *here = v + row.first, *above = here + row.up, *below = here + row.down;
  const float  *diagonal = l->diagonal + row.first;
  int           last = l->width - 1;

  out += row.first;
  for (int x = 0; x <= last; x++)
    out[x] = (double) diagonal[x] * here[x] + (double) row.north[x] * (here[x] - above[x]) +
             (double) row.south[x] * (here[x] - below[x]);
  if (last == 0)
    return;
  out[0] += (double) row.east[0] * (here[0] - here[1]);
  for (int x = 1; x < last; x++)
    out[x] += (double) row.east[x] * (here[x] - here[x + 1]) + (double) row.east[x - 1] * (here[x] - here[x - 1]);
  out[last] += (double) row.east[last - 1] * (here[last] - here[last - 1]);
}

void
celd_pixels_invert (CeldLaplace *l)
{
  for (int y = 0; y < l->height; y++)
    {
      Row row = row_at (l, y);

      for (int x = 0; x < l->width; x++)
        {
          float west = x > 0 ? row.east[x - 1] : 0, east = x + 1 < l->width ? row.east[x] : 0;
          float full = l->diagonal[row.first + (size_t) x] + (row.north[x] + west + east + row.south[x]);

          l->inverse[row.first + (size_t) x] = full > 0 ? 1 / full : 0;
        }
    }
}

static void
residual_strip (void *data, int strip)
{
  const Pass *pass  = data;
  double     *r     = pass->s->r;
  size_t      width = (size_t) pass->laplace->width;

  for (int y = first_row (strip); y < end_row (pass->laplace, strip); y++)
    {
      apply_row (pass->laplace, y, pass->s->x, r);
      for (size_t i = (size_t) y * width; i < (size_t) (y + 1) * width; i++)
        r[i] = -r[i];
    }
}

void
celd_pixels_residual (const CeldLaplace *l, const CeldRun *run, CeldSolution *s)
{
  Pass pass = { .laplace = l, .s = s };

  each_strip (&pass, run, residual_strip);
}

/* ------------------------------------------------------------------ the cycle */

/* Red pixels from z = 0. */
static void
guess_strip (void *data, int strip)
{
  const Pass        *pass = data;
  const CeldLaplace *l    = pass->laplace;

  for (int y = first_row (strip); y < end_row (l, strip); y++)
    for (int x = y & 1; x < l->width; x += 2)
      {
        size_t i = (size_t) y * (size_t) l->width + (size_t) x;

        pass->s->z[i] = l->inverse[i] * (float) pass->s->r[i];
      }
}

/* Gauss-Seidel for the pixels of one colour. */
static void
relax_strip (void *data, int strip)
{
  const Pass        *pass = data;
  const CeldLaplace *l    = pass->laplace;

  for (int y = first_row (strip); y < end_row (l, strip); y++)
    {
      Row           row     = row_at (l, y);
      float        *z       = pass->s->z + row.first;
      const double *r       = pass->s->r + row.first;
      const float  *inverse = l->inverse + row.first;

      for (int x = (y + pass->colour) & 1; x < l->width; x += 2)
        z[x] = inverse[x] * ((float) r[x] + pull (&row, x, l->width, z));
    }
}

/* After black pixels only red ones have a residual, and that is what their neighbours pull. */
static void
restrict_strip (void *data, int strip)
{
  const Pass        *pass = data;
  const CeldLaplace *l    = pass->laplace;

  for (int y = first_row (strip); y < end_row (l, strip); y++)
    {
      Row             row     = row_at (l, y);
      const uint32_t *coarser = l->levels.coarser + row.first;

      for (int x = y & 1; x < l->width; x += 2)
        if (coarser[x] != CELD_NO_NODE)
          pass->coarse[coarser[x]] += pull (&row, x, l->width, pass->s->z + row.first);
    }
}

static void
correct_strip (void *data, int strip)
{
  const Pass        *pass = data;
  const CeldLaplace *l    = pass->laplace;

  for (int y = first_row (strip); y < end_row (l, strip); y++)
    for (int x = y & 1; x < l->width; x += 2)
      {
        size_t   i    = (size_t) y * (size_t) l->width + (size_t) x;
        uint32_t node = l->levels.coarser[i];

        if (node != CELD_NO_NODE)
          pass->s->z[i] += STRETCH * pass->coarse[node];
      }
}

void
celd_pixels_cycle (CeldLaplace *l, const CeldRun *run, CeldSolution *s)
{
  CeldLevel *coarse = &l->levels.level[0];
  Pass       pass   = { .laplace = l, .s = s, .coarse = coarse->b, .colour = BLACK };

  each_strip (&pass, run, guess_strip);
  each_strip (&pass, run, relax_strip);

  memset (coarse->b, 0, coarse->n * sizeof *coarse->b);
  each_strip (&pass, run, restrict_strip);
  celd_levels_cycle (&l->levels);
  pass.coarse = coarse->x;
  each_strip (&pass, run, correct_strip);

  each_strip (&pass, run, relax_strip);
  pass.colour = RED;
  each_strip (&pass, run, relax_strip);
}

/* ------------------------------------------------------------------ the conjugate gradient */

static double
sum_rows (const CeldLaplace *l, const double *row)
{
  double sum = 0;

  for (int y = 0; y < l->height; y++)
    sum += row[y];
  return sum;
}

static void
measure_strip (void *data, int strip)
{
  const Pass         *pass  = data;
  const CeldSolution *s     = pass->s;
  size_t              width = (size_t) pass->laplace->width;

  for (int y = first_row (strip); y < end_row (pass->laplace, strip); y++)
    {
      double zr = 0, zq = 0, largest = 0;

      for (size_t i = (size_t) y * width; i < (size_t) (y + 1) * width; i++)
        {
          double z = (double) s->z[i], size = z < 0 ? -z : z;

          zr += z * s->r[i];
          zq += z * s->q[i];
          largest = size > largest ? size : largest;
        }
      s->row[0][y] = zr;
      s->row[1][y] = zq;
      s->row[2][y] = largest;
    }
}

void
celd_pixels_measure (const CeldLaplace *l, const CeldRun *run, CeldSolution *s, double *zr, double *zq, double *largest)
{
  Pass pass = { .laplace = l, .s = s };

  each_strip (&pass, run, measure_strip);
  *zr      = sum_rows (l, s->row[0]);
  *zq      = sum_rows (l, s->row[1]);
  *largest = 0;
  for (int y = 0; y < l->height; y++)
    *largest = fmax (*largest, s->row[2][y]);
}

static void
direction_strip (void *data, int strip)
{
  const Pass         *pass = data;
  const CeldSolution *s    = pass->s;
  size_t              width = (size_t) pass->laplace->width;
  size_t              end   = (size_t) end_row (pass->laplace, strip) * width;

  for (size_t i = (size_t) first_row (strip) * width; i < end; i++)
    s->p[i] = (double) s->z[i] + pass->factor * s->p[i];
}

static void
apply_strip (void *data, int strip)
{
  const Pass         *pass  = data;
  const CeldSolution *s     = pass->s;
  size_t              width = (size_t) pass->laplace->width;

  for (int y = first_row (strip); y < end_row (pass->laplace, strip); y++)
    {
      double pq = 0;

      apply_row (pass->laplace, y, s->p, s->q);
      for (size_t i = (size_t) y * width; i < (size_t) (y + 1) * width; i++)
        pq += s->p[i] * s->q[i];
      s->row[0][y] = pq;
    }
}

double
celd_pixels_turn (const CeldLaplace *l, const CeldRun *run, CeldSolution *s, double beta)
{
  Pass pass = { .laplace = l, .s = s, .factor = beta };

  each_strip (&pass, run, direction_strip);
  each_strip (&pass, run, apply_strip);
  return sum_rows (l, s->row[0]);
}

static void
advance_strip (void *data, int strip)
{
  const Pass         *pass  = data;
  const CeldSolution *s     = pass->s;
  size_t              width = (size_t) pass->laplace->width;

  for (int y = first_row (strip); y < end_row (pass->laplace, strip); y++)
    {
      double low = INFINITY, high = -INFINITY;

      for (size_t i = (size_t) y * width; i < (size_t) (y + 1) * width; i++)
        {
          s->x[i] += pass->factor * s->p[i];
          s->r[i] -= pass->factor * s->q[i];
          low  = s->x[i] < low ? s->x[i] : low;
          high = s->x[i] > high ? s->x[i] : high;
        }
      s->row[0][y] = low;
      s->row[1][y] = high;
    }
}

void
celd_pixels_advance (const CeldLaplace *l, const CeldRun *run, CeldSolution *s, double alpha, double *low, double *high)
{
  Pass pass = { .laplace = l, .s = s, .factor = alpha };

  each_strip (&pass, run, advance_strip);
  *low  = INFINITY;
  *high = -INFINITY;
  for (int y = 0; y < l->height; y++)
    {
      *low  = fmin (*low, s->row[0][y]);
      *high = fmax (*high, s->row[1][y]);
    }
}
