/* Components of a Laplacian system that nothing holds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "systems.h"

static void
a_floating_component_keeps_the_mean_of_its_start (void)
{
  static const int size[][2] = { { 1, 1 }, { 1, 50 }, { 30, 20 }, { 250, 220 } };

  for (size_t k = 0; k < sizeof size / sizeof *size; k++)
    {
      System   s = system_new (size[k][0], size[k][1], 1, 1);
      uint32_t seed = 5;
      double   left = 0, n = 0;
      int      wall = s.w / 2;

      for (int y = 0; y < s.h; y++)
        for (int x = 0; x < s.w; x++)
          {
            s.x[y * s.w + x] = 3 + (float) check_random (&seed, 100) / 100;
            if (x == wall)
              s.east[y * s.w + x] = 0;
            left += x <= wall ? (double) s.x[y * s.w + x] : 0;
            n    += x <= wall;
          }
      CHECK (solve (&s, 1e-5).converged);
      for (int y = 0; y < s.h; y++)
        for (int x = 0; x <= wall; x++)
          NEAR (s.x[y * s.w + x], left / n, 1e-4);
      system_free (&s);
    }
}

static void
a_floating_component_bends_under_its_right_hand_side (void)
{
  System s = system_new (130, 110, 1, 1);

  s.b[0] = 1;
  s.b[129] = -1;
  CHECK (solve (&s, 1e-6).converged);
  for (int y = 0; y < s.h; y++)
    NEAR (s.x[y * s.w] + s.x[y * s.w + 129], 0, 2e-5);
  NEAR ((double) s.x[0] * 2 - (double) s.x[1] - (double) s.x[130], 1, 1e-3);
  system_free (&s);
}

/* Lines one pixel wide, across and down, among pixels without an edge. */
static void
a_line_among_lone_pixels_floats_and_they_stay (void)
{
  enum { SIDE = 160 };
  System   s = system_new (SIDE, SIDE, 1, 1);
  uint32_t seed = 7;
  double   start = 0;

  memset (s.east, 0, SIDE * SIDE * sizeof (float));
  memset (s.south, 0, SIDE * SIDE * sizeof (float));
  for (int i = 0; i < SIDE * SIDE; i++)
    s.x[i] = (float) check_random (&seed, 100);
  for (int k = 0; k < 100; k++)
    {
      s.south[(k + 20) * SIDE + 50] = 1; /* down from row 20 to 120 of column 50, on to column 150 of row 120 */
      s.east[120 * SIDE + 50 + k] = 1;
    }
  for (int k = 0; k < 100; k++)
    start += (double) s.x[(k + 20) * SIDE + 50] + (double) s.x[120 * SIDE + 51 + k];
  start += (double) s.x[120 * SIDE + 50];
  CHECK (solve (&s, 1e-6).converged);
  seed = 7;
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      int  x = i % SIDE, y = i / SIDE, before = (int) check_random (&seed, 100);
      bool line = (x == 50 && y >= 20 && y <= 120) || (y == 120 && x >= 50 && x <= 150);

      NEAR (s.x[i], line ? start / 201 : before, 1e-3);
    }
  system_free (&s);
}

int
main (void)
{
  RUN (a_floating_component_keeps_the_mean_of_its_start);
  RUN (a_floating_component_bends_under_its_right_hand_side);
  RUN (a_line_among_lone_pixels_floats_and_they_stay);
  return DONE;
}
