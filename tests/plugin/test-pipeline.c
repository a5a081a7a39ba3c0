/* The pipeline of the plug-ins on the page of the operations' tests: layers at offsets, in formats of hosts, progress,
 * and cancel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "core-page.h"
#include "pipeline-page.h"

/* One picture of this input in a buffer of this format, read as another. */
static bool
make (const CeldPipelineInput *input, CeldPicture picture, const char *kept, const char *format, void *pixels)
{
  CeldPipeline *pipeline = celd_pipeline_new (input, NULL);
  GeglBuffer   *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format (kept));
  bool          good = pipeline && celd_pipeline_make (pipeline, 1u << picture, NULL, NULL, NULL) &&
                       celd_pipeline_write (pipeline, picture, buffer, NULL);

  gegl_buffer_get (buffer, NULL, 1, babl_format (format), pixels, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  g_object_unref (buffer);
  celd_pipeline_free (pipeline);
  return good;
}

static void
pictures_are_those_of_core (void)
{
  CeldPipelineInput input = page_input ();
  static uint8_t    painted[4 * PIXELS];

  CHECK (make (&input, CELD_PICTURE_REGIONS, "R'G'B'A u8", "R'G'B'A u8", painted));
  CHECK (!memcmp (painted, colours.data, sizeof painted));
  CHECK (make (&input, CELD_PICTURE_LEVELS, "Y float", "Y float", result));
  SAME (levels.data, 1);
  CHECK (make (&input, CELD_PICTURE_DEPTH, "Y float", "Y float", result));
  SAME (depth.data, 1);
  CHECK (make (&input, CELD_PICTURE_SHADING, "Y float", "Y float", result));
  SAME (shading.data, 1);
}

/* Whatever the buffer is encoded as, its numbers are the normals; depth is linear light. */
static void
numbers_of_normals_are_those_of_the_buffer (void)
{
  CeldPipelineInput input = page_input ();
  static uint8_t    bytes[3 * PIXELS];
  const float      *stored = stored_normals (false);
  int               most = 0;

  CHECK (make (&input, CELD_PICTURE_NORMALS, "RGB float", "RGB float", result));
  SAME (stored, 3);
  CHECK (make (&input, CELD_PICTURE_NORMALS, "R'G'B'A float", "R'G'B' float", result));
  SAME (stored, 3);
  CHECK (make (&input, CELD_PICTURE_NORMALS, "R'G'B' u8", "R'G'B' u8", bytes));
  for (int i = 0; i < 3 * PIXELS; i++)
    most = MAX (most, abs (bytes[i] - (int) lrintf (255 * stored[i])));
  CHECK (most <= 1);
  CHECK (make (&input, CELD_PICTURE_DEPTH, "R'G'B'A float", "Y float", result));
  SAME (depth.data, 1);
}

/* A part of a layer, and its offset, is the layer where nothing else is painted. */
static void
layers_may_be_smaller_than_the_image (void)
{
  CeldPipelineInput input = page_input ();
  GeglBuffer       *part = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 60, 30), babl_format ("R'G'B'A u8"));
  GeglBuffer       *larger = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH + 20, HEIGHT + 9), babl_format ("R'G'B'A u8"));

  gegl_buffer_copy (arrows, GEGL_RECTANGLE (40, 35, 60, 30), GEGL_ABYSS_NONE, part, GEGL_RECTANGLE (0, 0, 0, 0));
  gegl_buffer_copy (scribbles, NULL, GEGL_ABYSS_NONE, larger, GEGL_RECTANGLE (13, 5, 0, 0));
  input.layer[CELD_LAYER_ARROWS]    = (CeldPipelineLayer) { part, 40, 35, 0 };
  input.layer[CELD_LAYER_SCRIBBLES] = (CeldPipelineLayer) { larger, -13, -5, 0 };
  CHECK (make (&input, CELD_PICTURE_DEPTH, "Y float", "Y float", result));
  SAME (depth.data, 1);
  input.layer[CELD_LAYER_ARROWS].x = 0; /* there the arrow points elsewhere */
  CHECK (make (&input, CELD_PICTURE_DEPTH, "Y float", "Y float", result));
  CHECK (difference (result, depth.data, PIXELS) > 0.1);
  g_object_unref (part);
  g_object_unref (larger);
}

static void
relations_count_as_arrows_do (void)
{
  CeldPipelineInput input = page_input ();

  input.layer[CELD_LAYER_ARROWS].buffer = NULL;
  input.relations = "45,48 > 90,48";
  CHECK (make (&input, CELD_PICTURE_LEVELS, "Y float", "Y float", result));
  SAME (levels.data, 1);
}

