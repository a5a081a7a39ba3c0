/* Views of scenes of layers: how far things move, and what is uncovered.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "board.h"
#include "stereo/scene.h"

static CeldLayers *
cut (const LayerScene *s)
{
  return layer_scene_cut (s, 2, CELD_STORE_FLOAT, true);
}

/* A view with that many pixels of disparity between depth 1 and 0. */
static CeldColours
look_from (const LayerScene *s, CeldCamera camera, double pixels, double convergence, const CeldHost *host)
{
  CeldSettings settings = celd_settings ();
  CeldLayers  *layers = cut (s);
  CeldScene   *scene = NULL;
  CeldColours  view;

  settings.disparity   = (float) (pixels / s->width);
  settings.convergence = (float) convergence;
  CHECK (celd_scene_of_layers (layers, &s->own, &s->depth, host, &scene) == CELD_OK);
  view = view_of (scene, s->width, s->height, camera, &settings, host);
  celd_layers_free (layers);
  return view;
}

static CeldColours
look (const LayerScene *s, double eye, double pixels, double convergence, const CeldHost *host)
{
  return look_from (s, celd_camera_eye (eye), pixels, convergence, host);
}

/* Crossed disparity: nearer things lie further to the right for the left eye, by half of the disparity. */
static void
nearer_layers_move_by_half_the_disparity (void)
{
  LayerScene s = draw_board ();

  for (int eye = -1; eye <= 1; eye += 2)
    {
      CeldColours view = look (&s, eye, 12, 0, NULL);
      int         moved = -6 * eye;

      for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
          {
            bool board = is_on_board (x - moved, y);
            bool hidden = is_on_board (x, y);

            if (board)
              NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x - moved, y)[0], 1e-5);
            else if (!hidden)
              NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x, y)[0], 1e-5);
            NEAR (CELD_RGBA (&view, x, y)[3], 1, 1e-5);
          }
      free (view.data);
    }
  layer_scene_close (&s);
}

/* Uncovered pixels are paper, not a ghost of the outline. */
static void
uncovered_pixels_are_paper (void)
{
  LayerScene  s = draw_board ();
  CeldColours view = look (&s, -1, 16, 0, NULL);

  for (int y = 6; y < 24; y++)
    for (int x = 30; x < 38; x++)
      CHECK (CELD_RGBA (&view, x, y)[0] >= 0.69f);
  free (view.data);
  layer_scene_close (&s);
}

/* The middle of a dark bar, to a hundredth of a pixel. */
static void
disparity_is_precise_to_a_hundredth_of_a_pixel (void)
{
  LayerScene s = layer_scene (W, H);

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool board = x >= 20 && x < 60;

        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = board ? 2 : 1;
        CELD_AT (&s.depth, x, y) = board;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = x == 39 || x == 40 ? 0 : x == 38 || x == 41 ? 0.5f : 1;
      }
  for (int k = 0; k <= 10; k++)
    {
      CeldColours view = look (&s, -1, k, 0, NULL);
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
  layer_scene_close (&s);
}

/* One depth everywhere, no disparity, or the eye in the middle: the art. */
static void
views_without_disparity_are_the_art (void)
{
  LayerScene s = draw_board ();

  for (int way = 0; way < 3; way++)
    {
      CeldColours view;

      for (int i = 0; i < W * H && way == 2; i++)
        s.depth.data[i] = 0.7f;
      view = look (&s, way ? 1 : 0, way == 1 ? 0 : 15, 0.3, NULL);
      for (int i = 0; i < 4 * W * H; i++)
        NEAR (view.data[i], s.art.data[i], 1e-5);
      free (view.data);
    }
  layer_scene_close (&s);
}

/* What has the depth of the screen does not move; paper continues beyond the frame. */
static void
the_depth_of_convergence_does_not_move (void)
{
  LayerScene  s = draw_board ();
  CeldColours view = look (&s, 1, 12, 1, NULL);

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
  layer_scene_close (&s);
}

/* A slope stretches without holes, and folds without losing its nearer parts. */
static void
slopes_have_no_cracks (void)
{
  LayerScene s = draw_board ();

  for (int i = 0; i < W * H; i++)
    s.depth.data[i] = (float) (i % W) / W;
  for (int eye = -1; eye <= 1; eye += 2)
    {
      CeldColours view = look (&s, eye, 0.2 * W, 0.5, NULL);

      for (int i = 3; i < 4 * W * H; i += 4)
        NEAR (view.data[i], 1, 1e-4);
      free (view.data);
    }
  layer_scene_close (&s);
}

