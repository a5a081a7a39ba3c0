/* The inside of CeldLayers.
 *
 *   layers.c            assigns pixels to layers, also for pictures of levels; layers as pictures
 *   layer-unmixing.c    colours of two layers that share a pixel; rounding to stored values
 *   layer-paper.c       colours of what is hidden of a layer
 *   layer-completion.c  hidden parts of layers, with their line
 *   layer-joints.c      which layer each is attached to, and where
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAYERS_H
#define CELD_LAYERS_H

#include "sheets/sheets.h"

/* A pixel with two layers: index and colour (straight alpha), [0] of the front layer, [1] of the back one. */
typedef struct
{
  int      x, y;
  uint32_t layer[2];
  float    coverage;            /* of the pixel by the front layer */
  float    colour[2][4];
} CeldBlend;

/* Hidden pixels of a layer: runs in reading order, and of each pixel r, g, b, a in 1/65535. */
typedef struct
{
  CeldSheetRun *run;
  size_t        n_runs, n_pixels;
  uint16_t     *colour;
  float         paper[4];       /* flat paper: its exact colour; else 0 */
} CeldHiddenPart;

struct CeldLayers
{
  int               width, height;
  CeldStore         store;
  float             code_value[256], code_limit[256]; /* linear light of each sRGB code, and the upper limit of what is
                                                       * rounded to it */
  CeldLayer        *item;      /* from back to front */
  size_t            n;
  float            *art;       /* r, g, b, a of each pixel without padding, rounded to what can be stored */
  uint32_t         *place;     /* of each pixel: its layer, or n + its index among the blends */
  CeldBlend        *blend;     /* in reading order */
  size_t            n_blends;
  CeldHiddenPart   *hidden;    /* of each layer: its part of the sheet's silhouette */
  CeldHiddenPart   *margin;    /* of each layer: the sheet's margin, opaque where its paper is, and what is
                                * antialiased of its silhouette; for views only */
};

/* ------------------------------------------------------------------ layer-unmixing.c */

void celd_quantizer_prepare (CeldLayers *layers);

/* Round to the nearest value that can be stored. */
float celd_quantize_alpha  (const CeldLayers *layers, float alpha);
float celd_quantize_colour (const CeldLayers *layers, float value);


/* Fills in the colours of the blends.  `ink` is that of the drawing. */
CeldStatus celd_layers_unmix (CeldLayers *layers, const CeldPlane *ink, const CeldHost *host);

/* ------------------------------------------------------------------ layers.c */

/* Makes room for up to n layers, which are to be filled in and counted; freed by the caller, also after a failure. */
CeldStatus celd_layers_new (int width, int height, size_t n, CeldLayers **made);

/* Cuts the art into layers by the ownership of levels, completed with settings->complete. */
CeldStatus celd_level_layers_cut (const CeldLevelOwnership *made, const CeldPlane *ink, const CeldColours *art,
                                  CeldStore store, const CeldSettings *settings, const CeldHost *host,
                                  CeldLayers **layers);

/* ------------------------------------------------------------------ layer-paper.c */

/* Colours, with straight alpha, for the pixels of a box. */
typedef struct
{
  CeldRect box;
  bool     any;                 /* has the layer any pixel of its own? otherwise there are no colours */
  float    flat[4];             /* of all pixels, if `value` is NULL */
  float   *value;               /* r, g, b, a of each pixel of the box; the caller frees it with celd_free */
} CeldHiddenPaper;

/* Finds the colours in paper->box, which contains `seen`, the box of what is visible of the layer. */
CeldStatus celd_hidden_paper (const CeldLayers *layers, size_t layer, const CeldPlane *ink, CeldRect seen,
                              const CeldHost *host, CeldHiddenPaper *paper);

/* ------------------------------------------------------------------ layer-completion.c */

/* Finds the hidden parts of all layers, in the order of the sheets.  `ink` is that of the drawing. */
CeldStatus celd_layers_complete (CeldLayers *layers, const CeldPlane *ink, const CeldOwnership *own,
                                 const CeldSheets *sheets, const CeldHost *host);

/* The colour of a pixel of a hidden part, with straight alpha; returns its alpha. */
float celd_hidden_colour (const CeldHiddenPart *part, size_t pixel, float colour[4]);

#endif
