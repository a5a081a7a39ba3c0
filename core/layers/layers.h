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
  float    share;              /* of the pixel, that the front one covers */
  float    colour[2][4];
} CeldBlend;

/* A hidden pixel of a layer. */
typedef struct { int x, y; float colour[4]; } CeldHidden;

struct CeldLayers
{
  int         width, height;
  CeldStore   store;
  float       shade[256], limit[256]; /* linear light of each code of sRGB, and where the next one begins */
  CeldLayer  *item;            /* from back to front */
  CeldRect   *seen;            /* of each, where celd_layer_sight is CELD_SIGHT_SEEN */
  size_t      n;
  float      *art;             /* R, G, B, A a pixel, tight; as it can be stored */
  uint32_t   *place;           /* of each pixel: its layer, or n + its index among the blends */
  CeldBlend  *blend;           /* in reading order */
  size_t      n_blends;
  CeldHidden **hidden;         /* of each layer; NULL: none */
  size_t     *n_hidden;
};

/* ------------------------------------------------------------------ layer-unmixing.c */

void celd_store_prepare (CeldLayers *layers);

/* The nearest that can be stored. */
float celd_store_alpha  (const CeldLayers *layers, float alpha);
float celd_store_colour (const CeldLayers *layers, float value);

/* ------------------------------------------------------------------ layer-unmixing.c */

/* Fills in the colours of the blends.  `ink` is that of the drawing. */
CeldStatus celd_layer_colours (CeldLayers *layers, const CeldPlane *ink, const CeldHost *host);

/* ------------------------------------------------------------------ layer-outline.c */

typedef enum { CELD_SIGHT_NONE, CELD_SIGHT_SEEN, CELD_SIGHT_HIDDEN } CeldSight;

/* What is known of a pixel, of the frame or outside it, for one layer: it is seen there (mostly), it is not, or
 * something opaque of a nearer level hides whether it is there. */
CeldSight celd_layer_sight (const CeldLayers *layers, size_t layer, int x, int y);

/* A side of a pixel, from corner (x,y) on to the next crack's corner; the layer is on its right. */
typedef struct { int x, y; bool hidden; } CeldCrack;

/* Where an outline goes under a nearer layer, or comes out again. */
typedef struct
{
  double x, y;                 /* a corner */
  double tx, ty;               /* the outline's direction there, of length 1 */
  bool   sure;                 /* was there enough of it to measure that? */
  double width;                /* of the line along the outline before it is hidden; 0: none */
  float  colour[4];            /* of that line */
} CeldHiddenEnd;

/* A hidden piece of outline, from in[] to out[]. */
typedef struct { CeldHiddenEnd in, out; } CeldGap;

typedef struct
{
  CeldCrack *crack;            /* of all loops, one behind the other; each loop ends where the next begins */
  size_t     n;
  size_t    *loop;             /* index of the first crack of each, and n behind the last */
  size_t     n_loops;
  CeldGap   *gap;
  size_t     n_gaps;
} CeldOutline;

/* Traces a layer.  Cracks stay `hidden` only where a gap replaces them; holes that a nearer layer covers wholly are
 * left out.  `stroke` is the width of the drawing's lines in pixels. */
CeldStatus celd_layer_outline (const CeldLayers *layers, size_t layer, const CeldPlane *ink, int stroke,
                               CeldOutline *outline);
void celd_outline_clear (CeldOutline *outline);

/* ------------------------------------------------------------------ layer-curves.c */

/* A cubic Bezier curve, and the line along it. */
typedef struct { double x[4], y[4], width[2]; float colour[2][4]; } CeldCurve;

/* One curve for each gap of the outline: from where it goes in to where this or another gap comes out. */
void celd_layer_curves (const CeldLayers *layers, size_t layer, const CeldOutline *outline, CeldCurve *curve);

/* The place at t in [0,1]. */
void celd_curve_at (const CeldCurve *curve, double t, double *x, double *y);
/* Steps that are at most about a pixel long. */
int celd_curve_steps (const CeldCurve *curve);

/* ------------------------------------------------------------------ layer-coverage.c */

/* A picture that collects directed edges: of what is on their right the share of each pixel. */
typedef struct { CeldRect box; float *sum; } CeldCover;

CeldStatus celd_cover_new (CeldRect box, CeldCover *cover);      /* end with celd_free (sum) */
void celd_cover_edge (CeldCover *cover, double x, double y, double to_x, double to_y);
/* Once all edges are in: sum[] is the share, one tight plane of the box. */
void celd_cover_finish (CeldCover *cover);

/* ------------------------------------------------------------------ layer-completion.c */

/* Finds the hidden part of a layer. */
CeldStatus celd_layer_complete (CeldLayers *layers, size_t layer, bool everything, const CeldPlane *ink, int stroke,
                                const CeldHost *host);

#endif
