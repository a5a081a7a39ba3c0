/* CeldScribbleLayer scribbles: exact colours, tiny solid strokes, and what soft brushes, overlaps and lossy storage
 * add.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "scribble-page.h"

/* Counts, order, places and seeds agree with what was painted, pixel by pixel. */
static void
exact_colours (void)
{
  clear_paint (false);
  block (10, 10, 30, 20, red);
  block (60, 10, 40, 20, blue);
  block (10, 50, 5, 5, green);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 3);
  CHECK (palette.item[0].seeds == 800 && !memcmp (palette.item[0].colour, blue, 3) && palette.item[0].colour[3] == 255);
  CHECK (palette.item[1].seeds == 600 && !memcmp (palette.item[1].colour, red, 3));
  CHECK (palette.item[2].seeds == 25 && !memcmp (palette.item[2].colour, green, 3));
  for (size_t i = 0; i < palette.n; i++)
    {
      CHECK (palette.item[i].origin == CELD_FROM_SCRIBBLE && !palette.item[i].background && !palette.item[i].hard);
      CHECK (seed_of[palette.item[i].y * WIDTH + palette.item[i].x] == i + 1);
    }
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
      const uint8_t *p = paint_of + 4 * i;

      CHECK (seed_of[i] == 0 ? p[3] == 0 : p[3] == 255 && !memcmp (palette.item[seed_of[i] - 1].colour, p, 3));
    }
}

/* A pencil line one pixel wide, a dot of 2 x 2 and a dab of 12 x 6 are labels; near colours are two. */
static void
tiny_strokes (void)
{
  const uint8_t violet[3] = { 184, 73, 170 }, plum[3] = { 160, 73, 184 };

  clear_paint (false);
  for (int i = 0; i < 50; i++)
    lay (10 + i, 10 + i / 3, red, 1);
  block (100, 10, 2, 2, blue);
  block (120, 10, 12, 6, violet);
  block (140, 10, 12, 6, plum);
  lay (200, 200, green, 1); /* a single stray pixel is none */
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 4);
  CHECK (in_palette (red, 0) && in_palette (blue, 0) && in_palette (violet, 0) && in_palette (plum, 0));
  CHECK (seed_of[200 * WIDTH + 200] == 0);
}

/* In a small picture without antialiasing one pixel is a stroke; with a soft one anywhere it is stray. */
static void
strokes_of_one_pixel (void)
{
  clear_paint (false);
  for (int i = 0; i < 50; i++)
    lay (10 + i, 10 + i / 3, red, 1);
  lay (100, 100, green, 1);
  CHECK (read_size (128, 128) == CELD_OK && palette.n == 2 && in_palette (green, 0));
  CHECK (seed_of[100 * WIDTH + 100] > 0 && seed_of[100 * WIDTH + 100] != seed_of[10 * WIDTH + 10]);
  lay (50, 100, red, 0.5);
  CHECK (read_size (128, 128) == CELD_OK && palette.n == 1 && seed_of[100 * WIDTH + 100] == 0);
}

/* Colours of which no two are alike. */
static void
one_of_200 (int i, uint8_t colour[3])
{
  colour[0] = (uint8_t) (40 * (i % 6) + 10);
  colour[1] = (uint8_t) (40 * (i / 6 % 6) + 10);
  colour[2] = (uint8_t) (40 * (i / 36) + 10);
}

static void
two_hundred_labels (void)
{
  uint32_t seed = 11;
  uint8_t  colour[3];

  clear_paint (false);
  for (int i = 0; i < 200; i++)
    {
      int x = i % 20 * 20 + 4 + (int) check_random (&seed, 4), y = i / 20 * 30 + 4 + (int) check_random (&seed, 10);

      one_of_200 (i, colour);
      stroke (x, y, x + 6, y + 8, 2, 1, colour);
    }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 200);
  for (int i = 0; i < 200; i++)
    {
      one_of_200 (i, colour);
      CHECK (in_palette (colour, 0));
    }
}

