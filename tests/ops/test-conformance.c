/* Operations from contours to depth have the results of the steps of core, bit by bit.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "core-page.h"

#include <locale.h>

/* Colours of 8 bits are compared as floats, like all else. */
static const float *
as_floats (const uint8_t *bytes, int n)
{
  static float floats[4 * PIXELS];

  for (int i = 0; i < n; i++)
    floats[i] = (float) bytes[i] / 255;
  return floats;
}

static void
contours_are_those_of_core (void)
{
  float      *baked = malloc (PIXELS * sizeof (float));
  CeldDrawing out = { .luma = { WIDTH, HEIGHT, WIDTH, baked } };

  for (int purpose = CELD_FOR_SEGMENTATION; purpose <= CELD_FOR_DEPTH; purpose++)
    {
      CHECK (celd_contours_bake (&page_drawing, &contours_paint, (CeldPurpose) purpose, CELD_INK_AUTO, NULL, &out) ==
             CELD_OK);
      operate ("celdepth:virtual-contours", (Pads) { { drawing, contours } }, "Y' float", result,
               "result", purpose, NULL);
      SAME (baked, 1);
    }
  free (baked);
}

static void
labels_are_those_of_core (void)
{
  operate ("celdepth:lazybrush-segment", (Pads) { { drawing, scribbles, arrows } }, "R'G'B'A float", result, NULL);
  SAME (as_floats (colours.data, 4 * PIXELS), 4);
}

static void
order_is_that_of_core (void)
{
  GeglBuffer *input = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);

  operate ("celdepth:depth-order", (Pads) { { input, arrows, drawing } }, "Y float", result, NULL);
  SAME (flat.data, 1);
  operate ("celdepth:depth-order", (Pads) { { input, NULL, drawing } }, "Y float", result,
           "relations", "#ff0000 > #00ff00", "encoding", CELD_ENCODING_RANK, NULL);
  for (int i = 0; i < PIXELS; i++)
    result[i] /= 2;
  SAME (flat.data, 1);
  g_object_unref (input);
}

/* A depth hint counts only if the settings ask for suggestions. */
static void
order_uses_a_depth_hint (void)
{
  GeglBuffer *input = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  GeglBuffer *hint = page_buffer ("Y float", "Y float", flat.data);

  operate ("celdepth:depth-order", (Pads) { { input, NULL, drawing, hint } }, "Y float", result, "suggest",
           CELD_SUGGEST_OFF, NULL);
  CHECK (difference (flat.data, result, PIXELS) > 0);
  operate ("celdepth:depth-order", (Pads) { { input, NULL, NULL, hint } }, "Y float", result, "suggest",
           CELD_SUGGEST_ALL, "relations", "#ff0000 < #00ff00", NULL);
  CHECK (difference (flat.data, result, PIXELS) > 0); /* the artist's relation, which the hint is against */
  g_object_unref (hint);
  g_object_unref (input);
}

static void
levels_are_those_of_core (void)
{
  GeglBuffer *input = page_buffer ("Y float", "Y float", flat.data);

  operate ("celdepth:depth-expand", (Pads) { { input, drawing } }, "Y float", result, NULL);
  SAME (levels.data, 1);
  CHECK (difference (flat.data, levels.data, PIXELS) > 0);
  g_object_unref (input);
}

static void
depth_is_that_of_core (void)
{
  GeglBuffer *input = page_buffer ("Y float", "Y float", levels.data);

  operate ("celdepth:depth-smooth", (Pads) { { input, drawing, scribbles } }, "Y float", result, NULL);
  SAME (depth.data, 1);
  g_object_unref (input);
}

/* Depth, heights and normals of the page with breaks in its contours, which stay smooth if the whole page is the
 * drawing for segmentation. */
