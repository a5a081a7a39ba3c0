/* Reflection: the laws of light, and that what faces the viewer keeps its colour under each of them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "light-from.h"
#include "light/light.h"

typedef struct { double light, tone, gloss; } Lit;

/* One pixel with the normal (x,y,z). */
static Lit
light_one (const CeldSettings *settings, float x, float y, float z)
{
  CeldVectors normals = { 1, 1, 1, (float[3]) { x, y, z } };
  CeldLamp    lamp = celd_lamp (&normals, settings);

  return (Lit) { celd_light_at (&lamp, 0, 0), celd_tone_at (&lamp, 0, 0), celd_gloss_at (&lamp, 0, 0) };
}

static void
half_lambert_reaches_round (void)
{
  CeldSettings settings = light_from (0, 0);

  settings.light_model = CELD_MODEL_HALF_LAMBERT;
  NEAR (light_one (&settings, 1, 0, 0).light, 1, 1e-6);
  NEAR (light_one (&settings, 0, 0, 1).light, 0.25, 1e-6);
  NEAR (light_one (&settings, -1, 0, 0).light, 0, 1e-6);
}

/* ------------------------------------------------------------------ what faces the viewer */

/* Exactly, from wherever the light comes. */
static void
what_faces_the_viewer_keeps_its_colour (void)
{
  enum { W = 9, H = 7 };
  float        n[3 * W * H];
  CeldVectors  normals = { W, H, W, n };
  CeldSettings settings = celd_settings ();

  settings.specular = settings.rim_light = 1;
  for (int i = 0; i < W * H; i++) /* every third one, beside others */
    memcpy (n + 3 * i, i % 3 ? (float[3]) { 0.6f, 0, 0.8f } : (float[3]) { 0, 0, 1 }, 3 * sizeof *n);
  for (int model = CELD_MODEL_LAMBERT; model < CELD_MODEL_MATCAP; model++)
    for (int light = CELD_LIGHT_DIRECTION; light <= CELD_LIGHT_POINT; light++)
      for (int elevation = -90; elevation <= 90; elevation += 15)
        for (int steps = 2; steps <= 5; steps++)
          {
            settings.light_model     = (CeldLightModel) model;
            settings.light           = (CeldLight) light;
            settings.light_elevation = (float) elevation;
            settings.ambient         = elevation % 2 ? 0 : 0.25f;
            settings.toon_steps      = steps;
            settings.light_height    = 0.001f + (float) (elevation + 90) / 90;

            CeldLamp lamp = celd_lamp (&normals, &settings);

            for (int i = 0; i < W * H; i++)
              {
                double tone = celd_tone_at (&lamp, i % W, i / W), gloss = celd_gloss_at (&lamp, i % W, i / W);

                CHECK (tone >= 0 && tone <= CELD_MOST_TONE && gloss >= 0 && gloss <= 1);
                if (i % 3 == 0)
                  CHECK (tone == 1 && gloss == 0);
              }
          }
}

/* A tone is a quotient of lights, but at most two where what faces the viewer is dark. */
static void
tones_compare_with_what_faces_the_viewer (void)
{
  CeldSettings settings = light_from (0, 30);

  NEAR (light_one (&settings, 0.5f, 0, sqrtf (0.75f)).tone, sqrt (0.75) / 0.5, 1e-6);
  NEAR (light_one (&settings, -1, 0, 0).tone, 0, 1e-6);
  settings = light_from (0, 60);
  NEAR (light_one (&settings, 1, 0, 0).tone, 0.5 / sqrt (0.75), 1e-6);
  settings = light_from (0, 0);
  NEAR (light_one (&settings, 1, 0, 0).tone, 2, 1e-6);
  NEAR (light_one (&settings, 0.5f, 0, sqrtf (0.75f)).tone, 1.5, 1e-6);
  NEAR (light_one (&settings, -1, 0, 0).tone, 1, 1e-6); /* as dark as what faces the viewer */
}

/* ------------------------------------------------------------------ toon */

/* A cylinder: as many steps as there are, and at each edge a pixel between them, so that it lies where it would on a
 * finer picture. */
