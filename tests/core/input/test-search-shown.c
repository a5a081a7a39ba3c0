/* Arrows that end where others are straight on, and what shows that they do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shared-ends.h"

/* Three from the middle, two of them in a line: it has a head at either end, so it is two arrows, and the third one shows
 * where they begin. */
static void
a_line_with_two_heads (void)
{
  uint32_t state = 73;
  int      right = 0;

  for (int i = 0; i < 20; i++)
    {
      double w = random_between (&state, 3, 6), angle = random_between (&state, 0, 6.28);
      Arrow  a[3];

      for (int k = 0; k < 3; k++)
        a[k] = spoke (angle + k * 1.5708 + random_between (&state, -0.1, 0.1), random_between (&state, 12, 18) * w, w,
                      CELD_ARROW_HEAD, false, i % 2);
      right += read_green (a, 3, CELD_ARROW_HEAD);
    }
  CHECK (right >= 0.9 * 60);
}

/* One that leads on from where three end, about straight from one of them: its head shows that it is another one. */
static void
straight_on_from_a_head (void)
{
  uint32_t state = 107;
  int      right = 0;

  for (int i = 0; i < 20; i++)
    {
      double w = random_between (&state, 3, 5), angle = random_between (&state, 0, 6.28);
      Arrow  a[4] = { spoke (angle + 3.3416, 16 * w, w, CELD_ARROW_HEAD, false, i % 2) };

      for (int k = 1; k < 4; k++)
        a[k] = spoke (angle + 0.6 * (k - 2), (k == 2 ? 16 : 15) * w, w, CELD_ARROW_HEAD, true, i % 2);
      right += read_green (a, 4, CELD_ARROW_HEAD);
    }
  CHECK (right >= 0.8 * 80);
}

int
main (void)
{
  RUN (a_line_with_two_heads);
  RUN (straight_on_from_a_head);
  return DONE;
}
