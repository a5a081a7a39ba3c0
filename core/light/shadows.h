/* What depth enhancement (enhance.c, enhance-layer.c) shares with the stack of shadows (shadows.c, shadow-levels.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SHADOWS_H
#define CELD_SHADOWS_H

#include "base/base.h"

#include <math.h>

/* A pixel's level or depth; what is not a number is 0. */
static inline float
celd_level_at (const CeldPlane *levels, int x, int y)
{
  float level = CELD_AT (levels, x, y);

  return isfinite (level) ? level : 0;
}

void celd_level_range (const CeldPlane *levels, float *least, float *most);

#define CELD_MOST_LEVELS 256 /* levels beyond are put together with their neighbours */

typedef struct
{
  int      n;
  float    value[CELD_MOST_LEVELS];  /* of each level, rising */
  float    least, step;              /* of values put together; step 0: they are not */
  uint8_t *level;                    /* of each pixel; end with celd_free */
} CeldLevelNumbers;

/* `numbers` is all 0 before. */
CeldStatus celd_level_numbers (const CeldPlane *levels, CeldLevelNumbers *numbers);

/* Soft shadows that nearer levels cast on farther ones: of each pixel, the negative share of light that they take.
 * `deviation` in pixels, > 0. */
CeldStatus celd_shadows (const CeldPlane *levels, double deviation, const CeldSettings *settings, const CeldHost *host,
                         CeldPlane *change);

#endif
