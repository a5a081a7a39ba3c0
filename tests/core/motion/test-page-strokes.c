/* Strokes on the page: what hangs on one part goes with it, what hangs on several stays, and all of it is composed;
 * lines go on below others.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "layer-scene.h"
#include "motion/puppet.h"

#define SIDE 160
#define DY   10 /* by how much a part is moved, upwards */

static const float RED[3] = { 1, 0, 0 }, BLUE[3] = { 0, 0, 1 }, BLACK[3] = { 0, 0, 0 };

/* ------------------------------------------------------------------ shapes */

/* A box with an outline of three pixels. */
#define BOX(name, left, top, right, bottom)                                                                      \
  static double name (double x, double y) { return box_share (x, y, left, top, right, bottom); }                 \
  static double name##_line (double x, double y)                                                                 \
  {                                                                                                              \
    return 1 - box_share (x, y, (left) + 3, (top) + 3, (right) - 3, (bottom) - 3);                               \
  }

BOX (body, 20, 80, 70, 140)
BOX (arm, 100, 80, 140, 140)
BOX (visor, 45, 90, 70, 120)

static double all (double x, double y) { (void) x; (void) y; return 1; }
static double antenna (double x, double y) { return box_share (x, y, 40, 30.5, 43, 80); }
static double bridge (double x, double y) { return box_share (x, y, 70, 100, 100, 103); }
static double ground (double x, double y) { return box_share (x, y, 0, 130, 20, 133); }
static double crumb (double x, double y) { return box_share (x, y, 70, 90, 74, 94); }
static double alone (double x, double y) { return box_share (x, y, 20, 20, 26, 26); }
static double mouth (double x, double y) { return box_share (x, y, 30, 104, 60, 107); }

/* A body with a level of 1 and an arm; on the page below them the strokes, a list that ends with NULL. */
static CeldLayers *
layers_with (LayerScene *s, const LayerShare *stroke)
{
  *s = layer_scene (SIDE, SIDE);
  for (; *stroke; stroke++)
    layer_scene_paint (s, 1, BLACK, *stroke, all);
  layer_scene_paint (s, 2, RED, body, body_line);
  layer_scene_paint (s, 3, BLUE, arm, arm_line);
  return layer_scene_cut (s, 3, CELD_STORE_FLOAT, true);
}

static CeldPuppet *
puppet_with (LayerScene *s, const LayerShare *stroke)
{
  CeldSettings settings = celd_settings ();
  CeldPuppet  *puppet = NULL;
  CeldLayers  *layers = layers_with (s, stroke);

  CHECK (celd_puppet_new (layers, &s->ink, NULL, 1, NULL, &settings, NULL, &puppet) == CELD_OK);
  celd_layers_free (layers);
  return puppet;
}

static float       canvas_data[4 * SIDE * SIDE];
static CeldColours canvas = { SIDE, SIDE, SIDE, canvas_data };

/* Moves the body up, the arm stays. */
static void
move_body (CeldPuppet *puppet)
{
  CeldHandle handle[4] = { { 30, 130, 30, 130 - DY, 0 }, { 60, 95, 60, 95 - DY, 0 }, { 120, 90, 120, 90, 0 },
                           { 120, 130, 120, 130, 0 } };

  CHECK (celd_puppet_pose (puppet, handle, 4, NULL, NULL) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, NULL, &canvas, NULL) == CELD_OK);
}

static float
grey (int x, int y)
{
  const float *c = CELD_RGBA (&canvas, x, y);

  CHECK (c[3] > 0.999f);
  return (c[0] + c[1] + c[2]) / 3;
}

static void
at_rest (CeldPuppet *puppet, LayerScene *s)
{
  float most = 0;

  CHECK (celd_puppet_pose (puppet, NULL, 0, NULL, NULL) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, NULL, &canvas, NULL) == CELD_OK);
  for (size_t i = 0; i < 4 * SIDE * SIDE; i++)
    most = fmaxf (most, fabsf (canvas_data[i] - s->art.data[i]));
  NEAR (most, 0, 1 / 255.0);
}

static void
close_scene (CeldPuppet *puppet, LayerScene *s)
{
  celd_puppet_free (puppet);
  layer_scene_close (s);
}

/* ------------------------------------------------------------------ tests */

/* Also its antialiased end: half a pixel of ink at the top. */
static void
what_hangs_on_one_part_goes_with_it (void)
{
  LayerScene  s;
  CeldPuppet *puppet = puppet_with (&s, (LayerShare[]) { antenna, NULL });

  at_rest (puppet, &s);
  move_body (puppet);
  for (int y = 31; y < 80; y++)
    NEAR (grey (41, y - DY), 0, 0.01);
  NEAR (grey (41, 30 - DY), 0.5, 0.01);
  NEAR (grey (41, 29 - DY), 1, 0.01);
  NEAR (grey (39, 50 - DY), 1, 0.01);
  close_scene (puppet, &s);
}

static void
it_leaves_paper_behind (void)
{
  LayerScene  s;
  CeldPuppet *puppet = puppet_with (&s, (LayerShare[]) { antenna, NULL });
  CeldHandle  handle[2] = { { 30, 130, 60, 130, 0 }, { 60, 95, 90, 95, 0 } };

  CHECK (celd_puppet_pose (puppet, handle, 2, NULL, NULL) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, NULL, &canvas, NULL) == CELD_OK);
  for (int y = 25; y < 78; y++)
    for (int x = 36; x < 48; x++)
      NEAR (grey (x, y), 1, 0.001);
  close_scene (puppet, &s);
}