static void
gaps_are_those_of_core (void)
{
  static float broken[PIXELS], opened[PIXELS], wanted[2][PIXELS];
  static float unit[3 * PIXELS], bent[2][3 * PIXELS];
  CeldDrawing  page = { .luma = { WIDTH, HEIGHT, WIDTH, broken } };
  CeldPlane    open = { WIDTH, HEIGHT, WIDTH, opened };
  CeldSettings settings = celd_settings ();
  CeldRelief   relief = { 0 };
  CeldVectors  bodies = { WIDTH, HEIGHT, WIDTH, unit };
  GeglBuffer  *input = page_buffer ("Y float", "Y float", levels.data), *gaps;

  for (int i = 0; i < PIXELS; i++)
    broken[i] = i / WIDTH % 16 < 5 ? 1 : page_luma[i];
  gaps = page_buffer ("Y' float", "Y' float", broken);
  CHECK (celd_ink (&page, CELD_INK_AUTO, NULL, &open) == CELD_OK);
  for (int k = 0; k < 2; k++)
    {
      CeldPlane made = { WIDTH, HEIGHT, WIDTH, wanted[k] };

      CHECK (celd_smooth (&open, k ? &ink : NULL, &levels, NULL, &settings, NULL, &made, NULL) == CELD_OK);
      operate ("celdepth:depth-smooth", (Pads) { { input, gaps, NULL, k ? drawing : NULL } }, "Y float", result, NULL);
      SAME (wanted[k], 1);
      CHECK (celd_relief (&open, k ? &ink : NULL, &levels, NULL, &settings, NULL, &relief) == CELD_OK);
      operate ("celdepth:relief", (Pads) { { input, gaps, NULL, k ? drawing : NULL } }, "Y float", result, "unit", 1,
               NULL);
      SAME (relief.z, 1);
      CHECK (celd_normals_hinted (&open, k ? &ink : NULL, &levels, NULL, NULL, &settings, NULL, &bodies) == CELD_OK);
      for (int i = 0; i < 3 * PIXELS; i++)
        bent[k][i] = 0.5f + 0.5f * bodies.data[i];
      operate ("celdepth:lumo-shade", (Pads) { { input, gaps, NULL, NULL, NULL, NULL, k ? drawing : NULL } }, "RGB float",
               result, "result", 2, NULL);
      SAME (bent[k], 3);
    }
  CHECK (difference (wanted[0], wanted[1], PIXELS) > 0.1);
  CHECK (difference (bent[0], bent[1], 3 * PIXELS) > 0.1);
  celd_relief_clear (&relief);
  g_object_unref (gaps);
  g_object_unref (input);
}

/* With the scribbles of the page, of which the green one is the background, and contours. */
static void
exact_depth_is_that_of_core (void)
{
  static uint32_t data[PIXELS];
  static float    inked[PIXELS], wanted[PIXELS];
  CeldLabels      seeds = { WIDTH, HEIGHT, WIDTH, data };
  CeldDrawing     baked = { .luma = { WIDTH, HEIGHT, WIDTH, inked } };
  CeldPlane       exact = { WIDTH, HEIGHT, WIDTH, wanted };
  CeldSettings    settings = celd_settings ();
  CeldPalette     painted = { 0 };

  settings.contrast = 2;
  CHECK (celd_contours_bake (&page_drawing, &contours_paint, CELD_FOR_DEPTH, CELD_INK_AUTO, NULL, &baked) == CELD_OK);
  CHECK (celd_ink (&baked, CELD_INK_AUTO, NULL, &exact) == CELD_OK);
  memcpy (inked, wanted, sizeof inked);
  CHECK (celd_scribbles_read (&scribbles_paint, &settings, NULL, &seeds, &painted) == CELD_OK);
  for (size_t k = 0; k < painted.n; k++)
    for (size_t i = 0; i < palette.n; i++)
      if (!memcmp (painted.item[k].colour, palette.item[i].colour, 4))
        painted.item[k].background = palette.item[i].background;
  CHECK (celd_depth_exact (&baked.luma, &seeds, &painted, &relations, &settings, NULL, &exact, NULL, NULL) == CELD_OK);
  operate ("celdepth:depth-exact", (Pads) { { drawing, scribbles, arrows, contours } }, "Y float", result,
           "contrast", 2.0, "hold-gaps", FALSE, NULL);
  SAME (wanted, 1);
  NEAR (range (wanted, PIXELS), 1, 0);
  celd_palette_clear (&painted);
}

