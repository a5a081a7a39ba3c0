/* celdepth:live-popup has the results of celdepth:popup, follows what is painted, and passes its input through while
 * scribbles are not connected.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "listen.h"
#include "page.h"

#define LIVE "celdepth:live-popup"
#define RESULTS 8

static float result[4 * PIXELS], wanted[4 * PIXELS], group_light[4 * PIXELS];

static uint8_t hidden_paint[4 * PIXELS], correction_paint[4 * PIXELS];

/* The drawing and the arrows over each other, as in a group; what is hidden; and a stroke in the background's colour over
 * the outline of the left disc. */
static GeglBuffer *group, *hidden, *corrections;

/* The layers on the pads of a node; NULL: not connected. */
typedef struct { GeglBuffer *input, *drawing, *scribbles, *arrows, *contours, *hidden, *corrections; } Layers;

static void
make_group (void)
{
  static uint8_t all[4 * PIXELS];

  for (int i = 0; i < PIXELS; i++)
    {
      uint8_t luma = (uint8_t) roundf (255 * page_luma[i]), paper[] = { luma, luma, luma, 255 };

      memcpy (all + 4 * i, page_arrows[4 * i + 3] ? page_arrows + 4 * i : paper, 4);
    }
  paint_line (hidden_paint, 45, 14, 45, 40, 26, 0x000000);
  paint_line (correction_paint, 20, 38, 20, 42, 2, 0x0000ff);
  group       = page_buffer ("R'G'B'A u8", "R'G'B'A u8", all);
  hidden      = page_buffer ("R'G'B'A u8", "R'G'B'A u8", hidden_paint);
  corrections = page_buffer ("R'G'B'A u8", "R'G'B'A u8", correction_paint);
  gegl_buffer_get (group, NULL, 1, babl_format ("RGBA float"), group_light, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
}

static void
connect_layer (GeglNode *graph, GeglBuffer *layer, GeglNode *node, const char *pad)
{
  if (layer)
    join (gegl_node_new_child (graph, "operation", "gegl:buffer-source", "buffer", layer, NULL), node, pad);
}

static GeglNode *
add_live (GeglNode *graph, Layers layers)
{
  GeglNode *node = gegl_node_new_child (graph, "operation", LIVE, NULL);

  connect_layer (graph, layers.input, node, "input");
  connect_layer (graph, layers.drawing, node, "drawing");
  connect_layer (graph, layers.scribbles, node, "scribbles");
  connect_layer (graph, layers.arrows, node, "arrows");
  connect_layer (graph, layers.contours, node, "contours");
  connect_layer (graph, layers.hidden, node, "hidden");
  connect_layer (graph, layers.corrections, node, "corrections");
  return node;
}

static void
render (Layers layers, int kind, float *pixels)
{
  GeglNode *graph = gegl_node_new (), *node = add_live (graph, layers);

  gegl_node_set (node, "result", kind, NULL);
  get_output (node, "RGBA float", pixels);
  g_object_unref (graph);
}

#define SAME(tolerance) NEAR (difference (result, wanted, 4 * PIXELS), 0, tolerance)
#define PASSES_THROUGH() NEAR (difference (result, group_light, 4 * PIXELS), 0, 1e-6)

/* Whatever the input of the group is. */
static void
results_are_those_of_popup (void)
{
  for (int kind = 0; kind < RESULTS; kind++)
    {
      render ((Layers) { group, drawing, scribbles, arrows, contours, hidden, NULL }, kind, result);
      operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows, contours, hidden } }, "RGBA float", wanted,
               "result", kind, NULL);
      SAME (0);
      CHECK (difference (result, group_light, 4 * PIXELS) > 0.5);
    }
}

/* Each layer has its part in them. */
static void
every_layer_counts (void)
{
  Layers all = { group, drawing, scribbles, arrows, contours, hidden, NULL }, without[4] = { all, all, all, all };

  without[0].drawing  = NULL;
  without[1].arrows   = NULL;
  without[2].contours = NULL;
  without[3].hidden   = NULL;
  render (all, 4, wanted); /* normals */
  for (int i = 0; i < 4; i++)
    {
      render (without[i], 4, result);
      CHECK (difference (result, wanted, 4 * PIXELS) > 0.1);
    }
}

/* Ink below the correction belongs to the background. */
static void
corrections_count (void)
{
  int ink = 4 * (40 * WIDTH + 21), disc = 4 * (40 * WIDTH + 45), background = 4 * (70 * WIDTH + 5);

  render ((Layers) { .input = group, .drawing = drawing, .scribbles = scribbles, .arrows = arrows }, 2, result);
  NEAR (result[ink], result[disc], 1e-6);
  CHECK (result[ink] > result[background] + 0.3f);
  render ((Layers) { group, drawing, scribbles, arrows, NULL, NULL, corrections }, 2, result);
  NEAR (result[ink], result[background], 1e-6);
  CHECK (result[disc] > result[background] + 0.3f);
}

static void
the_input_can_be_the_drawing (void)
{
  render ((Layers) { .input = drawing, .scribbles = scribbles, .arrows = arrows }, 3, result);
  operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows } }, "RGBA float", wanted, NULL);
  SAME (0);
}

