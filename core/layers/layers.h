/* The inside of CeldLayers: a drawing cut into one layer a region.
 *
 *   layers.c          which pixel is in which layer, and the layers as pictures
 *   layers.c    layers from a picture of levels
 *   layer-unmixing.c     the numbers that layers can be stored in
 *   layer-unmixing.c   the colours of two layers that share a pixel
 *   layer-outline.c   the outline of a layer, and where nearer layers hide it
 *   layer-curves.c    how an outline runs on where it is hidden
 *   layer-coverage.c     how much of each pixel lies inside an outline
 *   layer-completion.c    the hidden parts of a layer, their colours and their line
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAYERS_H
#define CELD_LAYERS_H

#include "base/base.h"

/* A pixel that shows two layers: `layer` and `colour` (straight alpha) of the front one, then of the back one. */
typedef struct
{
  int      x, y;
  uint32_t layer[2];
  float    coverage;            /* of the pixel, that the front one covers */
  float    colour[2][4];
} CeldBlend;

/* A hidden pixel of a layer. */
typedef struct { int x, y; float colour[4]; } CeldHiddenPixel;

struct CeldLayers
{
  int         width, height;
  CeldStore   store;
  float       code_value[256], code_limit[256]; /* linear light of each code of sRGB, and where the next one begins */
  CeldLayer  *item;            /* from back to front */
  CeldRect   *seen;            /* of each, where celd_layer_visibility is CELD_LAYER_VISIBLE */
  size_t      n;
  float      *art;             /* R, G, B, A a pixel, tight; as it can be stored */
  uint32_t   *place;           /* of each pixel: its layer, or n + its index among the blends */
  CeldBlend  *blend;           /* in reading order */
  size_t      n_blends;
  CeldHiddenPixel **hidden;         /* of each layer; NULL: none */
  size_t     *n_hidden;
};

/* ------------------------------------------------------------------ layer-unmixing.c */

void celd_quantizer_prepare (CeldLayers *layers);

/* The nearest that can be stored. */
float celd_quantize_alpha  (const CeldLayers *layers, float alpha);
float celd_quantize_colour (const CeldLayers *layers, float value);

/* ------------------------------------------------------------------ layer-unmixing.c */

/* Fills in the colours of the blends.  `ink` is that of the drawing. */
CeldStatus celd_layers_unmix (CeldLayers *layers, const CeldPlane *ink, const CeldHost *host);

/* ------------------------------------------------------------------ layer-outline.c */

typedef enum { CELD_LAYER_ABSENT, CELD_LAYER_VISIBLE, CELD_LAYER_OCCLUDED } CeldVisibility;

/* What is known of a pixel, of the frame or outside it, for one layer: it is seen there (mostly), it is not, or
 * something opaque of a nearer level hides whether it is there. */
CeldVisibility celd_layer_visibility (const CeldLayers *layers, size_t layer, int x, int y);

/* A side of a pixel, from corner (x,y) on to the next crack's corner; the layer is on its right. */
typedef struct { int x, y; bool hidden; } CeldCrackEdge;

/* Where an outline goes under a nearer layer, or comes out again. */
typedef struct
{
  double x, y;                 /* a corner */
  double tx, ty;               /* the outline's direction there, of length 1 */
  bool   reliable;                 /* was there enough of it to measure that? */
  double width;                /* of the line along the outline before it is hidden; 0: none */
  float  colour[4];            /* of that line */
} CeldGapEnd;

/* A hidden piece of outline, from in[] to out[]. */
typedef struct { CeldGapEnd in, out; } CeldOutlineGap;

typedef struct
{
  CeldCrackEdge *crack;            /* of all loops, one behind the other; each loop ends where the next begins */
  size_t     n;
  size_t    *loop;             /* index of the first crack of each, and n behind the last */
  size_t     n_loops;
  CeldOutlineGap   *gap;
  size_t     n_gaps;
} CeldOutline;

/* Traces a layer.  Cracks stay `hidden` only where a gap replaces them; holes that a nearer layer covers wholly are
 * left out.  `stroke` is the width of the drawing's lines in pixels. */
CeldStatus celd_layer_outline (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke,
                               CeldOutline *outline);
void celd_outline_clear (CeldOutline *outline);

/* ------------------------------------------------------------------ layer-curves.c */

/* A cubic Bezier curve, and the line along it. */
typedef struct { double x[4], y[4], width[2]; float colour[2][4]; } CeldGapCurve;

/* One curve for each gap of the outline: from where it goes in to where this or another gap comes out. */
void celd_layer_curves (const CeldLayers *layers, size_t layer, const CeldOutline *outline, CeldGapCurve *curve);

/* The place at t in [0,1]. */
void celd_curve_at (const CeldGapCurve *curve, double t, double *x, double *y);
/* Steps that are at most about a pixel long. */
int celd_curve_steps (const CeldGapCurve *curve);

/* ------------------------------------------------------------------ layer-coverage.c */

/* A picture that collects directed edges: of what is on their right the share of each pixel. */
typedef struct { CeldRect box; float *sum; } CeldCoverage;

CeldStatus celd_coverage_new (CeldRect box, CeldCoverage *coverage);      /* end with celd_free (sum) */
void celd_coverage_edge (CeldCoverage *coverage, double x, double y, double to_x, double to_y);
/* Once all edges are in: sum[] is the share, one tight plane of the box. */
void celd_coverage_finish (CeldCoverage *coverage);

/* ------------------------------------------------------------------ layer-completion.c */

/* Finds the hidden part of a layer. */
CeldStatus celd_layer_complete (CeldLayers *layers, size_t layer, bool everything, const CeldPlane *ink, int stroke,
                                const CeldHost *host);

#endif
