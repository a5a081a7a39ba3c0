/* Lines of coloured drawings: fills of all kinds vanish, lines of all kinds stay.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "discs.h"

static void
fills_are_paper (void)
{
  draw (white, yellow, blue, brown);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  CHECK (worst () < 0.35f); /* antialiased pixels: between two fills a line's share of a pixel is not known exactly */
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (line_at (x, y) <= 0 || line_at (x, y) >= 1)
        NEAR (luma_of[y * SIDE + x], 1 - line_at (x, y), 0.02);
}

/* Lines in the colours of fills elsewhere, and those that differ from the fills in one channel only. */
static void
lines_have_any_colour (void)
{
  draw (white, yellow, pink, (Tone) { 0.75f, 0.1f, 0.1f });
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && worst () < 0.35f);
  draw (yellow, pink, yellow, (Tone) { 1, 0.7f, 0 });
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  CHECK (luma_of[100 * SIDE + 30] < 0.05f && luma_of[100 * SIDE + 170] < 0.05f);
  CHECK (luma_of[100 * SIDE + 50] > 0.95f && luma_of[100 * SIDE + 150] > 0.95f);
}

/* Bright lines over strong fills: each is darker than some of these and lighter than others. */
static void
lines_may_be_bright (void)
{
  const Tone line[] = { { 0, 0, 0.8f }, { 0.8f, 0, 0 }, { 0.8f, 0.4f, 0 } }, page = { 0.93f, 0.96f, 1 };
  const Tone green = { 0.29f, 0.58f, 0.13f }, navy = { 0.19f, 0.14f, 0.65f }, crimson = { 0.56f, 0.12f, 0.39f };

  for (int i = 0; i < 3; i++)
    {
      int wrong = 0;

      draw (page, green, crimson, line[i]);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            int stripe = y - 4 - x / 25;

            if (stripe >= 0 && stripe < 35)
              put (x, y, stripe % 15 < 5 ? line[i] : stripe / 15 ? green : navy);
          }
      CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
      for (int y = 4; y < 39; y++)
        for (int x = 0; x < SIDE; x++)
          {
            int from_line = (y - 4) % 15; /* two pixels of a fill may be taken for the edge of a line */

            if (from_line < 5 || (from_line >= 7 && from_line < 13))
              wrong += (luma_of[(y + x / 25) * SIDE + x] < 0.5f) != (from_line < 5);
          }
      for (int y = 70; y < 130; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float left = fabsf (hypotf ((float) x - 75, (float) y - 100) - 45);
            float right = fabsf (hypotf ((float) x - 125, (float) y - 100) - 45);

            if (right < 1 || (x < 75 && left < 1) || (left > 6 && right > 6))
              wrong += (luma_of[y * SIDE + x] < 0.5f) != (fminf (left, right) < 1);
          }
      CHECK (wrong == 0);
    }
}

static void
lines_may_be_lighter (void)
{
  draw ((Tone) { 0.1f, 0.1f, 0.2f }, (Tone) { 0.4f, 0.1f, 0.1f }, (Tone) { 0, 0.3f, 0.15f }, (Tone) { 1, 1, 0.8f });
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && worst () < 0.35f);
}

/* A stroke three times as wide as the others is ink, an area in their colour paper with the same outline. */
static void
thick_strokes_are_lines_and_areas_are_not (void)
{
  draw (white, yellow, blue, brown);
  for (int y = 5; y < 20; y++)
    for (int x = 20; x < 180; x++)
      put (x, y, brown);
  for (int y = 150; y < 200; y++)
    for (int x = 20; x < 180; x++)
      put (x, y, brown);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  CHECK (luma_of[12 * SIDE + 100] < 0.05f && luma_of[175 * SIDE + 100] > 0.95f);
}

/* The page's label, 1, spreads over what is lighter than ink from its corner on. */
static void
flood_page (uint8_t *label)
{
  bool more = true;

  memset (label, 0, SIDE * SIDE);
  label[0] = 1;
  while (more)
    {
      more = false;
      for (int turn = 0; turn < 2; turn++)
        for (int k = 0; k < SIDE * SIDE; k++)
          {
            int  i = turn ? SIDE * SIDE - 1 - k : k, x = i % SIDE, y = i / SIDE;
            bool beside = (x > 0 && label[i - 1]) || (x < SIDE - 1 && label[i + 1]) || (y > 0 && label[i - SIDE]) ||
                          (y < SIDE - 1 && label[i + SIDE]);

            if (!label[i] && beside && luma_of[i] >= 0.5f)
              label[i] = more = true;
          }
    }
}

