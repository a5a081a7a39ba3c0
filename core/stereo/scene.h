/* The inside of CeldScene: spans of rows that views shift sideways.
 *
 *   scene.c             spans, and scenes of layers
 *   scene-from-depth.c  scenes of a picture with a depth map
 *   scene-view.c        views
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SCENE_H
#define CELD_SCENE_H

#include "base/base.h"

#include <float.h>
#include <math.h>

#define CELD_SPAN_END 2 /* pixels stored beyond either end of a span, for interpolation */

/* n pixels from (x,y) on.  A span that ends at the frame continues beyond it.  colour[] is premultiplied and, like
 * depths[], can be read from pixel -CELD_SPAN_END to n + CELD_SPAN_END - 1. */
typedef struct
{
  int      x, y, n;
  uint32_t group;              /* within a group the nearest pixel wins; groups are composited in rising order */
  float   *colour, *depths;
} CeldSceneSpan;

/* The memory of a number of spans. */
typedef struct
{
  CeldSceneSpan *span;
  float         *colour, *depths;
  size_t         n, pixels;    /* used so far; `pixels` includes those beyond ends */
} CeldSceneSpans;

struct CeldScene
{
  int             width, height;
  bool            separate;    /* are spans of one group composited one by one, as separate surfaces? */
  double          least, most; /* range of depth */
  CeldSceneSpans *part;
  size_t          n_parts;
  CeldSceneSpan  *span;        /* of all parts, sorted by rows; within a row in the order of the parts */
  size_t         *row;         /* index of the first span of each row, and the number of spans at the end */
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

#endif
