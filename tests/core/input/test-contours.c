/* Virtual contours: each colour for each purpose, leaks, open ends, polarity, and what stays untouched.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"


enum { SIDE = 120 };

static float   luma_of[SIDE * SIDE], alpha_of[SIDE * SIDE], baked_luma[SIDE * SIDE], baked_alpha[SIDE * SIDE];
static uint8_t paint_of[4 * SIDE * SIDE];

static const uint8_t red[4] = { 230, 30, 40, 255 }, blue[4] = { 20, 60, 240, 255 }, green[4] = { 30, 180, 60, 255 };

/* White paper with a black frame, left and right of it as tall as the picture: columns 20-23 and 96-99. */
static void
clear (void)
{
  memset (paint_of, 0, sizeof paint_of);
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int x = i % SIDE;

      luma_of[i] = (x >= 20 && x < 24) || (x >= 96 && x < 100) ? 0 : 1;
      alpha_of[i] = 1;
    }
}

static void
rectangle (int left, int top, int width, int height, const uint8_t colour[4])
{
  for (int y = top; y < top + height; y++)
    for (int x = left; x < left + width; x++)
      memcpy (paint_of + 4 * (y * SIDE + x), colour, 4);
}

static CeldStatus
bake (CeldPurpose purpose, CeldInkMode mode, bool transparent)
{
  CeldDrawing drawing = { .luma = { SIDE, SIDE, SIDE, luma_of } }, out = { .luma = { SIDE, SIDE, SIDE, baked_luma } };
  CeldPaint   contours = { SIDE, SIDE, SIDE, paint_of };

  if (transparent)
    {
      drawing.alpha = (CeldPlane) { SIDE, SIDE, SIDE, alpha_of };
      out.alpha = (CeldPlane) { SIDE, SIDE, SIDE, baked_alpha };
    }
  return celd_contours_bake (&drawing, &contours, purpose, mode, NULL, &out);
}

/* Does paper connect the two points, going from pixel to pixel along rows and columns? */
static bool
connected (int from, int to)
{
  static int  todo[SIDE * SIDE];
  static bool seen[SIDE * SIDE];
  int         n = 0;

  memset (seen, 0, sizeof seen);
  todo[n++] = from;
  seen[from] = true;
  while (n > 0)
    {
      static const int step[] = { 1, -1, SIDE, -SIDE };
      int              p = todo[--n];

      for (int k = 0; k < 4; k++)
        {
          int q = p + step[k];

          if (q < 0 || q >= SIDE * SIDE || seen[q] || baked_luma[q] < 0.5f || (k < 2 && q / SIDE != p / SIDE))
            continue;
          seen[q] = true;
          todo[n++] = q;
        }
    }
  return seen[to];
}

enum { ABOVE = 30 * SIDE + 60, BELOW = 90 * SIDE + 60 };

static void
each_colour_for_each_purpose (void)
{
  clear ();
  rectangle (24, 58, 72, 4, red);
  CHECK (bake (CELD_FOR_SEGMENTATION, CELD_INK_AUTO, false) == CELD_OK && !connected (ABOVE, BELOW));
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && !connected (ABOVE, BELOW));
  NEAR (baked_luma[60 * SIDE + 60], 0, 0.01);

  clear ();
  rectangle (24, 58, 72, 4, blue);
  CHECK (bake (CELD_FOR_SEGMENTATION, CELD_INK_AUTO, false) == CELD_OK && !connected (ABOVE, BELOW));
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && connected (ABOVE, BELOW));
  CHECK (!memcmp (baked_luma, luma_of, sizeof luma_of));

  for (int purpose = 0; purpose < 2; purpose++)
    {
      clear ();
      rectangle (15, 50, 14, 30, green);
      CHECK (bake ((CeldPurpose) purpose, CELD_INK_AUTO, false) == CELD_OK);
      CHECK (connected (60 * SIDE + 10, ABOVE) && !connected (60 * SIDE + 110, ABOVE));
      NEAR (baked_luma[60 * SIDE + 21], 1, 1e-3);
    }
}

/* Blue along a contour takes it away for depth; blue across it, or over it at the end of a stroke, does not. */
static void
blue_along_and_across (void)
{
  clear ();
  rectangle (18, 40, 8, 50, blue);
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && connected (60 * SIDE + 10, ABOVE));
  CHECK (bake (CELD_FOR_SEGMENTATION, CELD_INK_AUTO, false) == CELD_OK && !connected (60 * SIDE + 10, ABOVE));
  clear ();
  rectangle (5, 58, 100, 4, blue);
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && !memcmp (baked_luma, luma_of, sizeof luma_of));
}