/* A disc in the colour of lines, on which the line of another one ends, and a bar on it that would be a thick stroke. */
static void
solid_areas_are_closed_and_whole (void)
{
  static uint8_t label[SIDE * SIDE];

  draw (white, yellow, brown, brown);
  for (int y = 20; y < 90; y++)
    for (int x = 118; x < 132; x++)
      put (x, y, brown);
  for (int y = 160; y < 190; y++)
    for (int x = 20; x < 60; x++)
      put (x, y, y >= 163 && y < 187 && x >= 23 && x < 57 ? blue : brown);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  flood_page (label);
  CHECK (label[5 * SIDE + 100] && !label[100 * SIDE + 125] && !label[100 * SIDE + 50] && !label[175 * SIDE + 40]);
  for (int y = 25; y < 100; y++)
    CHECK (luma_of[y * SIDE + 125] >= 0.95f && !label[y * SIDE + 125]);
}

/* How far a place is from the nearest of three broad lines that cross at the middle. */
static float
from_crossing (float x, float y)
{
  return fminf (from_line (x, y, 100, 0, 100, 200), fminf (from_line (x, y, 0, 130, 200, 70),
                                                           from_line (x, y, 0, 80, 200, 120)));
}

/* Where broad lines cross they are wider than the windows that find them, and of the dark fills beside them each is as
 * dark as lines in some channel, or darker. */
static void
dark_fills_hide_no_crossing (void)
{
  static const Tone left = { 0.67f, 0.21f, 0.18f }, right = { 0.19f, 0.14f, 0.65f };
  int               paper_in_line = 0, ink_beside = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (x, y, mixed (x < 100 ? left : right, brown,
                        fminf (fmaxf (6.5f - from_crossing ((float) x + 0.5f, (float) y + 0.5f), 0), 1)));
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        float away = from_crossing ((float) x + 0.5f, (float) y + 0.5f);

        paper_in_line += away < 5 && luma_of[y * SIDE + x] > 0.5f;
        ink_beside += away > 8 && luma_of[y * SIDE + x] < 0.5f;
      }
  CHECK (!paper_in_line && !ink_beside);
}

/* A ring 16 pixels wide among thin lines: antialiased pixels along its slanting edges are no area of its colour. */
static void
slanting_edges_are_no_areas (void)
{
  static const Tone red = { 0.725f, 0.145f, 0.345f };
  int               paper_in_line = 0;

  for (float radius = 50; radius < 51; radius += 0.0625f)
    {
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float r = hypotf ((float) x - 69.5f, (float) y - 99.5f), off = fabsf (r - radius) - 8;

            if (x < 140)
              put (x, y, mixed (r < radius ? red : white, brown, fminf (fmaxf (0.5f - off, 0), 1)));
            else
              put (x, y, (x - 140) % 12 < 2 ? brown : white);
          }
      CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < 130; x++)
          paper_in_line += fabsf (hypotf ((float) x - 69.5f, (float) y - 99.5f) - radius) < 6 &&
                           luma_of[y * SIDE + x] > 0.5f;
    }
  CHECK (!paper_in_line);
}

/* Most lines are grey, and one is black on white: its antialiased edges are grey, too, but its middle is no fill between
 * these. */
static void
lines_have_several_colours (void)
{
  static const Tone grey = { 0.5f, 0.5f, 0.5f }, black = { 0.02f, 0.02f, 0.02f };
  int               paper_in_line = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        float off = from_line ((float) x + 0.5f, (float) y + 0.5f, 155, 0, 125, 200);

        if (x < 100)
          put (x, y, x % 30 < 6 ? grey : yellow);
        else
          put (x, y, mixed (white, black, fminf (fmaxf (3.5f - off, 0), 1)));
      }
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  for (int y = 10; y < SIDE - 10; y++)
    for (int x = 110; x < SIDE; x++)
      paper_in_line += from_line ((float) x + 0.5f, (float) y + 0.5f, 155, 0, 125, 200) < 2 &&
                       luma_of[y * SIDE + x] > 0.5f;
  CHECK (!paper_in_line);
}

/* The tips of a diamond fit into the window by which lines are found, as there is a wide line too; a bar nearly in the
 * colour of lines fits into that for thick strokes. */
