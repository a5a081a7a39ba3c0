/* Operations that use depth (light, shadows, views, heights) have the results of the steps of core.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "core-page.h"

#include <locale.h>

/* The drawing in linear light, lit as by default. */
static const float *
lit_drawing (void)
{
  static float lit[4 * PIXELS], colour[4 * PIXELS], shine[PIXELS];
  const Babl  *fish = babl_fish (babl_format ("Y' float"), babl_format ("RGBA float"));
  CeldColours  art = { WIDTH, HEIGHT, WIDTH, lit }, tone = { WIDTH, HEIGHT, WIDTH, colour };
  CeldPlane    gloss = { WIDTH, HEIGHT, WIDTH, shine };
  CeldSettings settings = celd_settings ();

  babl_process (fish, page_luma, lit, PIXELS);
  CHECK (celd_light (&normals, &ink, &levels, NULL, &settings, NULL, &tone, &gloss) == CELD_OK);
  CHECK (celd_light_colours (&tone, &gloss, &art) == CELD_OK);
  return lit;
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

      CHECK ((layers ? celd_scene_of_levels (&ink, &levels, &depth, &art, &settings, NULL, &scene)
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

/* A red square behind the left disc, which is nearest, and in front of the right one. */
static void
compositions_are_those_of_core (void)
{
  enum { SIDE = 20 };
  static float  red[4 * SIDE * SIDE], blank[SIDE * SIDE], wanted[4 * PIXELS], own[4 * PIXELS], stacked[PIXELS];
  CeldColours   art = { WIDTH, HEIGHT, WIDTH, own }, square = { SIDE, SIDE, SIDE, red };
  CeldColours   picture = { WIDTH, HEIGHT, WIDTH, wanted };
  CeldPlane     paper = { SIDE, SIDE, SIDE, blank }, one = { SIDE, SIDE, SIDE, (float[SIDE * SIDE]) { 0 } };
  CeldPlane     made = { WIDTH, HEIGHT, WIDTH, stacked };
  CeldLevelArt  piece[2] = { { &art, &ink, &levels }, { &square, &paper, &one } };
  CeldPlacement placement = { 52, 28, 1.25, 30, true };
  GeglBuffer   *input = page_buffer ("Y float", "Y float", levels.data);
  GeglBuffer   *second = gegl_buffer_new (GEGL_RECTANGLE (7, -3, SIDE, SIDE), babl_format ("RGBA float"));
  const float  *pixel;

  for (int p = 0; p < SIDE * SIDE; p++)
    {
      memcpy (red + 4 * p, (float[]) { 1, 0, 0, 1 }, 4 * sizeof (float));
      blank[p] = 1;
    }
  gegl_buffer_set (second, NULL, 0, babl_format ("RGBA float"), red, GEGL_AUTO_ROWSTRIDE);
  gegl_buffer_get (drawing, NULL, 1, babl_format ("RGBA float"), own, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  CHECK (celd_compose_levels (piece, &placement, 0.6f, NULL, &picture, &made) == CELD_OK);
  operate ("celdepth:compose", (Pads) { { drawing, input, second } }, "RGBA float", result, "between", 0.6, "x", 52.0,
           "y", 28.0, "scale", 1.25, "turn", 30.0, "flip", TRUE, NULL);
  NEAR (difference (result, wanted, 4 * PIXELS), 0, 1e-3);
  pixel = result + 4 * (40 * WIDTH + 74);
  CHECK (pixel[0] == 1 && pixel[1] == 0);
  pixel = result + 4 * (40 * WIDTH + 62);
  CHECK (pixel[0] == 1 && pixel[1] == 1); /* the paper of the left disc */
  operate ("celdepth:compose", (Pads) { { drawing, input, second } }, "Y float", result, "between", 0.6, "x", 52.0,
           "y", 28.0, "scale", 1.25, "turn", 30.0, "flip", TRUE, "result", 1, NULL);
  SAME (stacked, 1);
  NEAR (result[40 * WIDTH + 74], 2.0 / 3, 1e-6);
  NEAR (result[40 * WIDTH + 62], 1, 1e-6);
  NEAR (result[40 * WIDTH + 95], 1.0 / 3, 1e-6);
  operate ("celdepth:compose", (Pads) { { drawing, input, second } }, "RGBA float", result, "x", 52.0, "y", 28.0, NULL);
  CHECK (result[4 * (40 * WIDTH + 62) + 1] == 0); /* in front of all */
  g_object_unref (input);
  g_object_unref (second);
}

static void
heights_are_those_of_core (void)
{
  GeglBuffer  *input = page_buffer ("Y float", "Y float", levels.data);
  GeglBuffer  *smooth = page_buffer ("Y float", "Y float", depth.data);
  Pads         pads = { { input, drawing, smooth } }, without = { { input, drawing } };
  CeldSettings settings = celd_settings ();
  CeldRelief   relief = { 0 };

  settings.relief_bulge = 0.5f;
  CHECK (celd_relief (&ink, NULL, &levels, &depth, &settings, NULL, &relief) == CELD_OK);
  operate ("celdepth:relief", pads, "Y float", result, "unit", 1, "relief-bulge", 0.5, NULL);
  SAME (relief.z, 1);
  operate ("celdepth:relief", pads, "Y float", result, "relief-bulge", 0.5, NULL);
  NEAR (range (result, PIXELS), 1, 1e-6);
  settings.relief_from  = CELD_RELIEF_NORMALS;
  settings.relief_depth = 0.3f;
  CHECK (celd_relief (&ink, NULL, &levels, NULL, &settings, NULL, &relief) == CELD_OK);
  operate ("celdepth:relief", without, "Y float", result, "unit", 1, "relief-bulge", 0.5, "relief-from", CELD_RELIEF_NORMALS,
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
  s.creases         = 0.7f;
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
  CHECK (celd_normals_hinted (&ink, NULL, &levels, &depth, &paint, &s, NULL, &bent) == CELD_OK);
  CHECK (difference (normal, normals.data, 3 * PIXELS) > 0.1);
  for (int model = CELD_MODEL_LAMBERT; model <= CELD_MODEL_MATCAP; model++)
    for (int result_of = 0; result_of <= 4; result_of++)
      {
        if (result_of == 2 || (result_of == 1 && model != CELD_MODEL_MATCAP))
          continue;
        s.light_model = (CeldLightModel) model;
        CHECK (celd_light (&bent, &ink, &levels, &matcap, &s, NULL, &tone, &gloss) == CELD_OK);
        operate ("celdepth:lumo-shade", (Pads) { { input, drawing, art, deep, hints, sample } },
                 "RGBA float", result, "result", result_of, "light-model", model, "creases", 0.7, "bevel", 0.1,
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

int
main (int argc, char **argv)
{
  setlocale (LC_ALL, "");
  gegl_init (&argc, &argv);
  make_page ();
  RUN (core_makes_all_results_of_the_page);
  RUN (shadows_are_those_of_core);
  RUN (compositions_are_those_of_core);
  RUN (heights_are_those_of_core);
  RUN (views_are_those_of_core);
  RUN (light_is_that_of_core);
  RUN (all_light_is_that_of_core);
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  drop_page ();
  gegl_exit ();
  return DONE;
}
