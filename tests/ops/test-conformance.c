/* Every operation against the step of core that it wraps: the same page in, the same numbers out.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "page.h"

#include <locale.h>

/* What core makes of the page, step by step, without threads. */
static CeldPlane     ink = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldLabels    labels = { WIDTH, HEIGHT, WIDTH, (uint32_t[PIXELS]) { 0 } };
static CeldPaint     colours = { WIDTH, HEIGHT, WIDTH, (uint8_t[4 * PIXELS]) { 0 } };
static CeldPlane     flat = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldPlane     levels = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldPlane     depth = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldVectors   normals = { WIDTH, HEIGHT, WIDTH, (float[3 * PIXELS]) { 0 } };
static CeldPlane     shading = { WIDTH, HEIGHT, WIDTH, (float[PIXELS]) { 0 } };
static CeldPalette   palette;
static CeldRelations relations;

static float result[4 * PIXELS];

/* ------------------------------------------------------------------ core */

static CeldStatus
make_order (const CeldSettings *settings)
{
  CeldOrder  order = { 0 };
  CeldStatus status = celd_order (&labels, &palette, &relations, &ink, NULL, NULL, &order, NULL);

  for (int i = 0; status == CELD_OK && i < PIXELS; i++)
    flat.data[i] = celd_encode_level (order.level[labels.data[i] - 1], order.levels, settings);
  if (status == CELD_OK)
    status = celd_expand_levels (&ink, &flat, NULL, NULL, CELD_EXPANSION_OUTLINES, NULL, &levels);
  celd_order_clear (&order);
  return status;
}

static void
core_makes_the_page (void)
{
  CeldSettings settings = celd_settings ();
  CeldMask     anchors = { WIDTH, HEIGHT, WIDTH, malloc (PIXELS) };

  CHECK (celd_ink (&page_drawing, CELD_INK_AUTO, NULL, &ink) == CELD_OK);
  CHECK (celd_scribbles_read (&scribbles_paint, &settings, NULL, &labels, &palette) == CELD_OK);
  for (int i = 0; i < PIXELS; i++)
    anchors.data[i] = labels.data[i] != 0;
  CHECK (celd_arrows_read (&arrows_paint, CELD_ARROW_HEAD, NULL, &relations, NULL) == CELD_OK);
  CHECK (relations.n == 1);
  CHECK (celd_segment (&ink, &labels, &relations, &settings, NULL, &labels, &palette, NULL) == CELD_OK);
  CHECK (palette.n == 3);
  CHECK (celd_labels_paint (&labels, &palette, &colours) == CELD_OK);
  CHECK (make_order (&settings) == CELD_OK);
  CHECK (celd_smooth (&ink, &levels, &anchors, &settings, NULL, &depth, NULL) == CELD_OK);
  CHECK (celd_normals (&ink, &levels, &settings, NULL, &normals) == CELD_OK);
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_OK);
  NEAR (range (flat.data, PIXELS), 1, 0);
  free (anchors.data);
}

/* ------------------------------------------------------------------ the table */

/* Colours of 8 bits are compared as floats, like all else. */
static const float *
as_floats (const uint8_t *bytes, int n)
{
  static float floats[4 * PIXELS];

  for (int i = 0; i < n; i++)
    floats[i] = (float) bytes[i] / 255;
  return floats;
}

/* What normals are stored as. */
static const float *
stored_normals (bool directx)
{
  static float stored[3 * PIXELS];

  for (int i = 0; i < 3 * PIXELS; i++)
    stored[i] = 0.5f + (directx && i % 3 == 1 ? -0.5f : 0.5f) * normals.data[i];
  return stored;
}

/* The drawing as grey light, under the shading. */
static const float *
lit_drawing (void)
{
  static float lit[4 * PIXELS];
  const Babl  *fish = babl_fish (babl_format ("Y' float"), babl_format ("RGBA float"));

  babl_process (fish, page_luma, lit, PIXELS);
  for (int i = 0; i < 4 * PIXELS; i++)
    if (i % 4 != 3)
      lit[i] *= shading.data[i / 4];
  return lit;
}

#define SAME(wanted, channels) NEAR (difference (result, wanted, (size_t) (channels) * PIXELS), 0, 1e-5)

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

