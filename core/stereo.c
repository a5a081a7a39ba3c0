/* Views from the side: stereoscopic pictures and parallax (section 5, Figure 1g).
 *
 * A point of depth d moves by half of its disparity  delta = B (d - d_0)  for each eye, in opposite directions; what
 * has depth d_0 stays where it is, on the screen.  Layers are moved one by one, back to front, each by its own depth,
 * which goes on under whatever hides the layer: what comes into sight then is the layer's hidden part, not a smear of
 * what is next to it.  Layers that reach the frame go on beyond it.
 *
 * A row of a layer becomes a line through its pixels' new places, so that it has no cracks where it is stretched;
 * where it folds over itself, the nearer part counts.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <float.h>
#include <math.h>

#define BAND 32 /* rows of one job */

typedef struct
{
  const CeldOwnership *own;
  const CeldPlane     *depth;
  double               shift, screen; /* place = x - shift (depth - screen) */
  CeldLayer            layer;
  float               *art;           /* of the layer's box, premultiplied */
  float               *near;          /* depth of the layer in its box */
  CeldColours         *view;          /* premultiplied */
  float               *scratch;
} View;

/* ------------------------------------------------------------------ the depth of a layer */

/* Is the depth of this pixel the layer's?  It is that of the label that covers more of it. */
static bool
is_own (const View *v, int x, int y)
{
  const CeldLabels *larger = CELD_AT (&v->own->share, x, y) < 0.5f ? &v->own->under : &v->own->owner;

  return CELD_AT (larger, x, y) == v->layer.label;
}

/* Row y of the box, where it is the layer's own; between, and beyond at its ends, from there.  False: nowhere. */
static bool
fill_row (View *v, int y)
{
  CeldRect box = v->layer.box;
  float   *near = v->near + (size_t) y * (size_t) box.width;
  int      last = -1;

  for (int x = 0; x < box.width; x++)
    {
      float depth = CELD_AT (v->depth, box.x + x, box.y + y);

      if (!is_own (v, box.x + x, box.y + y))
        continue;
      near[x] = isfinite (depth) ? depth : 0;
      for (int k = last + 1; k < x; k++)
        near[k] = last < 0 ? near[x] : near[last] + (near[x] - near[last]) * (float) (k - last) / (float) (x - last);
      last = x;
    }
  for (int k = last + 1; k < box.width && last >= 0; k++)
    near[k] = near[last];
  return last >= 0;
}

/* Rows without an own pixel are as the next one above, or at the top the next one below. */
static void
fill_depth (View *v)
{
  CeldRect box = v->layer.box;
  size_t   w = (size_t) box.width;
  int      known = -1;

  for (int y = 0; y < box.height; y++)
    if (fill_row (v, y))
      {
        for (int k = 0; known < 0 && k < y; k++)
          memcpy (v->near + (size_t) k * w, v->near + (size_t) y * w, w * sizeof *v->near);
        known = y;
      }
    else if (known >= 0)
      memcpy (v->near + (size_t) y * w, v->near + (size_t) (y - 1) * w, w * sizeof *v->near);
  for (size_t i = 0; known < 0 && i < w * (size_t) box.height; i++)
    v->near[i] = (float) v->screen;
}

/* ------------------------------------------------------------------ a row on its way */

/* The layer's pixel at x, which may lie beyond its box: there it goes on if the box ends at the frame. */
static const float *
pixel_at (const View *v, const float *row, int x)
{
  static const float nothing[4] = { 0 };
  CeldRect           box = v->layer.box;

  if (x < 0)
    return box.x == 0 ? row : nothing;
  if (x >= box.width)
    return box.x + box.width == v->view->width ? row + 4 * (box.width - 1) : nothing;
  return row + 4 * x;
}

/* Between the pixels x and x + 1, at t: a cubic through their neighbours, too (Catmull and Rom), that does not leave
 * the range of the two. */
