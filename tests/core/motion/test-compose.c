/* Pictures and layers of a composition.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fragments.h"
#include "layer-scene.h"
#include "layers/layers.h"

static CeldColours
picture_new (int width, int height)
{
  return (CeldColours) { width, height, (size_t) width, calloc (4 * (size_t) (width * height), sizeof (float)) };
}

/* Regions with antialiased borders, of any colours; `clear`: the page is transparent. */
static LayerScene
random_scene (uint32_t *state, int width, int height, bool clear)
{
  LayerScene s = layer_scene (width, height);

  for (uint32_t k = 0; k < MOST_LABELS; k++)
    s.level[k] = k;
  for (int p = 0; p < width * height; p++)
    {
      bool again = p && check_random (state, 5);

      s.own.owner.data[p] = again ? s.own.owner.data[p - 1] : 1 + check_random (state, 4);
      s.own.under.data[p] = check_random (state, 2) ? s.own.owner.data[p] : 1 + check_random (state, 4);
      if (s.own.under.data[p] != s.own.owner.data[p])
        s.own.coverage.data[p] = (float) check_random (state, 1001) / 1000;
      s.ink.data[p] = (float) check_random (state, 5) / 4;
      for (int c = 0; c < 3; c++)
        s.art.data[4 * p + c] = (float) check_random (state, 256) / 255;
      s.art.data[4 * p + 3] = clear && s.own.owner.data[p] == 1 ? 0 : 1;
    }
  return s;
}

static CeldFragment
scene_at (const LayerScene *s, const CeldLayers *layers, CeldOrder *order, CeldPlacement placement)
{
  *order = (CeldOrder) { .level = (uint32_t *) s->level, .n = 4, .levels = 4 };
  return (CeldFragment) { .layers = layers, .order = order, .page = 1, .placement = placement };
}

/* The picture of one scene, placed. */
static CeldColours
place (const LayerScene *s, CeldPlacement placement, int width, int height)
{
  CeldLayers      *layers = layer_scene_cut (s, 4, CELD_STORE_FLOAT, false);
  CeldOrder        order;
  CeldFragment     fragment = scene_at (s, layers, &order, placement);
  CeldComposition *made = NULL;
  CeldColours      picture = picture_new (width, height);

  CHECK (celd_compose (&fragment, 1, NULL, width, height, NULL, NULL, &made) == CELD_OK);
  CHECK (celd_composition_flatten (made, NULL, &picture) == CELD_OK);
  celd_composition_free (made);
  celd_layers_free (layers);
  return picture;
}

static void
check_pixel (const CeldColours *picture, int x, int y, const float *wanted, double error)
{
  for (int c = 0; c < 4; c++)
    NEAR (CELD_RGBA (picture, x, y)[c] * (c < 3 ? CELD_RGBA (picture, x, y)[3] : 1),
          wanted[c] * (c < 3 ? wanted[3] : 1), error);
}

/* ------------------------------------------------------------------ places */

static void
an_unmoved_drawing_is_itself (void)
{
  uint32_t state = 1;

  for (int round = 0; round < 40; round++)
    {
      int         w = 1 + (int) check_random (&state, 30), h = 1 + (int) check_random (&state, 30);
      LayerScene  s = random_scene (&state, w, h, round % 2);
      CeldColours picture = place (&s, (CeldPlacement) { .scale = 1 }, w, h);

      for (int p = 0; p < w * h; p++)
        check_pixel (&picture, p % w, p / w, s.art.data + 4 * p, 1e-5);
      free (picture.data);
      layer_scene_close (&s);
    }
}

/* Where pixel (x,y) goes by whole turns to the right round the pixel corner in the middle, after mirroring. */
static void
turn_pixel (int w, int h, int quarters, bool flip, int *x, int *y)
{
  int u = 2 * (flip ? w - 1 - *x : *x) + 1 - 2 * (w / 2), v = 2 * *y + 1 - 2 * (h / 2);

  for (int i = 0; i < quarters; i++)
    {
      int old = u;

      u = -v;
      v = old;
    }
  *x = (u - 1) / 2 + w / 2;
  *y = (v - 1) / 2 + h / 2;
  if ((u - 1) % 2 || (v - 1) % 2)
    abort ();
}

