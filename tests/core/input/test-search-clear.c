/* Arrows of one colour that share ends: what else the same paint may be is left out.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

#define MOST_ARROWS 10

/* A straight arrow to a dot that is hardly wider than a line. */
static Arrow
to_dot (Point tail, Point dot, double width)
{
  return arrow_at (tail, atan2 (dot.y - tail.y, dot.x - tail.x), hypot (dot.x - tail.x, dot.y - tail.y), width, 0.1, 0,
                   DOT, 1.25 * width);
}

/* Five lead to small dots, from where others lead straight on to one place: no line passes a dot. */
static void
dots_on_the_way (void)
{
  uint32_t state = 53;
  int      right = 0;

  for (int i = 0; i < 30; i++)
    {
      double w = random_between (&state, 4, 6), angle = random_between (&state, 0, 6.28);
      Point  hub = { SIZE / 2., SIZE / 2. };
      Arrow  a[MOST_ARROWS];

      for (int k = 0; k < 5; k++)
        {
          double length = random_between (&state, 11, 13) * w, more = length + random_between (&state, 8, 10) * w;
          double bend = random_between (&state, -0.1, 0.1);
          Point  dot = { hub.x + length * cos (angle), hub.y + length * sin (angle) };
          Point  far = { hub.x + more * cos (angle + bend), hub.y + more * sin (angle + bend) };

          a[2 * k]     = to_dot (hub, dot, w);
          a[2 * k + 1] = to_dot (dot, far, w);
          angle += random_between (&state, 0.9, 1.1);
        }
      right += read_green (a, 10, CELD_ARROW_DOT);
    }
  CHECK (right >= 0.95 * 30 * 10);
}

/* A dot at each corner of a ring: its arrows may lead round it either way. */
static void
a_ring_of_dots (void)
{
  uint32_t state = 59;

  for (int i = 0; i < 40; i++)
    {
      double    w = random_between (&state, 3, 6), start = random_between (&state, 0, 6.28);
      int       n = 3 + i % 3;
      CeldPaint paint = blank (SIZE, SIZE);
      Point     p[MOST_ARROWS];
      Answer    answer;

      for (int k = 0; k < n; k++)
        {
          double angle = start + (k + random_between (&state, -0.2, 0.2)) * 6.2832 / n;
          double r = random_between (&state, 15, 18) * w;

          p[k] = (Point) { SIZE / 2. + r * cos (angle), SIZE / 2. + r * sin (angle) };
        }
      for (int k = 0; k < n; k++)
        {
          Arrow a = to_dot (p[(k + 1) % n], p[k], w);

          draw_arrow (&paint, &a, GREEN);
        }
      answer = read_paint (&paint, CELD_ARROW_DOT);
      CHECK (answer.relations.n == 0 && answer.problems.n >= 1);
      forget (&answer);
      free (paint.data);
    }
}

/* Two that bend where they cross: there is nothing that shows an end. */
static void
bent_at_a_crossing (void)
{
  uint32_t state = 61;

  for (int i = 0; i < 120; i++)
    {
      double w = random_between (&state, 3, 6), start = random_between (&state, 0, 6.28);
      double length = random_between (&state, 9, 14) * w, turn = random_between (&state, 1.2, 1.8);
      Arrow  a[2];

      for (int k = 0; k < 2; k++)
        {
          double angle = start + k * turn, bend = (k ? 1 : -1) * random_between (&state, 0.5, 0.75);
          Point  middle = { SIZE / 2., SIZE / 2. };

          a[k] = arrow_at (middle, angle, length, w, 0, 0, DOT, 1.4 * w);
          a[k].point[0] = (Point) { middle.x - length * cos (angle + bend), middle.y - length * sin (angle + bend) };
          a[k].point[1] = middle;
        }
      read_green (a, 2, CELD_ARROW_DOT);
    }
}

/* Four that share an end, two of them short or with small heads: how many are read, and no other. */
static int
read_four (double length, double size, bool open)
{
  uint32_t state = 83;
  int      right = 0;

  for (int i = 0; i < 20; i++)
    {
      double w = random_between (&state, 4, 6), start = random_between (&state, 0, 6.28);
      Arrow  a[4];

      for (int k = 0; k < 4; k++)
        {
          double angle = start + k * 1.5708 + random_between (&state, -0.3, 0.3), far = (k < 2 ? length : 16) * w;
          Point  middle = { SIZE / 2., SIZE / 2. }, other = { middle.x + far * cos (angle), middle.y + far * sin (angle) };

          a[k] = arrow_at (k % 2 ? other : middle, angle + k % 2 * 3.14159265, far, w, 0.1, 0,
                           open && i % 2 ? OPEN : FILLED, (k < 2 ? size : 3.8) * w);
        }
      right += read_green (a, 4, CELD_ARROW_HEAD);
    }
  return right;
}

static void
short_ones (void)
{
  CHECK (read_four (6.4, 3.8, true) >= 0.7 * 80);
}

static void
small_heads (void)
{
  CHECK (read_four (16, 2.8, false) >= 0.94 * 80);
}

/* A line with half a head on its way, which nothing explains: it may be two. */
static void
half_a_head_on_the_way (void)
{
  uint32_t state = 101;
  int      right = 0;

  for (int i = 0; i < 20; i++)
    {
      double    w = random_between (&state, 4, 5), angle = random_between (&state, 0, 6.28), size = 2.4 * w;
      Point     middle = { SIZE / 2., SIZE / 2. };
      Point     from = { middle.x - 13 * w * cos (angle), middle.y - 13 * w * sin (angle) };
      CeldPaint paint = blank (SIZE, SIZE);
      Arrow     a = arrow_at (from, angle, 26 * w, w, 0.1, 0, FILLED, 3.8 * w);
      Arrow     half = { .n = 2, .width = 1, .last_width = 1, .alpha = 1, .last_alpha = 1, .head = FILLED, .size = size };
      Answer    answer;

      for (int k = 0; k < 2; k++)
        {
          Arrow other = arrow_at (from, angle + (k ? -1.2 : 1.2), 14 * w, w, 0.1, 0, FILLED, 3.8 * w);

          half.barb[k] = (Point) { middle.x - size * cos (angle - 0.55 * k), middle.y - size * sin (angle - 0.55 * k) };
          draw_arrow (&paint, &other, GREEN);
        }
      half.point[0] = half.tip = middle;
      half.point[1] = half.barb[0];
      draw_arrow (&paint, &a, GREEN);
      draw_arrow (&paint, &half, GREEN);
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      right += is_read (&answer, &a, CELD_ARROW_HEAD);
      forget (&answer);
      free (paint.data);
    }
  CHECK (right < 19);
}

int
main (void)
{
  RUN (dots_on_the_way);
  RUN (a_ring_of_dots);
  RUN (bent_at_a_crossing);
  RUN (short_ones);
  RUN (small_heads);
  RUN (half_a_head_on_the_way);
  return DONE;
}
