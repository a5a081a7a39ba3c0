/* Puppets: drawings at rest, moved, bent, crossed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "layer-scene.h"
#include "motion/puppet.h"

#define SIDE 240

static const float RED[3] = { 1, 0, 0 }, BLUE[3] = { 0, 0, 1 }, GREEN[3] = { 0, 0.6f, 0 };

/* ------------------------------------------------------------------ shapes */

static double body (double x, double y) { return box_share (x, y, 40.3, 60, 120, 200.6); }
static double body_line (double x, double y) { return frame_share (x, y, 40.3, 60, 120, 200.6); }
static double arm (double x, double y) { return box_share (x, y, 150, 80, 210, 104.5); }
static double arm_line (double x, double y) { return frame_share (x, y, 150, 80, 210, 104.5); }
static double eye (double x, double y) { return hypot (x - 80, y - 90) < 8; }
static double bar (double x, double y) { return box_share (x, y, 20, 180, 200, 204); }

static CeldPuppet *
puppet_of (const LayerScene *s, size_t n)
{
  CeldLayers  *layers = layer_scene_cut (s, n, CELD_STORE_FLOAT, true);
  CeldSettings settings = celd_settings ();
  CeldPuppet  *puppet = NULL;

  CHECK (celd_puppet_new (layers, &s->ink, NULL, 1, NULL, &settings, NULL, &puppet) == CELD_OK);
  celd_layers_free (layers);
  return puppet;
}

/* A body with an eye, and an arm beside it; `arm_level` against 1 of the body. */
static LayerScene
figure (uint32_t arm_level)
{
  LayerScene s = layer_scene (SIDE, SIDE);

  layer_scene_paint (&s, 2, RED, body, body_line);
  layer_scene_paint (&s, 3, BLUE, arm, arm_line);
  layer_scene_paint (&s, 4, GREEN, eye, NULL);
  s.level[2] = arm_level;
  s.level[3] = 3;
  return s;
}

static float canvas_data[4 * SIDE * SIDE], levels_data[SIDE * SIDE];
static CeldColours canvas = { SIDE, SIDE, SIDE, canvas_data };

static const float *
canvas_at (int x, int y)
{
  return CELD_RGBA (&canvas, x, y);
}

static CeldPoseReport
pose_and_draw (CeldPuppet *puppet, const CeldHandle *handle, size_t n, const CeldHost *host)
{
  CeldPoseReport report = { 0 };

  CHECK (celd_puppet_pose (puppet, handle, n, host, &report) == CELD_OK);
  CHECK (celd_puppet_draw (puppet, host, &canvas, NULL) == CELD_OK);
  return report;
}

static bool
has_colour (int x, int y, const float colour[3])
{
  const float *c = canvas_at (x, y);

  return fabsf (c[0] - colour[0]) + fabsf (c[1] - colour[1]) + fabsf (c[2] - colour[2]) < 0.02f && c[3] > 0.99f;
}

/* ------------------------------------------------------------------ tests */

