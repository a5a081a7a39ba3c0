/* Thin strokes whose chroma a codec has smeared: it stays in blocks of 16 pixels, and so does its sum; luma is shaken.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"


enum { W = 480, H = 320, BLOCK = 16, STROKES = 8 };

static const uint8_t colour_of[STROKES][3] = {
  { 200, 30, 40 }, { 30, 60, 200 }, { 20, 130, 50 }, { 90, 90, 96 }, { 20, 20, 24 }, { 240, 200, 60 }, { 180, 90, 200 },
  { 120, 200, 230 },
};

static uint8_t     paint_of[H][W][4];
static uint32_t    painted[H][W], seed_of[H][W];
static CeldPalette palette;

/* Slanting strokes, each `width` across, one above the other. */
static void
draw (double width)
{
  memset (paint_of, 255, sizeof paint_of);
  memset (painted, 0, sizeof painted);
  for (int k = 0; k < STROKES; k++)
    for (int y = 0; y < H; y++)
      for (int x = 20; x < W - 20; x++)
        {
          double away = fabs (y - 30 - 33.3 * k - 0.1 * x) / 1.005, cover = fmin (fmax (width / 2 + 0.5 - away, 0), 1);

          for (int i = 0; i < 3; i++)
            paint_of[y][x][i] = (uint8_t) (cover * colour_of[k][i] + (1 - cover) * paint_of[y][x][i] + 0.5);
          if (away < 1)
            painted[y][x] = (uint32_t) k + 1;
        }
}

static double
luma (const uint8_t *c)
{
  return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
}

/* Each block keeps this share of its chroma in place; the rest goes to all its pixels alike.  Luma is shaken in blocks
 * that are not flat. */
static void
store (double share, int shake)
{
  uint32_t state = 5;

  for (int top = 0; top < H; top += BLOCK)
    for (int left = 0; left < W; left += BLOCK)
      {
        double mean[3] = { 0 };
        bool   flat = true;

        for (int p = 0; p < BLOCK * BLOCK; p++)
          for (int i = 0; i < 3; i++)
            {
              const uint8_t *c = paint_of[top + p / BLOCK][left + p % BLOCK];

              mean[i] += (c[i] - luma (c)) / (BLOCK * BLOCK);
              flat = flat && c[i] == 255;
            }
        for (int p = 0; p < BLOCK * BLOCK && !flat; p++)
          {
            uint8_t *c = paint_of[top + p / BLOCK][left + p % BLOCK];
            double   l = luma (c), shaken = l + check_random (&state, 2 * (uint32_t) shake + 1) - shake;

            for (int i = 0; i < 3; i++)
              c[i] = (uint8_t) fmin (fmax (shaken + share * (c[i] - l) + (1 - share) * mean[i] + 0.5, 0), 255);
          }
      }
}

static void
read_paint (void)
{
  CeldPaint    paint = { W, H, W, &paint_of[0][0][0] };
  CeldLabels   seeds = { W, H, W, &seed_of[0][0] };
  CeldSettings settings = celd_settings ();

  CHECK (celd_scribbles_read (&paint, &settings, NULL, &seeds, &palette) == CELD_OK);
}

static double
off (const uint8_t *a, const uint8_t *b)
{
  return sqrt ((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/* As many labels as colours, each near its own; nearly all of each stroke's middle is its label.  Broader strokes keep
 * more of their chroma. */
static void
smeared_strokes_keep_their_colours (void)
{
  static const double share[] = { 0.7, 0.5, 0.35 };

  for (int width = 3; width < 6; width++)
    for (int i = 0; i < (width < 5 ? 3 : 2); i++)
      {
        size_t right = 0, all = 0;

        draw (width);
        store (share[i], 10);
        read_paint ();
        NEAR (palette.n, STROKES, 0);
        for (int p = 0; p < W * H; p++)
          if (painted[p / W][p % W])
            {
              uint32_t seed = seed_of[p / W][p % W];

              all++;
              right += seed && off (palette.item[seed - 1].colour, colour_of[painted[p / W][p % W] - 1]) < 32;
            }
        CHECK (100 * right > 98 * all);
      }
}

static bool
is_smeared (double width, double share, int shake)
{
  CeldPaint          paint = { W, H, W, &paint_of[0][0][0] };
  CeldScribbleLayer  r = { .paint = &paint, .width = W, .height = H, .pixels = W * H };
  CeldScribbleColour colour[2] = { { .pixels = 0 }, { .channel = { 255, 255, 255 } } };

  draw (width);
  store (share, shake);
  r.colour = colour;
  r.n = 2;
  r.paper = 1;
  return celd_scribble_smeared (&r);
}

/* Noise alone does not smear, however strong; chroma that has left thin strokes does. */
static void
smear_is_told_from_noise (void)
{
  for (int width = 3; width < 13; width += 3)
    for (int shake = 0; shake < 16; shake += 5)
      CHECK (!is_smeared (width, 1, shake));
  for (int shake = 0; shake < 16; shake += 5)
    CHECK (is_smeared (3, 0.6, shake));
}

int
main (void)
{
  RUN (smeared_strokes_keep_their_colours);
  RUN (smear_is_told_from_noise);
  celd_palette_clear (&palette);
  return DONE;
}
