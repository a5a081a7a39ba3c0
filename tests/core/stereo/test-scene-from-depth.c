/* Views of scenes of depth alone: what moves, and what is uncovered, without layers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "board.h"

/* A box of depth 1 in front of paper of depth 0, with flat colours and an antialiased outline: left edge at x =
 * 30.3. */
static LayerScene
draw_box (void)
{
  LayerScene s = layer_scene (W, H);

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        double side = fmin (fmin (x + 0.5 - 29.8, 50.2 - x - 0.5), fmin (y + 0.5 - 6, 24 - y - 0.5));
        double inside = fmax (0, fmin (side + 0.5, 1)), fill = fmax (0, fmin (side - 1.5, 1));

        CELD_AT (&s.ink, x, y) = (float) (1 - inside + fill);
        CELD_AT (&s.depth, x, y) = inside > 0.5;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = (float) ((1 - inside) * (c == 2 ? 0.9 : 0.8) + fill * (c == 0 ? 0.6 : 0.3));
      }
  return s;
}

/* A view with that many pixels of disparity between depth 1 and 0, which is on the screen. */
static CeldColours
look_at_depth (const LayerScene *s, CeldCamera camera, double pixels)
{
  CeldSettings settings = celd_settings ();
  CeldScene   *scene = NULL;

  settings.disparity   = (float) (pixels / s->width);
  settings.convergence = 0;
  CHECK (celd_scene_of_depth (&s->art, &s->ink, &s->depth, &settings, NULL, &scene) == CELD_OK);
  return view_of (scene, s->width, s->height, camera, &settings, NULL);
}

/* From the front it is the art; from the side the box has moved with its antialiased edges, and leaves paper without
 * its line. */
static void
outlines_leave_no_ghost (void)
{
  LayerScene s = draw_box ();

  for (int eye = -1; eye <= 1; eye++)
    {
      CeldColours view = look_at_depth (&s, celd_camera_eye (eye), 16);
      int         moved = -8 * eye;

      for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
          for (int c = 0; c < 4; c++)
            {
              bool   box = x - moved >= 28 && x - moved < 52 && y >= 5 && y < 25;
              double paper = c == 2 ? 0.9 : c == 3 ? 1 : 0.8;
              double wanted = y == 5 || y == 24 ? (double) CELD_RGBA (&view, x, y)[c]
                                       : box ? (double) art_at (&s, x - moved, y)[c] : paper;

              NEAR (CELD_RGBA (&view, x, y)[c], wanted, 0.01);
            }
      free (view.data);
    }
  layer_scene_close (&s);
}

/* The box's mean, to a twentieth of a pixel, at any disparity. */
static void
boxes_move_by_half_the_disparity (void)
{
  LayerScene s = draw_box ();

  for (int k = 0; k <= 13; k++)
    {
      CeldColours view = look_at_depth (&s, celd_camera_eye (-1), k);
      double      sum = 0, all = 0;

      for (int x = 10; x < 75; x++)
        {
          double dark = 0.8 - (double) CELD_RGBA (&view, x, 15)[1];

          sum += dark * (x + 0.5);
          all += dark;
        }
      NEAR (sum / all, 40 + 0.5 * k, 0.05);
      free (view.data);
    }
  layer_scene_close (&s);
}

/* Also one from above: pixels are either uncovered or opaque. */
static void
views_have_no_seams (void)
{
  LayerScene s = draw_board ();
  uint32_t   seed = 17;

  for (int i = 0; i < W * H; i++)
    s.depth.data[i] = (float) check_random (&seed, 5) / 4;
  for (int step = 0; step < 8; step++)
    {
      CeldColours view = look_at_depth (&s, (CeldCamera) { cos (step), sin (step), 1 }, 9);

      for (int i = 3; i < 4 * W * H; i += 4)
        CHECK (view.data[i] == 0 || view.data[i] == 1);
      free (view.data);
    }
  layer_scene_close (&s);
}

/* A range of depth that is a hair less than four steps is four when it is multiplied by their number. */
static void
the_nearest_depth_is_in_the_last_group (void)
{
  LayerScene s = layer_scene (8, 3);

  for (int i = 0; i < 24; i++)
    s.depth.data[i] = i % 8 < 4 ? 0.961538494f : 0x1p-53f;
  free (look_at_depth (&s, celd_camera_eye (1), 8 * (double) 0.13f).data);
  layer_scene_close (&s);
}

