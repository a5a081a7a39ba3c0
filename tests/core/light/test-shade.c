/* Shading: where light comes from, what takes none, antialiased pixels, and the layers that light is delivered in.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "light-from.h"
#include "base/base.h"

/* Light on the normal (x,y,z). */
static double
light (double azimuth, double elevation, double ambient, float x, float y, float z)
{
  float        n[3] = { x, y, z }, out = -1;
  CeldVectors  normals = { 1, 1, 1, n };
  CeldPlane    shading = { 1, 1, 1, &out };
  CeldSettings settings = celd_settings ();

  settings.light_azimuth   = (float) azimuth;
  settings.light_elevation = (float) elevation;
  settings.ambient         = (float) ambient;
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_OK);
  return (double) out;
}

static void
light_follows_lambert (void)
{
  NEAR (light (0, 90, 0, 0, 0, 1), 1, 1e-6);      /* from the viewer */
  NEAR (light (0, 30, 0, 0, 0, 1), 0.5, 1e-6);
  NEAR (light (0, 0, 0, 1, 0, 0), 1, 1e-6);       /* from the right */
  NEAR (light (90, 0, 0, 0, 1, 0), 1, 1e-6);      /* from above: y is up */
  NEAR (light (0, 0, 0, -1, 0, 0), 0, 0);         /* turned away */
  NEAR (light (0, 45, 0, 0.6f, 0, 0.8f), 1.4 * sqrt (0.5), 1e-6);
}

static void
ambient_light_reaches_every_pixel (void)
{
  NEAR (light (0, 0, 0.25, -1, 0, 0), 0.25, 1e-6);
  NEAR (light (0, 30, 0.25, 0, 0, 1), 0.625, 1e-6);
  NEAR (light (0, 30, 1, -1, 0, 0), 1, 1e-6);
}

static void
a_disc_is_brighter_towards_the_light (void)
{
  enum { SIZE = 60 };
  float        ink[SIZE * SIZE], level[SIZE * SIZE], shade[SIZE * SIZE];
  float       *n = malloc (SIZE * SIZE * 3 * sizeof *n);
  CeldPlane    i = { SIZE, SIZE, SIZE, ink }, l = { SIZE, SIZE, SIZE, level }, s = { SIZE, SIZE, SIZE, shade };
  CeldVectors  normals = { SIZE, SIZE, SIZE, n };
  CeldSettings settings = celd_settings ();

  for (int k = 0; k < SIZE * SIZE; k++)
    {
      double r = hypot (k % SIZE - 29.5, k / SIZE - 29.5);

      level[k] = r < 25;
      ink[k]   = r < 23 || r > 25;
    }
  CHECK (celd_normals (&i, &l, &settings, NULL, &normals) == CELD_OK);
  settings.light_azimuth = 0;
  CHECK (celd_shade (&normals, &settings, &s) == CELD_OK);
  CHECK (shade[30 * SIZE + 45] > shade[30 * SIZE + 14] + 0.3f);
  settings.light_azimuth = 90;
  CHECK (celd_shade (&normals, &settings, &s) == CELD_OK);
  CHECK (shade[14 * SIZE + 30] > shade[45 * SIZE + 30] + 0.3f);
  NEAR (shade[14 * SIZE + 20], shade[14 * SIZE + 39], 0.02);
  free (n);
}

/* ------------------------------------------------------------------ other light */

/* Ink takes light like all else, but does not shine. */
static void
ink_does_not_shine (void)
{
  float        n[12], art[4] = { 0, 0.25f, 1, NAN }, tone[16], gloss[4];
  CeldVectors  normals = { 4, 1, 4, n };
  CeldPlane    ink = { 4, 1, 4, art }, g = { 4, 1, 4, gloss };
  CeldColours  t = { 4, 1, 4, tone };
  CeldSettings settings = light_from (0, 0);

  settings.specular = 0.8f;
  for (int i = 0; i < 4; i++) /* half way between the light and the viewer */
    memcpy (n + 3 * i, (float[3]) { sqrtf (0.5f), 0, sqrtf (0.5f) }, 3 * sizeof *n);
  CHECK (celd_light (&normals, &ink, NULL, NULL, &settings, NULL, &t, &g) == CELD_OK);
  CHECK (tone[0] > 1 && tone[0] < 2);
  NEAR (gloss[0], 0, 0);
  NEAR (gloss[1], 0.2, 1e-6);
  NEAR (gloss[2], 0.8, 1e-6);
  NEAR (gloss[3], 0.8, 1e-6);
  ink.width = 3;
  CHECK (celd_light (&normals, &ink, NULL, NULL, &settings, NULL, &t, &g) == CELD_BAD_SIZE);
}

