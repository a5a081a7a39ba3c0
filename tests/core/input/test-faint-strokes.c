/* Strokes too faint to be read are told; what is read, its rims, and what an eraser leaves are not.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "input/input.h"

#include <string.h>

enum { SIDE = 200, READ = 51 };

static uint8_t   rgba[4 * SIDE * SIDE];
static CeldPaint layer = { SIDE, SIDE, SIDE, rgba };

static void
bar (int left, int top, int width, int height, int alpha)
{
  for (int y = top; y < top + height; y++)
    for (int x = left; x < left + width; x++)
      memcpy (CELD_RGBA (&layer, x, y), (uint8_t[4]) { 200, 30, 40, (uint8_t) alpha }, 4);
}

/* The problems of the layer; places are checked to lie in paint of this alpha. */
static size_t
count (int alpha)
{
  CeldProblems problems = { 0 };
  size_t       n;

  CHECK (celd_faint_strokes_find (&layer, READ, &problems) == CELD_OK);
  n = problems.n;
  for (size_t i = 0; i < n; i++)
    CHECK (problems.item[i].kind == CELD_PROBLEM_STROKE_FAINT && problems.item[i].relation == CELD_NO_INDEX &&
           CELD_RGBA (&layer, problems.item[i].x, problems.item[i].y)[3] == alpha);
  celd_problems_clear (&problems);
  memset (rgba, 0, sizeof rgba);
  return n;
}

static void
what_is_told (void)
{
  CHECK (count (0) == 0);
  bar (20, 20, 60, 8, 30);
  bar (20, 120, 60, 8, 30);
  CHECK (count (30) == 2);
  bar (20, 20, 60, 8, READ);
  CHECK (count (0) == 0); /* read */
  bar (20, 20, 60, 8, READ - 1);
  CHECK (count (READ - 1) == 1);
  bar (20, 20, 60, 8, CELD_VISIBLE_ALPHA);
  CHECK (count (CELD_VISIBLE_ALPHA) == 1);
  bar (20, 20, 60, 8, CELD_VISIBLE_ALPHA - 1);
  CHECK (count (0) == 0); /* what an eraser leaves */
  bar (20, 20, 5, 5, 40);
  CHECK (count (0) == 0); /* a speck */
}

/* Rims, and faint strokes that touch one that is read, are a part of that. */
static void
beside_paint_that_is_read (void)
{
  bar (20, 20, 60, 12, 40);
  bar (22, 22, 56, 8, 255);
  CHECK (count (0) == 0);
  bar (20, 20, 60, 12, 255);
  bar (20, 32, 8, 100, 40);
  CHECK (count (0) == 0);
  bar (20, 20, 60, 12, 255);
  bar (20, 40, 60, 12, 40);
  CHECK (count (40) == 1);
}

/* The horizontal arrow with an open head at its right end that is drawn at (left, top). */
static void
draw_arrow (int left, int top, int alpha)
{
  bar (left, top, 80, 6, alpha);
  for (int k = 0; k < 22; k++)
    {
      bar (left + 74 - k, top - k, 6, 6, alpha);
      bar (left + 74 - k, top + k, 6, 6, alpha);
    }
}

static void
check_arrows (size_t n_relations, size_t n_faint)
{
  CeldRelations relations = { 0 };
  CeldProblems  problems = { 0 };

  CHECK (celd_arrows_read (&layer, CELD_ARROW_HEAD, NULL, &relations, &problems) == CELD_OK);
  CHECK (relations.n == n_relations && problems.n == n_faint);
  for (size_t i = 0; i < relations.n; i++)
    CHECK (relations.item[i].nearer.x < 30 && relations.item[i].farther.x > 90);
  for (size_t i = 0; i < problems.n; i++)
    CHECK (problems.item[i].kind == CELD_PROBLEM_STROKE_FAINT);
  celd_relations_clear (&relations);
  celd_problems_clear (&problems);
  memset (rgba, 0, sizeof rgba);
}

/* The brush may be translucent: the opacity of arrows is by the most opaque one. */
static void
translucent_arrows (void)
{
  for (int alpha = CELD_VISIBLE_ALPHA; alpha <= 255; alpha++)
    {
      draw_arrow (20, 60, alpha);
      check_arrows (1, 0);
    }
  draw_arrow (20, 60, 60);
  draw_arrow (20, 140, 90);
  check_arrows (2, 0);
  draw_arrow (20, 60, 60);
  draw_arrow (20, 140, 255);
  check_arrows (1, 1);
  draw_arrow (20, 60, CELD_VISIBLE_ALPHA - 1);
  check_arrows (0, 0);
}

int
main (void)
{
  RUN (what_is_told);
  RUN (beside_paint_that_is_read);
  RUN (translucent_arrows);
  return DONE;
}
