/* The steps from a signed distance to the basin graph.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BASIN_STEPS_H
#define CELD_BASIN_STEPS_H

#include "segment/basins.h"

#define CELD_KEPT (1u << 30) /* in place of a basin: the rest is a basin of the old graph */

/* The part of a drawing that basins are made of: all of it, or a box in which some pixels are made anew. */
typedef struct
{
  CeldRect          box;
  const int32_t    *squared;  /* signed distance, from the first pixel of the box on */
  size_t            stride;   /* of squared */
  int               stroke;
  const uint8_t    *anew;     /* of each pixel of the box: is it made anew?  NULL: all are */
  const CeldBasins *old;      /* what the others keep */
} CeldPlot;

/* basin-ascent.c: fills in basin, n, row and run of a graph of the size of the box, areas left out.  Pixels that are
 * not made anew belong to CELD_KEPT | their old basin; outside the box nothing may be made anew. */
CeldStatus celd_basins_ascend (const CeldPlot *plot, const CeldHost *host, CeldBasins *basins);

/* basin-borders.c: the borders of the basins that width, height, basin, row and run describe, as far as a pixel of each
 * pair is made anew.  End with celd_free. */
CeldStatus celd_basins_touch (const CeldPlane *ink, const CeldPlot *plot, const CeldBasins *basins, const CeldHost *host,
                              CeldBorder **border, size_t *n);

/* One border where both are, of the same basins. */
void celd_border_add (CeldBorder *border, const CeldBorder *more);

/* basin-unions.c: fills in block, room and piece. */
CeldStatus celd_basins_unite (CeldBasins *basins);

/* basins.c: fills in the areas. */
void celd_basins_measure (CeldBasins *basins);

/* basin-renewal.c: makes *found, but for the paper, of the graph of the drawing before it changed inside a rectangle.
 * *found stays empty where that is not worth the trouble. */
CeldStatus celd_basins_revise (const CeldPlane *ink, const CeldRect *changed, const CeldBasins *old, const CeldHost *host,
                               CeldBasins *found);

#endif
