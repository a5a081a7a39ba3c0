/* What depth enhancement (enhance.c) shares with the stack of shadows (shadows.c, level-numbers.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SHADOWS_H
#define CELD_SHADOWS_H

#include "base/base.h"

#include <math.h>

/* The level or depth of a pixel; NaN and infinity read as 0. */
static inline float
celd_level_at (const CeldPlane *levels, int x, int y)
{
  float level = CELD_AT (levels, x, y);

  return isfinite (level) ? level : 0;
}

/* The least and largest of these levels. */
void celd_level_range (const CeldPlane *levels, float *least, float *most);

#define CELD_MOST_LEVELS 256 /* distinct levels; more are rounded to so many evenly spaced ones (they fit a byte) */

/* The distinct levels of a picture, numbered from the farthest. */

typedef struct
{
  int      n;
  float    value[CELD_MOST_LEVELS];  /* of each level, rising */
  float    least, step;              /* of evenly spaced levels; step 0: values are exact */
  uint8_t *level;                    /* number of each pixel, tight; freed by the caller */
} CeldLevelNumbers;

/* Fills in a zeroed record. */
CeldStatus celd_level_numbers (const CeldPlane *levels, CeldLevelNumbers *numbers);

/* Soft shadows of nearer levels on farther ones: change = - the fraction of light that they take, in [-1,0].
 * `deviation` of the blur in pixels, > 0; `change` has the size of `levels`. */
CeldStatus celd_shadows (const CeldPlane *levels, double deviation, const CeldSettings *settings, const CeldHost *host,
                         CeldPlane *change);

#endif
