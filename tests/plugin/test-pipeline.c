/* The pipeline of the plug-ins on the page of the operations' tests: layers at offsets, in formats of hosts, progress,
 * cancel, and input that makes no sense.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "core-page.h"
#include "pipeline-parts.h"

#define BIT(picture) (1u << CELD_PICTURE_##picture)

static CeldPipelineInput
page_input (void)
{
  CeldPipelineInput input = { WIDTH, HEIGHT, { { NULL, 0, 0, 0 } }, celd_settings (), NULL, NULL };

  input.layer[CELD_LAYER_DRAWING].buffer   = drawing;
  input.layer[CELD_LAYER_SCRIBBLES].buffer = scribbles;
  input.layer[CELD_LAYER_ARROWS].buffer    = arrows;
  return input;
}

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

/* ------------------------------------------------------------------ messages */

/* Whether this input is refused with a message that has these words. */
static bool
refused (const CeldPipelineInput *input, const char *words)
{
  GError       *error = NULL;
  CeldPipeline *pipeline = celd_pipeline_new (input, &error);
  bool          good = pipeline && celd_pipeline_make (pipeline, BIT (DEPTH), NULL, NULL, &error);
  bool          said = error && strstr (error->message, words);

  if (error && !said)
    fprintf (stderr, "%s\n", error->message);
  celd_pipeline_free (pipeline);
  g_clear_error (&error);
  return !good && said;
}

static void
input_without_sense_is_refused (void)
{
  static const float blank[PIXELS];
  CeldPipelineInput  input = page_input ();
  GeglBuffer        *page = page_buffer ("Y' u8", "Y' float", blank);

  input.width = 20001;
  CHECK (refused (&input, "20001 x 80 pixels"));
  input = page_input ();
  input.layer[CELD_LAYER_DRAWING].buffer = NULL;
  CHECK (refused (&input, "no drawing"));
  input.layer[CELD_LAYER_DRAWING].buffer = page;
  CHECK (refused (&input, "has no lines"));
  input = page_input ();
  input.layer[CELD_LAYER_ARROWS].x = WIDTH;
  CHECK (refused (&input, "'Arrows' lies outside the image"));
  input = page_input ();
  input.layer[CELD_LAYER_SCRIBBLES].id    = 7;
  input.layer[CELD_LAYER_CONTOURS].buffer = page; /* of the same layer, opened again */
  input.layer[CELD_LAYER_CONTOURS].id     = 7;
  CHECK (refused (&input, "chosen as 'Scribbles' and as 'Contours'"));
  input = page_input ();
  input.relations = "12,34 < x";
  CHECK (refused (&input, "line 1, column 9"));
  input = page_input ();
  input.arrow_path = "M 12,34";
  CHECK (refused (&input, "path with arrows cannot be read"));
  input = page_input ();
  input.settings.tolerance = 5;
  CHECK (refused (&input, "outside its range"));
  input = page_input ();
  input.layer[CELD_LAYER_SCRIBBLES].buffer = input.layer[CELD_LAYER_ARROWS].buffer = NULL;
  CHECK (refused (&input, "no scribbles and no arrows"));
  g_object_unref (page);
}

static void
other_layers_than_meant_are_refused (void)
{
  static float      grey[PIXELS], colour[3 * PIXELS];
  CeldPipelineInput input = page_input ();
  GeglBuffer       *surface, *photograph, *coloured, *squares, *parts;

  for (int i = 0; i < PIXELS; i++)
    grey[i] = i % WIDTH % 24 < 2 || i / WIDTH % 24 < 2 ? 0 : 1;
  squares = page_buffer ("Y' u8", "Y' float", grey);
  for (int i = 0; i < PIXELS; i++)
    grey[i] = level_at (i);
  parts = page_buffer ("Y' u8", "Y' float", grey);
  for (int i = 0; i < 3 * PIXELS; i++)
    {
      colour[i] = surface_at (i / 3, i % 3);
      grey[i / 3] = surface_at (i / 3, 0);
    }
  surface = page_buffer ("Y' u8", "Y' float", grey);
  photograph = page_buffer ("R'G'B' u8", "R'G'B' float", colour);
  input.layer[CELD_LAYER_DRAWING].buffer = surface;
  CHECK (refused (&input, "the drawing looks like a photograph"));
  input.settings.ink = CELD_INK_DARK; /* who says what the lines are is believed */
  CHECK (!refused (&input, "photograph"));
  input = page_input ();
  input.layer[CELD_LAYER_SCRIBBLES].buffer = photograph;
  CHECK (refused (&input, "the scribbles looks like a photograph"));
  input.layer[CELD_LAYER_SCRIBBLES].buffer = parts;
  CHECK (refused (&input, "the scribbles looks like levels or depth"));
  input.layer[CELD_LAYER_DRAWING].buffer = parts;
  input.layer[CELD_LAYER_SCRIBBLES].buffer = scribbles;
  CHECK (refused (&input, "the drawing looks like levels or depth"));
  input.settings.ink = CELD_INK_DARK;
  CHECK (!refused (&input, "levels or depth"));
  input = page_input ();
  input.layer[CELD_LAYER_SCRIBBLES].buffer = squares;
  CHECK (refused (&input, "chosen as scribbles looks like a drawing"));
  input.layer[CELD_LAYER_DRAWING].buffer = scribbles;
  input.layer[CELD_LAYER_SCRIBBLES].buffer = drawing;
  CHECK (refused (&input, "Exchange them"));
  colour_page (colour);
  coloured = page_buffer ("R'G'B' u8", "R'G'B' float", colour);
  input.layer[CELD_LAYER_SCRIBBLES].buffer = coloured;
  CHECK (refused (&input, "Exchange them"));
  input.layer[CELD_LAYER_DRAWING].buffer = coloured;
  CHECK (refused (&input, "is the same picture as the drawing"));
  input.layer[CELD_LAYER_SCRIBBLES].buffer = scribbles;
  CHECK (!refused (&input, "same picture") && !refused (&input, "Exchange"));
  g_object_unref (coloured);
  g_object_unref (surface);
  g_object_unref (photograph);
  g_object_unref (squares);
  g_object_unref (parts);
}