static void
blend_at (const View *v, const float *row, int x, float t, float colour[4])
{
  const float *before = pixel_at (v, row, x - 1), *a = pixel_at (v, row, x);
  const float *b = pixel_at (v, row, x + 1), *behind = pixel_at (v, row, x + 2);

  for (int k = 0; k < 4; k++)
    {
      float low = fminf (a[k], b[k]), high = fmaxf (a[k], b[k]);
      float slope = 0.5f * (b[k] - before[k]), to = 0.5f * (behind[k] - a[k]), rise = b[k] - a[k];
      float value = a[k] + t * (slope + t * (3 * rise - 2 * slope - to + t * (slope + to - 2 * rise)));

      colour[k] = fmaxf (low, fminf (value, high));
    }
}

/* The new place of the middle of pixel x, and its depth. */
static double
place_of (const View *v, const float *near, int x, float *depth)
{
  int inside = x < 0 ? 0 : x < v->layer.box.width ? x : v->layer.box.width - 1;

  *depth = near[inside];
  return v->layer.box.x + x + 0.5 - v->shift * ((double) *depth - v->screen);
}

/* The pixels of the view whose middles lie from `from` to before `to`, on the line from pixel x to x + 1. */
static void
draw_piece (const View *v, const float *row, int x, double from, double to, float near, float far, float *line,
            float *nearest)
{
  double first = fmax (ceil (from - 0.5), 0), end = fmin (ceil (to - 0.5), v->view->width);

  for (int k = (int) first; k < end; k++)
    {
      float t = (float) ((k + 0.5 - from) / (to - from)), depth = near + t * (far - near);

      if (depth < nearest[k])
        continue;
      nearest[k] = depth;
      blend_at (v, row, x, t, line + 4 * k);
    }
}

static void
draw_row (const View *v, int y, float *line, float *nearest)
{
  CeldRect     box = v->layer.box;
  const float *row = v->art + 4 * (size_t) y * (size_t) box.width, *near = v->near + (size_t) y * (size_t) box.width;
  float        depth, next_depth;
  int          beyond = (int) ceil (fabs (v->shift)) + 2; /* what can come in from beyond the frame */
  int          first = box.x == 0 ? -beyond : -1;
  int          end = box.x + box.width == v->view->width ? box.width + beyond : box.width;
  double       place = place_of (v, near, first, &depth);

  for (int x = first; x < end; x++)
    {
      double next = place_of (v, near, x + 1, &next_depth);

      if (next > place && (pixel_at (v, row, x)[3] > 0 || pixel_at (v, row, x + 1)[3] > 0))
        draw_piece (v, row, x, place, next, depth, next_depth, line, nearest);
      place = next;
      depth = next_depth;
    }
}

/* Lays a band of rows of the layer over the view. */
static void
draw_band (void *data, int band)
{
  const View *v = data;
  int         width = v->view->width, end = (band + 1) * BAND;
  float      *line = v->scratch + 5 * (size_t) band * (size_t) width, *nearest = line + 4 * width;

  end = end < v->layer.box.height ? end : v->layer.box.height;
  for (int y = band * BAND; y < end; y++)
    {
      float *to = CELD_RGBA (v->view, 0, v->layer.box.y + y);

      memset (line, 0, 4 * (size_t) width * sizeof *line);
      for (int x = 0; x < width; x++)
        nearest[x] = -FLT_MAX;
      draw_row (v, y, line, nearest);
      for (int i = 0; i < 4 * width; i++)
        to[i] = line[i] + (1 - line[i | 3]) * to[i];
    }
}

/* ------------------------------------------------------------------ */

typedef struct { double least, most, screen; } Range;

/* What depth there is; convergence is a share of that. */
static Range
depth_range (const CeldPlane *depth, const CeldSettings *settings)
{
  float least = FLT_MAX, most = -FLT_MAX;

  for (int y = 0; y < depth->height; y++)
    for (int x = 0; x < depth->width; x++)
      if (isfinite (CELD_AT (depth, x, y)))
        {
          least = fminf (least, CELD_AT (depth, x, y));
          most  = fmaxf (most, CELD_AT (depth, x, y));
        }
  if (most < least)
    return (Range) { 0 };
  return (Range) { (double) least, (double) most,
                   (double) least + (double) settings->convergence * ((double) most - (double) least) };
}

