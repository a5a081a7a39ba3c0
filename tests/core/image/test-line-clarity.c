/* How clear lines are: drawings of all kinds have clear ones, shaded pictures without lines have not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

enum { WIDTH = 200, HEIGHT = 150 };

static float luma_of[WIDTH * HEIGHT], alpha_of[WIDTH * HEIGHT];

static double
clarity (int width, int height, bool alpha)
{
  CeldDrawing drawing = { .luma = { width, height, WIDTH, luma_of } };
  double      found = -1;

  if (alpha)
    drawing.alpha = (CeldPlane) { width, height, WIDTH, alpha_of };
  CHECK (celd_line_clarity (&drawing, NULL, &found) == CELD_OK);
  return found;
}

static float
grain (int i)
{
  uint32_t hash = (uint32_t) i * 2654435769u;

  hash = (hash ^ hash >> 15) * 2246822519u;
  return (float) (hash >> 24) / 255 - 0.5f;
}

/* 1 on a ring and a line across it. */
static float
line_at (int x, int y)
{
  float r = hypotf ((float) x - 100, (float) y - 75);

  return fabsf (r - 50) < 2 || abs (x - y) < 2 ? 1 : 0;
}

/* Sums of waves of all lengths with heights in proportion, as surfaces in photographs have them. */
static float
cloud_at (int x, int y)
{
  double sum = 0;

  for (int k = 1; k <= 24; k++)
    {
      double angle = 2.4 * k, length = 0.05 * k;

      sum += sin (length * (x * cos (angle) + y * sin (angle)) + k * k) / k;
    }
  return (float) (0.5 + 0.2 * sum);
}

static void
drawings_are_clear (void)
{
  static const struct { float paper, ink, slope, grain; } kind[] = {
    { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0.95f, 0.7f, 0, 0.02f }, { 0.95f, 0.2f, 0.4f, 0.04f }, { 0.15f, 0.9f, 0, 0.05f },
  };

  for (size_t k = 0; k < sizeof kind / sizeof *kind; k++)
    {
      for (int i = 0; i < WIDTH * HEIGHT; i++)
        luma_of[i] = kind[k].paper + line_at (i % WIDTH, i / WIDTH) * (kind[k].ink - kind[k].paper) -
                     kind[k].slope * (float) (i % WIDTH) / WIDTH + kind[k].grain * grain (i);
      CHECK (clarity (WIDTH, HEIGHT, false) >= CELD_CLEAR_LINES);
    }
}

static void
surfaces_are_not (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = cloud_at (i % WIDTH, i / WIDTH) + 0.05f * grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) < CELD_LEAST_CLARITY);
}

/* What is transparent is white, whatever its colour. */
static void
transparent_is_white (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
      alpha_of[i] = line_at (i % WIDTH, i / WIDTH);
      luma_of[i] = alpha_of[i] > 0 ? 0 : cloud_at (i % WIDTH, i / WIDTH);
    }
  CHECK (clarity (WIDTH, HEIGHT, true) >= CELD_CLEAR_LINES);
  CHECK (clarity (WIDTH, HEIGHT, false) < 1);
}

/* Neither a blank page nor one of a few pixels says anything. */
static void
nothing_to_tell (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = 0.9f + 0.05f * grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) == 1);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = cloud_at (i % WIDTH, i / WIDTH);
  CHECK (clarity (63, HEIGHT, false) == 1 && clarity (WIDTH, 63, false) == 1);
  CHECK (clarity (64, 64, false) < 1);
}

static void
bad_input (void)
{
  CeldDrawing drawing = { { WIDTH, HEIGHT, WIDTH, luma_of }, { WIDTH - 1, HEIGHT, WIDTH, alpha_of } };
  double      found = -1;

  CHECK (celd_line_clarity (&drawing, NULL, &found) == CELD_BAD_SIZE && found == -1);
}

int
main (void)
{
  RUN (drawings_are_clear);
  RUN (surfaces_are_not);
  RUN (transparent_is_white);
  RUN (nothing_to_tell);
  RUN (bad_input);
  return DONE;
}