/* A point of light over a wall: brightest below it, as far as it is high by cos 45 degrees. */
static void
a_point_of_light_is_near (void)
{
  enum { SIDE = 100 };
  float       *n = malloc (3 * SIDE * SIDE * sizeof *n), *shade = malloc (SIDE * SIDE * sizeof *shade);
  CeldVectors  normals = { SIDE, SIDE, SIDE, n };
  CeldPlane    s = { SIDE, SIDE, SIDE, shade };
  CeldSettings settings = celd_settings ();

  for (int i = 0; i < SIDE * SIDE; i++)
    memcpy (n + 3 * i, (float[3]) { 0, 0, 1 }, 3 * sizeof *n);
  settings.light        = CELD_LIGHT_POINT;
  settings.ambient      = 0;
  settings.light_x      = 0.305f;
  settings.light_y      = 0.705f;
  settings.light_height = (float) (20 / hypot (SIDE, SIDE));
  CHECK (celd_shade (&normals, &settings, &s) == CELD_OK);
  NEAR (shade[70 * SIDE + 30], 1, 1e-6);
  NEAR (shade[70 * SIDE + 50], sqrt (0.5), 1e-5);
  NEAR (shade[50 * SIDE + 30], sqrt (0.5), 1e-5);
  for (int i = 0; i < SIDE * SIDE; i++) /* facing up: light from above is above in the picture */
    memcpy (n + 3 * i, (float[3]) { 0, 1, 0 }, 3 * sizeof *n);
  CHECK (celd_shade (&normals, &settings, &s) == CELD_OK);
  CHECK (shade[90 * SIDE + 30] > 0.5f);
  NEAR (shade[50 * SIDE + 30], 0, 0);
  free (n);
  free (shade);
}

/* Dark tones multiply art; bright ones, too, but less so the brighter it is; and the rim layer lies over that. */
static void
layers_are_the_shaded_art (void)
{
  float        n[6] = { -0.6f, 0, 0.8f, 0, 0.8f, 0.6f }, art[8] = { 0.2f, 0.5f, 1, 1, 0.2f, 0.5f, 1, 0.5f };
  float        tone[8], gloss[2], layer[8], lit[8];
  CeldVectors  normals = { 2, 1, 2, n };
  CeldColours  t = { 2, 1, 2, tone }, l = { 2, 1, 2, layer }, out = { 2, 1, 2, lit };
  CeldPlane    g = { 2, 1, 2, gloss };
  CeldSettings settings = celd_settings ();

  settings.specular      = 0.4f;
  settings.rim_light     = 0.7f;
  settings.light_azimuth = 90;
  memcpy (lit, art, sizeof lit);
  CHECK (celd_light (&normals, NULL, NULL, NULL, &settings, NULL, &t, &g) == CELD_OK);
  CHECK (celd_light_colours (&t, &g, &out) == CELD_OK);
  CHECK (celd_light_layer (&g, &l) == CELD_OK);
  CHECK (tone[0] < 0.9f && tone[4] > 1.1f && gloss[0] > 0 && gloss[1] > gloss[0]);
  for (int i = 0; i < 8; i++)
    {
      double alpha = (double) layer[i / 4 * 4 + 3], c = (double) art[i];
      double toned = tone[i] < 1 ? c * (double) tone[i] : c + ((double) tone[i] - 1) * c * (1 - c);

      if (i % 4 == 3)
        NEAR (lit[i], art[i], 0);
      else
        NEAR (lit[i], alpha * (double) layer[i] + (1 - alpha) * toned, 1e-6);
    }
}

/* However bright the light: what was black stays black, what was lighter stays lighter, and white is the most. */
static void
lit_colours_stay_in_gamut (void)
{
  enum { W = 101 };
  float       tone[4 * W], gloss[W] = { 0 }, colour[4 * W];
  CeldColours t = { W, 1, W, tone }, c = { W, 1, W, colour };
  CeldPlane   g = { W, 1, W, gloss };

  for (float most = 0; most <= 2; most += 0.25f)
    {
      for (int i = 0; i < 4 * W; i++)
        {
          tone[i]   = most;
          colour[i] = (float) (i / 4) / (W - 1);
        }
      CHECK (celd_light_colours (&t, &g, &c) == CELD_OK);
      NEAR (colour[0], 0, 0);
      for (int x = 1; x < W; x++)
        CHECK (colour[4 * x] <= 1 && colour[4 * x] >= colour[4 * x - 4]);
      if (most >= 1)
        NEAR (colour[4 * W - 4], 1, 0);
    }
}

/* ------------------------------------------------------------------ with levels */

enum { SIDE = 60 };

typedef struct
{
  float        ink[SIDE * SIDE], level[SIDE * SIDE], n[3 * SIDE * SIDE], tone[4 * SIDE * SIDE], gloss[SIDE * SIDE];
  CeldSettings settings;
} Page;

static const CeldSettings *
lively (Page *p)
{
  p->settings = celd_settings ();
  p->settings.specular = p->settings.rim_light = 0.7f;
  return &p->settings;
}

