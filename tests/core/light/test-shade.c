/* Shading: the laws of light, where it comes from, and the layers that it is delivered in.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
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

static CeldSettings
from (double azimuth, double elevation)
{
  CeldSettings settings = celd_settings ();

  settings.light_azimuth   = (float) azimuth;
  settings.light_elevation = (float) elevation;
  settings.ambient         = 0;
  return settings;
}

/* Tone and gloss of the normal (x,y,z). */
static void
light_one (const CeldSettings *settings, const CeldColours *matcap, float x, float y, float z, float tone[4],
           float *gloss)
{
  CeldVectors normals = { 1, 1, 1, (float[3]) { x, y, z } };
  CeldColours t = { 1, 1, 1, tone };
  CeldPlane   g = { 1, 1, 1, gloss };

  CHECK (celd_light (&normals, NULL, matcap, settings, NULL, &t, &g) == CELD_OK);
}

static void
half_lambert_reaches_round (void)
{
  CeldSettings settings = from (0, 0);
  float        tone[4], gloss;

  settings.light_model = CELD_MODEL_HALF_LAMBERT;
  light_one (&settings, NULL, 1, 0, 0, tone, &gloss);
  NEAR (tone[0], 1, 1e-6);
  light_one (&settings, NULL, 0, 0, 1, tone, &gloss);
  NEAR (tone[1], 0.25, 1e-6);
  light_one (&settings, NULL, -1, 0, 0, tone, &gloss);
  NEAR (tone[2], 0, 1e-6);
  NEAR (tone[3], 1, 0);
}

/* A cylinder from left to right under light from the right: as many bands as asked for, and at each edge a pixel
 * between them, so that it lies where it would on a finer picture. */
static void
toon_bands_have_soft_edges (void)
{
  enum { W = 200 };
  float       *n = malloc (3 * W * sizeof *n), *tone = malloc (4 * W * sizeof *tone), gloss[W];
  CeldVectors  normals = { W, 1, W, n };
  CeldColours  t = { W, 1, W, tone };
  CeldPlane    g = { W, 1, W, gloss };
  CeldSettings settings = from (0, 0);

  settings.light_model = CELD_MODEL_TOON;
  for (int x = 0; x < W; x++)
    {
      n[3 * x]     = (float) x / W;
      n[3 * x + 1] = 0;
      n[3 * x + 2] = sqrtf (1 - n[3 * x] * n[3 * x]);
    }
  for (int steps = 2; steps <= 5; steps++)
    {
      int    between = 0;
      double sum = 0, wanted = 0;

      settings.toon_steps = steps;
      CHECK (celd_light (&normals, NULL, NULL, &settings, NULL, &t, &g) == CELD_OK);
      for (int x = 0; x < W; x++)
        {
          double band = (double) tone[4 * x] * (steps - 1);

          between += fabs (band - round (band)) > 1e-4;
          sum += (double) tone[4 * x];
          CHECK (x == 0 || tone[4 * x] >= tone[4 * x - 4] - 1e-6f);
        }
      for (int k = 1; k < steps; k++) /* each edge at k / steps of the light */
        wanted += (1 - (double) k / steps) * W / (steps - 1);
      NEAR (tone[0], 0, 1e-6);
      NEAR (tone[4 * (W - 1)], 1, 1e-6);
      CHECK (between <= 2 * (steps - 1));
      NEAR (sum, wanted, 0.6);
    }
  free (n);
  free (tone);
}

static void
highlights_are_where_mirrors_shine (void)
{
  CeldSettings settings = from (0, 30); /* half way to the viewer: 60 degrees */
  float        tone[4], gloss, there;

  settings.specular = 0.5f;
  light_one (&settings, NULL, 0.5f, 0, sqrtf (0.75f), tone, &there);
  NEAR (there, 0.5, 1e-5);
  light_one (&settings, NULL, 0, 0, 1, tone, &gloss);
  NEAR (gloss, 0.5 * pow (sqrt (0.75), 30), 1e-5);
  settings.shininess = 100;
  light_one (&settings, NULL, 0, 0, 1, tone, &gloss);
  NEAR (gloss, 0.5 * pow (sqrt (0.75), 100), 1e-6);
  settings = from (0, -60); /* from behind: nothing, however near the mirror */
  settings.specular = 1;
  light_one (&settings, NULL, 0, 0, 1, tone, &gloss);
  NEAR (gloss, 0, 0);
}

static void
rims_shine_where_parts_turn_away (void)
{
  CeldSettings settings = from (0, 90);
  float        tone[4], gloss;

  settings.rim_light = 0.8f;
  settings.rim_power = 2;
  light_one (&settings, NULL, 0, 0, 1, tone, &gloss);
  NEAR (gloss, 0, 1e-6);
  light_one (&settings, NULL, 0.6f, 0, 0.8f, tone, &gloss);
  NEAR (gloss, 0.8 * 0.04, 1e-6);
  light_one (&settings, NULL, 0, -1, 0, tone, &gloss);
  NEAR (gloss, 0.8, 1e-6);
  settings.specular = 1; /* at most white */
  settings.rim_light = 1;
  settings.light_elevation = 0;
  light_one (&settings, NULL, 1, 0, 0, tone, &gloss);
  CHECK (gloss <= 1);
}

