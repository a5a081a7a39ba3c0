/* What the files that close gaps share: boundary chains across paper, and the line ends that they run between.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_CLOSURES_H
#define CELD_CLOSURES_H

#include "segment/task.h"

#include <math.h>

#define CELD_FAINT_INK 0.75f        /* ink value: paper darker than this is a faint line, or the antialiased edge of a
                                     * line */

static inline double
celd_distance_between (CeldPlace p, CeldPlace q)
{
  return hypot (p.x - q.x, p.y - q.y);
}

/* The corner (x,y) is the upper left one of the pixel (x,y); also used for pixels. */
typedef struct { int32_t x, y; } CeldCorner;

/* ------------------------------------------------------------------ boundary-chains.c */

typedef enum { CELD_CHAIN_INK, CELD_CHAIN_FRAME, CELD_CHAIN_JUNCTION, CELD_CHAIN_LOOP } CeldChainEnd;

/* Consecutive edges between pixels of paper that separate two labels. */
typedef struct
{
  size_t       first, n;        /* its corners: at least two */
  uint32_t     left, right;     /* labels on both sides, along the chain; left < right */
  CeldChainEnd end[2];          /* what it ends at */
  CeldCorner   ink[2];          /* the pixel of ink there, for CELD_CHAIN_INK */
} CeldChain;

typedef struct
{
  CeldChain  *item;
  size_t      n;
  CeldCorner *corner;           /* of all chains, one after the other */
  size_t      n_corners;
  size_t      item_capacity, corner_capacity;
} CeldChains;

/* Finds every chain that crosses a boundary of basins with different labels, or the outline of a patch; makes the
 * record. */
CeldStatus celd_chains_find (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels,
                             const CeldPatches *windows, CeldChains *chains);
void       celd_chains_clear (CeldChains *chains);              /* accepts a zeroed record */

/* ------------------------------------------------------------------ line-end-fit.c */

/* The ink that a chain ends at, up to a few stroke widths away, and the line end that it may be. */
typedef struct
{
  int         step;             /* spacing of the sampled pixels */
  int         radius;           /* in steps of that, each way */
  CeldCorner  middle;           /* the pixel at which the chain ends */
  uint8_t    *member;           /* square of side 2 radius + 1 round it: is it connected ink? */
  CeldCorner *pixel;            /* the connected ink as a list, nearest first */
  uint32_t   *from;             /* of pixel k: the index of the pixel it was reached from */
  size_t      n;

  bool      tip;                /* a line ends here; if so: */
  double    width;              /* width of the line, in pixels */
  CeldPlace at, inside;         /* the middle of the tip, and a point of the ink just behind it */
  double    dx, dy;             /* unit direction in which the line would go on */
} CeldLineEnd;

/* Allocates the workspace for lines of this stroke width. */
CeldStatus celd_line_end_new (int stroke, CeldLineEnd *end);
void       celd_line_end_clear (CeldLineEnd *end);              /* accepts a zeroed record */

void celd_line_end_fit (const CeldPlane *ink, CeldCorner pixel, CeldLineEnd *end);

/* Is this pixel of ink connected to the end? */
bool celd_line_end_contains (const CeldLineEnd *end, int x, int y);

/* Sets an end at a line end that is known; the ink that was gathered there stays. */
void celd_line_end_set_tip (const CeldTip *tip, CeldLineEnd *end);

/* Sets an end at a corner without ink. */
void celd_line_end_set_corner (CeldCorner corner, CeldLineEnd *end);

/* Moves the end, which is not a tip, to where a line from the other end reaches its ink, or to the nearest ink. */
void celd_line_end_aim (const CeldPlane *ink, const CeldLineEnd *from, CeldLineEnd *end);

/* ------------------------------------------------------------------ line-cuts.c */

/* The corners of pixels along the outline of connected ink, ink on the right. */
typedef struct { const CeldCorner *corner; size_t n; } CeldOutline;

/* Finds the next place from *from on, 0 at first, where a broad line was cut off or rubbed out.  `stroke`:
 * celd_stroke_width.  *tip becomes that end but for the number of its outline, *from where to go on.  False: there are no
 * more. */
bool celd_line_cut_next (const CeldPlane *ink, const CeldOutline *outline, int stroke, size_t *from, CeldTip *tip);

/* ------------------------------------------------------------------ closures.c */

#define CELD_CURVE_PLACES 65

/* The curve from the middle of one tip to the other as a polyline; returns its n <= CELD_CURVE_PLACES places.  Ends
 * that are not tips have no direction. */
size_t celd_curve_draw (const CeldLineEnd *from, const CeldLineEnd *to, CeldPlace place[CELD_CURVE_PLACES]);

/* ------------------------------------------------------------------ closure-redraw.c */

/* A new boundary from line end to line end; or, if `straight`, from the first corner of the old one to the last. */
typedef struct { CeldPlace place[CELD_CURVE_PLACES]; size_t n; bool straight; } CeldClosureCurve;

/* Where an edge of an outline crosses the line through the centres of row y; downwards is positive. */
typedef struct { int32_t y, sign; double x; } CeldRowCrossing;

/* The patches first .. last - 1 of one closure, and their bounding box. */
typedef struct { size_t first, last; CeldCorner least, most; } CeldClosurePatches;

typedef struct
{
  const CeldSegmentTask *task;
  const CeldLabels      *labels;     /* as they were before redrawing */
  const CeldChains      *chains;
  CeldLineEnd            end[2];     /* of the chain being redrawn */
  CeldRowCrossing       *crossing;
  size_t                 n_crossings;
  CeldPatches            relabelled; /* by the curve being tried */
  CeldClosurePatches    *done;
  size_t                 n_done;
  CeldPatches            patches;
  size_t                 crossing_capacity, done_capacity;
} CeldRedrawing;

void celd_redrawing_clear (CeldRedrawing *redrawing);           /* accepts a zeroed record */

/* Replaces the chain by this curve.  *allowed becomes false, and nothing changes, if something stands in the way. */
CeldStatus celd_boundary_redraw (CeldRedrawing *redrawing, const CeldChain *chain, const CeldClosureCurve *curve,
                                 bool *allowed);

#endif
