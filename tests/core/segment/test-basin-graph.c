/* A graph that is renewed after every edit is the one that is built anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basin-drawings.h"
#include "segment/basin-steps.h"
#include "segment/basins.h"

static void
an_updated_graph_equals_a_new_one (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 90 }, { 90, 1 }, { 40, 30 }, { 150, 140 }, { 400, 70 }, { 420, 400 } };
  uint32_t         state = 23;
  int              wrong = 0;

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
        for (int k = 0; k < (w * h > 100000 ? 30 : 12); k++)
          {
            CeldRect changed = edit (&state, &ink);

            CHECK (celd_basins_update (&ink, &changed, NULL, &kept) == CELD_OK);
            CHECK (celd_basins_new (&ink, THRESHOLD, NULL, &made) == CELD_OK);
            wrong += differences (&kept, &made);
            celd_basins_clear (&made);
          }
        celd_basins_clear (&kept);
        free (ink.data);
      }
  CHECK (wrong == 0);
}

/* Pairs of one boundary that are counted separately: sums, and the place of the saddle, the first of equal ones. */
static void
parts_of_a_boundary_add_up_in_any_order (void)
{
  CeldBasinBoundary sum = { .a = 1, .b = 2, .opening = 3, .saddle = 9, .x = 5, .y = 7, .south = true, .cost = 100,
                            .weakness = 7 };
  CeldBasinBoundary lower = { .opening = 1, .saddle = 4, .x = 1, .y = 1, .frame = true, .cost = 10, .weakness = 5 };
  CeldBasinBoundary later = { .saddle = 9, .x = 6, .y = 7, .cost = 1 },
  east = { .saddle = 9, .x = 5, .y = 7, .cost = 1 };
  CeldBasinBoundary earlier = { .saddle = 9, .x = 9, .y = 6, .south = true }, wider = { .saddle = 16, .x = 8, .y = 8 };

  celd_basin_boundary_add (&sum, &lower);
  celd_basin_boundary_add (&sum, &later);
  CHECK (sum.a == 1 && sum.b == 2 && sum.opening == 4 && sum.cost == 111 && sum.frame && sum.weakness == 12);
  CHECK (sum.saddle == 9 && sum.x == 5 && sum.y == 7 && sum.south);
  celd_basin_boundary_add (&sum, &east);
  CHECK (sum.saddle == 9 && sum.x == 5 && sum.y == 7 && !sum.south && sum.cost == 112);
  celd_basin_boundary_add (&sum, &earlier);
  CHECK (sum.saddle == 9 && sum.x == 9 && sum.y == 6 && sum.south);
  celd_basin_boundary_add (&sum, &wider);
  CHECK (sum.saddle == 16 && sum.x == 8 && sum.y == 8 && !sum.south);
}

int
main (void)
{
  RUN (an_updated_graph_equals_a_new_one);
  RUN (parts_of_a_boundary_add_up_in_any_order);
  return DONE;
}
