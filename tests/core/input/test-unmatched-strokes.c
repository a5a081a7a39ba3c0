/* Layers of corrections of which nothing was read are told; blank ones, and those with some right strokes, are not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"

#include <string.h>

enum { SIDE = 100 };

static uint8_t    rgba[4 * SIDE * SIDE];
static uint32_t   number[SIDE * SIDE];
static CeldPaint  layer = { SIDE, SIDE, SIDE, rgba };
static CeldLabels labels = { SIDE, SIDE, SIDE, number };

/* A bar of a colour, from (20, 30) on, of which so many pixels have a label; the page is of a grey and an alpha. */
static void
paint (int page, int alpha, int area, int known)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      memcpy (rgba + 4 * i, (uint8_t[4]) { (uint8_t) page, (uint8_t) page, (uint8_t) page, (uint8_t) alpha }, 4);
      number[i] = 0;
    }
  for (int i = 0; i < area; i++)
    {
      int x = 20 + i % 50, y = 30 + i / 50;

      memcpy (CELD_RGBA (&layer, x, y), (uint8_t[4]) { 200, 30, 40, 255 }, 4);
      CELD_AT (&labels, x, y) = i < known;
    }
}

static bool
is_told (void)
{
  CeldProblems problems = { 0 };
  bool         told;

  CHECK (celd_unmatched_strokes_find (&layer, &labels, &problems) == CELD_OK);
  told = problems.n;
  if (told)
    CHECK (problems.n == 1 && problems.item[0].kind == CELD_PROBLEM_STROKE_UNMATCHED && problems.item[0].x == 20 &&
           problems.item[0].y == 30 && problems.item[0].relation == CELD_NO_INDEX);
  celd_problems_clear (&problems);
  return told;
}

static void
what_is_told (void)
{
  const struct { int page, alpha; } pages[] = { { 0, 0 }, { 255, 255 }, { 255, 0 } };

  for (size_t i = 0; i < sizeof pages / sizeof *pages; i++)
    {
      paint (pages[i].page, pages[i].alpha, 0, 0);
      CHECK (!is_told ());
      paint (pages[i].page, pages[i].alpha, 500, 0);
      CHECK (is_told ());
      paint (pages[i].page, pages[i].alpha, 500, 4); /* by chance */
      CHECK (is_told ());
      paint (pages[i].page, pages[i].alpha, 500, 5);
      CHECK (!is_told ());
    }
}

int
main (void)
{
  RUN (what_is_told);
  return DONE;
}
