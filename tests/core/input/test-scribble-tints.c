/* Soft, translucent and resampled strokes, flattened on white paper: one label each, in the colour of their middle.
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
  RUN (sharp_edges_on_paper);
  celd_palette_clear (&palette);
  return DONE;
}