/* Depth from elsewhere that knows the order better than the shapes do: it counts only if asked for. */
static void
order_takes_a_depth_hint (void)
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

/* Each layer over the one before, in linear light: the drawing again, complete or not. */
static void
layers_are_the_drawing (void)
{
  static float  wanted[4 * PIXELS];
  static double sum[4 * PIXELS];
  GeglBuffer   *input = page_buffer ("Y float", "Y float", flat.data);
  GeglBuffer   *regions = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);

  babl_process (babl_fish (babl_format ("Y' float"), babl_format ("RGBA float")), page_luma, wanted, PIXELS);
  for (int complete = 0; complete < 2; complete++)
    for (int parted = 0; parted < 2; parted++)
      {
        int filled = 0;

        memset (sum, 0, sizeof sum);
        for (int layer = 0; layer < 5; layer++)
          {
            operate ("celdepth:depth-expand", (Pads) { { input, drawing, parted ? regions : NULL } }, "RGBA float",
                     result, "result", 1, "layer", layer, "complete", complete, NULL);
            filled += result[0] > 0 || range (result, 4 * PIXELS) > 0;
            for (int i = 0; i < 4 * PIXELS; i++)
              {
                double alpha = (double) result[i / 4 * 4 + 3];

                sum[i] = (i % 4 < 3 ? alpha * (double) result[i] : alpha) + (1 - alpha) * sum[i];
              }
          }
        CHECK (filled == 3);
        for (int i = 0; i < 4 * PIXELS; i++)
          result[i] = (float) sum[i];
        SAME (wanted, 4);
      }
  g_object_unref (input);
  g_object_unref (regions);
}

/* What core says of the page's labels, without the way over levels and colours. */
static void
own_the_page (const CeldLabels *strokes, CeldOwnership *own)
{
  CeldOrder order = { 0 };

  own->owner = (CeldLabels) { WIDTH, HEIGHT, WIDTH, malloc (PIXELS * sizeof (uint32_t)) };
  own->under = (CeldLabels) { WIDTH, HEIGHT, WIDTH, malloc (PIXELS * sizeof (uint32_t)) };
  own->share = (CeldPlane) { WIDTH, HEIGHT, WIDTH, malloc (PIXELS * sizeof (float)) };
  CHECK (celd_order (&labels, &palette, &relations, &ink, NULL, NULL, &order, NULL) == CELD_OK);
  CHECK (celd_own (&ink, &labels, order.level, order.n, strokes, CELD_EXPANSION_OUTLINES, NULL, own) == CELD_OK);
  celd_order_clear (&order);
}

static void
drop_ownership (CeldOwnership *own)
{
  free (own->owner.data);
  free (own->under.data);
  free (own->share.data);
}

/* The owners' colours, as opaque as they cover the pixel. */
static const float *
matte_of (const CeldOwnership *own)
{
  static float matte[4 * PIXELS];
  CeldPaint    paint = { WIDTH, HEIGHT, WIDTH, malloc (4 * PIXELS) };

  CHECK (celd_labels_paint (&own->owner, &palette, &paint) == CELD_OK);
  babl_process (babl_fish (babl_format ("R'G'B'A u8"), babl_format ("RGBA float")), paint.data, matte, PIXELS);
  for (int i = 0; i < PIXELS; i++)
    matte[4 * i + 3] = own->share.data[i];
  free (paint.data);
  return matte;
}

/* By a table of each label's level on the page. */
static const float *
levels_of (const CeldOwnership *own, bool of_owner)
{
  static float owned[PIXELS], level[4];

  for (int i = 0; i < PIXELS; i++)
    level[labels.data[i]] = flat.data[i];
  for (int i = 0; i < PIXELS; i++)
    owned[i] = level[(of_owner || own->share.data[i] >= 0.5f ? own->owner : own->under).data[i]];
  return owned;
}

