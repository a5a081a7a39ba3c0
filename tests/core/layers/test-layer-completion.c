/* Colours of what is hidden: flat paper stays flat to the last bit, other paper goes on smoothly, and nothing comes
 * from other layers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layer-scene.h"
#include "base/base.h"
#include "layers/layers.h"

#define STORES 3

static const float red[3] = { 0.9f, 0.123f, 0.2f }, blue[3] = { 0.1f, 0.2f, 0.9f }, green[3] = { 0.05f, 0.7f, 0.3f };

static double
share_of (double depth)
{
  return fmin (fmax (depth + 0.5, 0), 1);
}

/* A disc of radius 30 with a line, a board over its right half, and a small disc in its left one. */
static double disc (double x, double y) { return share_of (30 - hypot (x - 40, y - 40)); }
static double disc_line (double x, double y) { return share_of (hypot (x - 40, y - 40) - 27); }
static double board (double x, double y) { return share_of (fmin (x - 45.3, fmin (y - 8.4, 71.7 - y))); }
static double board_line (double x, double y) { return 1 - share_of (fmin (x - 48, fmin (y - 11, 69 - y))); }
static double button (double x, double y) { return share_of (6 - hypot (x - 28, y - 40)); }

static LayerScene
painted (void)
{
  LayerScene s = layer_scene (100, 80);

  layer_scene_paint (&s, 2, red, disc, disc_line);
  layer_scene_paint (&s, 3, blue, board, board_line);
  layer_scene_paint (&s, 4, blue, button, NULL);
  return s;
}

/* Calls a check for each pixel of the hidden parts of a layer. */
typedef void (*CheckColour) (const LayerScene *s, int x, int y, const float colour[4], double coverage);

static size_t
check_part (const LayerScene *s, const CeldHiddenPart *part, CheckColour check)
{
  for (size_t r = 0; r < part->n_runs; r++)
    for (int k = 0; k < part->run[r].n; k++)
      {
        float  colour[4];
        double alpha = (double) celd_hidden_colour (part, part->run[r].first + (size_t) k, colour);

        check (s, part->run[r].x + k, part->run[r].y, colour, alpha);
      }
  return part->n_pixels;
}

/* The exact colour of the paper in the stored art. */
static float paper[2][4];

static bool
is_paper (const float colour[4], const float wanted[4])
{
  return colour[0] == wanted[0] && colour[1] == wanted[1] && colour[2] == wanted[2];
}

/* Away from the line, which is within 3 pixels of the outline, wherever that goes on. */
static void
check_flat (const LayerScene *s, int x, int y, const float colour[4], double coverage)
{
  (void) s;
  if (hypot (x + 0.5 - 40, y + 0.5 - 40) < 20)
    CHECK (is_paper (colour, paper[0]) && coverage == 1);
  /* No component lies outside of what paper and black ink span. */
  for (int c = 0; c < 3; c++)
    CHECK (colour[c] <= paper[0][c] + 1e-4f);
  CHECK (colour[2] <= 0.21f);
}

static void
check_white (const LayerScene *s, int x, int y, const float colour[4], double coverage)
{
  (void) s;
  (void) x;
  (void) y;
  CHECK (colour[0] == 1 && colour[1] == 1 && colour[2] == 1 && coverage == 1);
}

static void
flat_paper_stays_flat (void)
{
  for (CeldStore store = 0; store < STORES; store++)
    {
      LayerScene  s = painted ();
      CeldLayers *layers = layer_scene_cut (&s, 4, store, true);

      for (int c = 0; c < 4; c++)
        paper[0][c] = layers->art[4 * (40 * s.width + 18) + c];
      CHECK (check_part (&s, &layers->hidden[1], check_flat) > 500);
      check_part (&s, &layers->margin[1], check_flat);
      CHECK (check_part (&s, &layers->hidden[0], check_white) > 2000);
      CHECK (check_part (&s, &layers->hidden[2], check_flat) == 0);
      CHECK (check_part (&s, &layers->hidden[3], check_flat) == 0);
      celd_layers_free (layers);
      layer_scene_close (&s);
    }
}

/* In 1/65535, as hidden colours are stored. */
static bool
is_close (const float colour[4], const float wanted[4])
{
  for (int c = 0; c < 3; c++)
    if (!(fabsf (colour[c] - wanted[c]) < 1e-5f))
      return false;
  return true;
}

/* A disc whose lower half is green. */
static void
check_two (const LayerScene *s, int x, int y, const float colour[4], double coverage)
{
  (void) s;
  (void) coverage;
  if (hypot (x + 0.5 - 40, y + 0.5 - 40) >= 20)
    return;
  CHECK (is_close (colour, paper[0]) || is_close (colour, paper[1]));
  if (y < 34)
    CHECK (is_close (colour, paper[0]));
  if (y > 46)
    CHECK (is_close (colour, paper[1]));
}

