/* A scene of layers: each moves by its own depth as one surface, hidden parts with it.
 *
 * Layers are composited in their order.  Their margins come before them, right after the farthest layer, the page: they
 * are seen only where no layer is, between parts that a view moves apart.  Beside the visible page there is no margin,
 * because it is the page that comes into view there.
 *
 * The scene keeps where the pixels of each layer are, and depth where it cannot be taken from the picture: where the
 * layer is occluded it goes on smoothly.  Colours and all other depth are read from the layers and from the depth
 * picture for each row of a view, because copies would take 20 bytes for each pixel, visible or hidden.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"
#include "stereo/scene.h"

#define PAGE_REACH  0.025 /* of the width: no margin so close to the visible page; half of what a view of a disparity of
                          * 0.05 moves; chosen */

/* ------------------------------------------------------------------ pixels of a layer */

typedef struct
{
  float colour[4];             /* straight alpha; 0: the layer is transparent there */
  bool  last, whole;           /* is it the last of a run of hidden pixels; is the pixel the layer's alone? */
} LayerPixel;

static LayerPixel
visible_pixel (const CeldLayers *layers, uint32_t layer, size_t p)
{
  size_t           place = layers->place[p];
  LayerPixel       pixel = { .whole = place == layer };
  const CeldBlend *blend = place < layers->n ? NULL : &layers->blend[place - layers->n];

  if (place == layer)
    memcpy (pixel.colour, layers->art + 4 * p, sizeof pixel.colour);
  for (int side = 0; side < 2 && blend; side++)
    if (blend->layer[side] == layer)
      memcpy (pixel.colour, blend->colour[side], sizeof pixel.colour);
  return pixel;
}

/* The pixel (x,y) of a layer, whose next run of hidden pixels in reading order is `run`. */
static inline LayerPixel
layer_pixel (const CeldLayers *layers, uint32_t layer, size_t run, int x, int y)
{
  const CeldHiddenPart *part = &layers->hidden[layer];
  const CeldSheetRun   *hidden = run < part->n_runs ? &part->run[run] : NULL;
  LayerPixel            pixel;

  if (!hidden || hidden->y != y || hidden->x > x)
    return visible_pixel (layers, layer, (size_t) y * (size_t) layers->width + (size_t) x);
  pixel = (LayerPixel) { .last = x + 1 == hidden->x + hidden->n };
  celd_hidden_colour (part, hidden->first + (size_t) (x - hidden->x), pixel.colour);
  return pixel;
}

static void
premultiply (float colour[4])
{
  for (int c = 0; c < 3 && colour[3] < 1; c++)
    colour[c] *= colour[3];
}

/* Neighbours are mostly equal. */
static void
paint_hidden (const CeldHiddenPart *part, size_t first, int n, float *colour)
{
  const uint16_t *code = part->colour + 4 * first;

  for (int i = 0; i < n; i++, code += 4, colour += 4)
    if (i && !memcmp (code, code - 4, 4 * sizeof *code))
      memcpy (colour, colour - 4, 4 * sizeof *colour);
    else
      {
        celd_hidden_colour (part, first + (size_t) i, colour);
        premultiply (colour);
      }
}

static void
paint_visible (const CeldLayers *layers, uint32_t layer, size_t p, int n, float *colour)
{
  for (int i = 0; i < n; i++, p++, colour += 4)
    {
      if (layers->place[p] == layer)
        memcpy (colour, layers->art + 4 * p, 4 * sizeof *colour);
      else
        memcpy (colour, visible_pixel (layers, layer, p).colour, 4 * sizeof *colour);
      premultiply (colour);
    }
}

/* Paints the n pixels from (x,y) on of a layer, whose next run of hidden pixels is `run`. */
static void
paint_layer (const CeldLayers *layers, uint32_t layer, size_t run, int x, int y, int n, float *colour)
{
  const CeldHiddenPart *part = &layers->hidden[layer];
  int                   end = x + n;

  while (x < end)
    {
      const CeldSheetRun *hidden = run < part->n_runs && part->run[run].y == y ? &part->run[run] : NULL;
      bool                here = hidden && hidden->x <= x;
      int                 stop = here ? hidden->x + hidden->n : hidden ? hidden->x : end;

      stop = stop < end ? stop : end;
      if (here)
        paint_hidden (part, hidden->first + (size_t) (x - hidden->x), stop - x, colour);
      else
        paint_visible (layers, layer, (size_t) y * (size_t) layers->width + (size_t) x, stop - x, colour);
      run    += here;
      colour += 4 * (stop - x);
      x = stop;
    }
}

