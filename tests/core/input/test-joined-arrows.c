/* Arrows of one colour that share ends: read where heads, dots, opacity or width tell, and none wrongly.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

static const uint8_t ONE[4][3] = { { 20, 160, 60 }, { 20, 160, 60 }, { 20, 160, 60 }, { 20, 160, 60 } };

static void
two_that_leave (void)
{
  read_shared (FAN_OUT, 2, 48, ONE, 0.6);
}

static void
three_that_leave (void)
{
  read_shared (FAN_OUT, 3, 48, ONE, 0.6);
}

static void
two_that_arrive (void)
{
  read_shared (FAN_IN, 2, 120, ONE, 0.6);
}

static void
three_that_arrive (void)
{
  read_shared (FAN_IN, 3, 48, ONE, 0.6);
}

static void
head_to_tail (void)
{
  read_shared (CHAIN, 2, 48, ONE, 0.6);
}

static void
side_by_side (void)
{
  read_shared (OVERLAP, 2, 48, ONE, 0);
}

static void
at_any_angles (void)
{
  read_at_any_angles (80, ONE, 0);
}

/* Two that fade or taper in one straight line: nothing else shows where they meet. */
static void
in_one_line (void)
{
  static const Sharing kinds[] = { FAN_OUT, FAN_IN, CHAIN };
  uint32_t             state = 31;
  int                  right = 0;

  for (int i = 0; i < 90; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_FADE : CELD_ARROW_TAPER;
      double         angle = random_between (&state, 0, 6.28), w = random_between (&state, 6, 8);
      Arrow          a[2];

      for (int k = 0; k < 2; k++)
        a[k] = shared_arrow (kinds[i % 3], k, angle + 3.14159265 * k, random_between (&state, 12, 17) * w, w, style,
                             true);
      right += read_green (a, 2, style);
    }
  CHECK (right >= 160);
}

/* A stroke that is thicker or stronger in its middle, as a brush makes it, is not two arrows. */
static void
swelling_strokes (void)
{
  for (int i = 0; i < 24; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_FADE : CELD_ARROW_TAPER;
      CeldPaint      paint = blank (SIZE, SIZE);
      double         angle = 0.26 * i, w = 8 + i % 5, length = 12 * w / 30;
      Answer         answer;

      for (int k = 0; k < 30; k++)
        {
          double along = (k - 15) * length, from = 0.3 + 0.7 * sin (3.14159265 * k / 30);
          double to = 0.3 + 0.7 * sin (3.14159265 * (k + 1) / 30);
          Arrow  a = arrow_at ((Point) { SIZE / 2. + along * cos (angle), SIZE / 2. + along * sin (angle) }, angle,
                               length, w, 0, 0, BARE, 0);

          if (style == CELD_ARROW_FADE)
            a.alpha = from, a.last_alpha = to;
          else
            a.width = w * from, a.last_width = w * to;
          draw_arrow (&paint, &a, GREEN);
        }
      answer = read_paint (&paint, style);
      CHECK (answer.relations.n == 0 && answer.problems.n == 1);
      forget (&answer);
      free (paint.data);
    }
}

/* Strokes that meet and have neither heads nor dots, and are as opaque and wide everywhere, are not several arrows.
 * Three may look like one with long barbs, and a few pictures of four like two that share a head. */
static void
bare_strokes (void)
{
  uint32_t state = 7;
  int      several = 0;

  for (int i = 0; i < 80; i++)
    {
      CeldPaint paint = blank (SIZE, SIZE);
      double    w = random_between (&state, 3, 8);
      int       n = 2 + (int) check_random (&state, 3);
      Answer    answer;

      for (int k = 0; k < n; k++)
        {
          double angle = random_between (&state, 0, 6.28), length = random_between (&state, 8, 16) * w;
          Arrow  a = arrow_at ((Point) { SIZE / 2., SIZE / 2. }, angle, length, w, 0, 0, BARE, 0);

          draw_arrow (&paint, &a, GREEN);
        }
      answer = read_paint (&paint, STYLES[i % 4]);
      CHECK (answer.relations.n + answer.problems.n >= 1);
      several += answer.relations.n > 1;
      forget (&answer);
      free (paint.data);
    }
  CHECK (several <= 2);
}

