/* Strokes that cross or touch, and what is no arrow at all: each is read on its own, or reported.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "draw-arrows.h"

#define SIZE 240

/* Two arrows at angles from 40 to 140 degrees: both are read nearly always, and never wrongly. */
static void
two_that_cross (void)
{
  uint32_t state = 3;

  for (size_t s = 0; s < 4; s++)
    {
      int right = 0, n = 40;

      for (int i = 0; i < n; i++)
        {
          double    w = random_between (&state, 3, 7), angle = random_between (&state, 0, 6.28);
          double    turn = random_between (&state, 0.7, 2.44), length = random_between (&state, 6, 7.5) * (w + 20);
          Point     middle = { 120, 120 };
          Arrow     a = through (middle, angle, length, random_between (&state, 0.4, 0.5), w, STYLES[s], i % 2);
          Arrow     b = through (middle, angle + turn, length, random_between (&state, 0.4, 0.5), w, STYLES[s],
                                 !(i % 3));
          CeldPaint paint = blank (SIZE, SIZE);
          Answer    answer;
          int       found;

          draw_arrow (&paint, &a, GREEN);
          draw_arrow (&paint, &b, GREEN);
          answer = read_paint (&paint, STYLES[s]);
          found  = is_read (&answer, &a, STYLES[s]) + is_read (&answer, &b, STYLES[s]);
          CHECK (answer.relations.n == (size_t) found); /* no other */
          CHECK (answer.relations.n + answer.problems.n >= 1);
          right += found;
          forget (&answer);
          free (paint.data);
        }
      if (right < 1.8 * n)
        printf ("style %d: %d of %d read\n", (int) STYLES[s], right, 2 * n);
      CHECK (right >= 1.8 * n);
    }
}

/* Colours stay with their strokes. */
static void
cracks_that_cross (void)
{
  Arrow     a = through ((Point) { 100, 100 }, 0.3, 140, 0.5, 4, CELD_ARROW_HEAD, true);
  Arrow     b = through ((Point) { 100, 100 }, 1.8, 140, 0.5, 4, CELD_ARROW_HEAD, false);
  CeldPaint paint = blank (SIZE, SIZE);
  Answer    answer;

  draw_arrow (&paint, &a, GREEN);
  draw_arrow (&paint, &b, BLUE);
  answer = read_paint (&paint, CELD_ARROW_HEAD);
  CHECK (answer.relations.n == 2 && answer.problems.n == 0);
  CHECK (answer.relations.item[0].crack != answer.relations.item[1].crack);
  for (size_t i = 0; i < answer.relations.n; i++)
    CHECK (answer.relations.item[i].crack == (hypot (answer.relations.item[i].farther.x - b.tip.x,
                                                     answer.relations.item[i].farther.y - b.tip.y) < 6));
  forget (&answer);
  free (paint.data);
}

/* Wherever a second arrow touches the first - end to end, end on shaft, side by side - no relation is wrong. */
static void
arrows_that_touch (void)
{
  uint32_t state = 9;

  for (int i = 0; i < 240; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      double         w = random_between (&state, 3, 8), angle = random_between (&state, 0, 6.28), share = i % 3 / 2.;
      double         turn = random_between (&state, 0.5, 5.8);
      Arrow          a = through ((Point) { 120, 120 }, angle, 90, i / 4 % 3 / 2., w, style, i % 8 < 4);
      Arrow          b = through ((Point) { 120, 120 }, angle + turn, 90, share, w, style, i % 8 < 4);
      CeldPaint      paint = blank (SIZE, SIZE);
      Answer         answer;

      draw_arrow (&paint, &a, GREEN);
      draw_arrow (&paint, &b, GREEN);
      answer = read_paint (&paint, style);
      CHECK (answer.relations.n == (size_t) is_read (&answer, &a, style) + is_read (&answer, &b, style));
      CHECK (answer.relations.n + answer.problems.n > 0);
      forget (&answer);
      free (paint.data);
    }
}

static void
dab (CeldPaint *paint, double x, double y, double radius)
{
  for (int py = 0; py < paint->height; py++)
    for (int px = 0; px < paint->width; px++)
      if (hypot (px + 0.5 - x, py + 0.5 - y) <= radius)
        memcpy (paint->data + 4 * ((size_t) py * paint->stride + (size_t) px), (uint8_t[]) { 20, 160, 60, 255 }, 4);
}

