/* When something is wrong, one message names the cause, and the output is the input.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "listen.h"
#include "page.h"

static float result[4 * PIXELS], input_light[4 * PIXELS];

/* Checks a call that must fail with one message, without a warning, and with the input as output. */
#define PASSES_THROUGH() \
  do { \
    CHECK (times_said == 1); \
    CHECK (warnings == 0); \
    NEAR (difference (result, input_light, 4 * PIXELS), 0, 1e-6); \
  } while (0)

static void
missing_pads_are_named (void)
{
  static const struct { const char *operation, *pad; } cases[] = {
    { "celdepth:virtual-contours", "Contours" }, { "celdepth:depth-expand", "Drawing" },
    { "celdepth:depth-smooth", "Drawing" }, { "celdepth:lumo-shade", "Drawing" },
    { "celdepth:depth-enhance", "Levels" }, { "celdepth:relief", "Drawing" }, { "celdepth:stereo", "Depth" },
    { "celdepth:arap-register", "Target" }, { "celdepth:depth-propagate", "Drawing before" },
    { "celdepth:compose", "Levels" },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (cases); i++)
    {
      be_quiet ();
      operate (cases[i].operation, (Pads) { { drawing } }, "RGBA float", result, NULL);
      PASSES_THROUGH ();
      CHECK (SAYS (cases[i].pad));
    }
}

