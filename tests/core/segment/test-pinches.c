/* Regions that their own lines cut in two, in drawings with lines of one pixel: what is a pinch and what is none, and
 * that thin regions keep one label.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#include <math.h>

#define SIDE  72
#define FRAME 4

/* All pinches of a drawing. */
typedef struct { CeldPlane ink; CeldBasins basins; CeldPinch *pinch; size_t n; } Found;

/* Takes the ink over. */
static Found
find (CeldPlane ink)
{
  Found f = { .ink = ink };
  bool *wanted;

  CHECK (celd_basins_new (&f.ink, celd_settings ().ink_threshold, NULL, &f.basins) == CELD_OK);
  wanted = calloc (f.basins.n, sizeof *wanted);
  for (size_t k = 0; k < f.basins.n; k++)
    wanted[k] = true;
  CHECK (celd_pinches_find (&f.ink, &f.basins, wanted, &f.pinch, &f.n) == CELD_OK);
  free (wanted);
  return f;
}

static void
drop (Found *f)
{
  celd_basins_clear (&f->basins);
  celd_free (f->pinch);
  free (f->ink.data);
}

static uint32_t
part_at (const Found *f, int x, int y)
{
  return f->basins.component[celd_basin_at (&f->basins, x, y)];
}

/* The weakness of the pinch between the parts at two pixels; 0: there is none. */
static int64_t
pinch_between (const Found *f, int ax, int ay, int bx, int by)
{
  uint32_t a = part_at (f, ax, ay), b = part_at (f, bx, by);

  for (size_t i = 0; i < f->n; i++)
    {
      uint32_t p = f->basins.component[f->pinch[i].a], q = f->basins.component[f->pinch[i].b];

      if ((p == a && q == b) || (p == b && q == a))
        return f->pinch[i].weakness;
    }
  return 0;
}

static void
single_pixels_between_two_lines_are_joined (void)
{
  static const char *const strip[] = {
    ".#......",
    "#.#.....",
    ".#.#....",
    "..#.#...",
    "...#.#..",
    "....#.#.",
    ".....#.#",
    "......#.", NULL };
  Found f = find (art_plane (strip));

  for (int i = 1; i < 6; i++)
    CHECK (pinch_between (&f, i, i, i + 1, i + 1) == CELD_PINCH_CORNER);
  for (int i = 0; i < 8; i++)
    CHECK (!pinch_between (&f, i, i, 7, 0) && !pinch_between (&f, i, i, 0, 7));
  drop (&f);
}

static void
lines_that_are_one_over_some_pixels_part_again (void)
{
  static const char *const merged[] = {
    "..............",
    "####......####",
    "....#....#....",
    ".....####.....",
    "....#....#....",
    "####......####",
    "..............", NULL };
  static const char *const rung[] = {           /* a line that ends at a thick one, above and below */
    "......#.......",
    "......#.......",
    "####..#....###",
    "...#######....",
    "...#######....",
    "####..#....###",
    "......#.......",
    "......#.......", NULL };
  Found f = find (art_plane (merged));

  CHECK (pinch_between (&f, 0, 3, 13, 3) == CELD_PINCH_MERGED);
  CHECK (!pinch_between (&f, 0, 0, 0, 3) && !pinch_between (&f, 0, 6, 0, 3));
  CHECK (!pinch_between (&f, 0, 0, 13, 3) && !pinch_between (&f, 0, 0, 0, 6));
  drop (&f);
  f = find (art_plane (rung));
  NEAR (f.n, 0, 0);
  drop (&f);
}

/* Paper on both sides of it touches at each corner of its steps. */
static void
a_line_is_no_pinch (void)
{
  uint32_t state = 3;

  for (int round = 0; round < 60; round++)
    {
      int       y = (int) check_random (&state, SIDE), end = (int) check_random (&state, SIDE);
      CeldPlane ink;
      Found     f;

      CHECK (celd_plane_new (SIDE, SIDE, &ink) == CELD_OK);
      for (int p = 0; p < SIDE * SIDE; p++)
        ink.data[p] = 1;
      for (int x = 0; x < SIDE; x++)
        ink.data[(y + (end - y) * x / (SIDE - 1)) * SIDE + x] = 0;
      f = find (ink);
      NEAR (f.n, 0, 0);
      drop (&f);
    }
}

/* ------------------------------------------------------------------ labels */

/* A tail that tapers from six pixels to little more than one. */
typedef struct { double x, y, dx, dy, length; } Tail;

