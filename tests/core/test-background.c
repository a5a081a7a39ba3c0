/* Who gets the paper along the frame.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "canvas.h"

/* Seeds after celd_background_seed; returns the number of the background's label, 0 if none is marked. */
static uint32_t
seed (Sketch *s, const char *const *wanted)
{
  uint32_t marked = 0;

  CHECK (celd_background_seed (NULL, &s->canvas) == CELD_OK);
  NEAR (seeds_differing (&s->canvas.seeds, wanted), 0, 0);
  for (size_t k = 0; k < s->canvas.palette.n; k++)
    if (s->canvas.palette.item[k].background)
      {
        CHECK (!marked);
        marked = (uint32_t) k + 1;
      }
  return marked;
}

static const char *const ring[] = { "1111111", "1#####1", "1#222#1", "1#222#1", "1#####1", "1111111", NULL };
static const char *const figure_only[] = { ".......", ".......", "...A...", "...A...", ".......", ".......", NULL };
static const char *const framed[] = { "BBBBBBB", "B.....B", "B..A..B", "B..A..B", "B.....B", "BBBBBBB", NULL };

static void
nobodys_frame_is_a_transparent_label_of_its_own (void)
{
  Sketch s;

  sketch_open (&s, ring, figure_only, 1);
  NEAR (seed (&s, framed), 2, 0);
  NEAR (s.canvas.palette.n, 2, 0);
  if (s.canvas.palette.n == 2)
    {
      CHECK (s.canvas.palette.item[1].origin == CELD_FROM_BACKGROUND && s.canvas.palette.item[1].hard);
      NEAR (s.canvas.palette.item[1].colour[3], 0, 0);
    }
  sketch_close (&s);
}

static void
a_painted_frame_stays_as_it_is (void)
{
  static const char *const painted[] = { ".......", ".......", "...A...", ".......", ".......", ".BB....", NULL };
  Sketch s;

  sketch_open (&s, ring, painted, 2);
  NEAR (seed (&s, painted), 2, 0);
  NEAR (s.canvas.palette.n, 2, 0);
  sketch_close (&s);
}

static void
the_settings_choose (void)
{
  Sketch s;

  sketch_open (&s, ring, figure_only, 1);
  s.settings.background = CELD_BACKGROUND_NONE;
  NEAR (seed (&s, figure_only), 0, 0);
  sketch_close (&s);

  sketch_open (&s, ring, figure_only, 2);
  s.settings.background = CELD_BACKGROUND_COLOUR;
  memcpy (s.settings.background_colour, s.canvas.palette.item[1].colour, 3);
  NEAR (seed (&s, framed), 2, 0);
  NEAR (s.canvas.palette.n, 2, 0);
  sketch_close (&s);

  sketch_open (&s, ring, figure_only, 1);
  s.settings.background = CELD_BACKGROUND_COLOUR;
  memset (s.settings.background_colour, 99, 3);
  NEAR (seed (&s, framed), 2, 0);
  NEAR (s.canvas.palette.n == 2 ? s.canvas.palette.item[1].colour[1] : 0, 99, 0);
  sketch_close (&s);
}

/* A holds most of the frame; the corner that the figure cuts off belongs to it as well. */
static void
a_corner_cut_off_joins_the_background (void)
{
  static const char *const paper[] = { "1111#22", "11111#2", "111111#", "1111111", NULL };
  static const char *const painted[] = { ".......", ".AA....", ".......", ".......", NULL };
  static const char *const wanted[] = { ".....AA", ".AA...A", ".......", ".......", NULL };
  Sketch s;

  sketch_open (&s, paper, painted, 1);
  NEAR (seed (&s, wanted), 1, 0);
  NEAR (s.canvas.palette.n, 1, 0);
  sketch_close (&s);
}

/* The frame cuts off a figure; with a fifth of the frame it is not the background. */
static void
a_figure_that_the_frame_cuts_off_is_not_the_background (void)
{
  static const char *const paper[] = { "11111111", "11111111", "1######1", "1#2222#1", NULL };
  static const char *const painted[] = { "........", "........", "........", "...A....", NULL };
  static const char *const wanted[] = { "BBBBBBBB", "B......B", "B......B", "B..A...B", NULL };
  Sketch s;

  sketch_open (&s, paper, painted, 1);
  NEAR (seed (&s, wanted), 2, 0);
  sketch_close (&s);
}

/* A runs on out of the figure.  A soft stroke is at home where most of it is, and loses what lies in nobody's room; an
 * obeyed one holds the frame. */
static void
a_stroke_that_runs_out_does_not_hold_the_frame (void)
{
  static const char *const paper[] = { "1111111", "11#####", "11#2222", "11#####", "1111111", NULL };
  static const char *const painted[] = { ".......", ".......", ".AAAAA.", ".......", ".......", NULL };
  static const char *const wanted[] = { "BBBBBBB", "B......", "B.AAAA.", "B......", "BBBBBBB", NULL };
  Sketch s;

  sketch_open (&s, paper, painted, 1);
  NEAR (seed (&s, wanted), 2, 0);
  sketch_close (&s);
  sketch_open (&s, paper, painted, 1);
  s.settings.hardness = 1;
  CHECK (celd_background_seed (NULL, &s.canvas) == CELD_OK);
  CHECK (s.canvas.palette.n == 1 && s.canvas.palette.item[0].background);
  sketch_close (&s);
}

/* A small room behind a gap goes to whom its piece goes, and gets no seeds. */
static void
behind_a_gap_the_piece_counts (void)
{
  static const char *const rooms[] = { "1111#22", "1111122", "1111#22", "1111111", NULL };
  static const char *const painted[] = { ".......", ".AA....", ".......", ".......", NULL };
  Sketch s;

  sketch_open (&s, rooms, painted, 1);
  s.basins.piece[1] = 1;
  NEAR (seed (&s, painted), 1, 0);
  sketch_close (&s);
}

int
main (void)
{
  RUN (nobodys_frame_is_a_transparent_label_of_its_own);
  RUN (a_painted_frame_stays_as_it_is);
  RUN (the_settings_choose);
  RUN (a_corner_cut_off_joins_the_background);
  RUN (a_figure_that_the_frame_cuts_off_is_not_the_background);
  RUN (a_stroke_that_runs_out_does_not_hold_the_frame);
  RUN (behind_a_gap_the_piece_counts);
  return DONE;
}
