/* Where arrows that share ends are read to end, if their lines are bent there.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

/* An arrow that ends in the middle. */
static Arrow
bent_to_middle (double way, double turning, double width, Head head)
{
  Arrow  a = arrow_at ((Point) { 0, 0 }, way, 17 * width, width, turning, 0, head, 3.8 * width);
  Point *end[3] = { &a.barb[0], &a.barb[1], &a.tip };
  double x = SIZE / 2. - a.tip.x, y = SIZE / 2. - a.tip.y;

  for (int k = 0; k < a.n + 3; k++)
    {
      Point *p = k < a.n ? &a.point[k] : end[k - a.n];

      *p = (Point) { p->x + x, p->y + y };
    }
  return a;
}

/* Three to the middle, of which two that are near each other bend away from each other: led on straight they meet
 * elsewhere.  Returns by how many widths the worst one that is read misses the middle; *n: how many are read. */
static double
worst_end (double turning, double spread, size_t *n)
{
  uint32_t state = 79;
  double   worst = 0;

  *n = 0;
  for (int i = 0; i < 30; i++)
    {
      double    w = random_between (&state, 4, 7), angle = random_between (&state, 0, 6.28);
      double    half = random_between (&state, spread, spread + 0.1);
      CeldPaint paint = blank (SIZE, SIZE);
      Answer    answer;

      for (int k = 0; k < 3; k++)
        {
          double turn = k == 2 ? 0 : k ? turning : -turning, way = angle + (k == 2 ? 2.6 : k ? half : -half);
          Arrow  a = bent_to_middle (way, turn, w, i % 2 ? OPEN : FILLED);

          draw_arrow (&paint, &a, GREEN);
        }
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      for (size_t k = 0; k < answer.relations.n; k++)
        worst = fmax (worst, hypot (answer.relations.item[k].farther.x - SIZE / 2.,
                                    answer.relations.item[k].farther.y - SIZE / 2.) / w);
      *n += answer.relations.n;
      forget (&answer);
      free (paint.data);
    }
  return worst;
}

/* Where they meet is no better place. */
static void
lines_that_bend (void)
{
  size_t n;

  CHECK (worst_end (1.9, 0.55, &n) < 1.3);
  CHECK (n >= 12);
}

/* Where both are far from each other, those arrows are not read. */
static void
lines_that_meet_elsewhere (void)
{
  size_t n;

  CHECK (worst_end (1.6, 0.6, &n) < 0.6);
  CHECK (n > 0);
}

int
main (void)
{
  RUN (lines_that_bend);
  RUN (lines_that_meet_elsewhere);
  return DONE;
}