static void
missing_scribbles_and_arrows_are_reported (void)
{
  be_quiet ();
  operate ("celdepth:lazybrush-segment", (Pads) { { drawing } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("scribble"));
  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Pop-up: ") && SAYS ("scribble"));
  be_quiet ();
  operate ("celdepth:depth-exact", (Pads) { { drawing } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Depth Exact: ") && SAYS ("scribble"));
}

/* Scribbles of the drawing before, in one of two forms, and relations that can be read. */
static void
propagation_needs_something_to_carry (void)
{
  Pads pads = { { drawing, drawing } };

  for (int flats = 0; flats < 2; flats++)
    {
      be_quiet ();
      operate ("celdepth:depth-propagate", pads, "RGBA float", result, "flats", flats, NULL);
      PASSES_THROUGH ();
      CHECK (SAYS ("Depth Propagate: ") && SAYS ("scribble"));
    }
  pads.pad[2] = scribbles;
  be_quiet ();
  operate ("celdepth:depth-propagate", pads, "RGBA float", result, "relations", "1,1 >", NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("line 1"));
  be_quiet ();
  operate ("celdepth:depth-propagate", pads, "RGBA float", result, "relations", "#ff0000 > #00ff00 > #ff0000", NULL);
  CHECK (times_said == 1 && SAYS ("contradicts"));
  CHECK (difference (result, input_light, 4 * PIXELS) > 0.1);
}

/* Parts, and handles that can be read and suit them. */
static void
deformation_says_what_is_wrong (void)
{
  static const struct { const char *handles, *says[2]; gboolean fails; } cases[] = {
    { "45,40 ->", { "line 1, column 9", "120,80 -> 200,60" }, TRUE },
    { "45,40; 2000000,2", { "handle", "between -1000000 and 1000000" }, TRUE },
    { "45,40; 3,3", { "1 handle lies outside", "3,3" }, FALSE },
    { "30,40; 60,40 -> 110,40", { "stretched to", "times its length" }, FALSE },
    { "25,40; 45,40 -> 0,40; 65,40", { "folded over in", "around" }, FALSE },
    { "45,40 -> 50,40", { "", "" }, FALSE },
  };
  Pads pads = { { drawing } };

  be_quiet ();
  operate ("celdepth:arap-deform", pads, "RGBA float", result, "handles", "45,40 -> 50,40", NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("'Levels'") && SAYS ("'Scribbles'"));
  pads.pad[4] = scribbles;
  for (size_t i = 0; i < G_N_ELEMENTS (cases); i++)
    {
      be_quiet ();
      operate ("celdepth:arap-deform", pads, "RGBA float", result, "handles", cases[i].handles, NULL);
      CHECK (warnings == 0 && times_said == (cases[i].says[0][0] != 0));
      CHECK (SAYS (cases[i].says[0]) && SAYS (cases[i].says[1]));
      if (cases[i].fails)
        PASSES_THROUGH ();
      else
        CHECK (difference (result, input_light, 4 * PIXELS) > (i == 2 ? -1 : 0.1));
    }
}

/* A matcap may have any size and place.  A ball that is all like its middle, here black, changes nothing. */
static void
a_missing_matcap_is_reported (void)
{
  GeglBuffer *ball = gegl_buffer_new (GEGL_RECTANGLE (-500, 900, 3, 4), babl_format ("RGBA float"));

  be_quiet ();
  operate ("celdepth:lumo-shade", (Pads) { { drawing, drawing } }, "RGBA float", result, "light-model",
           CELD_MODEL_MATCAP, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Matcap") && SAYS ("aux5"));
  be_quiet ();
  operate ("celdepth:lumo-shade", (Pads) { { drawing, drawing, NULL, NULL, NULL, ball } }, "RGBA float", result,
           "light-model", CELD_MODEL_MATCAP, NULL);
  CHECK (times_said == 0 && warnings == 0);
  NEAR (difference (result, input_light, 4 * PIXELS), 0, 1e-6);
  g_object_unref (ball);
}

/* The second picture may have any size and place, but its levels must have the same. */
static void
a_second_picture_has_levels_of_its_size (void)
{
  GeglBuffer *art = gegl_buffer_new (GEGL_RECTANGLE (-50, 900, 30, 4), babl_format ("RGBA float"));
  GeglBuffer *levels = gegl_buffer_new (GEGL_RECTANGLE (-50, 900, 30, 5), babl_format ("Y float"));

  be_quiet ();
  operate ("celdepth:compose", (Pads) { { drawing, drawing } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Second art") && SAYS ("aux2"));
  be_quiet ();
  operate ("celdepth:compose", (Pads) { { drawing, drawing, art, levels } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("30 x 5 pixels at -50, 900") && SAYS ("30 x 4"));
  be_quiet ();
  operate ("celdepth:compose", (Pads) { { drawing, drawing, art } }, "RGBA float", result, NULL);
  CHECK (times_said == 0 && warnings == 0);
  NEAR (difference (result, input_light, 4 * PIXELS), 0, 1e-4); /* it is transparent */
  g_object_unref (art);
  g_object_unref (levels);
}

/* With too much disparity there is a result and a message. */
static void
strain_of_the_eyes_is_reported (void)
{
  be_quiet ();
  operate ("celdepth:stereo", (Pads) { { drawing, drawing } }, "RGBA float", result, "disparity", 0.1, "screen-width",
           3000.0, NULL);
  CHECK (difference (result, input_light, 4 * PIXELS) > 0.1);
  CHECK (SAYS ("Stereo: ") && SAYS ("disparity of 0.03") && SAYS ("3000 mm") && SAYS ("150 mm"));
  be_quiet ();
  operate ("celdepth:stereo", (Pads) { { drawing, drawing } }, "RGBA float", result, "convergence", 1.0, NULL);
  CHECK (times_said == 0 && warnings == 0);
}

/* Strokes in a colour that no region has, or without regions, are errors; a layer without strokes is not. */
static void
corrections_of_unknown_colours_are_errors (void)
{
  GeglBuffer *blank = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH, HEIGHT), babl_format ("R'G'B'A u8"));

  be_quiet ();
  operate ("celdepth:depth-expand", (Pads) { { drawing, drawing, scribbles, arrows } }, "RGBA float", result,
           "result", 2, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Corrections") && SAYS ("colour"));
  be_quiet ();
  operate ("celdepth:depth-expand", (Pads) { { drawing, drawing, NULL, scribbles } }, "RGBA float", result,
           "result", 2, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Corrections") && SAYS ("aux2"));
  be_quiet ();
  operate ("celdepth:depth-expand", (Pads) { { drawing, drawing, scribbles, blank } }, "Y float", result, NULL);
  CHECK (times_said == 0 && warnings == 0);
  g_object_unref (blank);
}

static void
unreadable_relations_are_located (void)
{
  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing, scribbles } }, "RGBA float", result,
           "relations", "45,40 > 90,40\n45,40 >> 90,40", NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("line 2") && SAYS ("column 8"));
  be_quiet ();
  operate ("celdepth:depth-order", (Pads) { { drawing } }, "RGBA float", result, "relations", "red > green", NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("line 1"));
}

static void
unreadable_arrow_paths_are_located (void)
{
  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing, scribbles } }, "RGBA float", result,
           "arrow-path", "M 45,40 L 90,40\nM 45,40 L 90", NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("arrow path") && SAYS ("line 2") && SAYS ("column 13"));
  be_quiet ();
  operate ("celdepth:depth-order", (Pads) { { drawing } }, "RGBA float", result, "arrow-path", "45,40", NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("line 1, column 1"));
}

static void
layers_outside_the_picture_are_errors (void)
{
  GeglBuffer *elsewhere = gegl_buffer_new (GEGL_RECTANGLE (500, 0, 10, 10), babl_format ("R'G'B'A u8"));
  GeglBuffer *empty = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 0, 0), babl_format ("R'G'B'A u8"));

  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing, elsewhere } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Scribbles") && SAYS ("outside"));
  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing, scribbles, empty } }, "RGBA float", result, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("Arrows") && SAYS ("empty"));
  g_object_unref (empty);
  g_object_unref (elsewhere);
}