/* Closed loops, blots, writing and noise are no arrows in any style. */
static void
other_things (void)
{
  for (size_t s = 0; s < 4; s++)
    {
      CeldPaint paint = blank (SIZE, SIZE);
      uint32_t  state = 21;
      Answer    answer;

      for (int i = 0; i < 400; i++) /* a ring, a blot, */
        dab (&paint, 50 + 30 * cos (i * 0.0157), 50 + 24 * sin (i * 0.0157), 3);
      dab (&paint, 150, 50, 9);
      for (int i = 0; i < 100; i++) /* an A, an X, an O */
        {
          double t = i / 99.;

          dab (&paint, 20 + 15 * t, 150 - 40 * t, 2);
          dab (&paint, 50 - 15 * t, 150 - 40 * t, 2);
          dab (&paint, 26 + 18 * t, 132, 2);
          dab (&paint, 70 + 25 * t, 150 - 40 * t, 2);
          dab (&paint, 70 + 25 * t, 110 + 40 * t, 2);
          dab (&paint, 125 + 14 * cos (6.28 * t), 130 + 20 * sin (6.28 * t), 2);
        }
      for (int i = 0; i < 60; i++) /* and specks */
        dab (&paint, 10 + check_random (&state, 220), 180 + check_random (&state, 50), 0.7);
      answer = read_paint (&paint, STYLES[s]);
      CHECK (answer.relations.n == 0);
      CHECK (answer.problems.n >= 5);
      forget (&answer);
      free (paint.data);
    }
}

/* From 8 pixels on an arrow may be read, and is never read wrongly; from 14 on nearly all are read. */
static void
small_arrows (void)
{
  uint32_t state = 31;
  int      right = 0, all = 0;

  for (int i = 0; i < 800; i++)
    {
      double    length = random_between (&state, 8, 24), w = fmax (1.2, length / 9);
      double    angle = random_between (&state, 0, 6.28);
      Arrow     a = through ((Point) { 30, 30 }, angle, length, 0.5, w, STYLES[i % 4], i % 8 < 4);
      CeldPaint paint = blank (60, 60);
      Answer    answer;
      bool      good;

      draw_arrow (&paint, &a, GREEN);
      answer = read_paint (&paint, STYLES[i % 4]);
      good   = is_read (&answer, &a, STYLES[i % 4]);
      CHECK (answer.relations.n == (size_t) good && answer.relations.n + answer.problems.n == 1);
      if (length >= 14)
        {
          right += good;
          all++;
        }
      forget (&answer);
      free (paint.data);
    }
  if (right < 0.9 * all)
    printf ("%d of %d small arrows read\n", right, all);
  CHECK (right >= 0.9 * all);
}

/* Half of it beyond the frame: what can be seen may be read from end to end, never the other way. */
static void
arrows_on_the_frame (void)
{
  for (int degrees = 0; degrees < 360; degrees += 10)
    for (size_t s = 0; s < 4; s++)
      {
        double    angle = degrees * 0.0174532925;
        Arrow     a = through ((Point) { 50, 50 }, angle, 90, 0.5, 5, STYLES[s], degrees % 20);
        CeldPaint paint = blank (80, 100);
        Answer    answer;
        bool      dot = STYLES[s] == CELD_ARROW_DOT;

        draw_arrow (&paint, &a, GREEN);
        answer = read_paint (&paint, STYLES[s]);
        for (size_t i = 0; i < answer.relations.n; i++)
          {
            const CeldRelation *r = &answer.relations.item[i];
            double along = (r->farther.x - r->nearer.x) * cos (angle) + (r->farther.y - r->nearer.y) * sin (angle);

            CHECK (dot ? along < 0 : along > 0);
          }
        CHECK (answer.relations.n <= 1 && answer.relations.n + answer.problems.n >= 1);
        forget (&answer);
        free (paint.data);
      }
}

int
main (void)
{
  RUN (two_that_cross);
  RUN (cracks_that_cross);
  RUN (arrows_that_touch);
  RUN (other_things);
  RUN (small_arrows);
  RUN (arrows_on_the_frame);
  return DONE;
}
