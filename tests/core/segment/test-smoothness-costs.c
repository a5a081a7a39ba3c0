/* What a boundary between two pixels costs.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "segment/basins.h"

static CeldSmoothnessCosts
costs_of (int width, int height, float threshold)
{
  CeldSmoothnessCosts costs;

  celd_smoothness_costs_new (width, height, threshold, &costs);
  return costs;
}

/* V = 1 + K g with K = 2 (width + height), in units of 16. */
static void
paper_costs_the_perimeter (void)
{
  CeldSmoothnessCosts costs = costs_of (30, 20, 0.25f);

  NEAR (celd_smoothness_cost (&costs, 1, 1, 0, 0, false), 16 * (1 + 100), 0);
  NEAR (celd_smoothness_cost (&costs, 0, 0, 1, 1, false), 16, 0);
  NEAR (celd_smoothness_cost (&costs, 0.2f, 1, 0, 0, false), 16, 0);
  NEAR (celd_smoothness_cost (&costs, 0.625f, 0.625f, 0, 0, false), 16 * (1 + 100 / 8.), 1);
}

static void
the_darker_pixel_counts (void)
{
  CeldSmoothnessCosts costs = costs_of (300, 200, 0);
  uint32_t            state = 1;

  for (int i = 0; i < 1000; i++)
    {
      float   a = (float) check_random (&state, 1001) / 1000, b = (float) check_random (&state, 1001) / 1000;
      float   least = a < b ? a : b;
      int32_t cost = celd_smoothness_cost (&costs, a, b, 0, 0, false);

      CHECK (cost == celd_smoothness_cost (&costs, b, a, 0, 0, false) &&
             cost == celd_smoothness_cost (&costs, least, least, 0, 0, false));
      CHECK (cost >= 16 && cost <= celd_smoothness_cost (&costs, 1, 1, 0, 0, false));
    }
}

/* A boundary runs along the middle of a line: there it costs least, but never nothing. */
static void
deep_ink_costs_less (void)
{
  CeldSmoothnessCosts costs = costs_of (300, 200, 0.25f);
  int32_t             last = celd_smoothness_cost (&costs, 0, 0, 1, 1, false);

  for (int depth = 2; depth < 2000; depth++)
    {
      int32_t cost = celd_smoothness_cost (&costs, 0, 0, depth, depth + 7, false);

      CHECK (cost > 0 && cost <= last && cost == celd_smoothness_cost (&costs, 0, 0, depth + 7, depth, false));
      last = cost;
    }
  CHECK (last < celd_smoothness_cost (&costs, 0, 0, 4, 4, false));
  CHECK (celd_smoothness_cost (&costs, 0, 0, 100, 1, false) == celd_smoothness_cost (&costs, 0, 0, 1, 1, false));
}

static void
paper_along_the_frame_stands_for_a_margin (void)
{
  CeldSmoothnessCosts costs = costs_of (640, 640, 0.25f);

  NEAR (celd_smoothness_cost (&costs, 1, 1, 0, 0, true), 81. * celd_smoothness_cost (&costs, 1, 1, 0, 0, false), 0);
  CHECK (celd_smoothness_cost (&costs, 0, 0, 1, 1, true) == celd_smoothness_cost (&costs, 0, 0, 1, 1, false));
}

static void
not_a_number_counts_as_paper (void)
{
  CeldSmoothnessCosts costs = costs_of (30, 20, 0.25f);

  CHECK (celd_smoothness_cost (&costs, NAN, 1, 0, 0, false) == celd_smoothness_cost (&costs, 1, 1, 0, 0, false));
  CHECK (celd_smoothness_cost (&costs, NAN, 0, 0, 1, false) == celd_smoothness_cost (&costs, 1, 0, 0, 1, false));
  CHECK (celd_smoothness_cost (&costs, 7, 9, 0, 0, false) == celd_smoothness_cost (&costs, 1, 1, 0, 0, false));
  CHECK (celd_smoothness_cost (&costs, -3, 1, 1, 0, false) == celd_smoothness_cost (&costs, 0, 1, 1, 0, false));
}

/* The largest picture does not overflow, margin and all, also where a flow and what it returns are added up. */
static void
costs_of_the_largest_page_do_not_overflow (void)
{
  CeldSmoothnessCosts costs = costs_of (CELD_MAX_SIDE, CELD_MAX_SIDE, 0);

  NEAR (celd_smoothness_cost (&costs, 1, 1, 0, 0, false), 16. + 16. * 80000, 0);
  CHECK (celd_smoothness_cost (&costs, 1, 1, 0, 0, true) > 400 * celd_smoothness_cost (&costs, 1, 1, 0, 0, false));
  CHECK (celd_smoothness_cost (&costs, 1, 1, 0, 0, true) <= INT32_MAX / 4);
}

int
main (void)
{
  RUN (paper_costs_the_perimeter);
  RUN (the_darker_pixel_counts);
  RUN (deep_ink_costs_less);
  RUN (paper_along_the_frame_stands_for_a_margin);
  RUN (not_a_number_counts_as_paper);
  RUN (costs_of_the_largest_page_do_not_overflow);
  return DONE;
}
