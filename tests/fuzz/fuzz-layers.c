/* Painted layers, pixel by pixel: arrows, scribbles, contours, corrections and pictures of labels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fuzz.h"

#define MOST_SIDE 40
#define PIXELS    (MOST_SIDE * MOST_SIDE)

static const uint8_t inks[8][4] = {
  { 0, 0, 0, 0 }, { 255, 0, 0, 255 }, { 0, 0, 255, 255 }, { 0, 255, 0, 255 }, { 255, 128, 0, 200 }, { 0, 0, 0, 255 },
  { 255, 255, 255, 255 }, { 250, 5, 3, 130 },
};

/* Lines of some width in some colours, and then single pixels of any. */
static void
paint (FuzzInput *input, CeldPaint *layer)
{
  for (int lines = fuzz_below (input, 12); lines > 0; lines--)
    {
      const uint8_t *ink = inks[fuzz_below (input, 8)];
      int            x = fuzz_below (input, layer->width), y = fuzz_below (input, layer->height);
      int            dx = fuzz_below (input, 41) - 20, dy = fuzz_below (input, 41) - 20;
      int            wide = fuzz_below (input, 3) + 1;
      int            steps = abs (dx) > abs (dy) ? abs (dx) : abs (dy);

      for (int s = 0; s <= steps; s++)
        for (int k = 0; k < wide * wide; k++)
          {
            int u = x + (steps ? s * dx / steps : 0) + k % wide, v = y + (steps ? s * dy / steps : 0) + k / wide;

            if (u >= 0 && v >= 0 && u < layer->width && v < layer->height)
              memcpy (layer->data + 4 * ((size_t) v * layer->stride + (size_t) u), ink, 4);
          }
    }
  for (int dots = fuzz_below (input, 30); dots > 0; dots--)
    layer->data[(size_t) fuzz_below (input, 4 * layer->width * layer->height)] = fuzz_byte (input);
}

static void
check_relations (const CeldRelations *relations, const CeldPaint *layer)
{
  for (size_t i = 0; i < relations->n; i++)
    {
      const CeldRelation *r = &relations->item[i];

      FUZZ_CHECK (!r->nearer.by_colour && r->nearer.x >= -1 && r->nearer.x <= layer->width);
      FUZZ_CHECK (r->farther.y >= -1 && r->farther.y <= layer->height && r->source == CELD_SOURCE_ARROW);
    }
}

static void
read_arrows (const CeldPaint *layer, CeldArrowStyle style)
{
  CeldRelations relations = { 0 };
  CeldProblems  problems = { 0 };

  FUZZ_CHECK (celd_arrows_read (layer, style, NULL, &relations, &problems) == CELD_OK);
  check_relations (&relations, layer);
  celd_relations_clear (&relations);
  celd_problems_clear (&problems);
}

/* Every label is of the palette, which counts their pixels. */
static void
read_scribbles (const CeldPaint *layer, const CeldSettings *settings)
{
  static uint32_t data[PIXELS];
  size_t          count[PIXELS + 1] = { 0 };
  CeldLabels      seeds = { layer->width, layer->height, (size_t) layer->width, data };
  CeldPalette     palette = { 0 };

  FUZZ_CHECK (celd_scribbles_read (layer, settings, NULL, &seeds, &palette) == CELD_OK);
  for (int p = 0; p < layer->width * layer->height; p++)
    {
      FUZZ_CHECK (data[p] <= palette.n);
      count[data[p]]++;
    }
  for (size_t k = 0; k < palette.n; k++)
    FUZZ_CHECK (palette.item[k].seeds == count[k + 1] && count[k + 1]);
  celd_palette_clear (&palette);
}

static void
read_labels (const CeldPaint *layer)
{
  static uint32_t data[PIXELS];
  static uint8_t  again[4 * PIXELS];
  CeldLabels      labels = { layer->width, layer->height, (size_t) layer->width, data };
  CeldPaint       painted = { layer->width, layer->height, (size_t) layer->width, again };
  CeldPalette     palette = { 0 };

  FUZZ_CHECK (celd_labels_read (layer, &labels, &palette) == CELD_OK);
  FUZZ_CHECK (celd_labels_paint (&labels, &palette, &painted) == CELD_OK);
  for (int p = 0; p < layer->width * layer->height; p++)
    FUZZ_CHECK (layer->data[4 * p + 3] < 255 || !memcmp (layer->data + 4 * p, again + 4 * p, 4));
  FUZZ_CHECK (celd_corrections_read (layer, &palette, &labels) == CELD_OK);
  for (int p = 0; p < layer->width * layer->height; p++)
    FUZZ_CHECK (data[p] <= palette.n);
  celd_palette_clear (&palette);
}

/* Over white paper or a transparent drawing. */
static void
bake_contours (FuzzInput *input, const CeldPaint *layer)
{
  static float luma[PIXELS], alpha[PIXELS], baked[PIXELS], baked_alpha[PIXELS];
  size_t       w = (size_t) layer->width;
  bool         clear = fuzz_below (input, 2);
  CeldInkMode  mode = (CeldInkMode) fuzz_below (input, 4);
  CeldDrawing  drawing = { { layer->width, layer->height, w, luma },
                           { layer->width, layer->height, w, clear ? alpha : NULL } };
  CeldDrawing  out = { { layer->width, layer->height, w, baked },
                       { layer->width, layer->height, w, clear ? baked_alpha : NULL } };

  for (int p = 0; p < layer->width * layer->height; p++)
    {
      luma[p] = p % 7 ? 1 : 0;
      alpha[p] = p % 5 ? 0 : 1;
    }
  for (int purpose = 0; purpose < 2; purpose++)
    {
      FUZZ_CHECK (celd_contours_bake (&drawing, layer, (CeldPurpose) purpose, mode, NULL, &out) == CELD_OK);
      for (int p = 0; p < layer->width * layer->height; p++)
        FUZZ_CHECK (baked[p] >= 0 && baked[p] <= 1 && (!clear || (baked_alpha[p] >= 0 && baked_alpha[p] <= 1)));
    }
}

int
LLVMFuzzerTestOneInput (const uint8_t *data, size_t size)
{
  static uint8_t pixels[4 * PIXELS];
  FuzzInput      input = { data, data + size };
  CeldPaint      layer = { 1 + fuzz_below (&input, MOST_SIDE), 1 + fuzz_below (&input, MOST_SIDE), 0, pixels };
  CeldSettings   settings = celd_settings ();
  CeldArrowStyle style = (CeldArrowStyle) fuzz_below (&input, 4);

  layer.stride = (size_t) layer.width;
  settings.flats = fuzz_below (&input, 2);
  memset (pixels, fuzz_below (&input, 2) ? 255 : 0, sizeof pixels);
  paint (&input, &layer);
  read_arrows (&layer, style);
  read_scribbles (&layer, &settings);
  read_labels (&layer);
  bake_contours (&input, &layer);
  return 0;
}
