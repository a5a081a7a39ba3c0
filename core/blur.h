/* Wide Gaussians over a picture, made on cells of several pixels.
 *
 * A Gaussian of deviation s hardly changes within a box of s / 2 pixels, so it is made of the means of such boxes, and
 * read between their middles.  Boxes and reading spread by themselves; what they spread is taken off the deviation.
 * The picture goes on mirrored at its edges.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BLUR_H
#define CELD_BLUR_H

#include "private.h"

typedef struct
{
  int picture_width, picture_height;
  int side;                        /* of a cell in pixels, a power of two; those at the right and bottom are cut off */
  int width, height;               /* in cells */
} CeldCells;

/* Weights of the cells first .. first + n - 1 to the right of one; they add up to 1. */
typedef struct { int first, n; float *weight; } CeldKernel;

/* Where a column (or row) of pixels lies between cells: (1 - share) of one and share of the other. */
typedef struct { int one, other; float share; } CeldBetween;

/* Cells for a Gaussian of this deviation in pixels, > 0. */
CeldCells celd_cells (int width, int height, double deviation);

/* Centred `shift` pixels to the right; end with celd_free (weight). */
CeldStatus celd_kernel_new (const CeldCells *cells, double deviation, double shift, CeldKernel *kernel);

/* The picture's columns between the cells' columns, and the same for rows; NULL: no memory. */
CeldBetween *celd_between_columns (const CeldCells *cells);
CeldBetween *celd_between_rows    (const CeldCells *cells);

/* width x height values by one kernel along rows and one along columns, mirrored at the edges; `scratch` is as
 * large. */
void celd_blur (const CeldKernel *along, const CeldKernel *down, int width, int height, float *value, float *scratch);

#endif
