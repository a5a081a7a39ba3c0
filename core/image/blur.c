/* Wide Gaussian blurs on a coarse grid: mean values of square cells are blurred, and interpolated between cells.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

#define FINEST 2   /* cells in a deviation, at least (chosen: the error stays invisible) */
#define KERNEL_DEVIATIONS  3.2 /* at which a Gaussian is cut off (chosen) */

CeldBlurGrid
celd_cells (int width, int height, double deviation)
{
  CeldBlurGrid cells = { width, height, 1, width, height };

  while (2 * FINEST * cells.side <= deviation && 2 * cells.side <= CELD_MAX_SIDE)
    cells.side *= 2;
  cells.width  = (width + cells.side - 1) / cells.side;
  cells.height = (height + cells.side - 1) / cells.side;
  return cells;
}

CeldStatus
celd_kernel_new (const CeldBlurGrid *cells, double deviation, double shift, CeldKernel *kernel)
{
  /* Averaging n pixels adds (n^2 - 1) / 12 to the variance, linear interpolation (n^2 - 1) / 6 in the mean. */
  double side = cells->side, spread = deviation * deviation - (side * side - 1) / 4;
  double s = sqrt (fmax (spread, 0.01)) / side, centre = shift / side, sum = 0;
  int    last = (int) ceil (centre + KERNEL_DEVIATIONS * s);

  kernel->first  = (int) floor (centre - KERNEL_DEVIATIONS * s);
  kernel->n      = last - kernel->first + 1;
  kernel->weight = celd_alloc ((size_t) kernel->n, sizeof *kernel->weight);
  if (!kernel->weight)
    return CELD_NO_MEMORY;
  for (int i = 0; i < kernel->n; i++)
    {
      double t = (kernel->first + i - centre) / s;

      sum += kernel->weight[i] = (float) exp (-0.5 * t * t);
    }
  for (int i = 0; i < kernel->n; i++)
    kernel->weight[i] = (float) ((double) kernel->weight[i] / sum);
  return CELD_OK;
}

static CeldBetween *
between (int pixels, int side, int cells)
{
  CeldBetween *b = celd_alloc ((size_t) pixels, sizeof *b);

  for (int i = 0; b && i < pixels; i++)
    {
      double place = fmin (fmax ((i + 0.5) / side - 0.5, 0), cells - 1);
      int    one = (int) place;

      b[i] = (CeldBetween) { one, one + 1 < cells ? one + 1 : one, (float) (place - one) };
    }
  return b;
}

CeldBetween *
celd_between_columns (const CeldBlurGrid *cells)
{
  return between (cells->picture_width, cells->side, cells->width);
}

CeldBetween *
celd_between_rows (const CeldBlurGrid *cells)
{
  return between (cells->picture_height, cells->side, cells->height);
}

/* i, mirrored at both ends of 0 .. n-1 as often as needed. */
static int
mirror (int i, int n)
{
  while (i < 0 || i >= n)
    i = i < 0 ? -1 - i : 2 * n - 1 - i;
  return i;
}

/* Blurs one row of values. */
static void
blur_row (const CeldKernel *kernel, int width, const float *from, float *to)
{
  for (int x = 0; x < width; x++)
    {
      float sum = 0;

      for (int i = 0; i < kernel->n; i++)
        sum += kernel->weight[i] * from[mirror (x + kernel->first + i, width)];
      to[x] = sum;
    }
}

CELD_CLONES static void
blur_add_row (int width, float weight, const float *from, float *to)
{
  for (int x = 0; x < width; x++)
    to[x] += weight * from[x];
}

void
celd_blur (const CeldKernel *along, const CeldKernel *down, int width, int height, float *value, float *scratch)
{
  size_t row = (size_t) width;

  for (int y = 0; y < height; y++)
    blur_row (along, width, value + (size_t) y * row, scratch + (size_t) y * row);
  memset (value, 0, row * (size_t) height * sizeof *value);
  for (int y = 0; y < height; y++)
    for (int i = 0; i < down->n; i++)
      blur_add_row (width, down->weight[i], scratch + (size_t) mirror (y + down->first + i, height) * row,
                    value + (size_t) y * row);
}
