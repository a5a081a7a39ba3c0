/* Soft, translucent and resampled strokes, flattened on white paper, also with loss: one label each, in the colour of
 * their middle.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "scribble-page.h"

/* Very soft brushes on white, one of them along the frame: the pale tails of their edges are no labels. */
static void
soft_brushes_on_paper (void)
{
  clear_paint (true);
  for (int k = 0; k < 3; k++)
    for (int y = 0; y < HEIGHT; y++)
      for (int x = 0; x < WIDTH; x++)
        {
          double away = k == 0 ? abs (x - 27) : k == 1 ? abs (y - 120) : hypot (x - 210, (y - 220) / 2.);

          lay (x, y, k == 0 ? red : k == 1 ? blue : green, fmin (2 * exp (-away * away / 90), 1));
        }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 3);
  CHECK (in_palette (red, 2) && in_palette (blue, 2) && in_palette (green, 2));
}

/* A blurred stroke of a colour that many others pass through where paper thins them: being broad, it has it. */
static void
blurred_strokes_on_paper (void)
{
  const uint8_t pink[3] = { 255, 105, 115 }, strong[3] = { 255, 15, 15 };

  clear_paint (true);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 0; x < WIDTH; x++)
      {
        double wave = y - 0.3 * x, away = (wave - 60) / 4, far = (fmod (wave, 30) - 15) / 4;

        lay (x, y, strong, x > 20 && x < 380 && wave > 90 ? exp (-far * far) : 0);
        lay (x, y, pink, x > 20 && x < 80 ? exp (-away * away) : 0);
      }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  CHECK (in_palette (strong, 16) && in_palette (pink, 16));
  CHECK (seed_of[75 * WIDTH + 50] && seed_of[75 * WIDTH + 50] != seed_of[165 * WIDTH + 200]);
}

/* Narrow soft brushes of half opacity, flattened on white: each label has the tint in the middle of its strokes, and
 * near colours remain two although their tints are twice as near. */
static void
narrow_translucent_strokes_on_paper (void)
{
  static const uint8_t pure[5][3] = { { 255, 13, 13 }, { 184, 73, 170 }, { 160, 73, 184 }, { 124, 73, 184 },
                                      { 102, 198, 255 } };

  for (int width = 3; width < 10; width++)
    {
      clear_paint (true);
      for (int k = 0; k < 5; k++)
        for (int y = 40 * k + 20; y < 40 * k + 60; y++)
          for (int x = 20; x < 320; x++)
            {
              double away = fabs (y - 40 * k - 40 - 10 * sin (x / 40.));

              lay (x, y, pure[k], 0.5 * fmin (fmax (1.6 * (1 - 2 * away / width), 0), 1));
            }
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 5);
      for (int k = 0; k < 5; k++)
        {
          uint8_t  tint[3] = { (uint8_t) ((255 + pure[k][0]) / 2), (uint8_t) ((255 + pure[k][1]) / 2),
                               (uint8_t) ((255 + pure[k][2]) / 2) };
          uint32_t label = seed_of[(40 * k + 40 + 7) * WIDTH + 31];
          int      wrong = 0;

          for (int x = 20; x < 320; x++)
            wrong += seed_of[(40 * k + 40 + (int) floor (10 * sin (x / 40.) + 0.5)) * WIDTH + x] != label;
          CHECK (in_palette (tint, 1));
          CHECK (wrong == 0 && label && label <= palette.n && abs (palette.item[label - 1].colour[0] - tint[0]) <= 1 &&
                 abs (palette.item[label - 1].colour[1] - tint[1]) <= 1);
        }
    }
}

/* Strokes of a soft pen whose pressure changes their opacity, on white: each is one label, in its strongest tint.  Two
 * hard strokes in tints of one colour remain two, also where they touch. */
