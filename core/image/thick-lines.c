/* Thick strokes of a coloured drawing: what is much darker than what lies on both sides of it, within a wide window.
 *
 * Of each channel, the closing of squares of 2 x 2 pixels is compared with each pixel: for a wide window that is as good
 * as the closing of pixels, at a quarter of its cost.  A square is as light as its lightest pixel, so squares at the edge
 * of a dark area count as light; therefore the closing is eroded by one square more.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

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

static void
halve (const CeldMask *value, CeldMask *half)
{
  for (int y = 0; y < half->height; y++)
    {
      int lower = 2 * y + 1 < value->height ? 2 * y + 1 : 2 * y;

      halve_rows (&CELD_AT (value, 0, 2 * y), &CELD_AT (value, 0, lower), value->width, &CELD_AT (half, 0, y));
    }
}

/* Marks pixels with at least half of the contrast of black. */
CELD_CLONES static void
mark_row (const uint8_t *restrict value, const uint8_t *restrict half, int width, uint8_t *restrict thick)
{
  for (int x = 0; x < width; x++)
    {
      int closed = half[x / 2], paper = closed > CELD_DARKEST_FILL ? closed : CELD_DARKEST_FILL;

      thick[x] |= 2 * (closed - value[x]) >= paper;
    }
}

CeldStatus
celd_thick_lines (const CeldMask channel[3], int radius, const CeldHost *host, void *work, CeldMask *spare,
                  CeldMask *thick)
{
  int        width = (thick->width + 1) / 2, height = (thick->height + 1) / 2;
  CeldMask   half = { width, height, (size_t) width, spare->data };
  CeldStatus status = CELD_OK;

  memset (thick->data, 0, (size_t) thick->width * (size_t) thick->height);
  for (int c = 0; c < 3 && status == CELD_OK; c++)
    {
      halve (&channel[c], &half);
      celd_dilate_bytes (&half, radius / 2, work);
      celd_erode_bytes (&half, radius / 2 + 1, work);
      for (int y = 0; y < thick->height; y++)
        mark_row (&CELD_AT (&channel[c], 0, y), &CELD_AT (&half, 0, y / 2), thick->width, &CELD_AT (thick, 0, y));
      status = celd_progress (host, (c + 1) / 3.0);
    }
  return status;
}
