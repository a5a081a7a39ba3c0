/* Lines with a head at either end, as two arrows that begin at one place.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

/* Draws an arrow that begins thin, for one step of its points. */
static void
draw_thin (CeldPaint *paint, const Arrow *a, double part)
{
  Arrow rest = *a, thin = *a;

  rest.n = a->n - 1;
  memcpy (rest.point, a->point + 1, (size_t) rest.n * sizeof *rest.point);
  thin.n          = 2;
  thin.point[0]   = a->point[1];
  thin.point[1]   = a->point[0];
  thin.last_width = part * a->width;
  thin.head       = BARE;
  draw_arrow (paint, &rest, GREEN);
  draw_arrow (paint, &thin, GREEN);
}

/* Two that lead away from the middle, up to a turn in one line; part: the width of their beginnings, by that of the
 * rest.  Counts those that are read; no other one is. */
static int
read_two (double turn, double part, int pictures)
{
  uint32_t state = 71;
  int      right = 0;

  for (int i = 0; i < pictures; i++)
    {
      double    w = random_between (&state, 3, 6), angle = random_between (&state, 0, 6.28);
      CeldPaint paint = blank (SIZE, SIZE);
      Arrow     a[2];
      Answer    answer;
      int       found;

      for (int k = 0; k < 2; k++)
        {
          a[k] = arrow_at ((Point) { SIZE / 2., SIZE / 2. }, angle + k * (3.14159265 - turn),
                           random_between (&state, 12, 20) * w, w, 0, 0, i % 2 ? OPEN : FILLED, 3.8 * w);
          draw_thin (&paint, &a[k], part);
        }
      answer = read_paint (&paint, CELD_ARROW_HEAD);
      found  = (int) count_read (&answer, a, 2, CELD_ARROW_HEAD);
      CHECK ((int) answer.relations.n == found);
      right += found;
      forget (&answer);
      free (paint.data);
    }
  return right;
}

static void
thin_beginnings (void)
{
  CHECK (read_two (0, 0.55, 20) >= 0.8 * 40);
}

static void
a_kink (void)
{
  CHECK (read_two (0.44, 1, 20) >= 0.7 * 40);
}

/* One stroke with two heads is as likely as two arrows: nobody can tell where they begin. */
static void
a_smooth_line (void)
{
  CHECK (read_two (0, 1, 20) == 0);
}

int
main (void)
{
  RUN (thin_beginnings);
  RUN (a_kink);
  RUN (a_smooth_line);
  return DONE;
}
