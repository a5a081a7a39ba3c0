/* Grey pixels that show how dark their stroke is, and those that may be the antialiased edge of a darker one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>

/* Whether the pixel is inside a stroke, not on its antialiased edge: its 3x3 neighbours differ by a tenth at most. */
static bool
is_solid (const CeldPlane *contrast, int x, int y)
{
  float c = CELD_AT (contrast, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < contrast->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < contrast->width; u++)
      if (fabsf (CELD_AT (contrast, u, v) - c) > 0.1f * c)
        return false;
  return true;
}

/* The contrast at a pixel, or at the one nearest to it in the picture. */
static float
nearest_contrast (const CeldPlane *contrast, int x, int y)
{
  x = x < 0 ? 0 : x < contrast->width ? x : contrast->width - 1;
  y = y < 0 ? 0 : y < contrast->height ? y : contrast->height - 1;
  return CELD_AT (contrast, x, y);
}

/* Whether there is paper on both sides of a pixel, and between less ink than that of a black line a pixel wide; or as
 * much, if the line lies between two rows of pixels, so that neither has most of it. */
static bool
is_thin_ridge (const CeldPlane *contrast, int x, int y, float dark)
{
  static const struct { int x, y; float apart; } across[] = { { 1, 0, 1 }, { 0, 1, 1 },
                                                              { 1, 1, 1.414f }, { 1, -1, 1.414f } };
  float c = CELD_AT (contrast, x, y), most = (c < 0.6f * dark ? 1.2f : 0.8f) * dark;

  for (int i = 0; i < 4; i++)
    {
      int   u = across[i].x, v = across[i].y;
      float before = nearest_contrast (contrast, x - u, y - v), after = nearest_contrast (contrast, x + u, y + v);

      if (celd_most (before, after) <= c && across[i].apart * (before + c + after) < most &&
          nearest_contrast (contrast, x - 2 * u, y - 2 * v) < 0.25f * c &&
          nearest_contrast (contrast, x + 2 * u, y + 2 * v) < 0.25f * c)
        return true;
    }
  return false;
}

/* Whether the pixel is on a line thinner than a pixel, which is pale because it covers its pixels in part; not at the
 * end or the corner of a dark stroke, where something around is much darker. */
static bool
is_hairline (const CeldPlane *contrast, int x, int y, float dark)
{
  if (!is_thin_ridge (contrast, x, y, dark))
    return false;
  for (int v = -2; v <= 2; v++)
    for (int u = -2; u <= 2; u++)
      if (CELD_AT (contrast, x, y) < 0.6f * nearest_contrast (contrast, x + u, y + v))
        return false;
  return true;
}

bool
celd_ink_shows_level (const CeldPlane *contrast, int x, int y, float dark)
{
  return is_solid (contrast, x, y) || is_hairline (contrast, x, y, dark);
}
