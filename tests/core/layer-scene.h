/* A drawing whose parts are known, for the tests of layers, and a compositor.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef LAYER_SCENE_H
#define LAYER_SCENE_H

#include "base/base.h"
#include "check.h"

#define MOST_LABELS 8

typedef struct
{
  int           width, height;
  CeldPlane     ink, depth;
  CeldOwnership own;
  CeldColours   art;
  uint32_t      level[MOST_LABELS];
} LayerScene;

/* White paper of depth 0, all of label 1; level k of label k + 1. */
static inline LayerScene
layer_scene (int width, int height)
{
  LayerScene s = { .width = width, .height = height };
  size_t     n = (size_t) width * (size_t) height;

  CHECK (celd_plane_new (width, height, &s.ink) == CELD_OK);
  CHECK (celd_plane_new (width, height, &s.depth) == CELD_OK);
  CHECK (celd_labels_new (width, height, &s.own.owner) == CELD_OK);
  CHECK (celd_labels_new (width, height, &s.own.under) == CELD_OK);
  CHECK (celd_plane_new (width, height, &s.own.coverage) == CELD_OK);
  s.art = (CeldColours) { width, height, (size_t) width, malloc (4 * n * sizeof (float)) };
  for (size_t p = 0; p < n; p++)
    {
      s.ink.data[p] = s.own.coverage.data[p] = 1;
      s.depth.data[p] = 0;
      s.own.owner.data[p] = s.own.under.data[p] = 1;
      for (int c = 0; c < 4; c++)
        s.art.data[4 * p + (size_t) c] = 1;
    }
  for (uint32_t k = 0; k < MOST_LABELS; k++)
    s.level[k] = k;
  return s;
}

static inline void
layer_scene_close (LayerScene *s)
{
  free (s->ink.data);
  free (s->depth.data);
  free (s->own.owner.data);
  free (s->own.under.data);
  free (s->own.coverage.data);
  free (s->art.data);
}

static inline float *
art_at (LayerScene *s, int x, int y)
{
  return s->art.data + 4 * (y * s->width + x);
}

/* Paints a shape over what there is: where inside (x,y) is a share of the pixel, and line (x,y) the share of its ink.
 * Both are given the middle of the pixel. */
typedef double (*LayerShare) (double x, double y);

static inline void
layer_scene_paint (LayerScene *s, uint32_t label, const float colour[3], LayerShare inside, LayerShare line)
{
  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++)
      {
        double share = inside (x + 0.5, y + 0.5), ink = line ? line (x + 0.5, y + 0.5) : 0;
        float *art = art_at (s, x, y);

        if (!(share > 0))
          continue;
        for (int c = 0; c < 3; c++)
          art[c] = (float) ((1 - share) * (double) art[c] + share * (1 - ink) * (double) colour[c]);
        CELD_AT (&s->ink, x, y) = (float) ((1 - share) * (double) CELD_AT (&s->ink, x, y) + share * (1 - ink));
        CELD_AT (&s->own.under, x, y) = share < 1 ? CELD_AT (&s->own.owner, x, y) : label;
        CELD_AT (&s->own.owner, x, y) = label;
        CELD_AT (&s->own.coverage, x, y) = (float) share;
      }
}

/* Shares of pixels in a box, and outside its inside, which is 3 pixels from its edges. */
static inline double
box_share (double x, double y, double left, double top, double right, double bottom)
{
  double w = fmin (x + 0.5, right) - fmax (x - 0.5, left), h = fmin (y + 0.5, bottom) - fmax (y - 0.5, top);

  return fmax (w, 0) * fmax (h, 0);
}

static inline double
frame_share (double x, double y, double left, double top, double right, double bottom)
{
  return 1 - box_share (x, y, left + 3, top + 3, right - 3, bottom - 3);
}

/* The sheets of n labels, by their levels; the background is label 1. */
static inline CeldSheets *
layer_scene_sheets (const LayerScene *s, size_t n, const CeldHost *host)
{
  CeldSheets  *sheets = NULL;
  CeldOrder    order = { .level = (uint32_t *) s->level, .n = n };
  CeldSettings settings = celd_settings ();

  CHECK (celd_sheets (&s->ink, &s->own, NULL, &order, 1, &settings, host, &sheets) == CELD_OK);
  return sheets;
}

/* Cuts it into n labels; the background is label 1. */
static inline CeldLayers *
layer_scene_cut (const LayerScene *s, size_t n, CeldStore store, bool complete)
{
  CeldLayers *layers = NULL;
  CeldSheets *sheets = complete ? layer_scene_sheets (s, n, NULL) : NULL;

  CHECK (celd_layers_cut (&s->ink, &s->own, s->level, n, &s->art, sheets, store, NULL, &layers) == CELD_OK);
  celd_sheets_free (sheets);
  return layers;
}

/* A layer on the whole canvas. */
static inline float *
layer_canvas (const LayerScene *s, const CeldLayers *layers, size_t layer)
{
  CeldRect box = celd_layers_item (layers, layer)->box;
  float   *canvas = calloc (4 * (size_t) s->width * (size_t) s->height, sizeof *canvas);
  float   *part = malloc ((4 * (size_t) box.width * (size_t) box.height + 1) * sizeof *part);

  celd_layers_paint (layers, layer, part);
  for (int y = 0; y < box.height; y++)
    memcpy (canvas + 4 * ((y + box.y) * s->width + box.x), part + 4 * y * box.width,
            4 * (size_t) box.width * sizeof *part);
  free (part);
  return canvas;
}

/* All layers over each other, premultiplied. */
static inline double *
layer_composite (const LayerScene *s, const CeldLayers *layers)
{
  size_t  n = (size_t) s->width * (size_t) s->height;
  double *sum = calloc (4 * n, sizeof *sum);

  for (size_t k = 0; k < celd_layers_count (layers); k++)
    {
      float *canvas = layer_canvas (s, layers, k);

      for (size_t p = 0; p < n; p++)
        {
          double alpha = (double) canvas[4 * p + 3];

          for (size_t c = 0; c < 4; c++)
            sum[4 * p + c] = (c < 3 ? alpha * (double) canvas[4 * p + c] : alpha) + (1 - alpha) * sum[4 * p + c];
        }
      free (canvas);
    }
  return sum;
}

/* The largest difference to the art, premultiplied. */
static inline double
layer_error (const LayerScene *s, const double *composite)
{
  double worst = 0;

  for (size_t p = 0; p < (size_t) s->width * (size_t) s->height; p++)
    for (size_t c = 0; c < 4; c++)
      {
        double alpha = (double) s->art.data[4 * p + 3];
        double wanted = c < 3 ? alpha * (double) s->art.data[4 * p + c] : alpha;

        worst = fmax (worst, fabs (composite[4 * p + c] - wanted));
      }
  return worst;
}

#endif