/* Beside painted arrows, which point the same way here and do not contradict. */
static void
paths_count_as_arrows_do (void)
{
  CeldPipelineInput input = page_input ();

  input.arrow_path = "M 45,48 C 50,10 70,60 90,48";
  CHECK (make (&input, CELD_PICTURE_LEVELS, "Y float", "Y float", result));
  SAME (levels.data, 1);
  input.layer[CELD_LAYER_ARROWS].buffer = NULL;
  CHECK (make (&input, CELD_PICTURE_LEVELS, "Y float", "Y float", result));
  SAME (levels.data, 1);
  input.arrow_path = "M 90,48 L 45,48";
  CHECK (make (&input, CELD_PICTURE_LEVELS, "Y float", "Y float", result));
  CHECK (difference (result, levels.data, PIXELS) > 0.1);
}

/* ------------------------------------------------------------------ precision */

#define PART_X 40
#define PART_Y 20

/* The numbers of a part of depth, refined; how many were. */
static gsize
refine (CeldPipeline *pipeline, GeglBuffer *part)
{
  CeldPipelineLayer layer = { part, PART_X, PART_Y, 0 };
  CeldPlane         numbers = { WIDTH, HEIGHT, WIDTH, result };
  gsize             refined = 0;

  gegl_buffer_get (part, GEGL_RECTANGLE (-PART_X, -PART_Y, WIDTH, HEIGHT), 1, babl_format ("Y float"), result,
                   GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  CHECK (celd_pipeline_refine (pipeline, CELD_PICTURE_DEPTH, &layer, &numbers, &refined) == CELD_OK);
  return refined;
}

/* Depth of 8 bits becomes exact again, but for what was painted over; and there is none outside the layer. */
static void
few_bits_get_all_precision_but_where_they_are_painted (void)
{
  CeldPipelineInput input = page_input ();
  CeldPipeline     *pipeline = celd_pipeline_new (&input, NULL);
  GeglBuffer       *whole = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("R'G'B' u8"));
  GeglBuffer       *part = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 50, 30), babl_format ("R'G'B' u8"));
  float             paint = 0.25f;

  CHECK (celd_pipeline_make (pipeline, BIT (DEPTH), NULL, NULL, NULL));
  CHECK (celd_pipeline_write (pipeline, CELD_PICTURE_DEPTH, whole, NULL));
  gegl_buffer_copy (whole, GEGL_RECTANGLE (PART_X, PART_Y, 50, 30), GEGL_ABYSS_NONE, part, GEGL_RECTANGLE (0, 0, 0, 0));
  for (int painted = 0; painted < 2; painted++)
    {
      gsize same = 0, outside = 0;

      if (painted)
        gegl_buffer_set (part, GEGL_RECTANGLE (7, 9, 1, 1), 0, babl_format ("Y float"), &paint, GEGL_AUTO_ROWSTRIDE);
      CHECK (refine (pipeline, part) == 50 * 30 - (gsize) painted);
      for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
          if (x < PART_X || x >= PART_X + 50 || y < PART_Y || y >= PART_Y + 30)
            outside += result[y * WIDTH + x] == 0;
          else
            same += result[y * WIDTH + x] == depth.data[y * WIDTH + x];
      CHECK (same == 50 * 30 - (gsize) painted && outside == PIXELS - 50 * 30);
    }
  NEAR (result[(PART_Y + 9) * WIDTH + PART_X + 7], paint, 4e-3);
  g_object_unref (part);
  g_object_unref (whole);
  celd_pipeline_free (pipeline);
}

/* ------------------------------------------------------------------ progress */

typedef struct { double last; int calls, most; } Watch;

static gboolean
watch (gpointer data, double done, const char *step)
{
  Watch *w = data;

  CHECK (done >= w->last && done <= 1);
  CHECK (step && *step);
  w->last = done;
  return ++w->calls < w->most;
}

static void
progress_rises_and_cancels (void)
{
  CeldPipelineInput input = page_input ();
  CeldPipeline     *pipeline = celd_pipeline_new (&input, NULL);
  Watch             all = { 0, 0, G_MAXINT }, some = { 0, 0, 1 };
  GError           *error = NULL;

  CHECK (!celd_pipeline_make (pipeline, BIT (LIT), watch, &some, &error));
  CHECK (g_error_matches (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_CANCELLED));
  CHECK (some.calls == 1);
  g_clear_error (&error);
  CHECK (celd_pipeline_make (pipeline, BIT (LIT) | BIT (DEPTH), watch, &all, &error)); /* goes on after a cancel */
  CHECK (all.calls > 5 && all.last > 0.9);
  all.last = 0;
  CHECK (celd_pipeline_view (pipeline, watch, &all, &error));
  CHECK (all.last > 0.99);
  celd_pipeline_free (pipeline);
}

/* ------------------------------------------------------------------ views */

