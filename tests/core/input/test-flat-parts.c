/* Flat parts without lines, told from drawings and strokes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

enum { SIDE = 240 };

static uint8_t rgba[4 * SIDE * SIDE];

static const uint8_t greys[4][3] = { { 0, 0, 0 }, { 90, 90, 90 }, { 170, 170, 170 }, { 255, 255, 255 } },
                     paper[4][3] = { { 255, 255, 255 }, { 190, 190, 190 }, { 120, 120, 120 }, { 60, 60, 60 } },
                     clear[4][3] = { { 230, 60, 40 }, { 40, 90, 220 }, { 60, 180, 70 }, { 240, 220, 60 } },
                     few[4][3] = { { 0, 0, 0 }, { 255, 255, 255 }, { 0, 0, 0 }, { 255, 255, 255 } };

/* Which of four parts: three boxes on a page. */
static int
part_at (int x, int y)
{
  return x < 20 || y < 20 || x >= 220 || y >= 220 ? 0 : x < 90 ? 1 : y < 110 ? 2 : 3;
}

/* Parts in these colours, with a soft line of this width between them; the page has an alpha. */
static CeldPaint
draw (const uint8_t colour[4][3], int line, int alpha)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        uint8_t *p = rgba + 4 * (y * SIDE + x);
        int      part = part_at (x, y);
        bool     drawn = line && x >= line && y >= line && part_at (x - line, y - line) != part;

        for (int k = 0; k < 3; k++)
          p[k] = drawn ? 10 : colour[part][k];
        p[3] = part || drawn ? 255 : (uint8_t) alpha;
      }
  return (CeldPaint) { SIDE, SIDE, SIDE, rgba };
}

static CeldFlatParts
parts (const uint8_t colour[4][3], int line, int alpha)
{
  CeldPaint paint = draw (colour, line, alpha);

  return celd_flat_parts (&paint);
}

static void
levels_and_regions (void)
{
  CHECK (parts (greys, 0, 255) == CELD_PARTS_LEVELS);
  CHECK (parts (clear, 0, 255) == CELD_PARTS_COLOURED && parts (clear, 0, 0) == CELD_PARTS_COLOURED);
  CHECK (parts (paper, 0, 255) == CELD_PARTS_COLOURED); /* no levels: the page is white, */
  CHECK (parts (greys, 0, 0) == CELD_PARTS_COLOURED);   /* or transparent */
}

/* Lines between parts make a drawing, also a coloured one and chalk; two tones may be a silhouette. */
static void
drawings (void)
{
  for (int line = 1; line <= 6; line++)
    CHECK (parts (clear, line, 255) == CELD_PARTS_NONE && parts (paper, line, 255) == CELD_PARTS_NONE);
  CHECK (parts (few, 0, 255) == CELD_PARTS_NONE);
}

/* What is added to the grey of a part. */
static int
gentle (int x, int y)
{
  return (x + y) / 20;
}

static int
steep (int x, int y)
{
  return (x + y) % 200 < 100 ? (x + y) % 100 : 100 - (x + y) % 100;
}

/* A narrow part. */
static int
strip (int x, int y)
{
  (void) y;
  return x >= 50 && x < 54 ? 60 : 0;
}

static int
grain (int x, int y)
{
  return (7 * x + 5 * y) % 31;
}

static CeldFlatParts
parts_with (int (*more) (int x, int y))
{
  CeldPaint paint = draw (greys, 0, 255);

  for (int i = 0; i < SIDE * SIDE; i++)
    for (int k = 0; k < 3 && part_at (i % SIDE, i / SIDE) == 1; k++)
      rgba[4 * i + k] = (uint8_t) (90 + more (i % SIDE, i / SIDE));
  return celd_flat_parts (&paint);
}

/* Depth changes a little from place to place; shading changes at each pixel, and grain much. */
static void
slopes_and_grain (void)
{
  CHECK (parts_with (gentle) == CELD_PARTS_LEVELS && parts_with (strip) == CELD_PARTS_LEVELS);
  CHECK (parts_with (steep) == CELD_PARTS_NONE && parts_with (grain) == CELD_PARTS_NONE);
}

/* Levels and regions leave no page; parts on a blank page, or on paper, may be strokes. */
static void
what_leaves_no_page (void)
{
  CeldPaint paint = draw (greys, 0, 255);

  CHECK (celd_is_painted_over (&paint));
  draw (clear, 0, 255);
  CHECK (celd_is_painted_over (&paint));
  draw (clear, 0, 0);
  CHECK (!celd_is_painted_over (&paint));
  draw (clear, 2, 255);
  CHECK (!celd_is_painted_over (&paint));
  for (int white = 0; white < 2; white++)
    {
      draw (clear, 0, 255);
      for (int i = 0; i < SIDE * SIDE; i++)
        for (int k = 0; k < 3; k++)
          if (part_at (i % SIDE, i / SIDE) < 2)
            rgba[4 * i + k] = white ? 250 : clear[0][k];
      CHECK (celd_flat_parts (&paint) == CELD_PARTS_COLOURED && celd_is_painted_over (&paint) == !white);
    }
}

int
main (void)
{
  RUN (levels_and_regions);
  RUN (drawings);
  RUN (slopes_and_grain);
  RUN (what_leaves_no_page);
  return DONE;
}
