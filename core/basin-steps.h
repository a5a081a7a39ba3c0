/* The steps from a signed distance to the basin graph.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASIN_STEPS_H
#define CELD_BASIN_STEPS_H

#include "basins.h"

/* Deeper in ink than this, in squared pixels, the relief rises again. */
static inline int32_t
celd_stroke_core (int stroke)
{
  return stroke > 2 ? stroke * stroke : 4;
}

/* basin-ascent.c: fills in basin, n, row and run from width, height, stroke and the signed distance. */
CeldStatus celd_basins_ascend (const int32_t *squared, const CeldRun *run, CeldBasins *basins);

/* basin-borders.c: fills in border and n_borders. */
CeldStatus celd_basins_touch (const CeldPlane *ink, const int32_t *squared, const CeldRun *run, CeldBasins *basins);

/* basin-unions.c: fills in block, room and piece. */
CeldStatus celd_basins_unite (CeldBasins *basins);

#endif
