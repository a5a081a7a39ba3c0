/* The weights of the exact program.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

static void
weights_follow_the_formula (void)
{
  /* Differences: 0.5 0.5 / 0 0 in rows, 0.5 0 0.5 in columns: the mean of their squares is 1 / 7. */
  float     value[] = { 0.5f, 1, 0.5f, 1, 1, 1 }, east[6], south[6];
  CeldPlane ink = { 3, 2, 3, value };
  double    mean, step;

  CHECK (celd_affinities (&ink, 1, 1e-6f, NULL, east, south, &mean) == CELD_OK);
  NEAR (mean, 1.0 / 7, 1e-7);
  step = exp (-0.25 * 7);
  NEAR (east[0], step, 1e-7);
  NEAR (east[1], step, 1e-7);
  NEAR (east[3], step, 1e-7); /* of its own 1, but not round it */
  NEAR (south[0], step, 1e-7);
  NEAR (south[1], step, 1e-7);
  CHECK (celd_affinities (&ink, 2, 1e-6f, NULL, east, south, &mean) == CELD_OK);
  NEAR (mean, 1.0 / 7, 1e-7);
  NEAR (east[0], exp (-0.25 * 3.5), 1e-7);
}

static void
weights_end_with_the_picture (void)
{
  float     value[] = { 0.5f, 1, 0.5f, 1, 1, 1 }, east[6], south[6];
  CeldPlane ink = { 3, 2, 3, value };
  double    mean;

  CHECK (celd_affinities (&ink, 1, 1e-6f, NULL, east, south, &mean) == CELD_OK);
  CHECK (east[2] == 0 && east[5] == 0 && south[3] == 0 && south[4] == 0 && south[5] == 0);
}

static void
weights_have_a_floor (void)
{
  float     value[100], east[100], south[100];
  CeldPlane ink = { 100, 1, 100, value };
  double    mean;

  for (int x = 0; x < 100; x++)
    value[x] = x != 40; /* sigma is 2 / 99, and exp (-49.5) next to nothing */
  CHECK (celd_affinities (&ink, 1, 1e-4f, NULL, east, south, &mean) == CELD_OK);
  CHECK (east[38] == 1 && east[39] == 1e-4f && east[40] == 1e-4f && east[41] == 1);
}

static void
an_empty_page_holds_together (void)
{
  float     value[] = { 1, 1, NAN, 1 }, east[4], south[4];
  CeldPlane ink = { 2, 2, 2, value };
  double    mean;

  CHECK (celd_affinities (&ink, 1, 1e-6f, NULL, east, south, &mean) == CELD_OK);
  CHECK (mean == 0 && east[0] == 1 && east[2] == 1 && south[0] == 1 && south[1] == 1);
}

/* An antialiased border that is nearly level: between paper above and ink below it fades in steps of 1/20. */
static void
fading_lines_are_no_way_through (void)
{
  float     value[3 * 21], east[3 * 21], south[3 * 21];
  CeldPlane ink = { 21, 3, 21, value };
  double    mean;

  for (int x = 0; x < 21; x++)
    {
      value[x]      = 1;
      value[21 + x] = (float) x / 20;
      value[42 + x] = 0;
    }
  CHECK (celd_affinities (&ink, 0.01f, 1e-6f, NULL, east, south, &mean) == CELD_OK);
  for (int x = 0; x < 20; x++)
    CHECK (east[21 + x] == 1e-6f);
}

int
main (void)
{
  RUN (weights_follow_the_formula);
  RUN (weights_end_with_the_picture);
  RUN (weights_have_a_floor);
  RUN (fading_lines_are_no_way_through);
  RUN (an_empty_page_holds_together);
  return DONE;
}