/* Such layers are used at their place, with a message. */
static void
layers_of_another_size_are_reported (void)
{
  GeglBuffer *narrow = gegl_buffer_new (GEGL_RECTANGLE (0, 0, WIDTH - 1, HEIGHT), babl_format ("R'G'B'A u8"));

  gegl_buffer_copy (scribbles, GEGL_RECTANGLE (0, 0, WIDTH - 1, HEIGHT), GEGL_ABYSS_NONE, narrow, NULL);
  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing, narrow } }, "RGBA float", result, NULL);
  CHECK (difference (result, input_light, 4 * PIXELS) > 0.1);
  CHECK (times_said == 1 && SAYS ("Scribbles") && SAYS ("the picture's size") && SAYS ("for this layer and for the one"));
  g_object_unref (narrow);
}

/* A dialog of GIMP that has just opened: its pickers are sources without a buffer. */
static void
empty_layer_pickers_are_no_error (void)
{
  GeglNode *graph = gegl_node_new (), *picker = gegl_node_new_child (graph, "operation", "gegl:buffer-source", NULL);
  GeglNode *popup = add_operation (graph, "celdepth:popup", (Pads) { { drawing } });
  GeglNode *expand = add_operation (graph, "celdepth:depth-expand", (Pads) { { drawing } });
  GeglNode *chosen = add_operation (graph, "celdepth:popup", (Pads) { { drawing, scribbles } });

  be_quiet ();
  join (picker, popup, "aux");
  join (picker, popup, "aux2");
  get_output (popup, "RGBA float", result);
  NEAR (difference (result, input_light, 4 * PIXELS), 0, 1e-6);
  join (picker, expand, "aux");
  get_output (expand, "RGBA float", result);
  NEAR (difference (result, input_light, 4 * PIXELS), 0, 1e-6);
  join (picker, chosen, "aux2");
  get_output (chosen, "RGBA float", result);
  CHECK (difference (result, input_light, 4 * PIXELS) > 0.1);
  CHECK (times_said == 0 && warnings == 0);
  g_object_unref (graph);
}

static void
settings_out_of_range_are_errors (void)
{
  be_quiet ();
  operate ("celdepth:popup", (Pads) { { drawing, scribbles } }, "RGBA float", result,
           "encoding", CELD_ENCODING_FIXED, "near-level", 1.0, "far-level", 2.0, NULL);
  PASSES_THROUGH ();
  CHECK (SAYS ("setting"));
}

static void
an_infinite_input_is_an_error (void)
{
  GeglNode *graph = gegl_node_new (), *node = add_operation (graph, "celdepth:popup", (Pads) { { NULL, scribbles } });
  GeglNode *endless = gegl_node_new_child (graph, "operation", "gegl:color", NULL);

  be_quiet ();
  join (endless, node, "input");
  get_output (node, "RGBA float", result);
  CHECK (times_said == 1 && SAYS ("Crop"));
  CHECK (warnings == 0);
  g_object_unref (graph);
}

static void
empty_and_single_pixel_pictures_are_handled (void)
{
  static const char *const operations[] = {
    "celdepth:virtual-contours", "celdepth:lazybrush-segment", "celdepth:depth-order", "celdepth:depth-expand",
    "celdepth:depth-smooth", "celdepth:depth-exact", "celdepth:lumo-shade", "celdepth:depth-enhance",
    "celdepth:relief", "celdepth:arap-register", "celdepth:popup",
  };
  GeglBuffer              *empty = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 0, 0), babl_format ("R'G'B'A u8"));
  GeglBuffer              *pixel = gegl_buffer_new (GEGL_RECTANGLE (0, 0, 1, 1), babl_format ("R'G'B'A u8"));

  be_quiet ();
  for (size_t i = 0; i < G_N_ELEMENTS (operations); i++)
    {
      operate (operations[i], (Pads) { { empty, empty } }, "RGBA float", result, NULL);
      operate (operations[i], (Pads) { { pixel, pixel } }, "RGBA float", result, NULL);
      operate (operations[i], (Pads) { { drawing, empty } }, "RGBA float", result, NULL);
      operate (operations[i], (Pads) { { NULL, scribbles } }, "RGBA float", result, NULL);
    }
  CHECK (warnings == 0);
  g_object_unref (empty);
  g_object_unref (pixel);
}

