/* Arrowheads at all angles, of all sizes and tempers, and strokes that look like them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "draw-arrows.h"

static void
heads_at_all_angles (void)
{
  for (int degrees = 0; degrees < 360; degrees += 9)
    {
      Arrow open = straight (degrees, 4, OPEN, 16), filled = straight (degrees, 4, FILLED, 16);

      CHECK (judge_arrow (&open, 100, CELD_ARROW_HEAD, false) == 1);
      CHECK (judge_arrow (&filled, 100, CELD_ARROW_HEAD, false) == 1);
    }
}

static void
heads_of_all_kinds (void)
{
  uint32_t state = 11;
  int      right = 0, n = 300;

  for (int i = 0; i < n; i++)
    {
      double width = random_between (&state, 2, 12), least = fmax (20, 6 * width);
      double length = i % 3 ? least : random_between (&state, least, 120);
      double head = fmin (fmax (6, 3.5 * width), 0.55 * length);
      double angle = random_between (&state, 0, 6.28);
      Point  tail = { 90 - 0.5 * length * cos (angle), 90 - 0.5 * length * sin (angle) };
      Arrow  a = arrow_at (tail, angle, length, width, random_between (&state, -0.7, 0.7), 0.1 * width,
                           i % 2 ? OPEN : FILLED, head);
      int    verdict = judge_arrow (&a, 180, CELD_ARROW_HEAD, false);

      CHECK (verdict >= 0); /* never wrong */
      right += verdict > 0;
    }
  CHECK (right >= 0.99 * n);
}

static void
pens_that_start_or_end_thin (void)
{
  for (int degrees = 0; degrees < 360; degrees += 15)
    {
      Arrow growing = straight (degrees, 3, FILLED, 20), ending = straight (degrees, 6, FILLED, 20);

      growing.last_width = 6;
      ending.last_width  = 3;
      CHECK (judge_arrow (&growing, 100, CELD_ARROW_HEAD, false) == 1);
      CHECK (judge_arrow (&ending, 100, CELD_ARROW_HEAD, false) == 1);
    }
}

/* Barbs that are nearly as long as the shaft. */
static void
long_barbs (void)
{
  int right = 0;

  for (int degrees = 0; degrees < 360; degrees += 15)
    {
      double angle = degrees * 0.0174532925;
      Arrow  a = arrow_at ((Point) { 50 - 13 * cos (angle), 50 - 13 * sin (angle) }, angle, 27, 3, 0, 0, OPEN, 20);
      int    verdict = judge_arrow (&a, 100, CELD_ARROW_HEAD, false);

      CHECK (verdict >= 0);
      right += verdict;
    }
  CHECK (right >= 22);
}

static void
without_direction (void)
{
  for (int degrees = 0; degrees < 360; degrees += 24)
    {
      Arrow     line = straight (degrees, 4, BARE, 0), bar = straight (degrees, 4, BAR, 12);
      Arrow     dot = straight (degrees, 4, DOT, 7);
      Arrow     there = straight (degrees, 4, OPEN, 14), back = straight (degrees + 180, 4, OPEN, 14);
      CeldPaint paint = blank (100, 100);
      Answer    answer;

      CHECK (judge_arrow (&line, 100, CELD_ARROW_HEAD, false) == 0);
      CHECK (judge_arrow (&bar, 100, CELD_ARROW_HEAD, false) == 0);
      CHECK (judge_arrow (&dot, 100, CELD_ARROW_HEAD, false) == 0); /* says the opposite in another style */
      draw_arrow (&paint, &there, GREEN);
      draw_arrow (&paint, &back, GREEN);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      CHECK (answer.relations.n == 0 && answer.problems.n == 1);
      forget (&answer);
      free (paint.data);
    }
}

/* Whatever is read of two, in one colour or in two, is one of them. */
static void
arrows_end_to_end (void)
{
  for (int degrees = 0; degrees < 180; degrees += 30)
    for (int coloured = 0; coloured < 2; coloured++)
      {
        Arrow     one = straight (degrees, 4, FILLED, 16);
        Arrow     two = arrow_at (one.tip, degrees * 0.0174532925 + 0.5, 50, 4, 0, 0, OPEN, 16);
        CeldPaint paint = blank (150, 150);
        Answer    answer;

        draw_arrow (&paint, &one, GREEN);
        draw_arrow (&paint, &two, coloured ? BLUE : GREEN);
        answer = read_paint (&paint, CELD_ARROW_HEAD);
        CHECK (answer.relations.n == (size_t) is_read (&answer, &one, CELD_ARROW_HEAD) +
                                     (size_t) is_read (&answer, &two, CELD_ARROW_HEAD));
        CHECK (answer.relations.n + answer.problems.n >= 1);
        forget (&answer);
        free (paint.data);
      }
}

int
main (void)
{
  RUN (heads_at_all_angles);
  RUN (heads_of_all_kinds);
  RUN (pens_that_start_or_end_thin);
  RUN (long_barbs);
  RUN (without_direction);
  RUN (arrows_end_to_end);
  return DONE;
}
