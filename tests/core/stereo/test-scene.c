/* Views of scenes of layers and of depth alone: how far things move, and what is uncovered.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "base/base.h"

enum { W = 80, H = 30 };

/* A board (label 2, depth 1) from x = 30 to 49 with an outline, in front of paper of depth 0; random greys on both. */
static LayerScene
draw_board (CeldPlane *depth)
{
  LayerScene s = layer_scene (W, H);
  uint32_t   seed = 5;

  CHECK (celd_plane_new (W, H, depth) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool  board = x >= 30 && x < 50 && y >= 6 && y < 24, line = board && (x < 32 || x >= 48 || y < 8 || y >= 22);
        float grey = line ? 0 : (board ? 0.3f : 0.7f) + 0.25f * (float) check_random (&seed, 1000) / 1000;

        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = board ? 2 : 1;
        CELD_AT (&s.ink, x, y) = !line;
        CELD_AT (depth, x, y) = board;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = grey;
      }
  return s;
}

static CeldLayers *
cut (const LayerScene *s)
{
  CeldLayers *layers = NULL;

  CHECK (celd_layers_cut (&s->ink, &s->own, s->level, 2, &s->art, 1, 0, true, NULL, &layers) == CELD_OK);
  return layers;
}

static CeldColours
new_colours (int width, int height)
{
  size_t n = 4 * (size_t) width * (size_t) height;

  return (CeldColours) { width, height, (size_t) width, calloc (n, sizeof (float)) };
}

/* A view with that many pixels of disparity between depth 1 and 0. */
static CeldColours
look (const LayerScene *s, const CeldPlane *depth, double eye, double pixels, double convergence, const CeldHost *host)
{
  CeldColours  view = new_colours (s->width, s->height);
  CeldSettings settings = celd_settings ();
  CeldLayers  *layers = cut (s);
  CeldScene   *scene = NULL;

  settings.disparity   = (float) (pixels / s->width);
  settings.convergence = (float) convergence;
  CHECK (celd_scene_of_layers (layers, &s->own, depth, host, &scene) == CELD_OK);
  CHECK (celd_scene_view (scene, celd_camera_eye (eye), &settings, host, &view) == CELD_OK);
  celd_scene_free (scene);
  celd_layers_free (layers);
  return view;
}

/* Crossed disparity: nearer things lie further to the right for the left eye, by half of the disparity. */
static void
boards_move_by_what_is_asked_for (void)
{
  CeldPlane  depth;
  LayerScene s = draw_board (&depth);

  for (int eye = -1; eye <= 1; eye += 2)
    {
      CeldColours view = look (&s, &depth, eye, 12, 0, NULL);
      int         moved = -6 * eye;

      for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
          {
            bool board = x - moved >= 30 && x - moved < 50 && y >= 6 && y < 24;
            bool hidden = x >= 30 && x < 50 && y >= 6 && y < 24;

            if (board)
              NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x - moved, y)[0], 1e-5);
            else if (!hidden)
              NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x, y)[0], 1e-5);
            NEAR (CELD_RGBA (&view, x, y)[3], 1, 1e-5);
          }
      free (view.data);
    }
  free (depth.data);
  layer_scene_close (&s);
}

/* Uncovered pixels are paper, not a ghost of the outline. */
static void
what_comes_into_sight_is_paper (void)
{
  CeldPlane   depth;
  LayerScene  s = draw_board (&depth);
  CeldColours view = look (&s, &depth, -1, 16, 0, NULL);

  for (int y = 6; y < 24; y++)
    for (int x = 30; x < 38; x++)
      CHECK (CELD_RGBA (&view, x, y)[0] >= 0.69f);
  free (view.data);
  free (depth.data);
  layer_scene_close (&s);
}

