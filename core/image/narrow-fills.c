/* Fills of a coloured drawing that are narrow between lines: tips, stripes, thin limbs.  With the lines on both sides
 * they fit into the window by which lines are found, so that they are darker than what is around, as a wide line is.
 *
 * They are told apart from it because they are lighter than what is on both sides of them: than the opening by the same
 * window, by the contrast that a line needs.  A pale line between two dark ones is as well, but there is lighter paper
 * next to it: within half of the window's radius, so that what is beyond the dark lines does not count.  Only what is
 * at least three pixels wide counts: less may be antialiased pixels, and so may be all of a thin line.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <string.h>

/* From what is darker than its closing in the inverted picture to its contrast in the picture itself, 0 .. 255. */
CELD_CLONES static void
measure_lightness_of_piece (const uint8_t *restrict inverted, size_t n, uint8_t *restrict closed)
{
  uint8_t value[CELD_PIECE]; /* apart, because compilers make no vectors of it otherwise */

  for (size_t i = 0; i < n; i++)
    value[i] = inverted[i] < 255 - CELD_MIDDLE_FILL ? (uint8_t) ~inverted[i] : CELD_MIDDLE_FILL;
  for (size_t i = 0; i < n; i++)
    {
      int light = (int) (255.0f * (float) (closed[i] - inverted[i]) / (float) value[i] + 0.5f);

      closed[i] = (uint8_t) (light < 255 ? light : 255);
    }
}

static void
measure_lightness (const uint8_t *inverted, size_t n, uint8_t *closed)
{
  for (size_t i = 0; i < n; i += CELD_PIECE)
    {
      size_t piece = n - i < CELD_PIECE ? n - i : CELD_PIECE;

      if (memcmp (inverted + i, closed + i, piece)) /* few differ */
        measure_lightness_of_piece (inverted + i, piece, closed + i);
      else
        memset (closed + i, 0, piece);
    }
}

/* Replaces the largest lightness near by with 1 where a pixel is nearly as light as that, else with 0. */
CELD_CLONES static void
keep_lightest (const uint8_t *restrict light, int faintest, size_t n, uint8_t *restrict around)
{
  for (size_t i = 0; i < n; i++)
    around[i] = light[i] >= faintest && 5 * light[i] >= 3 * around[i];
}

CELD_CLONES static void
clear_contrast (const uint8_t *restrict fill, size_t n, uint8_t *restrict contrast)
{
  for (size_t i = 0; i < n; i++)
    contrast[i] = fill[i] ? 0 : contrast[i];
}

void
celd_clear_narrow_fills (CeldMask *lightness, int radius, int faintest, void *work, CeldMask *light, CeldMask *fill,
                         CeldMask *contrast)
{
  size_t n = (size_t) lightness->width * (size_t) lightness->height;

  celd_invert_bytes (lightness);
  celd_close_bytes (lightness, radius, work, light);
  measure_lightness (lightness->data, n, light->data);
  memcpy (fill->data, light->data, n);
  celd_dilate_bytes (fill, (radius + 1) / 2, work);
  keep_lightest (light->data, faintest, n, fill->data);
  celd_erode_bytes (fill, 1, work);
  celd_dilate_bytes (fill, 1, work);
  clear_contrast (fill->data, n, contrast->data);
}