static void
pressure_on_paper (void)
{
  const uint8_t pink[3] = { 255, 170, 170 };
  int           wrong = 0;

  for (int period = 30; period <= 90; period += 20)
    {
      clear_paint (true);
      for (int y = 0; y < HEIGHT; y++)
        for (int x = 30; x < 370; x++)
          for (int k = 0; k < 2; k++)
            {
              double away = fabs (y - (k ? 210 : 80) - 20 * sin (x / 50.));
              double pressure = 0.7 + 0.3 * cos (x * 6.2832 / period);

              lay (x, y, k ? blue : red, pressure * fmin (fmax ((10 - away) / 3, 0), 1));
            }
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
      CHECK (in_palette (red, 4) && in_palette (blue, 4));
      for (int x = 40; x < 360; x++)
        for (int k = 0; k < 2; k++)
          wrong += seed_of[((k ? 210 : 80) + (int) lrint (20 * sin (x / 50.))) * WIDTH + x] !=
                   seed_of[(k ? 221 : 91) * WIDTH + 30];
    }
  CHECK (wrong == 0 && seed_of[91 * WIDTH + 30]);

  clear_paint (true);
  block (60, 100, 100, 16, red);
  block (160, 100, 100, 16, pink);
  for (int y = 100; y < 116; y++)
    lay (160, y, red, 0.5);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
  CHECK (in_palette (red, 0) && in_palette (pink, 0));
}

/* A hard pen of changing pressure is never less than two thirds as opaque as where it is strongest. */
static void
little_pressure_on_paper (void)
{
  clear_paint (true);
  for (int y = 0; y < HEIGHT; y++)
    for (int x = 30; x < 370; x++)
      for (int k = 0; k < 2; k++)
        {
          double away = fabs (y - (k ? 210 : 80) - 20 * sin (x / 50.)), pressure = 0.85 + 0.15 * cos (x / 40.);

          lay (x, y, k ? blue : red, pressure * fmin (fmax (8.5 - away, 0), 1));
        }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
  CHECK (in_palette (red, 4) && in_palette (blue, 4));
}

/* Pens of changing pressure that cross: where they do, all mixtures of their tints are found, and none is a label. */
static void
crossing_pressure_on_paper (void)
{
  clear_paint (true);
  for (int y = 20; y < HEIGHT - 20; y++)
    for (int x = 30; x < 370; x++)
      {
        double side = fabs (y - 150 - 0.2 * (x - 200)), along = fabs (x - 200 + 0.3 * (y - 150));

        lay (x, y, blue, (0.65 + 0.35 * cos ((y - 75) * 6.2832 / 150)) * fmin (fmax (16.5 - along, 0), 1));
        lay (x, y, red, (0.65 + 0.35 * cos ((x - 100) * 6.2832 / 200)) * fmin (fmax (16.5 - side, 0), 1));
      }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
  CHECK (in_palette (red, 6) && in_palette (blue, 6));
}

/* Shakes each block of 16 pixels that is not blank, as a codec does: all pixels by luma, and the block by chroma. */
static void
shake_paint (int luma, int chroma)
{
  uint32_t state = 7;

  for (int top = 0; top < HEIGHT; top += 16)
    for (int left = 0; left < WIDTH; left += 16)
      {
        int  bottom = top + 16 < HEIGHT ? top + 16 : HEIGHT, shift[3];
        bool blank = true;

        for (int i = 0; i < 3; i++)
          shift[i] = (int) check_random (&state, 2 * (uint32_t) chroma + 1) - chroma;
        for (int y = top; y < bottom; y++)
          for (int x = left; x < left + 16; x++)
            for (int i = 0; i < 3; i++)
              blank = blank && paint_of[4 * (y * WIDTH + x) + i] == 255;
        for (int y = top; y < bottom && !blank; y++)
          for (int x = left; x < left + 16; x++)
            {
              uint8_t *c = paint_of + 4 * (y * WIDTH + x);
              int      shaken = (int) check_random (&state, 2 * (uint32_t) luma + 1) - luma;

              for (int i = 0; i < 3; i++)
                c[i] = (uint8_t) fmin (fmax (c[i] + shaken + shift[i], 0), 255);
            }
      }
}

/* Soft brushes of half opacity, and pens of changing pressure, stored with loss: one label each, nearly in the colour
 * that they have where they are strongest. */
