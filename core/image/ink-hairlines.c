/* Antialiased lines of one pixel that lie between two rows or columns of pixels.
 *
 * Each of the two pixels across such a line has half of its ink, so that both are paper by a little, and a line that
 * looks closed is open for a pixel or, along an axis, for many.  The darker pixel gets the ink of both.  Elsewhere a
 * pixel across a line of one pixel has more than half of its ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#define LEAST_BREADTH 0.75f /* pixels: of a line, ink across it; chosen */
#define PAPER_BESIDE  0.9f  /* of ink: no darker beside a line; chosen */

/* Joins the ink of two pixels side by side, if it is that of a line with paper on both sides. */
static void
join_ink (float before, float *first, float *second, float after)
{
  float breadth = 2 - *first - *second, *darker = *first <= *second ? first : second;

  if (celd_is_paper (*darker) && breadth >= LEAST_BREADTH && before > PAPER_BESIDE && after > PAPER_BESIDE)
    *darker = 1 - celd_least (breadth, 1);
}

void
celd_ink_join_hairlines (CeldPlane *ink)
{
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      {
        float *p = &CELD_AT (ink, x, y);

        if (!celd_is_paper (*p) || *p > PAPER_BESIDE)
          continue;
        if (x > 0 && x + 2 < ink->width)
          join_ink (p[-1], p, p + 1, p[2]);
        if (y > 0 && y + 2 < ink->height)
          join_ink (CELD_AT (ink, x, y - 1), p, &CELD_AT (ink, x, y + 1), CELD_AT (ink, x, y + 2));
      }
}