/* The middle of a dark bar, to a hundredth of a pixel. */
static void
disparity_is_right_between_pixels (void)
{
  CeldPlane  depth;
  LayerScene s = layer_scene (W, H);

  CHECK (celd_plane_new (W, H, &depth) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool board = x >= 20 && x < 60;

        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = board ? 2 : 1;
        CELD_AT (&depth, x, y) = board;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = x == 39 || x == 40 ? 0 : x == 38 || x == 41 ? 0.5f : 1;
      }
  for (int k = 0; k <= 10; k++)
    {
      CeldColours view = look (&s, &depth, -1, k, 0, NULL);
      double      sum = 0, all = 0;

      for (int x = 30; x < 56; x++)
        {
          double dark = 1 - (double) CELD_RGBA (&view, x, 15)[1];

          sum += dark * (x + 0.5);
          all += dark;
        }
      NEAR (sum / all, 40 + 0.5 * k, 0.01);
      free (view.data);
    }
  free (depth.data);
  layer_scene_close (&s);
}

/* One depth everywhere, no disparity, or the eye in the middle: the art. */
static void
without_depth_views_are_the_art (void)
{
  CeldPlane  depth;
  LayerScene s = draw_board (&depth);

  for (int way = 0; way < 3; way++)
    {
      CeldColours view;

      for (int i = 0; i < W * H && way == 2; i++)
        depth.data[i] = 0.7f;
      view = look (&s, &depth, way ? 1 : 0, way == 1 ? 0 : 15, 0.3, NULL);
      for (int i = 0; i < 4 * W * H; i++)
        NEAR (view.data[i], s.art.data[i], 1e-5);
      free (view.data);
    }
  free (depth.data);
  layer_scene_close (&s);
}

/* What has the depth of the screen does not move; paper continues beyond the frame. */
static void
convergence_says_what_stays (void)
{
  CeldPlane   depth;
  LayerScene  s = draw_board (&depth);
  CeldColours view = look (&s, &depth, 1, 12, 1, NULL);

  for (int y = 6; y < 24; y++)
    for (int x = 30; x < 50; x++)
      NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x, y)[0], 1e-5);
  for (int y = 0; y < H; y++)
    {
      for (int x = 0; x < 20; x++)
        NEAR (CELD_RGBA (&view, x + 6, y)[0], art_at (&s, x, y)[0], 1e-5);
      for (int x = 0; x < 6; x++)
        NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, 0, y)[0], 1e-5);
    }
  free (view.data);
  free (depth.data);
  layer_scene_close (&s);
}

/* A slope stretches without holes, and folds without losing its nearer parts. */
static void
slopes_have_no_cracks (void)
{
  CeldPlane  depth;
  LayerScene s = draw_board (&depth);

  for (int i = 0; i < W * H; i++)
    depth.data[i] = (float) (i % W) / W;
  for (int eye = -1; eye <= 1; eye += 2)
    {
      CeldColours view = look (&s, &depth, eye, 0.2 * W, 0.5, NULL);

      for (int i = 3; i < 4 * W * H; i += 4)
        NEAR (view.data[i], 1, 1e-4);
      free (view.data);
    }
  free (depth.data);
  layer_scene_close (&s);
}

static void
the_order_of_jobs_does_not_matter (void)
{
  CeldPlane   depth;
  LayerScene  s = draw_board (&depth);
  CeldHost    backwards = { NULL, check_backwards, NULL };
  CeldColours one = look (&s, &depth, 0.7, 9, 0.4, NULL), other = look (&s, &depth, 0.7, 9, 0.4, &backwards);

  CHECK (!memcmp (one.data, other.data, 4 * W * H * sizeof (float)));
  free (one.data);
  free (other.data);
  free (depth.data);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ the camera */

/* Vertical views equal horizontal ones with rows and columns exchanged. */
static void
cameras_move_up_and_down (void)
{
  CeldPlane   depth;
  LayerScene  s = draw_board (&depth);
  CeldLayers *layers = cut (&s);
  CeldScene  *scene = NULL;
  CeldColours view = new_colours (W, H);
  CeldSettings settings = celd_settings ();

  settings.disparity   = 10.0f / W;
  settings.convergence = 0;
  CHECK (celd_scene_of_layers (layers, &s.own, &depth, NULL, &scene) == CELD_OK);
  CHECK (celd_scene_view (scene, (CeldCamera) { 0.4, -0.8, 1 }, &settings, NULL, &view) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        int  from_x = x + 2, from_y = y - 4;
        bool board = from_x >= 30 && from_x < 50 && from_y >= 6 && from_y < 24;
        bool hidden = x >= 30 && x < 50 && y >= 6 && y < 24;

        if (board)
          NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, from_x, from_y)[0], 1e-5);
        else if (!hidden)
          NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x, y)[0], 1e-5);
        else
          CHECK (CELD_RGBA (&view, x, y)[0] >= 0.69f);
        NEAR (CELD_RGBA (&view, x, y)[3], 1, 1e-5);
      }
  celd_scene_free (scene);
  celd_layers_free (layers);
  free (view.data);
  free (depth.data);
  layer_scene_close (&s);
}

