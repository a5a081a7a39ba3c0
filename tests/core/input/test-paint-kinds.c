/* Whether layers are scribbles, grey, or strokes in clear colours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"

enum { SIDE = 100 };

static uint8_t rgba[4 * SIDE * SIDE];

static CeldPaint
layer (int width, int height)
{
  return (CeldPaint) { width, height, SIDE, rgba };
}

static void
put (int x, int y, int red, int green, int blue, int alpha)
{
  uint8_t *p = rgba + 4 * (y * SIDE + x);

  p[0] = (uint8_t) red;
  p[1] = (uint8_t) green;
  p[2] = (uint8_t) blue;
  p[3] = (uint8_t) alpha;
}

/* Strokes ten pixels wide in rows of 25, in these colours by turns, on a page of this grey and alpha. */
static void
draw_strokes (const int colour[2][3], int page, int alpha)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        const int *c = colour[y / 25 % 2];

        if (y % 25 < 10)
          put (x, y, c[0], c[1], c[2], 255);
        else
          put (x, y, page, page, page, alpha);
      }
}

/* Every pixel differs from its neighbours. */
static void
draw_photograph (void)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (x, y, (7 * x + 3 * y) % 256, (5 * x + 11 * y) % 256, (2 * x + 2 * y + x * y / 50) % 256, 255);
}

static const int clear[2][3] = { { 230, 30, 30 }, { 30, 60, 220 } }, inks[2][3] = { { 20, 20, 20 }, { 120, 115, 118 } },
                 reds[2][3] = { { 230, 30, 30 }, { 200, 20, 20 } };

static void
scribbles (void)
{
  CeldPaint paint = layer (SIDE, SIDE), small = layer (63, SIDE);

  draw_strokes (clear, 255, 0);
  CHECK (celd_are_scribbles (&paint) && celd_is_coloured_strokes (&paint) && !celd_is_grey (&paint));
  draw_strokes (clear, 255, 255);
  CHECK (celd_are_scribbles (&paint) && celd_is_coloured_strokes (&paint) && !celd_is_grey (&paint));
  draw_strokes (reds, 255, 0);
  CHECK (celd_are_scribbles (&paint) && !celd_is_coloured_strokes (&paint)); /* one hue: may be a red pencil */
  draw_photograph ();
  CHECK (!celd_are_scribbles (&paint) && !celd_are_scribbles (&small) && !celd_is_grey (&paint));
}

/* Grain on blank paper makes all neighbours differ, but there is one colour. */
static void
scanned_scribbles (void)
{
  CeldPaint paint = layer (SIDE, SIDE);

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (y % 25 < 8)
        put (x, y, 190 + (x * 7 + y) % 20, 40, 40 + (x + y * 5) % 20, 255);
      else
        put (x, y, 226 + (x * 7 + y * 3) % 29, 230 + (x * 5 + y * 7) % 25, 228, 255);
  CHECK (celd_are_scribbles (&paint));
}

/* Small photographs; and grey ones of which nearly all is of one colour, which is dark. */
static void
small_and_dark_photographs (void)
{
  CeldPaint paint = layer (SIDE, SIDE), small = layer (40, 32), tiny = layer (40, 31);

  draw_photograph ();
  CHECK (!celd_are_scribbles (&small) && celd_are_scribbles (&tiny));
  put (0, 0, 0, 0, 0, 0);
  CHECK (celd_are_scribbles (&small)); /* soft strokes on a small transparent layer */
  for (int light = 0; light < 2; light++)
    {
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            int grey = (light ? 226 : 34) + (x * 7 + y * 3) % 29;

            put (x, y, grey, grey, grey, 255);
          }
      CHECK (celd_are_scribbles (&paint) == light);
    }
}

static void
grey_pictures (void)
{
  CeldPaint paint = layer (SIDE, SIDE);

  draw_strokes (inks, 255, 255);
  CHECK (celd_is_grey (&paint) && !celd_is_coloured_strokes (&paint));
  put (50, 50, 200, 30, 30, 0); /* cannot be seen */
  CHECK (celd_is_grey (&paint));
  put (50, 50, 200, 30, 30, 255);
  CHECK (!celd_is_grey (&paint));
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (x, y, 0, 0, 0, 0);
  CHECK (!celd_is_grey (&paint)); /* nothing has been painted yet */
}

/* Fills all over the page are no strokes. */
static void
fills (void)
{
  CeldPaint paint = layer (SIDE, SIDE);

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (x, y, clear[x / 50][0], clear[x / 50][1], clear[x / 50][2], 255);
  CHECK (!celd_is_coloured_strokes (&paint));
}

/* More than a hundredth of all pixels, by more than JPEG changes a channel. */
static void
colours (void)
{
  CeldPaint paint = layer (SIDE, SIDE);
  int       least = SIDE * SIDE / 100 + 1;

  for (int hue = 12; hue <= 13; hue++)
    for (int n = least - 1; n <= least; n++)
      {
        for (int i = 0; i < SIDE * SIDE; i++)
          put (i % SIDE, i / SIDE, 100, 100, 100 + (i < n ? hue : 0), 255);
        CHECK (celd_paint_is_coloured (&paint) == (hue == 13 && n == least));
      }
  for (int i = 0; i < SIDE * SIDE; i++)
    put (i % SIDE, i / SIDE, 200, 0, 0, 0);
  CHECK (!celd_paint_is_coloured (&paint)); /* what is transparent has no colour */
}

/* A clear colour on two of 40000 pixels, which is seen. */
static void
few_colours (void)
{
  static uint8_t large[4 * 200 * 200];
  CeldPaint      paint = { 200, 200, 200, large };

  for (int i = 0; i < 200 * 200; i++)
    paint.data[4 * i + 3] = 255;
  CHECK (!celd_paint_has_colours (&paint));
  paint.data[0] = paint.data[4] = 63;
  CHECK (!celd_paint_has_colours (&paint));
  paint.data[0] = 64;
  CHECK (!celd_paint_has_colours (&paint));
  paint.data[4] = 64;
  CHECK (celd_paint_has_colours (&paint));
  paint.data[3] = 127;
  CHECK (!celd_paint_has_colours (&paint));
}

int
main (void)
{
  RUN (scribbles);
  RUN (scanned_scribbles);
  RUN (small_and_dark_photographs);
  RUN (grey_pictures);
  RUN (fills);
  RUN (colours);
  RUN (few_colours);
  return DONE;
}
