/* The texture of a model: the pictures of all parts side by side, on shelves, the tallest first.
 *
 * Round each picture and below its transparent pixels its colours go on, so that no seam shows where a viewer blends
 * neighbouring pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/parts.h"

#include <math.h>
#include <stdlib.h>

#define SPARE_WIDTH 1.1 /* of the atlas, beyond a square of the pictures' area; chosen */

typedef struct { size_t part; int width, height; } Tile;

/* The box of a part's layer with the margin round it. */
static Tile
tile_of (const CeldParts *parts, size_t k)
{
  const CeldRect *box = &parts->item[k].box;
  int             more = 2 * CELD_ATLAS_MARGIN - 2; /* the box has a margin of one pixel already */

  return (Tile) { k, box->width + more, box->height + more };
}

static int
compare_tiles (const void *first, const void *second)
{
  const Tile *a = first, *b = second;

  if (a->height != b->height)
    return a->height > b->height ? -1 : 1;
  return (a->part > b->part) - (a->part < b->part);
}

CeldStatus
celd_atlas_pack (const CeldParts *parts, CeldAtlasPlace *place)
{
  Tile  *tile = celd_alloc (parts->n, sizeof *tile);
  double area = 0, widest = 0, width;
  int    x = 0, y = 0, shelf = 0;

  if (!tile)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < parts->n; k++)
    {
      tile[k] = tile_of (parts, k);
      area += (double) tile[k].width * tile[k].height;
      widest = fmax (widest, tile[k].width);
    }
  width = fmax (widest, ceil (SPARE_WIDTH * sqrt (area)));
  qsort (tile, parts->n, sizeof *tile, compare_tiles);
  for (size_t i = 0; i < parts->n; i++)
    {
      if (i == 0 || x + tile[i].width > width)
        {
          y += shelf;
          x     = 0;
          shelf = tile[i].height;
        }
      place[tile[i].part] = (CeldAtlasPlace) { .x = x + CELD_ATLAS_MARGIN - 1, .y = y + CELD_ATLAS_MARGIN - 1 };
      x += tile[i].width;
    }
  for (size_t k = 0; k < parts->n; k++)
    {
      place[k].width  = width;
      place[k].height = y + shelf;
    }
  celd_free (tile);
  return CELD_OK;
}

/* The layer of a part's label, or NULL. */
static const CeldLayer *
layer_of (const CeldLayers *layers, uint32_t label, size_t *layer)
{
  for (*layer = 0; *layer < layers->n; (*layer)++)
    if (layers->item[*layer].label == label)
      return &layers->item[*layer];
  return NULL;
}

/* Does the layer of part k have a colour at pixel (x,y) of the part's box?  Art may be transparent where it is seen. */
static bool
has_colour (const CeldParts *parts, size_t k, int x, int y, float alpha)
{
  const CeldPart *part = &parts->item[k];

  if (x < 1 || y < 1 || x >= part->box.width - 1 || y >= part->box.height - 1)
    return false;
  return part->page || (celd_part_has (part, x, y) &&
                        (alpha > 0 || celd_part_seen (parts, part->box.x + x, part->box.y + y) == k));
}

/* Composites what is inside part k on white: of the layer's alpha, without the share that the outline leaves open.
 * All else becomes transparent. */
static void
fill_inside (const CeldParts *parts, size_t k, CeldColours *tile)
{
  const CeldPart *part = &parts->item[k];

  for (int y = 0; y < tile->height; y++)
    for (int x = 0; x < tile->width; x++)
      {
        float *rgba = CELD_RGBA (tile, x, y);
        int    u = x - CELD_ATLAS_MARGIN + 1, v = y - CELD_ATLAS_MARGIN + 1;
        bool   inside = has_colour (parts, k, u, v, rgba[3]);
        float  share = inside ? fminf (part->page ? rgba[3] : rgba[3] / part->coverage[celd_part_at (part, u, v)], 1)
                              : 0;

        for (int c = 0; c < 3; c++)
          rgba[c] = rgba[c] * share + 1 - share;
        rgba[3] = inside;
      }
}

/* Paints the layer of part k into its tile, and extends its colours. */
static CeldStatus
paint_tile (const CeldLayers *layers, const CeldParts *parts, size_t k, const CeldHost *host, CeldColours *tile)
{
  static const float white[3] = { 1, 1, 1 };
  size_t             found;
  const CeldLayer   *layer = layer_of (layers, parts->sheets->item[k].label, &found);
  CeldRect           box = layer ? layer->box : (CeldRect) { .width = 0 };
  int                x = box.x - parts->item[k].box.x + CELD_ATLAS_MARGIN - 1;
  int                y = box.y - parts->item[k].box.y + CELD_ATLAS_MARGIN - 1;
  size_t             row = 4 * (size_t) box.width;
  float             *rgba = NULL;
  CeldStatus         status;

  if (box.width)
    {
      rgba = celd_alloc (row * (size_t) box.height, sizeof *rgba);
      if (!rgba)
        return CELD_NO_MEMORY;
      celd_layers_paint (layers, found, rgba);
      for (int v = 0; v < box.height; v++)
        memcpy (CELD_RGBA (tile, x, y + v), rgba + (size_t) v * row, row * sizeof *rgba);
    }
  fill_inside (parts, k, tile);
  status = celd_pad_colours (2 * CELD_ATLAS_MARGIN, white, host, tile);
  for (int v = 0; v < tile->height; v++)
    for (int u = 0; u < tile->width; u++)
      CELD_RGBA (tile, u, v)[3] = 1;
  celd_free (rgba);
  return status;
}

CeldStatus
celd_atlas_paint (const CeldParts *parts, const CeldAtlasPlace *place, const CeldLayers *layers, const CeldHost *host,
                  CeldColours *atlas)
{
  size_t     pixels;
  CeldStatus status = CELD_OK;

  atlas->width  = (int) place[0].width;
  atlas->height = (int) place[0].height;
  atlas->stride = (size_t) atlas->width;
  pixels        = atlas->stride * (size_t) atlas->height;
  atlas->data   = celd_alloc0 (pixels, 4 * sizeof *atlas->data);
  if (!atlas->data)
    return CELD_NO_MEMORY;
  for (size_t p = 0; p < pixels; p++)
    atlas->data[4 * p + 3] = 1;
  for (size_t k = 0; k < parts->n && status == CELD_OK; k++)
    {
      CeldHostPart share;
      CeldHost     turn = celd_host_part (&share, host, (double) k / (double) parts->n, (double) k / (double) parts->n);
      Tile         size = tile_of (parts, k);
      int          x = (int) place[k].x - (CELD_ATLAS_MARGIN - 1), y = (int) place[k].y - (CELD_ATLAS_MARGIN - 1);
      CeldColours  tile = { size.width, size.height, atlas->stride, CELD_RGBA (atlas, x, y) };

      for (int v = 0; v < size.height; v++)
        memset (CELD_RGBA (&tile, 0, v), 0, 4 * (size_t) size.width * sizeof *tile.data);
      status = celd_progress (&turn, 0);
      if (status == CELD_OK)
        status = paint_tile (layers, parts, k, &turn, &tile);
    }
  return status;
}