static void
copy_depths (const CeldScene *scene, const CeldSceneSpan *span, uint32_t layer, float *depths)
{
  const CeldLayerDepth *extended = &scene->extended[span->group];
  bool                  margin = celd_scene_is_margin (scene, span->group);
  size_t                at = span->extended;

  for (int i = 0; i < span->n; i++)
    if (!extended->value)
      depths[i] = extended->flat;
    else if (!margin && celd_scene_is_whole (scene->layers, layer, span->x + i, span->y))
      depths[i] = celd_scene_depth (CELD_AT (&scene->depth, span->x + i, span->y));
    else
      depths[i] = extended->value[at++];
}

void
celd_scene_paint_layer (const CeldScene *scene, const CeldSceneSpan *span, float *colour, float *depths)
{
  uint32_t layer = celd_scene_layer_of_group (scene, span->group);

  if (celd_scene_is_margin (scene, span->group))
    paint_hidden (&scene->layers->margin[layer], span->hidden, span->n, colour);
  else
    paint_layer (scene->layers, layer, span->hidden, span->x, span->y, span->n, colour);
  copy_depths (scene, span, layer, depths);
}

/* ------------------------------------------------------------------ spans */

/* Adds the spans of a layer, and counts its pixels that are not its alone. */
static CeldStatus
add_spans (CeldScene *scene, uint32_t layer, size_t *extended)
{
  const CeldLayers *layers = scene->layers;
  CeldRect          box = layers->item[layer].box;
  uint32_t          group = celd_scene_group_of_layer (scene, layer);
  CeldSceneSpans   *to = &scene->part[group];
  size_t            run = 0;
  CeldStatus        status = CELD_OK;

  for (int y = box.y; y < box.y + box.height && status == CELD_OK; y++)
    for (int x = box.x, n = 0; x < box.x + box.width && status == CELD_OK; x += n ? n : 1)
      {
        CeldSceneSpan span = { .x = x, .y = y, .group = group, .hidden = run, .extended = *extended };

        for (n = 0; x + n < box.x + box.width; n++)
          {
            LayerPixel pixel = layer_pixel (layers, layer, run, x + n, y);

            run += pixel.last;
            if (!(pixel.colour[3] > 0))
              break;
            *extended += !pixel.whole;
          }
        span.n = n;
        if (n)
          status = celd_append (to->span, to->n, to->capacity, span);
      }
  return status;
}

/* Marks pixels close to the visible page in their row, from left to right and back. */
static void
mark_beside_page (const CeldLayers *layers, uint8_t *beside)
{
  int reach = (int) (PAGE_REACH * layers->width);

  for (int y = 0; y < layers->height; y++)
    {
      const uint32_t *place = layers->place + (size_t) y * (size_t) layers->width;
      uint8_t        *row = beside + (size_t) y * (size_t) layers->width;
      int             left = -reach - 1, right = layers->width + reach;

      for (int x = 0; x < layers->width; x++)
        {
          left   = place[x] ? left : x;
          row[x] = x - left <= reach;
        }
      for (int x = layers->width - 1; x >= 0; x--)
        {
          right   = place[x] ? right : x;
          row[x] |= right - x <= reach;
        }
    }
}

