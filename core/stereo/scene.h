/* The inside of CeldScene: spans of rows that views shift sideways.
 *
 *   scene.c             spans
 *   scene-of-layers.c   scenes of layers
 *   layer-depth.c       depth of layers where they are occluded
 *   scene-from-depth.c  scenes of a picture with a depth map
 *   scanline.c          rows of views
 *   scene-transpose.c   columns of views from above or below
 *   scene-view.c        views
 *   turntable.c         scenes of a relief that turns
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SCENE_H
#define CELD_SCENE_H

#include "layers/layers.h"
#include "ownership/ownership.h"

#include <float.h>
#include <math.h>

#define CELD_SPAN_END 2 /* pixels stored beyond either end of a span, for interpolation */

/* n pixels from (x,y) on.  A span that ends at the frame continues beyond it.  colour[] is premultiplied and, like
 * depths[], can be read from pixel -CELD_SPAN_END to n + CELD_SPAN_END - 1.  In a scene of layers both are NULL; they
 * are painted for each row of a view. */
typedef struct
{
  int      x, y, n;
  uint32_t group;              /* within a group the nearest pixel wins; groups are composited in rising order */
  size_t   hidden, extended;   /* in a scene of layers: index of the first run of hidden pixels (in a margin, pixel) and
                                * of the first extended depth in this span or behind it */
  float   *colour, *depths;
} CeldSceneSpan;

/* A number of spans with their memory. */
typedef struct
{
  CeldSceneSpan *span;
  size_t         n, capacity;
  float         *colour, *depths;
  size_t         pixels;       /* used so far, including those beyond ends */
} CeldSceneSpans;

/* Depth of a layer: of its pixels that are not its alone, in reading order, or one for all of its pixels (value
 * NULL). */
typedef struct { float *value, flat; } CeldLayerDepth;

struct CeldScene
{
  int               width, height;
  bool              separate;    /* are spans of one group composited one by one, as separate surfaces? */
  bool              opaque;      /* does nothing lie behind the scene, so that views are opaque? */
  double            least, most; /* range of depth */
  CeldSceneSpans   *part;
  size_t            n_parts;
  CeldSceneSpan    *span;        /* of all parts, sorted by rows; within a row in the order of the parts */
  size_t           *row;         /* index of the first span of each row, and the number of spans at the end */
  size_t            most_spans, most_pixels; /* of one group in one row, pixels beyond ends included */
  const CeldLayers *layers;      /* of a scene of layers, else NULL */
  CeldLayers       *own_layers;  /* the same if the scene frees them */
  CeldPlane         depth;       /* of a scene of layers: the picture's */
  CeldLayerDepth   *extended;    /* of a scene of layers: of each group */
};

/* Depth as stored: NaN and infinity become 0, and magnitude is limited so that shifts can be counted in int. */
static inline float
celd_scene_depth (float depth)
{
  if (!(fabsf (depth) <= FLT_MAX))
    return 0;
  return depth < -1e5f ? -1e5f : depth < 1e5f ? depth : 1e5f;
}

/* Range of the finite depths; 0 and 0 if there are none. */
void celd_depth_range (const CeldPlane *depth, double *least, double *most);

CeldStatus celd_scene_new (int width, int height, size_t parts, CeldScene **scene);

/* Allocates n spans with that many pixels in all. */
CeldStatus celd_scene_spans_new (size_t n, size_t pixels, CeldSceneSpans *spans);
/* Adds a span, whose n pixels the caller fills in before celd_scene_span_pad fills those beyond its ends. */
CeldSceneSpan *celd_scene_spans_add (CeldSceneSpans *spans, int x, int y, int n, uint32_t group);
void      celd_scene_span_pad (CeldSceneSpan *span, int width);

/* Makes spans of all pixels of a picture that are not transparent; `rgba` is premultiplied, and both planes have the
 * size of the box. */
CeldStatus celd_scene_spans_of_picture (CeldRect box, int width, const float *rgba, const float *depths, uint32_t group,
                                        const CeldHost *host, CeldSceneSpans *spans);

/* Sorts the spans by rows; to be called once, when all parts are complete. */
CeldStatus celd_scene_sort (CeldScene *scene);

/* ------------------------------------------------------------------ scenes of layers */

/* Group 0 is the farthest layer, 1 .. n are the margins of all layers, n + 1 .. 2 n - 1 are the other layers. */

static inline uint32_t
celd_scene_group_of_layer (const CeldScene *scene, uint32_t layer)
{
  return layer ? (uint32_t) scene->layers->n + layer : 0;
}

static inline bool
celd_scene_is_margin (const CeldScene *scene, uint32_t group)
{
  return group > 0 && group <= scene->layers->n;
}

static inline uint32_t
celd_scene_layer_of_group (const CeldScene *scene, uint32_t group)
{
  return celd_scene_is_margin (scene, group) ? group - 1 : group ? group - (uint32_t) scene->layers->n : 0;
}

/* Is a pixel the layer's alone?  Its depth is then the picture's. */
static inline bool
celd_scene_is_whole (const CeldLayers *layers, uint32_t layer, int x, int y)
{
  return layers->place[(size_t) y * (size_t) layers->width + (size_t) x] == layer;
}

/* Writes the n pixels of a span of a scene of layers: premultiplied colours, and depth. */
void celd_scene_paint_layer (const CeldScene *scene, const CeldSceneSpan *span, float *colour, float *depths);

/* Finds the depth of the n[0] pixels in the spans of a layer that are not its alone, and of the n[1] pixels of its
 * margin. */
CeldStatus celd_scene_layer_depth (CeldScene *scene, const CeldOwnership *own, uint32_t layer, const size_t n[2]);

#endif