static void
soft_strokes_with_loss (void)
{
  static const uint8_t pure[4][3] = { { 200, 30, 40 }, { 30, 60, 220 }, { 20, 160, 60 }, { 60, 0, 160 } };

  for (int loss = 4; loss <= 8; loss += 4)
    {
      clear_paint (true);
      for (int k = 0; k < 4; k++)
        for (int y = 70 * k + 10; y < 70 * k + 70; y++)
          for (int x = 20; x < 380; x++)
            {
              double away = fabs (y - 70 * k - 40 - 10 * sin (x / 40.));
              double pressure = 0.7 + 0.3 * cos (x / (k < 3 ? 40. : 1.6));

              lay (x, y, pure[k], k < 2 ? 0.5 * fmax (1 - away / 14, 0) : pressure * fmin (fmax ((12 - away) / 3, 0), 1));
            }
      shake_paint (loss, 3);
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
      NEAR (palette.n, 4, 0);
      for (int k = 0; k < 4; k++)
        {
          uint8_t tint[3];

          for (int i = 0; i < 3; i++)
            tint[i] = (uint8_t) (k < 2 ? (255 + pure[k][i]) / 2 : pure[k][i]);
          CHECK (in_palette (tint, 24));
        }
    }
}

/* A grey stroke that a black one crosses, both with soft edges and stored with loss, is no tint of that: most of it has
 * one colour, nearly. */
static void
grey_across_black_with_loss (void)
{
  static const uint8_t black[3] = { 0, 0, 0 }, grey[3] = { 110, 110, 110 };

  clear_paint (true);
  spray (30, 60, 370, 240, 7, 0.5, 1, grey);
  spray (200, 20, 180, 280, 7, 0.5, 1, black);
  shake_paint (4, 2);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  NEAR (palette.n, 2, 0);
  CHECK (in_palette (black, 24) && in_palette (grey, 24));
}

static double
lanczos (double x)
{
  double t = 3.14159265358979 * x;

  return fabs (x) < 1e-9 ? 1 : fabs (x) >= 3 ? 0 : 3 * sin (t) * sin (t / 3) / (t * t);
}

/* A line of that width, `away` pixels from its middle, after a picture with hard edges was made half as large by
 * Lanczos's filter: it overshoots by some percent inside the edges. */
static double
resampled_line (double away, double width)
{
  double sum = 0, all = 0;

  for (int k = -12; k <= 12; k++)
    {
      double at = floor (2 * away) + 0.5 + k, weight = lanczos ((at / 2 - away));

      all += weight;
      sum += fabs (at / 2) < width / 2 ? weight : 0;
    }
  return sum / all;
}

/* Aslant strokes made smaller with a sharp filter keep the colour of their inside: that of their rims is a tenth
 * stronger, and no relation names it. */
static void
sharp_edges_on_paper (void)
{
  for (double width = 6; width <= 6.5; width += 0.5)
    for (double slant = 0.2; slant <= 0.4; slant += 0.2)
      {
        clear_paint (true);
        for (int y = 0; y < HEIGHT; y++)
          for (int x = 30; x < 370; x++)
            {
              double   cover = resampled_line ((y - 150 - slant * (x - 200)) / hypot (1, slant), width);
              uint8_t *p = paint_of + 4 * (y * WIDTH + x);

              for (int i = 0; i < 3; i++)
                p[i] = (uint8_t) lrint (fmin (fmax (255 + cover * (red[i] - 255), 0), 255));
            }
        CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 1);
        CHECK (in_palette (red, 5));
      }
}

int
main (void)
{
  RUN (soft_brushes_on_paper);
  RUN (blurred_strokes_on_paper);
  RUN (narrow_translucent_strokes_on_paper);
  RUN (pressure_on_paper);
  RUN (little_pressure_on_paper);
  RUN (crossing_pressure_on_paper);
  RUN (soft_strokes_with_loss);
  RUN (grey_across_black_with_loss);
  RUN (sharp_edges_on_paper);
  celd_palette_clear (&palette);
  return DONE;
}