/* Adds the runs of a layer's margin that are not beside the page, and counts their pixels. */
static CeldStatus
add_margin (CeldScene *scene, uint32_t layer, const uint8_t *beside_page, size_t *pixels)
{
  const CeldHiddenPart *margin = &scene->layers->margin[layer];
  CeldSceneSpans       *to = &scene->part[layer + 1];
  CeldStatus            status = CELD_OK;

  for (size_t r = 0; r < margin->n_runs && status == CELD_OK; r++)
    {
      CeldSheetRun   run = margin->run[r];
      const uint8_t *beside = beside_page + (size_t) run.y * (size_t) scene->width + (size_t) run.x;

      for (int first = 0, end; first < run.n && status == CELD_OK; first = end + 1)
        {
          for (end = first; end < run.n && !beside[end];)
            end++;
          if (end == first)
            continue;
          status = celd_append (to->span, to->n, to->capacity,
                                (CeldSceneSpan) { .x = run.x + first, .y = run.y, .n = end - first, .group = layer + 1,
                                                  .hidden = run.first + (size_t) first, .extended = *pixels });
          *pixels += (size_t) (end - first);
        }
    }
  return status;
}

/* ------------------------------------------------------------------ */

static CeldStatus
add_layer (CeldScene *scene, const CeldOwnership *own, uint32_t layer, const uint8_t *beside_page)
{
  size_t     extended[2] = { 0, 0 };
  CeldStatus status = add_spans (scene, layer, &extended[0]);

  if (status == CELD_OK)
    status = add_margin (scene, layer, beside_page, &extended[1]);
  return status == CELD_OK ? celd_scene_layer_depth (scene, own, layer, extended) : status;
}

CeldStatus
celd_scene_of_layers (const CeldLayers *layers, const CeldOwnership *ownership, const CeldPlane *depth,
                      const CeldHost *host, CeldScene **result)
{
  CeldScene *scene = NULL;
  uint8_t   *beside_page;
  CeldStatus status;

  if (layers->width != depth->width || layers->height != depth->height ||
      !CELD_SAME_SIZE (depth, &ownership->owner) || !CELD_SAME_SIZE (depth, &ownership->under) ||
      !CELD_SAME_SIZE (depth, &ownership->coverage))
    return CELD_BAD_SIZE;
  status      = celd_scene_new (depth->width, depth->height, 2 * layers->n, &scene);
  beside_page = celd_alloc ((size_t) depth->width * (size_t) depth->height, 1);
  if (status == CELD_OK)
    {
      scene->layers   = layers;
      scene->depth    = *depth;
      scene->extended = celd_alloc0 (2 * layers->n, sizeof *scene->extended);
      status = scene->extended && beside_page ? CELD_OK : CELD_NO_MEMORY;
      celd_depth_range (depth, &scene->least, &scene->most);
    }
  if (status == CELD_OK)
    mark_beside_page (layers, beside_page);
  for (size_t k = 0; k < layers->n && status == CELD_OK; k++)
    if ((status = add_layer (scene, ownership, (uint32_t) k, beside_page)) == CELD_OK)
      status = celd_progress (host, (double) (k + 1) / (double) layers->n);
  if (status == CELD_OK)
    status = celd_scene_sort (scene);
  celd_free (beside_page);
  if (status != CELD_OK)
    celd_scene_free (scene);
  else
    *result = scene;
  return status;
}

CeldStatus
celd_scene_of_levels (const CeldPlane *ink, const CeldPlane *levels, const CeldPlane *depth, const CeldColours *art,
                      const CeldSettings *settings, const CeldHost *host, CeldScene **scene)
{
  CeldLevelOwnership made;
  CeldSettings       whole = *settings;
  CeldLayers        *layers = NULL;
  CeldHostPart       part[3];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.3);
  CeldHost           second = celd_host_part (&part[1], host, 0.3, 0.9), third = celd_host_part (&part[2], host, 0.9, 1);
  CeldStatus         status = celd_settings_check (settings);

  if (status != CELD_OK)
    return status;
  whole.complete = true;
  status = celd_level_ownership_new (ink, NULL, levels, NULL, NULL, settings->expansion, &first, &made);
  if (status == CELD_OK)
    status = celd_level_layers_cut (&made, ink, art, CELD_STORE_FLOAT, &whole, &second, &layers);
  if (status == CELD_OK)
    status = celd_scene_of_layers (layers, &made.own, depth, &third, scene);
  celd_level_ownership_clear (&made);
  if (status == CELD_OK)
    (*scene)->own_layers = layers;
  else
    celd_layers_free (layers);
  return status;
}
