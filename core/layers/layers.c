/* Cutting a drawing into layers, one for each region: the region's part of the art with its own ink, antialiased.
 *
 * A pixel of one region is copied to its layer.  A pixel that two regions share goes to both: the front layer gets its
 * coverage as alpha, and the colours of both are unmixed (layer-unmixing.c) so that front over back gives the pixel
 * again.  In 8 bits the back colour is found for the rounded front colour, so that the composite is off by one step at
 * most.
 *
 * Hidden parts are added afterwards, only where a nearer opaque layer occludes them, so that the composite does not
 * change.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "layers/layers.h"
#include "ownership/ownership.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ the list of layers */

static int
compare_layers (const void *a, const void *b)
{
  const CeldLayer *one = a, *other = b;

  if (one->level != other->level)
    return one->level < other->level ? -1 : 1;
  return one->label < other->label ? -1 : one->label > other->label;
}

static void
extend_box (CeldRect *box, int x, int y)
{
  *box = celd_rect_union (*box, (CeldRect) { x, y, 1, 1 });
}

/* Is each label one of 1 .. n? */
static bool
labels_fit (const CeldOwnership *own, size_t n)
{
  for (int y = 0; y < own->owner.height; y++)
    for (int x = 0; x < own->owner.width; x++)
      if (CELD_AT (&own->owner, x, y) - 1 >= n || CELD_AT (&own->under, x, y) - 1 >= n)
        return false;
  return true;
}

/* Finds the labels that cover any pixel: there[l - 1]. */
static void
find_labels (const CeldOwnership *own, bool *there)
{
  for (int y = 0; y < own->owner.height; y++)
    for (int x = 0; x < own->owner.width; x++)
      there[CELD_AT (&own->owner, x, y) - 1] = there[CELD_AT (&own->under, x, y) - 1] = true;
}

/* Makes a layer of each label that covers any pixel, from back to front, in the order of the sheets if there are any;
 * of_label[l - 1] is the layer of label l. */
static CeldStatus
list_layers (const CeldOwnership *own, const uint32_t *level, size_t n, const CeldSheets *sheets, uint32_t *of_label,
             CeldLayers *layers)
{
  bool      *there = celd_alloc0 (n, sizeof *there);
  CeldStatus status = there ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    find_labels (own, there);
  for (size_t l = 0; l < n && status == CELD_OK; l++)
    {
      if (sheets && there[l] != (sheets->of_label[l] != CELD_NO_SHEET))
        status = CELD_BAD_VALUE;
      if (there[l])
        layers->item[layers->n++] = (CeldLayer) { .label = (uint32_t) l + 1, .level = level[l] };
    }
  celd_free (there);
  if (status != CELD_OK)
    return status;
  qsort (layers->item, layers->n, sizeof *layers->item, compare_layers);
  for (size_t k = 0; k < layers->n && sheets; k++)
    layers->item[k] = (CeldLayer) { .label = sheets->item[k].label, .level = level[sheets->item[k].label - 1] };
  for (size_t k = 0; k < layers->n; k++)
    of_label[layers->item[k].label - 1] = (uint32_t) k;
  return CELD_OK;
}

/* ------------------------------------------------------------------ pixels */

static bool
is_shared (const CeldOwnership *own, int x, int y)
{
  return CELD_AT (&own->owner, x, y) != CELD_AT (&own->under, x, y) && CELD_AT (&own->coverage, x, y) < 1;
}

/* Of equal levels either may be the owner; the later layer is in front in any case. */
static CeldBlend
make_blend (const CeldOwnership *own, const uint32_t *of_label, int x, int y)
{
  uint32_t owner = of_label[CELD_AT (&own->owner, x, y) - 1], under = of_label[CELD_AT (&own->under, x, y) - 1];
  float    coverage = CELD_AT (&own->coverage, x, y);

  coverage = coverage > 0 ? coverage : 0; /* NaN becomes 0 */
  return owner > under ? (CeldBlend) { .x = x, .y = y, .layer = { owner, under }, .coverage = coverage }
                       : (CeldBlend) { .x = x, .y = y, .layer = { under, owner }, .coverage = 1 - coverage };
}

static CeldStatus
place_pixels (const CeldOwnership *own, const uint32_t *of_label, CeldLayers *layers)
{
  size_t blends = 0;

  for (int y = 0; y < layers->height; y++)
    for (int x = 0; x < layers->width; x++)
      blends += is_shared (own, x, y);
  layers->blend = celd_alloc (blends, sizeof *layers->blend);
  if (!layers->blend)
    return CELD_NO_MEMORY;
  for (int y = 0; y < layers->height; y++)
    for (int x = 0; x < layers->width; x++)
      {
        uint32_t *place = &layers->place[(size_t) y * (size_t) layers->width + (size_t) x];

        if (is_shared (own, x, y))
          {
            *place = (uint32_t) (layers->n + layers->n_blends);
            layers->blend[layers->n_blends++] = make_blend (own, of_label, x, y);
          }
        else
          *place = of_label[CELD_AT (&own->owner, x, y) - 1];
      }
  return CELD_OK;
}

