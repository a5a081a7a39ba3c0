/* The relief on the turntable: depth of heights, and views of points where they are when the relief has turned.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "base/base.h"

#include <math.h>

enum { W = 5, H = 2 };

static const float heights[W * H] = { -4, 0, 4, 8, 12, 12, 8, 4, 0, -4 };

static void
heights_become_depth (void)
{
  float      z[W * H], found[(W + 3) * H];
  CeldRelief relief = { .width = W, .height = H, .z = z };
  CeldPlane  depth = { W, H, W + 3, found };
  double     range = -1;

  for (int i = 0; i < (W + 3) * H; i++)
    found[i] = 9;
  memcpy (z, heights, sizeof z);
  CHECK (celd_turntable_depth (&relief, &depth, &range) == CELD_OK);
  NEAR (range, 16, 0);
  for (int y = 0; y < H; y++)
    for (int x = 0; x < W + 3; x++)
      NEAR (found[y * (W + 3) + x], x < W ? (heights[y * W + x] + 4) / 16 : 9, 1e-7);
}

static void
a_level_relief_has_no_depth (void)
{
  float      z[W * H], found[W * H];
  CeldRelief relief = { .width = W, .height = H, .z = z };
  CeldPlane  depth = { W, H, W, found };
  double     range = -1;

  for (int i = 0; i < W * H; i++)
    z[i] = 7;
  CHECK (celd_turntable_depth (&relief, &depth, &range) == CELD_OK);
  NEAR (range, 0, 0);
  for (int i = 0; i < W * H; i++)
    NEAR (found[i], 0, 0);
  depth.width--;
  range = -1;
  CHECK (celd_turntable_depth (&relief, &depth, &range) == CELD_BAD_SIZE);
  NEAR (range, -1, 0);
}

/* A point at height z in front of the axis is then at -z sin a of it, by rotation; in a view, depth d in front of the
 * screen moves by half the disparity against the camera. */
static void
points_turn_about_the_middle_height (void)
{
  CeldSettings settings = celd_settings ();
  const double range = 16, width = 200;

  celd_turntable_settings (range, (int) width, &settings);
  CHECK (celd_settings_check (&settings) == CELD_OK);
  for (int frame = 0; frame < 9; frame++)
    {
      CeldCamera camera = celd_turntable_sweep (frame, 9);
      double     angle = asin (camera.x * sin (CELD_TURNTABLE_ANGLE * CELD_PI / 180));

      NEAR (camera.squeeze, cos (angle), 1e-9);
      for (double z = -8; z <= 8; z += 4) /* from the middle of all heights */
        {
          double in_front = (z + range / 2) / range - (double) settings.convergence;
          double moved = -camera.x * (double) settings.disparity / 2 * in_front * width;

          NEAR (moved, -z * sin (angle), 1e-5);
        }
    }
}

/* Whatever the heights are, the settings are ones that a view takes. */
static void
high_reliefs_are_limited (void)
{
  CeldSettings settings = celd_settings ();

  celd_turntable_settings (1e12, 100, &settings);
  CHECK (celd_settings_check (&settings) == CELD_OK && settings.disparity == 0.2f);
  celd_turntable_settings (0, 100, &settings);
  CHECK (celd_settings_check (&settings) == CELD_OK && settings.disparity == 0);
}

static void
the_sweep_goes_from_side_to_side (void)
{
  for (int frames = 3; frames <= 65; frames += 2)
    {
      NEAR (celd_turntable_sweep (0, frames).x, -1, 1e-9);
      NEAR (celd_turntable_sweep (frames / 2, frames).x, 0, 1e-9);
      NEAR (celd_turntable_sweep (frames - 1, frames).x, 1, 1e-9);
      for (int k = 1; k < frames; k++)
        CHECK (celd_turntable_sweep (k, frames).x > celd_turntable_sweep (k - 1, frames).x);
    }
  NEAR (celd_turntable_sweep (0, 1).x, 0, 0);
}

int
main (void)
{
  RUN (heights_become_depth);
  RUN (a_level_relief_has_no_depth);
  RUN (points_turn_about_the_middle_height);
  RUN (high_reliefs_are_limited);
  RUN (the_sweep_goes_from_side_to_side);
  return DONE;
}
