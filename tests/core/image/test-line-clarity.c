/* How clear lines are: drawings of all kinds have clear ones, shaded pictures without lines have not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

enum { WIDTH = 200, HEIGHT = 150 };

static float luma_of[WIDTH * HEIGHT], alpha_of[WIDTH * HEIGHT];

static CeldLineClarity
clarity (int width, int height, bool alpha)
{
  CeldDrawing     drawing = { .luma = { width, height, WIDTH, luma_of } };
  CeldLineClarity found = (CeldLineClarity) -1;

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

/* Mostly small, seldom large, as the grain of paper is. */
static float
paper_grain (int i)
{
  return grain (i) + grain (i + 99999) + grain (i + 999999);
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
      CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_CLEAR);
    }
}

static void
surfaces_are_not (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = cloud_at (i % WIDTH, i / WIDTH) + 0.05f * grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_NONE);
}

/* Other marks than outlines: hatching, dots of a screen, washes, shadows, solid blacks, lines that are broad. */
static float
mark_at (int kind, int x, int y)
{
  float r = hypotf ((float) x - 100, (float) y - 75);
  bool  inside = r < 50;

  switch (kind)
    {
    case 0: return inside && (x + 2 * y) % 9 < 2 ? 0 : 1;
    case 1: return inside && hypotf ((float) (x % 7) - 3, (float) (y % 7) - 3) < 2 ? 0 : 1;
    case 2: return inside ? 0.7f + 0.15f * cosf ((float) x / 15) * sinf ((float) y / 19) - 0.2f * expf (r / 4 - 12.5f) : 1;
    case 3: return inside && x > 90 ? 0.6f : 1;
    case 4: return inside && x > 90 ? 0 : 1;
    case 5: return x > y ? 0.4f : 0.8f;
    default: return fabsf (r - 45) < 12 ? 0 : 1;
    }
}

static void
drawings_have_other_marks (void)
{
  for (int kind = 0; kind < 7; kind++)
    for (int paper = 0; paper < 2; paper++)
      {
        for (int i = 0; i < WIDTH * HEIGHT; i++)
          luma_of[i] = (1 - paper * 0.3f * (float) (i % WIDTH) / WIDTH) * (1 - 0.9f * line_at (i % WIDTH, i / WIDTH)) *
                       mark_at (kind, i % WIDTH, i / WIDTH) + paper * 0.04f * grain (i);
        CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_CLEAR);
      }
}

/* Balls of different brightness, lit from the left, in front of a surface: edges, and no lines. */
static float
balls_at (int x, int y)
{
  float luma = cloud_at (x, y);

  for (int k = 0; k < 12; k++)
    {
      float across = ((float) x - (float) (k * 83 % WIDTH)) / (float) (10 + 2 * k);
      float down = ((float) y - (float) (k * 47 % HEIGHT)) / (float) (10 + 2 * k);

      if (hypotf (across, down) < 1)
        luma = (0.2f + 0.1f * (float) (k % 7)) * (0.7f - 0.3f * across) + 0.3f * (cloud_at (2 * x, 2 * y) - 0.5f);
    }
  return luma;
}

static void
photographs_have_edges (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = balls_at (i % WIDTH, i / WIDTH) + 0.05f * grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_NONE);
}

static void
shade_and_noise_are_no_lines (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = (float) (i % WIDTH) / WIDTH;
  CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_NONE);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = 0.5f + 0.5f * paper_grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_NONE);
}

/* A faint drawing in strong grain may be a surface. */
static void
grain_makes_lines_unsure (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = 0.8f - 0.15f * line_at (i % WIDTH, i / WIDTH) + 0.08f * paper_grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_UNSURE);
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
  CHECK (clarity (WIDTH, HEIGHT, true) == CELD_LINES_CLEAR);
}

/* Neither a blank page nor one of a few pixels says anything. */
static void
nothing_to_tell (void)
{
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = 0.9f + 0.05f * grain (i);
  CHECK (clarity (WIDTH, HEIGHT, false) == CELD_LINES_CLEAR);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    luma_of[i] = cloud_at (i % WIDTH, i / WIDTH);
  CHECK (clarity (63, HEIGHT, false) == CELD_LINES_CLEAR && clarity (WIDTH, 63, false) == CELD_LINES_CLEAR);
  CHECK (clarity (64, 64, false) != CELD_LINES_CLEAR);
}

static void
bad_input (void)
{
  CeldDrawing     drawing = { { WIDTH, HEIGHT, WIDTH, luma_of }, { WIDTH - 1, HEIGHT, WIDTH, alpha_of } };
  CeldLineClarity found = CELD_LINES_UNSURE;

  CHECK (celd_line_clarity (&drawing, NULL, &found) == CELD_BAD_SIZE && found == CELD_LINES_UNSURE);
}

int
main (void)
{
  RUN (drawings_are_clear);
  RUN (surfaces_are_not);
  RUN (drawings_have_other_marks);
  RUN (photographs_have_edges);
  RUN (shade_and_noise_are_no_lines);
  RUN (grain_makes_lines_unsure);
  RUN (transparent_is_white);
  RUN (nothing_to_tell);
  RUN (bad_input);
  return DONE;
}