static void
copy_art (const CeldColours *art, CeldLayers *layers)
{
  float *to = layers->art;

  for (int y = 0; y < art->height; y++)
    for (int i = 0; i < 4 * art->width; i++)
      {
        float value = art->data[4 * (size_t) y * art->stride + (size_t) i];

        value = value > 0 ? value < 1 ? value : 1 : 0; /* NaN becomes 0 */
        *to++ = i % 4 < 3 ? celd_quantize_colour (layers, value) : celd_quantize_alpha (layers, value);
      }
}

/* Finds the box of the pixels of each layer that are not transparent. */
static void
find_boxes (CeldLayers *layers)
{
  const float *art = layers->art;

  for (int y = 0; y < layers->height; y++)
    for (int x = 0; x < layers->width; x++, art += 4)
      {
        size_t place = layers->place[(size_t) y * (size_t) layers->width + (size_t) x];

        if (place < layers->n && art[3] > 0)
          extend_box (&layers->item[place].box, x, y);
      }
  for (size_t i = 0; i < layers->n_blends; i++)
    for (int side = 0; side < 2; side++)
      {
        const CeldBlend *blend = &layers->blend[i];

        if (blend->colour[side][3] > 0)
          extend_box (&layers->item[blend->layer[side]].box, blend->x, blend->y);
      }
}

/* ------------------------------------------------------------------ hidden parts */

static CeldStatus
complete_layers (const CeldPlane *ink, const CeldOwnership *own, const CeldSheets *sheets, const CeldHost *host,
                 CeldLayers *layers)
{
  CeldStatus status = celd_layers_complete (layers, ink, own, sheets, host);

  for (size_t k = 0; k < layers->n && status == CELD_OK; k++)
    for (size_t r = 0; r < layers->hidden[k].n_runs; r++)
      {
        const CeldSheetRun *run = &layers->hidden[k].run[r];

        layers->item[k].box = celd_rect_union (layers->item[k].box, (CeldRect) { run->x, run->y, run->n, 1 });
      }
  return status;
}

/* ------------------------------------------------------------------ the object */

CeldStatus
celd_layers_new (int width, int height, size_t n, CeldLayers **made)
{
  size_t      pixels = (size_t) width * (size_t) height;
  CeldLayers *layers = celd_alloc0 (1, sizeof *layers);

  *made = layers;
  if (!layers)
    return CELD_NO_MEMORY;
  layers->width    = width;
  layers->height   = height;
  layers->item     = celd_alloc (n, sizeof *layers->item);
  layers->hidden   = celd_alloc0 (n, sizeof *layers->hidden);
  layers->margin   = celd_alloc0 (n, sizeof *layers->margin);
  layers->art      = celd_alloc (pixels, 4 * sizeof *layers->art);
  layers->place    = celd_alloc (pixels, sizeof *layers->place);
  return layers->item && layers->hidden && layers->margin && layers->art && layers->place
           ? CELD_OK : CELD_NO_MEMORY;
}

static void
clear_hidden (CeldHiddenPart *part)
{
  celd_free (part->run);
  celd_free (part->colour);
}

void
celd_layers_free (CeldLayers *layers)
{
  if (!layers)
    return;
  for (size_t k = 0; k < layers->n; k++)
    {
      clear_hidden (&layers->hidden[k]);
      clear_hidden (&layers->margin[k]);
    }
  celd_free (layers->hidden);
  celd_free (layers->margin);
  celd_free (layers->item);
  celd_free (layers->art);
  celd_free (layers->place);
  celd_free (layers->blend);
  celd_free (layers);
}

size_t
celd_layers_count (const CeldLayers *layers)
{
  return layers->n;
}

const CeldLayer *
celd_layers_item (const CeldLayers *layers, size_t layer)
{
  return &layers->item[layer];
}

/* ------------------------------------------------------------------ layers as pictures */

static float *
pixel_of (const CeldRect *box, float *rgba, int x, int y)
{
  return rgba + 4 * ((size_t) (y - box->y) * (size_t) box->width + (size_t) (x - box->x));
}