/* Soft strokes that cross, on a layer and on opaque paper, make two labels; the middle of each stroke is its own. */
static void
soft_overlaps (void)
{
  for (int white = 0; white < 2; white++)
    for (int soft = 1; soft <= 33; soft += 4)
      {
        clear_paint (white);
        stroke (60, 60, 340, 240, 6, soft, red);
        stroke (340, 60, 60, 240, 6, soft, blue);
        CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
        CHECK (in_palette (red, 8) && in_palette (blue, 8));
        if (palette.n == 2)
          CHECK (abs (palette.item[seed_of[96 * WIDTH + 116] - 1].colour[0] - red[0]) < 9 &&
                 abs (palette.item[seed_of[150 * WIDTH + 200] - 1].colour[2] - blue[2]) < 9);
      }
}

/* Strokes of two thirds opacity that cross: the flat mixture in the middle is one of the two, on a layer and paper. */
static void
translucent_overlaps (void)
{
  for (int white = 0; white < 2; white++)
    {
      clear_paint (white);
      for (int k = 0; k < 2; k++)
        for (int y = 0; y < HEIGHT; y++)
          for (int x = 0; x < WIDTH; x++)
            {
              double from = fabs (k ? 0.6 * (x - 200) + 0.8 * (y - 150) : 0.6 * (x - 200) - 0.8 * (y - 150));

              if (x > 40 && x < 360)
                lay (x, y, k ? red : blue, 0.67 * fmin (fmax (20.5 - from, 0), 1));
            }
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
      CHECK (seed_of[150 * WIDTH + 200] != 0);
    }
}

/* Which colour has the label at a point? 0, 1, ...; -1: none.  It may be a tint of its own on white. */
static int
colour_at (int x, int y, const uint8_t (*colour)[3], int n, double opacity)
{
  uint32_t label = seed_of[y * WIDTH + x];
  int      least = 3 * 256, found = -1;

  for (int k = 0; k < n && label; k++)
    {
      const uint8_t *c = palette.item[label - 1].colour;
      int            distance = 0;

      for (int i = 0; i < 3; i++)
        distance += abs (c[i] - (int) (255 - opacity * (255 - colour[k][i])));
      if (distance < least)
        {
          least = distance;
          found = k;
        }
    }
  return found;
}

/* Three strokes of any brush, two of which cross the first: each is a label on both sides of a crossing, and the
 * mixtures there are none. */
static void
brushes_that_cross (void)
{
  static const double  brush[][3] = { { 0.3, 0.5, 8 }, { 0.5, 0, 12 }, { 0.5, 0.5, 10 }, { 0.6, 0.75, 6 },
                                      { 0.8, 0.3, 8 }, { 1, 0, 10 }, { 1, 0.5, 12 } }; /* opacity, hardness, radius */
  static const uint8_t colour[3][3] = { { 220, 20, 30 }, { 40, 170, 60 }, { 150, 60, 230 } };
  static const int     point[][3] = { { 50, 150, 0 }, { 200, 150, 0 }, { 350, 150, 0 }, { 105, 60, 1 }, { 135, 240, 1 },
                                      { 296, 60, 2 }, { 272, 240, 2 } };

  for (size_t b = 0; b < sizeof brush / sizeof *brush; b++)
    for (int white = 0; white < 2; white++)
      {
        double opacity = brush[b][0], hardness = brush[b][1], radius = brush[b][2];

        clear_paint (white);
        spray (20, 150, 380, 150, radius, hardness, opacity, colour[0]);
        spray (95, 30, 145, 270, radius, hardness, opacity, colour[1]);
        spray (300, 30, 268, 270, radius, hardness, opacity, colour[2]);
        CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
        NEAR (palette.n, 3, 0);
        for (size_t i = 0; i < sizeof point / sizeof *point; i++)
          NEAR (colour_at (point[i][0], point[i][1], colour, 3, white ? opacity : 1), point[i][2], 0);
      }
}

/* Soft strokes on white with the slight noise that a JPEG of high quality leaves: each is one label. */
static void
soft_strokes_with_slight_noise (void)
{
  static const uint8_t colour[3][3] = { { 220, 20, 30 }, { 40, 170, 60 }, { 30, 60, 220 } };
  uint32_t             seed = 3;

  clear_paint (true);
  for (int k = 0; k < 3; k++)
    spray (30, 60 + 80 * k, 370, 75 + 80 * k, 9, 0.3, 0.8, colour[k]);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    for (int k = 0; k < 3; k++)
      {
        int v = paint_of[4 * i + k] + (int) check_random (&seed, 4) - 1;

        if (memcmp (paint_of + 4 * i, (uint8_t[3]) { 255, 255, 255 }, 3))
          paint_of[4 * i + k] = (uint8_t) (v < 0 ? 0 : v > 255 ? 255 : v);
      }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
  NEAR (palette.n, 3, 0);
}

