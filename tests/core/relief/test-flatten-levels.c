/* Levels of regions, of which expanded ones differ in ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

enum { W = 8, H = 1 };

static CeldStatus
flatten (const char *regions, size_t n, float levels[W])
{
  uint32_t   label[W];
  CeldLabels labels = { W, H, W, label };
  CeldPlane  plane = { W, H, W, levels };

  for (int i = 0; i < W; i++)
    label[i] = (uint32_t) (regions[i] - '0');
  return celd_flatten_levels (&labels, n, &plane);
}

static void
each_region_has_its_median (void)
{
  float       levels[] = { 3, 1, 1, 9, 2, 2, 7, 5 };
  const float expected[] = { 1, 1, 1, 2, 2, 2, 7, 7 }; /* of two the higher one */

  CHECK (flatten ("11122233", 3, levels) == CELD_OK);
  CHECK (!memcmp (levels, expected, sizeof levels));
}

/* Regions of any shape; label 0, a region without pixels, infinity and NaN. */
static void
any_levels_will_do (void)
{
  float       levels[] = { -1, 4, NAN, INFINITY, 3, -INFINITY, 0.5f, 2 };
  const float expected[] = { 0.5f, 4, 4, 4, 3, 3, 0.5f, 0.5f };

  CHECK (flatten ("02221100", 3, levels) == CELD_OK);
  CHECK (!memcmp (levels, expected, sizeof levels));
}

static void
bad_input_is_refused (void)
{
  float      levels[W] = { 1, 2, 3, 4, 5, 6, 7, 8 };
  uint32_t   label[2 * W] = { 0 };
  CeldLabels two_rows = { W, 2, W, label };
  CeldPlane  plane = { W, H, W, levels };

  CHECK (flatten ("11111113", 2, levels) == CELD_BAD_VALUE);
  CHECK (celd_flatten_levels (&two_rows, 2, &plane) == CELD_BAD_SIZE);
  for (int i = 0; i < W; i++)
    NEAR (levels[i], i + 1, 0);
}

int
main (void)
{
  RUN (each_region_has_its_median);
  RUN (any_levels_will_do);
  RUN (bad_input_is_refused);
  return DONE;
}