static void
what_hangs_on_several_parts_or_the_frame_stays (void)
{
  LayerScene  s;
  CeldPuppet *puppet = puppet_with (&s, (LayerShare[]) { bridge, ground, alone, NULL });

  at_rest (puppet, &s);
  move_body (puppet);
  for (int x = 72; x < 99; x++)
    NEAR (grey (x, 101), 0, 0.01);
  for (int x = 0; x < 18; x++)
    NEAR (grey (x, 131), 0, 0.01);
  NEAR (grey (23, 23), 0, 0.01);
  close_scene (puppet, &s);
}

static void
a_crumb_goes_with_what_it_touches (void)
{
  LayerScene  s;
  CeldPuppet *puppet = puppet_with (&s, (LayerShare[]) { crumb, NULL });

  move_body (puppet);
  NEAR (grey (72, 92 - DY), 0, 0.01);
  NEAR (grey (72, 93), 1, 0.01);
  close_scene (puppet, &s);
}

/* A visor over a mouth moves to the right by one pixel: the mouth still reaches it. */
static void
a_line_goes_on_below_a_nearer_line (void)
{
  LayerScene   s = layer_scene (SIDE, SIDE);
  CeldSettings settings = celd_settings ();
  CeldPuppet  *puppet = NULL;
  CeldLayers  *layers;
  CeldHandle   handle[4] = { { 25, 135, 25, 135, 0 }, { 25, 85, 25, 85, 0 }, { 60, 95, 61, 95, 0 },
                             { 60, 115, 61, 115, 0 } };

  layer_scene_paint (&s, 2, RED, body, body_line);
  layer_scene_paint (&s, 2, BLACK, mouth, all);
  layer_scene_paint (&s, 3, BLUE, visor, visor_line);
  layers = layer_scene_cut (&s, 3, CELD_STORE_FLOAT, true);
  CHECK (celd_puppet_new (layers, &s.ink, NULL, 1, NULL, &settings, NULL, &puppet) == CELD_OK);
  celd_layers_free (layers);
  at_rest (puppet, &s);
  CHECK (celd_puppet_pose (puppet, handle, 4, NULL, NULL) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, NULL, &canvas, NULL) == CELD_OK);
  for (int x = 32; x < 48; x++)
    NEAR (grey (x, 105), 0, 0.05);
  for (int y = 112; y < 118; y++)
    CHECK (CELD_RGBA (&canvas, 45, y)[0] > 0.9f); /* away from the mouth the face goes on, not the line */
  close_scene (puppet, &s);
}

/* The page of the second drawing is left out, but not what hangs on its parts: on grey paper it has no fringe of white,
 * and each pixel is the drawing's own, darkened by the paper. */
static void
a_composition_keeps_what_hangs_on_parts (void)
{
  LayerScene       first = layer_scene (SIDE, SIDE), second;
  CeldLayers      *layers[2];
  CeldOrder        order[2] = { { .level = first.level, .n = 1 }, { .n = 3 } };
  CeldFragment     fragment[2];
  CeldComposition *made = NULL;

  for (size_t i = 0; i < 4 * SIDE * SIDE; i++)
    first.art.data[i] = i % 4 == 3 ? 1 : 0.6f;
  layers[0] = layer_scene_cut (&first, 1, CELD_STORE_FLOAT, true);
  layers[1] = layers_with (&second, (LayerShare[]) { antenna, bridge, ground, alone, NULL });
  order[1].level = second.level;
  for (size_t i = 0; i < 2; i++)
    fragment[i] = (CeldFragment) { .layers = layers[i], .order = &order[i], .page = 1,
                                   .placement = { i ? 7 : 0, i ? -5 : 0, 1, 0, false },
                                   .ink = i ? &second.ink : &first.ink };
  CHECK (celd_compose (fragment, 2, NULL, SIDE, SIDE, NULL, NULL, &made) == CELD_OK);
  CHECK (celd_composition_flatten (made, NULL, &canvas) == CELD_OK);
  for (int y = 31; y < 79; y++)
    {
      NEAR (grey (41 + 7, y - 5), 0, 1e-5);
      NEAR (grey (44 + 7, y - 5), 0.6, 1e-5);
    }
  NEAR (grey (41 + 7, 30 - 5), 0.3, 1e-5);
  for (int x = 72; x < 99; x++)
    NEAR (grey (x + 7, 101 - 5), 0, 1e-5);
  NEAR (grey (10 + 7, 131 - 5), 0.6, 1e-5); /* the ground reaches the frame */
  NEAR (grey (23 + 7, 23 - 5), 0.6, 1e-5);  /* and this hangs on nothing */
  celd_composition_free (made);
  for (size_t i = 0; i < 2; i++)
    celd_layers_free (layers[i]);
  layer_scene_close (&first);
  layer_scene_close (&second);
}

int
main (void)
{
  RUN (what_hangs_on_one_part_goes_with_it);
  RUN (it_leaves_paper_behind);
  RUN (what_hangs_on_several_parts_or_the_frame_stays);
  RUN (a_crumb_goes_with_what_it_touches);
  RUN (a_line_goes_on_below_a_nearer_line);
  RUN (a_composition_keeps_what_hangs_on_parts);
  return DONE;
}