/* Pixel by pixel, also out of the picture, in any size. */
static void
quarter_turns_and_mirrors_are_exact (void)
{
  uint32_t state = 9;

  for (int round = 0; round < 64; round++)
    {
      int         w = 1 + (int) check_random (&state, 20), h = 1 + (int) check_random (&state, 20), seen = 0;
      int         dx = (int) check_random (&state, 30) - 5, dy = (int) check_random (&state, 30) - 5;
      int         quarters = round % 4, turns = (int) check_random (&state, 3) - 1;
      bool        flip = round / 4 % 2;
      LayerScene  s = random_scene (&state, w, h, false);
      CeldColours picture = place (&s, (CeldPlacement) { dx, dy, 1, 90 * quarters + 360 * turns, flip }, 32, 32);

      for (int p = 0; p < w * h; p++)
        {
          int x = p % w, y = p / w;

          turn_pixel (w, h, quarters, flip, &x, &y);
          x += dx;
          y += dy;
          if (x < 0 || y < 0 || x >= 32 || y >= 32)
            continue;
          check_pixel (&picture, x, y, s.art.data + 4 * p, 1e-5);
          seen++;
        }
      for (int p = 0; p < 32 * 32; p++)
        seen -= picture.data[4 * p + 3] > 0;
      CHECK (seen == 0); /* and nothing elsewhere */
      free (picture.data);
      layer_scene_close (&s);
    }
}

static double
share_of (double depth)
{
  return fmin (fmax (depth + 0.5, 0), 1);
}

static double disc (double x, double y) { return share_of (18 - hypot (x - 24, y - 20)); }

/* A red disc, alone or on a white page. */
static LayerScene
disc_scene (bool alone)
{
  LayerScene s = layer_scene (50, 40);

  layer_scene_paint (&s, 2, (float[]) { 1, 0, 0 }, disc, NULL);
  for (int p = 0; p < 50 * 40 && alone; p++)
    {
      memcpy (s.art.data + 4 * p, (float[]) { 1, 0, 0 }, 3 * sizeof (float));
      s.art.data[4 * p + 3] = (float) disc (p % 50 + 0.5, p / 50 + 0.5);
    }
  return s;
}

static void
scaling_keeps_the_share_of_area (void)
{
  uint32_t state = 2;

  for (int round = 0; round < 60; round++)
    {
      LayerScene    s = disc_scene (true);
      double        scale = 0.12 * pow (20, check_random (&state, 1000) / 1000.0), sum = 0, x = 0, y = 0;
      CeldPlacement to = { check_random (&state, 1000) / 50.0, check_random (&state, 1000) / 50.0, scale,
                           check_random (&state, 3600) / 10.0, round % 2 };
      CeldColours   picture;

      to.x += 20;
      to.y += 20;
      picture = place (&s, to, 200, 200);
      for (int p = 0; p < 200 * 200; p++)
        {
          double alpha = (double) picture.data[4 * p + 3];

          sum += alpha;
          x   += alpha * (p % 200 + 0.5);
          y   += alpha * (p / 200 + 0.5);
          if (alpha > 0)
            CHECK (picture.data[4 * p] == 1 && picture.data[4 * p + 1] == 0);
        }
      NEAR (sum / (CELD_PI * 18 * 18 * scale * scale), 1, 0.02);
      /* The disc's middle, (24,20), or mirrored (26,20), is 1 left or right of the middle of the drawing. */
      NEAR (x / sum, to.x + scale * (25 + (to.flip ? 1 : -1) * cos (to.turn * CELD_RADIANS)), 0.02 + 0.02 * scale);
      NEAR (y / sum, to.y + scale * (20 + (to.flip ? 1 : -1) * sin (to.turn * CELD_RADIANS)), 0.02 + 0.02 * scale);
      free (picture.data);
      layer_scene_close (&s);
    }
}

static double line (double x, double y) { return x > 5 && x < 95 && y > 20 && y < 21; }

/* A line one pixel wide does not break at any size. */
static void
thin_lines_do_not_break (void)
{
  for (double scale = 0.08; scale < 1; scale *= 1.31)
    for (int turned = 0; turned < 2; turned++)
      {
        LayerScene  s = layer_scene (100, 40);
        CeldColours picture;

        layer_scene_paint (&s, 2, (float[]) { 0, 0, 0 }, line, NULL);
        for (int p = 0; p < 100 * 40; p++)
          s.art.data[4 * p + 3] = (float) line (p % 100 + 0.5, p / 100 + 0.5);
        picture = place (&s, (CeldPlacement) { 10.3, 10.7 + 30 * turned, scale, 90 * turned, false }, 130, 130);
        for (int along = 0; along < 130; along++)
          {
            double sum = 0, at;

            for (int across = 0; across < 130; across++)
              sum += (double) CELD_RGBA (&picture, turned ? across : along, turned ? along : across)[3];
            /* The middle of the line is that of the drawing. */
            at = (along + 0.5 - (turned ? 40.7 + 20 * scale : 10.3 + 50 * scale)) / scale;
            if (fabs (at) < 45 - 1 / scale)
              NEAR (sum, scale, 1e-4);
          }
        free (picture.data);
        layer_scene_close (&s);
      }
}