/* Depth of all kinds, and noise as art: no view has holes. */
static void
views_have_no_holes (void)
{
  LayerScene s = draw_board ();
  uint32_t   seed = 11;

  for (int round = 0; round < 12; round++)
    {
      double     angle = round;
      CeldCamera camera = { sin (angle), round % 3 ? 0 : cos (angle), 1 };

      for (int i = 0; i < W * H; i++)
        {
          int block = i / W / 6 + 31 * (i % W / 9);

          s.depth.data[i] = round % 2 ? (float) (block * 7 % 11) / 10 : (float) check_random (&seed, 5) / 4;
          s.ink.data[i] = (float) check_random (&seed, 3) / 2;
        }
      for (int pixels = 1; pixels < 14; pixels += 4)
        {
          CeldColours view = look_at_depth (&s, camera, pixels);

          for (int i = 0; i < W * H && camera.y == 0; i++)
            CHECK (view.data[4 * i + 3] > 0.999f);
          for (int i = 0; i < 4 * W * H; i++)
            CHECK (view.data[i] >= 0 && view.data[i] <= 1.0001f);
          free (view.data);
        }
    }
  layer_scene_close (&s);
}

/* One of four kinds of depth pictures, as they are painted or estimated: discs of flat depth, slopes, both, and both in
 * 256 steps with noise. */
static void
draw_depth (CeldPlane *depth, int kind, uint32_t *seed)
{
  double at[9][4], wave[3][3];

  for (int k = 0; k < 9; k++)
    for (int i = 0; i < 4; i++)
      at[k][i] = check_random (seed, 1000) / 1000.0;
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      wave[k][i] = check_random (seed, 1000) / 1000.0;
  for (int y = 0; y < depth->height; y++)
    for (int x = 0; x < depth->width; x++)
      {
        double u = (double) x / depth->width, v = (double) y / depth->width, value = 0;

        for (int k = 0; k < 3 && kind != 0; k++)
          value += 0.15 * (1 + sin (30 * wave[k][0] * u + 40 * wave[k][1] * v + 6 * wave[k][2]));
        for (int k = 0; k < 9 && kind != 1; k++)
          if (hypot (u - at[k][0], v - 0.3 * at[k][1]) < 0.2 * at[k][2])
            value = at[k][3] + 0.3 * value;
        if (kind == 3)
          value = (floor (255 * value) + check_random (seed, 3)) / 255;
        CELD_AT (depth, x, y) = (float) value;
      }
}

/* At each disparity up to a tenth of the width, with any convergence: opaque art has no hole. */
static void
depth_of_any_kind_leaves_no_hole (void)
{
  LayerScene   s = layer_scene (150, 40);
  CeldSettings settings = celd_settings ();
  uint32_t     seed = 17;

  for (int i = 0; i < s.width * s.height; i++)
    {
      s.ink.data[i] = check_random (&seed, 4) ? 1 : (float) check_random (&seed, 5) / 4;
      for (int c = 0; c < 3; c++)
        s.art.data[4 * i + c] = s.ink.data[i];
    }
  for (int round = 0; round < 200; round++)
    {
      CeldScene *scene = NULL;

      settings.disparity   = (float) (1 + round % 5) / 50;
      settings.convergence = (float) check_random (&seed, 11) / 10;
      draw_depth (&s.depth, round / 5 % 4, &seed);
      CHECK (celd_scene_of_depth (&s.art, &s.ink, &s.depth, &settings, NULL, &scene) == CELD_OK);
      for (int eye = -1; eye <= 1; eye += 2)
        {
          CeldColours view = new_colours (s.width, s.height);
          float       least = 1;

          CHECK (celd_scene_view (scene, celd_camera_eye (eye), &settings, NULL, &view) == CELD_OK);
          for (int i = 3; i < 4 * s.width * s.height; i += 4)
            least = fminf (least, view.data[i]);
          NEAR (least, 1, 1e-5);
          free (view.data);
        }
      celd_scene_free (scene);
    }
  layer_scene_close (&s);
}

