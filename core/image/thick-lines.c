/* Thick strokes of a coloured drawing: what is much darker than what lies on both sides of it, within a wide window,
 * and not lighter than that: then it is a fill between lines.
 *
 * Of each channel, each pixel is compared with the closing and the opening of squares of 2 x 2 pixels: for a wide
 * window they are as good as those of pixels, at a quarter of the cost.  For the closing a square is as light as its
 * lightest pixel, so squares at the edge of a dark area count as light; therefore it is eroded by one square more.  For
 * the opening it is the other way round.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

#define MUCH_DARKER   1 /* much darker than the closing in some channel */
#define BETWEEN_LINES 2 /* lighter than the opening in some channel */

/* The lightest pixel of each square in two rows. */
CELD_CLONES static void
halve_rows (const uint8_t *restrict upper, const uint8_t *restrict lower, int width, uint8_t *restrict half)
{
  for (int i = 0; i < width / 2; i++)
    {
      uint8_t left = upper[2 * i] > lower[2 * i] ? upper[2 * i] : lower[2 * i];
      uint8_t right = upper[2 * i + 1] > lower[2 * i + 1] ? upper[2 * i + 1] : lower[2 * i + 1];

      half[i] = left > right ? left : right;
    }
  if (width & 1)
    half[width / 2] = upper[width - 1] > lower[width - 1] ? upper[width - 1] : lower[width - 1];
}

/* The closing of the squares of a channel. */
static void
close_squares (const CeldMask *value, int radius, void *work, CeldMask *half)
{
  for (int y = 0; y < half->height; y++)
    {
      int lower = 2 * y + 1 < value->height ? 2 * y + 1 : 2 * y;

      halve_rows (&CELD_AT (value, 0, 2 * y), &CELD_AT (value, 0, lower), value->width, &CELD_AT (half, 0, y));
    }
  celd_dilate_bytes (half, radius / 2, work);
  celd_erode_bytes (half, radius / 2 + 1, work);
}

CELD_CLONES static void
mark_dark (const uint8_t *restrict value, const uint8_t *restrict half, int width, uint8_t *restrict thick)
{
  for (int x = 0; x < width; x++)
    {
      int closed = half[x / 2], paper = closed > CELD_DARKEST_FILL ? closed : CELD_DARKEST_FILL;

      thick[x] |= 2 * (closed - value[x]) >= paper ? MUCH_DARKER : 0;
    }
}

/* In an inverted channel, of which `half` has the closing. */
CELD_CLONES static void
mark_between (const uint8_t *restrict inverted, const uint8_t *restrict half, int width, int faintest,
              uint8_t *restrict thick)
{
  for (int x = 0; x < width; x++)
    {
      int fill = 255 - inverted[x], paper = fill > CELD_MIDDLE_FILL ? fill : CELD_MIDDLE_FILL;

      thick[x] |= 255 * (half[x / 2] - inverted[x]) >= faintest * paper ? BETWEEN_LINES : 0;
    }
}

CeldStatus
celd_thick_lines (CeldMask channel[3], int radius, int faintest, const CeldHost *host, void *work, CeldMask *spare,
                  CeldMask *thick)
{
  int        width = (thick->width + 1) / 2, height = (thick->height + 1) / 2;
  CeldMask   half = { width, height, (size_t) width, spare->data };
  CeldStatus status = CELD_OK;

  memset (thick->data, 0, (size_t) thick->width * (size_t) thick->height);
  for (int c = 0; c < 3 && status == CELD_OK; c++)
    {
      close_squares (&channel[c], radius, work, &half);
      for (int y = 0; y < thick->height; y++)
        mark_dark (&CELD_AT (&channel[c], 0, y), &CELD_AT (&half, 0, y / 2), thick->width, &CELD_AT (thick, 0, y));
      celd_invert_bytes (&channel[c]);
      close_squares (&channel[c], radius, work, &half);
      for (int y = 0; y < thick->height; y++)
        mark_between (&CELD_AT (&channel[c], 0, y), &CELD_AT (&half, 0, y / 2), thick->width, faintest,
                      &CELD_AT (thick, 0, y));
      celd_invert_bytes (&channel[c]);
      status = celd_progress (host, (c + 1) / 3.0);
    }
  for (size_t i = 0; i < (size_t) thick->width * (size_t) thick->height; i++)
    thick->data[i] = thick->data[i] == MUCH_DARKER;
  return status;
}