/* Some of the lines of a drawn net have heads; whatever is read is one of them. */
static void
in_a_net (void)
{
  uint32_t state = 17;

  for (int i = 0; i < 40; i++)
    {
      CeldArrowStyle style = STYLES[i % 4];
      double         w = random_between (&state, 3, 5);
      Point          place[4];
      Arrow          a[5];
      int            n = 3 + (int) check_random (&state, 3);

      for (int k = 0; k < 4; k++)
        place[k] = (Point) { random_between (&state, 30, SIZE - 30), random_between (&state, 30, SIZE - 30) };
      for (int k = 0; k < n; k++)
        {
          Point  from = place[k % 4], to = place[(k + 1 + k / 4) % 4];
          double dx = to.x - from.x, dy = to.y - from.y;

          a[k] = through (to, atan2 (dy, dx), hypot (dx, dy), 1, w, style, i % 8 < 4);
        }
      read_green (a, n, style);
    }
}

/* Three places, with an arrow between each two: nothing begins in the middle of a line. */
static void
round_a_loop (void)
{
  uint32_t state = 23;

  for (int i = 0; i < 60; i++)
    {
      double turn = random_between (&state, 0, 6.28), w = random_between (&state, 4, 6);
      Point  place[3];
      Arrow  a[3];

      for (int k = 0; k < 3; k++)
        {
          double angle = turn + k * 2.0944 + random_between (&state, -0.2, 0.2), r = random_between (&state, 80, 110);

          place[k] = (Point) { SIZE / 2. + r * cos (angle), SIZE / 2. + r * sin (angle) };
        }
      for (int k = 0; k < 3; k++)
        {
          Point  from = place[k == 1], to = place[k ? 2 : 1];
          double length = hypot (to.x - from.x, to.y - from.y);

          a[k] = through (to, atan2 (to.y - from.y, to.x - from.x), length, 1, w, CELD_ARROW_HEAD, i % 4 == 0);
        }
      read_green (a, 3, CELD_ARROW_HEAD);
    }
}

/* Two that meet near the frame, which cuts off the end of the second: it is never read the other way. */
static void
cut_by_the_frame (void)
{
  uint32_t state = 29;

  for (int i = 0; i < 96; i++)
    {
      CeldArrowStyle style = STYLES[i % 2];
      double         w = random_between (&state, 3, 6), angle = random_between (&state, -0.5, 0.5);
      double         length = random_between (&state, 12, 15) * w, turn = random_between (&state, 0.7, 2);
      CeldPaint      paint = blank (SIZE, SIZE);
      Point          place = { SIZE - length * random_between (&state, 0.5, 0.95), SIZE / 2. };
      Arrow          a = through (place, angle + (i % 4 < 2 ? turn : -turn), length, i % 8 < 4, w, style, i % 16 < 8);
      Arrow          b = through (place, angle, length, 0, w, style, i % 32 < 16);
      Answer         answer;

      draw_arrow (&paint, &a, GREEN);
      draw_arrow (&paint, &b, GREEN);
      answer = read_paint (&paint, style);
      for (size_t k = 0; k < answer.relations.n; k++)
        {
          const CeldRelation *r = &answer.relations.item[k];
          double              near = fmin (hypot (r->nearer.x - place.x, r->nearer.y - place.y),
                                           hypot (r->farther.x - place.x, r->farther.y - place.y));

          if (fmax (r->nearer.x, r->farther.x) > SIZE - w - 2 && near < 3 * w) /* the second one */
            CHECK ((r->farther.x > r->nearer.x) == (style == CELD_ARROW_HEAD));
        }
      forget (&answer);
      free (paint.data);
    }
}

/* Tips that meet on the frame: the places that are read lie in the picture. */
static void
tips_on_the_frame (void)
{
  uint32_t state = 37;
  size_t   read = 0;

  for (int i = 0; i < 40; i++)
    {
      double    w = random_between (&state, 3, 6), length = random_between (&state, 13, 16) * w;
      double    angle = 3.1416 + random_between (&state, -0.3, 0.3);
      Point     place = { random_between (&state, -1, 2), SIZE / 2. };
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;

      for (int k = -1; k <= 1; k += 2)
        {
          Arrow a = through (place, angle + 0.7 * k, length, 1, w, STYLES[i % 4], i % 8 < 4);

          draw_arrow (&paint, &a, GREEN);
        }
      answer = read_paint (&paint, STYLES[i % 4]);
      for (size_t k = 0; k < answer.relations.n; k++, read++)
        CHECK (fmin (answer.relations.item[k].farther.x, answer.relations.item[k].nearer.x) >= 0);
      forget (&answer);
      free (paint.data);
    }
  CHECK (read > 20);
}