static void
narrow_fills_are_no_lines (void)
{
  const Tone dark = { 0.3f, 0.16f, 0.13f };

  draw (white, white, white, white);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        float diamond = 25 - 0.3f * fabsf ((float) x - 99.5f) - fabsf ((float) y - 39.5f);

        if (diamond > 0)
          put (x, y, diamond < 4 ? brown : blue);
        if (y >= 80 && y < 90 && x >= 10 && x < 190)
          put (x, y, brown);
        if (y >= 110 && y < 132 && x >= 10 && x < 190)
          put (x, y, y >= 114 && y < 128 && x >= 14 && x < 186 ? dark : brown);
        if (y >= 160 && y < 164)
          put (x, y, brown);
      }
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  for (int x = 40; x < 160; x++)
    CHECK (luma_of[39 * SIDE + x] > 0.95f);
  for (int x = 20; x < 180; x++)
    {
      CHECK (luma_of[85 * SIDE + x] < 0.05f && luma_of[162 * SIDE + x] < 0.05f);
      CHECK (luma_of[112 * SIDE + x] < 0.05f && luma_of[121 * SIDE + x] > 0.95f && luma_of[130 * SIDE + x] < 0.05f);
    }
}

/* Fills that become wide between two lines: nothing crosses them where they have the width of the window. */
static void
wedges_have_no_cross_lines (void)
{
  static const Tone dark = { 0.12f, 0.3f, 0.67f }, teal = { 0.15f, 0.5f, 0.55f }, page = { 0.93f, 0.96f, 1 };

  for (int slope = 8; slope <= 40; slope += 4)
    {
      int stains = 0;

      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            float half = 0.01f * (float) slope * (float) (x - 5), from = (float) y - 100.3f;
            float line = fminf (fabsf (from - half), fabsf (from + half));
            Tone  fill = from < -fabsf (half) ? teal : from > fabsf (half) ? page : x < 5 ? teal : dark;

            put (x, y, mixed (fill, brown, fminf (fmaxf (0.5f * BREADTH + 0.5f - line, 0), 1)));
          }
      CHECK (find (CELD_INK_LINES, NULL) == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        for (int x = 15; x < SIDE - 15; x++)
          stains += fabsf ((float) y - 100.3f) < 0.01f * (float) slope * (float) (x - 5) - 5 &&
                    luma_of[y * SIDE + x] < 0.95f;
      CHECK (stains == 0);
    }
}

/* A line in a lighter colour than those on both of its sides. */
static void
pale_lines_stay_between_dark_ones (void)
{
  draw (white, yellow, blue, white);
  for (int y = 20; y < 40; y++)
    for (int x = 20; x < 180; x++)
      put (x, y, y < 24 || y >= 36 ? brown : y >= 28 && y < 32 ? (Tone) { 0.8f, 0.5f, 0.4f } : white);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  for (int x = 30; x < 170; x++)
    CHECK (luma_of[22 * SIDE + x] < 0.05f && luma_of[30 * SIDE + x] < 0.6f && luma_of[26 * SIDE + x] > 0.95f);
}

/* Icons have lines a tenth of the page wide: all of them, so that they are no thick strokes among thinner ones. */
static void
broad_lines_are_lines (void)
{
  enum { WIDE = 512, LINE = 45 };
  uint8_t    *rgba = malloc (WIDE * WIDE * 4);
  float      *luma = malloc (WIDE * WIDE * sizeof *luma);
  CeldDrawing drawing = { .luma = { WIDE, WIDE, WIDE, luma } };
  static const uint8_t fill[][3] = { { 237, 245, 255 }, { 110, 165, 130 }, { 190, 80, 130 } }, dark[] = { 64, 31, 20 };
  int         wrong = 0;

  for (int turn = 0; turn < 2; turn++) /* first drawn, then compared */
    {
      if (turn)
        CHECK (celd_coloured_lines (&(CeldPaint) { WIDE, WIDE, WIDE, rgba }, CELD_INK_LINES, NULL, &drawing) == CELD_OK);
      for (int y = 0; y < WIDE; y++)
        for (int x = 0; x < WIDE; x++)
          {
            int  u = abs (x - WIDE / 2), v = abs (y - WIDE / 2), out = u > v ? u : v, i = y * WIDE + x;
            bool line = out <= 200 && (out > 200 - LINE || u <= LINE / 2);

            if (turn)
              wrong += line != (luma[i] < 0.5f);
            else
              memcpy (rgba + 4 * i, line ? dark : fill[out > 200 ? 0 : x < WIDE / 2 ? 1 : 2], 3);
            if (!turn)
              rgba[4 * i + 3] = 255;
          }
    }
  CHECK (wrong == 0);
  free (rgba);
  free (luma);
}

