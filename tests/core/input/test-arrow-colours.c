/* Arrows of different colours that share ends: each is read by its colour, or reported, and none wrongly.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "draw-arrows.h"

#define SIZE 300

static const uint8_t COLOURS[4][3] = { { 20, 160, 60 }, { 230, 90, 0 }, { 120, 40, 160 }, { 0, 0, 0 } };

/* How arrows share the place in the middle. */
typedef enum { FAN_OUT, FAN_IN, CHAIN, STAR, OVERLAP } Sharing;

/* An arrow from the middle to a place around it, or the other way. */
static Arrow
spoke (double angle, double length, double width, CeldArrowStyle style, bool inwards, bool open)
{
  bool  nearer_is_tip = style == CELD_ARROW_DOT; /* `through` draws a dot at the last point */
  Point middle = { SIZE / 2., SIZE / 2. };

  return inwards != nearer_is_tip ? through (middle, angle + 3.14159265, length, 1, width, style, open)
                                  : through (middle, angle, length, 0, width, style, open);
}

static Arrow
shared_arrow (Sharing sharing, int k, double angle, double length, double width, CeldArrowStyle style, bool open)
{
  bool inwards = sharing == FAN_IN || (sharing == CHAIN && k == 0) || (sharing == STAR && k % 2 == 0);

  return spoke (sharing == OVERLAP ? angle * 0.1 : angle, length * (sharing == OVERLAP ? 1 + 0.3 * k : 1), width, style,
                inwards, open);
}

static void
read_shared (Sharing sharing, int arrows, double least)
{
  uint32_t state = 5 + (uint32_t) sharing;
  int      right = 0, all = 0;

  for (int i = 0; i < 120; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      double         start = random_between (&state, 0, 6.28), w = random_between (&state, 3, 7);
      double         length = random_between (&state, 14, 16) * w;
      CeldPaint      paint = blank (SIZE, SIZE);
      Arrow          a[4];
      Answer         answer;
      size_t         found = 0;

      for (int k = 0; k < arrows; k++)
        {
          double angle = start + (k + random_between (&state, -0.25, 0.25)) * 6.2832 / arrows;

          a[k] = shared_arrow (sharing, k, angle, length, w * random_between (&state, 0.9, 1.1), style, i % 8 < 4);
          draw_arrow (&paint, &a[k], COLOURS[k]);
        }
      answer = read_paint (&paint, style);
      for (int k = 0; k < arrows; k++)
        found += is_read (&answer, &a[k], style);
      CHECK (answer.relations.n == found); /* no other */
      CHECK (answer.relations.n + answer.problems.n >= 1);
      right += (int) found;
      all   += arrows;
      forget (&answer);
      free (paint.data);
    }
  if (right < least * all)
    printf ("sharing %d: %d of %d read\n", (int) sharing, right, all);
  CHECK (right >= least * all);
}

static void
several_that_leave (void)
{
  read_shared (FAN_OUT, 3, 0.5);
}

static void
several_that_arrive (void)
{
  read_shared (FAN_IN, 3, 0.5);
}

static void
head_to_tail (void)
{
  read_shared (CHAIN, 2, 0.65);
}

static void
both_ways (void)
{
  read_shared (STAR, 4, 0.72);
}

static void
side_by_side (void)
{
  read_shared (OVERLAP, 2, 0);
}

/* Four that begin or end in the middle, half a radian apart or more: opposite ones may look like one stroke. */
static void
at_any_angles (void)
{
  uint32_t state = 3;
  int      right = 0, all = 0;

  for (int i = 0; i < 400; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      double         w = random_between (&state, 3, 7);
      CeldPaint      paint = blank (SIZE, SIZE);
      Arrow          a[4];
      Answer         answer;
      size_t         found = 0;
      double         angle = random_between (&state, 0, 6.28);

      for (int k = 0; k < 4; k++)
        {
          angle += 0.5 + random_between (&state, 0, 1);
          a[k] = spoke (angle, random_between (&state, 10, 16) * w, w, style,
                        check_random (&state, 2), i % 8 < 4);
          draw_arrow (&paint, &a[k], COLOURS[k]);
        }
      answer = read_paint (&paint, style);
      for (int k = 0; k < 4; k++)
        found += is_read (&answer, &a[k], style);
      CHECK (answer.relations.n == found);
      right += (int) found;
      all   += 4;
      forget (&answer);
      free (paint.data);
    }
  CHECK (right >= 0.75 * all);
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
      size_t    found = 0;

      a[0] = through (middle, angle + 1.5, length, 1, w, CELD_ARROW_DOT, false);
      a[1] = arrow_at (middle, angle, length, w, 0, 0, DOT, 1.5 * w);
      a[2] = arrow_at (middle, angle + 3.1416 + turn, length, w, 0, 0, DOT, 1.5 * w);
      a[3] = through (a[2].tip, angle - 1.5, length, 1, 1.2 * w, CELD_ARROW_DOT, false);
      for (int k = 0; k < 4; k++)
        draw_arrow (&paint, &a[k], COLOURS[k < 2 ? k : k - 1]);
      answer = read_paint (&paint, CELD_ARROW_DOT);
      for (int k = 0; k < 4; k++)
        found += is_read (&answer, &a[k], CELD_ARROW_DOT);
      CHECK (answer.relations.n == found);
      forget (&answer);
      free (paint.data);
    }
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
  RUN (colours_stay);
  return DONE;
}
