/* What the files that find the ink of a drawing share.  Contrast: that of each pixel against the paper, 0 .. 1.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_INK_H
#define CELD_INK_H

#include "base/base.h"

/* fminf and fmaxf, but for numbers only and not through a call. */
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

/* The standard deviation of the paper's grain at one scale: median second difference along rows, where no ink is. */
float celd_ink_noise (const CeldPlane *contrast, int step);

/* The ripple that one of ten paper pixels near dark ink exceeds: the echoes of a lossy picture; 0 in a clean one.
 * `around` is the largest contrast in some neighbourhood. */
float celd_ink_echo (const CeldPlane *contrast, const CeldPlane *around, float dark);

/* One pass of the binomial filter (1 2 1)/4 in both directions; `spare` is overwritten. */
void celd_ink_smooth (CeldPlane *plane, CeldPlane *spare);

#endif
