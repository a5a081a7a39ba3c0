/* The inside of CeldLayers.
 *
 *   layers.c            assigns pixels to layers, also for pictures of levels; layers as pictures
 *   layer-unmixing.c    colours of two layers that share a pixel; rounding to stored values
 *   layer-outline.c     traces the outline of a layer and its occluded gaps
 *   layer-shape.c       where a layer is visible; curves that close its gaps; the pixels that its outline covers
 *   layer-completion.c  hidden parts of a layer, their colours and their line
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAYERS_H
#define CELD_LAYERS_H

#include "base/base.h"

/* A pixel with two layers: index and colour (straight alpha), [0] of the front layer, [1] of the back one. */
typedef struct
{
  int      x, y;
  uint32_t layer[2];
  float    coverage;            /* of the pixel by the front layer */
  float    colour[2][4];
} CeldBlend;

/* A hidden pixel of a layer. */
typedef struct { int x, y; float colour[4]; } CeldHiddenPixel;

struct CeldLayers
{
  int               width, height;
  CeldStore         store;
  float             code_value[256], code_limit[256]; /* linear light of each sRGB code, and the upper limit of what is
                                                       * rounded to it */
  CeldLayer        *item;      /* from back to front */
  CeldRect         *seen;      /* box of the pixels where each layer is CELD_LAYER_VISIBLE */
  size_t            n;
  float            *art;       /* r, g, b, a of each pixel without padding, rounded to what can be stored */
  uint32_t         *place;     /* of each pixel: its layer, or n + its index among the blends */
  CeldBlend        *blend;     /* in reading order */
  size_t            n_blends;
  CeldHiddenPixel **hidden;         /* of each layer; NULL: none */
  size_t           *n_hidden;
};

/* ------------------------------------------------------------------ layer-unmixing.c */

void celd_quantizer_prepare (CeldLayers *layers);

/* Round to the nearest value that can be stored. */
float celd_quantize_alpha  (const CeldLayers *layers, float alpha);
float celd_quantize_colour (const CeldLayers *layers, float value);


/* Fills in the colours of the blends.  `ink` is that of the drawing. */
CeldStatus celd_layers_unmix (CeldLayers *layers, const CeldPlane *ink, const CeldHost *host);

/* ------------------------------------------------------------------ layer-outline.c */

/* A crack edge: a side of a pixel, from corner (x,y) to the corner of the next one; the layer is on its right. */
typedef struct { int x, y; bool hidden; } CeldCrackEdge;

/* One end of a gap: where an outline disappears under a nearer layer, or reappears. */
typedef struct
{
  double x, y;                 /* a corner */
  double tx, ty;               /* unit vector of the outline's direction */
  bool   reliable;             /* was the visible outline long enough to measure the direction? */
  double width;                /* in pixels, of the line along the visible outline; 0: none */
  float  colour[4];            /* of that line */
} CeldGapEnd;

/* An occluded piece of outline, from `in` to `out`. */
typedef struct { CeldGapEnd in, out; } CeldOutlineGap;

typedef struct
{
  CeldCrackEdge  *crack;           /* of all loops in succession */
  size_t          n, crack_capacity;
  size_t         *loop;            /* index of the first crack edge of each loop, and n at the end */
  size_t          n_loops, loop_capacity;
  CeldOutlineGap *gap;
  size_t          n_gaps, gap_capacity;
} CeldOutline;

/* Traces the outline of a layer.  Crack edges are `hidden` only where a gap replaces them; holes that nearer layers
 * cover wholly are left out.  `stroke` is the drawing's stroke width in pixels. */
CeldStatus celd_layer_outline (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke,
                               CeldOutline *outline);
void celd_outline_clear (CeldOutline *outline);

/* ------------------------------------------------------------------ layer-shape.c */

typedef enum { CELD_LAYER_ABSENT, CELD_LAYER_VISIBLE, CELD_LAYER_OCCLUDED } CeldVisibility;

/* The state of a pixel, inside or outside the picture, for one layer: the layer is visible there (by half at least),
 * is absent, or may be there but is occluded by an opaque layer of a nearer level. */
CeldVisibility celd_layer_visibility (const CeldLayers *layers, size_t layer, int x, int y);

/* A cubic Bezier curve, and width and colour of the line at its two ends. */
typedef struct { double x[4], y[4], width[2]; float colour[2][4]; } CeldGapCurve;

/* Makes one curve for each gap; gaps may exchange their ends. */
void celd_layer_curves (const CeldLayers *layers, size_t layer, const CeldOutline *outline, CeldGapCurve *curve);

/* The point at parameter t in [0,1]. */
void celd_curve_at (const CeldGapCurve *curve, double t, double *x, double *y);
/* A number of steps with which each is about a pixel long at most. */
int celd_curve_steps (const CeldGapCurve *curve);

/* An accumulator of directed edges, and then the coverage of each pixel by what is on their right. */
typedef struct { CeldRect box; float *sum; } CeldCoverage;

CeldStatus celd_coverage_new (CeldRect box, CeldCoverage *coverage);      /* sum has to be freed with celd_free */
void celd_coverage_edge (CeldCoverage *coverage, double x, double y, double to_x, double to_y);
/* Turns sum[] into coverage, a plane of the box without padding. */
void celd_coverage_finish (CeldCoverage *coverage);

/* The coverage of each pixel of the box by what the outline encloses, its gaps closed by one curve each; a plane to be
 * freed with celd_free. */
CeldStatus celd_coverage_of_outline (CeldRect box, const CeldOutline *outline, const CeldGapCurve *curve,
                                     float **coverage);

/* ------------------------------------------------------------------ layer-completion.c */

/* Finds the hidden part of a layer; with `everything`, that is the rest of the picture. */
CeldStatus celd_layer_complete (CeldLayers *layers, size_t layer, bool everything, const CeldPlane *ink, int stroke,
                                const CeldHost *host);

#endif