/* Lights all of the page, bent to the lower right, and a figure that is bent to the upper left and nearer. */
static void
light_page (Page *p, const CeldSettings *settings)
{
  CeldVectors normals = { SIDE, SIDE, SIDE, p->n };
  CeldPlane   ink = { SIDE, SIDE, SIDE, p->ink }, levels = { SIDE, SIDE, SIDE, p->level };
  CeldPlane   gloss = { SIDE, SIDE, SIDE, p->gloss };
  CeldColours tone = { SIDE, SIDE, SIDE, p->tone };

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      float side = p->level[i] > 0 ? -0.6f : 0.6f;

      memcpy (p->n + 3 * i, (float[3]) { side, -side, sqrtf (1 - 0.72f) }, 3 * sizeof (float));
    }
  CHECK (celd_light (&normals, &ink, &levels, NULL, settings, NULL, &tone, &gloss) == CELD_OK);
}

/* A disc with an antialiased outline of 3 pixels inside its border. */
static void
draw_disc (Page *p, double cx)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      double r = hypot (i % SIDE - cx, i / SIDE - 29.3), line = fmin (fmin (r - 20, 23 - r) + 0.5, 1);

      p->ink[i]   = (float) (1 - fmax (0, line));
      p->level[i] = r < 23;
    }
}

static void
the_background_takes_no_light (void)
{
  Page         *p = malloc (sizeof *p);
  CeldSettings *s = &p->settings;
  int           lit = 0;

  draw_disc (p, 29.6);
  light_page (p, lively (p));
  for (int i = 0; i < SIDE * SIDE; i++)
    if (!(p->level[i] > 0))
      CHECK (p->tone[4 * i] == 1 && p->tone[4 * i + 1] == 1 && p->tone[4 * i + 2] == 1 && p->gloss[i] == 0);
    else
      lit += p->tone[4 * i] > 1.1f;
  CHECK (lit > 1000);
  s->light_background = true;
  light_page (p, s);
  CHECK (p->tone[0] < 0.8f && p->gloss[0] > 0.05f);
  s->light_background = false;
  for (int i = 0; i < SIDE * SIDE; i++) /* nothing in front: not a background */
    p->level[i] = 0.5f;
  light_page (p, s);
  CHECK (p->tone[0] > 1.1f);
  draw_disc (p, 29.6);
  for (int i = 0; i < SIDE * SIDE; i++) /* a hole within what fills the frame is not one, either */
    p->level[i] = 1 - p->level[i];
  light_page (p, s);
  CHECK (p->tone[4 * (30 * SIDE + 30)] < 0.8f);
  free (p);
}

/* The figure is light and its neighbour dark: pixels of both have the light of the paper that they show. */
static void
outlines_take_the_light_of_the_paper_they_show (void)
{
  Page                *p = malloc (sizeof *p);
  const CeldSettings  *s = lively (p);
  double               light[2];
  int                  mixed = 0;

  p->settings.light_background = true;
  draw_disc (p, 29.6);
  light_page (p, s);
  light[0] = (double) p->tone[0];
  light[1] = (double) p->tone[4 * (30 * SIDE + 30)];
  CHECK (light[1] > light[0] + 0.5);
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      double r = hypot (i % SIDE - 29.6, i / SIDE - 29.3);
      bool   inside = r < 21.5, aliased = p->ink[i] > 0 && p->ink[i] < 1;

      mixed += aliased;
      if (p->ink[i] > 0)
        NEAR (p->tone[4 * i], light[inside], 1e-6);
    }
  CHECK (mixed > 200);
  free (p);
}

static void
bad_input_does_no_harm (void)
{
  float        n[12] = { NAN, NAN, NAN, 0, 0, 1 }, out[6] = { 7, 7, 7, 7, 7, 7 };
  CeldVectors  normals = { 2, 2, 2, n };
  CeldPlane    small = { 1, 2, 2, out }, shading = { 2, 2, 3, out };
  CeldSettings settings = celd_settings ();

  CHECK (celd_shade (&normals, &settings, &small) == CELD_BAD_SIZE);
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_OK);
  NEAR (out[0], settings.ambient, 1e-6);
  NEAR (out[2], 7, 0); /* beyond the width */
  settings.ambient = NAN;
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_BAD_VALUE);
  settings = celd_settings ();
  settings.light_model = CELD_MODEL_MATCAP; /* without a ball */
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_BAD_VALUE);
  CHECK (celd_light (&normals, NULL, NULL, NULL, &settings, NULL, &(CeldColours) { 2, 2, 2, (float[16]) { 0 } },
                     &shading) == CELD_BAD_VALUE);
  settings.light_model = CELD_MODEL_TOON;
  settings.specular = settings.rim_light = 1;
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_OK);
  CHECK (isfinite (out[0]) && isfinite (out[1]));
  settings.toon_steps = 6;
  CHECK (celd_shade (&normals, &settings, &shading) == CELD_BAD_VALUE);
}

int
main (void)
{
  RUN (light_follows_lambert);
  RUN (ambient_light_reaches_every_pixel);
  RUN (a_disc_is_brighter_towards_the_light);
  RUN (ink_does_not_shine);
  RUN (a_point_of_light_is_near);
  RUN (layers_are_the_shaded_art);
  RUN (lit_colours_stay_in_gamut);
  RUN (the_background_takes_no_light);
  RUN (outlines_take_the_light_of_the_paper_they_show);
  RUN (bad_input_does_no_harm);
  return DONE;
}
