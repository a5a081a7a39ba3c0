/* The windows by which lines of coloured drawings are found: lines of all widths, darker and lighter than fills, beside
 * fills that are narrow or nearly as dark, and lines under a pixel wide.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "celdepth.h"

#include <string.h>

enum { SIDE = 480 };

typedef struct { uint8_t red, green, blue; } Tone;

/* A rectangle with a line along its inside. */
typedef struct { int left, top, right, bottom, line; Tone fill; } Part;

static const Tone page = { 237, 245, 255 }, brown = { 64, 31, 20 }, beige = { 230, 205, 165 }, sky = { 150, 190, 210 },
                  crimson = { 165, 36, 74 }, navy = { 77, 87, 150 }, purple = { 175, 50, 155 }, cyan = { 64, 217, 204 };

static uint8_t art_of[SIDE * SIDE * 4];
static float   luma_of[SIDE * SIDE];

static void
put (int x, int y, Tone tone, uint8_t invert)
{
  uint8_t rgba[4] = { tone.red ^ invert, tone.green ^ invert, tone.blue ^ invert, 255 };

  memcpy (art_of + 4 * (y * SIDE + x), rgba, sizeof rgba);
}

static Tone
mixed (Tone a, Tone b, float share)
{
  return (Tone) { (uint8_t) ((float) a.red + share * (float) (b.red - a.red) + 0.5f),
                  (uint8_t) ((float) a.green + share * (float) (b.green - a.green) + 0.5f),
                  (uint8_t) ((float) a.blue + share * (float) (b.blue - a.blue) + 0.5f) };
}

static CeldStatus
find (void)
{
  CeldPaint   art = { SIDE, SIDE, SIDE, art_of };
  CeldDrawing drawing = { .luma = { SIDE, SIDE, SIDE, luma_of } };

  for (int i = 0; i < SIDE * SIDE; i++)
    luma_of[i] = 0.5f;
  return celd_coloured_lines (&art, CELD_INK_LINES, NULL, &drawing);
}

/* Whether a pixel is on the line of the last of the parts that has it. */
static bool
is_line (const Part *part, int n, int x, int y, Tone *fill)
{
  bool line = false;

  *fill = page;
  for (int i = 0; i < n; i++)
    {
      const Part *p = &part[i];

      if (x < p->left || x >= p->right || y < p->top || y >= p->bottom)
        continue;
      line = x < p->left + p->line || x >= p->right - p->line || y < p->top + p->line || y >= p->bottom - p->line;
      *fill = p->fill;
    }
  return line;
}

/* Finds the lines of the parts, dark on light and then all colours inverted; returns how many pixels are wrong. */
static int
wrong_pixels (const Part *part, int n)
{
  int  wrong = 0;
  Tone fill;

  for (int invert = 0; invert < 256; invert += 255)
    {
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          put (x, y, is_line (part, n, x, y, &fill) ? brown : fill, (uint8_t) invert);
      CHECK (find () == CELD_OK);
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          wrong += (luma_of[y * SIDE + x] < 0.5f) != is_line (part, n, x, y, &fill);
    }
  return wrong;
}

static void
broad_lines_beside_thin_ones (void)
{
  const Part icon[] = { { 30, 40, 450, 340, 26, beige }, { 150, 110, 230, 190, 5, sky }, { 30, 350, 450, 460, 26, crimson } };

  CHECK (wrong_pixels (icon, 3) == 0);
}

static void
broad_lines_between_strong_colours (void)
{
  const Part icon[] = { { 30, 40, 450, 340, 26, crimson }, { 100, 20, 380, 240, 26, navy }, { 180, 70, 260, 150, 26, page }, { 180, 150, 260, 320, 26, crimson }, { 20, 350, 120, 470, 26, navy } };

  CHECK (wrong_pixels (icon, 5) == 0);
}

/* Lines of all widths, with fills that are ten times as wide and as narrow as lines. */
static void
lines_of_all_widths (void)
{
  for (int line = 2; line <= 28; line += 2)
    {
      const Part parts[] = { { 20, 20, 460, 460, line, beige }, { 20 + line, 100, 40 + 4 * line, 380, line, purple }, { 200, 60, 420, 300, line, cyan } };

      CHECK (wrong_pixels (parts, 3) == 0);
    }
}

/* A disc with a hairline on the page. */
static void
draw_ring (float radius, float width, Tone fill)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        float from  = hypotf ((float) (x - SIDE / 2), (float) (y - SIDE / 2)) - radius;
        float share = fminf (fmaxf (0.5f * width + 0.5f - fabsf (from), 0), width);

        put (x, y, mixed (mixed (fill, page, fminf (fmaxf (from + 0.5f, 0), 1)), brown, share), 0);
      }
}

/* At how many of 1024 angles there is no ink within a pixel of the ring. */
static int
gaps_in_ring (float radius)
{
  int gaps = 0;

  for (int k = 0; k < 1024; k++)
    {
      float angle = 6.2832f * (float) k / 1024, least = 1;

      for (int step = -2; step <= 2; step++)
        {
          float r = radius + 0.5f * (float) step;
          int   x = (int) (SIDE / 2 + r * cosf (angle) + 0.5f), y = (int) (SIDE / 2 + r * sinf (angle) + 0.5f);

          least = fminf (least, luma_of[y * SIDE + x]);
        }
      gaps += least >= 0.5f;
    }
  return gaps;
}

/* Lines under a pixel wide are paler where they lie between two rows of pixels, and all of them may be pale. */
static void
hairlines_are_whole (void)
{
  static const Tone fills[] = { { 95, 200, 137 }, { 100, 117, 175 }, { 198, 99, 164 } };

  for (int i = 0; i < 3; i++)
    for (int tenths = 4; tenths <= 10; tenths++)
      {
        draw_ring (180.3f, 0.1f * (float) tenths, fills[i]);
        CHECK (find () == CELD_OK);
        CHECK (gaps_in_ring (180.3f) <= 32);
      }
}

int
main (void)
{
  RUN (broad_lines_beside_thin_ones);
  RUN (broad_lines_between_strong_colours);
  RUN (lines_of_all_widths);
  RUN (hairlines_are_whole);
  return DONE;
}