static void
paint_hidden (const CeldLayers *layers, const CeldHiddenPart *part, const CeldRect *box, float *rgba)
{
  for (size_t r = 0; r < part->n_runs; r++)
    for (int k = 0; k < part->run[r].n; k++)
      {
        float *to = pixel_of (box, rgba, part->run[r].x + k, part->run[r].y);

        celd_hidden_colour (part, part->run[r].first + (size_t) k, to);
        for (int c = 0; c < 4; c++)
          to[c] = c < 3 ? celd_quantize_colour (layers, to[c]) : celd_quantize_alpha (layers, to[c]);
      }
}

void
celd_layers_paint (const CeldLayers *layers, size_t layer, float *rgba)
{
  const CeldRect *box = &layers->item[layer].box;

  memset (rgba, 0, 4 * sizeof *rgba * (size_t) box->width * (size_t) box->height);
  for (int y = box->y; y < box->y + box->height; y++)
    for (int x = box->x; x < box->x + box->width; x++)
      {
        size_t       p = (size_t) y * (size_t) layers->width + (size_t) x, place = layers->place[p];
        const float *colour = place == layer ? layers->art + 4 * p : NULL;

        if (place >= layers->n)
          for (int side = 0; side < 2; side++)
            if (layers->blend[place - layers->n].layer[side] == layer)
              colour = layers->blend[place - layers->n].colour[side];
        if (colour && colour[3] > 0)
          memcpy (pixel_of (box, rgba, x, y), colour, 4 * sizeof *colour);
      }
  paint_hidden (layers, &layers->hidden[layer], box, rgba);
}

CeldStatus
celd_layers_cut (const CeldPlane *ink, const CeldOwnership *own, const uint32_t *level, size_t n,
                 const CeldColours *art, const CeldSheets *sheets, CeldStore store, const CeldHost *host,
                 CeldLayers **result)
{
  CeldLayers  *layers = NULL;
  uint32_t    *of_label;
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, sheets ? 0.3 : 1);
  CeldHost     second = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus   status;

  if (!CELD_SAME_SIZE (ink, &own->owner) || !CELD_SAME_SIZE (ink, &own->under) ||
      !CELD_SAME_SIZE (ink, &own->coverage) || !CELD_SAME_SIZE (ink, art) ||
      (sheets && (sheets->width != ink->width || sheets->height != ink->height)))
    return CELD_BAD_SIZE;
  if (!n)
    return CELD_NOTHING_TO_GO_BY;
  if ((unsigned) store > CELD_STORE_8_BIT_SRGB || (sheets && sheets->n_labels != n) || !labels_fit (own, n))
    return CELD_BAD_VALUE;
  of_label = celd_alloc (n, sizeof *of_label);
  status = of_label ? celd_layers_new (ink->width, ink->height, n, &layers) : CELD_NO_MEMORY;
  if (status != CELD_OK)
    goto done;
  layers->store = store;
  celd_quantizer_prepare (layers);
  copy_art (art, layers);
  if ((status = list_layers (own, level, n, sheets, of_label, layers)) == CELD_OK &&
      (status = place_pixels (own, of_label, layers)) == CELD_OK &&
      (status = celd_layers_unmix (layers, ink, &first)) == CELD_OK)
    find_boxes (layers);
  if (status == CELD_OK && sheets)
    status = complete_layers (ink, own, sheets, &second, layers);
done:
  celd_free (of_label);
  if (status != CELD_OK)
    celd_layers_free (layers);
  else
    *result = layers;
  return status;
}

CeldStatus
celd_level_layers_cut (const CeldLevelOwnership *made, const CeldPlane *ink, const CeldColours *art, CeldStore store,
                       const CeldSettings *settings, const CeldHost *host, CeldLayers **layers)
{
  CeldHostPart part[2];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldSheets  *sheets = NULL;
  CeldStatus   status = settings->complete ? celd_level_sheets (made, ink, settings, &first, &sheets) : CELD_OK;

  if (status == CELD_OK)
    status = celd_layers_cut (ink, &made->own, made->order, made->n, art, sheets, store, &second, layers);
  celd_sheets_free (sheets);
  return status;
}

CeldStatus
celd_layers_of_levels (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                       const CeldLabels *regions, const CeldLabels *corrections, const CeldColours *art,
                       CeldStore store, const CeldSettings *settings, const CeldHost *host, CeldLayers **layers)
{
  CeldLevelOwnership made;
  CeldHostPart       part[2];
  CeldHost           first = celd_host_part (&part[0], host, 0, 0.6), second = celd_host_part (&part[1], host, 0.6, 1);
  CeldStatus         status = celd_settings_check (settings);

  if (status != CELD_OK)
    return status;
  status = celd_level_ownership_new (ink, colours, levels, regions, corrections, settings->expansion, &first, &made);
  if (status == CELD_OK)
    status = celd_level_layers_cut (&made, ink, art, store, settings, &second, layers);
  celd_level_ownership_clear (&made);
  return status;
}