CeldStatus
celd_stereo_comfort (const CeldPlane *depth, const CeldSettings *settings, CeldComfort *comfort)
{
  Range  range;
  double disparity = (double) settings->disparity;

  if (!CELD_SAME_SIZE (depth, depth))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  range    = depth_range (depth, settings);
  *comfort = (CeldComfort) { .front = disparity * (range.most - range.screen),
                             .behind = disparity * (range.screen - range.least) };
  for (int y = 0; y < depth->height; y++) /* by a pixel at least */
    {
      double least = range.screen + 1 / fmax (disparity * depth->width, 1e-9);

      comfort->cut_left  = comfort->cut_left || (double) CELD_AT (depth, 0, y) > least;
      comfort->cut_right = comfort->cut_right || (double) CELD_AT (depth, depth->width - 1, y) > least;
    }
  return CELD_OK;
}

static CeldStatus
draw_layer (View *v, const CeldLayers *layers, size_t layer, const CeldRun *run)
{
  CeldRect box;
  size_t   n;

  v->layer = *celd_layers_item (layers, layer);
  if (!v->layer.box.width)
    v->layer.box = (CeldRect) { 0, 0, v->view->width, v->view->height };
  box     = v->layer.box;
  n       = (size_t) box.width * (size_t) box.height;
  v->art  = celd_alloc (n, 4 * sizeof *v->art);
  v->near = celd_alloc (n, sizeof *v->near);
  if (v->art && v->near)
    {
      celd_layers_paint (layers, layer, v->art);
      for (size_t i = 0; i < 4 * n; i++)
        v->art[i] *= i % 4 == 3 ? 1 : v->art[i | 3];
      fill_depth (v);
      celd_each (run, (box.height + BAND - 1) / BAND, draw_band, v);
    }
  celd_free (v->art);
  celd_free (v->near);
  return v->art && v->near ? CELD_OK : CELD_NO_MEMORY;
}

/* The colours with straight alpha. */
static void
deliver (const CeldColours *from, CeldColours *to)
{
  for (int y = 0; y < to->height; y++)
    for (int x = 0; x < to->width; x++)
      {
        const float *rgba = CELD_RGBA (from, x, y);

        for (int c = 0; c < 4; c++)
          CELD_RGBA (to, x, y)[c] = c < 3 && rgba[3] > 0 ? rgba[c] / rgba[3] : rgba[c];
      }
}

CeldStatus
celd_stereo_view (const CeldLayers *layers, const CeldOwnership *ownership, const CeldPlane *depth, double eye,
                  const CeldSettings *settings, const CeldRun *run, CeldColours *view)
{
  size_t      n = celd_layers_count (layers), width = (size_t) depth->width, height = (size_t) depth->height;
  CeldColours drawn = { depth->width, depth->height, width, NULL };
  View        v = { .own = ownership, .depth = depth, .view = &drawn };
  CeldStatus  status = CELD_OK;

  if (!CELD_SAME_SIZE (depth, view) || !CELD_SAME_SIZE (depth, &ownership->owner))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK || !(fabs (eye) <= 1))
    return CELD_BAD_VALUE;
  v.shift    = eye * (double) settings->disparity * view->width / 2;
  v.screen   = depth_range (depth, settings).screen;
  v.scratch  = celd_alloc (5 * ((height + BAND - 1) / BAND), width * sizeof *v.scratch);
  drawn.data = celd_alloc0 (width * height, 4 * sizeof *drawn.data);
  if (!v.scratch || !drawn.data)
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      status = draw_layer (&v, layers, i, run);
      if (status == CELD_OK)
        status = celd_step (run, (double) (i + 1) / (double) n);
    }
  if (status == CELD_OK)
    deliver (&drawn, view);
  celd_free (v.scratch);
  celd_free (drawn.data);
  return status;
}
