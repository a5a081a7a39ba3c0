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

int
main (void)
{
  RUN (a_floating_component_keeps_the_mean_of_its_start);
  RUN (a_floating_component_bends_under_its_right_hand_side);
  return DONE;
}
