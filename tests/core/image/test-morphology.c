/* Erosion and dilation against their definition, on random pictures of all small sizes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"
#include "image/image.h"

enum { MOST = 40 };

static int
inside (int i, int n)
{
  return i < 0 ? 0 : i < n ? i : n - 1;
}

/* The least, or largest, of the values at most `radius` away. */
static int
extreme (const uint8_t *value, int width, int height, int x, int y, int radius, bool largest)
{
  int found = value[y * width + x];

  for (int v = inside (y - radius, height); v <= inside (y + radius, height); v++)
    for (int u = inside (x - radius, width); u <= inside (x + radius, width); u++)
      if (largest ? value[v * width + u] > found : value[v * width + u] < found)
        found = value[v * width + u];
  return found;
}

static void
as_defined (void)
{
  static uint8_t before[MOST * MOST], after[MOST * MOST], work[8 * MOST * MOST * 2];
  uint32_t       seed = 7;

  for (int turn = 0; turn < 300; turn++)
    {
      int      width = 1 + turn * 7 % MOST, height = 1 + turn * 11 % MOST, radius = 1 + turn % 15, wrong = 0;
      bool     largest = turn % 2;
      CeldMask mask = { width, height, (size_t) width, after };

      CHECK (celd_erosion_work (width, radius) <= sizeof work);
      for (int i = 0; i < width * height; i++)
        {
          seed = seed * 1664525u + 1013904223u;
          before[i] = after[i] = (uint8_t) (turn % 3 ? seed >> 24 : seed >> 30);
        }
      if (largest)
        celd_dilate_bytes (&mask, radius, work);
      else
        celd_erode_bytes (&mask, radius, work);
      for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
          wrong += after[y * width + x] != extreme (before, width, height, x, y, radius, largest);
      CHECK (wrong == 0);
    }
}

int
main (void)
{
  RUN (as_defined);
  return DONE;
}