/* A dark board in front of yellow paper that has a line close to it and one that goes on behind it: what comes into
 * view is paper. */
static void
uncovered_paper_has_its_own_colour (void)
{
  static const float paper[4] = { 0.9f, 0.8f, 0.3f, 1 };
  LayerScene         s = layer_scene (120, 30);

  for (int y = 0; y < s.height; y++)
    for (int x = 0; x < s.width; x++)
      {
        bool board = x >= 50 && x < 80, line = x == 44 || x == 45 || (y >= 20 && y < 22 && x < 60);

        CELD_AT (&s.depth, x, y) = board;
        CELD_AT (&s.ink, x, y) = board ? x >= 52 && x < 78 : !line;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = board ? (x >= 52 && x < 78 ? 0.2f : 0) : line ? 0 : paper[c];
      }
  for (int step = 1; step <= 5; step++)
    for (int eye = -1; eye <= 1; eye += 2)
      {
        CeldColours view = look_at_depth (&s, celd_camera_eye (eye), 0.02 * step * s.width);
        double      moved = -eye * 0.01 * step * s.width;

        for (int y = 0; y < s.height; y++)
          for (int x = 50; x < 80; x++)
            for (int c = 0; c < 4 && (x + 1 <= 50 + moved || x >= 80 + moved) && (y < 20 || y >= 22); c++)
              NEAR (CELD_RGBA (&view, x, y)[c], paper[c], 1e-4);
        free (view.data);
      }
  layer_scene_close (&s);
}

/* Any width and height, several bands of rows: without depth both ways give the art. */
static void
odd_sizes_give_the_art_without_depth (void)
{
  uint32_t seed = 3;

  for (int size = 1; size < 90; size += 1 + size / 7)
    {
      LayerScene s = layer_scene (size, 90 - size);

          for (int i = 0; i < s.width * s.height; i++)
        {
          s.depth.data[i] = 0.5f;
          for (int c = 0; c < 3; c++)
            s.art.data[4 * i + c] = (float) check_random (&seed, 100) / 100;
        }
      for (int way = 0; way < 2; way++)
        {
          CeldColours view = look_at_depth (&s, (CeldCamera) { 0, way ? 1 : 0, 1 }, 0.1 * size);

          for (int i = 0; i < 4 * s.width * s.height; i++)
            NEAR (view.data[i], s.art.data[i], 1e-6);
          free (view.data);
        }
      layer_scene_close (&s);
    }
}

/* One depth everywhere: both eyes see the art. */
static void
constant_depth_gives_both_eyes_the_art (void)
{
  LayerScene s = draw_board ();

  for (int i = 0; i < W * H; i++)
    s.depth.data[i] = 0.37f;
  for (int eye = -1; eye <= 1; eye += 2)
    {
      CeldColours view = look_at_depth (&s, celd_camera_eye (eye), 15);

      for (int i = 0; i < 4 * W * H; i++)
        NEAR (view.data[i], s.art.data[i], 1e-6);
      free (view.data);
    }
  layer_scene_close (&s);
}

/* Progress is reported every 64 rows. */
static void
the_step_can_be_cancelled (void)
{
  LayerScene   s = layer_scene (3, 70);
  CeldSettings settings = celd_settings ();
  CeldScene   *scene = NULL;
  CeldHost     refuses = { check_refuse, NULL, NULL };

  CHECK (celd_scene_of_depth (&s.art, &s.ink, &s.depth, &settings, &refuses, &scene) == CELD_CANCELLED && !scene);
  CHECK (celd_scene_of_depth (&s.art, &s.ink, &s.depth, &settings, NULL, &scene) == CELD_OK && scene);
  celd_scene_free (scene);
  layer_scene_close (&s);
}

int
main (void)
{
  RUN (outlines_leave_no_ghost);
  RUN (boxes_move_by_half_the_disparity);
  RUN (views_have_no_seams);
  RUN (the_nearest_depth_is_in_the_last_group);
  RUN (views_have_no_holes);
  RUN (depth_of_any_kind_leaves_no_hole);
  RUN (uncovered_paper_has_its_own_colour);
  RUN (odd_sizes_give_the_art_without_depth);
  RUN (constant_depth_gives_both_eyes_the_art);
  RUN (the_step_can_be_cancelled);
  return DONE;
}
