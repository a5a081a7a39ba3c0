/* The inside of CeldScene: what there is to see, as pieces of rows that move sideways.
 *
 *   scene.c        the pieces, and those of layers
 *   scene-levels.c those of a picture with levels and depth
 *   scene-depth.c  those of a picture with depth alone
 *   scene-view.c   how they look from the side
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SCENE_H
#define CELD_SCENE_H

#include "base/base.h"

#include <float.h>
#include <math.h>

#define CELD_SPAN_END 2 /* pixels that are stored beyond either end of a piece, for blending */

/* n pixels from (x,y) on.  At the frame a piece goes on beyond it, elsewhere it ends.  colour[] is premultiplied and,
 * as near[], can be read from pixel -CELD_SPAN_END to n + CELD_SPAN_END - 1. */
typedef struct
{
  int      x, y, n;
  uint32_t group;              /* within one the nearest counts; each is laid over those before it */
  float   *colour, *depths;
} CeldSceneSpan;

/* The memory of some pieces. */
typedef struct
{
  CeldSceneSpan *span;
  float    *colour, *depths;
  size_t    n, pixels;         /* that are in it; `pixels` with what is beyond ends */
} CeldSceneSpans;

struct CeldScene
{
  int        width, height;
  bool       separate;            /* pieces of a group are laid one by one, as different surfaces */
  double     least, most;      /* depth that there is */
  CeldSceneSpans *part;
  size_t     n_parts;
  CeldSceneSpan  *span;             /* of all parts, by rows; within a row in the order of the parts */
  size_t    *row;              /* the first of each row, and one behind the last */
};

/* Depth as it is kept: what is not a number is 0, and none is so large that pixels cannot be counted. */
static inline float
celd_scene_depth (float depth)
{
  if (!(fabsf (depth) <= FLT_MAX))
    return 0;
  return depth < -1e5f ? -1e5f : depth < 1e5f ? depth : 1e5f;
}

/* Least and most depth; 0 and 0 if there is none. */
void celd_depth_range (const CeldPlane *depth, double *least, double *most);

CeldStatus celd_scene_new (int width, int height, size_t parts, CeldScene **scene);

/* Room for n pieces of so many pixels in all. */
CeldStatus celd_scene_spans_new (size_t n, size_t pixels, CeldSceneSpans *spans);
/* The next piece, whose n pixels the caller fills; then it is closed. */
CeldSceneSpan *celd_scene_spans_add (CeldSceneSpans *spans, int x, int y, int n, uint32_t group);
void      celd_scene_span_pad (CeldSceneSpan *span, int width);

/* All that is not transparent in a picture: `rgba` premultiplied and `near` as large as the box. */
CeldStatus celd_scene_spans_of_picture (CeldRect box, int width, const float *rgba, const float *depths, uint32_t group,
                                  const CeldHost *host, CeldSceneSpans *spans);

/* Once all parts are there. */
CeldStatus celd_scene_sort (CeldScene *scene);

#endif
