/* A scene: the visible and the hidden pixels of layers with their depth, as spans of rows.
 *
 * Spans hold only pixels that are not transparent, so that memory and the cost of views are proportional to their
 * number.  Where a layer is occluded, its depth is interpolated along rows.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"
#include "ownership/ownership.h"
#include "stereo/scene.h"

#define BAND_ROWS 32 /* rows of one task */

void
celd_depth_range (const CeldPlane *depth, double *least, double *most)
{
  float low = FLT_MAX, high = -FLT_MAX;

  for (int y = 0; y < depth->height; y++)
    for (int x = 0; x < depth->width; x++)
      {
        float value = CELD_AT (depth, x, y);

        if (!(fabsf (value) <= FLT_MAX))
          continue;
        low  = value < low ? value : low;
        high = value > high ? value : high;
      }
  *least = low <= high ? (double) celd_scene_depth (low) : 0;
  *most  = low <= high ? (double) celd_scene_depth (high) : 0;
}

/* ------------------------------------------------------------------ spans */

CeldStatus
celd_scene_spans_new (size_t n, size_t pixels, CeldSceneSpans *spans)
{
  size_t all = pixels + 2 * CELD_SPAN_END * n;

  *spans = (CeldSceneSpans) {
    .span   = celd_alloc (n, sizeof *spans->span),
    .colour = celd_alloc (all, 4 * sizeof *spans->colour),
    .depths   = celd_alloc (all, sizeof *spans->depths),
  };
  return spans->span && spans->colour && spans->depths ? CELD_OK : CELD_NO_MEMORY;
}

CeldSceneSpan *
celd_scene_spans_add (CeldSceneSpans *spans, int x, int y, int n, uint32_t group)
{
  CeldSceneSpan *span = &spans->span[spans->n++];
  size_t         first = spans->pixels + CELD_SPAN_END;

  *span = (CeldSceneSpan) { x, y, n, group, spans->colour + 4 * first, spans->depths + first };
  spans->pixels += (size_t) n + 2 * CELD_SPAN_END;
  return span;
}

void
celd_scene_span_pad (CeldSceneSpan *span, int width)
{
  for (int k = 1; k <= CELD_SPAN_END; k++)
    {
      float *before = span->colour - 4 * k, *behind = span->colour + 4 * (span->n + k - 1);

      memset (before, 0, 4 * sizeof *before);
      memset (behind, 0, 4 * sizeof *behind);
      if (span->x == 0)
        memcpy (before, span->colour, 4 * sizeof *before);
      if (span->x + span->n == width)
        memcpy (behind, span->colour + 4 * (span->n - 1), 4 * sizeof *behind);
      span->depths[-k]              = span->depths[0];
      span->depths[span->n + k - 1] = span->depths[span->n - 1];
    }
}

/* Finds the next run of pixels that are not transparent, from x on: returns its end, *first is its beginning, and
 * both are n if there is none. */
static int
next_run (const float *rgba, int n, int x, int *first)
{
  while (x < n && !(rgba[4 * x + 3] > 0))
    x++;
  *first = x;
  while (x < n && rgba[4 * x + 3] > 0)
    x++;
  return x;
}

CeldStatus
celd_scene_spans_of_picture (CeldRect box, int width, const float *rgba, const float *depths, uint32_t group,
                             const CeldHost *host, CeldSceneSpans *spans)
{
  size_t     w = (size_t) box.width, n = 0, pixels = 0;
  CeldStatus status;

  for (int y = 0, first; y < box.height; y++)
    for (int x = 0; (x = next_run (rgba + 4 * (size_t) y * w, box.width, x, &first)) > first;)
      {
        n++;
        pixels += (size_t) (x - first);
      }
  status = celd_scene_spans_new (n, pixels, spans);
  for (int y = 0, first; y < box.height && status == CELD_OK; y++)
    {
      const float *row = rgba + 4 * (size_t) y * w;

      for (int x = 0; (x = next_run (row, box.width, x, &first)) > first;)
        {
          CeldSceneSpan *span = celd_scene_spans_add (spans, box.x + first, box.y + y, x - first, group);

          memcpy (span->colour, row + 4 * first, 4 * (size_t) span->n * sizeof *row);
          memcpy (span->depths, depths + (size_t) y * w + first, (size_t) span->n * sizeof *depths);
          celd_scene_span_pad (span, width);
        }
      if (y % 256 == 255)
        status = celd_progress (host, 0);
    }
  return status;
}

