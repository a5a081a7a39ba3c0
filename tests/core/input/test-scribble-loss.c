/* Thin strokes whose chroma a codec has smeared: it stays in blocks of 16 pixels, and so does its sum; luma is shaken.
 * Where strokes cross, a block has several colours.
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

/* Of the pixels in the middle of strokes, how many have a label of about the stroke's colour. */
static double
share_right (void)
{
  size_t right = 0, all = 0;

  for (int p = 0; p < W * H; p++)
    if (painted[p / W][p % W])
      {
        uint32_t seed = seed_of[p / W][p % W];

        all++;
        right += seed && off (palette.item[seed - 1].colour, colour_of[painted[p / W][p % W] - 1]) < 32;
      }
  return (double) right / (double) all;
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
        draw (width);
        store (share[i], 10);
        read_paint ();
        NEAR (palette.n, STROKES, 0);
        CHECK (share_right () > 0.98);
      }
}

/* Four strokes across four others of other colours, which are painted later and cover them. */
static void
draw_crossing (double width)
{
  memset (paint_of, 255, sizeof paint_of);
  memset (painted, 0, sizeof painted);
  for (int k = 0; k < STROKES; k++)
    for (int y = 12; y < H - 12; y++)
      for (int x = 12; x < W - 12; x++)
        {
          double away = k < 4 ? fabs (y - 40 - 66.6 * k - 0.1 * x) / 1.005
                              : fabs (x - 30 - 110.3 * (k - 4) - 0.2 * y) / 1.02;
          double cover = fmin (fmax (width / 2 + 0.5 - away, 0), 1);

          for (int i = 0; i < 3; i++)
            paint_of[y][x][i] = (uint8_t) (cover * colour_of[k][i] + (1 - cover) * paint_of[y][x][i] + 0.5);
          if (away < 1)
            painted[y][x] = (uint32_t) k + 1;
          else if (away < width)
            painted[y][x] = 0;
        }
}

/* No colour that strokes have in a block in which they cross, mixed of both, becomes a label. */
static void
crossings_make_no_labels (void)
{
  for (int width = 3; width < 6; width += 2)
    {
      draw_crossing (width);
      store (0.7, 10);
      read_paint ();
      NEAR (palette.n, STROKES, 0);
      CHECK (share_right () > 0.97);
    }
}

/* Are the strokes of the drawn picture thin? */
static bool
is_thin (void)
{
  CeldPaint         paint = { W, H, W, &paint_of[0][0][0] };
  CeldScribbleLayer r = { .paint = &paint, .width = W, .height = H, .pixels = W * H };
  bool              thin;

  r.id = calloc (W * H, sizeof *r.id);
  r.label = calloc (W * H, sizeof *r.label);
  r.kind = calloc (W * H, 1);
  CHECK (celd_scribble_colours (&r, false, NULL) == CELD_OK);
  r.radius = 6;
  thin = celd_scribble_thin (&r);
  free (r.id);
  free (r.label);
  free (r.kind);
  celd_free (r.colour);
  celd_free (r.slot);
  return thin;
}

/* Their mean width, with the pixels that antialiasing adds, is less than 8 pixels. */
static void
thin_strokes_are_told_from_broad (void)
{
  for (int width = 3; width < 14; width++)
    {
      draw (width);
            CHECK (width == 7 || is_thin () == (width < 7));
      draw_crossing (width);
            CHECK (width == 7 || is_thin () == (width < 7));
    }
}

/* On grey paper the sums of blocks differ, so that nothing is restored. */
static void
only_white_paper_is_restored (void)
{
  draw (4);
  for (int p = 0; p < W * H; p++)
    for (int i = 0; i < 3; i++)
      paint_of[p / W][p % W][i] = (uint8_t) (0.8 * paint_of[p / W][p % W][i]);
  CHECK (!is_thin ());
}

/* Two strokes of a soft brush, 26 pixels across and of an opacity of 0.25, along steps of whole pixels.  Their colours
 * on paper are 19 apart. */
static void
draw_soft (void)
{
  static const uint8_t pink[2][3] = { { 255, 13, 110 }, { 255, 13, 34 } };

  memset (paint_of, 255, sizeof paint_of);
  memset (painted, 0, sizeof painted);
  for (int y = 0; y < H; y++)
    for (int x = 20; x < 300; x++)
      for (int k = 0; k < 2; k++)
        {
          int    away = abs (y - 40 - 90 * k - x / 2);
          double cover = fmin (fmax (0.4 * (1 - away / 13.), 0), 0.25);

          for (int i = 0; i < 3; i++)
            paint_of[y][x][i] = (uint8_t) (cover * pink[k][i] + (1 - cover) * paint_of[y][x][i] + 0.5);
          if (away < 5)
            painted[y][x] = (uint32_t) k + 1;
        }
}

/* Soft strokes are broad, too, so that near colours stay apart. */
static void
near_colours_of_soft_strokes_stay_apart (void)
{
  size_t pixels[2][2] = { { 0 } }, all[2] = { 0 };

  draw_soft ();
  CHECK (!is_thin ());
  read_paint ();
  NEAR (palette.n, 2, 0);
  for (int p = 0; p < W * H; p++)
    if (painted[p / W][p % W])
      {
        uint32_t k = painted[p / W][p % W] - 1, seed = seed_of[p / W][p % W];

        all[k]++;
        if (seed == 1 || seed == 2)
          pixels[k][seed - 1]++;
      }
  CHECK ((pixels[0][0] == all[0] && pixels[1][1] == all[1]) || (pixels[0][1] == all[0] && pixels[1][0] == all[1]));
}

/* Pale strokes, 38 from paper, are no tint of loss where no stroke is stronger: their middle is theirs. */
static void
pale_strokes_are_labels (void)
{
  static const uint8_t pale[2][3] = { { 255, 228, 228 }, { 228, 228, 255 } };
  size_t               right = 0, all = 0;

  memset (paint_of, 255, sizeof paint_of);
  memset (painted, 0, sizeof painted);
  for (int k = 0; k < 2; k++)
    for (int y = 20 + 40 * k; y < 36 + 40 * k; y++)
      for (int x = 20; x < 300; x++)
        {
          memcpy (paint_of[y][x], pale[k], 3);
          painted[y][x] = y >= 24 + 40 * k && y < 32 + 40 * k ? (uint32_t) k + 1 : 0;
        }
  store (1, 4);
  read_paint ();
  NEAR (palette.n, 2, 0);
  for (int p = 0; p < W * H; p++)
    if (painted[p / W][p % W])
      {
        uint32_t seed = seed_of[p / W][p % W];

        all++;
        right += seed && off (palette.item[seed - 1].colour, pale[painted[p / W][p % W] - 1]) < 12;
      }
  CHECK (100 * right > 95 * all);
}

int
main (void)
{
  RUN (smeared_strokes_keep_their_colours);
  RUN (crossings_make_no_labels);
  RUN (thin_strokes_are_told_from_broad);
  RUN (only_white_paper_is_restored);
  RUN (near_colours_of_soft_strokes_stay_apart);
  RUN (pale_strokes_are_labels);
  celd_palette_clear (&palette);
  return DONE;
}
