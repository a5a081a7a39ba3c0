/* A row of a view while it is made: the spans of one group after another, projected to their new places.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SCANLINE_H
#define CELD_SCANLINE_H

#include "stereo/scene.h"

/* new x = middle + squeeze (x - middle) - shift (depth - screen) */
typedef struct { double squeeze, middle, shift, screen; } CeldProjection;

/* The nearest sample of a group at each pixel of a row: `t` of the way from pixel `at` of the span to the next. */
typedef struct
{
  float                *nearest, *t;
  const CeldSceneSpan **span;              /* NULL: no sample */
  int                  *at;
  float                *colour;            /* composite of the row so far, premultiplied */
  int                   width, first, end; /* pixels that the group may have reached */
  CeldSceneSpan        *painted;           /* spans of a group of layers, with their pixels */
  float                *pixels;
} CeldScanline;

/* ------------------------------------------------------------------ scanline.c */

/* Memory of a scanline, rounded up for alignment. */
size_t       celd_scanline_bytes (const CeldScene *scene);
CeldScanline celd_scanline_in    (char *scratch, const CeldScene *scene);

/* The next spans of one group in a row, from number `first` of the scene on; returns how many they are. */
size_t celd_scanline_take_group (const CeldScene *scene, size_t first, CeldScanline *line, const CeldSceneSpan **spans);

/* Takes the samples of a span that are the nearest ones. */
void celd_scanline_project (const CeldProjection *move, const CeldSceneSpan *span, CeldScanline *line);

/* Interpolates between two pixels by a Catmull-Rom spline clamped to their range; linearly where their alphas
 * differ, so that premultiplied colours stay consistent. */
static inline void
celd_scanline_blend (const float *a, float t, float colour[4])
{
  if (a[3] != a[7])
    {
      for (int c = 0; c < 4; c++)
        colour[c] = a[c] + t * (a[4 + c] - a[c]);
      return;
    }
  for (int c = 0; c < 4; c++)
    {
      float from = a[c], to = a[4 + c], rise = to - from, low = from < to ? from : to, high = from < to ? to : from;
      float slope = 0.5f * (to - a[c - 4]), end = 0.5f * (a[8 + c] - from);
      float value = from + t * (slope + t * (3 * rise - 2 * slope - end + t * (slope + end - 2 * rise)));

      value     = value < low ? low : value;
      colour[c] = value > high ? high : value;
    }
}

/* ------------------------------------------------------------------ scene-transpose.c */

/* The scene after horizontal projection, with rows and columns exchanged, so that its rows can be projected in turn.
 * The caller frees it by celd_scene_free. */
CeldStatus celd_scene_transpose (const CeldScene *scene, CeldProjection move, const CeldHost *host, CeldScene **result);

#endif
