/* What the files that close gaps share: chains of white border, and the line ends that they run between.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_CLOSURES_H
#define CELD_CLOSURES_H

#include "segment/task.h"

#include <math.h>

#define CELD_FAINT_INK 0.75f        /* ink: paper below it is a line that is too thin to be ink, or the rim of one */

static inline double
celd_distance_between (CeldPlace p, CeldPlace q)
{
  return hypot (p.x - q.x, p.y - q.y);
}

/* The corner (x,y) is that of the pixel (x,y) which is nearest to the origin; also used for pixels. */
typedef struct { int32_t x, y; } CeldCorner;

/* ------------------------------------------------------------------ closure-chains.c */

typedef enum { CELD_CHAIN_INK, CELD_CHAIN_FRAME, CELD_CHAIN_JUNCTION, CELD_CHAIN_LOOP } CeldChainEnd;

/* Edges between pixels of paper, one after the other, that part two labels. */
typedef struct
{
  size_t       first, n;        /* its corners; at least two */
  uint32_t     left, right;     /* labels on both sides, as seen on the way; left < right */
  CeldChainEnd end[2];          /* what its first and its last corner touch */
  CeldCorner   ink[2];          /* that pixel, for CELD_CHAIN_INK */
} CeldChain;

typedef struct
{
  CeldChain  *item;
  size_t      n;
  CeldCorner *corner;           /* of all chains, one behind the other */
  size_t      n_corners;
} CeldChains;

/* Every chain that crosses a border of basins with different labels, or the rim of a patch; makes the record. */
CeldStatus celd_chains_find (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels,
                             const CeldPatches *windows, CeldChains *chains);
void       celd_chains_clear (CeldChains *chains);              /* accepts a zeroed record */

/* ------------------------------------------------------------------ closure-ends.c */

/* The ink that a chain ends at, a few strokes around, and the line end that it may be. */
typedef struct
{
  int         step;             /* pixels between those that are looked at */
  int         radius;           /* so many steps each way */
  CeldCorner  middle;           /* the pixel that was landed on */
  uint8_t    *member;           /* square of side 2 reach + 1 round it: connected ink */
  CeldCorner *pixel;            /* the same as a list, nearest first */
  uint32_t   *from;             /* of pixel k: which of them it was reached from; of the first: itself */
  size_t      n;

  bool      tip;                /* a line ends here; then: */
  double    width;              /* of the line */
  CeldPlace at, inside;         /* the middle of the tip, and a point of the ink right behind it */
  double    dx, dy;             /* where the line would go on; length 1 */
} CeldLineEnd;

/* Room for looking as far as lines of this width need. */
CeldStatus celd_line_end_new (int stroke, CeldLineEnd *end);
void       celd_line_end_clear (CeldLineEnd *end);              /* accepts a zeroed record */

void celd_line_end_fit (const CeldPlane *ink, CeldCorner pixel, CeldLineEnd *end);

/* The pixel of connected ink that is nearest to a place; there is one. */
size_t celd_line_end_nearest (const CeldLineEnd *end, CeldPlace place);

/* Is this pixel, which is ink, connected? */
bool celd_line_end_contains (const CeldLineEnd *end, int x, int y);

/* A border that ends at this corner, without ink. */
void celd_line_end_set_corner (CeldCorner corner, CeldLineEnd *end);

/* Puts the end, which is not a tip, where a line coming from the other end reaches its ink, or the nearest ink. */
void celd_line_end_aim (const CeldPlane *ink, const CeldLineEnd *from, CeldLineEnd *end);

/* ------------------------------------------------------------------ closures.c */

#define CELD_CURVE_PLACES 65

/* The curve from the middle of one tip to the other as a polyline of n <= CELD_CURVE_PLACES places.  Ends without a
 * tip have no direction. */
size_t celd_curve_draw (const CeldLineEnd *from, const CeldLineEnd *to, CeldPlace place[CELD_CURVE_PLACES]);

/* ------------------------------------------------------------------ closure-redraw.c */

/* A new border from end to end; or, if `straight`, from the first corner of the old one to the last. */
typedef struct { CeldPlace place[CELD_CURVE_PLACES]; size_t n; bool straight; } CeldClosureCurve;

/* Where an edge of an outline crosses the centres of row y; down is positive. */
typedef struct { int32_t y, sign; double x; } CeldRowCrossing;

/* The patches of one closure. */
typedef struct { size_t first, last; CeldCorner least, most; } CeldClosurePatches;

typedef struct
{
  const CeldSegmentTask *task;
  const CeldLabels      *labels;     /* before anything is redrawn */
  const CeldChains      *chains;
  CeldLineEnd            end[2];     /* of the chain that is redrawn */
  CeldRowCrossing       *crossing;
  size_t                 n_crossings;
  CeldPatches            relabelled; /* by the way that is being tried */
  CeldClosurePatches    *done;
  size_t                 n_done;
  CeldPatches            patches;
} CeldRedrawing;

void celd_redrawing_clear (CeldRedrawing *redrawing);           /* accepts a zeroed record */

/* Makes this way the border in place of the chain; *may becomes false, and nothing changes, if it cannot be. */
CeldStatus celd_boundary_redraw (CeldRedrawing *redrawing, const CeldChain *chain, const CeldClosureCurve *curve,
                                 bool *allowed);

#endif