/* One pixel wide, straight or slanting in any direction, a red stroke lets nothing through, and is two pixels wide. */
static void
thin_strokes_hold (void)
{
  for (int slope = -40; slope <= 40; slope += 5)
    {
      clear ();
      for (int x = 22; x < 98; x++)
        memcpy (paint_of + 4 * ((60 + (int) lround ((x - 60) * slope / 40.)) * SIDE + x), red, 4);
      CHECK (bake (CELD_FOR_SEGMENTATION, CELD_INK_AUTO, false) == CELD_OK);
      CHECK (!connected (10 * SIDE + 60, 110 * SIDE + 60));
      for (int x = 30; x < 90; x++)
        {
          int n = 0;

          for (int y = 0; y < SIDE; y++)
            n += baked_luma[y * SIDE + x] < 0.5f;
          CHECK (n >= 2 && n <= 4);
        }
    }
}

/* Ends that stop short by a few pixels are joined to ink, to the frame and to each other; wide gaps stay open. */
static void
open_ends_are_joined (void)
{
  for (int gap = 0; gap <= 20; gap++)
    if (gap <= 4 || gap >= 10)
      {
        clear ();
        rectangle (24 + gap, 58, 72 - gap, 3, red);
        CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && connected (ABOVE, BELOW) == (gap > 4));
        clear ();
        rectangle (24, 40, 30, 3, red);
        rectangle (54 + gap, 40, 42 - gap, 3, red);
        CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && connected (ABOVE, BELOW) == (gap > 4));
        clear ();
        rectangle (gap, 58, 20 - gap, 3, red);
        CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK);
        CHECK (connected (10, 110 * SIDE + 10) == (gap > 4));
      }
}

/* A dab in a gap closes it on both sides. */
static void
dab_closes_gap (void)
{
  clear ();
  for (int y = 50; y < 62; y++)
    for (int x = 20; x < 24; x++)
      luma_of[y * SIDE + x] = 1;
  rectangle (20, 53, 4, 6, red);
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && !connected (56 * SIDE + 10, ABOVE));
}

/* A stroke leaves what it does not cover as it was, to the last bit; other hues are no contours. */
static void
rest_is_untouched (void)
{
  const uint8_t yellow[4] = { 240, 220, 20, 255 }, grey[4] = { 90, 90, 90, 255 }, violet[4] = { 200, 0, 220, 255 };
  uint32_t      seed = 4;

  clear ();
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] -= 0.1f * (float) check_random (&seed, 1000) / 1000;
  luma_of[5] = NAN;
  rectangle (30, 10, 30, 5, yellow);
  rectangle (30, 20, 30, 5, grey);
  rectangle (30, 30, 30, 5, violet);
  CHECK (bake (CELD_FOR_SEGMENTATION, CELD_INK_AUTO, false) == CELD_OK);
  CHECK (!memcmp (baked_luma, luma_of, sizeof luma_of));
  rectangle (40, 60, 30, 5, red);
  CHECK (bake (CELD_FOR_SEGMENTATION, CELD_INK_AUTO, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      bool covered = i % SIDE >= 40 && i % SIDE < 70 && i / SIDE >= 60 && i / SIDE < 65;

      CHECK (covered ? baked_luma[i] < 0.1f : !memcmp (&baked_luma[i], &luma_of[i], sizeof *luma_of));
    }
}

/* The soft rim of a stroke covers in part. */
static void
alpha_is_coverage (void)
{
  clear ();
  rectangle (40, 60, 30, 5, red);
  rectangle (40, 65, 30, 1, (uint8_t[4]) { 230, 30, 40, 51 });
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK);
  NEAR (baked_luma[65 * SIDE + 50], 0.8, 0.01);
}

/* Chalk gets chalk; the ink of both drawings is the same. */
static void
chalk (void)
{
  static float dark[SIDE * SIDE];
  CeldPlane    ink = { SIDE, SIDE, SIDE, dark };

  clear ();
  rectangle (24, 58, 72, 4, red);
  rectangle (15, 20, 14, 20, green);
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_DARK, false) == CELD_OK);
  memcpy (dark, baked_luma, sizeof dark);
  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 1 - luma_of[i];
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_LIGHT, false) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    NEAR (baked_luma[i], 1 - ink.data[i], 1e-6);
}

