/* Thin strokes on transparency whose colours vary, as where a filter has made a layer smaller.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "scribble-page.h"

enum { STROKES = 6 };

static const uint8_t pure[STROKES][3] = { { 200, 30, 40 }, { 30, 60, 220 },  { 20, 160, 60 },
                                          { 150, 60, 180 }, { 240, 180, 40 }, { 90, 90, 90 } };

/* Slanting strokes, each of one colour, shaken by so much in each pixel. */
static void
draw (double width, int most)
{
  uint32_t state = 3;

  clear_paint (false);
  for (int k = 0; k < STROKES; k++)
    for (int x = 20; x < 380; x++)
      for (int y = 40 * k + 10; y < 40 * k + 90 && y < HEIGHT; y++)
        {
          double  away = fabs (y - 40 * k - 20 - 0.1 * x);
          uint8_t colour[3];

          for (int i = 0; i < 3; i++)
            colour[i] = (uint8_t) (pure[k][i] + (int) check_random (&state, 2 * (uint32_t) most + 1) - most);
          lay (x, y, colour, fmin (fmax (width / 2 + 0.5 - away, 0), 1));
        }
}

static uint32_t
label_at (int k, int x)
{
  return seed_of[(40 * k + 20 + (int) floor (0.1 * x + 0.5)) * WIDTH + x];
}

/* Is each stroke read, all of it as one label of its own in its colour? */
static void
strokes_are_read (int error)
{
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  NEAR (palette.n, STROKES, 0);
  for (int k = 0; k < STROKES; k++)
    {
      int wrong = 0;

      for (int x = 30; x < 370; x++)
        wrong += !label_at (k, x) || label_at (k, x) != label_at (k, 200);
      NEAR (wrong, 0, 4);
      CHECK (in_palette (pure[k], error));
    }
}

/* They have no pixels whose neighbours all have their colour. */
static void
thin_strokes_have_no_interior (void)
{
  draw (2, 8);
  strokes_are_read (10);
}

/* A short hairline that changes its colour all along: each pixel lies between its neighbours, as in a fringe. */
static void
a_hairline_that_looks_like_a_fringe (void)
{
  clear_paint (false);
  for (int x = 0; x < 24; x++)
    lay (100 + x, 100, (uint8_t[3]) { 200, 40, (uint8_t) (40 + 5 * x) }, 1);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  NEAR (palette.n, 1, 0);
  for (int x = 0; x < 24; x++)
    CHECK (seed_of[100 * WIDTH + 100 + x] == 1);
}

int
main (void)
{
  RUN (thin_strokes_have_no_interior);
  RUN (a_hairline_that_looks_like_a_fringe);
  celd_palette_clear (&palette);
  return DONE;
}
