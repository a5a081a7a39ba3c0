/* What the pipeline of the plug-ins says: input that makes no sense is refused, and problems are told.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-page.h"

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
  gegl_exit ();
  return DONE;
}
