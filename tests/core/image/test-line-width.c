/* The windows by which lines of coloured drawings are found: lines of all widths, darker and lighter than fills, beside
 * fills that are narrow or nearly as dark.
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

int
main (void)
{
  RUN (broad_lines_beside_thin_ones);
  RUN (broad_lines_between_strong_colours);
  RUN (lines_of_all_widths);
  return DONE;
}