/* The drawing in place of strokes, also once it takes the place of good ones; its colours may be scribbles. */
static void
drawings_are_no_strokes (void)
{
  static float      colour[3 * PIXELS];
  CeldPipelineInput input = page_input ();
  CeldPipeline     *pipeline = celd_pipeline_new (&input, NULL);
  GeglBuffer       *coloured, *copy = gegl_buffer_dup (drawing);
  GError           *error = NULL;

  colour_page (colour);
  coloured = page_buffer ("R'G'B' u8", "R'G'B' float", colour);
  for (int role = CELD_LAYER_ARROWS; role < CELD_N_LAYERS; role++)
    {
      input = page_input ();
      input.layer[role].buffer = copy;
      CHECK (refused (&input, "has the lines of the drawing"));
      input.layer[role].buffer = coloured;
      CHECK (refused (&input, "has the lines of the drawing"));
      input.settings.flats = true;
      CHECK (!refused (&input, "has the lines of the drawing"));
    }
  input = page_input ();
  input.layer[CELD_LAYER_SCRIBBLES].buffer = coloured;
  CHECK (!refused (&input, "has the lines of the drawing"));
  input.layer[CELD_LAYER_SCRIBBLES].buffer = scribbles;
  input.layer[CELD_LAYER_ARROWS].buffer = copy;
  CHECK (!celd_pipeline_update (pipeline, &input, 1u << CELD_LAYER_ARROWS, &error) &&
         strstr (error->message, "The layer with 'Arrows' has the lines of the drawing"));
  g_clear_error (&error);
  celd_pipeline_free (pipeline);
  g_object_unref (coloured);
  g_object_unref (copy);
}

/* A layer in colours is no depth. */
static void
only_grey_layers_are_depth (void)
{
  CeldPipelineLayer painted = { scribbles, 0, 0, 0 }, drawn = { drawing, 0, 0, 0 };
  GError           *error = NULL;

  CHECK (!celd_pipeline_check_grey (&painted, &error));
  CHECK (error && strstr (error->message, "in colour"));
  g_clear_error (&error);
  CHECK (celd_pipeline_check_grey (&drawn, &error) && !error);
}

/* In any layer but the drawing, where it is paper. */
static void
only_numbers_are_paint (void)
{
  static const char *const names[CELD_N_LAYERS] = { NULL, "'Scribbles'", "'Arrows'", "'Contours'", "'Corrections'",
                                                    "'Hidden'" };
  static float values[4 * PIXELS];
  GeglBuffer  *odd;

  values[4 * (PIXELS / 2)] = INFINITY;
  values[4 * (PIXELS / 2) + 3] = 1;
  odd = page_buffer ("RGBA float", "RGBA float", values);
  for (int role = CELD_LAYER_SCRIBBLES; role < CELD_N_LAYERS; role++)
    {
      CeldPipelineInput input = page_input ();

      input.layer[role].buffer = odd;
      CHECK (refused (&input, names[role]));
      input.settings.flats = true;
      CHECK (refused (&input, "infinite or no number"));
    }
  g_object_unref (odd);
}

