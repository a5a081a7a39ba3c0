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

/* Steep on a small page, in 8 bits, and dithered; a picture with a little grain on top of it is none. */
static void
smooth_depth_is_depth (void)
{
  CeldPlane depth = { SIDE, SIDE, SIDE, pixels };

  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = roundf (255 * (1 - hypotf ((float) (i % SIDE) - 80, (float) (i / SIDE) - 100) / 160)) / 255;
  CHECK (celd_are_levels (&depth));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = floorf (255 * (float) (i % SIDE) / SIDE + noise ()) / 255;
  CHECK (celd_are_levels (&depth));
  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] += 0.04f * noise ();
  CHECK (!celd_are_levels (&depth));
}

/* Lines of three pixels every 40 part the page into squares, which have levels in turn. */
static int
line_at (int x, int y)
{
  return x % 40 < 3 || y % 40 < 3;
}

static float
level_at (int x, int y)
{
  return (float) ((x / 40 + 2 * (y / 40)) % 4 + 1);
}

static bool
has_lines (float (*level) (int x, int y), float ink_of_line)
{
  static float drawn[SIDE * SIDE];
  CeldPlane    levels = { SIDE, SIDE, SIDE, pixels }, ink = { SIDE, SIDE, SIDE, drawn };
  bool         have = false;

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      pixels[i] = level (i % SIDE, i / SIDE);
      drawn[i] = line_at (i % SIDE, i / SIDE) ? ink_of_line : 1;
    }
  CHECK (celd_levels_have_lines (&levels, &ink, &have) == CELD_OK);
  return have;
}

static float
filled (int x, int y)
{
  return line_at (x, y) ? 0 : level_at (x, y);
}

static float
flat (int x, int y)
{
  (void) x;
  (void) y;
  return 2;
}

/* Every third line, as a gap that is seen between nearer parts. */
static float
with_gaps (int x, int y)
{
  return line_at (x, y) && (x / 40 + y / 40) % 3 == 0 ? 0 : level_at (x, y);
}

static void
drawings_have_lines (void)
{
  CeldPlane levels = { SIDE, SIDE, SIDE, pixels }, small = { SIDE / 2, SIDE, SIDE, pixels };
  bool      have = true;

  CHECK (has_lines (filled, 0.2f));
  CHECK (!has_lines (filled, 1)); /* the drawing has none */
  CHECK (!has_lines (level_at, 0.2f) && !has_lines (with_gaps, 0.2f) && !has_lines (flat, 0.2f));
  CHECK (celd_levels_have_lines (&levels, &small, &have) == CELD_BAD_SIZE && have);
}

static float
inked (int x, int y)
{
  return line_at (x, y) ? 0 : 1;
}

static float
chalked (int x, int y)
{
  return 1 - inked (x, y);
}

/* The same parts in flat colours. */
static float
with_fills (int x, int y)
{
  return with_gaps (x, y) > 0 ? level_at (x, y) : 2.5f;
}

static bool
are_exchanged (float (*level) (int x, int y), float (*drawing) (int x, int y))
{
  static float drawn[SIDE * SIDE];
  CeldPlane    levels = { SIDE, SIDE, SIDE, pixels }, plane = { SIDE, SIDE, SIDE, drawn };
  bool         exchanged = false;

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      pixels[i] = level (i % SIDE, i / SIDE);
      drawn[i] = drawing (i % SIDE, i / SIDE);
    }
  CHECK (celd_levels_are_exchanged (&levels, &plane, &exchanged) == CELD_OK);
  return exchanged;
}

/* A drawing has more lines and edges than its levels; what has none of either is not told. */
static bool
are_drawing (float (*value) (int x, int y))
{
  CeldPlane levels = { SIDE, SIDE, SIDE, pixels };
  bool      are = false;

  for (int i = 0; i < SIDE * SIDE; i++)
    pixels[i] = 3 * value (i % SIDE, i / SIDE) - 7;
  CHECK (celd_levels_are_drawing (&levels, &are) == CELD_OK);
  return are;
}

/* In ink or chalk; fills, and parts with gaps between, may be levels. */
static void
drawings_without_levels_are_noticed (void)
{
  CHECK (are_drawing (inked) && are_drawing (chalked));
  CHECK (!are_drawing (level_at) && !are_drawing (with_gaps) && !are_drawing (filled) && !are_drawing (flat));
}

static void
exchanged_levels_are_noticed (void)
{
  CHECK (are_exchanged (inked, level_at) && are_exchanged (chalked, level_at) && are_exchanged (inked, flat));
  CHECK (!are_exchanged (level_at, inked) && !are_exchanged (level_at, chalked) && !are_exchanged (with_gaps, inked));
  CHECK (!are_exchanged (flat, inked) && !are_exchanged (flat, flat));
  CHECK (!are_exchanged (inked, inked) && !are_exchanged (level_at, level_at));
  CHECK (!are_exchanged (with_gaps, with_fills));
}

/* More than half of the pixels of a picture with many labels differ from one beside them. */
static void
labels_are_flat (void)
{
  static uint32_t number[SIDE * SIDE];
  CeldLabels      labels = { SIDE, SIDE, SIDE, number };
  CeldPalette     palette = { NULL, 64 };

  for (int i = 0; i < SIDE * SIDE; i++)
    number[i] = (uint32_t) (64 * noise ()) % 64 + 1;
  CHECK (!celd_are_labels (&labels, &palette));
  palette.n = 63; /* may be a pattern */
  CHECK (celd_are_labels (&labels, &palette));
  for (int i = 0; i < SIDE * SIDE; i++)
    number[i] = (uint32_t) (i % SIDE / 25 + i / SIDE / 25 * 8) + 1;
  palette.n = 64;
  CHECK (celd_are_labels (&labels, &palette));
}

static void
labels_have_many_pixels (void)
{
  static uint32_t same[20200];
  CeldLabels  labels = { 200, 100, 200, same };
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
  RUN (drawings_have_lines);
  RUN (drawings_without_levels_are_noticed);
  RUN (exchanged_levels_are_noticed);
  RUN (labels_are_flat);
  RUN (labels_have_many_pixels);
  return DONE;
}
