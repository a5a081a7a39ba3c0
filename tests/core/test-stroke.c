/* Stroke widths, and the paper beside a stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "private.h"

static void
stroke_widths (void)
{
  const char *const thick[] = { ".......###......", ".......###......", ".......###......", ".......###......", NULL };
  const char *const none[] = { "....", NULL };
  CeldPlane a = art_plane (thick), b = art_plane (none);

  CHECK (celd_stroke_width (&a) >= 3 && celd_stroke_width (&a) <= 4);
  CHECK (celd_stroke_width (&b) == 0);
  free (a.data), free (b.data);
}

static void
the_nearest_paper (void)
{
  const char *const rows[] = {
    "#####..",
    "#####..",
    "#####..",
    ".####..", NULL };
  CeldPlane ink = art_plane (rows);
  int       x = 6, y = 1;

  CHECK (celd_paper_near (&ink, 0, &x, &y) && x == 6 && y == 1); /* is paper */
  x = 3;
  CHECK (!celd_paper_near (&ink, 1, &x, &y) && x == 3 && y == 1);
  CHECK (celd_paper_near (&ink, 2, &x, &y) && x == 5 && y == 1);
  x = 1, y = 2;
  CHECK (!celd_paper_near (&ink, 1, &x, &y));                    /* a diagonal step is longer than 1 */
  CHECK (celd_paper_near (&ink, 2, &x, &y) && x == 0 && y == 3);
  x = y = 0;
  CHECK (celd_paper_near (&ink, 256, &x, &y) && x == 0 && y == 3); /* farther than the picture is large */
  CELD_AT (&ink, 2, 2) = NAN;
  x = y = 2;
  CHECK (celd_paper_near (&ink, 9, &x, &y) && x == 2 && y == 2); /* NaN is paper */
  free (ink.data);
}

int
main (void)
{
  RUN (stroke_widths);
  RUN (the_nearest_paper);
  return DONE;
}
