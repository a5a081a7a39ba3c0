/* Layers: their composite is the drawing, edges have each layer's own colours, and hidden parts are completed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "base/base.h"

static const float white[3] = { 1, 1, 1 }, red[3] = { 1, 0.2f, 0.2f }, blue[3] = { 0.1f, 0.2f, 0.9f };

static double
share_of (double depth)
{
  return fmin (fmax (depth + 0.5, 0), 1);
}

/* A disc, and its line, 4 pixels wide. */
static double disc (double x, double y) { return share_of (30 - hypot (x - 50, y - 50)); }
static double disc_line (double x, double y) { return share_of (hypot (x - 50, y - 50) - 26); }
/* A board before its upper right quarter. */
static double inside_board (double x, double y) { return fmin (fmin (x - 52.25, 99.5 - x), fmin (y - 5, 48.5 - y)); }
static double board (double x, double y) { return share_of (inside_board (x, y)); }
static double board_line (double x, double y) { return share_of (3 - inside_board (x, y)); }
/* A limb from left to right. */
static double limb (double x, double y) { return share_of (fmin (fmin (x - 10, 110 - x), fmin (y - 20, 34 - y))); }

/* ------------------------------------------------------------------ edges */

static void
whole_pixels_stay_as_they_are (void)
{
  LayerScene  s = layer_scene (4, 2);
  CeldLayers *layers;
  float      *canvas;

  CELD_AT (&s.own.owner, 2, 1) = CELD_AT (&s.own.under, 2, 1) = 2;
  memcpy (art_at (&s, 2, 1), (float[]) { 0.2f, 0.4f, 0.6f, 0.8f }, 4 * sizeof (float));
  layers = layer_scene_cut (&s, 2, CELD_STORE_8_BIT, false);
  CHECK (celd_layers_count (layers) == 2);
  CHECK (celd_layers_item (layers, 1)->label == 2 && celd_layers_item (layers, 1)->level == 1);
  CHECK (!memcmp (&celd_layers_item (layers, 1)->box, &(CeldRect) { 2, 1, 1, 1 }, sizeof (CeldRect)));
  canvas = layer_canvas (&s, layers, 0);
  CHECK (canvas[4 * 6 + 3] == 0 && canvas[4 * 5 + 3] == 1);
  free (canvas);
  canvas = layer_canvas (&s, layers, 1);
  NEAR (canvas[4 * 6], 51 / 255.0, 1e-6);
  NEAR (canvas[4 * 6 + 3], 204 / 255.0, 1e-6);
  free (canvas);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* Black ink of the front layer covers half a pixel of blue: each layer gets its own colour. */
static void
antialiased_edges_are_unmixed (void)
{
  for (CeldStore store = CELD_STORE_FLOAT; store <= CELD_STORE_8_BIT; store++)
    {
      LayerScene  s = layer_scene (7, 1);
      CeldLayers *layers;
      float      *front, *back;

      for (int x = 0; x < 7; x++)
        {
          double cover = x < 3 ? 0 : x == 3 ? 0.4 : 1, ink = x >= 3 && x < 6;

          CELD_AT (&s.own.owner, x, 0) = x < 3 ? 1 : 2;
          CELD_AT (&s.own.under, x, 0) = x <= 3 ? 1 : 2;
          CELD_AT (&s.own.coverage, x, 0) = x == 3 ? 0.4f : 1;
          CELD_AT (&s.ink, x, 0) = (float) (1 - cover * ink);
          for (int c = 0; c < 3; c++)
            art_at (&s, x, 0)[c] = (float) ((1 - cover) * (double) blue[c] + cover * (1 - ink) * (double) red[c]);
        }
      layers = layer_scene_cut (&s, 2, store, false);
      back   = layer_canvas (&s, layers, 0);
      front  = layer_canvas (&s, layers, 1);
      NEAR (front[4 * 3 + 3], 0.4, store ? 1.0 / 255 : 1e-6);
      NEAR (back[4 * 3 + 3], 1, 1e-6);
      for (int c = 0; c < 3; c++)
        {
          NEAR (front[4 * 3 + c], 0, store ? 0.02 : 1e-4);
          NEAR (back[4 * 3 + c], blue[c], store ? 0.02 : 1e-4);
        }
      CHECK (back[4 * 4 + 3] == 0 && front[4 * 2 + 3] == 0);
      free (front);
      free (back);
      celd_layers_free (layers);
      layer_scene_close (&s);
    }
}

/* Paint of the front layer that runs out under its line, where the art is darker than the line covers and of a colour
 * that the layer behind does not have: it stays in the front layer. */
static void
paint_beyond_a_line_stays_in_front (void)
{
  static const float orange[3] = { 1, 0.725f, 0.4f }, beyond[3] = { 0.09f, 0.016f, 0.314f };

  for (CeldStore store = CELD_STORE_FLOAT; store <= CELD_STORE_8_BIT_SRGB; store++)
    {
      LayerScene  s = layer_scene (7, 1);
      CeldLayers *layers;
      float      *front, *back;

      for (int x = 0; x < 7; x++)
        {
          CELD_AT (&s.own.owner, x, 0) = x < 3 ? 1 : 2;
          CELD_AT (&s.own.under, x, 0) = x <= 3 ? 1 : 2;
          CELD_AT (&s.own.coverage, x, 0) = x == 3 ? 0.85f : 1;
          CELD_AT (&s.ink, x, 0) = x < 3 || x == 6 ? 1 : x == 3 ? 0.15f : 0;
          for (int c = 0; c < 3; c++)
            art_at (&s, x, 0)[c] = x < 3 ? orange[c] : x == 3 ? beyond[c] : x == 6 ? blue[c] : 0;
        }
      layers = layer_scene_cut (&s, 2, store, false);
      back   = layer_canvas (&s, layers, 0);
      front  = layer_canvas (&s, layers, 1);
      NEAR (back[4 * 3 + 3], 1, 1e-6);
      CHECK (front[4 * 3 + 3] > 0.9f);
      for (int c = 0; c < 3; c++)
        {
          NEAR (back[4 * 3 + c], orange[c], 0.05);
          NEAR (front[4 * 3 + 3] * front[4 * 3 + c] + (1 - front[4 * 3 + 3]) * back[4 * 3 + c], beyond[c],
                store ? 0.008 : 1e-5);
        }
      free (front);
      free (back);
      celd_layers_free (layers);
      layer_scene_close (&s);
    }
}

/* Ink on a transparent layer: the front layer keeps it, and nothing stays behind. */
static void
transparent_paper_stays_transparent (void)
{
  LayerScene  s = layer_scene (5, 1);
  CeldLayers *layers;
  float      *front, *back;
  const float alpha[5] = { 0, 0.4f, 1, 1, 0 };

  for (int x = 0; x < 5; x++)
    {
      CELD_AT (&s.own.owner, x, 0) = x < 1 ? 1 : 2;
      CELD_AT (&s.own.under, x, 0) = x < 2 ? 1 : 2;
      CELD_AT (&s.own.coverage, x, 0) = x == 1 ? 0.4f : 1;
      CELD_AT (&s.ink, x, 0) = 1 - alpha[x];
      memcpy (art_at (&s, x, 0), (float[]) { 0.2f, 0, 0, alpha[x] }, 4 * sizeof (float));
    }
  layers = layer_scene_cut (&s, 2, CELD_STORE_8_BIT, false);
  back   = layer_canvas (&s, layers, 0);
  front  = layer_canvas (&s, layers, 1);
  CHECK (celd_layers_item (layers, 0)->box.width == 0);
  for (int x = 0; x < 5; x++)
    {
      NEAR (front[4 * x + 3], alpha[x], 1e-6);
      CHECK (back[4 * x + 3] == 0);
    }
  NEAR (front[4], 0.2, 1e-6);
  free (front);
  free (back);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* A line thinner than a pixel stays dark, and the paper behind it stays white. */
static void
thin_ink_stays_ink (void)
{
  LayerScene  s = layer_scene (9, 9);
  CeldLayers *layers;
  float      *front, *back;

  for (int y = 0; y < 9; y++)
    for (int x = 4; x < 9; x++)
      {
        CELD_AT (&s.own.owner, x, y) = 2;
        CELD_AT (&s.own.under, x, y) = x == 4 ? 1 : 2;
        CELD_AT (&s.own.coverage, x, y) = x == 4 ? 0.5f : 1;
        CELD_AT (&s.ink, x, y) = x == 4 ? 0.5f : 1;
        for (int c = 0; c < 3; c++)
          art_at (&s, x, y)[c] = x == 4 ? 0.5f : 1;
      }
  layers = layer_scene_cut (&s, 2, CELD_STORE_FLOAT, false);
  back   = layer_canvas (&s, layers, 0);
  front  = layer_canvas (&s, layers, 1);
  CHECK (front[4 * (4 * 9 + 4)] < 0.05f);
  CHECK (back[4 * (4 * 9 + 4)] > 0.95f);
  free (front);
  free (back);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ any picture at all */

static LayerScene
random_scene (uint32_t *state, size_t *n)
{
  int        w = 1 + (int) check_random (state, 20), h = 1 + (int) check_random (state, 20);
  bool       opaque = check_random (state, 2), smooth = check_random (state, 2);
  LayerScene s = layer_scene (w, h);

  *n = 1 + check_random (state, MOST_LABELS);
  for (size_t k = 0; k < *n; k++)
    s.level[k] = check_random (state, 4);
  for (int p = 0; p < w * h; p++)
    {
      /* Runs of a label, so that there is something round a pixel. */
      bool again = smooth && p && check_random (state, 4);

      s.own.owner.data[p] = again ? s.own.owner.data[p - 1] : 1 + check_random (state, (uint32_t) *n);
      s.own.under.data[p] = check_random (state, 2) ? s.own.owner.data[p] : 1 + check_random (state, (uint32_t) *n);
      s.own.coverage.data[p] = 1;
      if (s.own.under.data[p] != s.own.owner.data[p])
        s.own.coverage.data[p] = (float) check_random (state, 1001) / 1000;
      s.ink.data[p] = (float) check_random (state, 5) / 4;
      for (int c = 0; c < 4; c++)
        s.art.data[4 * p + c] = c == 3 && opaque ? 1 : (float) check_random (state, 256) / 255;
    }
  return s;
}

static double
encode (double linear)
{
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow (linear, 1 / 2.4) - 0.055;
}

static bool
is_whole (double value)
{
  return fabs (value * 255 - round (value * 255)) < 1e-3;
}

static void
check_range (const LayerScene *s, const CeldLayers *layers, CeldStore store)
{
  for (size_t k = 0; k < celd_layers_count (layers); k++)
    {
      float *canvas = layer_canvas (s, layers, k);

      for (int i = 0; i < 4 * s->width * s->height; i++)
        {
          CHECK (canvas[i] >= 0 && canvas[i] <= 1);
          if (store)
            CHECK (is_whole (store == CELD_STORE_8_BIT || i % 4 == 3 ? (double) canvas[i]
                                                                      : encode ((double) canvas[i])));
        }
      free (canvas);
    }
}

/* The largest difference to the art as it is encoded, of an opaque picture. */
static double
encoded_error (const LayerScene *s, const double *composite)
{
  double worst = 0;

  for (int i = 0; i < 4 * s->width * s->height; i++)
    worst = fmax (worst, fabs (encode (composite[i]) - encode ((double) s->art.data[i])));
  return worst;
}

static void
random_layers_make_the_drawing_again (void)
{
  uint32_t state = 3;
  double   worst[3] = { 0, 0, 0 };

  for (int round = 0; round < 3000; round++)
    {
      CeldStore   store = (CeldStore) (round % 3);
      size_t      n;
      LayerScene  s = random_scene (&state, &n);
      CeldLayers *plain, *complete;
      double     *one, *other;

      for (int i = 3; store == CELD_STORE_8_BIT_SRGB && i < 4 * s.width * s.height; i += 4)
        s.art.data[i] = 1;
      plain    = layer_scene_cut (&s, n, store, false);
      complete = layer_scene_cut (&s, n, store, true);
      one      = layer_composite (&s, plain);
      other    = layer_composite (&s, complete);
      if (store == CELD_STORE_8_BIT_SRGB)
        worst[store] = fmax (worst[store], encoded_error (&s, one));
      else
        worst[store] = fmax (worst[store], layer_error (&s, one));
      for (int i = 0; i < 4 * s.width * s.height; i++)
        CHECK (one[i] == other[i]);
      check_range (&s, complete, store);
      free (one);
      free (other);
      celd_layers_free (plain);
      celd_layers_free (complete);
      layer_scene_close (&s);
    }
  CHECK (worst[CELD_STORE_FLOAT] < 1e-5);
  CHECK (worst[CELD_STORE_8_BIT] < 1.0 / 255);
  CHECK (worst[CELD_STORE_8_BIT_SRGB] < 1.0 / 255);
}

static void
threads_make_no_difference (void)
{
  uint32_t state = 11;
  CeldHost backwards = { .each = check_backwards };

  for (int round = 0; round < 50; round++)
    {
      size_t      n;
      LayerScene  s = random_scene (&state, &n);
      CeldSheets *sheets = layer_scene_sheets (&s, n, &backwards);
      CeldLayers *one = layer_scene_cut (&s, n, CELD_STORE_8_BIT, true), *other = NULL;

      CHECK (celd_layers_cut (&s.ink, &s.own, s.level, n, &s.art, sheets, CELD_STORE_8_BIT, &backwards, &other) ==
             CELD_OK);
      celd_sheets_free (sheets);
      for (size_t k = 0; k < celd_layers_count (one); k++)
        {
          float *a = layer_canvas (&s, one, k), *b = layer_canvas (&s, other, k);

          CHECK (!memcmp (a, b, 4 * (size_t) (s.width * s.height) * sizeof *a));
          free (a);
          free (b);
        }
      celd_layers_free (one);
      celd_layers_free (other);
      layer_scene_close (&s);
    }
}

/* ------------------------------------------------------------------ hidden parts */

/* Compares the layer's alpha with the shape. */
static double
overlap (const LayerScene *s, const float *canvas, LayerShare shape)
{
  double both = 0, either = 0;

  for (int y = 0; y < s->height; y++)
    for (int x = 0; x < s->width; x++)
      {
        double a = (double) canvas[4 * (y * s->width + x) + 3], b = shape (x + 0.5, y + 0.5);

        both   += fmin (a, b);
        either += fmax (a, b);
      }
  return both / either;
}

static void
a_disc_is_round_behind_a_board (void)
{
  LayerScene  s = layer_scene (110, 90);
  CeldLayers *layers;
  float      *canvas;
  double      line = 0, line_wanted = 0, line_wrong = 0;

  layer_scene_paint (&s, 2, red, disc, disc_line);
  layer_scene_paint (&s, 3, blue, board, board_line);
  layers = layer_scene_cut (&s, 3, CELD_STORE_8_BIT, false);
  canvas = layer_canvas (&s, layers, 1);
  CHECK (overlap (&s, canvas, disc) < 0.85);
  free (canvas);
  celd_layers_free (layers);
  layers = layer_scene_cut (&s, 3, CELD_STORE_8_BIT, true);
  canvas = layer_canvas (&s, layers, 1);
  CHECK (overlap (&s, canvas, disc) > 0.975);
  for (int y = 9; y < 44; y++)
    for (int x = 57; x < 95; x++)
      {
        const float *pixel = canvas + 4 * (y * s.width + x);
        double       radius = hypot (x + 0.5 - 50, y + 0.5 - 50);
        bool         outermost = pixel[3] == 1 && (pixel[4 + 3] < 0.5f || pixel[3 - 4 * s.width] < 0.5f);

        line += outermost && pixel[0] < 0.2f;
        line_wanted += outermost;
        line_wrong += radius < 24 && (fabsf (pixel[0] - red[0]) > 0.01f || fabsf (pixel[2] - red[2]) > 0.01f);
      }
  CHECK (line_wanted > 15 && line > 0.95 * line_wanted);
  CHECK (line_wrong == 0);
  free (canvas);
  canvas = layer_canvas (&s, layers, 0);
  for (int p = 0; p < s.width * s.height; p++)
    CHECK (canvas[4 * p + 3] == 1 && canvas[4 * p] == 1); /* paper behind everything */
  free (canvas);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* Both pieces of a limb are joined behind what crosses it, and nothing sticks out at its sides. */
static double post (double x, double y) { return share_of (fmin (fmin (x - 45, 70 - x), fmin (y - 4, 60 - y))); }

static void
a_limb_runs_on_behind_a_post (void)
{
  LayerScene  s = layer_scene (120, 64);
  CeldLayers *layers;
  float      *canvas;

  layer_scene_paint (&s, 2, red, limb, NULL);
  layer_scene_paint (&s, 3, blue, post, NULL);
  layers = layer_scene_cut (&s, 3, CELD_STORE_8_BIT, true);
  canvas = layer_canvas (&s, layers, 1);
  CHECK (overlap (&s, canvas, limb) > 0.99);
  for (int x = 12; x < 108; x++)
    NEAR (canvas[4 * (27 * s.width + x) + 1], red[1], 0.01);
  free (canvas);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* A ramp of colour with a hole: Laplace's equation gives the ramp. */
static double window (double x, double y) { return share_of (14 - hypot (x - 30, y - 30)); }

static void
colours_run_on_across_a_hole (void)
{
  LayerScene  s = layer_scene (60, 60);
  CeldLayers *layers;
  float      *canvas;

  for (int y = 0; y < 60; y++)
    for (int x = 0; x < 60; x++)
      {
        CELD_AT (&s.own.owner, x, y) = CELD_AT (&s.own.under, x, y) = 2;
        art_at (&s, x, y)[0] = (float) x / 60;
        art_at (&s, x, y)[1] = (float) y / 60;
      }
  layer_scene_paint (&s, 3, blue, window, NULL);
  layers = layer_scene_cut (&s, 3, CELD_STORE_FLOAT, true);
  canvas = layer_canvas (&s, layers, 0);
  for (int y = 0; y < 60; y++)
    for (int x = 0; x < 60; x++)
      {
        NEAR (canvas[4 * (y * 60 + x) + 3], 1, 1e-5);
        /* A pixel at the boundary has the mean of its neighbours outside. */
        NEAR (canvas[4 * (y * 60 + x)], x / 60.0, 1.5 / 60);
        NEAR (canvas[4 * (y * 60 + x) + 1], y / 60.0, 1.5 / 60);
      }
  free (canvas);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* At equal levels it is unknown which one continues: nothing is completed. */
static void
equal_levels_hide_nothing (void)
{
  LayerScene  s = layer_scene (110, 90);
  CeldLayers *plain, *complete;

  layer_scene_paint (&s, 2, white, disc, disc_line);
  layer_scene_paint (&s, 3, white, board, board_line);
  s.level[1] = s.level[2] = 1;
  plain    = layer_scene_cut (&s, 3, CELD_STORE_8_BIT, false);
  complete = layer_scene_cut (&s, 3, CELD_STORE_8_BIT, true);
  for (size_t k = 1; k < 3; k++)
    {
      float *a = layer_canvas (&s, plain, k), *b = layer_canvas (&s, complete, k);

      CHECK (!memcmp (a, b, 4 * (size_t) (s.width * s.height) * sizeof *a));
      free (a);
      free (b);
    }
  celd_layers_free (plain);
  celd_layers_free (complete);
  layer_scene_close (&s);
}

/* ------------------------------------------------------------------ what is refused */

static void
bad_input_is_refused (void)
{
  LayerScene  s = layer_scene (6, 5);
  CeldLayers *layers = NULL;
  CeldColours small = { 5, 5, 6, s.art.data };
  CeldHost    refuse = { .progress = check_refuse };
  CeldSheets *sheets = layer_scene_sheets (&s, 1, NULL);

  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 1, &small, NULL, CELD_STORE_FLOAT, NULL, &layers) ==
         CELD_BAD_SIZE);
  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 0, &s.art, NULL, CELD_STORE_FLOAT, NULL, &layers) ==
         CELD_NOTHING_TO_GO_BY);
  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 2, &s.art, sheets, CELD_STORE_FLOAT, NULL, &layers) ==
         CELD_BAD_VALUE);
  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 1, &s.art, NULL, (CeldStore) 3, NULL, &layers) ==
         CELD_BAD_VALUE);
  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 1, &s.art, sheets, CELD_STORE_FLOAT, &refuse, &layers) ==
         CELD_CANCELLED);
  s.own.under.data[3] = 2;
  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 1, &s.art, NULL, CELD_STORE_FLOAT, NULL, &layers) ==
         CELD_BAD_VALUE);
  s.own.under.data[3] = 0;
  CHECK (celd_layers_cut (&s.ink, &s.own, s.level, 1, &s.art, NULL, CELD_STORE_FLOAT, NULL, &layers) ==
         CELD_BAD_VALUE);
  CHECK (!layers);
  celd_sheets_free (sheets);
  layer_scene_close (&s);
}

int
main (void)
{
  RUN (whole_pixels_stay_as_they_are);
  RUN (antialiased_edges_are_unmixed);
  RUN (paint_beyond_a_line_stays_in_front);
  RUN (transparent_paper_stays_transparent);
  RUN (thin_ink_stays_ink);
  RUN (random_layers_make_the_drawing_again);
  RUN (threads_make_no_difference);
  RUN (a_disc_is_round_behind_a_board);
  RUN (a_limb_runs_on_behind_a_post);
  RUN (colours_run_on_across_a_hole);
  RUN (equal_levels_hide_nothing);
  RUN (bad_input_is_refused);
  return DONE;
}
