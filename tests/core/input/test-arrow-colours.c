/* Arrows of different colours that share ends: each is read by its colour, or reported, and none wrongly.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

static void
several_that_leave (void)
{
  read_shared (FAN_OUT, 3, 120, COLOURS, 0.85);
}

static void
several_that_arrive (void)
{
  read_shared (FAN_IN, 3, 120, COLOURS, 0.95);
}

static void
head_to_tail (void)
{
  read_shared (CHAIN, 2, 120, COLOURS, 0.93);
}

static void
both_ways (void)
{
  read_shared (STAR, 4, 120, COLOURS, 0.93);
}

static void
side_by_side (void)
{
  read_shared (OVERLAP, 2, 120, COLOURS, 0);
}

static void
at_any_angles (void)
{
  read_at_any_angles (400, COLOURS, 0.88);
}

/* The line of a head lies on the tail of an arrow that leaves the same place. */
static void
tails_below_heads (void)
{
  uint32_t state = 9;
  int      all = 0;

  for (int i = 0; i < 600; i++)
    {
      double    angle = random_between (&state, 0, 6.28), w = random_between (&state, 3, 7), length = 15 * w;
      CeldPaint paint = blank (SIZE, SIZE);
      Arrow     below, above = spoke (angle, length, w, CELD_ARROW_HEAD, true, true);
      Answer    answer;
      size_t    found;

      angle += (i % 2 ? 0.55 : -0.55) + random_between (&state, -0.3, 0.3);
      below = spoke (angle, length, w * random_between (&state, 0.8, 1.3), CELD_ARROW_HEAD, false, true);
      draw_arrow (&paint, &below, COLOURS[0]);
      draw_arrow (&paint, &above, COLOURS[1]);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      found  = (size_t) is_read (&answer, &below, CELD_ARROW_HEAD) + is_read (&answer, &above, CELD_ARROW_HEAD);
      CHECK (answer.relations.n == found);
      all += (int) found;
      forget (&answer);
      free (paint.data);
    }
  CHECK (all >= 600);
}

/* Two of one colour whose tips meet, where another one begins; the dot of the second is below that of a fourth one, so
 * that they look like one from the first dot to there. */
static void
two_that_look_like_one (void)
{
  uint32_t state = 4;

  for (int i = 0; i < 150; i++)
    {
      Point     middle = { SIZE / 2., SIZE / 2. };
      double    angle = random_between (&state, 0, 6.28), turn = random_between (&state, -0.6, 0.6);
      double    w = random_between (&state, 3, 5), length = 12 * w;
      Arrow     a[4];
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;
      size_t    found;

      a[0] = through (middle, angle + 1.5, length, 1, w, CELD_ARROW_DOT, false);
      a[1] = arrow_at (middle, angle, length, w, 0, 0, DOT, 1.5 * w);
      a[2] = arrow_at (middle, angle + 3.1416 + turn, length, w, 0, 0, DOT, 1.5 * w);
      a[3] = through (a[2].tip, angle - 1.5, length, 1, 1.2 * w, CELD_ARROW_DOT, false);
      for (int k = 0; k < 4; k++)
        draw_arrow (&paint, &a[k], COLOURS[k < 2 ? k : k - 1]);
      answer = read_paint (&paint, CELD_ARROW_DOT);
      found  = count_read (&answer, a, 4, CELD_ARROW_DOT);
      CHECK (answer.relations.n == found);
      forget (&answer);
      free (paint.data);
    }
}

/* The dot of a broad arrow hides an end of another one.  Its bare end tells that its dot is there; or its dot, that its
 * bare end is. */
static void
one_end_is_enough (void)
{
  uint32_t state = 12;
  size_t   found = 0;

  for (int i = 0; i < 200; i++)
    {
      double    angle = random_between (&state, 0, 6.28), w = random_between (&state, 3, 6);
      CeldPaint paint = blank (SIZE, SIZE);
      Arrow     below = spoke (angle, 16 * w, w, CELD_ARROW_DOT, i % 2, false);
      Arrow     above = spoke (angle + random_between (&state, 1.5, 4.5), 20 * w, 1.6 * w, CELD_ARROW_DOT, false, false);
      Answer    answer;

      draw_arrow (&paint, &below, COLOURS[0]);
      draw_arrow (&paint, &above, COLOURS[1]);
      answer = read_paint (&paint, CELD_ARROW_DOT);
      CHECK (answer.relations.n == (size_t) is_read (&answer, &below, CELD_ARROW_DOT) +
                                     (size_t) is_read (&answer, &above, CELD_ARROW_DOT));
      found += answer.relations.n;
      forget (&answer);
      free (paint.data);
    }
  CHECK (found >= 360);
}

/* Two of one colour, head to tail, of which the first begins and the second ends below others: both end where others
 * do, but neither ends on the way of the other. */