/* Half as wide about the middle, without depth; paper continues beyond the frame. */
static void
what_is_turned_is_narrow (void)
{
  LayerScene   s = layer_scene (W, H);
  CeldPlane    depth;
  CeldLayers  *layers;
  CeldScene   *scene = NULL;
  CeldColours  view = new_colours (W, H);
  CeldSettings settings = celd_settings ();

  CHECK (celd_plane_new (W, H, &depth) == CELD_OK);
  for (int i = 0; i < W * H; i++)
    {
      depth.data[i] = 3;
      for (int c = 0; c < 3; c++)
        s.art.data[4 * i + c] = (float) (i % W) / W;
    }
  layers = cut (&s);
  CHECK (celd_scene_of_layers (layers, &s.own, &depth, NULL, &scene) == CELD_OK);
  CHECK (celd_scene_view (scene, (CeldCamera) { 1, 0, 0.5 }, &settings, NULL, &view) == CELD_OK);
  for (int x = 0; x < W; x++)
    {
      double from = (x + 0.5 - W / 2) * 2 + W / 2 - 0.5;

      NEAR (CELD_RGBA (&view, x, 9)[1], fmax (0, fmin (from, W - 1)) / W, from < 1 || from > W - 2 ? 0.01 : 1e-4);
    }
  celd_scene_free (scene);
  celd_layers_free (layers);
  free (view.data);
  free (depth.data);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ depth alone */

/* A box of depth 1 in front of paper of depth 0, with flat colours and an antialiased outline: left edge at x =
 * 30.3. */
static LayerScene
draw_box (CeldPlane *depth)
{
  LayerScene s = layer_scene (W, H);

  CHECK (celd_plane_new (W, H, depth) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        double side = fmin (fmin (x + 0.5 - 29.8, 50.2 - x - 0.5), fmin (y + 0.5 - 6, 24 - y - 0.5));
        double inside = fmax (0, fmin (side + 0.5, 1)), fill = fmax (0, fmin (side - 1.5, 1));

        CELD_AT (&s.ink, x, y) = (float) (1 - inside + fill);
        CELD_AT (depth, x, y) = inside > 0.5;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = (float) ((1 - inside) * (c == 2 ? 0.9 : 0.8) + fill * (c == 0 ? 0.6 : 0.3));
      }
  return s;
}

static CeldColours
look_at_depth (const LayerScene *s, const CeldPlane *depth, CeldCamera camera, double pixels)
{
  CeldColours  view = new_colours (s->width, s->height);
  CeldSettings settings = celd_settings ();
  CeldScene   *scene = NULL;

  settings.disparity   = (float) (pixels / s->width);
  settings.convergence = 0;
  CHECK (celd_scene_of_depth (&s->art, &s->ink, depth, &settings, NULL, &scene) == CELD_OK);
  CHECK (celd_scene_view (scene, camera, &settings, NULL, &view) == CELD_OK);
  celd_scene_free (scene);
  return view;
}

/* From the front it is the art; from the side the box has moved with its antialiased edges, and leaves paper without
 * its line. */
static void
depth_alone_leaves_no_ghost (void)
{
  CeldPlane  depth;
  LayerScene s = draw_box (&depth);

  for (int eye = -1; eye <= 1; eye++)
    {
      CeldColours view = look_at_depth (&s, &depth, celd_camera_eye (eye), 16);
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
  free (depth.data);
  layer_scene_close (&s);
}

/* The box's mean, to a twentieth of a pixel, at any disparity. */
static void
depth_alone_moves_by_what_is_asked_for (void)
{
  CeldPlane  depth;
  LayerScene s = draw_box (&depth);

  for (int k = 0; k <= 13; k++)
    {
      CeldColours view = look_at_depth (&s, &depth, celd_camera_eye (-1), k);
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
  free (depth.data);
  layer_scene_close (&s);
}

/* Depth of all kinds, and noise as art: no view has holes. */
static void
depth_alone_leaves_no_holes (void)
{
  CeldPlane  depth;
  LayerScene s = draw_board (&depth);
  uint32_t   seed = 11;

  for (int round = 0; round < 12; round++)
    {
      double     angle = round;
      CeldCamera camera = { sin (angle), round % 3 ? 0 : cos (angle), 1 };

      for (int i = 0; i < W * H; i++)
        {
          int block = i / W / 6 + 31 * (i % W / 9);

          depth.data[i] = round % 2 ? (float) (block * 7 % 11) / 10 : (float) check_random (&seed, 5) / 4;
          s.ink.data[i] = (float) check_random (&seed, 3) / 2;
        }
      for (int pixels = 1; pixels < 14; pixels += 4)
        {
          CeldColours view = look_at_depth (&s, &depth, camera, pixels);

          for (int i = 0; i < W * H && camera.y == 0; i++)
            CHECK (view.data[4 * i + 3] > 0.999f);
          for (int i = 0; i < 4 * W * H; i++)
            CHECK (view.data[i] >= 0 && view.data[i] <= 1.0001f);
          free (view.data);
        }
    }
  free (depth.data);
  layer_scene_close (&s);
}

/* Any width and height, several bands of rows: without depth both ways give the art. */
static void
odd_sizes_are_fine (void)
{
  uint32_t seed = 3;

  for (int size = 1; size < 90; size += 1 + size / 7)
    {
      LayerScene s = layer_scene (size, 90 - size);
      CeldPlane  depth;

      CHECK (celd_plane_new (s.width, s.height, &depth) == CELD_OK);
      for (int i = 0; i < s.width * s.height; i++)
        {
          depth.data[i] = 0.5f;
          for (int c = 0; c < 3; c++)
            s.art.data[4 * i + c] = (float) check_random (&seed, 100) / 100;
        }
      for (int way = 0; way < 2; way++)
        {
          CeldColours view = look_at_depth (&s, &depth, (CeldCamera) { 0, way ? 1 : 0, 1 }, 0.1 * size);

          for (int i = 0; i < 4 * s.width * s.height; i++)
            NEAR (view.data[i], s.art.data[i], 1e-6);
          free (view.data);
        }
      free (depth.data);
      layer_scene_close (&s);
    }
}

/* One depth everywhere: both eyes see the art, bit for bit. */
static void
constant_depth_is_flat (void)
{
  CeldPlane  depth;
  LayerScene s = draw_board (&depth);

  for (int i = 0; i < W * H; i++)
    depth.data[i] = 0.37f;
  for (int way = 0; way < 2; way++)
    {
      CeldColours left = way ? look (&s, &depth, -1, 15, 0.3, NULL)
                             : look_at_depth (&s, &depth, celd_camera_eye (-1), 15);
      CeldColours right = way ? look (&s, &depth, 1, 15, 0.3, NULL)
                              : look_at_depth (&s, &depth, celd_camera_eye (1), 15);

      CHECK (!memcmp (left.data, right.data, 4 * W * H * sizeof (float)));
      for (int i = 0; i < 4 * W * H; i++)
        NEAR (left.data[i], s.art.data[i], 1e-6);
      free (left.data);
      free (right.data);
    }
  free (depth.data);
  layer_scene_close (&s);
}

static void
bad_input_is_refused (void)
{
  CeldPlane    depth;
  LayerScene   s = draw_board (&depth);
  CeldColours  view = new_colours (W, H);
  CeldSettings settings = celd_settings ();
  CeldLayers  *layers = cut (&s);
  CeldScene   *scene = NULL;
  CeldCamera   eye = celd_camera_eye (1);
  CeldHost     refuses = { check_refuse, NULL, NULL };

  depth.data[77] = NAN;
  depth.data[78] = INFINITY;
  depth.data[79] = -3e38f;
  CHECK (celd_scene_of_layers (layers, &s.own, &depth, &refuses, &scene) == CELD_CANCELLED);
  CHECK (!scene);
  for (int way = 0; way < 2; way++)
    {
      settings.disparity = 0.1f;
      if (way)
        CHECK (celd_scene_of_depth (&s.art, &s.ink, &depth, &settings, NULL, &scene) == CELD_OK);
      else
        CHECK (celd_scene_of_layers (layers, &s.own, &depth, NULL, &scene) == CELD_OK);
      CHECK (celd_scene_view (scene, eye, &settings, &refuses, &view) == CELD_CANCELLED);
      CHECK (celd_scene_view (scene, celd_camera_eye (1.1), &settings, NULL, &view) == CELD_BAD_VALUE);
      CHECK (celd_scene_view (scene, celd_camera_eye (NAN), &settings, NULL, &view) == CELD_BAD_VALUE);
      CHECK (celd_scene_view (scene, (CeldCamera) { 0, 2, 1 }, &settings, NULL, &view) == CELD_BAD_VALUE);
      CHECK (celd_scene_view (scene, (CeldCamera) { 0, 0, 0 }, &settings, NULL, &view) == CELD_BAD_VALUE);
      CHECK (celd_scene_view (scene, eye, &settings, NULL, &view) == CELD_OK);
      CHECK (celd_scene_view (scene, (CeldCamera) { 1, -1, 0.2 }, &settings, NULL, &view) == CELD_OK);
      for (int i = 0; i < 4 * W * H; i++)
        CHECK (view.data[i] >= 0 && view.data[i] <= 1.0001f);
      settings.disparity = -1;
      CHECK (celd_scene_view (scene, eye, &settings, NULL, &view) == CELD_BAD_VALUE);
      CHECK (celd_scene_of_depth (&s.art, &s.ink, &depth, &settings, NULL, &scene) == CELD_BAD_VALUE);
      settings.disparity = 0.1f;
      view.height--;
      CHECK (celd_scene_view (scene, eye, &settings, NULL, &view) == CELD_BAD_SIZE);
      view.height++;
      celd_scene_free (scene);
    }
  depth.height--;
  CHECK (celd_scene_of_layers (layers, &s.own, &depth, NULL, &scene) == CELD_BAD_SIZE);
  CHECK (celd_scene_of_depth (&s.art, &s.ink, &depth, &settings, NULL, &scene) == CELD_BAD_SIZE);
  celd_scene_free (NULL);
  celd_layers_free (layers);
  free (view.data);
  free (depth.data);
  layer_scene_close (&s);
}

/* Progress is reported every 64 rows. */
static void
a_scene_of_depth_can_be_cancelled (void)
{
  CeldColours  art = new_colours (3, 70);
  CeldPlane    ink, depth;
  CeldSettings settings = celd_settings ();
  CeldScene   *scene = NULL;
  CeldHost     refuses = { check_refuse, NULL, NULL };

  CHECK (celd_plane_new (3, 70, &ink) == CELD_OK && celd_plane_new (3, 70, &depth) == CELD_OK);
  memset (ink.data, 0, 3 * 70 * sizeof *ink.data);
  memset (depth.data, 0, 3 * 70 * sizeof *depth.data);
  CHECK (celd_scene_of_depth (&art, &ink, &depth, &settings, &refuses, &scene) == CELD_CANCELLED && !scene);
  CHECK (celd_scene_of_depth (&art, &ink, &depth, &settings, NULL, &scene) == CELD_OK && scene);
  celd_scene_free (scene);
  free (ink.data);
  free (depth.data);
  free (art.data);
}

int
main (void)
{
  RUN (boards_move_by_what_is_asked_for);
  RUN (what_comes_into_sight_is_paper);
  RUN (disparity_is_right_between_pixels);
  RUN (without_depth_views_are_the_art);
  RUN (convergence_says_what_stays);
  RUN (slopes_have_no_cracks);
  RUN (the_order_of_jobs_does_not_matter);
  RUN (cameras_move_up_and_down);
  RUN (what_is_turned_is_narrow);
  RUN (depth_alone_leaves_no_ghost);
  RUN (depth_alone_moves_by_what_is_asked_for);
  RUN (depth_alone_leaves_no_holes);
  RUN (odd_sizes_are_fine);
  RUN (constant_depth_is_flat);
  RUN (bad_input_is_refused);
  RUN (a_scene_of_depth_can_be_cancelled);
  return DONE;
}