/* A pencil of one pixel without antialiasing: pixels of its diagonals touch at corners alone. */
static void
thin_diagonals (void)
{
  for (int k = 0; k < 4; k++)
    {
      CeldPaint paint = blank (SIZE, SIZE);
      int       middle = SIZE / 2, length = 80;
      Answer    answer;
      bool      found[2] = { false, false };

      for (int side = -1; side <= 1; side += 2)
        for (int i = 0; i <= length; i++)
          {
            int x = middle + (k % 2 ? side * i : k / 2 ? i : -i), y = middle + (k % 2 ? k / 2 ? i : -i : side * i);

            memcpy (paint.data + 4 * ((size_t) y * paint.stride + (size_t) x), GREEN, 3);
            paint.data[4 * ((size_t) y * paint.stride + (size_t) x) + 3] = (uint8_t) (255 - 200 * i / length);
          }
      answer = read_paint (&paint, CELD_ARROW_FADE);
      CHECK (answer.relations.n == 2 && answer.problems.n == 0);
      for (size_t i = 0; i < answer.relations.n; i++)
        {
          const CeldRelation *r = &answer.relations.item[i];

          CHECK (hypot (r->nearer.x - middle, r->nearer.y - middle) < 5);
          CHECK (fabs (fabs (r->farther.x - middle) - length) < 5 && fabs (fabs (r->farther.y - middle) - length) < 5);
          found[(k % 2 ? r->farther.x : r->farther.y) > middle] = true;
        }
      CHECK (found[0] && found[1]);
      forget (&answer);
      free (paint.data);
    }
}

/* Draws arrows in an order at random and counts those that are read; no other one is. */
static int
read_all (Arrow *a, int n, CeldArrowStyle style, uint32_t *state)
{
  for (int k = n - 1; k > 0; k--)
    {
      int   other = (int) check_random (state, (uint32_t) k + 1);
      Arrow b = a[k];

      a[k]     = a[other];
      a[other] = b;
    }
  return read_green (a, n, style);
}

/* Four that arrive at one place, and one more that arrives, or begins, where each of them begins. */
static void
a_star_that_leads_on (void)
{
  uint32_t state = 41;
  int      right = 0;

  for (int i = 0; i < 60; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_FADE : CELD_ARROW_TAPER;
      double         w = random_between (&state, 4, 6), turn = random_between (&state, 0, 6.28);
      Arrow          a[8];

      for (int k = 0; k < 4; k++)
        {
          double angle = turn + 1.5708 * k + random_between (&state, -0.2, 0.2), on = random_between (&state, 0.9, 1.3);
          Point  middle = { SIZE / 2., SIZE / 2. };

          a[2 * k]     = through (middle, angle + 3.14159265, 80, 1, w, style, true);
          a[2 * k + 1] = through (a[2 * k].point[0], k % 2 ? angle + 3.14159265 - on : angle + on, 45, k % 2, w, style,
                                  true);
        }
      right += read_all (a, 8, style, &state);
    }
  CHECK (right >= 0.8 * 60 * 8);
}

/* Five that arrive at one place, of which two are about in line with arrows that leave it: so many ends show by
 * themselves that none goes on there. */
static void
a_hub (void)
{
  uint32_t state = 47;
  int      right = 0;

  for (int i = 0; i < 60; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_FADE : CELD_ARROW_TAPER;
      double         w = random_between (&state, 4, 6), turn = random_between (&state, 0, 6.28);
      Arrow          a[7];

      for (int k = 0; k < 7; k++)
        a[k] = through ((Point) { SIZE / 2., SIZE / 2. }, turn + 0.9 * k, random_between (&state, 75, 95), k % 3 != 1, w,
                        style, true);
      right += read_all (a, 7, style, &state);
    }
  CHECK (right >= 0.95 * 60 * 7);
}

/* Two hubs with an arrow from one to the other, and six more at each, which begin or end there as it comes and lead
 * anywhere: some are in line with others, and which of them go on shows only in all together. */
static void
two_hubs (void)
{
  enum { ARMS = 6, ALL = 2 * ARMS + 1 };
  uint32_t state = 53;
  int      right = 0;

  for (int i = 0; i < 60; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_FADE : CELD_ARROW_TAPER;
      double         w = random_between (&state, 4, 6), turn = random_between (&state, 0, 6.28), angle = 0;
      Point          hub[2];
      Arrow          a[ALL];

      for (int k = 0; k < 2; k++)
        hub[k] = (Point) { SIZE / 2. + (2 * k - 1) * 45 * cos (turn), SIZE / 2. + (2 * k - 1) * 45 * sin (turn) };
      a[ALL - 1] = through (hub[0], turn, 90, 0, w, style, true);
      for (int k = 0; k < ALL - 1; k++)
        {
          bool inwards = check_random (&state, 2);

          angle = (k % ARMS ? angle : turn + k / ARMS * 3.1416) + random_between (&state, 0.35, 5.9 / ARMS);
          a[k]  = through (hub[k / ARMS], angle + inwards * 3.1416, random_between (&state, 55, 95), inwards, w, style, true);
        }
      right += read_all (a, ALL, style, &state);
    }
  CHECK (right >= 0.9 * 60 * ALL);
}