/* A layer that has a value which is no number, but for one that alpha hides. */
static void
only_numbers_are_depth (void)
{
  for (int i = 0; i < 2; i++)
    {
      float             pixel[2][4] = { { 1, 1, 1, 1 }, { NAN, NAN, NAN, (float) i } };
      GeglBuffer       *buffer = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 2, 1), babl_format ("RGBA float"));
      CeldPipelineLayer layer = { buffer, 0, 0, 0 };
      GError           *error = NULL;

      gegl_buffer_set (buffer, NULL, 0, babl_format ("RGBA float"), pixel, GEGL_AUTO_ROWSTRIDE);
      CHECK (celd_pipeline_check_grey (&layer, &error) == (i == 0));
      CHECK (!i || (error && strstr (error->message, "infinite or no number")));
      g_clear_error (&error);
      g_object_unref (buffer);
    }
}

static void
problems_are_told (void)
{
  CeldPipelineInput input = page_input ();
  CeldPipeline     *pipeline = celd_pipeline_new (&input, NULL);
  char             *text;

  CHECK (celd_pipeline_make (pipeline, BIT (DEPTH), NULL, NULL, NULL));
  text = celd_pipeline_problems (pipeline);
  CHECK (text == NULL);
  celd_pipeline_free (pipeline);

  input.relations = "90,40 > 45,40"; /* contradicts the arrow */
  pipeline = celd_pipeline_new (&input, NULL);
  CHECK (celd_pipeline_make (pipeline, BIT (DEPTH), NULL, NULL, NULL));
  text = celd_pipeline_problems (pipeline);
  CHECK (text && strstr (text, "line 1, column 1"));
  g_free (text);
  celd_pipeline_free (pipeline);
}

/* What strains the eyes is no problem of what is made after an update without views. */
static void
notes_on_views_end_with_the_next_update (void)
{
  CeldPipelineInput input = page_input ();
  CeldPipeline     *pipeline;
  char             *text;

  input.settings.disparity = 0.1f;
  pipeline = celd_pipeline_new (&input, NULL);
  CHECK (celd_pipeline_view (pipeline, NULL, NULL, NULL));
  text = celd_pipeline_problems (pipeline);
  CHECK (text != NULL);
  g_free (text);
  CHECK (celd_pipeline_update (pipeline, &input, 0, NULL));
  CHECK (celd_pipeline_make (pipeline, BIT (DEPTH), NULL, NULL, NULL));
  text = celd_pipeline_problems (pipeline);
  CHECK (text == NULL);
  g_free (text);
  celd_pipeline_free (pipeline);
}

static gboolean
warns_of_lines (CeldPipeline *pipeline)
{
  char    *text = celd_pipeline_problems (pipeline);
  gboolean warns = text && strstr (text, "hardly has clear lines");

  g_free (text);
  return warns;
}

/* What may be a photograph is used, with a warning, until the artist says what its lines are, or draws it. */
static void
unclear_lines_are_told (void)
{
  static float      faint[PIXELS];
  CeldPipelineInput input = page_input ();
  CeldPipeline     *pipeline;
  GArray           *list;

  for (int i = 0; i < PIXELS; i++)
    faint[i] = faint_at (i);
  input.layer[CELD_LAYER_DRAWING].buffer = page_buffer ("Y' u8", "Y' float", faint);
  pipeline = celd_pipeline_new (&input, NULL);
  CHECK (warns_of_lines (pipeline));
  list = celd_pipeline_problem_list (pipeline);
  CHECK (list->len == 1 && strstr (g_array_index (list, CeldPipelineProblem, 0).text, "hardly has clear lines"));
  g_array_unref (list);
  input.settings.ink = CELD_INK_DARK;
  CHECK (celd_pipeline_update (pipeline, &input, 0, NULL));
  CHECK (celd_pipeline_problems (pipeline) == NULL);
  input.settings.ink = CELD_INK_AUTO;
  CHECK (celd_pipeline_update (pipeline, &input, 0, NULL));
  CHECK (warns_of_lines (pipeline));
  for (int i = 0; i < 2; i++) /* flats need no lines */
    {
      input.settings.flats = !input.settings.flats;
      CHECK (celd_pipeline_update (pipeline, &input, 0, NULL));
      CHECK (warns_of_lines (pipeline) == !input.settings.flats);
    }
  g_object_unref (input.layer[CELD_LAYER_DRAWING].buffer);
  input.layer[CELD_LAYER_DRAWING].buffer = drawing;
  CHECK (celd_pipeline_update (pipeline, &input, 1u << CELD_LAYER_DRAWING, NULL));
  CHECK (celd_pipeline_problems (pipeline) == NULL);
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
  RUN (input_without_sense_is_refused);
  RUN (other_layers_than_meant_are_refused);
  RUN (drawings_are_no_strokes);
  RUN (only_grey_layers_are_depth);
  RUN (only_numbers_are_paint);
  RUN (only_numbers_are_depth);
  RUN (problems_are_told);
  RUN (notes_on_views_end_with_the_next_update);
  RUN (unclear_lines_are_told);
  drop_page ();
  celd_palette_clear (&palette);
  celd_relations_clear (&relations);
  gegl_exit ();
  return DONE;
}