static bool
is_in_tail (const Tail *t, double x, double y)
{
  double along = ((x - t->x) * t->dx + (y - t->y) * t->dy) / t->length;
  double away = fabs ((y - t->y) * t->dx - (x - t->x) * t->dy);

  return along > 0 && along < 1 && away < 3 - 2.3 * along;
}

/* Its outline, in steps of a tenth of a pixel, as lines one pixel wide. */
static void
draw_tail (const Tail *t, CeldPlane *ink)
{
  for (double along = 0; along <= 1; along += 0.1 / t->length)
    for (int side = -1; side <= 1; side += 2)
      {
        double away = side * (3 - 2.3 * along);
        int    x = (int) (t->x + along * t->length * t->dx - away * t->dy);
        int    y = (int) (t->y + along * t->length * t->dy + away * t->dx);

        CELD_AT (ink, x, y) = 0;
      }
  for (double across = -1; across <= 1; across += 0.02)
    for (int end = 0; end <= 1; end++)
      {
        double away = across * (3 - 2.3 * end);

        CELD_AT (ink, (int) (t->x + end * t->length * t->dx - away * t->dy),
                 (int) (t->y + end * t->length * t->dy + away * t->dx)) = 0;
      }
}

/* A frame, so that what is beside the tail is not the background, and the tail. */
static void
draw_page (const Tail *t, CeldPlane *ink)
{
  for (int p = 0; p < SIDE * SIDE; p++)
    ink->data[p] = 1;
  for (int i = FRAME; i < SIDE - FRAME; i++)
    CELD_AT (ink, i, FRAME) = CELD_AT (ink, FRAME, i) = CELD_AT (ink, i, SIDE - 1 - FRAME) =
      CELD_AT (ink, SIDE - 1 - FRAME, i) = 0;
  draw_tail (t, ink);
}

/* Of the tail, paint is in the wide end alone.  Counts its paper, and what of that got another label. */
static void
paint_tail (const Tail *t, int *paper, int *wrong)
{
  CeldSettings settings = celd_settings ();
  CeldPalette  palette = { 0 };
  CeldProblems problems = { 0 };
  CeldPlane    ink;
  CeldLabels   seeds, labels;

  CHECK (celd_plane_new (SIDE, SIDE, &ink) == CELD_OK);
  CHECK (celd_labels_new (SIDE, SIDE, &seeds) == CELD_OK && celd_labels_new (SIDE, SIDE, &labels) == CELD_OK);
  draw_page (t, &ink);
  for (int p = 0; p < SIDE * SIDE; p++)
    seeds.data[p] = 0;
  palette.item = celd_alloc0 (3, sizeof *palette.item);
  palette.n    = 3;
  for (int k = 0; k < 3; k++)
    memcpy (palette.item[k].colour, (uint8_t[4]) { (uint8_t) (100 * k), 90, 40, 255 }, 4);
  for (int x = FRAME + 1; x < SIDE - FRAME - 1; x++)
    {
      CELD_AT (&seeds, x, FRAME + 1) = 1;
      CELD_AT (&seeds, x, 0)         = 3;
    }
  for (int i = 2; i < 7; i++)
    CELD_AT (&seeds, (int) (t->x + i * t->dx), (int) (t->y + i * t->dy)) = 2;
  CHECK (celd_segment (&ink, &seeds, NULL, &settings, NULL, &labels, &palette, &problems) == CELD_OK);
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (celd_is_paper (CELD_AT (&ink, x, y)) && is_in_tail (t, x + 0.5, y + 0.5))
        {
          ++*paper;
          *wrong += CELD_AT (&labels, x, y) != 2;
        }
  celd_palette_clear (&palette);
  celd_problems_clear (&problems);
  free (ink.data);
  free (seeds.data);
  free (labels.data);
}

static void
thin_tails_are_of_one_piece (void)
{
  uint32_t state = 11;
  int      paper = 0, wrong = 0;

  for (int round = 0; round < 100; round++)
    {
      double angle = 2 * CELD_PI * check_random (&state, 1000) / 1000;
      Tail   t = { SIDE / 2.0, SIDE / 2.0, cos (angle), sin (angle), 26 };

      paint_tail (&t, &paper, &wrong);
    }
  CHECK (paper > 5000);
  NEAR ((double) wrong / paper, 0, 0.005);
}

int
main (void)
{
  RUN (single_pixels_between_two_lines_are_joined);
  RUN (lines_that_are_one_over_some_pixels_part_again);
  RUN (a_line_is_no_pinch);
  RUN (thin_tails_are_of_one_piece);
  return DONE;
}
