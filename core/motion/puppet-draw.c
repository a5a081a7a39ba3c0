/* A puppet in its pose: layers at rest and squares of others, from back to front.
 *
 * Squares are drawn one by one in the order of their level, which handles have changed, so that a layer can lie behind
 * another one at one end and in front of it at the other.  Of equal levels what was moved forward is in front, else the
 * nearer layer.  Bands of rows are independent of each other.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#include <stdlib.h>

#define BAND_ROWS   64          /* rows of a job; chosen */
#define WHOLE_LAYER UINT32_MAX  /* in place of a cell: the layer is at rest */
#define STILL       (1.f / 512) /* pixels: half of what sampling rounds to */

typedef struct { float level, depth; uint32_t layer, cell; } Item;

typedef struct
{
  CeldPuppet  *puppet;
  Item        *item;           /* from back to front */
  size_t       n;
  bool         on_base;        /* is the base below? */
  uint32_t     mark;           /* of layer 0; others count on from it */
  CeldColours *picture;
  CeldPlane   *levels;
} Drawing;

/* ------------------------------------------------------------------ the order */

static int
compare_items (const void *a, const void *b)
{
  const Item *p = a, *q = b;

  if (p->level != q->level)
    return p->level < q->level ? -1 : 1;
  if (p->depth != q->depth)
    return p->depth < q->depth ? -1 : 1;
  if (p->layer != q->layer)
    return p->layer < q->layer ? -1 : 1;
  return p->cell < q->cell ? -1 : p->cell > q->cell;
}

/* Whether no pixel of a layer moves. */
static bool
is_still (const CeldPuppet *puppet, const CeldPuppetLayer *layer)
{
  const CeldLattice *lattice = &puppet->lattice;

  for (size_t c = layer->first; layer->cell && c < layer->first + layer->n_cells; c++)
    for (size_t i = 0; i < 8; i++)
      {
        size_t v = 2 * (size_t) lattice->corner[4 * c + i / 2] + i % 2;

        if (fabsf (lattice->place[v] - lattice->rest[v]) >= STILL || puppet->depth[c] != 0)
          return false;
      }
  return true;
}

/* Lists what is to be drawn of the layers from `first` on to `end` - 1. */
static CeldStatus
list_items (Drawing *d, size_t first, size_t end)
{
  const CeldPuppet *puppet = d->puppet;

  d->item = celd_alloc (puppet->lattice.n_cells + puppet->n, sizeof *d->item);
  if (!d->item)
    return CELD_NO_MEMORY;
  for (size_t k = first; k < end; k++)
    {
      const CeldPuppetLayer *layer = &puppet->layer[k];
      bool                   still = is_still (puppet, layer);

      if (still) /* nothing is behind the base */
        d->item[d->n++] = (Item) { k < puppet->n_base ? -INFINITY : (float) layer->level, 0, (uint32_t) k,
                                   WHOLE_LAYER };
      for (size_t c = layer->first; !still && c < layer->first + layer->n_cells; c++)
        d->item[d->n++] = (Item) { (float) layer->level + puppet->depth[c], puppet->depth[c], (uint32_t) k,
                                   (uint32_t) c };
    }
  qsort (d->item, d->n, sizeof *d->item, compare_items);
  return CELD_OK;
}

/* ------------------------------------------------------------------ bands of rows */

static void
begin_rows (const Drawing *d, int top, int bottom)
{
  size_t w = (size_t) d->puppet->width;

  for (int y = top; y < bottom; y++)
    {
      float *row = CELD_RGBA (d->picture, 0, y);

      if (d->on_base)
        memcpy (row, d->puppet->base + 4 * (size_t) y * w, 4 * w * sizeof *row);
      else
        memset (row, 0, 4 * w * sizeof *row);
      if (d->levels)
        memset (&CELD_AT (d->levels, 0, y), 0, w * sizeof *row);
    }
}

/* The level of the picture that a puppet was made of; what was moved beyond its levels goes on in their last step. */
static float
level_value (const CeldPuppet *puppet, float level)
{
  const float *value = puppet->value;
  size_t       last = puppet->n_values - 1;
  float        first_step = last ? value[1] - value[0] : 1, last_step = last ? value[last] - value[last - 1] : 1;

  if (level < 0)
    return value[0] + level * first_step;
  return level > (float) last ? value[last] + (level - (float) last) * last_step : value[(size_t) level];
}

