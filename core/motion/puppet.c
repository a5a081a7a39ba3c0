/* A puppet at rest: copies of completed layers, their lattice, and what lies still behind them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/page-strokes.h"
#include "motion/puppet.h"

/* ------------------------------------------------------------------ pictures of layers */

/* Extends a box to the left and up to the grid of cells. */
static CeldRect
box_on_grid (CeldRect box, int side)
{
  int dx = box.x % side, dy = box.y % side;

  return (CeldRect) { box.x - dx, box.y - dy, box.width + dx, box.height + dy };
}

/* The box of a layer, or all of the drawing if it is empty. */
static CeldRect
box_of (const CeldLayers *layers, size_t k)
{
  CeldRect box = layers->item[k].box;

  return box.width ? box : (CeldRect) { 0, 0, layers->width, layers->height };
}

/* Copies one layer, whose box is known, into pictures of their own, premultiplied. */
static CeldStatus
copy_layer (const CeldLayers *layers, size_t k, bool moves, int side, CeldPuppetLayer *to)
{
  CeldRect box = box_of (layers, k);
  float   *rgba;
  size_t   pixels;

  *to    = (CeldPuppetLayer) { .box = box_on_grid (to->box, side), .label = layers->item[k].label,
                              .level = layers->item[k].level };
  pixels = celd_puppet_stride (to) * ((size_t) to->box.height + 2 * CELD_PUPPET_PAD);
  rgba     = celd_alloc0 ((size_t) box.width * (size_t) box.height, 4 * sizeof *rgba); /* for an empty layer */
  to->rgba = celd_alloc0 (pixels, 4 * sizeof *to->rgba);
  to->cell = moves ? celd_alloc0 (pixels, sizeof *to->cell) : NULL;
  if (!rgba || !to->rgba || (moves && !to->cell))
    {
      celd_free (rgba);
      return CELD_NO_MEMORY;
    }
  celd_layers_paint (layers, k, rgba);
  for (int y = 0; y < box.height; y++)
    for (int x = 0; x < box.width; x++)
      {
        const float *from = rgba + 4 * ((size_t) y * (size_t) box.width + (size_t) x);
        float       *pixel = to->rgba + 4 * celd_puppet_pixel (to, box.x + x, box.y + y);

        for (int c = 0; c < 4; c++)
          pixel[c] = c < 3 ? from[c] * from[3] : from[3];
      }
  celd_free (rgba);
  return CELD_OK;
}

static void
add_to_box (CeldPuppet *puppet, uint32_t k, int x, int y)
{
  puppet->layer[k].box = celd_rect_union (puppet->layer[k].box, (CeldRect) { x, y, 1, 1 });
}

/* Notes which layer is in front of each pixel, and the boxes of layers, with the pixels that they are in front of, also
 * where art is transparent; returns the layer of the background, or their number. */
static uint32_t
look_at (const CeldLayers *layers, uint32_t background, CeldPuppet *puppet)
{
  uint32_t page = (uint32_t) layers->n;

  for (size_t k = 0; k < layers->n; k++)
    {
      puppet->layer[k].box = box_of (layers, k);
      if (layers->item[k].label == background)
        page = (uint32_t) k;
    }
  for (size_t p = 0; p < (size_t) layers->width * (size_t) layers->height; p++)
    {
      int x = (int) (p % (size_t) layers->width), y = (int) (p / (size_t) layers->width);

      puppet->front[p] = layers->place[p] < layers->n ? layers->place[p]
                                                      : layers->blend[layers->place[p] - layers->n].layer[0];
      add_to_box (puppet, puppet->front[p], x, y);
    }
  return page;
}

/* Puts strokes in front that go with parts, and into the boxes of their layers. */
static void
take_strokes (const CeldPageStrokes *strokes, CeldPuppet *puppet)
{
  for (int y = 0; y < puppet->height; y++)
    for (int x = 0; x < puppet->width; x++)
      {
        size_t   p = (size_t) y * (size_t) puppet->width + (size_t) x;
        uint32_t to = celd_page_strokes_at (strokes, p);

        if (to)
          {
            add_to_box (puppet, to - 1, x, y);
            puppet->front[p] = to - 1;
          }
      }
}

static void
write_premultiplied (const float straight[4], CeldPuppetLayer *layer, int x, int y)
{
  float *to = layer->rgba + 4 * celd_puppet_pixel (layer, x, y);

  for (int c = 0; c < 4; c++)
    to[c] = c < 3 ? straight[c] * straight[3] : straight[3];
}

/* Paints these strokes on their layers, and paper where they were on the page. */
static void
paint_strokes (const CeldPageStrokes *strokes, uint32_t page, CeldPuppet *puppet)
{
  for (int y = 0; y < puppet->height; y++)
    for (int x = 0; x < puppet->width; x++)
      {
        size_t   p = (size_t) y * (size_t) puppet->width + (size_t) x;
        uint32_t to = celd_page_strokes_at (strokes, p);

        if (to)
          {
            write_premultiplied (strokes->colour + 4 * p, &puppet->layer[to - 1], x, y);
            write_premultiplied (strokes->paper + 4 * p, &puppet->layer[page], x, y);
          }
      }
}

