/* Labels and levels, told from photographs.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#include <stdint.h>

#define SIDE 200

static float pixels[SIDE * SIDE];

/* Noise in [0,1], the same each time. */
static float
noise (void)
{
  static uint32_t state = 1;

  state = state * 1664525 + 1013904223;
  return (float) (state >> 8) / (1 << 24);
}

/* Also in any unit, and where smooth depth changes a little at each pixel. */
static void
flat_and_smooth_levels_are_levels (void)
{
  CeldPlane levels = { SIDE, SIDE, SIDE, pixels };

  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = (float) (i % SIDE / 20) * 1000 - 500;
  CHECK (celd_are_levels (&levels));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = hypotf ((float) (i % SIDE) - 100, (float) (i / SIDE) - 100) / 500 + (i % SIDE < 100 ? 1 : 0);
  CHECK (celd_are_levels (&levels));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = 7;
  CHECK (celd_are_levels (&levels));
}

/* All of it, or more than a third of it; rows may have a stride. */
static void
grainy_pictures_are_none (void)
{
  CeldPlane levels = { SIDE, SIDE, SIDE, pixels }, left = { SIDE / 2, SIDE, SIDE, pixels };

  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = noise ();
  CHECK (!celd_are_levels (&levels));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = i % SIDE < 80 ? noise () : 0.5f;
  CHECK (!celd_are_levels (&levels));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = i % SIDE < 50 ? noise () : 0.5f;
  CHECK (celd_are_levels (&levels));
  CHECK (!celd_are_levels (&left));
}

/* Steep on a small page, and in 8 bits; a picture with a little grain on top of it is none. */
static void
smooth_depth_is_depth (void)
{
  CeldPlane depth = { SIDE, SIDE, SIDE, pixels };

  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = roundf (255 * (1 - hypotf ((float) (i % SIDE) - 80, (float) (i / SIDE) - 100) / 160)) / 255;
  CHECK (celd_is_depth (&depth));
  CHECK (!celd_are_levels (&depth));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] += 0.04f * noise ();
  CHECK (!celd_is_depth (&depth));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = (float) (i % SIDE / 20);
  CHECK (celd_is_depth (&depth));
}

static void
labels_have_many_pixels (void)
{
  CeldLabels  labels = { 200, 100, 200, NULL };
  CeldPalette palette = { NULL, 999 };

  CHECK (celd_are_labels (&labels, &palette));
  palette.n = 1000; /* of 20 pixels each */
  CHECK (!celd_are_labels (&labels, &palette));
  labels.height = 101;
  CHECK (celd_are_labels (&labels, &palette));
  labels.height = 1;
  palette.n = 200;
  CHECK (celd_are_labels (&labels, &palette));
}

int
main (void)
{
  RUN (flat_and_smooth_levels_are_levels);
  RUN (grainy_pictures_are_none);
  RUN (smooth_depth_is_depth);
  RUN (labels_have_many_pixels);
  return DONE;
}
