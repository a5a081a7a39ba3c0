/* What the files that find the ink of a drawing share.  `contrast` planes hold the contrast of each pixel against the
 * paper, 0 .. 1.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_INK_H
#define CELD_INK_H

#include "base/base.h"

#define CELD_INK_BINS  256 /* of a histogram of values in [0,1] */
#define CELD_INK_BANKS 4   /* histograms filled in turn: adding to the same count twice running would have to wait */

/* fminf and fmaxf without a call; not for NaN. */
static inline float
celd_least (float a, float b)
{
  return a < b ? a : b;
}

static inline float
celd_most (float a, float b)
{
  return a > b ? a : b;
}

/* ------------------------------------------------------------------ ink-noise.c */

/* The standard deviation of the paper's grain at the scale of `step` pixels, from the median second difference along
 * rows where there is no ink. */
float celd_ink_noise (const CeldPlane *contrast, int step);

/* The strength of compression artefacts: the ripple that one of ten paper pixels near dark ink exceeds; 0 in a clean
 * picture.  `around` holds the largest contrast near each pixel, `dark` the contrast of dark strokes. */
float celd_ink_echo (const CeldPlane *contrast, const CeldPlane *around, float dark);

/* One pass of the binomial filter (1 2 1)/4 in both directions, in place; `spare`, of the same size, is overwritten. */
void celd_ink_smooth (CeldPlane *plane, CeldPlane *spare);

#endif