static void
two_flat_colours_stay_two (void)
{
  for (CeldStore store = 0; store < STORES; store++)
    {
      LayerScene  s = layer_scene (100, 80);
      CeldLayers *layers;

      layer_scene_paint (&s, 2, red, disc, disc_line);
      for (int y = 40; y < 80; y++)
        for (int x = 0; x < 100; x++)
          if (hypot (x + 0.5 - 40, y + 0.5 - 40) < 26)
            memcpy (art_at (&s, x, y), green, sizeof green);
      layer_scene_paint (&s, 3, blue, board, board_line);
      layers = layer_scene_cut (&s, 3, store, true);
      for (int c = 0; c < 4; c++)
        {
          paper[0][c] = layers->art[4 * (30 * s.width + 25) + c];
          paper[1][c] = layers->art[4 * (50 * s.width + 25) + c];
        }
      CHECK (check_part (&s, &layers->hidden[1], check_two) > 500);
      celd_layers_free (layers);
      layer_scene_close (&s);
    }
}

/* A gradient down the disc and across it goes on, up to a tenth of its range where nothing is known beyond. */
static double
gradient (int x, int y, int c)
{
  return c == 0 ? y / 80.0 : c == 1 ? 0.3 + x / 400.0 : 0.15;
}

static void
check_gradient (const LayerScene *s, int x, int y, const float colour[4], double coverage)
{
  (void) s;
  (void) coverage;
  if (hypot (x + 0.5 - 40, y + 0.5 - 40) >= 22 || x > 52)
    return;
  for (int c = 0; c < 3; c++)
    NEAR (colour[c], gradient (x, y, c), 0.1);
}

static void
gradients_go_on (void)
{
  for (CeldStore store = 0; store < STORES; store++)
    {
      LayerScene  s = layer_scene (100, 80);
      CeldLayers *layers;

      layer_scene_paint (&s, 2, red, disc, disc_line);
      for (int y = 0; y < 80; y++)
        for (int x = 0; x < 100; x++)
          for (int c = 0; c < 3 && hypot (x + 0.5 - 40, y + 0.5 - 40) < 26; c++)
            art_at (&s, x, y)[c] = (float) gradient (x, y, c);
      layer_scene_paint (&s, 3, blue, board, board_line);
      layer_scene_paint (&s, 4, blue, button, NULL);
      layers = layer_scene_cut (&s, 4, store, true);
      CHECK (check_part (&s, &layers->hidden[1], check_gradient) > 500);
      celd_layers_free (layers);
      layer_scene_close (&s);
    }
}

/* Where what lies over it can be seen through, nothing is hidden. */
static void
nothing_goes_on_under_glass (void)
{
  LayerScene  s = painted ();
  CeldLayers *layers;

  for (int y = 0; y < 80; y++)
    for (int x = 0; x < 100; x++)
      if (CELD_AT (&s.own.owner, x, y) == 3)
        art_at (&s, x, y)[3] = 0.5f;
  layers = layer_scene_cut (&s, 4, CELD_STORE_FLOAT, true);
  for (size_t k = 0; k < 2; k++)
    for (size_t r = 0; r < layers->hidden[k].n_runs; r++)
      for (int x = layers->hidden[k].run[r].x; x < layers->hidden[k].run[r].x + layers->hidden[k].run[r].n; x++)
        CHECK (CELD_AT (&s.own.owner, x, layers->hidden[k].run[r].y) != 3);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

/* A region of ink alone goes on in its own colour. */
static double bar (double x, double y) { return share_of (fmin (fmin (x - 5, 95 - x), fmin (y - 36, 44 - y))); }
static double post (double x, double y) { return share_of (fmin (fmin (x - 43, 57 - x), fmin (y - 5, 75 - y))); }
static double all_ink (double x, double y) { (void) x; (void) y; return 1; }

static void
check_black (const LayerScene *s, int x, int y, const float colour[4], double coverage)
{
  (void) s;
  (void) x;
  (void) y;
  (void) coverage;
  CHECK (colour[0] < 0.01f && colour[1] < 0.01f && colour[2] < 0.01f);
}

static void
ink_goes_on_as_ink (void)
{
  LayerScene  s = layer_scene (100, 80);
  CeldLayers *layers;

  layer_scene_paint (&s, 2, red, bar, all_ink);
  layer_scene_paint (&s, 3, blue, post, NULL);
  layers = layer_scene_cut (&s, 3, CELD_STORE_8_BIT, true);
  CHECK (check_part (&s, &layers->hidden[1], check_black) > 90);
  celd_layers_free (layers);
  layer_scene_close (&s);
}

int
main (void)
{
  RUN (flat_paper_stays_flat);
  RUN (two_flat_colours_stay_two);
  RUN (gradients_go_on);
  RUN (nothing_goes_on_under_glass);
  RUN (ink_goes_on_as_ink);
  return DONE;
}