static double
pixel_difference (GeglBuffer *a, GeglBuffer *b, int width)
{
  static float first[8 * PIXELS], second[8 * PIXELS];

  gegl_buffer_get (a, GEGL_RECTANGLE (0, 0, width, HEIGHT), 1, babl_format ("RGBA float"), first, GEGL_AUTO_ROWSTRIDE,
                   GEGL_ABYSS_NONE);
  gegl_buffer_get (b, GEGL_RECTANGLE (0, 0, width, HEIGHT), 1, babl_format ("RGBA float"), second, GEGL_AUTO_ROWSTRIDE,
                   GEGL_ABYSS_NONE);
  return difference (first, second, 4 * (gsize) width * HEIGHT);
}

/* Without distance between the eyes both see the drawing; with it they see different pictures, which lie side by
 * side. */
static void
views_are_those_of_two_eyes (void)
{
  GeglBuffer *view[4];

  for (int i = 0; i < 4; i++)
    {
      CeldPipelineInput input = page_input ();
      CeldPipeline     *pipeline;

      input.settings.disparity = i ? 0.05f : 0;
      pipeline = celd_pipeline_new (&input, NULL);
      view[i] = gegl_buffer_new (GEGL_RECTANGLE (0, 0, i == 3 ? 2 * WIDTH : WIDTH, HEIGHT), babl_format ("RGBA float"));
      CHECK (!celd_pipeline_write_views (pipeline, CELD_STEREO_LEFT, view[i], NULL)); /* not made */
      CHECK (celd_pipeline_view (pipeline, NULL, NULL, NULL));
      CHECK (celd_pipeline_write_views (pipeline, i < 2 ? CELD_STEREO_LEFT : i == 2 ? CELD_STEREO_RIGHT
                                                                                  : CELD_STEREO_SIDE_BY_SIDE,
                                        view[i], NULL));
      celd_pipeline_free (pipeline);
    }
  NEAR (pixel_difference (view[0], drawing, WIDTH), 0, 1e-3);
  CHECK (pixel_difference (view[1], drawing, WIDTH) > 0.5);
  CHECK (pixel_difference (view[1], view[2], WIDTH) > 0.5);
  NEAR (pixel_difference (view[3], view[1], WIDTH), 0, 1e-6);
  for (int i = 0; i < 4; i++)
    g_object_unref (view[i]);
}

/* One for each region, from the back; over each other they are the drawing. */
static void
layers_are_the_drawing_again (void)
{
  static const char *const names[] = { "#0000ff", "#00ff00", "#ff0000" };
  static float             seen[4 * PIXELS], layer[4 * PIXELS], art[4 * PIXELS];
  CeldPipelineInput        input = page_input ();
  CeldPipeline            *pipeline = celd_pipeline_new (&input, NULL);
  Watch                    all = { 0, 0, G_MAXINT };

  CHECK (celd_pipeline_n_layers (pipeline) == 0);
  CHECK (celd_pipeline_cut (pipeline, 32, watch, &all, NULL));
  CHECK (celd_pipeline_n_layers (pipeline) == 3);
  for (gsize i = 0; i < celd_pipeline_n_layers (pipeline); i++)
    {
      GeglRectangle box = celd_pipeline_layer_box (pipeline, i);
      GeglBuffer   *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, box.width, box.height), babl_format ("RGBA float"));
      char         *name = celd_pipeline_layer_name (pipeline, i);

      CHECK (!strcmp (name, names[i]));
      CHECK (celd_pipeline_write_layer (pipeline, i, buffer, NULL));
      gegl_buffer_get (buffer, GEGL_RECTANGLE (-box.x, -box.y, WIDTH, HEIGHT), 1, babl_format ("RGBA float"), layer,
                       GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
      for (int k = 0; k < 4 * PIXELS; k += 4)
        for (int c = 0; c < 3; c++)
          seen[k + c] = layer[k + 3] * layer[k + c] + (1 - layer[k + 3]) * seen[k + c];
      g_object_unref (buffer);
      g_free (name);
    }
  gegl_buffer_get (drawing, NULL, 1, babl_format ("RGBA float"), art, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  for (int k = 3; k < 4 * PIXELS; k += 4)
    seen[k] = art[k];
  NEAR (difference (seen, art, 4 * PIXELS), 0, 1e-4);
  celd_pipeline_free (pipeline);
}

int
main (void)
{
  gegl_init (NULL, NULL);
  make_page ();
  RUN (core_makes_all_results_of_the_page);
  RUN (pictures_are_those_of_core);
  RUN (numbers_of_normals_are_those_of_the_buffer);
  RUN (layers_may_be_smaller_than_the_image);
  RUN (relations_count_as_arrows_do);
  RUN (paths_count_as_arrows_do);
  RUN (few_bits_get_all_precision_but_where_they_are_painted);
  RUN (progress_rises_and_cancels);
  RUN (views_are_those_of_two_eyes);
  RUN (layers_are_the_drawing_again);
  drop_page ();
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  gegl_exit ();
  return DONE;
}