/* Where regions meet there is neither a gap nor the page: all of a white drawing stays white. */
static void
no_seams_between_regions (void)
{
  uint32_t state = 21;

  for (int round = 0; round < 30; round++)
    {
      LayerScene  s = random_scene (&state, 40, 40, false);
      double      scale = 0.4 + check_random (&state, 1000) / 400.0;
      CeldColours picture;

      for (int i = 0; i < 4 * 40 * 40; i++)
        s.art.data[i] = 1;
      picture = place (&s, (CeldPlacement) { 50 - 20 * scale, 50 - 20 * scale, scale, check_random (&state, 360),
                                            false }, 100,
                       100);
      for (int p = 0; p < 100 * 100; p++)
        if (hypot (p % 100 + 0.5 - 50, p / 100 + 0.5 - 50) < 19 * scale - 2)
          for (int c = 0; c < 4; c++)
            NEAR (picture.data[4 * p + c], 1, 1e-5);
      free (picture.data);
      layer_scene_close (&s);
    }
}

/* ------------------------------------------------------------------ several drawings */

/* A red disc without its white page: no white fringe on black. */
static void
the_page_of_a_later_drawing_leaves_no_fringe (void)
{
  for (int turn = 0; turn < 360; turn += 35)
    {
      LayerScene       black = layer_scene (60, 60), red = disc_scene (false);
      CeldLayers      *layers[2];
      CeldOrder        order[2];
      CeldFragment     fragment[2];
      CeldComposition *made = NULL;
      CeldColours      picture = picture_new (60, 60);

      for (int i = 0; i < 4 * 60 * 60; i++)
        black.art.data[i] = i % 4 == 3;
      layers[0]   = layer_scene_cut (&black, 4, CELD_STORE_FLOAT, false);
      layers[1]   = layer_scene_cut (&red, 4, CELD_STORE_FLOAT, false);
      fragment[0] = scene_at (&black, layers[0], &order[0], (CeldPlacement) { .scale = 1 });
      fragment[1] = scene_at (&red, layers[1], &order[1], (CeldPlacement) { 7.3, 5.9, 0.9, turn, false });
      CHECK (celd_compose (fragment, 2, NULL, 60, 60, NULL, NULL, &made) == CELD_OK);
      CHECK (celd_composition_flatten (made, NULL, &picture) == CELD_OK);
      for (int p = 0; p < 60 * 60; p++)
        {
          NEAR (picture.data[4 * p + 3], 1, 1e-5);
          CHECK (picture.data[4 * p + 1] < 0.02f && picture.data[4 * p + 2] < 0.02f);
        }
      CHECK (CELD_RGBA (&picture, 30, 24)[0] > 0.99f);
      celd_composition_free (made);
      free (picture.data);
      for (int i = 0; i < 2; i++)
        celd_layers_free (layers[i]);
      layer_scene_close (&black);
      layer_scene_close (&red);
    }
}

/* All layers over each other, premultiplied. */
static double *
composite (const CeldComposition *c, int width, int height)
{
  double *sum = calloc (4 * (size_t) (width * height), sizeof *sum);

  for (size_t k = 0; k < celd_composition_count (c); k++)
    {
      const CeldRect *box = &celd_composition_item (c, k)->box;
      float          *part = malloc ((4 * (size_t) box->width * (size_t) box->height + 1) * sizeof *part);

      CHECK (celd_composition_paint (c, k, NULL, part) == CELD_OK);
      for (int p = 0; p < box->width * box->height; p++)
        {
          double *to = sum + 4 * ((box->y + p / box->width) * width + box->x + p % box->width);
          double  alpha = (double) part[4 * p + 3];

          CHECK (alpha >= 0 && alpha <= 1);
          for (int i = 0; i < 4; i++)
            to[i] = (i < 3 ? alpha * (double) part[4 * p + i] : alpha) + (1 - alpha) * to[i];
        }
      free (part);
    }
  return sum;
}

