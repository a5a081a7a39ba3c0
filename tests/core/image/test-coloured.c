/* Which drawings are coloured: those with fills, large ones or a few flat ones; neither stains nor grain.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/coloured-steps.h"

enum { SIDE = 400 };

static uint8_t of[3][SIDE * SIDE];

/* Whether a white page with an orange square in its middle is coloured.  The square's colour goes up and down by
 * `grain` between pixels, and its paleness rises by `slope` a pixel away from its middle. */
static bool
is_coloured (int side, int grain, int slope)
{
  static const int orange[3] = { 240, 150, 60 };
  CeldMask         channel[3];

  for (int c = 0; c < 3; c++)
    {
      for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
          {
            int away = abs (x - SIDE / 2) > abs (y - SIDE / 2) ? abs (x - SIDE / 2) : abs (y - SIDE / 2);
            int tone = orange[c] + slope * away + ((x + y) % 2 ? grain : -grain);

            of[c][y * SIDE + x] = (uint8_t) (2 * away >= side || tone > 250 ? 250 : tone);
          }
      channel[c] = (CeldMask) { SIDE, SIDE, SIDE, of[c] };
    }
  return celd_is_coloured (channel);
}

static void
large_fills (void)
{
  CHECK (!is_coloured (0, 0, 0));
  CHECK (is_coloured (100, 0, 0));
  CHECK (is_coloured (100, 5, 0));
}

/* A square of 48 pixels is one part in 70 of the page. */
static void
few_flat_fills (void)
{
  CHECK (is_coloured (48, 0, 0));
  CHECK (is_coloured (48, 1, 0));
  CHECK (!is_coloured (48, 5, 0)); /* grain */
  CHECK (!is_coloured (48, 0, 2)); /* a stain */
  CHECK (!is_coloured (20, 0, 0)); /* too small for a fill */
}

int
main (void)
{
  RUN (large_fills);
  RUN (few_flat_fills);
  return DONE;
}
