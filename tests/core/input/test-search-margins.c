/* How much worse other arrows are: those that nothing shows are none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

#define LINES 5

/* A straight arrow from a dot. */
static Arrow
from_dot (Point dot, Point tip, double width)
{
  return arrow_at (tip, atan2 (dot.y - tip.y, dot.x - tip.x), hypot (dot.x - tip.x, dot.y - tip.y), width, 0.1, 0, DOT,
                   1.5 * width);
}

/* From each of some dots an arrow leads to one place, and another one elsewhere.  Where all meet, their paint is almost
 * as wide as a dot, but it is none: no arrow begins there. */
static void
lines_that_meet_without_a_dot (void)
{
  uint32_t state = 61;
  int      right = 0;

  for (int i = 0; i < 30; i++)
    {
      double w = random_between (&state, 4, 5), angle = random_between (&state, 0, 6.28);
      Point  hub = { SIZE / 2., SIZE / 2. };
      Arrow  a[2 * LINES];

      for (int k = 0; k < LINES; k++)
        {
          double length = random_between (&state, 14, 16) * w, more = random_between (&state, 9, 11) * w;
          double turn = random_between (&state, 0.9, 1.1);
          Point  dot = { hub.x + length * cos (angle), hub.y + length * sin (angle) };
          Point  tip = { dot.x + more * cos (angle + turn), dot.y + more * sin (angle + turn) };

          a[2 * k]     = from_dot (dot, hub, w);
          a[2 * k + 1] = from_dot (dot, tip, w);
          angle += random_between (&state, 0.4, 0.47);
        }
      right += read_green (a, 2 * LINES, CELD_ARROW_DOT);
    }
  CHECK (right >= 0.9 * 30 * 2 * LINES);
}

int
main (void)
{
  RUN (lines_that_meet_without_a_dot);
  return DONE;
}