static void
random_layers_make_the_picture (void)
{
  uint32_t state = 77;
  CeldHost backwards = { .each = check_backwards };

  for (int round = 0; round < 60; round++)
    {
      LayerScene       s[3];
      CeldLayers      *layers[3];
      CeldOrder        order[3];
      CeldFragment     fragment[3];
      CeldComposition *made = NULL;
      CeldColours      picture = picture_new (64, 48), again = picture_new (64, 48);
      double          *sum;

      for (int f = 0; f < 3; f++)
        {
          s[f] = random_scene (&state, 5 + (int) check_random (&state, 40), 5 + (int) check_random (&state, 40), f % 2);
          layers[f] = layer_scene_cut (&s[f], 4, CELD_STORE_FLOAT, true);
          fragment[f] = scene_at (&s[f], layers[f], &order[f], (CeldPlacement) {
            (double) check_random (&state, 500) / 10 - 10, (double) check_random (&state, 500) / 10 - 10,
            0.3 + check_random (&state, 100) / 50.0, check_random (&state, 360), round % 2 });
        }
      CHECK (celd_compose (fragment, 3, NULL, 64, 48, NULL, NULL, &made) == CELD_OK);
      CHECK (celd_composition_flatten (made, NULL, &picture) == CELD_OK);
      CHECK (celd_composition_flatten (made, &backwards, &again) == CELD_OK);
      CHECK (!memcmp (picture.data, again.data, 4 * 64 * 48 * sizeof (float)));
      sum = composite (made, 64, 48);
      for (int p = 0; p < 64 * 48; p++)
        for (int c = 0; c < 4; c++)
          NEAR (sum[4 * p + c], (double) picture.data[4 * p + c] * (c < 3 ? (double) picture.data[4 * p + 3] : 1),
                0.5 / 255);
      free (sum);
      free (picture.data);
      free (again.data);
      celd_composition_free (made);
      for (int f = 0; f < 3; f++)
        {
          celd_layers_free (layers[f]);
          layer_scene_close (&s[f]);
        }
    }
}

/* A pixel half covered by a red arm before a blue body, and half by a green rope between them: the rope gets half of
 * what the arm leaves, and leaves half of the body. */
static void
a_pixel_is_shared_by_the_order (void)
{
  LayerScene       s = layer_scene (1, 1), rope = layer_scene (1, 1);
  CeldLayers      *layers[2];
  CeldOrder        order[2];
  CeldFragment     fragment[2];
  CeldRelations    relations = { 0 };
  CeldComposition *made = NULL;
  CeldColours      picture = picture_new (1, 1);
  CeldPalette      palette = { (CeldRegion[3]) { { .colour = { 1, 1, 1, 255 } }, { .colour = { 0, 0, 255, 255 } },
                                                 { .colour = { 255, 0, 0, 255 } } }, 3 };

  *s.own.owner.data = 3;
  *s.own.under.data = 2;
  *s.own.coverage.data = 0.5f;
  *rope.own.owner.data = *rope.own.under.data = 2;
  memcpy (rope.art.data, (float[]) { 0, 1, 0, 0.5f }, 4 * sizeof (float));
  for (int f = 0; f < 2; f++)
    {
      layers[f]   = layer_scene_cut (f ? &rope : &s, 3, CELD_STORE_FLOAT, false);
      fragment[f] = scene_at (f ? &rope : &s, layers[f], &order[f], (CeldPlacement) { .scale = 1 });
    }
  memcpy (layers[0]->blend[0].colour[0], (float[]) { 1, 0, 0, 0.5f }, 4 * sizeof (float));
  memcpy (layers[0]->blend[0].colour[1], (float[]) { 0, 0, 1, 1 }, 4 * sizeof (float));
  fragment[0].palette = &palette;
  fragment[0].labels  = &s.own.owner;
  CHECK (celd_fragment_relations_parse ("man:#ff0000 > rope:*; rope:* > man:#0000ff",
                                        (const char *[]) { "man", "rope" }, 2, &relations, NULL) == CELD_OK);
  CHECK (celd_compose (fragment, 2, &relations, 1, 1, NULL, NULL, &made) == CELD_OK);
  CHECK (celd_composition_flatten (made, NULL, &picture) == CELD_OK);
  NEAR (picture.data[0], 0.5, 1e-6);
  NEAR (picture.data[1], 0.25, 1e-6);
  NEAR (picture.data[2], 0.25, 1e-6);
  NEAR (picture.data[3], 1, 1e-6);
  celd_composition_free (made);
  celd_relations_clear (&relations);
  free (picture.data);
  for (int f = 0; f < 2; f++)
    celd_layers_free (layers[f]);
  layer_scene_close (&s);
  layer_scene_close (&rope);
}