static void
at_rest_it_is_the_drawing (void)
{
  LayerScene  s = figure (2);
  CeldPuppet *puppet = puppet_of (&s, 4);
  CeldHandle  pins[3] = { { 80, 180, 80, 180, 0 }, { 60, 80, 60, 80, 0 }, { 200, 90, 200, 90, 0 } };

  for (size_t n = 0; n <= 3; n++)
    {
      CeldPoseReport report = pose_and_draw (puppet, pins, n, NULL);
      float          most = 0;

      for (size_t i = 0; i < 4 * SIDE * SIDE; i++)
        most = fmaxf (most, fabsf (canvas_data[i] - s.art.data[i]));
      NEAR (most, 0, 1 / 255.0);
      CHECK (!report.folded && !report.outside);
      NEAR (report.stretch, 1, 1e-3);
    }
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* All parts are moved by whole pixels: each pixel is copied, antialiasing included. */
static void
a_translation_is_exact (void)
{
  LayerScene  s = figure (2);
  CeldPuppet *puppet = puppet_of (&s, 4);
  CeldHandle  moved[3] = { { 80, 180, 67, 190, 0 }, { 60, 150, 47, 160, 0 }, { 200, 90, 187, 100, 0 } };

  pose_and_draw (puppet, moved, 3, NULL);
  for (int y = 0; y < SIDE - 10; y++)
    for (int x = 13; x < SIDE; x++)
      for (int c = 0; c < 4; c++)
        NEAR (canvas_at (x - 13, y + 10)[c], art_at (&s, x, y)[c], 1e-5);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* One end is pinned, the other is taken round a quarter of a circle: length and area stay. */
static void
a_bent_bar_keeps_length_and_area (void)
{
  LayerScene  s = layer_scene (SIDE, SIDE);
  double      r = (160 - 60) / 1.57079633, x = 60 + r, y = 192 - r, length = 0, area = 0;
  CeldHandle  handle[4] = { { 30, 192, 30, 192, 0 }, { 60, 192, 60, 192, 0 }, { 160, 192, x, y, 0 },
                            { 190, 192, x, y - 30, 0 } };
  CeldPuppet *puppet;
  CeldPoseReport report;
  double      drawn = 0, before[2] = { 0, 0 };

  layer_scene_paint (&s, 2, RED, bar, NULL);
  puppet = puppet_of (&s, 2);
  report = pose_and_draw (puppet, handle, 4, NULL);
  CHECK (!report.folded);
  for (int u = 20; u < 200; u++)
    {
      uint32_t c = celd_puppet_front_cell (puppet, u, 192);
      float    at[2];

      CHECK (c > 0);
      celd_cell_map (&puppet->lattice, c - 1, (float) u + 0.5f, 192, at);
      if (u > 20)
        length += hypot (at[0] - before[0], at[1] - before[1]);
      before[0] = at[0];
      before[1] = at[1];
    }
  for (int v = 180; v < 204; v++)
    for (int u = 20; u < 200; u++)
      area += celd_cell_area (&puppet->lattice, celd_puppet_front_cell (puppet, u, v) - 1);
  for (size_t p = 0; p < SIDE * SIDE; p++)
    drawn += 1 - canvas_data[4 * p + 1]; /* red on white */
  NEAR (length, 179, 0.03 * 179);
  NEAR (area, 180 * 24, 0.03 * 180 * 24);
  NEAR (drawn, 180 * 24, 0.03 * 180 * 24);
  CHECK (has_colour ((int) x, (int) y - 15, RED));
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* The arm is drawn over the body, or behind it, as its level and the depth of its handle say. */
static void
an_arm_passes_in_front_or_behind (void)
{
  static const struct { uint32_t level; double depth; bool front; } way[] = {
    { 2, 0, true }, { 0, 0, false }, { 2, -2, false }, { 0, 2, true },
  };

  for (size_t i = 0; i < 4; i++)
    {
      LayerScene  s = figure (way[i].level);
      CeldPuppet *puppet;
      CeldHandle  handle[2] = { { 80, 180, 80, 180, 0 }, { 180, 92, 90, 132, way[i].depth } };
      CeldPlane   levels = { SIDE, SIDE, SIDE, levels_data };

      if (way[i].level == 0)
        s.level[0] = 0;
      s.level[1] = 1;
      puppet = puppet_of (&s, 4);
      pose_and_draw (puppet, handle, 2, NULL);
      CHECK (has_colour (90, 132, way[i].front ? BLUE : RED));
      CHECK (has_colour (80, 90, GREEN)); /* the eye goes with the body that is held */
      CHECK (has_colour (180, 92, (float[3]) { 1, 1, 1 }));
      CHECK (celd_puppet_draw (puppet, NULL, &canvas, &levels) == CELD_OK);
      NEAR (levels_data[132 * SIDE + 90], way[i].front ? way[i].level + way[i].depth : 1, 0);
      NEAR (levels_data[5 * SIDE + 5], 0, 0);
      celd_puppet_free (puppet);
      layer_scene_close (&s);
    }
}

/* What has no handle goes with what it touches most; what touches nothing stays. */
static void
parts_go_with_what_they_touch (void)
{
  LayerScene  s = figure (2);
  CeldPuppet *puppet = puppet_of (&s, 4);
  CeldHandle  handle[2] = { { 60, 180, 80, 190, 0 }, { 100, 180, 120, 190, 0 } };

  pose_and_draw (puppet, handle, 2, NULL);
  CHECK (has_colour (100, 100, GREEN) && has_colour (80, 90, RED));
  CHECK (has_colour (180, 92, BLUE));
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* No gap opens inside a part that is turned and bent. */
static void
no_gaps_open (void)
{
  LayerScene  s = layer_scene (SIDE, SIDE);
  CeldPuppet *puppet;
  CeldHandle  handle[3] = { { 50, 70, 70, 60, 0 }, { 110, 190, 60, 170.3, 0 }, { 50, 190, 20, 130.7, 0 } };
  size_t      red = 0;

  layer_scene_paint (&s, 2, RED, body, NULL);
  puppet = puppet_of (&s, 2);
  pose_and_draw (puppet, handle, 3, NULL);
  for (int y = 1; y < SIDE - 1; y++)
    for (int x = 1; x < SIDE - 1; x++)
      {
        bool around = has_colour (x - 1, y, RED) && has_colour (x + 1, y, RED) && has_colour (x, y - 1, RED) &&
                      has_colour (x, y + 1, RED);

        CHECK (!around || has_colour (x, y, RED));
        red += around;
      }
  CHECK (red > 8000);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

static void
poses_do_not_depend_on_order_or_threads (void)
{
  static float first[4 * SIDE * SIDE];
  LayerScene   s = figure (2);
  CeldPuppet  *puppet = puppet_of (&s, 4), *other = puppet_of (&s, 4);
  CeldHandle   a[2] = { { 80, 180, 90, 170, 0 }, { 180, 92, 90, 132.4, 0 } };
  CeldHandle   b[2] = { { 80, 180, 20, 100, 1 }, { 180, 92, 190, 30, 0 } };
  CeldHost     host = { .each = check_backwards };

  pose_and_draw (puppet, a, 2, NULL);
  memcpy (first, canvas_data, sizeof first);
  pose_and_draw (puppet, b, 2, NULL);
  CHECK (memcmp (first, canvas_data, sizeof first) != 0);
  pose_and_draw (puppet, a, 2, &host);
  CHECK (memcmp (first, canvas_data, sizeof first) == 0);
  pose_and_draw (other, a, 2, &host);
  CHECK (memcmp (first, canvas_data, sizeof first) == 0);
  celd_puppet_free (puppet);
  celd_puppet_free (other);
  layer_scene_close (&s);
}

static void
handles_outside_hold_the_nearest_part (void)
{
  LayerScene     s = figure (2);
  CeldPuppet    *puppet = puppet_of (&s, 4);
  CeldHandle     far[2] = { { -9e5, 130, -9e5 + 10, 130, 0 }, { 235, 90, 235, 100, 0 } };
  CeldHandle     wrong = { NAN, 0, 0, 0, 0 };
  CeldPoseReport report = pose_and_draw (puppet, far, 2, NULL);

  CHECK (report.outside == 2);
  CHECK (has_colour (47, 130, (float[3]) { 1, 1, 1 }) && has_colour (110, 130, RED)); /* the body went 10 to the right */
  CHECK (has_colour (180, 108, BLUE));                                                /* the arm went 10 down */
  CHECK (celd_puppet_pose (puppet, &wrong, 1, NULL, NULL) == CELD_BAD_VALUE);
  wrong = (CeldHandle) { 80, 80, 80, INFINITY, 0 };
  CHECK (celd_puppet_pose (puppet, &wrong, 1, NULL, NULL) == CELD_BAD_VALUE);
  wrong = (CeldHandle) { 80, 80, 80, 80, NAN };
  CHECK (celd_puppet_pose (puppet, &wrong, 1, NULL, NULL) == CELD_BAD_VALUE);
  wrong = (CeldHandle) { 80, 80, 9e5, -9e5, 0 };
  pose_and_draw (puppet, &wrong, 1, NULL);
  CHECK (has_colour (80, 150, (float[3]) { 1, 1, 1 }));
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* Many handles that contradict each other: folds are counted, and all numbers stay finite. */
static void
wild_handles_are_survived (void)
{
  LayerScene  s = figure (2);
  CeldPuppet *puppet = puppet_of (&s, 4);
  uint32_t    state = 7;
  size_t      folded = 0;

  for (int round = 0; round < 30; round++)
    {
      CeldHandle handle[12];

      for (int i = 0; i < 12; i++)
        {
          double *number = &handle[i].x;

          for (int k = 0; k < 5; k++)
            {
              state     = state * 1664525 + 1013904223;
              number[k] = (double) (state >> 8) / (1 << 24) * SIDE * (round % 3 ? 1 : 4);
            }
        }
      folded += pose_and_draw (puppet, handle, (size_t) (round % 13), NULL).folded;
      for (size_t p = 0; p < 4 * SIDE * SIDE; p++)
        CHECK (canvas_data[p] >= 0 && canvas_data[p] <= 1.00001f);
    }
  CHECK (folded > 0);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

static double sheet (double x, double y) { return box_share (x, y, 40, 60, 160, 200); }

static double
sheet_line (double x, double y)
{
  return fmin (1, frame_share (x, y, 40, 60, 160, 200) + box_share (x, y, 98, 60, 102, 200));
}

/* The line down the middle of a sheet is four pixels wide, also if the sheet is stretched by half across it. */
static void
lines_keep_their_width (void)
{
  LayerScene     s = layer_scene (SIDE, SIDE);
  CeldHandle     handle[6];
  CeldPuppet    *puppet;
  CeldPoseReport report;
  double         width = 0;

  for (int i = 0; i < 3; i++)
    {
      handle[i]     = (CeldHandle) { 45, 70 + 60 * i, 20, 70 + 60 * i, 0 };
      handle[i + 3] = (CeldHandle) { 155, 70 + 60 * i, 185, 70 + 60 * i, 0 };
    }
  layer_scene_paint (&s, 2, RED, sheet, sheet_line);
  puppet = puppet_of (&s, 2);
  report = pose_and_draw (puppet, handle, 6, NULL);
  CHECK (report.stretch > 1.3);
  for (int y = 100; y < 160; y++)
    for (int x = 70; x < 135; x++)
      width += 1 - (double) canvas_at (x, y)[0];
  NEAR (width / 60, 4, 0.4);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* Layers have the levels of their pose, and nothing is behind the page, with levels or without. */
static void
layers_are_where_handles_put_them (void)
{
  LayerScene     s = figure (2);
  CeldPuppet    *puppet = puppet_of (&s, 4);
  CeldHandle     handle[2] = { { 80, 180, 80, 180, 0 }, { 180, 92, 120, 132, -5 } };
  CeldPlane      levels = { SIDE, SIDE, SIDE, levels_data };
  CeldPosedLayer layer;

  CHECK (celd_puppet_count (puppet) == 4);
  pose_and_draw (puppet, handle, 2, NULL);
  for (size_t k = 0; k < 4; k++)
    {
      celd_puppet_layer (puppet, k, &layer);
      CHECK (layer.label == 1   ? isinf (layer.level) && layer.level < 0
             : layer.label == 3 ? layer.level < -2.5
                                : layer.level >= 1);
      CHECK (layer.elsewhere < 0.2);
    }
  CHECK (has_colour (140, 132, BLUE) && has_colour (100, 132, RED));
  CHECK (celd_puppet_draw (puppet, NULL, &canvas, &levels) == CELD_OK);
  CHECK (has_colour (140, 132, BLUE) && has_colour (100, 132, RED));
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* Where cells are folded and stretched, and which handle holds no part. */
/* Layers of a pose, composited from the back, are its picture; complete ones also below those in front. */
static void
a_pose_has_layers (void)
{
  LayerScene   s = figure (2);
  CeldPuppet  *puppet = puppet_of (&s, 4);
  CeldHandle   handle[2] = { { 80, 180, 80, 180, 0 }, { 180, 92, 100, 110.4, 0 } };
  CeldHandle   nearer[2] = { handle[0], { 180, 92, 100, 110.4, 1 } };
  static float sum[4 * SIDE * SIDE], own[4 * SIDE * SIDE];
  size_t       covered[2] = { 0 };

  pose_and_draw (puppet, handle, 2, NULL);
  CHECK (has_colour (100, 110, BLUE)); /* the arm lies over the body */
  for (int complete = 0; complete < 2; complete++)
    {
      CeldLayers *layers = NULL;
      float       most = 0;

      CHECK (celd_puppet_layers (puppet, complete, NULL, &layers) == CELD_OK);
      CHECK (celd_layers_count (layers) == 4);
      memset (sum, 0, sizeof sum);
      for (size_t k = 0; k < celd_layers_count (layers); k++)
        {
          const CeldRect *box = &celd_layers_item (layers, k)->box;

          celd_layers_paint (layers, k, own);
          for (int y = 0; y < box->height; y++)
            for (int x = 0; x < box->width; x++)
              {
                const float *from = own + 4 * (y * box->width + x);
                float       *to = sum + 4 * ((y + box->y) * SIDE + x + box->x), left = to[3] * (1 - from[3]);

                for (int c = 0; c < 3 && from[3] > 0; c++)
                  to[c] = (from[3] * from[c] + left * to[c]) / (from[3] + left);
                to[3] = from[3] + left;
                covered[complete] += from[3] > 0.5f;
              }
        }
      for (size_t i = 0; i < 4 * SIDE * SIDE; i++)
        most = fmaxf (most, i % 4 == 3 || canvas_data[i - i % 4 + 3] > 0.1f ? fabsf (sum[i] - canvas_data[i]) : 0);
      NEAR (most, 0, 1.5 / 255);
      celd_layers_free (layers);
    }
  CHECK (covered[1] > covered[0] + 500); /* 40 x 24 pixels of the body at least are below the arm */
  pose_and_draw (puppet, nearer, 2, NULL);
  {
    CeldLayers *layers = NULL;

    CHECK (celd_puppet_layers (puppet, false, NULL, &layers) == CELD_BAD_VALUE && !layers);
  }
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

static void
poses_are_reported_with_places (void)
{
  LayerScene     s = figure (2);
  CeldPuppet    *puppet = puppet_of (&s, 4);
  CeldHandle     pull[2] = { { 50, 190, 50, 190, 0 }, { 110, 70, 110, -330, 0 } };
  CeldHandle     swap[3] = { { 155, 92, 155, 92, 0 }, { 180, 92, 125, 92, 0 }, { 205, 92, 205, 92, 0 } };
  CeldHandle     out[2] = { { 80, 180, 80, 180, 0 }, { 230, 17, 230, 17, 0 } };
  CeldPoseReport report = pose_and_draw (puppet, pull, 2, NULL);
  char           text[1000];

  celd_pose_text (&report, NULL, text, sizeof text);
  CHECK (report.stretch > 2 && !report.outside);
  CHECK (report.stretch_x > 40 && report.stretch_x < 120 && report.stretch_y > 60 && report.stretch_y < 200);
  CHECK (strstr (text, "stretched to") && !strstr (text, "outside"));
  report = pose_and_draw (puppet, swap, 3, NULL);
  celd_pose_text (&report, NULL, text, sizeof text);
  CHECK (report.folded > 0 && strstr (text, "folded over"));
  CHECK (report.folded_x > 145 && report.folded_x < 215 && report.folded_y > 75 && report.folded_y < 110);
  report = pose_and_draw (puppet, out, 2, NULL);
  celd_pose_text (&report, NULL, text, sizeof text);
  CHECK (report.outside == 1 && !strcmp (text, "1 handle lies outside all parts and holds the nearest part instead: it"
                                               " is at 230,17."));
  celd_pose_text (&report, NULL, text, 9);
  CHECK (!strcmp (text, "1 handle"));
  report = pose_and_draw (puppet, out, 1, NULL);
  celd_pose_text (&report, NULL, text, sizeof text);
  CHECK (!text[0]);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* Of two poses the worse of each kind counts, with its place; the first of two that are as bad. */
static void
the_worst_of_several_poses_is_kept (void)
{
  CeldPoseReport worst = { 0 };
  CeldPoseReport first = { .outside = 2, .folded = 1, .stretch = 3, .outside_x = 1, .folded_x = 2, .stretch_x = 3 };
  CeldPoseReport next = { .outside = 2, .folded = 4, .stretch = 2.5, .outside_x = 7, .folded_x = 8, .stretch_x = 9 };

  celd_pose_worst (&first, &worst);
  CHECK (!memcmp (&worst, &first, sizeof worst));
  celd_pose_worst (&next, &worst);
  CHECK (worst.outside == 2 && worst.outside_x == 1);
  CHECK (worst.folded == 4 && worst.folded_x == 8);
  CHECK (worst.stretch == 3 && worst.stretch_x == 3);
}

/* Levels of a picture come back as they are, and go on in their last step where handles move parts beyond them. */
static void
levels_are_those_of_the_picture (void)
{
  LayerScene   s = figure (2);
  CeldSettings settings = celd_settings ();
  CeldPuppet  *puppet = NULL;
  CeldHandle   handle[2] = { { 80, 180, 80, 180, 0 }, { 180, 92, 180, 92, 2 } };
  CeldPlane    levels = { SIDE, SIDE, SIDE, levels_data };
  static const float of[4] = { -3, 1, 1.25f, 8 };

  for (size_t p = 0; p < SIDE * SIDE; p++)
    levels_data[p] = of[s.own.owner.data[p] - 1];
  CHECK (celd_puppet_of_levels (&s.ink, &levels, &s.art, &settings, NULL, &puppet) == CELD_OK);
  for (size_t n = 0; n <= 2; n += 2)
    {
      CHECK (celd_puppet_pose (puppet, handle, n, NULL, NULL) == CELD_OK);
      CHECK (celd_puppet_draw (puppet, NULL, &canvas, &levels) == CELD_OK);
      CHECK (levels_data[5 * SIDE + 5] == -3 && levels_data[180 * SIDE + 80] == 1 && levels_data[90 * SIDE + 80] == 8);
      NEAR (levels_data[92 * SIDE + 180], n ? 8 + 6.75 : 1.25, 1e-6); /* two levels up: one beyond the nearest */
    }
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

/* Where art is transparent, a layer is in front all the same, and can be held there; the page moves, too. */
static void
layers_reach_as_far_as_they_are_in_front (void)
{
  LayerScene   s = figure (2);
  CeldHandle   handle[] = { { .x = 60, .y = 190, .to_x = 70, .to_y = 190 } };
  CeldSettings settings = celd_settings ();
  CeldPuppet  *puppet = NULL;
  CeldLayers  *layers;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (hypot (x - 60, y - 75) > 12)
        CELD_RGBA (&s.art, x, y)[3] = 0;
  layers = layer_scene_cut (&s, 4, CELD_STORE_FLOAT, false);
  CHECK (celd_puppet_new (layers, &s.ink, NULL, 0, NULL, &settings, NULL, &puppet) == CELD_OK);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        CeldRect box = puppet->layer[puppet->front[y * SIDE + x]].box;

        CHECK (x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height);
      }
  pose_and_draw (puppet, handle, 1, NULL);
  CHECK (has_colour (70, 75, RED));
  celd_layers_free (layers);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

static void
wrong_sizes_are_refused (void)
{
  LayerScene   s = figure (2);
  CeldLayers  *layers = layer_scene_cut (&s, 4, CELD_STORE_FLOAT, true);
  CeldPuppet  *puppet = puppet_of (&s, 4), *none = NULL;
  CeldSettings settings = celd_settings ();
  CeldPlane    small = { SIDE - 1, SIDE, SIDE, s.ink.data };
  CeldColours  cut = { SIDE - 1, SIDE, SIDE, canvas_data };

  CHECK (celd_puppet_new (layers, &small, NULL, 1, NULL, &settings, NULL, &none) == CELD_BAD_SIZE);
  settings.cell_size = -1;
  CHECK (celd_puppet_new (layers, &s.ink, NULL, 1, NULL, &settings, NULL, &none) == CELD_BAD_VALUE && !none);
  CHECK (celd_puppet_draw (puppet, NULL, &cut, NULL) == CELD_BAD_SIZE);
  CHECK (celd_puppet_draw_layer (puppet, 9, NULL, &canvas) == CELD_BAD_VALUE);
  celd_layers_free (layers);
  celd_puppet_free (puppet);
  layer_scene_close (&s);
}

int
main (void)
{
  RUN (at_rest_it_is_the_drawing);
  RUN (a_translation_is_exact);
  RUN (a_bent_bar_keeps_length_and_area);
  RUN (an_arm_passes_in_front_or_behind);
  RUN (parts_go_with_what_they_touch);
  RUN (no_gaps_open);
  RUN (poses_do_not_depend_on_order_or_threads);
  RUN (handles_outside_hold_the_nearest_part);
  RUN (wild_handles_are_survived);
  RUN (lines_keep_their_width);
  RUN (layers_are_where_handles_put_them);
  RUN (a_pose_has_layers);
  RUN (poses_are_reported_with_places);
  RUN (the_worst_of_several_poses_is_kept);
  RUN (levels_are_those_of_the_picture);
  RUN (layers_reach_as_far_as_they_are_in_front);
  RUN (wrong_sizes_are_refused);
  return DONE;
}
