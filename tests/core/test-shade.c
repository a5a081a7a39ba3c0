/* Shading: Lambert's law, and where the light comes from.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "private.h"

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
}

int
main (void)
{
  RUN (light_follows_lambert);
  RUN (ambient_light_reaches_every_pixel);
  RUN (a_disc_is_brighter_towards_the_light);
  RUN (bad_input_does_no_harm);
  return DONE;
}
