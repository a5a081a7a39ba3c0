/* Lines of sprites, pixel art in a few exact colours: they are found whatever the width of the fills between them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

enum { SIDE = 40 };

typedef uint8_t Rgb[3];

static const Rgb black = { 0, 0, 0 }, sky = { 150, 200, 240 };

static uint8_t art_of[SIDE][SIDE][4];
static float   luma_of[SIDE][SIDE];

static void
box (int left, int top, int width, int height, const Rgb colour)
{
  for (int y = top; y < top + height; y++)
    for (int x = left; x < left + width; x++)
      memcpy (art_of[y][x], (uint8_t[4]) { colour[0], colour[1], colour[2], 255 }, 4);
}

static void
outlined_box (int left, int top, int width, int height, const Rgb colour)
{
  box (left - 1, top - 1, width + 2, height + 2, black);
  box (left, top, width, height, colour);
}

static void
find (CeldInkMode mode)
{
  CeldPaint   art = { SIDE, SIDE, SIDE, &art_of[0][0][0] };
  CeldDrawing drawing = { .luma = { SIDE, SIDE, SIDE, &luma_of[0][0] } };

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i / SIDE][i % SIDE] = 0.5f;
  CHECK (celd_coloured_lines (&art, mode, NULL, &drawing) == CELD_OK);
}

/* How many pixels are not ink where they are black, or ink where they are not. */
static int
count_wrong (void)
{
  int wrong = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      wrong += fabsf (luma_of[y][x] - (float) !!memcmp (art_of[y][x], black, 3)) > 0;
  return wrong;
}

/* Limbs of all widths from a pixel on, across and beside each other, each with an outline of a pixel. */
static void
narrow_fills_between_lines_are_fills (void)
{
  uint32_t r = 4;

  for (int round = 0; round < 60; round++)
    {
      box (0, 0, SIDE, SIDE, sky);
      for (int k = 0; k < 5; k++)
        {
          Rgb colour = { (uint8_t) (60 + 40 * k), (uint8_t) (90 + check_random (&r, 160)), (uint8_t) (40 * (4 - k)) };
          int narrow = 1 + (int) check_random (&r, 3), length = 6 + (int) check_random (&r, 20);
          int x = 2 + (int) check_random (&r, SIDE - 30), y = 2 + (int) check_random (&r, SIDE - 30);

          outlined_box (x, y, k % 2 ? narrow : length, k % 2 ? length : narrow, colour);
        }
      find (CELD_INK_LINES);
      NEAR (count_wrong (), 0, 0);
      find (CELD_INK_AUTO);
      NEAR (count_wrong (), 0, 0);
    }
}

/* A black shoe of 8 x 8 pixels beside an outline: an artist can scribble on it. */
static void
areas_in_the_colour_of_lines_are_fills (void)
{
  static const Rgb orange = { 240, 150, 60 };

  box (0, 0, SIDE, SIDE, sky);
  outlined_box (3, 3, 16, 20, orange);
  box (26, 26, 8, 8, black);
  find (CELD_INK_LINES);
  NEAR (count_wrong (), 64, 0);
  CHECK (luma_of[30][30] >= 1 && luma_of[26][26] >= 1 && luma_of[2][10] <= 0);
}

/* Outlines of four pixels, each in a darker shade of its box: half of their pixels have neighbours of one colour alone. */
static void
broad_outlines_have_several_colours (void)
{
  static const Rgb fill[2] = { { 250, 190, 60 }, { 90, 160, 70 } }, line[2] = { { 100, 76, 24 }, { 36, 64, 28 } };
  int              wrong = 0;

  box (0, 0, SIDE, SIDE, sky);
  for (int k = 0; k < 2; k++)
    {
      box (3 + 10 * k, 3 + 12 * k, 22, 20, line[k]);
      box (7 + 10 * k, 7 + 12 * k, 14, 12, fill[k]);
    }
  find (CELD_INK_AUTO);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      wrong += (luma_of[y][x] <= 0) != (!memcmp (art_of[y][x], line[0], 3) || !memcmp (art_of[y][x], line[1], 3));
  NEAR (wrong, 0, 0);
}

/* Brown lines on cream with antialiased sides are line art, though in three colours. */
static void
antialiased_lines_make_no_sprite (void)
{
  static const Rgb cream = { 250, 240, 220 }, side = { 170, 150, 130 }, brown = { 60, 40, 30 };

  box (0, 0, SIDE, SIDE, cream);
  for (int x = 5; x < SIDE - 5; x += 10)
    {
      box (x - 1, 3, 3, SIDE - 6, side);
      box (x, 3, 1, SIDE - 6, brown);
    }
  find (CELD_INK_AUTO);
  for (int i = 0; i < SIDE * SIDE; i++)
    NEAR (luma_of[i / SIDE][i % SIDE], 0.5, 0);
}

/* Black and grey on white is no sprite, unless the artist says so: its lines are those of any drawing with flat greys. */
static void
greys_are_fills (void)
{
  static const Rgb white = { 255, 255, 255 }, grey = { 180, 180, 180 };

  box (0, 0, SIDE, SIDE, white);
  outlined_box (8, 8, 20, 20, grey);
  find (CELD_INK_AUTO);
  CHECK (count_wrong () == 0);
}

int
main (void)
{
  RUN (narrow_fills_between_lines_are_fills);
  RUN (areas_in_the_colour_of_lines_are_fills);
  RUN (broad_outlines_have_several_colours);
  RUN (antialiased_lines_make_no_sprite);
  RUN (greys_are_fills);
  return DONE;
}