static void
popup_is_the_steps_of_core (void)
{
  Pads         pads = { { drawing, scribbles, arrows } };
  const float *wanted[] = { NULL, flat.data, levels.data, depth.data, NULL, shading.data };

  operate ("celdepth:popup", pads, "R'G'B'A float", result, "result", 0, NULL);
  SAME (as_floats (colours.data, 4 * PIXELS), 4);
  for (int i = 0; i < 6; i++)
    if (wanted[i])
      {
        operate ("celdepth:popup", pads, "Y float", result, "result", i, NULL);
        SAME (wanted[i], 1);
      }
  operate ("celdepth:popup", pads, "RGB float", result, "result", 4, NULL);
  SAME (stored_normals (false), 3);
}

/* Without its hidden side, the right disc bends at the left one as at an outline of its own. */
static void
popup_reads_what_is_hidden (void)
{
  static uint8_t hidden[4 * PIXELS];
  static float   whole[3 * PIXELS];
  GeglBuffer    *painted;
  size_t         beside = 3 * (40 * WIDTH + 72), left = 3 * (40 * WIDTH + 30);

  paint_line (hidden, 45, 14, 45, 40, 26, 0x000000); /* all of the left disc right of its middle */
  painted = page_buffer ("R'G'B'A u8", "R'G'B'A u8", hidden);
  operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows } }, "RGB float", whole, "result", 4, NULL);
  operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows, NULL, painted } }, "RGB float", result,
           "result", 4, NULL);
  CHECK (whole[beside] > 0.25f);
  CHECK (result[beside] < whole[beside] - 0.1f);
  NEAR (result[left], whole[left], 1e-3);
  g_object_unref (painted);
}

/* The settings of segmentation have their effect. */
static void
method_is_that_of_core (void)
{
  static const struct { CeldMethod method; gboolean gaps, necks; } cases[] = {
    { CELD_METHOD_EXACT, TRUE, TRUE }, { CELD_METHOD_WALKER, TRUE, TRUE },
    { CELD_METHOD_BASINS, FALSE, TRUE }, { CELD_METHOD_BASINS, TRUE, FALSE },
  };
  static uint32_t data[PIXELS];
  static uint8_t  wanted[4 * PIXELS];
  CeldLabels      seeds = { WIDTH, HEIGHT, WIDTH, data };
  CeldPaint       paint = { WIDTH, HEIGHT, WIDTH, wanted };

  for (size_t i = 0; i < G_N_ELEMENTS (cases); i++)
    {
      CeldSettings settings = celd_settings ();
      CeldPalette  made = { 0 };

      settings.method     = cases[i].method;
      settings.close_gaps = cases[i].gaps;
      settings.keep_necks = cases[i].necks;
      CHECK (celd_scribbles_read (&scribbles_paint, &settings, NULL, &seeds, &made) == CELD_OK);
      CHECK (celd_segment (&ink, &seeds, &relations, &settings, NULL, &seeds, &made, NULL) == CELD_OK);
      CHECK (celd_labels_paint (&seeds, &made, &paint) == CELD_OK);
      operate ("celdepth:lazybrush-segment", (Pads) { { drawing, scribbles, arrows } }, "R'G'B'A float", result,
               "method", cases[i].method, "close-gaps", cases[i].gaps, "keep-necks", cases[i].necks, NULL);
      SAME (as_floats (wanted, 4 * PIXELS), 4);
      operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows } }, "R'G'B'A float", result, "result", 0,
               "method", cases[i].method, "close-gaps", cases[i].gaps, "keep-necks", cases[i].necks, NULL);
      SAME (as_floats (wanted, 4 * PIXELS), 4);
      celd_palette_clear (&made);
    }
}

