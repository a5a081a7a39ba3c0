/* Bridges: lines that nobody drew, from one line's end to another's.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_BRIDGES_H
#define CELD_BRIDGES_H

#include "segment/basins.h"

/* ------------------------------------------------------------------ line-ends.c */

/* Where a line ends: the middle of its tip, the direction in which it would go on, of length 1, and which outline of
 * ink it is on. */
typedef struct { double x, y, dx, dy; uint32_t outline; } CeldTip;

/* All ends of lines, in the order of their first pixels; the caller frees them.  `stroke`: celd_stroke_width. */
CeldStatus celd_line_ends_find (const CeldPlane *ink, int stroke, const CeldHost *host, CeldTip **tip, size_t *n);

/* ------------------------------------------------------------------ bridge-pairs.c */

/* Two tips by their numbers, a < b, and what it costs to join them. */
typedef struct { double cost; uint32_t a, b; } CeldTipPair;

typedef struct CeldTipPairs CeldTipPairs;

/* All pairs of tips that may be joined, to be taken one by one; the tips stay the caller's.  NULL: no memory. */
CeldTipPairs *celd_tip_pairs_new (const CeldTip *tip, size_t n, int stroke);
void          celd_tip_pairs_free (CeldTipPairs *pairs);         /* accepts NULL */

/* The next pair by cost, then by numbers, of which no tip is taken: what is taken stays so.  Valid until the next call;
 * NULL: there is none. */
CeldStatus celd_tip_pairs_next (CeldTipPairs *pairs, const bool *taken, const CeldHost *host, const CeldTipPair **pair);

/* ------------------------------------------------------------------ bridges.c */

/* A pixel of paper that a bridge goes over. */
typedef struct { int32_t x, y; } CeldBridgePixel;

typedef struct { size_t first, n; double length; } CeldBridge;  /* its pixels, from end to end; its length in pixels */

typedef struct
{
  CeldBridge      *item;
  size_t           n;
  CeldBridgePixel *pixel;       /* of all bridges, one behind the other */
  size_t           n_pixels;
} CeldBridges;

/* Bridges between line ends that point to each other with nothing but paper between; each end has one at most.  Makes
 * the record. */
CeldStatus celd_bridges_find (const CeldPlane *ink, int stroke, const CeldHost *host, CeldBridges *bridges);
void       celd_bridges_clear (CeldBridges *bridges);            /* accepts a zeroed record */

/* Draws them as lines so faint that a border across paper is dear beside them, but dark enough to part basins. */
void celd_bridges_draw (const CeldBridges *bridges, CeldPlane *ink);

/* Makes *changed hold the pixels that only one of two records has, too. */
CeldStatus celd_bridges_compare (const CeldBridges *old, const CeldBridges *new, CeldRect *changed);

/* Paper on both sides of a bridge is one piece all the same, and one room if the bridge is longer than two strokes.
 * `ink` is without bridges. */
CeldStatus celd_bridges_join (const CeldBridges *bridges, const CeldPlane *ink, CeldBasins *basins);

/* Finds the bridges of a drawing, and makes the basins of the drawing with the bridges on it.  `changed`: where the
 * drawing differs from the one that *bridges and *basins are of, grown by where bridges differ; NULL: both are made from
 * the beginning.  *cell, which is NULL before, gets each basin's piece without joining pieces over bridges; it stays NULL
 * where there are no bridges.  After a failure *bridges are the old ones, and *basins may be the new ones. */
CeldStatus celd_bridges_make_basins (const CeldPlane *ink, CeldRect *changed, float threshold, const CeldHost *host,
                                     CeldBridges *bridges, CeldBasins *basins, uint32_t **bridged_component);

#endif
