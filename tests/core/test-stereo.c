/* Views from the side: how far what moves, what comes into sight, and two views in one picture.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"

enum { W = 80, H = 30 };

/* A sheet (label 2, depth 1) from x = 30 to 49 with an outline, before paper of depth 0; random greys on both. */
static LayerScene
draw_sheet (CeldPlane *depth)
{
  LayerScene s = layer_scene (W, H);
  uint32_t   seed = 5;

  CHECK (celd_plane_new (W, H, depth) == CELD_OK);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W; x++)
      {
        bool  sheet = x >= 30 && x < 50 && y >= 6 && y < 24, line = sheet && (x < 32 || x >= 48 || y < 8 || y >= 22);
        float grey = line ? 0 : (sheet ? 0.3f : 0.7f) + 0.25f * (float) check_random (&seed, 1000) / 1000;

        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = sheet ? 2 : 1;
        CELD_AT (&s.ink, x, y) = !line;
        CELD_AT (depth, x, y) = sheet;
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

/* A view with so many pixels between depth 1 and 0. */
static CeldColours
look (const LayerScene *s, const CeldPlane *depth, double eye, double pixels, double convergence, const CeldRun *run)
{
  CeldColours  view = new_colours (s->width, s->height);
  CeldSettings settings = celd_settings ();
  CeldLayers  *layers = cut (s);

  settings.disparity   = (float) (pixels / s->width);
  settings.convergence = (float) convergence;
  CHECK (celd_stereo_view (layers, &s->own, depth, eye, &settings, run, &view) == CELD_OK);
  celd_layers_free (layers);
  return view;
}

/* Crossed disparity: what is nearer lies further to the right for the left eye, by half of what was asked for. */
static void
sheets_move_by_what_is_asked_for (void)
{
  CeldPlane  depth;
  LayerScene s = draw_sheet (&depth);

  for (int eye = -1; eye <= 1; eye += 2)
    {
      CeldColours view = look (&s, &depth, eye, 12, 0, NULL);
      int         moved = -6 * eye;

      for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
          {
            bool sheet = x - moved >= 30 && x - moved < 50 && y >= 6 && y < 24;
            bool hidden = x >= 30 && x < 50 && y >= 6 && y < 24;

            if (sheet)
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

/* What comes into sight is paper, not a ghost of the outline that was before it. */
static void
what_comes_into_sight_is_paper (void)
{
  CeldPlane   depth;
  LayerScene  s = draw_sheet (&depth);
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
        bool sheet = x >= 20 && x < 60;

        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = sheet ? 2 : 1;
        CELD_AT (&depth, x, y) = sheet;
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

/* One depth everywhere, and no disparity, and the eye in the middle: the art. */
static void
without_depth_views_are_the_art (void)
{
  CeldPlane  depth;
  LayerScene s = draw_sheet (&depth);

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

/* The depth on the screen stays where it is; paper beyond the frame goes on. */
static void
convergence_says_what_stays (void)
{
  CeldPlane   depth;
  LayerScene  s = draw_sheet (&depth);
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

/* A slope stretches without cracks, and folds without losing what is near. */
static void
slopes_have_no_cracks (void)
{
  CeldPlane  depth;
  LayerScene s = draw_sheet (&depth);

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
  LayerScene  s = draw_sheet (&depth);
  CeldRun     backwards = { NULL, check_backwards, NULL };
  CeldColours one = look (&s, &depth, 0.7, 9, 0.4, NULL), other = look (&s, &depth, 0.7, 9, 0.4, &backwards);

  CHECK (!memcmp (one.data, other.data, 4 * W * H * sizeof (float)));
  free (one.data);
  free (other.data);
  free (depth.data);
  layer_scene_close (&s);
}

static void
comfort_is_told (void)
{
  CeldPlane    depth;
  LayerScene   s = draw_sheet (&depth);
  CeldSettings settings = celd_settings ();
  CeldComfort  comfort;

  settings.disparity   = 0.1f;
  settings.convergence = 0.25f;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  NEAR (comfort.front, 0.075, 1e-6);
  NEAR (comfort.behind, 0.025, 1e-6);
  CHECK (!comfort.cut_left && !comfort.cut_right);
  CELD_AT (&depth, W - 1, 3) = 1;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  CHECK (!comfort.cut_left && comfort.cut_right);
  settings.convergence = 1; /* nothing is in front of the screen */
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_OK);
  CHECK (!comfort.cut_left && !comfort.cut_right);
  NEAR (comfort.front, 0, 1e-9);
  settings.convergence = 2;
  CHECK (celd_stereo_comfort (&depth, &settings, &comfort) == CELD_BAD_VALUE);
  free (depth.data);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ two views in one picture */

/* White and greys look through glasses as they are; each glass sees its own eye's view. */
static void
glasses_keep_white_and_greys (void)
{
  for (int format = CELD_STEREO_GREY; format <= (int) CELD_STEREO_DUBOIS; format++)
    for (int k = 0; k <= 10; k++)
      {
        float       grey[4] = { (float) k / 10, (float) k / 10, (float) k / 10, 1 }, to[4];
        CeldColours view = { 1, 1, 1, grey }, joined = { 1, 1, 1, to };

        CHECK (celd_stereo_join (&view, &view, (CeldStereo) format, &joined) == CELD_OK);
        for (int c = 0; c < 3; c++)
          NEAR (to[c], grey[c], 0.002);
        NEAR (to[3], 1, 0);
      }
}

static void
the_left_view_is_red (void)
{
  for (int format = CELD_STEREO_GREY; format <= (int) CELD_STEREO_DUBOIS; format++)
    {
      float       white[4] = { 1, 1, 1, 1 }, black[4] = { 0, 0, 0, 1 }, to[4];
      CeldColours one = { 1, 1, 1, white }, other = { 1, 1, 1, black }, joined = { 1, 1, 1, to };

      CHECK (celd_stereo_join (&one, &other, (CeldStereo) format, &joined) == CELD_OK);
      CHECK (to[0] > 0.95f && to[1] < 0.05f && to[2] < 0.05f);
      CHECK (celd_stereo_join (&other, &one, (CeldStereo) format, &joined) == CELD_OK);
      CHECK (to[0] < 0.05f && to[1] > 0.95f && to[2] > 0.95f);
    }
}

/* Pixels of the left view are 1, 2, 3, ...; those of the right one 101, 102, 103, ... */
static void
views_lie_where_the_format_says (void)
{
  enum { w = 3, h = 2 };
  static const struct { CeldStereo format; int width, height; float pixel[12]; } cases[] = {
    { CELD_STEREO_LEFT, w, h, { 1, 2, 3, 4, 5, 6 } },
    { CELD_STEREO_RIGHT, w, h, { 101, 102, 103, 104, 105, 106 } },
    { CELD_STEREO_SIDE_BY_SIDE, 2 * w, h, { 1, 2, 3, 101, 102, 103, 4, 5, 6, 104, 105, 106 } },
    { CELD_STEREO_CROSSED, 2 * w, h, { 101, 102, 103, 1, 2, 3, 104, 105, 106, 4, 5, 6 } },
    { CELD_STEREO_HALF_SIDE_BY_SIDE, w, h, { 1.5f, 3, 101.5f, 4.5f, 6, 104.5f } },
    { CELD_STEREO_OVER_UNDER, w, 2 * h, { 1, 2, 3, 4, 5, 6, 101, 102, 103, 104, 105, 106 } },
    { CELD_STEREO_INTERLACED, w, h, { 1, 2, 3, 104, 105, 106 } },
  };
  CeldColours left = new_colours (w, h), right = new_colours (w, h);

  for (int i = 0; i < 4 * w * h; i++)
    {
      left.data[i]  = i % 4 == 3 ? 1 : (float) (i / 4 + 1);
      right.data[i] = i % 4 == 3 ? 1 : (float) (i / 4 + 101);
    }
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
    {
      int         width = w, height = h;
      CeldColours joined;

      celd_stereo_size (cases[k].format, &width, &height);
      CHECK (width == cases[k].width && height == cases[k].height);
      joined = new_colours (width, height);
      CHECK (celd_stereo_join (&left, &right, cases[k].format, &joined) == CELD_OK);
      for (int i = 0; i < width * height; i++)
        NEAR (joined.data[4 * i + 1], cases[k].pixel[i], 0);
      joined.width--;
      CHECK (celd_stereo_join (&left, &right, cases[k].format, &joined) == CELD_BAD_SIZE);
      free (joined.data);
    }
  free (left.data);
  free (right.data);
}

static void
bad_input_is_refused (void)
{
  CeldPlane    depth;
  LayerScene   s = draw_sheet (&depth);
  CeldColours  view = new_colours (W, H);
  CeldSettings settings = celd_settings ();
  CeldLayers  *layers = cut (&s);
  CeldRun      refuses = { check_refuse, NULL, NULL };

  depth.data[77] = NAN;
  CHECK (celd_stereo_view (layers, &s.own, &depth, 1, &settings, &refuses, &view) == CELD_CANCELLED);
  CHECK (celd_stereo_view (layers, &s.own, &depth, 1.1, &settings, NULL, &view) == CELD_BAD_VALUE);
  CHECK (celd_stereo_view (layers, &s.own, &depth, NAN, &settings, NULL, &view) == CELD_BAD_VALUE);
  settings.disparity = -1;
  CHECK (celd_stereo_view (layers, &s.own, &depth, 1, &settings, NULL, &view) == CELD_BAD_VALUE);
  settings.disparity = 0.1f;
  CHECK (celd_stereo_view (layers, &s.own, &depth, 1, &settings, NULL, &view) == CELD_OK);
  for (int i = 0; i < 4 * W * H; i++)
    CHECK (view.data[i] >= 0 && view.data[i] <= 1.0001f);
  view.height--;
  CHECK (celd_stereo_view (layers, &s.own, &depth, 1, &settings, NULL, &view) == CELD_BAD_SIZE);
  celd_layers_free (layers);
  free (view.data);
  free (depth.data);
  layer_scene_close (&s);
}

int
main (void)
{
  RUN (sheets_move_by_what_is_asked_for);
  RUN (what_comes_into_sight_is_paper);
  RUN (disparity_is_right_between_pixels);
  RUN (without_depth_views_are_the_art);
  RUN (convergence_says_what_stays);
  RUN (slopes_have_no_cracks);
  RUN (the_order_of_jobs_does_not_matter);
  RUN (comfort_is_told);
  RUN (glasses_keep_white_and_greys);
  RUN (the_left_view_is_red);
  RUN (views_lie_where_the_format_says);
  RUN (bad_input_is_refused);
  return DONE;
}