static void
nan_and_infinity_are_handled (void)
{
  static float poisoned[4 * PIXELS];
  GeglBuffer  *bad;
  int          strange = 0;

  for (int i = 0; i < 4 * PIXELS; i++)
    poisoned[i] = i % 7 == 0 ? NAN : i % 11 == 0 ? INFINITY : i % 13 == 0 ? -5.f : page_luma[i / 4];
  bad = page_buffer ("RGBA float", "RGBA float", poisoned);
  be_quiet ();
  operate ("celdepth:depth-expand", (Pads) { { bad, bad } }, "Y float", result, NULL);
  operate ("celdepth:depth-smooth", (Pads) { { bad, drawing, scribbles } }, "Y float", result, NULL);
  operate ("celdepth:popup", (Pads) { { bad, scribbles, arrows } }, "Y float", result, NULL);
  for (int i = 0; i < PIXELS; i++)
    strange += !isfinite (result[i]);
  operate ("celdepth:depth-exact", (Pads) { { bad, scribbles, arrows } }, "Y float", result, NULL);
  for (int i = 0; i < PIXELS; i++)
    strange += !isfinite (result[i]);
  CHECK (strange == 0);
  CHECK (warnings == 0);
  g_object_unref (bad);
}

/* With contradictions there is a result; the message is repeated only after another one. */
static void
contradictions_are_reported_once (void)
{
  GeglNode *graph = gegl_node_new ();
  GeglNode *node = add_operation (graph, "celdepth:popup", (Pads) { { drawing, scribbles } });

  be_quiet ();
  gegl_node_set (node, "relations", "#ff0000 > #00ff00; #00ff00 > #ff0000", NULL);
  get_output (node, "Y float", result);
  CHECK (times_said == 1 && SAYS ("contradicts") && SAYS ("in a circle with the relation in line 1, column 1"));
  NEAR (range (result, PIXELS), 1, 1e-3);
  gegl_node_set (node, "tolerance", 1e-5, NULL);
  get_output (node, "Y float", result);
  CHECK (times_said == 1);
  gegl_node_set (node, "relations", "#ff0000 > #00ff00", NULL);
  get_output (node, "Y float", result);
  CHECK (times_said == 1);
  gegl_node_set (node, "relations", "#ff0000 > #00ff00; #00ff00 > #ff0000", NULL);
  get_output (node, "Y float", result);
  CHECK (times_said == 2);
  CHECK (warnings == 0);
  g_object_unref (graph);
}

static void
hear_progress (GeglNode *node, double done, gpointer data)
{
  double *last = data;

  CHECK (done >= *last && done <= 1);
  *last = done;
}

static void
progress_increases_to_the_end (void)
{
  GeglNode *graph = gegl_node_new ();
  GeglNode *node = add_operation (graph, "celdepth:popup", (Pads) { { drawing, scribbles, arrows } });
  double    last = 0;

  g_signal_connect (node, "progress", G_CALLBACK (hear_progress), &last);
  get_output (node, "Y float", result);
  CHECK (last > 0.98);
  g_object_unref (graph);
}

int
main (int argc, char **argv)
{
  int failed;

  gegl_init (&argc, &argv);
  make_page ();
  gegl_buffer_get (drawing, NULL, 1.0, babl_format ("RGBA float"), input_light, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  start_to_listen ();
  RUN (missing_pads_are_named);
  RUN (missing_scribbles_and_arrows_are_reported);
  RUN (propagation_needs_something_to_carry);
  RUN (deformation_says_what_is_wrong);
  RUN (a_missing_matcap_is_reported);
  RUN (a_second_picture_has_levels_of_its_size);
  RUN (strain_of_the_eyes_is_reported);
  RUN (corrections_of_unknown_colours_are_errors);
  RUN (unreadable_relations_are_located);
  RUN (unreadable_arrow_paths_are_located);
  RUN (layers_outside_the_picture_are_errors);
  RUN (layers_of_another_size_are_reported);
  RUN (empty_layer_pickers_are_no_error);
  RUN (settings_out_of_range_are_errors);
  RUN (an_infinite_input_is_an_error);
  RUN (empty_and_single_pixel_pictures_are_handled);
  RUN (nan_and_infinity_are_handled);
  RUN (contradictions_are_reported_once);
  RUN (progress_increases_to_the_end);
  failed = DONE;
  stop_to_listen ();
  drop_page ();
  gegl_exit ();
  return failed;
}
