/* A graph that is renewed after every edit is the one that is built anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-drawings.h"

static void
renewed_is_new (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 90 }, { 90, 1 }, { 40, 30 }, { 150, 140 }, { 400, 70 }, { 420, 400 } };
  uint32_t state = 23;
  int      wrong = 0;

  for (size_t i = 0; i < sizeof size / sizeof *size; i++)
    for (int round = 0; round < 12; round++)
      {
        int        w = size[i][0], h = size[i][1];
        size_t     stride = (size_t) w + check_random (&state, 4);
        CeldPlane  ink = { w, h, stride, calloc (stride * (size_t) h, sizeof (float)) };
        CeldBasins kept = { 0 }, made = { 0 };

        if (round & 1)
          draw_cells (&state, 20 + 4 * round, 1 + round % 5, &ink);
        else
          draw (&state, round, &ink);
        CHECK (celd_basins_new (&ink, THRESHOLD, NULL, &kept) == CELD_OK);
        for (int k = 0; k < 12; k++)
          {
            CeldRect changed = edit (&state, &ink);

            CHECK (celd_basins_renew (&ink, &changed, NULL, &kept) == CELD_OK);
            CHECK (celd_basins_new (&ink, THRESHOLD, NULL, &made) == CELD_OK);
            wrong += differences (&kept, &made);
            celd_basins_clear (&made);
          }
        celd_basins_clear (&kept);
        free (ink.data);
      }
  CHECK (wrong == 0);
}

int
main (void)
{
  RUN (renewed_is_new);
  return DONE;
}