/* Owner and alpha: in colours, or without regions the levels as greys, which part the page no less. */
static void
matte_is_owner_and_share (void)
{
  GeglBuffer   *input = page_buffer ("Y float", "Y float", flat.data);
  GeglBuffer   *regions = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  CeldOwnership own;
  int           soft = 0;
  const float  *level;

  own_the_page (NULL, &own);
  operate ("celdepth:depth-expand", (Pads) { { input, drawing, regions } }, "RGBA float", result, "result", 2, NULL);
  SAME (matte_of (&own), 4);
  operate ("celdepth:depth-expand", (Pads) { { input, drawing } }, "RGBA float", result, "result", 2, NULL);
  level = levels_of (&own, true);
  for (int i = 0; i < PIXELS; i++)
    {
      result[4 * i] -= level[i];
      result[4 * i + 1] -= level[i];
      result[4 * i + 2] -= level[i];
      result[4 * i + 3] -= own.share.data[i];
      soft += own.share.data[i] < 1;
    }
  NEAR (range (result, 4 * PIXELS), 0, 1e-5);
  CHECK (soft > 100); /* the outlines are antialiased */
  drop_ownership (&own);
  g_object_unref (input);
  g_object_unref (regions);
}

/* A stroke in the background's colour over the outline of the left disc. */
static void
corrections_give_ink (void)
{
  static uint8_t  stroke[4 * PIXELS];
  static uint32_t given[PIXELS];
  CeldLabels      strokes = { WIDTH, HEIGHT, WIDTH, given };
  GeglBuffer     *input = page_buffer ("Y float", "Y float", flat.data), *corrections;
  GeglBuffer     *regions = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  CeldOwnership   before, after;
  Pads            pads;

  paint_line (stroke, 20, 38, 20, 42, 2, 0x0000ff);
  for (int i = 0; i < PIXELS; i++)
    given[i] = stroke[4 * i + 3] ? labels.data[0] : 0;
  own_the_page (NULL, &before);
  own_the_page (&strokes, &after);
  CHECK (before.owner.data[40 * WIDTH + 21] == labels.data[40 * WIDTH + 45]);
  CHECK (after.owner.data[40 * WIDTH + 21] == labels.data[0]);
  corrections = page_buffer ("R'G'B'A u8", "R'G'B'A u8", stroke);
  pads = (Pads) { { input, drawing, regions, corrections } };
  operate ("celdepth:depth-expand", pads, "RGBA float", result, "result", 2, NULL);
  SAME (matte_of (&after), 4);
  operate ("celdepth:depth-expand", pads, "Y float", result, NULL);
  SAME (levels_of (&after, false), 1);
  operate ("celdepth:depth-expand", pads, "RGBA float", result, "result", 1, "layer", 2, NULL);
  CHECK (result[4 * (40 * WIDTH + 21) + 3] < 0.5f && result[4 * (40 * WIDTH + 45) + 3] > 0.5f);
  drop_ownership (&before);
  drop_ownership (&after);
  g_object_unref (input);
  g_object_unref (regions);
  g_object_unref (corrections);
}

static void
depth_is_that_of_core (void)
{
  GeglBuffer *input = page_buffer ("Y float", "Y float", levels.data);

  operate ("celdepth:depth-smooth", (Pads) { { input, drawing, scribbles } }, "Y float", result, NULL);
  SAME (depth.data, 1);
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
           "contrast", 2.0, NULL);
  SAME (wanted, 1);
  NEAR (range (wanted, PIXELS), 1, 0);
  celd_palette_clear (&painted);
}