/* Lines that lead to one place at 30 degrees look like a disc there; the dots of all are at their other ends. */
static void
dots_round_a_hub (void)
{
  uint32_t state = 43;
  int      right = 0;

  for (int i = 0; i < 40; i++)
    {
      double w = random_between (&state, 4, 6), turn = random_between (&state, 0, 6.28);
      Arrow  a[6];

      for (int k = 0; k < 6; k++)
        a[k] = through ((Point) { SIZE / 2., SIZE / 2. }, turn + 0.5236 * k, random_between (&state, 70, 90), 1, w,
                        CELD_ARROW_DOT, true);
      right += read_all (a, 6, CELD_ARROW_DOT, &state);
    }
  CHECK (right >= 0.9 * 40 * 6);
}

/* Five with open heads that arrive at one place, and one that leaves it: their barbs lie on each other and on shafts,
 * and heads at the other ends would fit the paint if barbs might lie on the shafts that have them. */
static void
heads_round_a_hub (void)
{
  uint32_t state = 47;
  int      right = 0;

  for (int i = 0; i < 40; i++)
    {
      double w = random_between (&state, 4, 6), turn = random_between (&state, 0, 6.28);
      Point  middle = { SIZE / 2., SIZE / 2. };
      Arrow  a[6];

      for (int k = 0; k < 6; k++)
        {
          double angle = turn + 1.0472 * k + random_between (&state, -0.15, 0.15);
          double length = random_between (&state, 75, 95);

          a[k] = through (middle, k ? angle : angle + 3.14159265, length, k != 0, w, CELD_ARROW_HEAD, true);
        }
      right += read_all (a, 6, CELD_ARROW_HEAD, &state);
    }
  CHECK (right >= 0.85 * 40 * 6);
}

/* Two that leave one place, and one that crosses both: it goes on where its opacity or width does. */
static void
crossed_on_the_way (void)
{
  uint32_t state = 43;
  int      right = 0;

  for (int i = 0; i < 60; i++)
    {
      CeldArrowStyle style = i % 2 ? CELD_ARROW_FADE : CELD_ARROW_TAPER;
      double         w = random_between (&state, 4, 6), turn = random_between (&state, 0, 6.28);
      Point          from = { SIZE / 2. - 90 * cos (turn), SIZE / 2. - 90 * sin (turn) };
      Point          middle = { SIZE / 2., SIZE / 2. };
      Arrow          a[3];

      for (int k = 0; k < 2; k++)
        a[k] = through (from, turn + (k ? 0.35 : -0.35), 190, 0, w, style, true);
      a[2] = through (middle, turn + 1.5708 + random_between (&state, -0.3, 0.3), 180, 0.5, w, style, true);
      right += read_all (a, 3, style, &state);
    }
  CHECK (right >= 0.8 * 60 * 3);
}

/* All are blue, so that all crack. */
static void
cracks (void)
{
  CeldPaint paint = blank (SIZE, SIZE);
  Arrow     a = spoke (0.4, 90, 5, CELD_ARROW_HEAD, false, false), b = spoke (2.5, 90, 5, CELD_ARROW_HEAD, false, true);
  Answer    answer;

  draw_arrow (&paint, &a, BLUE);
  draw_arrow (&paint, &b, BLUE);
  answer = read_paint (&paint, CELD_ARROW_HEAD);
  CHECK (answer.relations.n == 2 && answer.problems.n == 0);
  for (size_t i = 0; i < answer.relations.n; i++)
    CHECK (answer.relations.item[i].crack);
  forget (&answer);
  free (paint.data);
}

int
main (void)
{
  RUN (two_that_leave);
  RUN (three_that_leave);
  RUN (two_that_arrive);
  RUN (three_that_arrive);
  RUN (head_to_tail);
  RUN (side_by_side);
  RUN (at_any_angles);
  RUN (in_one_line);
  RUN (a_star_that_leads_on);
  RUN (a_hub);
  RUN (two_hubs);
  RUN (dots_round_a_hub);
  RUN (heads_round_a_hub);
  RUN (crossed_on_the_way);
  RUN (swelling_strokes);
  RUN (bare_strokes);
  RUN (in_a_net);
  RUN (round_a_loop);
  RUN (cut_by_the_frame);
  RUN (tips_on_the_frame);
  RUN (thin_diagonals);
  RUN (cracks);
  return DONE;
}
