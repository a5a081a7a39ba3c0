/* What the files that read painted arrows share.
 *
 *   arrow-layer.c        how opaque the pixels of the layer are
 *   stroke-distance.c    geodesic distances along a stroke, its width and middle at a distance
 *   arrowhead.c          which end of a stroke has an arrowhead or a dot
 *   arrow-profile.c      which end of a stroke is more opaque or wider
 *   crossings.c          where strokes cross
 *   crossing-strokes.c   the strokes of a connected component in which some cross
 *   arrows.c             all arrows of a layer
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ARROWS_H
#define CELD_ARROWS_H

#include "base/base.h"

typedef struct { double x, y; } CeldPoint;

/* ------------------------------------------------------------------ arrow-layer.c */

#define CELD_PAPER_CONTRAST 32 /* least difference of paint from paper, 0 .. 255, in a layer without alpha; chosen */

typedef struct
{
  const CeldPaint *paint;    /* borrowed */
  bool             opaque;   /* all alpha is 255: paint is what differs from paper */
  uint8_t          paper[3]; /* the commonest colour of an opaque layer */
} CeldArrowLayer;

/* Finds out whether a layer is opaque, and its paper.  CELD_NO_MEMORY is the only failure. */
CeldStatus celd_arrow_layer_new (const CeldPaint *paint, CeldArrowLayer *layer);

/* Alpha, or the largest difference from paper in any channel: 0 .. 255.  (x,y) must be in the picture. */
int celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y);

/* ------------------------------------------------------------------ stroke-distance.c */

/* Sums over all pixels nearer to the start than one distance: their number and their places. */
typedef struct { double count, x, y; } CeldStrokeSums;

/* A connected stroke, followed from one or more of its pixels.  Pixels are indices into planes that have a border of
 * one pixel, (width + 2) x (height + 2), so that each has eight neighbours. */
typedef struct
{
  int             width, height; /* of the picture */
  float          *distance;      /* such a plane: geodesic distance from the start, in pixels; infinite off the stroke */
  const uint32_t *pixel;         /* of the stroke, in reading order */
  size_t          n;
  CeldStrokeSums *sums;          /* sums[i]: pixels with distance < i; room for 3 n / 2 + 4 */
  size_t          n_sums;
  float          *earlier;       /* room for n distances from an earlier start */
} CeldArrowStroke;

int       celd_stroke_x (const CeldArrowStroke *stroke, uint32_t pixel);     /* column in the picture */
int       celd_stroke_y (const CeldArrowStroke *stroke, uint32_t pixel);     /* row in the picture */
CeldPoint celd_stroke_point (const CeldArrowStroke *stroke, uint32_t pixel); /* centre of a pixel, in the picture */

/* Is the pixel at a point, or one of its four neighbours, part of a stroke? */
bool celd_stroke_painted (const CeldArrowStroke *stroke, CeldPoint p);

/* Fills in the distances from the nearest of n starts, and the sums.  Returns the farthest pixel. */
uint32_t celd_stroke_follow (CeldArrowStroke *stroke, const uint32_t *start, size_t n);

/* Distance of the farthest pixel, rounded up, after celd_stroke_follow. */
double celd_stroke_length (const CeldArrowStroke *stroke);

/* Between two distances: pixels per unit of length, which is the mean width; and the centroid of the pixels. */
double    celd_stroke_mean_width (const CeldArrowStroke *stroke, double from, double to);
CeldPoint celd_stroke_centroid (const CeldArrowStroke *stroke, double from, double to);

/* ------------------------------------------------------------------ arrowhead.c, arrow-profile.c */

/* The tail of an arrow is at the nearer region, its tip at the farther one. */
typedef struct { CeldPoint tail, tip; } CeldArrowEnds;

/* False if the stroke has no clear arrowhead; with `dot`, no clear dot, whose centre is then the tip. */
bool celd_arrowhead (CeldArrowStroke *stroke, bool dot, CeldArrowEnds *ends);

/* The more opaque (CELD_ARROW_FADE) or the wider (CELD_ARROW_TAPER) end of a stroke is the tail; false if neither end
 * clearly is. */
bool celd_arrow_profile (CeldArrowStroke *stroke, const CeldArrowLayer *layer, CeldArrowStyle style,
                         CeldArrowEnds *ends);

/* ------------------------------------------------------------------ crossings.c */

/* Where two strokes cross: arms 0 and 2 are one of them, 1 and 3 the other, on a circle round the crossing. */
typedef struct { CeldPoint centre, arm[4]; double radius, breadth[4]; } CeldStrokeCrossing;

/* A stroke cut out of its picture, with a border of one pixel that is not painted.  squared: of each pixel the squared
 * distance to the nearest one that is not painted. */
typedef struct { int left, top, width, height; uint8_t *painted; int32_t *squared; } CeldStrokeMask;

CeldStatus celd_stroke_mask_new (const CeldArrowStroke *stroke, CeldStrokeMask *mask);
void       celd_stroke_mask_clear (CeldStrokeMask *mask);

/* The crossings in a mask; *list is the caller's to free. */
CeldStatus celd_stroke_crossings_find (const CeldStrokeMask *mask, CeldStrokeCrossing **list, size_t *n);

/* ------------------------------------------------------------------ crossing-strokes.c */

/* Stroke k of a component has the pixels from first[k] to first[k + 1], numbered as in CeldArrowStroke. */
typedef struct { uint32_t *pixel; size_t *first, n; size_t pixel_capacity; } CeldCrossingStrokes;

/* Takes a connected component apart where strokes cross; n = 0 if none do.  To be cleared by the caller. */
CeldStatus celd_crossing_strokes_find (const CeldArrowStroke *component, CeldCrossingStrokes *strokes);
void       celd_crossing_strokes_clear (CeldCrossingStrokes *strokes);

#endif