static void
shadows_are_those_of_core (void)
{
  GeglBuffer  *input = page_buffer ("Y float", "Y float", levels.data);
  Pads         pads = { { drawing, input } };
  CeldSettings settings = celd_settings ();
  float       *shadow = malloc (PIXELS * sizeof (float)), *wanted = malloc (4 * PIXELS * sizeof (float));
  CeldPlane    change = { WIDTH, HEIGHT, WIDTH, shadow }, view = { WIDTH, HEIGHT, WIDTH, wanted };
  CeldColours  art = { WIDTH, HEIGHT, WIDTH, wanted };

  settings.shadow_offset = 0.01f;
  settings.light_azimuth = 30;
  CHECK (celd_enhance (&levels, &settings, NULL, &change) == CELD_OK);
  operate ("celdepth:depth-enhance", pads, "RGBA float", result, "shadow-offset", 0.01, "light-azimuth", 30.0, NULL);
  gegl_buffer_get (drawing, NULL, 1, babl_format ("RGBA float"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  CHECK (celd_enhance_colours (&change, &art) == CELD_OK);
  SAME (wanted, 4);
  operate ("celdepth:depth-enhance", pads, "RGBA float", result, "shadow-offset", 0.01, "light-azimuth", 30.0,
           "result", 1, NULL);
  CHECK (celd_enhance_layer (&change, &art) == CELD_OK);
  SAME (wanted, 4);
  operate ("celdepth:depth-enhance", pads, "Y float", result, "shadow-offset", 0.01, "light-azimuth", 30.0,
           "result", 2, NULL);
  CHECK (celd_enhance_view (&levels, &change, &view) == CELD_OK);
  SAME (wanted, 1);
  settings.enhance = CELD_ENHANCE_CONTRAST;
  CHECK (celd_enhance (&levels, &settings, NULL, &change) == CELD_OK);
  CHECK (celd_enhance_view (&levels, &change, &view) == CELD_OK);
  operate ("celdepth:depth-enhance", pads, "Y float", result, "enhance", CELD_ENHANCE_CONTRAST, "result", 2, NULL);
  SAME (wanted, 1);
  free (shadow);
  free (wanted);
  g_object_unref (input);
}

/* All that the operation gives, which must be as large as `like`. */
static void
look (Pads pads, int format, const CeldSettings *settings, const CeldColours *like, float *got)
{
  GeglNode     *graph = gegl_node_new (), *node = add_operation (graph, "celdepth:stereo", pads);
  GeglRectangle whole;

  gegl_node_set (node, "stereo", format, "disparity", (double) settings->disparity, "convergence",
                 (double) settings->convergence, "floating-window", settings->floating_window, NULL);
  whole = gegl_node_get_bounding_box (node);
  CHECK (whole.x == 0 && whole.y == 0 && whole.width == like->width && whole.height == like->height);
  gegl_node_blit (node, 1.0, GEGL_RECTANGLE (0, 0, like->width, like->height), babl_format ("RGBA float"), got,
                  GEGL_AUTO_ROWSTRIDE, GEGL_BLIT_DEFAULT);
  g_object_unref (graph);
}

/* By layers and by depth alone; all arrangements, of which some are larger than the page. */
static void
views_are_those_of_core (void)
{
  GeglBuffer  *deep = page_buffer ("Y float", "Y float", depth.data);
  GeglBuffer  *flats = page_buffer ("Y float", "Y float", levels.data);
  float       *got = malloc (8 * PIXELS * sizeof (float)), *wanted = malloc (8 * PIXELS * sizeof (float));
  CeldSettings settings = celd_settings ();
  CeldColours  art = { WIDTH, HEIGHT, WIDTH, malloc (4 * PIXELS * sizeof (float)) }, view[2] = { art, art };

  gegl_buffer_get (drawing, NULL, 1, babl_format ("RGBA float"), art.data, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  settings.disparity       = 0.05f;
  settings.convergence     = 0.25f;
  settings.floating_window = true;
  for (int layers = 0; layers < 2; layers++)
    {
      Pads       pads = { { drawing, deep, layers ? flats : NULL, layers ? drawing : NULL } };
      CeldScene *scene = NULL;

      CHECK ((layers ? celd_scene_of_levels (&ink, &levels, &depth, &art, CELD_EXPANSION_OUTLINES, NULL, &scene)
                     : celd_scene_of_depth (&art, &ink, &depth, &settings, NULL, &scene)) == CELD_OK);
      for (int eye = 0; eye < 2; eye++)
        {
          view[eye].data = malloc (4 * PIXELS * sizeof (float));
          CHECK (celd_scene_view (scene, celd_camera_eye (2 * eye - 1), &settings, NULL, &view[eye]) == CELD_OK);
        }
      CHECK (celd_stereo_window (&depth, &settings, &view[0], &view[1]) == CELD_OK);
      CHECK (difference (view[0].data, view[1].data, 4 * PIXELS) > 0.5);
      for (int format = 0; format <= (int) CELD_STEREO_DUBOIS; format++)
        {
          CeldColours joined = { WIDTH, HEIGHT, 0, wanted };

          celd_stereo_size ((CeldStereo) format, &joined.width, &joined.height);
          joined.stride = (size_t) joined.width;
          CHECK (celd_stereo_join (&view[0], &view[1], (CeldStereo) format, &joined) == CELD_OK);
          look (pads, format, &settings, &joined, got);
          NEAR (difference (got, wanted, 4 * (size_t) joined.width * (size_t) joined.height), 0, 1e-5);
        }
      celd_scene_free (scene);
      free (view[0].data);
      free (view[1].data);
    }
  operate ("celdepth:stereo", (Pads) { { drawing, drawing } }, "RGBA float", result, "disparity", 0.0, "stereo",
           CELD_STEREO_RIGHT, NULL);
  SAME (art.data, 4);
  free (art.data);
  free (got);
  free (wanted);
  g_object_unref (deep);
  g_object_unref (flats);
}

static void
heights_are_those_of_core (void)
{
  GeglBuffer  *input = page_buffer ("Y float", "Y float", levels.data);
  GeglBuffer  *smooth = page_buffer ("Y float", "Y float", depth.data);
  Pads         pads = { { input, drawing, smooth } }, without = { { input, drawing } };
  CeldSettings settings = celd_settings ();
  CeldRelief   relief = { 0 };

  settings.bulge = 0.5f;
  CHECK (celd_relief (&ink, &levels, &depth, &settings, NULL, &relief) == CELD_OK);
  operate ("celdepth:relief", pads, "Y float", result, "unit", 1, "bulge", 0.5, NULL);
  SAME (relief.z, 1);
  operate ("celdepth:relief", pads, "Y float", result, "bulge", 0.5, NULL);
  NEAR (range (result, PIXELS), 1, 1e-6);
  settings.relief_from  = CELD_RELIEF_NORMALS;
  settings.relief_depth = 0.3f;
  CHECK (celd_relief (&ink, &levels, NULL, &settings, NULL, &relief) == CELD_OK);
  operate ("celdepth:relief", without, "Y float", result, "unit", 1, "bulge", 0.5, "from", CELD_RELIEF_NORMALS,
           "relief-depth", 0.3, NULL);
  SAME (relief.z, 1);
  celd_relief_clear (&relief);
  g_object_unref (input);
  g_object_unref (smooth);
}

static void
light_is_that_of_core (void)
{
  GeglBuffer *input = page_buffer ("Y float", "Y float", levels.data);
  Pads        pads = { { input, drawing } };

  operate ("celdepth:lumo-shade", pads, "Y float", result, "result", 1, NULL);
  SAME (shading.data, 1);
  operate ("celdepth:lumo-shade", pads, "RGB float", result, "result", 2, NULL);
  SAME (stored_normals (false), 3);
  operate ("celdepth:lumo-shade", pads, "RGB float", result, "result", 2, "directx", TRUE, NULL);
  SAME (stored_normals (true), 3);
  operate ("celdepth:lumo-shade", pads, "RGBA float", result, "result", 0, NULL);
  SAME (lit_drawing (), 4);
  g_object_unref (input);
}

/* Every setting, pad and result of light at once. */
static void
all_light_is_that_of_core (void)
{
  static uint8_t painted[4 * PIXELS];
  static float   normal[3 * PIXELS], shine[PIXELS], colour[4 * PIXELS], wanted[4 * PIXELS], ball[4 * 5 * 7];
  GeglBuffer    *input = page_buffer ("Y float", "Y float", levels.data), *deep, *hints;
  GeglBuffer    *art = page_buffer ("R'G'B'A u8", "R'G'B'A u8", colours.data);
  GeglBuffer    *sample = gegl_buffer_new (GEGL_RECTANGLE (3, -2, 5, 7), babl_format ("RGBA float"));
  CeldPaint      paint = { WIDTH, HEIGHT, WIDTH, painted };
  CeldVectors    bent = { WIDTH, HEIGHT, WIDTH, normal };
  CeldPlane      gloss = { WIDTH, HEIGHT, WIDTH, shine }, open = { WIDTH, HEIGHT, WIDTH, shine };
  CeldColours    tone = { WIDTH, HEIGHT, WIDTH, colour }, out = { WIDTH, HEIGHT, WIDTH, wanted };
  CeldColours    matcap = { 5, 7, 5, ball };
  CeldSettings   s = celd_settings ();

  paint_line (painted, 20, 38, 20, 42, 2, 0xffffff);
  for (int i = 0; i < 4 * 5 * 7; i++)
    ball[i] = i % 4 == 3 ? 1 : (float) (i % 11) / 11;
  gegl_buffer_set (sample, NULL, 0, babl_format ("RGBA float"), ball, GEGL_AUTO_ROWSTRIDE);
  deep  = page_buffer ("Y float", "Y float", depth.data);
  hints = page_buffer ("R'G'B'A u8", "R'G'B'A u8", painted);
  s.quilt         = 0.7f;
  s.bevel         = 0.1f;
  s.frame_outline = true;
  s.light         = CELD_LIGHT_POINT;
  s.light_x       = 0.75f;
  s.light_y       = 0.25f;
  s.light_height  = 0.5f;
  s.specular      = 0.5f;
  s.shininess     = 8;
  s.rim_light     = 0.25f;
  s.rim_power     = 2;
  CHECK (celd_normals_hinted (&ink, &levels, &depth, &paint, &s, NULL, &bent) == CELD_OK);
  CHECK (difference (normal, normals.data, 3 * PIXELS) > 0.1);
  for (int model = CELD_MODEL_LAMBERT; model <= CELD_MODEL_MATCAP; model++)
    for (int result_of = 0; result_of <= 4; result_of++)
      {
        if (result_of == 2 || (result_of == 1 && model != CELD_MODEL_MATCAP))
          continue;
        s.light_model = (CeldLightModel) model;
        CHECK (celd_light (&bent, &ink, &matcap, &s, NULL, &tone, &gloss) == CELD_OK);
        operate ("celdepth:lumo-shade", (Pads) { { input, drawing, art, deep, hints, sample } },
                 "RGBA float", result, "result", result_of, "light-model", model, "quilt", 0.7, "bevel", 0.1,
                 "frame-outline", TRUE, "light", CELD_LIGHT_POINT, "light-x", 0.75, "light-y", 0.25,
                 "light-height", 0.5, "specular", 0.5, "shininess", 8.0, "rim-light", 0.25, "rim-power", 2.0, NULL);
        if (result_of == 4)
          CHECK (celd_light_layer (&gloss, &out) == CELD_OK);
        else if (result_of != 3)
          {
            for (int i = 0; i < 4 * PIXELS; i++)
              wanted[i] = 1;
            if (result_of == 0)
              babl_process (babl_fish (babl_format ("R'G'B'A u8"), babl_format ("RGBA float")), colours.data,
                            wanted, PIXELS);
            CHECK (celd_light_colours (&tone, &gloss, &out) == CELD_OK);
          }
        SAME (result_of == 3 ? colour : wanted, 4);
      }
  s = celd_settings ();
  s.shadow_size     = 0.05f;
  s.shadow_strength = 0.9f;
  CHECK (celd_occlusion (&levels, &s, NULL, &open) == CELD_OK);
  operate ("celdepth:lumo-shade", (Pads) { { input, drawing } }, "Y float", result, "result", 5, "shadow-size", 0.05,
           "shadow-strength", 0.9, NULL);
  SAME (shine, 1);
  CHECK (range (shine, PIXELS) > 0.2);
  g_object_unref (input);
  g_object_unref (art);
  g_object_unref (deep);
  g_object_unref (hints);
  g_object_unref (sample);
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

/* The other engine, and the basins without their two extras, reach core as they are set. */
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
  RUN (core_makes_the_page);
  RUN (contours_are_those_of_core);
  RUN (labels_are_those_of_core);
  RUN (order_is_that_of_core);
  RUN (order_takes_a_depth_hint);
  RUN (levels_are_those_of_core);
  RUN (layers_are_the_drawing);
  RUN (matte_is_owner_and_share);
  RUN (corrections_give_ink);
  RUN (depth_is_that_of_core);
  RUN (exact_depth_is_that_of_core);
  RUN (shadows_are_those_of_core);
  RUN (heights_are_those_of_core);
  RUN (views_are_those_of_core);
  RUN (light_is_that_of_core);
  RUN (all_light_is_that_of_core);
  RUN (popup_is_the_steps_of_core);
  RUN (method_is_that_of_core);
  RUN (popup_follows_its_properties);
  RUN (chain_agrees_with_popup);
  RUN (every_depth_of_colour_gives_the_same);
  RUN (colour_is_read_as_luma);
  RUN (small_layers_keep_their_place);
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  drop_page ();
  gegl_exit ();
  return DONE;
}
