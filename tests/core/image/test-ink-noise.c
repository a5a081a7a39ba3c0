/* The ripple that compression leaves beside dark lines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/ink-steps.h"

enum { SIDE = 100, LINE = 50 };

static float   contrast_of[SIDE * SIDE];
static uint8_t around_of[SIDE * SIDE];

/* The ripple beside a line that is `length` pixels long; two rows away the contrast goes up and down by `ripple`. */
static float
echo (int length, float ripple)
{
  CeldPlane contrast = { SIDE, SIDE, SIDE, contrast_of };
  CeldMask  around = { SIDE, SIDE, SIDE, around_of };

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      {
        bool near = x < length && abs (y - LINE) <= 4;

        CELD_AT (&contrast, x, y) = !near || (abs (y - LINE) == 1) ? 0 : y == LINE ? 1 : x % 2 ? ripple : 0;
        CELD_AT (&around, x, y) = near ? 255 : 0;
      }
  return celd_ink_echo (&contrast, &around, 1);
}

/* Its strength is half the second difference, which of a ripple is its height. */
static void
ripple_beside_a_line (void)
{
  NEAR (echo (90, 0), 0, 0);
  NEAR (echo (90, 0.1f), 0.1, 1.0 / 128);
  NEAR (echo (90, 0.2f), 0.2, 1.0 / 128);
}

/* Pixels of hairlines look like ripple; a few of them must not hide fainter lines. */
static void
too_few_pixels_tell_nothing (void)
{
  NEAR (echo (20, 0.2f), 0, 0);
}

int
main (void)
{
  RUN (ripple_beside_a_line);
  RUN (too_few_pixels_tell_nothing);
  return DONE;
}
