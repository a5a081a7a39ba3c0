/* Where strokes lie, and which of their shares are stains.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "canvas.h"

static void
check_share (const CeldSpread *spread, size_t i, CeldShare wanted)
{
  const CeldShare *share = &spread->share[i];

  CHECK (share->piece == wanted.piece && share->label == wanted.label && share->stroke == wanted.stroke);
  NEAR (share->pixels, wanted.pixels, 0);
}

/* A runs through the contour and back, in runs that add up; paint on ink is no share.  B touches only by a corner. */
static void
shares_of_strokes (void)
{
  static const char *const paper[] = { "111#222", "111#222", "111#222", "111#222", NULL };
  static const char *const painted[] = { ".AAAAA.", ".....A.", ".AAAAAB", "B.....B", NULL };
  CeldSpread spread;
  Sketch     s;

  sketch_open (&s, paper, painted, 2);
  CHECK (celd_spread_new (&s.canvas, &s.canvas.pieces, NULL, &spread) == CELD_OK);
  NEAR (spread.n, 4, 0);
  if (spread.n == 4)
    {
      check_share (&spread, 0, (CeldShare) { 1, 1, 1, 4, false });
      check_share (&spread, 1, (CeldShare) { 1, 2, 3, 1, false });
      check_share (&spread, 2, (CeldShare) { 2, 1, 1, 5, false });
      check_share (&spread, 3, (CeldShare) { 2, 2, 2, 2, false });
      NEAR (spread.total[1], 9, 0);
      NEAR (spread.total[2], 2, 0);
      NEAR (spread.total[3], 1, 0);
    }
  celd_spread_clear (&spread);
  sketch_close (&s);
}

static void
pixels_that_touch_by_a_corner_are_one_stroke (void)
{
  static const char *const paper[] = { "111", "111", NULL }, *const painted[] = { "A.A", ".A.", NULL };
  CeldSpread spread;
  Sketch     s;

  sketch_open (&s, paper, painted, 1);
  CHECK (celd_spread_new (&s.canvas, &s.canvas.pieces, NULL, &spread) == CELD_OK);
  NEAR (spread.n, 1, 0);
  NEAR (spread.n ? spread.share[0].pixels : 0, 3, 0);
  celd_spread_clear (&spread);
  sketch_close (&s);
}

/* The seeds that are left of the painted ones. */
static void
check_left (const char *const *paper, const char *const *painted, float hardness, const char *const *left)
{
  Sketch s;

  sketch_open (&s, paper, painted, 2);
  s.settings.hardness = hardness;
  CHECK (celd_stains_remove (NULL, &s.canvas) == CELD_OK);
  NEAR (differing (&s.canvas.seeds, left), 0, 0);
  sketch_close (&s);
}

static const char *const halves[] = { "111111#2222", "111111#2222", NULL };

static void
paint_behind_a_contour_is_a_stain (void)
{
  static const char *const painted[] = { "AAAAAAAAA..", ".......BBBB", NULL };
  static const char *const left[] = { "AAAAAAA....", ".......BBBB", NULL };

  check_left (halves, painted, 0.05f, left);
  check_left (halves, painted, 1, painted);
}

static void
at_home_or_alone_paint_is_none (void)
{
  static const char *const within[] = { ".......A...", ".......BBBB", NULL };
  static const char *const alone[] = { "AAAAAAAA...", "...........", NULL };

  check_left (halves, within, 0.05f, within);
  check_left (halves, alone, 0.05f, alone);
}

/* A stroke with 2 of its 5 pixels elsewhere: 9 pixels of B do not outweigh the other 3, 10 do. */
static void
the_odds_of_a_stain (void)
{
  static const char *const paper[] = { "1#22222", "1#22222", "1#22222", NULL };
  static const char *const nine[] = { "AAAAA..", "A.BBBBB", "...BBBB", NULL };
  static const char *const ten[] = { "AAAAA..", "A.BBBBB", "..BBBBB", NULL };
  static const char *const left[] = { "AA.....", "A.BBBBB", "..BBBBB", NULL };

  check_left (paper, nine, 0.05f, nine);
  check_left (paper, ten, 0.05f, left);
}

int
main (void)
{
  RUN (shares_of_strokes);
  RUN (pixels_that_touch_by_a_corner_are_one_stroke);
  RUN (paint_behind_a_contour_is_a_stain);
  RUN (at_home_or_alone_paint_is_none);
  RUN (the_odds_of_a_stain);
  return DONE;
}