/* ------------------------------------------------------------------ the object */

CeldStatus
celd_scene_new (int width, int height, size_t parts, CeldScene **made)
{
  CeldScene *scene = celd_alloc0 (1, sizeof *scene);

  *made = scene;
  if (!scene)
    return CELD_NO_MEMORY;
  scene->width   = width;
  scene->height  = height;
  scene->row     = celd_alloc0 ((size_t) height + 2, sizeof *scene->row);
  scene->part    = celd_alloc0 (parts, sizeof *scene->part);
  scene->n_parts = scene->part ? parts : 0;
  return scene->row && scene->part ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_scene_free (CeldScene *scene)
{
  if (!scene)
    return;
  for (size_t k = 0; k < scene->n_parts; k++)
    {
      celd_free (scene->part[k].span);
      celd_free (scene->part[k].colour);
      celd_free (scene->part[k].depths);
    }
  celd_free (scene->part);
  celd_free (scene->span);
  celd_free (scene->row);
  celd_free (scene);
}

/* Counting sort: row[y + 2] first has the number of spans of row y, then row[y + 1] is the index of the next one. */
CeldStatus
celd_scene_sort (CeldScene *scene)
{
  size_t n = 0;

  for (size_t k = 0; k < scene->n_parts; k++)
    n += scene->part[k].n;
  scene->span = celd_alloc (n, sizeof *scene->span);
  if (!scene->span)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < scene->n_parts; k++)
    for (size_t i = 0; i < scene->part[k].n; i++)
      scene->row[scene->part[k].span[i].y + 2]++;
  for (int y = 0; y < scene->height; y++)
    scene->row[y + 2] += scene->row[y + 1];
  for (size_t k = 0; k < scene->n_parts; k++)
    for (size_t i = 0; i < scene->part[k].n; i++)
      scene->span[scene->row[scene->part[k].span[i].y + 1]++] = scene->part[k].span[i];
  for (size_t k = 0; k < scene->n_parts; k++)
    {
      celd_free (scene->part[k].span);
      scene->part[k].span = NULL;
    }
  return CELD_OK;
}

/* ------------------------------------------------------------------ scenes of layers */

typedef struct
{
  const CeldOwnership *own;
  const CeldPlane     *depth;
  CeldLayer            layer;
  float               *art, *depths; /* of the layer's box; the art is premultiplied */
  bool                *known;        /* of each row: does it have depth of the layer's own? */
} LayerDepth;

/* Is the depth of this pixel the layer's?  It is that of the label that covers most of the pixel. */
static bool
is_own (const LayerDepth *p, int x, int y)
{
  const CeldLabels *larger = CELD_AT (&p->own->coverage, x, y) < 0.5f ? &p->own->under : &p->own->owner;

  return CELD_AT (larger, x, y) == p->layer.label;
}

/* Copies the layer's own depth in row y of the box, and interpolates between, constant at both ends.  False if there
 * is none. */
static bool
fill_row (const LayerDepth *p, int y)
{
  CeldRect box = p->layer.box;
  float   *depths = p->depths + (size_t) y * (size_t) box.width;
  int      last = -1;

  for (int x = 0; x < box.width; x++)
    {
      if (!is_own (p, box.x + x, box.y + y))
        continue;
      depths[x] = celd_scene_depth (CELD_AT (p->depth, box.x + x, box.y + y));
      for (int k = last + 1; k < x; k++)
        depths[k] = last < 0 ? depths[x] : depths[last] + (depths[x] - depths[last])
                    * (float) (k - last) / (float) (x - last);
      last = x;
    }
  for (int k = last + 1; k < box.width && last >= 0; k++)
    depths[k] = depths[last];
  return last >= 0;
}

static void
prepare_band (void *data, int band)
{
  LayerDepth *p = data;
  int         w = p->layer.box.width, end = (band + 1) * BAND_ROWS;

  for (int y = band * BAND_ROWS; y < end && y < p->layer.box.height; y++)
    {
      float *art = p->art + 4 * (size_t) y * (size_t) w;

      p->known[y] = fill_row (p, y);
      for (int i = 0; i < 4 * w; i += 4)
        for (int c = 0; c < 3; c++)
          art[i + c] *= art[i + 3];
    }
}