/* What a later drawing hides of an earlier one is in its layer. */
static void
layers_are_whole_behind_other_drawings (void)
{
  static const char *const board[] = { "AAAAAA", "ABBBBA", "ABBBBA", "AAAAAA", NULL };
  Drawn                    back = drawn_text (0, board, 2, ""), front = drawn_text (1, board, 2, "");
  CeldFragment             fragment[2] = { drawn_at (&back, 0, 0), drawn_at (&front, 2, 0) };
  CeldComposition         *made = NULL;
  float                    rgba[4 * 24];
  char                     text[40];

  CHECK (celd_compose (fragment, 2, NULL, 8, 4, NULL, NULL, &made) == CELD_OK);
  shown (made, 8, 4, text);
  CHECK (!strcmp (text, "aaaaaa  " "abbBBBB " "abbBBBB " "aaaaaa  "));
  CHECK (celd_composition_item (made, 1)->label == 2 && celd_composition_item (made, 1)->fragment == 0);
  CHECK (!memcmp (&celd_composition_item (made, 1)->box, &(CeldRect) { 1, 1, 4, 2 }, sizeof (CeldRect)));
  CHECK (celd_composition_paint (made, 1, NULL, rgba) == CELD_OK);
  for (int p = 0; p < 8; p++)
    CHECK (rgba[4 * p + 3] == 1);
  celd_composition_free (made);
  drawn_clear (&back);
  drawn_clear (&front);
}

static void
levels_are_those_of_what_is_seen (void)
{
  static const char *const board[] = { "AAAAAA", "ABBBBA", "ABBBBA", "AAAAAA", NULL };
  Drawn                    back = drawn_text (0, board, 2, ""), front = drawn_text (1, board, 2, "");
  CeldFragment             fragment[2] = { drawn_at (&back, 0, 0), drawn_at (&front, 2, 0) };
  CeldComposition         *made = NULL;
  CeldPlane                levels = { 8, 4, 8, (float[32]) { 0 } };
  const int                wanted[8] = { 0, 1, 1, 2, 2, 2, 2, 0 };

  CHECK (celd_compose (fragment, 2, NULL, 8, 4, NULL, NULL, &made) == CELD_OK);
  CHECK (celd_composition_levels (made, NULL, &levels) == CELD_OK);
  for (int x = 0; x < 8; x++)
    {
      CHECK (levels.data[x] == 0 && levels.data[24 + x] == 0);
      CHECK (levels.data[8 + x] == wanted[x] && levels.data[16 + x] == wanted[x]);
    }
  celd_composition_free (made);
  drawn_clear (&back);
  drawn_clear (&front);
}

/* Of two drawings with levels, each of the steps can be cancelled. */
static void
picture_and_levels_both_report_progress (void)
{
  enum { SIDE = 24, N = SIDE * SIDE };
  static float  art[4 * N], ink[N], depth[N], made[N], wanted[4 * N];
  CeldColours   colours = { SIDE, SIDE, SIDE, art }, picture = { SIDE, SIDE, SIDE, wanted };
  CeldPlane     paper = { SIDE, SIDE, SIDE, ink }, given = { SIDE, SIDE, SIDE, depth }, levels = { SIDE, SIDE, SIDE, made };
  CeldLevelArt  piece[2] = { { &colours, &paper, &given }, { &colours, &paper, &given } };
  CeldPlacement placement = { .scale = 1 };
  double        done = 0;
  CeldHost      host = { .progress = check_rising, .data = &done };

  for (int i = 0; i < N; i++)
    {
      ink[i]   = 1;
      depth[i] = i % SIDE < SIDE / 2;
    }
  CHECK (celd_compose_levels (piece, &placement, 0.5f, &host, &picture, &levels) == CELD_OK);
  NEAR (done, 1, 1e-9);
  done = 0;
  CHECK (celd_compose_levels (piece, &placement, 0.5f, &host, NULL, &levels) == CELD_OK);
  CHECK (done < 1); /* what is left is for the picture */
}

int
main (void)
{
  RUN (an_unmoved_drawing_is_itself);
  RUN (quarter_turns_and_mirrors_are_exact);
  RUN (scaling_keeps_the_share_of_area);
  RUN (thin_lines_do_not_break);
  RUN (no_seams_between_regions);
  RUN (the_page_of_a_later_drawing_leaves_no_fringe);
  RUN (a_pixel_is_shared_by_the_order);
  RUN (random_layers_make_the_picture);
  RUN (layers_are_whole_behind_other_drawings);
  RUN (levels_are_those_of_what_is_seen);
  RUN (picture_and_levels_both_report_progress);
  return DONE;
}