/* A short flat stroke in the very mixture of two others, which it touches, is a label: mixtures of opaque strokes are
 * nowhere flat, and those of translucent ones stronger than this. */
static void
a_flat_mixture_is_a_label (void)
{
  const uint8_t purple[3] = { 115, 45, 130 };

  for (int white = 0; white < 2; white++)
    {
      clear_paint (white);
      block (40, 100, 60, 12, red);
      block (100, 100, 14, 12, purple);
      block (114, 100, 60, 12, blue);
      stroke (300, 60, 340, 240, 6, 2, green);
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 4 && in_palette (purple, 0));
    }
}

/* A grey label next to black strokes on white: the rims of black are as grey, but no label. */
static void
rims_of_another_label (void)
{
  const uint8_t black[3] = { 0, 0, 0 }, grey[3] = { 128, 128, 128 };
  uint32_t      label;

  clear_paint (true);
  stroke (40, 40, 300, 77, 6, 1, black);
  stroke (40, 200, 300, 237, 6, 1, grey);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2 && in_palette (black, 0) && in_palette (grey, 0));
  label = seed_of[200 * WIDTH + 40];
  for (int i = 0; i < WIDTH * 150; i++)
    CHECK (seed_of[i] != label);
}

/* Lines of less than two pixels on opaque paper have hardly a pixel of their colour. */
static void
thin_lines_on_paper (void)
{
  clear_paint (true);
  stroke (40, 40, 300, 133, 0.2, 1, red);
  stroke (40, 200, 300, 233, 0.5, 1, blue);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2);
}

/* The loss of a JPEG: each channel shaken, more than near labels differ, and echoes beside the strokes. */
static void
lossy_paint (void)
{
  const uint8_t violet[3] = { 184, 73, 170 }, plum[3] = { 160, 73, 184 };
  uint32_t      seed = 9;
  size_t        right = 0;

  clear_paint (true);
  stroke (40, 40, 340, 60, 5, 1, red);
  stroke (40, 100, 340, 120, 5, 1, violet);
  stroke (40, 160, 340, 180, 5, 1, plum);
  stroke (40, 220, 340, 240, 5, 1, green);
  for (int i = 0; i < WIDTH * HEIGHT; i++)
    {
      int y = i / WIDTH % 60, strength = y > 25 && y < 75 ? 25 : 3;

      for (int k = 0; k < 3; k++)
        {
          int v = paint_of[4 * i + k] + (int) check_random (&seed, (uint32_t) strength) - strength / 2;

          paint_of[4 * i + k] = (uint8_t) (v < 0 ? 0 : v > 255 ? 255 : v);
        }
    }
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 4);
  CHECK (in_palette (red, 12) && in_palette (violet, 12) && in_palette (plum, 12) && in_palette (green, 12));
  for (int x = 60; x < 320; x++)
    right += seed_of[(100 + (x - 40) / 15) * WIDTH + x] != 0 &&
             seed_of[(100 + (x - 40) / 15) * WIDTH + x] != seed_of[(160 + (x - 40) / 15) * WIDTH + x];
  CHECK (right > 255);
}

/* Without alpha the commonest colour is none, but in a flat colouring it is a label. */
static void
flats_and_paper (void)
{
  clear_paint (true);
  block (100, 100, 60, 60, red);
  block (200, 100, 60, 60, green);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 2 && seed_of[0] == 0);
  settings.flats = true;
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 3 && seed_of[0] == 1);
  CHECK (palette.item[0].colour[0] == 255 && palette.item[0].seeds == WIDTH * HEIGHT - 7200);
}

/* A row of pixels with these three opacities, 200 each. */
static void
row_of_opacities (int first, int second, int third)
{
  clear_paint (false);
  for (int i = 0; i < 3 * 120; i++)
    memcpy (paint_of + 4 * (10 * WIDTH + i),
            (uint8_t[4]) { 9, 99, 199, (uint8_t) (i < 120 ? first : i < 240 ? second : third) }, 4);
}