static void
two_in_a_chain (void)
{
  uint32_t state = 6;
  size_t   found = 0;

  for (int i = 0; i < 200; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_HEAD : CELD_ARROW_DOT;
      double         angle = random_between (&state, 0, 6.28), w = random_between (&state, 3, 4.5), length = 14 * w;
      CeldPaint      paint = blank (SIZE, SIZE);
      Arrow          a[4] = { spoke (angle, length, w, style, true, false),
                              spoke (angle + 2.2, length, w, style, false, false) };
      Answer         answer;

      for (int k = 2; k < 4; k++)
        {
          double away = k == 2 ? angle : angle + 2.2;
          Point  end = { SIZE / 2. + length * cos (away), SIZE / 2. + length * sin (away) };

          a[k] = through (end, away + (k == 2 ? 1.9 : -1.9), length, 1, 1.3 * w, style, false);
        }
      for (int k = 3; k >= 0; k--) /* what is painted first hides what follows */
        draw_arrow (&paint, &a[k], COLOURS[k < 2 ? 0 : k - 1]);
      answer = read_paint (&paint, style);
      CHECK (answer.relations.n == count_read (&answer, a, 4, style));
      found += answer.relations.n;
      forget (&answer);
      free (paint.data);
    }
  CHECK (found >= 780);
}

/* A dot is so broad that what ends below it may end beside its middle. */
static void
ends_below_dots (void)
{
  for (int i = 0; i < 24; i++)
    {
      double    angle = 0.26 * i, w = 4, off = 2.65 * w;
      Point     middle = { SIZE / 2., SIZE / 2. };
      Point     end = { middle.x - off * sin (angle), middle.y + off * cos (angle) };
      Point     far = { middle.x + 80 * sin (angle), middle.y - 80 * cos (angle) };
      Arrow     above = arrow_at (far, angle + 1.5708, 80, 2 * w, 0, 0, DOT, 3.2 * w);
      Arrow     below = arrow_at (end, angle, 90, w, 0, 0, DOT, 1.6 * w);
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;

      draw_arrow (&paint, &above, COLOURS[0]);
      draw_arrow (&paint, &below, COLOURS[1]);
      answer = read_paint (&paint, CELD_ARROW_DOT);
      CHECK (answer.relations.n == (size_t) is_read (&answer, &above, CELD_ARROW_DOT) +
                                     (size_t) is_read (&answer, &below, CELD_ARROW_DOT));
      forget (&answer);
      free (paint.data);
    }
}

/* Edges on white paper are mixed with it: the lighter shades of one colour are not paint of another, near one. */
static void
near_hues_on_white (void)
{
  static const uint8_t near[4][3] = { { 120, 40, 160 }, { 200, 0, 120 }, { 230, 90, 0 }, { 150, 100, 20 } };
  uint32_t             state = 21;
  size_t               found = 0;

  for (int i = 0; i < 160; i++)
    {
      double    angle = random_between (&state, 0, 6.28);
      CeldPaint paint = blank (SIZE, SIZE);
      Arrow     a[4];
      Answer    answer;

      for (int k = 0; k < 4; k++)
        {
          double w = random_between (&state, 1.5, 4);

          a[k] = spoke (angle + 1.57 * k + random_between (&state, -0.4, 0.4), 80, w, CELD_ARROW_HEAD, false, k % 2);
          draw_arrow (&paint, &a[k], near[k]);
        }
      flatten (&paint, 255);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      CHECK (answer.relations.n == count_read (&answer, a, 4, CELD_ARROW_HEAD));
      found += answer.relations.n;
      forget (&answer);
      free (paint.data);
    }
  CHECK (found >= 600);
}

/* Each keeps its own colour, so that only the blue one cracks. */
static void
colours_stay (void)
{
  CeldPaint paint = blank (SIZE, SIZE);
  Arrow     a = spoke (0.4, 80, 5, CELD_ARROW_HEAD, false, false), b = spoke (2.5, 80, 5, CELD_ARROW_HEAD, false, true);
  Answer    answer;

  draw_arrow (&paint, &a, GREEN);
  draw_arrow (&paint, &b, BLUE);
  answer = read_paint (&paint, CELD_ARROW_HEAD);
  CHECK (answer.relations.n == 2 && answer.problems.n == 0);
  for (size_t i = 0; i < answer.relations.n; i++)
    CHECK (answer.relations.item[i].crack == (hypot (answer.relations.item[i].farther.x - b.tip.x,
                                                     answer.relations.item[i].farther.y - b.tip.y) < 6));
  forget (&answer);
  free (paint.data);
}

int
main (void)
{
  RUN (several_that_leave);
  RUN (several_that_arrive);
  RUN (head_to_tail);
  RUN (both_ways);
  RUN (side_by_side);
  RUN (at_any_angles);
  RUN (tails_below_heads);
  RUN (two_that_look_like_one);
  RUN (one_end_is_enough);
  RUN (two_in_a_chain);
  RUN (ends_below_dots);
  RUN (near_hues_on_white);
  RUN (colours_stay);
  return DONE;
}