static void
without_scribbles_the_input_passes_through (void)
{
  be_quiet ();
  render ((Layers) { .input = group, .drawing = drawing, .arrows = arrows }, 3, result);
  PASSES_THROUGH ();
  CHECK (times_said == 1 && warnings == 0 && SAYS ("Live pop-up: ") && SAYS ("Cartoon Depth > Live group"));
}

/* Before the first stroke, too, which is no mistake. */
static void
nothing_is_said_while_painting (void)
{
  GeglBuffer         *live = page_buffer ("R'G'B'A u8", "R'G'B'A u8", hidden_paint);
  const GeglRectangle outside = { 0, 0, 3, 3 };

  gegl_buffer_clear (live, NULL);
  be_quiet ();
  render ((Layers) { .input = group, .drawing = drawing, .scribbles = live }, 3, result);
  PASSES_THROUGH ();
  gegl_buffer_copy (scribbles, NULL, GEGL_ABYSS_NONE, live, NULL);
  gegl_buffer_set_color_from_pixel (live, &outside, (const uint8_t[]) { 9, 99, 199, 255 }, babl_format ("R'G'B'A u8"));
  render ((Layers) { group, drawing, live, arrows, NULL, NULL, NULL }, 3, result);
  CHECK (times_said == 0 && warnings == 0);
  operate ("celdepth:popup", (Pads) { { drawing, live, arrows } }, "RGBA float", wanted, NULL);
  SAME (0);
  CHECK (times_said == 1);
  g_object_unref (live);
}

/* GIMP connects a source without a buffer to a pad while its dialog is open. */
static void
a_source_without_buffer_is_no_layer (void)
{
  GeglNode *graph = gegl_node_new (), *node = add_live (graph, (Layers) { .input = group, .drawing = drawing });

  be_quiet ();
  join (gegl_node_new_child (graph, "operation", "gegl:buffer-source", NULL), node, "scribbles");
  get_output (node, "RGBA float", result);
  PASSES_THROUGH ();
  CHECK (times_said == 0 && warnings == 0);
  g_object_unref (graph);
}

static void
layers_of_other_sizes_are_named (void)
{
  GeglBuffer *away = gegl_buffer_new (GEGL_RECTANGLE (WIDTH, 0, 50, 50), babl_format ("R'G'B'A u8"));
  GeglBuffer *small = gegl_buffer_new (GEGL_RECTANGLE (3, 3, 112, 60), babl_format ("R'G'B'A u8"));

  gegl_buffer_copy (scribbles, GEGL_RECTANGLE (3, 3, 112, 60), GEGL_ABYSS_NONE, small, GEGL_RECTANGLE (3, 3, 0, 0));
  be_quiet ();
  render ((Layers) { .input = group, .drawing = drawing, .scribbles = away, .arrows = arrows }, 3, result);
  PASSES_THROUGH ();
  CHECK (times_said == 1 && warnings == 0 && SAYS ("Scribbles") && SAYS ("outside"));
  be_quiet ();
  render ((Layers) { .input = group, .drawing = drawing, .scribbles = small, .arrows = arrows }, 3, result);
  operate ("celdepth:popup", (Pads) { { drawing, scribbles, arrows } }, "RGBA float", wanted, NULL);
  SAME (0);
  CHECK (SAYS ("112 x 60") && SAYS ("Live group again") && !SAYS ("Image Size"));
  g_object_unref (away);
  g_object_unref (small);
}

/* A stroke into a connected layer changes the result also where it does not touch it: the right disc, which was in
 * front of the background, becomes a part of it. */
static void
strokes_are_followed (void)
{
  GeglBuffer         *live = gegl_buffer_dup (scribbles);
  GeglNode           *graph = gegl_node_new ();
  GeglNode           *node = add_live (graph, (Layers) { group, drawing, live, arrows, NULL, NULL, NULL });
  const GeglRectangle stroke = { 78, 28, 18, 28 };
  const uint8_t       blue[] = { 0, 0, 255, 255 };
  int                 disc = 4 * (22 * WIDTH + 85), background = 4 * (70 * WIDTH + 5);

  get_output (node, "RGBA float", result);
  CHECK (result[disc] > result[background] + 0.3f);
  gegl_buffer_set_color_from_pixel (live, &stroke, blue, babl_format ("R'G'B'A u8"));
  get_output (node, "RGBA float", result);
  operate ("celdepth:popup", (Pads) { { drawing, live, arrows } }, "RGBA float", wanted, NULL);
  SAME (1e-5);
  NEAR (result[disc], result[background], 0.05);
  g_object_unref (graph);
  g_object_unref (live);
}

int
main (int argc, char **argv)
{
  start_to_listen ();
  gegl_init (&argc, &argv);
  make_page ();
  make_group ();
  RUN (results_are_those_of_popup);
  RUN (every_layer_counts);
  RUN (corrections_count);
  RUN (the_input_can_be_the_drawing);
  RUN (without_scribbles_the_input_passes_through);
  RUN (nothing_is_said_while_painting);
  RUN (a_source_without_buffer_is_no_layer);
  RUN (layers_of_other_sizes_are_named);
  RUN (strokes_are_followed);
  g_object_unref (group);
  g_object_unref (hidden);
  g_object_unref (corrections);
  drop_page ();
  gegl_exit ();
  stop_to_listen ();
  return DONE;
}
