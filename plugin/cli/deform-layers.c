/* A deformed drawing as a file with one layer for each region, in the order of depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stdlib.h>
#include <string.h>

#define LEAST_ELSEWHERE 0.1 /* of a layer that was moved forward or back, for a message; chosen */

/* A layer of the puppet in its pose. */
typedef struct { size_t number; uint32_t label; double level; CeldRect box; } Posed;

typedef struct
{
  CeldPuppet *puppet;
  Posed      *posed;        /* from back to front */
  size_t      n;
  CeldColours canvas;       /* for one layer at a time */
  bool        encode;       /* linear light to encoded colours, when stored */
  CliRun     *run;
} Deformed;

/* ------------------------------------------------------------------ layers in their pose */

static CeldRect
box_of (const CeldColours *canvas)
{
  int left = canvas->width, top = canvas->height, right = 0, bottom = 0;

  for (int y = 0; y < canvas->height; y++)
    for (int x = 0; x < canvas->width; x++)
      if (canvas->data[4 * ((size_t) y * canvas->stride + (size_t) x) + 3] > 0)
        {
          left   = MIN (left, x);
          top    = MIN (top, y);
          right  = MAX (right, x + 1);
          bottom = y + 1;
        }
  return right ? (CeldRect) { left, top, right - left, bottom - top } : (CeldRect) { 0 };
}

static int
compare_levels (const void *a, const void *b)
{
  const Posed *p = a, *q = b;

  return p->level != q->level ? (p->level < q->level ? -1 : 1) : p->number < q->number ? -1 : 1;
}

/* Lists the layers by their levels.  One that handles have moved forward in part has the mean of its levels, since a
 * layer has one place. */
static bool
list_layers (Deformed *d, const CeldPalette *palette)
{
  bool good = true;

  for (size_t k = 0; k < d->n && good; k++)
    {
      CeldHost       quiet = { NULL, d->run->host.each, d->run->host.data };
      CeldPosedLayer layer;
      char          *name;

      good = cli_check (celd_puppet_draw_layer (d->puppet, k, &quiet, &d->canvas));
      celd_puppet_layer (d->puppet, k, &layer);
      d->posed[k] = (Posed) { k, layer.label, layer.level, box_of (&d->canvas) };
      if (layer.elsewhere < LEAST_ELSEWHERE)
        continue;
      name = cli_layer_name (palette, layer.label);
      cli_say ("Only part of %s was moved forward or back, but a layer has one place: it lies where the mean is.",
               name);
      g_free (name);
    }
  qsort (d->posed, d->n, sizeof *d->posed, compare_levels);
  return good;
}

/* ------------------------------------------------------------------ writing */

static bool
paint (void *host, size_t layer, float *rgba)
{
  Deformed       *d = host;
  const CeldRect *box = &d->posed[layer].box;
  CeldHost        quiet = { NULL, d->run->host.each, d->run->host.data };

  if (celd_puppet_draw_layer (d->puppet, d->posed[layer].number, &quiet, &d->canvas) != CELD_OK)
    return false;
  for (int y = 0; y < box->height; y++)
    memcpy (rgba + 4 * (size_t) y * (size_t) box->width,
            d->canvas.data + 4 * ((size_t) (box->y + y) * d->canvas.stride + (size_t) box->x),
            4 * (size_t) box->width * sizeof *rgba);
  cli_convert_light (d->encode, false, box->width, box->height, rgba);
  return d->run->host.progress (d->run->host.data, (double) layer / (double) d->n);
}

static bool
write_stack (const char *path, Deformed *d, const CeldPalette *palette, const CeldColours *picture)
{
  CeldIoLayer *item = g_new0 (CeldIoLayer, d->n);
  char       **name = g_new0 (char *, d->n + 1);
  CeldIoStack  stack = { picture->width, picture->height, item, d->n, picture->data, paint, d };
  CeldIoError  error;
  bool         good;

  for (size_t i = 0; i < d->n; i++)
    {
      name[i] = cli_layer_name (palette, d->posed[i].label);
      item[i] = (CeldIoLayer) { .name = name[i], .box = d->posed[i].box, .label = d->posed[i].label };
    }
  good = celd_io_write_layers (path, &stack, &error) ||
         (error.text[0] ? cli_error ("%s", error.text)
                        : cli_check (cli_run_cancelled () ? CELD_CANCELLED : CELD_NO_MEMORY));
  g_strfreev (name);
  g_free (item);
  return good;
}

bool
cli_deformed_layers_write (const char *path, CeldPuppet *puppet, const CeldPalette *palette, bool encode,
                           CeldColours *picture, CliRun *run)
{
  Deformed d = { .puppet = puppet, .n = celd_puppet_count (puppet), .encode = encode, .run = run };
  bool     good;

  d.posed = g_new0 (Posed, d.n);
  good    = cli_colours_new (picture->width, picture->height, &d.canvas) && list_layers (&d, palette);
  if (good)
    {
      cli_convert_light (encode, false, picture->width, picture->height, picture->data);
      good = write_stack (path, &d, palette, picture);
    }
  g_free (d.canvas.data);
  g_free (d.posed);
  return good;
}