static void
the_order_of_jobs_does_not_matter (void)
{
  LayerScene  s = draw_board ();
  CeldHost    backwards = { NULL, check_backwards, NULL };
  CeldColours one = look (&s, 0.7, 9, 0.4, NULL), other = look (&s, 0.7, 9, 0.4, &backwards);

  CHECK (!memcmp (one.data, other.data, 4 * W * H * sizeof (float)));
  free (one.data);
  free (other.data);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ what comes into view */

static bool
within (double x, double y, double left, double top, double right, double bottom)
{
  return x > left && x < right && y > top && y < bottom;
}

static double body (double x, double y) { return hypot (x - 45, y - 20) < 27; }
static double body_line (double x, double y) { return body (x, y) && hypot (x - 45, y - 20) > 25; }
static double coat (double x, double y) { return within (x, y, 70, 6, 110, 34); }
static double coat_line (double x, double y) { return coat (x, y) && !within (x, y, 72, 8, 108, 32); }
static double button (double x, double y) { return within (x, y, 85, 16, 95, 24); }

/* A green ball, a red coat before its side, so that little of it is hidden, and a blue button on the coat: views move
 * them apart.  Whatever the disparity, no page is seen between them; the page comes into view beside them. */
static void
parts_that_move_apart_show_no_page (void)
{
  static const float green[3] = { 0.1f, 0.7f, 0.2f }, red[3] = { 0.8f, 0.1f, 0.1f }, blue[3] = { 0.1f, 0.1f, 0.8f };
  static const float depth_of[4] = { 0, 0.4f, 0.9f, 1 };
  LayerScene         s = layer_scene (130, 40);
  CeldSettings       settings = celd_settings ();
  CeldLayers        *layers;
  CeldScene         *scene = NULL;

  layer_scene_paint (&s, 2, green, body, body_line);
  layer_scene_paint (&s, 3, red, coat, coat_line);
  layer_scene_paint (&s, 4, blue, button, NULL);
  for (int i = 0; i < s.width * s.height; i++)
    s.depth.data[i] = depth_of[s.own.owner.data[i] - 1];
  layers = layer_scene_cut (&s, 4, CELD_STORE_FLOAT, true);
  CHECK (celd_scene_of_layers (layers, &s.own, &s.depth, NULL, &scene) == CELD_OK);
  for (int step = 1; step <= 10; step++)
    for (int eye = -1; eye <= 1; eye += 2)
      {
        CeldColours view = new_colours (s.width, s.height);
        double      shift = 0.005 * step * s.width;

        settings.disparity   = (float) step / 100;
        settings.convergence = 0;
        CHECK (celd_scene_view (scene, celd_camera_eye (eye), &settings, NULL, &view) == CELD_OK);
        for (int y = 13; y < 27; y++)
          for (int x = 0; x < s.width; x++)
            {
              const float *colour = CELD_RGBA (&view, x, y);
              bool         page = colour[0] > 0.95f && colour[1] > 0.95f && colour[2] > 0.95f;

              if (x >= 45 && x + 1 <= 109 - shift)
                CHECK (!page);
              if (x + 1 < 18 - shift || x > 110 + shift)
                CHECK (page);
              CHECK (colour[3] > 0.9999f);
            }
        free (view.data);
      }
  celd_scene_free (scene);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* Paper whose depth rises to the right, behind a board: under the board, too. */
static void
depth_goes_on_smoothly_under_what_is_nearer (void)
{
  LayerScene  s = draw_board ();
  CeldLayers *layers = cut (&s);
  CeldScene  *scene = NULL;
  float       depths[W], colour[4 * W];

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      CELD_AT (&s.depth, x, y) = is_on_board (x, y) ? 1 : 0.5f * (float) x / W;
  CHECK (celd_scene_of_layers (layers, &s.own, &s.depth, NULL, &scene) == CELD_OK);
  for (int y = 0; y < H; y++)
    {
      const CeldSceneSpan *span = &scene->span[scene->row[y]];

      CHECK (span->group == 0 && span->x == 0 && span->n == W);
      celd_scene_paint_layer (scene, span, colour, depths);
      for (int x = 0; x < W; x++)
        NEAR (depths[x], 0.5 * x / W, is_on_board (x, y) ? 0.03 : 1e-6);
    }
  celd_scene_free (scene);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ the camera */

/* Vertical views equal horizontal ones with rows and columns exchanged. */
static void
vertical_movement_shifts_columns (void)
{
  LayerScene  s = draw_board ();
  CeldColours view = look_from (&s, (CeldCamera) { 0.4, -0.8, 1 }, 10, 0, NULL);

  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        int  from_x = x + 2, from_y = y - 4;
        bool board = is_on_board (from_x, from_y);
        bool hidden = is_on_board (x, y);

        if (board)
          NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, from_x, from_y)[0], 1e-5);
        else if (!hidden)
          NEAR (CELD_RGBA (&view, x, y)[0], art_at (&s, x, y)[0], 1e-5);
        else
          CHECK (CELD_RGBA (&view, x, y)[0] >= 0.69f);
        NEAR (CELD_RGBA (&view, x, y)[3], 1, 1e-5);
      }
  free (view.data);
  layer_scene_close (&s);
}