/* ------------------------------------------------------------------ graphs */

/* One node, asked again and again with other properties, as a preview does. */
static void
popup_follows_its_properties (void)
{
  GeglNode *graph = gegl_node_new ();
  GeglNode *node = add_operation (graph, "celdepth:popup", (Pads) { { drawing, scribbles, arrows } });

  gegl_node_set (node, "result", 3, NULL);
  get_output (node, "Y float", result);
  SAME (depth.data, 1);
  gegl_node_set (node, "result", 0, NULL);
  get_output (node, "R'G'B'A float", result);
  SAME (as_floats (colours.data, 4 * PIXELS), 4);
  gegl_node_set (node, "result", 2, "encoding", CELD_ENCODING_FIXED, "near-level", 4.0, "far-level", 0.0, NULL);
  get_output (node, "Y float", result);
  for (int i = 0; i < PIXELS; i++)
    result[i] *= 2;
  SAME (levels.data, 1);
  g_object_unref (graph);
}

/* The reference chain of the manual, contours included. */
static void
chain_agrees_with_popup (void)
{
  GeglNode *graph = gegl_node_new (), *cut_labels, *cut_depth, *segment, *order, *expand, *smooth;
  float    *one = malloc (PIXELS * sizeof (float));

  cut_labels = add_operation (graph, "celdepth:virtual-contours", (Pads) { { drawing, contours } });
  cut_depth  = add_operation (graph, "celdepth:virtual-contours", (Pads) { { drawing, contours } });
  segment    = add_operation (graph, "celdepth:lazybrush-segment", (Pads) { { NULL, scribbles, arrows } });
  order      = add_operation (graph, "celdepth:depth-order", (Pads) { { NULL, arrows } });
  expand     = add_operation (graph, "celdepth:depth-expand", (Pads) { { NULL } });
  smooth     = add_operation (graph, "celdepth:depth-smooth", (Pads) { { NULL, NULL, scribbles } });
  gegl_node_set (cut_depth, "result", CELD_FOR_DEPTH, NULL);
  join (cut_labels, segment, "input");
  join (segment, order, "input");
  join (cut_labels, order, "aux2");
  join (order, expand, "input");
  join (cut_depth, expand, "aux");
  join (expand, smooth, "input");
  join (cut_depth, smooth, "aux");
  join (cut_labels, smooth, "aux3");
  get_output (smooth, "Y float", result);
  operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows, contours } }, "Y float", one, NULL);
  NEAR (difference (result, one, PIXELS), 0, 1e-4);
  CHECK (range (one, PIXELS) > 0.5);
  CHECK (difference (one, depth.data, PIXELS) > 0.01); /* the contours matter */
  g_object_unref (graph);
  free (one);
}

/* ------------------------------------------------------------------ formats */

static void
every_depth_of_colour_gives_the_same (void)
{
  static const char *const formats[] = { "R'G'B' u8", "R'G'B'A u16", "RGB float", "RGBA float", "Y float", "Y'A half" };

  for (size_t i = 0; i < G_N_ELEMENTS (formats); i++)
    {
      GeglBuffer *other = page_buffer (formats[i], "Y' float", page_luma);
      GeglBuffer *painted = page_buffer ("RGBA float", "R'G'B'A u8", page_scribbles);

      operate ("celdepth:popup", (Pads) { { other, painted, arrows } }, "Y float", result, NULL);
      NEAR (difference (result, depth.data, PIXELS), 0, 1e-3);
      g_object_unref (other);
      g_object_unref (painted);
    }
}