/* Paint that is half opaque is a stroke, and so is, where there are faint strokes, what has a third of the opacity of
 * the strongest paint that it touches; what an eraser left is none. */
static void
faint_strokes (void)
{
  static const struct { int opacity[3]; bool painted[3]; } row[] = {
    { { 128, 0, 127 }, { true, false, true } },  { { 60, 0, 240 }, { true, false, true } },
    { { 40, 0, 240 }, { false, false, true } },  { { 79, 80, 240 }, { false, true, true } },
    { { 20, 60, 160 }, { false, true, true } },
  };

  for (size_t k = 0; k < sizeof row / sizeof *row; k++)
    {
      const int *o = row[k].opacity;

      row_of_opacities (o[0], o[1], o[2]);
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 1);
      for (int i = 0; i < 3; i++)
        CHECK ((seed_of[10 * WIDTH + 120 * i + 60] != 0) == row[k].painted[i]);
    }
  clear_paint (false);
}

static void
sizes (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 40 }, { 40, 1 }, { 2, 2 }, { 7, 5 } };
  CeldLabels       seeds = { WIDTH - 1, HEIGHT, WIDTH, seed_of };
  CeldPaint        paint = { WIDTH, HEIGHT, WIDTH, paint_of };

  clear_paint (false);
  CHECK (read_size (WIDTH, HEIGHT) == CELD_OK && palette.n == 0);
  CHECK (celd_scribbles_read (&paint, &settings, NULL, &seeds, &palette) == CELD_BAD_SIZE);
  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    {
      clear_paint (true);
      memset (seed_of, 7, sizeof seed_of);
      settings.flats = true;
      CHECK (read_size (size[k][0], size[k][1]) == CELD_OK);
      CHECK (palette.n == (size[k][0] * size[k][1] >= 4) && seed_of[size[k][0]] == 0x07070707);
    }
}

/* Hard strokes that cover each other: each colour that shows in four pixels or more is a label, with just these. */
static void
remains_of_hard_strokes (void)
{
  uint32_t r = 5;

  for (int round = 0; round < 40; round++)
    {
      size_t shown[8] = { 0 };

      clear_paint (false);
      for (int k = 0; k < 40; k++)
        {
          int x0 = (int) check_random (&r, 60), y0 = (int) check_random (&r, 40), of = (int) check_random (&r, 8);
          int w = 1 + (int) check_random (&r, 12), h = 1 + (int) check_random (&r, 12);

          for (int i = 0; i < w * h; i++)
            lay (x0 + i % w, y0 + i / w, (uint8_t[3]) { of & 1 ? 255 : 0, of & 2 ? 255 : 0, of & 4 ? 255 : 0 }, 1);
        }
      for (int p = 0; p < WIDTH * HEIGHT; p++)
        if (paint_of[4 * p + 3])
          shown[!!paint_of[4 * p] + 2 * !!paint_of[4 * p + 1] + 4 * !!paint_of[4 * p + 2]]++;
      CHECK (read_size (WIDTH, HEIGHT) == CELD_OK);
      for (int of = 0; of < 8; of++)
        if (shown[of] >= 4)
          {
            uint8_t  colour[3] = { of & 1 ? 255 : 0, of & 2 ? 255 : 0, of & 4 ? 255 : 0 };
            uint32_t label = celd_palette_find (&palette, colour);

            CHECK (label && palette.item[label - 1].seeds >= shown[of]);
          }
    }
}

int
main (void)
{
  RUN (exact_colours);
  RUN (tiny_strokes);
  RUN (strokes_of_one_pixel);
  RUN (two_hundred_labels);
  RUN (soft_overlaps);
  RUN (translucent_overlaps);
  RUN (brushes_that_cross);
  RUN (soft_strokes_with_slight_noise);
  RUN (a_flat_mixture_is_a_label);
  RUN (rims_of_another_label);
  RUN (thin_lines_on_paper);
  RUN (lossy_paint);
  RUN (flats_and_paper);
  RUN (faint_strokes);
  RUN (remains_of_hard_strokes);
  RUN (sizes);
  celd_palette_clear (&palette);
  return DONE;
}