/* Half as wide about the middle, without depth; paper continues beyond the frame. */
static void
turned_pictures_are_narrower (void)
{
  LayerScene  s = layer_scene (W, H);
  CeldColours view;

  for (int i = 0; i < W * H; i++)
    {
      s.depth.data[i] = 3;
      for (int c = 0; c < 3; c++)
        s.art.data[4 * i + c] = (float) (i % W) / W;
    }
  view = look_from (&s, (CeldCamera) { 1, 0, 0.5 }, 10, 0.5, NULL);
  for (int x = 0; x < W; x++)
    {
      double from = (x + 0.5 - W / 2) * 2 + W / 2 - 0.5;

      NEAR (CELD_RGBA (&view, x, 9)[1], fmax (0, fmin (from, W - 1)) / W, from < 1 || from > W - 2 ? 0.01 : 1e-4);
    }
  free (view.data);
  layer_scene_close (&s);
}

/* One depth everywhere: both eyes see one picture, bit for bit. */
static void
constant_depth_gives_both_eyes_one_picture (void)
{
  LayerScene  s = draw_board ();
  CeldColours left, right;

  for (int i = 0; i < W * H; i++)
    s.depth.data[i] = 0.37f;
  left  = look (&s, -1, 15, 0.3, NULL);
  right = look (&s, 1, 15, 0.3, NULL);
  CHECK (!memcmp (left.data, right.data, 4 * W * H * sizeof (float)));
  free (left.data);
  free (right.data);
  layer_scene_close (&s);
}

static void
bad_input_is_refused (void)
{
  LayerScene   s = draw_board ();
  CeldColours  view = new_colours (W, H);
  CeldSettings settings = celd_settings ();
  CeldLayers  *layers = cut (&s);
  CeldScene   *scene = NULL;
  CeldCamera   eye = celd_camera_eye (1);
  CeldHost     refuses = { check_refuse, NULL, NULL };

  s.depth.data[77] = NAN;
  s.depth.data[78] = INFINITY;
  s.depth.data[79] = -3e38f;
  CHECK (celd_scene_of_layers (layers, &s.own, &s.depth, &refuses, &scene) == CELD_CANCELLED);
  CHECK (!scene);
  for (int way = 0; way < 2; way++)
    {
      settings.disparity = 0.1f;
      if (way)
        CHECK (celd_scene_of_depth (&s.art, &s.ink, &s.depth, &settings, NULL, &scene) == CELD_OK);
      else
        CHECK (celd_scene_of_layers (layers, &s.own, &s.depth, NULL, &scene) == CELD_OK);
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
      CHECK (celd_scene_of_depth (&s.art, &s.ink, &s.depth, &settings, NULL, &scene) == CELD_BAD_VALUE);
      settings.disparity = 0.1f;
      view.height--;
      CHECK (celd_scene_view (scene, eye, &settings, NULL, &view) == CELD_BAD_SIZE);
      view.height++;
      celd_scene_free (scene);
    }
  s.depth.height--;
  CHECK (celd_scene_of_layers (layers, &s.own, &s.depth, NULL, &scene) == CELD_BAD_SIZE);
  CHECK (celd_scene_of_depth (&s.art, &s.ink, &s.depth, &settings, NULL, &scene) == CELD_BAD_SIZE);
  celd_scene_free (NULL);
  celd_layers_free (layers);
  free (view.data);
  layer_scene_close (&s);
}

int
main (void)
{
  RUN (nearer_layers_move_by_half_the_disparity);
  RUN (uncovered_pixels_are_paper);
  RUN (disparity_is_precise_to_a_hundredth_of_a_pixel);
  RUN (views_without_disparity_are_the_art);
  RUN (the_depth_of_convergence_does_not_move);
  RUN (slopes_have_no_cracks);
  RUN (the_order_of_jobs_does_not_matter);
  RUN (parts_that_move_apart_show_no_page);
  RUN (depth_goes_on_smoothly_under_what_is_nearer);
  RUN (vertical_movement_shifts_columns);
  RUN (turned_pictures_are_narrower);
  RUN (constant_depth_gives_both_eyes_one_picture);
  RUN (bad_input_is_refused);
  return DONE;
}