/* On a layer of lines the alpha is drawn in, and the lines keep their colour. */
static void
line_layer (void)
{
  clear ();
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      alpha_of[i] = 1 - luma_of[i];
      luma_of[i] = 0.75f;
    }
  rectangle (24, 58, 72, 4, red);
  rectangle (15, 20, 14, 20, green);
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, true) == CELD_OK && !memcmp (baked_luma, luma_of, sizeof luma_of));
  CHECK (baked_alpha[60 * SIDE + 60] == 1 && baked_alpha[30 * SIDE + 21] == 0 && baked_alpha[80 * SIDE + 60] == 0 &&
         baked_alpha[80 * SIDE + 21] == 1);
}

/* Dark lines and chalk on a picture with alpha: strokes are painted in its luma, and alpha grows where ink needs it. */
static void
ink_over_alpha (void)
{
  for (int chalk = 0; chalk < 2; chalk++)
    {
      clear ();
      for (int i = 0; i < SIDE * SIDE; i++)
        {
          alpha_of[i] = i % SIDE < 40 || i % SIDE >= 80 ? 1 : 0.5f;
          luma_of[i] = chalk ? 1 - luma_of[i] : luma_of[i];
        }
      rectangle (24, 58, 72, 4, red);
      rectangle (15, 20, 14, 20, green);
      CHECK (bake (CELD_FOR_DEPTH, chalk ? CELD_INK_LIGHT : CELD_INK_DARK, true) == CELD_OK);
      for (int i = 0; i < SIDE * SIDE; i++)
        {
          int  x = i % SIDE, y = i / SIDE;
          bool is_red = x >= 24 && x < 96 && y >= 58 && y < 62, is_green = x >= 15 && x < 29 && y >= 20 && y < 40;

          if (is_red)
            {
              NEAR (baked_luma[i], chalk, 0.01);
              NEAR (baked_alpha[i], 1, 0.01);
            }
          else if (is_green)
            {
              NEAR (baked_luma[i], !chalk, 0.01);
              NEAR (baked_alpha[i], 1, 0);
            }
          else
            CHECK (baked_luma[i] == luma_of[i] && baked_alpha[i] == alpha_of[i]);
        }
    }
}

/* Without alpha the commonest colour is none, even if it is red. */
static void
opaque_contours (void)
{
  clear ();
  rectangle (0, 0, SIDE, SIDE, (uint8_t[4]) { 255, 0, 0, 255 });
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && !memcmp (baked_luma, luma_of, sizeof luma_of));
  rectangle (0, 0, SIDE, SIDE, (uint8_t[4]) { 255, 255, 255, 255 });
  rectangle (24, 58, 72, 4, red);
  CHECK (bake (CELD_FOR_DEPTH, CELD_INK_AUTO, false) == CELD_OK && !connected (ABOVE, BELOW) && connected (ABOVE, 60));
}

static void
sizes (void)
{
  CeldDrawing drawing = { .luma = { SIDE, SIDE, SIDE, luma_of } };
  CeldPaint   paint = { SIDE - 1, SIDE, SIDE, paint_of };

  clear ();
  rectangle (0, 0, 60, 60, red);
  CHECK (celd_contours_bake (&drawing, &paint, CELD_FOR_DEPTH, CELD_INK_AUTO, NULL, &drawing) == CELD_BAD_SIZE);
  for (int w = 2; w < 40; w += 6)
    for (int h = 1; h < 40; h += 6)
      {
        clear ();
        for (int i = 0; i < SIDE * SIDE; i++)
          luma_of[i] = 1;
        rectangle (0, 0, 60, 60, green);
        rectangle (0, 0, 1, 60, red);
        drawing.luma.width = paint.width = w;
        drawing.luma.height = paint.height = h;
        CHECK (celd_contours_bake (&drawing, &paint, CELD_FOR_DEPTH, CELD_INK_DARK, NULL, &drawing) == CELD_OK);
        CHECK (luma_of[0] < 0.1f && luma_of[(h - 1) * SIDE + w] == 1 && luma_of[h * SIDE] == 1);
      }
}

int
main (void)
{
  RUN (each_colour_for_each_purpose);
  RUN (blue_along_and_across);
  RUN (thin_strokes_hold);
  RUN (open_ends_are_joined);
  RUN (dab_closes_gap);
  RUN (rest_is_untouched);
  RUN (alpha_is_coverage);
  RUN (chalk);
  RUN (line_layer);
  RUN (ink_over_alpha);
  RUN (opaque_contours);
  RUN (sizes);
  return DONE;
}