/* Rows without depth of their own copy the next one above, or at the top the next one below. */
static void
fill_rows (const LayerDepth *p)
{
  size_t w = (size_t) p->layer.box.width;
  int    last = -1;

  for (int y = 0; y < p->layer.box.height; y++)
    {
      if (p->known[y])
        for (int k = last < 0 ? 0 : y; k < y; k++)
          memcpy (p->depths + (size_t) k * w, p->depths + (size_t) y * w, w * sizeof *p->depths);
      else if (last >= 0)
        memcpy (p->depths + (size_t) y * w, p->depths + (size_t) last * w, w * sizeof *p->depths);
      last = p->known[y] ? y : last;
    }
  for (size_t i = 0; last < 0 && i < w * (size_t) p->layer.box.height; i++)
    p->depths[i] = 0;
}

static CeldStatus
add_layer (LayerDepth *p, const CeldLayers *layers, size_t layer, const CeldHost *host, CeldScene *scene)
{
  CeldRect   box = celd_layers_item (layers, layer)->box;
  size_t     n = (size_t) box.width * (size_t) box.height;
  CeldStatus status = CELD_NO_MEMORY;

  p->layer = *celd_layers_item (layers, layer);
  p->art   = celd_alloc (n, 4 * sizeof *p->art);
  p->depths  = celd_alloc (n, sizeof *p->depths);
  p->known = celd_alloc ((size_t) box.height, sizeof *p->known);
  if (p->art && p->depths && p->known)
    {
      celd_layers_paint (layers, layer, p->art);
      celd_parallel_for (host, (box.height + BAND_ROWS - 1) / BAND_ROWS, prepare_band, p);
      fill_rows (p);
      status = celd_scene_spans_of_picture (box, scene->width, p->art, p->depths, (uint32_t) layer, host,
                                            &scene->part[layer]);
    }
  celd_free (p->art);
  celd_free (p->depths);
  celd_free (p->known);
  return status;
}

CeldStatus
celd_scene_of_layers (const CeldLayers *layers, const CeldOwnership *ownership, const CeldPlane *depth,
                      const CeldHost *host, CeldScene **result)
{
  size_t     n = celd_layers_count (layers);
  LayerDepth part = { .own = ownership, .depth = depth };
  CeldScene *scene = NULL;
  CeldStatus status;

  if (layers->width != depth->width || layers->height != depth->height ||
      !CELD_SAME_SIZE (depth, &ownership->owner) || !CELD_SAME_SIZE (depth, &ownership->under) ||
      !CELD_SAME_SIZE (depth, &ownership->coverage))
    return CELD_BAD_SIZE;
  status = celd_scene_new (depth->width, depth->height, n, &scene);
  for (size_t k = 0; k < n && status == CELD_OK; k++)
    {
      CeldHostPart turn;
      CeldHost     short_run = celd_host_part (&turn, host, 0, 0);

      status = add_layer (&part, layers, k, &short_run, scene);
      if (status == CELD_OK)
        status = celd_progress (host, (double) (k + 1) / (double) n);
    }
  if (status == CELD_OK)
    {
      celd_depth_range (depth, &scene->least, &scene->most);
      status = celd_scene_sort (scene);
    }
  if (status != CELD_OK)
    celd_scene_free (scene);
  else
    *result = scene;
  return status;
}

CeldStatus
celd_scene_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth, const CeldColours *art,
                      CeldExpansion method, const CeldHost *host, CeldScene **scene)
{
  CeldLevelOwnership made;
  CeldLayers   *layers = NULL;
  CeldHostPart      part[3];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.3), second = celd_host_part (&part[1], host, 0.3, 0.9);
  CeldHost      third = celd_host_part (&part[2], host, 0.9, 1);
  CeldStatus    status = celd_level_ownership_new (ink, levels, NULL, NULL, method, &first, &made);

  if (status == CELD_OK)
    status = celd_level_layers_cut (&made, ink, art, CELD_STORE_FLOAT, true, &second, &layers);
  if (status == CELD_OK)
    status = celd_scene_of_layers (layers, &made.own, depth, &third, scene);
  celd_layers_free (layers);
  celd_level_ownership_clear (&made);
  return status;
}