/* Makes alpha straight, and levels those of the picture that they come from. */
static void
finish_rows (const Drawing *d, int top, int bottom)
{
  for (int y = top; y < bottom && d->levels && d->puppet->value; y++)
    for (int x = 0; x < d->levels->width; x++)
      CELD_AT (d->levels, x, y) = level_value (d->puppet, CELD_AT (d->levels, x, y));
  for (int y = top; y < bottom; y++)
    for (int x = 0; x < d->picture->width; x++)
      {
        float *pixel = CELD_RGBA (d->picture, x, y), alpha = pixel[3];

        for (int c = 0; c < 3 && alpha > 0 && alpha < 1; c++)
          pixel[c] = fminf (pixel[c] / alpha, 1);
      }
}

static void
draw_band (void *data, int band)
{
  const Drawing   *d = data;
  int              top = band * BAND_ROWS, end = top + BAND_ROWS, height = d->puppet->height;
  CeldPuppetCanvas canvas = { d->puppet, d->picture, d->levels, top, end < height ? end : height };

  begin_rows (d, top, canvas.bottom);
  for (size_t i = 0, next; i < d->n; i = next)
    {
      const Item            *item = &d->item[i];
      const CeldPuppetLayer *layer = &d->puppet->layer[item->layer];

      if (item->cell == WHOLE_LAYER)
        celd_puppet_draw_rest (&canvas, layer);
      for (next = i + 1; next < d->n && d->item[next].layer == item->layer && d->item[next].level == item->level;)
        next++;
      for (int beside = 0; beside < 2 && item->cell != WHOLE_LAYER; beside++)
        for (size_t k = i; k < next; k++)
          celd_puppet_draw_cell (&canvas, layer, d->item[k].cell, item->level, d->mark + item->layer, beside);
    }
  finish_rows (d, top, canvas.bottom);
}

/* Draws the layers from `first` on to `end` - 1. */
static CeldStatus
draw_layers (Drawing *d, size_t first, size_t end, const CeldHost *host)
{
  CeldPuppet *puppet = d->puppet;
  size_t      pixels = (size_t) puppet->width * (size_t) puppet->height;
  CeldStatus  status;

  if (!d->picture->data || d->picture->width != puppet->width || d->picture->height != puppet->height ||
      (d->levels && !CELD_SAME_SIZE (d->levels, d->picture)))
    return CELD_BAD_SIZE;
  if (puppet->mark > UINT32_MAX - 1 - (uint32_t) puppet->n)
    {
      memset (puppet->drawn, 0, 2 * pixels * sizeof *puppet->drawn);
      puppet->mark = 0;
    }
  d->mark       = puppet->mark + 1;
  puppet->mark += (uint32_t) puppet->n;
  status = list_items (d, first, end);
  if (status == CELD_OK)
    status = celd_progress (host, 1); /* before anything is drawn, since a picture stays as it was if this fails */
  if (status == CELD_OK)
    celd_parallel_for (host, (puppet->height + BAND_ROWS - 1) / BAND_ROWS, draw_band, d);
  celd_free (d->item);
  return status;
}

CeldStatus
celd_puppet_draw (CeldPuppet *puppet, const CeldHost *host, CeldColours *picture, CeldPlane *levels)
{
  Drawing d = { .puppet = puppet, .picture = picture, .levels = levels, .on_base = !levels };

  return draw_layers (&d, levels ? 0 : puppet->n_base, puppet->n, host);
}

size_t
celd_puppet_count (const CeldPuppet *puppet)
{
  return puppet->n;
}

void
celd_puppet_layer (const CeldPuppet *puppet, size_t layer, CeldPosedLayer *posed)
{
  const CeldPuppetLayer *of = &puppet->layer[layer];
  double                 sum = 0, n = of->n_cells ? (double) of->n_cells : 1;

  for (size_t c = of->first; c < of->first + of->n_cells; c++)
    sum += (double) puppet->depth[c];
  *posed = (CeldPosedLayer) { .label = of->label, .level = layer < puppet->n_base ? -INFINITY : of->level + sum / n };
  for (size_t c = of->first; c < of->first + of->n_cells; c++)
    posed->elsewhere += (double) (puppet->depth[c] != round (sum / n)) / n;
}

CeldStatus
celd_puppet_draw_layer (CeldPuppet *puppet, size_t layer, const CeldHost *host, CeldColours *picture)
{
  Drawing d = { .puppet = puppet, .picture = picture };

  return layer < puppet->n ? draw_layers (&d, layer, layer + 1, host) : CELD_BAD_VALUE;
}
