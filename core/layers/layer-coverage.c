/* Coverage of pixels by a polygon: exact areas to the right of directed edges, accumulated along rows.
 *
 * An edge that goes up by h through a pixel adds h to everything beyond it in the row, and one that goes down subtracts
 * h, so that the sum along a row is the winding number.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"

#include <math.h>

CeldStatus
celd_coverage_new (CeldRect box, CeldCoverage *coverage)
{
  /* rows have one more number, for what lies beyond their end */
  *coverage = (CeldCoverage) { box, celd_alloc0 ((size_t) (box.width + 1) * (size_t) box.height,
                                                 sizeof *coverage->sum) };
  return coverage->sum ? CELD_OK : CELD_NO_MEMORY;
}

/* Adds a piece of height h within one row and one column, whose middle is at x. */
static void
add_piece (CeldCoverage *coverage, int row, double x, double h)
{
  float *sum    = coverage->sum + (size_t) row * (size_t) (coverage->box.width + 1);
  int    column = (int) floor (x);

  if (column < 0)
    sum[0] -= (float) h;
  else if (column < coverage->box.width)
    {
      double left = x - column;

      sum[column]     -= (float) (h * (1 - left));
      sum[column + 1] -= (float) (h * left);
    }
}

/* Adds a piece within one row, cut at the boundaries of columns. */
static void
add_row (CeldCoverage *coverage, int row, double x, double y, double to_x, double to_y)
{
  while (y != to_y)
    {
      double next_column = to_x > x ? floor (x) + 1 : ceil (x) - 1, next_y = to_y, next_x = to_x;

      if (to_x > x ? next_column < to_x : to_x < x && next_column > to_x)
        {
          next_x = next_column;
          next_y = y + (to_y - y) * (next_column - x) / (to_x - x);
        }
      add_piece (coverage, row, (x + next_x) / 2, next_y - y);
      x = next_x;
      y = next_y;
    }
}

void
celd_coverage_edge (CeldCoverage *coverage, double x, double y, double to_x, double to_y)
{
  double slope = to_y != y ? (to_x - x) / (to_y - y) : 0;
  double first = fmin (y, to_y) - coverage->box.y, last = fmax (y, to_y) - coverage->box.y;

  for (int row = (int) fmax (floor (first), 0); row < coverage->box.height && row < last; row++)
    {
      double top = fmax (first, row), bottom = fmin (last, row + 1);
      double a = y < to_y ? top : bottom, b = y < to_y ? bottom : top; /* in the edge's direction */

      add_row (coverage, row, x + slope * (a + coverage->box.y - y) - coverage->box.x, a,
               x + slope * (b + coverage->box.y - y) - coverage->box.x, b);
    }
}

void
celd_coverage_finish (CeldCoverage *coverage)
{
  const float *from = coverage->sum;
  float       *to = coverage->sum;

  for (int y = 0; y < coverage->box.height; y++, from++)
    {
      double winding = 0;

      for (int x = 0; x < coverage->box.width; x++)
        {
          winding += (double) *from++;
          *to++ = (float) fmin (fmax (winding, 0), 1);
        }
    }
}
