/* Drawings written as text, to be put together: 'A' is the page, 'B' the region of label 2, ...
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef FRAGMENTS_H
#define FRAGMENTS_H

#include "base/base.h"
#include "check.h"

#define MOST_REGIONS 8

typedef struct
{
  CeldLabels  labels;
  CeldPalette palette;
  CeldOrder   order;
  CeldLayers *layers;
} Drawn;

/* The colour of a label: different for all drawings and labels of a test. */
static inline void
drawn_colour (int drawing, uint32_t label, uint8_t colour[4])
{
  colour[0] = (uint8_t) (20 + 40 * drawing);
  colour[1] = (uint8_t) (250 - 30 * label);
  colour[2] = (uint8_t) (10 * label);
  colour[3] = 255;
}

/* Opaque pixels of labels 1 .. n, with relations between them; takes over the labels. */
static inline Drawn
drawn (int drawing, CeldLabels labels, uint32_t n, const char *relations)
{
  Drawn         d = { .labels = labels };
  size_t        pixels = (size_t) labels.width * (size_t) labels.height;
  CeldOwnership own = { labels, labels, { 0 } };
  CeldColours   art = { labels.width, labels.height, (size_t) labels.width, malloc (4 * pixels * sizeof (float)) };
  CeldRelations read = { 0 };

  d.palette = (CeldPalette) { calloc (n, sizeof (CeldRegion)), n };
  for (uint32_t l = 1; l <= n; l++)
    {
      drawn_colour (drawing, l, d.palette.item[l - 1].colour);
      d.palette.item[l - 1].background = l == 1;
    }
  CHECK (celd_plane_new (labels.width, labels.height, &own.coverage) == CELD_OK);
  for (size_t p = 0; p < pixels; p++)
    {
      own.coverage.data[p] = 1;
      for (int c = 0; c < 4; c++)
        art.data[4 * p + (size_t) c] = (float) d.palette.item[labels.data[p] - 1].colour[c] / 255;
    }
  CHECK (celd_relations_parse (relations, &read, NULL) == CELD_OK);
  CHECK (celd_order (&labels, &d.palette, &read, NULL, NULL, NULL, &d.order, NULL) == CELD_OK);
  CHECK (celd_layers_cut (&own.coverage, &own, d.order.level, n, &art, NULL, CELD_STORE_FLOAT, NULL, &d.layers) ==
         CELD_OK);
  celd_relations_clear (&read);
  free (own.coverage.data);
  free (art.data);
  return d;
}

static inline Drawn
drawn_text (int drawing, const char *const *rows, uint32_t n, const char *relations)
{
  return drawn (drawing, art_labels (rows), n, relations);
}

static inline void
drawn_clear (Drawn *d)
{
  celd_order_clear (&d->order);
  celd_palette_clear (&d->palette);
  celd_layers_free (d->layers);
  free (d->labels.data);
}

static inline CeldFragment
drawn_at (const Drawn *d, double x, double y)
{
  return (CeldFragment) { .layers = d->layers, .order = &d->order, .page = 1, .placement = { x, y, 1, 0, false },
                          .labels = &d->labels, .palette = &d->palette };
}

/* Which region each pixel shows, as text: 'a' the page of the first drawing, 'b' its label 2; 'A', 'B' those of the
 * second one; '0', '1' of the third; ' ' nothing, '?' something else. */
static inline void
shown (const CeldComposition *c, int width, int height, char *text)
{
  CeldColours picture = { width, height, (size_t) width, malloc (4 * (size_t) (width * height) * sizeof (float)) };

  CHECK (celd_composition_flatten (c, NULL, &picture) == CELD_OK);
  for (int p = 0; p < width * height; p++)
    {
      const float *pixel = picture.data + 4 * p;

      text[p] = pixel[3] > 0 ? '?' : ' ';
      for (int drawing = 0; drawing < 3; drawing++)
        for (uint32_t l = 1; l <= MOST_REGIONS; l++)
          {
            uint8_t colour[4];
            bool    same = true;

            drawn_colour (drawing, l, colour);
            for (int k = 0; k < 4; k++)
              same = same && fabsf (pixel[k] - (float) colour[k] / 255) < 1e-5f;
            if (same)
              text[p] = (char) ((drawing == 0 ? 'a' : drawing == 1 ? 'A' : '0') + (int) l - 1);
          }
    }
  text[width * height] = 0;
  free (picture.data);
}

#endif