static void
toon_steps_have_soft_edges (void)
{
  enum { W = 400 };
  float        n[3 * W];
  CeldVectors  normals = { W, 1, W, n };
  CeldSettings settings = light_from (0, 90); /* steps from dark at both sides to light in the middle */

  settings.light_model = CELD_MODEL_TOON;
  for (int x = 0; x < W; x++)
    {
      n[3 * x]     = (2 * (float) x + 1) / W - 1;
      n[3 * x + 1] = 0;
      n[3 * x + 2] = sqrtf (1 - n[3 * x] * n[3 * x]);
    }
  for (int steps = 2; steps <= 5; steps++)
    {
      int      between = 0, seen = 0;
      double   sum = 0, wanted = 0;
      CeldLamp lamp = celd_lamp (&normals, &settings);

      settings.toon_steps = steps;
      for (int x = 0; x < W; x++)
        {
          double step = celd_light_at (&lamp, x, 0) * (steps - 1);

          between += fabs (step - round (step)) > 1e-4;
          seen |= 1 << (int) round (step);
          sum += step / (steps - 1);
        }
      for (int k = 1; k < steps; k++) /* each edge half way between two steps */
        {
          double edge = (k - 0.5) / (steps - 1);

          wanted += sqrt (1 - edge * edge) * W / (steps - 1);
        }
      CHECK (seen == (1 << steps) - 1);
      CHECK (between <= 4 * (steps - 1));
      NEAR (sum, wanted, 1);
    }
}

/* Slightly bent, a surface is in the step of what faces the viewer, under light from any height. */
static void
slight_bends_stay_in_their_step (void)
{
  CeldSettings settings = celd_settings ();

  settings.light_model = CELD_MODEL_TOON;
  for (int elevation = 10; elevation <= 80; elevation++)
    for (int steps = 2; steps <= 5; steps++)
      {
        settings.light_elevation = (float) elevation;
        settings.toon_steps      = steps;
        for (int k = 0; k < 8; k++)
          {
            float x = 0.05f * cosf (0.25f * CELD_PI * (float) k), y = 0.05f * sinf (0.25f * CELD_PI * (float) k);

            NEAR (light_one (&settings, x, y, sqrtf (1 - x * x - y * y)).tone, 1, 0);
          }
      }
}

/* ------------------------------------------------------------------ gloss */

/* As bright as the settings say half way between light and viewer, from where it fades to nothing. */
static void
highlights_are_where_mirrors_shine (void)
{
  CeldSettings settings = light_from (0, 30); /* half way to the viewer: 60 degrees */
  double       facing = pow (sqrt (0.75), 30);

  settings.specular = 0.5f;
  NEAR (light_one (&settings, 0.5f, 0, sqrtf (0.75f)).gloss, 0.5, 1e-5);
  NEAR (light_one (&settings, 0.6f, 0, 0.8f).gloss,
        0.5 * (pow (0.5 * 0.6 + sqrt (0.75) * 0.8, 30) - facing) / (1 - facing), 1e-5);
  settings.light_elevation = 60; /* the highlight includes what faces the viewer, and is bright all the same */
  NEAR (light_one (&settings, sinf (0.25f * CELD_PI / 3), 0, cosf (0.25f * CELD_PI / 3)).gloss, 0.5, 1e-5);
  settings = light_from (0, -60); /* from behind: nothing, however near the mirror */
  settings.specular = 1;
  NEAR (light_one (&settings, 0.1f, 0, sqrtf (0.99f)).gloss, 0, 0);
}

static void
rims_shine_where_parts_turn_away (void)
{
  CeldSettings settings = light_from (0, 90);

  settings.rim_light = 0.8f;
  settings.rim_power = 2;
  NEAR (light_one (&settings, 0.6f, 0, 0.8f).gloss, 0.8 * 0.04, 1e-6);
  NEAR (light_one (&settings, 0, -1, 0).gloss, 0.8, 1e-6);
  settings.specular = 1; /* at most white */
  settings.rim_light = 1;
  settings.light_elevation = 0;
  CHECK (light_one (&settings, 1, 0, 0).gloss <= 1);
}

int
main (void)
{
  RUN (half_lambert_reaches_round);
  RUN (what_faces_the_viewer_keeps_its_colour);
  RUN (tones_compare_with_what_faces_the_viewer);
  RUN (toon_steps_have_soft_edges);
  RUN (slight_bends_stay_in_their_step);
  RUN (highlights_are_where_mirrors_shine);
  RUN (rims_shine_where_parts_turn_away);
  return DONE;
}