/* Coloured ink: luma of encoded values, whatever the buffer holds. */
static void
colour_is_read_as_luma (void)
{
  static float rgb[3 * PIXELS], grey[PIXELS], blank[4 * PIXELS];
  GeglBuffer  *coloured, *nothing = page_buffer ("R'G'B'A u8", "R'G'B'A float", blank);

  for (int i = 0; i < PIXELS; i++)
    {
      rgb[3 * i]     = 1;
      rgb[3 * i + 1] = page_luma[i];
      rgb[3 * i + 2] = page_luma[i];
      grey[i] = 0.2126f + 0.7874f * page_luma[i];
    }
  coloured = page_buffer ("RGB float", "R'G'B' float", rgb);
  operate ("celdepth:virtual-contours", (Pads) { { coloured, nothing } }, "Y' float", result, NULL);
  SAME (grey, 1);
  g_object_unref (coloured);
  g_object_unref (nothing);
}

/* With flats and no scribbles, a coloured drawing has its regions itself, in the colours of its fills. */
static void
fills_can_be_regions (void)
{
  static uint8_t art[4 * PIXELS], found[4 * PIXELS];
  static const uint8_t fill[][4] = { { 250, 190, 60, 255 }, { 90, 160, 70, 255 }, { 200, 225, 250, 255 } };
  GeglBuffer *coloured;
  int         wrong = 0;

  for (int i = 0; i < PIXELS; i++)
    {
      float x = (float) (i % WIDTH) + 0.5f, y = (float) (i / WIDTH) + 0.5f;
      bool  left = hypotf (x - 45, y - 40) < 24, right = hypotf (x - 80, y - 40) < 22;

      for (int c = 0; c < 4; c++)
        art[4 * i + c] = (uint8_t) (fill[left ? 0 : right ? 1 : 2][c] * (c < 3 ? page_luma[i] : 1));
    }
  coloured = page_buffer ("R'G'B'A u8", "R'G'B'A u8", art);
  operate ("celdepth:lazybrush-segment", (Pads) { { coloured } }, "R'G'B'A u8", found, "flats", TRUE, NULL);
  for (int i = 0; i < PIXELS; i++)
    wrong += page_luma[i] >= 1 && memcmp (found + 4 * i, art + 4 * i, 4) != 0;
  NEAR (wrong, 0, 0);
  g_object_unref (coloured);
}

/* A layer that is smaller than the canvas is read at its place. */
static void
small_layers_keep_their_place (void)
{
  GeglBuffer *small = gegl_buffer_new (GEGL_RECTANGLE (3, 3, 112, 60), babl_format ("R'G'B'A u8"));

  gegl_buffer_copy (scribbles, GEGL_RECTANGLE (3, 3, 112, 60), GEGL_ABYSS_NONE, small, GEGL_RECTANGLE (3, 3, 0, 0));
  operate ("celdepth:popup", (Pads) { { drawing, small, arrows } }, "Y float", result, NULL);
  SAME (depth.data, 1);
  g_object_unref (small);
}

int
main (int argc, char **argv)
{
  setlocale (LC_ALL, "");
  gegl_init (&argc, &argv);
  make_page ();
  RUN (core_makes_all_results_of_the_page);
  RUN (contours_are_those_of_core);
  RUN (labels_are_those_of_core);
  RUN (order_is_that_of_core);
  RUN (order_uses_a_depth_hint);
  RUN (levels_are_those_of_core);
  RUN (depth_is_that_of_core);
  RUN (gaps_are_those_of_core);
  RUN (exact_depth_is_that_of_core);
  RUN (popup_is_the_steps_of_core);
  RUN (popup_reads_what_is_hidden);
  RUN (method_is_that_of_core);
  RUN (popup_follows_its_properties);
  RUN (chain_agrees_with_popup);
  RUN (every_depth_of_colour_gives_the_same);
  RUN (colour_is_read_as_luma);
  RUN (fills_can_be_regions);
  RUN (small_layers_keep_their_place);
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  drop_page ();
  gegl_exit ();
  return DONE;
}