static void
grain_makes_no_lines (void)
{
  uint32_t state = 1;

  draw (white, yellow, blue, brown);
  for (int i = 0; i < SIDE * SIDE * 4; i++)
    {
      state = state * 1664525 + 1013904223;
      if (i % 4 < 3)
        art_of[i] = (uint8_t) fminf (fmaxf ((float) art_of[i] + (float) (int) (state >> 24) / 16 - 8, 0), 255);
    }
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK);
  for (int y = 4; y < SIDE - 4; y++)
    for (int x = 4; x < SIDE - 4; x++)
      if (fminf (line_at (x - 1, y), line_at (x + 1, y)) >= 1 && fminf (line_at (x, y - 1), line_at (x, y + 1)) >= 1)
        CHECK (luma_of[y * SIDE + x] < 0.25f);
      else if (fmaxf (line_at (x - 4, y), line_at (x + 4, y)) <= 0 && fmaxf (line_at (x, y - 4), line_at (x, y + 4)) <= 0)
        CHECK (luma_of[y * SIDE + x] > 0.85f);
}

static void
transparent_is_white (void)
{
  draw (white, yellow, blue, brown);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (!inside (x, y, 75, 100, 50) && !inside (x, y, 125, 100, 50))
        memset (art_of + 4 * (y * SIDE + x), 0, 4);
  CHECK (find (CELD_INK_AUTO, NULL) == CELD_OK && worst () < 0.35f);
  for (int i = 0; i < SIDE * SIDE; i++)
    CHECK (alpha_of[i] >= 1);
}

/* Grey fills are found when the artist asks for it, and nothing is found where there is nothing. */
static void
by_request (void)
{
  const Tone light = { 0.8f, 0.8f, 0.8f }, dark = { 0.5f, 0.5f, 0.5f };

  draw (white, light, dark, (Tone) { 0, 0, 0 });
  CHECK (find (CELD_INK_LINES, NULL) == CELD_OK && worst () < 0.35f);
  draw (blue, blue, blue, blue);
  CHECK (find (CELD_INK_LINES, NULL) == CELD_OK);
  for (int i = 0; i < SIDE * SIDE; i++)
    CHECK (luma_of[i] >= 1);
}

static void
bad_input (void)
{
  CeldPaint   art = { SIDE, SIDE, SIDE, art_of };
  CeldDrawing small = { .luma = { SIDE, SIDE - 1, SIDE, luma_of } };
  CeldHost    host = { .progress = check_refuse };
  uint8_t     pixel[4] = { 10, 200, 30, 255 };
  float       luma = 0.25f;
  CeldPaint   one = { 1, 1, 1, pixel };
  CeldDrawing point = { .luma = { 1, 1, 1, &luma } };

  CHECK (celd_coloured_lines (&art, CELD_INK_LINES, NULL, &small) == CELD_BAD_SIZE);
  draw (white, yellow, blue, brown);
  CHECK (find (CELD_INK_AUTO, &host) == CELD_CANCELLED);
  CHECK (celd_coloured_lines (&one, CELD_INK_LINES, NULL, &point) == CELD_OK && luma >= 1);
}

int
main (void)
{
  RUN (fills_are_paper);
  RUN (lines_have_any_colour);
  RUN (lines_may_be_bright);
  RUN (lines_may_be_lighter);
  RUN (thick_strokes_are_lines_and_areas_are_not);
  RUN (solid_areas_are_closed_and_whole);
  RUN (dark_fills_hide_no_crossing);
  RUN (slanting_edges_are_no_areas);
  RUN (lines_have_several_colours);
  RUN (narrow_fills_are_no_lines);
  RUN (wedges_have_no_cross_lines);
  RUN (pale_lines_stay_between_dark_ones);
  RUN (broad_lines_are_lines);
  RUN (grain_makes_no_lines);
  RUN (transparent_is_white);
  RUN (by_request);
  RUN (bad_input);
  return DONE;
}
