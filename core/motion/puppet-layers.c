/* A puppet in its pose as layers, for composition.
 *
 * Layers are drawn one by one, from the front.  A pixel belongs to the first one that covers it, or to the first two:
 * a third one, at a corner of three layers, gives its colour to the second.  What is covered by then is hidden.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#define NEARLY_HIDDEN (0.5f / 255) /* a pixel of which nearer layers leave less is full; half a step of 8 bits */

typedef struct
{
  CeldPuppet *puppet;
  CeldLayers *layers;
  bool        complete;
  CeldColours canvas;          /* the layer that is drawn */
  CeldBlend  *pixel;           /* of each pixel of the drawing: coverage, and its one or two layers */
  uint8_t    *n;               /* how many these are */
} PosedLayers;

/* Whether handles move any part forward or back, which layers cannot show. */
static bool
changes_depth (const CeldPuppet *puppet)
{
  for (size_t c = 0; c < puppet->lattice.n_cells; c++)
    if (puppet->depth[c] != 0)
      return true;
  return false;
}

/* ------------------------------------------------------------------ one layer */

/* Adds what a layer shows of a pixel behind all before it; false if that is nothing. */
static bool
add_visible (PosedLayers *l, size_t layer, size_t p, const float colour[4])
{
  CeldBlend *pixel = &l->pixel[p];
  float      left = l->n[p] ? 1 - pixel->colour[0][3] : 1, behind = l->n[p] > 1 ? pixel->colour[1][3] : 0;
  float      alpha = (1 - behind) * colour[3], sum = behind + alpha;

  if (left * (1 - behind) < NEARLY_HIDDEN)
    return false;
  if (l->n[p] < 2)
    {
      pixel->layer[l->n[p]] = (uint32_t) layer;
      memcpy (pixel->colour[l->n[p]], colour, sizeof pixel->colour[0]);
      l->n[p]++;
      return true;
    }
  for (int c = 0; c < 3; c++)
    pixel->colour[1][c] = (behind * pixel->colour[1][c] + alpha * colour[c]) / sum;
  pixel->colour[1][3] = sum;
  return true;
}

static CeldStatus
add_hidden (CeldHiddenPart *part, size_t *runs, size_t *colours, int x, int y, const float colour[4])
{
  CeldStatus status = celd_sheet_run_add (&part->run, &part->n_runs, runs, x, y, part->n_pixels);
  size_t     n = 4 * part->n_pixels;

  for (int c = 0; c < 4 && status == CELD_OK; c++)
    status = celd_append (part->colour, n, *colours, (uint16_t) (fminf (colour[c], 1) * 65535 + 0.5f));
  part->n_pixels += status == CELD_OK;
  return status;
}

static CeldStatus
take_layer (PosedLayers *l, size_t layer)
{
  CeldHiddenPart *part = &l->layers->hidden[layer];
  size_t          runs = 0, colours = 0;
  CeldStatus      status = CELD_OK;

  for (int y = 0; y < l->canvas.height; y++)
    for (int x = 0; x < l->canvas.width && status == CELD_OK; x++)
      {
        size_t       p = (size_t) y * (size_t) l->canvas.width + (size_t) x;
        const float *colour = l->canvas.data + 4 * p;

        if (!(colour[3] > 0))
          continue;
        if (!add_visible (l, layer, p, colour))
          {
            if (!l->complete)
              continue;
            status = add_hidden (part, &runs, &colours, x, y, colour);
          }
        l->layers->item[layer].box = celd_rect_union (l->layers->item[layer].box, (CeldRect) { x, y, 1, 1 });
      }
  return status;
}

/* ------------------------------------------------------------------ all layers */

static CeldStatus
take_layers (PosedLayers *l, const CeldHost *host)
{
  CeldPuppet *puppet = l->puppet;
  CeldStatus  status = CELD_OK;

  for (size_t k = puppet->n; k-- && status == CELD_OK;)
    {
      CeldHostPart part;
      CeldHost     own = celd_host_part (&part, host, (double) (puppet->n - k - 1) / (double) puppet->n,
                                         (double) (puppet->n - k) / (double) puppet->n);

      l->layers->item[k] = (CeldLayer) { .label = puppet->layer[k].label, .level = puppet->layer[k].level };
      status = celd_puppet_draw_layer (puppet, k, &own, &l->canvas);
      if (status == CELD_OK)
        status = take_layer (l, k);
    }
  return status;
}

/* Gives each pixel to its layer, or to two. */
static CeldStatus
place_pixels (const PosedLayers *l)
{
  CeldLayers *layers = l->layers;
  size_t      capacity = 0, pixels = (size_t) layers->width * (size_t) layers->height;
  CeldStatus  status = CELD_OK;

  for (size_t p = 0; p < pixels && status == CELD_OK; p++)
    {
      CeldBlend *pixel = &l->pixel[p];

      layers->place[p] = l->n[p] > 1 ? (uint32_t) (layers->n + layers->n_blends) : pixel->layer[0];
      memcpy (layers->art + 4 * p, pixel->colour[0], 4 * sizeof *layers->art);
      if (l->n[p] < 2)
        continue;
      pixel->x        = (int) (p % (size_t) layers->width);
      pixel->y        = (int) (p / (size_t) layers->width);
      pixel->coverage = pixel->colour[0][3];
      status = celd_append (layers->blend, layers->n_blends, capacity, *pixel);
    }
  return status;
}

CeldStatus
celd_puppet_layers (CeldPuppet *puppet, bool complete, const CeldHost *host, CeldLayers **result)
{
  size_t      pixels = (size_t) puppet->width * (size_t) puppet->height;
  PosedLayers l = { .puppet = puppet, .complete = complete,
                    .canvas = { puppet->width, puppet->height, (size_t) puppet->width, NULL } };
  CeldStatus  status;

  if (changes_depth (puppet))
    return CELD_BAD_VALUE;
  status        = celd_layers_new (puppet->width, puppet->height, puppet->n, &l.layers);
  l.canvas.data = celd_alloc (pixels, 4 * sizeof *l.canvas.data);
  l.pixel       = celd_alloc0 (pixels, sizeof *l.pixel);
  l.n           = celd_alloc0 (pixels, sizeof *l.n);
  if (status == CELD_OK && (!l.canvas.data || !l.pixel || !l.n))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      l.layers->n = puppet->n;
      celd_quantizer_prepare (l.layers);
      status = take_layers (&l, host);
    }
  if (status == CELD_OK)
    status = place_pixels (&l);
  celd_free (l.canvas.data);
  celd_free (l.pixel);
  celd_free (l.n);
  if (status == CELD_OK)
    *result = l.layers;
  else
    celd_layers_free (l.layers);
  return status;
}