/* Ink takes light like all else, but does not shine. */
static void
ink_does_not_shine (void)
{
  float        n[12] = { 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1 }, art[4] = { 0, 0.25f, 1, NAN }, tone[16], gloss[4];
  CeldVectors  normals = { 4, 1, 4, n };
  CeldPlane    ink = { 4, 1, 4, art }, g = { 4, 1, 4, gloss };
  CeldColours  t = { 4, 1, 4, tone };
  CeldSettings settings = from (0, 90);

  settings.specular = 0.8f;
  CHECK (celd_light (&normals, &ink, NULL, &settings, NULL, &t, &g) == CELD_OK);
  NEAR (tone[0], 1, 1e-6);
  NEAR (gloss[0], 0, 0);
  NEAR (gloss[1], 0.2, 1e-6);
  NEAR (gloss[2], 0.8, 1e-6);
  NEAR (gloss[3], 0.8, 1e-6);
  ink.width = 3;
  CHECK (celd_light (&normals, &ink, NULL, &settings, NULL, &t, &g) == CELD_BAD_SIZE);
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

/* A ball that is red at the right, green at the top and blue in the middle. */
static void
a_matcap_is_read_by_the_normal (void)
{
  enum { SIDE = 64 };
  float       *ball = malloc (4 * SIDE * SIDE * sizeof *ball), tone[4], gloss;
  CeldColours  matcap = { SIDE, SIDE, SIDE, ball };
  CeldSettings settings = celd_settings ();

  settings.light_model = CELD_MODEL_MATCAP;
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        float *rgba = CELD_RGBA (&matcap, x, y);

        rgba[0] = ((float) x + 0.5f) / SIDE;
        rgba[1] = 1 - ((float) y + 0.5f) / SIDE;
        rgba[2] = 0.25f;
        rgba[3] = hypot (x - 31.5, y - 31.5) < 32;
      }
  for (int k = 0; k < 50; k++)
    {
      float x = 0.9f * cosf ((float) k), y = 0.9f * sinf ((float) k);

      light_one (&settings, &matcap, x, y, sqrtf (1 - x * x - y * y), tone, &gloss);
      NEAR (tone[0], 0.5 + 0.5 * (double) x, 1e-5);
      NEAR (tone[1], 0.5 + 0.5 * (double) y, 1e-5);
      NEAR (tone[2], 0.25, 1e-6);
    }
  light_one (&settings, &matcap, 1, 0, 0, tone, &gloss); /* not what is beside the ball */
  CHECK (tone[0] > 0.97f);
  NEAR (tone[2], 0.25, 1e-6);
  light_one (&settings, &matcap, NAN, INFINITY, 0, tone, &gloss);
  NEAR (tone[0], 0.5, 1e-5);
  free (ball);
}

/* Art times the tone, and the rim layer over that, are the shaded art; on white that is the shading. */
static void
layers_are_the_shaded_art (void)
{
  float        n[6] = { 0.6f, 0, 0.8f, 0, 0.8f, 0.6f }, art[8] = { 0.2f, 0.5f, 1, 1, 1, 1, 1, 0.5f };
  float        tone[8], gloss[2], layer[8], shade[2], lit[8];
  CeldVectors  normals = { 2, 1, 2, n };
  CeldColours  t = { 2, 1, 2, tone }, l = { 2, 1, 2, layer }, out = { 2, 1, 2, lit };
  CeldPlane    g = { 2, 1, 2, gloss }, s = { 2, 1, 2, shade };
  CeldSettings settings = celd_settings ();

  settings.specular  = 0.4f;
  settings.rim_light = 0.7f;
  memcpy (lit, art, sizeof lit);
  CHECK (celd_light (&normals, NULL, NULL, &settings, NULL, &t, &g) == CELD_OK);
  CHECK (celd_light_colours (&t, &g, &out) == CELD_OK);
  CHECK (celd_light_layer (&g, &l) == CELD_OK);
  CHECK (celd_shade (&normals, &settings, &s) == CELD_OK);
  for (int i = 0; i < 8; i++)
    {
      float alpha = layer[i / 4 * 4 + 3];

      if (i % 4 == 3)
        NEAR (lit[i], art[i], 0);
      else
        NEAR (lit[i], alpha * layer[i] + (1 - alpha) * art[i] * tone[i], 1e-6);
    }
  NEAR (shade[1], lit[4], 1e-6);
  CHECK (gloss[0] > 0 && gloss[1] > gloss[0]);
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
  CHECK (celd_light (&normals, NULL, NULL, &settings, NULL, &(CeldColours) { 2, 2, 2, (float[16]) { 0 } }, &shading) ==
         CELD_BAD_VALUE);
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
  RUN (half_lambert_reaches_round);
  RUN (toon_bands_have_soft_edges);
  RUN (highlights_are_where_mirrors_shine);
  RUN (rims_shine_where_parts_turn_away);
  RUN (ink_does_not_shine);
  RUN (a_point_of_light_is_near);
  RUN (a_matcap_is_read_by_the_normal);
  RUN (layers_are_the_shaded_art);
  RUN (bad_input_does_no_harm);
  return DONE;
}