static CeldStatus
copy_layers (const CeldLayers *layers, const CeldPlane *ink, uint32_t background, const CeldSettings *settings,
             const CeldHost *host, CeldPuppet *puppet)
{
  int             side = celd_cell_side (layers->width, layers->height, settings);
  uint32_t        page = look_at (layers, background, puppet);
  CeldPageStrokes strokes = { 0 };
  CeldStatus      status = CELD_OK;

  puppet->lattice.side = side;
  if (page < layers->n)
    status = celd_page_strokes_find (layers, page, ink, false, NULL, &strokes);
  if (status == CELD_OK)
    take_strokes (&strokes, puppet);
  for (; puppet->n < layers->n && status == CELD_OK; puppet->n++)
    {
      size_t k = puppet->n;

      status = copy_layer (layers, k, layers->item[k].label != background, side, &puppet->layer[k]);
      if (status == CELD_OK)
        status = celd_progress (host, 0.5 * (double) k / (double) layers->n);
    }
  if (status == CELD_OK)
    {
      paint_strokes (&strokes, page, puppet);
      status = celd_puppet_continue_lines (puppet, ink);
    }
  celd_page_strokes_clear (&strokes);
  return status;
}

/* ------------------------------------------------------------------ what lies still */

static void
draw_base (CeldPuppet *puppet)
{
  CeldColours      base = { puppet->width, puppet->height, (size_t) puppet->width, puppet->base };
  CeldPuppetCanvas canvas = { puppet, &base, NULL, 0, puppet->height };

  while (puppet->n_base < puppet->n && !puppet->layer[puppet->n_base].cell)
    celd_puppet_draw_rest (&canvas, &puppet->layer[puppet->n_base++]);
}

/* ------------------------------------------------------------------ the puppet */

CeldStatus
celd_puppet_new (const CeldLayers *layers, const CeldPlane *ink, const CeldPlane *borders, uint32_t background,
                 const CeldCracks *cracks, const CeldSettings *settings, const CeldHost *host, CeldPuppet **result)
{
  size_t       pixels = (size_t) layers->width * (size_t) layers->height;
  CeldSettings own = *settings;
  CeldHostPart part;
  CeldHost     quiet = celd_host_part (&part, host, 0.5, 0.5);
  CeldPuppet  *puppet;
  CeldStatus   status;

  if (!CELD_SAME_SIZE (ink, borders ? borders : ink) || ink->width != layers->width || ink->height != layers->height)
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;
  puppet = celd_alloc0 (1, sizeof *puppet);
  if (!puppet)
    return CELD_NO_MEMORY;
  puppet->width  = puppet->lattice.width = layers->width;
  puppet->height = puppet->lattice.height = layers->height;
  puppet->layer  = celd_alloc0 (layers->n, sizeof *puppet->layer);
  puppet->front  = celd_alloc (pixels, sizeof *puppet->front);
  puppet->base   = celd_alloc0 (pixels, 4 * sizeof *puppet->base);
  puppet->drawn  = celd_alloc0 (pixels, 2 * sizeof *puppet->drawn);
  status = puppet->layer && puppet->front && puppet->base && puppet->drawn
             ? copy_layers (layers, ink, background, settings, host, puppet) : CELD_NO_MEMORY;
  own.cell_size = puppet->lattice.side;
  if (status == CELD_OK)
    status = celd_puppet_measure_lines (puppet, ink, &quiet);
  if (status == CELD_OK)
    status = celd_puppet_embed (puppet, ink, borders, cracks, &own, &quiet);
  if (status == CELD_OK)
    status = celd_puppet_tie (puppet);
  if (status == CELD_OK)
    {
      puppet->depth = celd_alloc0 (puppet->lattice.n_cells, sizeof *puppet->depth);
      if (puppet->depth)
        draw_base (puppet);
      else
        status = CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    *result = puppet;
  else
    celd_puppet_free (puppet);
  return status;
}

void
celd_puppet_free (CeldPuppet *puppet)
{
  if (!puppet)
    return;
  for (size_t k = 0; k < puppet->n; k++)
    {
      celd_free (puppet->layer[k].rgba);
      celd_free (puppet->layer[k].cell);
    }
  celd_free (puppet->layer);
  celd_free (puppet->front);
  celd_free (puppet->base);
  celd_free (puppet->drawn);
  celd_free (puppet->line);
  celd_free (puppet->tie);
  celd_free (puppet->piece);
  celd_free (puppet->bleeds);
  celd_free (puppet->value);
  celd_free (puppet->depth);
  celd_free (puppet->lattice.corner);
  celd_free (puppet->lattice.piece);
  celd_free (puppet->lattice.rest);
  celd_free (puppet->lattice.place);
  celd_free (puppet->lattice.seam);
  celd_free (puppet);
}
