/* Holes of grain in ink: small grey ones are filled; paper that is bright somewhere, or long, stays.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"
#include "image/ink-steps.h"

#include <math.h>
#include <string.h>

enum { SIDE = 160 };

static float   ink_of[SIDE * SIDE], luma_of[SIDE * SIDE], fine_of[SIDE * SIDE];
static uint8_t known_of[SIDE * SIDE];

/* Ink values of the signs of a picture: # ink, o dark grey, + grey paper, . paper. */
static float
value_of (char sign)
{
  return sign == '#' ? 0 : sign == 'o' ? 0.4f : sign == '+' ? 0.6f : 1;
}

/* Whether filling makes of a picture the other one, where a filled pixel is ink. */
static bool
becomes (const char *rows, const char *expected)
{
  int       width = (int) strcspn (rows, "/"), height = ((int) strlen (rows) + 1) / (width + 1);
  int       wrong = 0;
  CeldPlane ink = { width, height, (size_t) width, ink_of };
  CeldMask  known = { width, height, (size_t) width, known_of };

  for (int i = 0; i < width * height; i++)
    ink_of[i] = value_of (rows[i % width + i / width * (width + 1)]);
  celd_ink_fill_grain (&ink, &known);
  for (int i = 0; i < width * height; i++)
    wrong += ink_of[i] != value_of (expected[i % width + i / width * (width + 1)]);
  return wrong == 0;
}

static void
small_grey_holes_are_filled (void)
{
  CHECK (becomes ("######/##+###/#o++##/###+##/######", "######/######/#o####/######/######"));
  CHECK (becomes ("+##/###/##+", "###/###/###"));
}

static void
paper_stays (void)
{
  CHECK (becomes ("######/##+###/#+.+##/###+##/######", "######/##+###/#+.+##/###+##/######"));
  CHECK (becomes ("######/#+####/##+###/###.##/######", "######/#+####/##+###/###.##/######"));
  CHECK (becomes ("######/##.###/#+####/######", "######/##.###/#+####/######"));
}

/* A gap out of focus, a pixel wide, across a picture of any width: as soon as it is longer than any hole, it stays. */
static void
long_gaps_stay (void)
{
  int filled_up_to = 0;

  for (int width = 3; width <= SIDE; width++)
    {
      CeldPlane ink = { width, 3, (size_t) width, ink_of };
      CeldMask  known = { width, 3, (size_t) width, known_of };
      int       left = 0;

      for (int i = 0; i < 3 * width; i++)
        ink_of[i] = i / width == 1 ? 0.6f : 0;
      celd_ink_fill_grain (&ink, &known);
      for (int i = 0; i < 3 * width; i++)
        left += ink_of[i] >= 0.5f;
      CHECK (left == 0 || left == width);
      CHECK (left == width || filled_up_to == 0 || filled_up_to == width - 1);
      filled_up_to = left ? filled_up_to : width;
    }
  CHECK (filled_up_to >= 16 && filled_up_to <= 48);
}

/* ------------------------------------------------------------------ chalk */

/* Grain about three pixels wide, deviation 1. */
static float
wide_grain (int x, int y)
{
  float sum = 0;

  for (int k = 0; k < 9; k++)
    sum += fine_of[(y + k / 3) % SIDE * SIDE + (x + k % 3) % SIDE];
  return sum / 3;
}

/* The distance from the window of 7 pixels in the stroke's middle, along the longer axis. */
static int
from_window (int x, int y)
{
  int across = abs (x - 80), down = abs (y - 80);

  return (across > down ? across : down) - 3;
}

/* Draws with chalk a stroke 24 pixels wide, with a window, on a dark board. */
static void
draw_chalk (uint32_t seed)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    fine_of[i] = check_noise (&seed);
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int   x = i % SIDE, y = i / SIDE;
      bool  stroke = y >= 68 && y < 92 && from_window (x, y) > 0;
      float chalk = fminf (fmaxf (0.75f + 0.22f * wide_grain (x, y), 0.15f), 1);

      luma_of[i] = 0.16f + 0.01f * check_noise (&seed) + (stroke ? 0.7f * chalk : 0);
    }
}

/* However much board shows through a broad stroke, it is ink throughout; a window as small as such a hole stays. */
static void
broad_chalk_has_no_holes (void)
{
  for (uint32_t seed = 1; seed <= 8; seed++)
    {
      CeldDrawing drawing = { .luma = { SIDE, SIDE, SIDE, luma_of } };
      CeldPlane   ink = { SIDE, SIDE, SIDE, ink_of };
      int         holes = 0, stains = 0;

      draw_chalk (seed);
      CHECK (celd_ink (&drawing, CELD_INK_AUTO, NULL, &ink) == CELD_OK);
      for (int i = 0; i < SIDE * SIDE; i++)
        {
          int x = i % SIDE, y = i / SIDE, away = from_window (x, y);

          holes  += y >= 74 && y < 86 && away > 8 && ink_of[i] >= 0.5f;
          stains += (y < 64 || y >= 96 || away < -1) && ink_of[i] < 0.5f;
        }
      CHECK (holes == 0);
      CHECK (stains == 0);
    }
}

int
main (void)
{
  RUN (small_grey_holes_are_filled);
  RUN (paper_stays);
  RUN (long_gaps_stay);
  RUN (broad_chalk_has_no_holes);
  return DONE;
}
