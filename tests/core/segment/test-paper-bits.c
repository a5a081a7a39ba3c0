/* Paper as bits: counts of runs on random drawings, and after the drawing has changed somewhere.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"
#include "segment/basins.h"

enum { W = 45, H = 21 };

/* All runs of all rows against the drawing's pixels. */
static void
check_counts (const CeldPlane *ink, const CeldBasins *basins)
{
  int wrong = 0;

  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      {
        uint32_t n = 0;

        wrong += celd_paper_count (basins, y, x, x) != 0;
        for (int end = x + 1; end <= ink->width; end++)
          {
            n += celd_is_paper (CELD_AT (ink, end - 1, y));
            wrong += celd_paper_count (basins, y, x, end) != n;
          }
      }
  NEAR (wrong, 0, 0);
}

static void
counts_are_those_of_the_drawing (void)
{
  uint32_t state = 3;

  for (int round = 0; round < 40; round++)
    {
      float      pixel[(W + 2) * H];
      int        w = W - round % 17, h = H - round % 9;
      CeldPlane  ink = { w, h, W + 2, pixel };
      CeldRect   changed = { .x = (int) check_random (&state, (uint32_t) w) };
      CeldBasins basins = { .width = w, .height = h };

      changed.y = (int) check_random (&state, (uint32_t) h);
      for (int p = 0; p < (W + 2) * H; p++)
        pixel[p] = check_random (&state, 7) ? (float) check_random (&state, 21) / 20 : NAN;
      CHECK (celd_paper_new (&ink, NULL, &basins.paper) == CELD_OK);
      check_counts (&ink, &basins);
      celd_paper_update (&ink, &changed, NULL, basins.paper); /* nothing has changed */
      check_counts (&ink, &basins);
      changed.width  = 1 + (int) check_random (&state, (uint32_t) (w - changed.x));
      changed.height = 1 + (int) check_random (&state, (uint32_t) (h - changed.y));
      for (int y = changed.y; y < changed.y + changed.height; y++)
        for (int x = changed.x; x < changed.x + changed.width; x++)
          CELD_AT (&ink, x, y) = (float) check_random (&state, 2);
      celd_paper_update (&ink, &changed, NULL, basins.paper);
      check_counts (&ink, &basins);
      celd_free (basins.paper);
    }
}

int
main (void)
{
  RUN (counts_are_those_of_the_drawing);
  return DONE;
}
