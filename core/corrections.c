/* The artist's strokes over ink, by their colours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <string.h>

CeldStatus
celd_corrections_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels)
{
  if (!CELD_SAME_SIZE (paint, labels))
    return CELD_BAD_SIZE;
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *pixel = CELD_RGBA (paint, x, y);
        uint32_t      *label = &CELD_AT (labels, x, y);

        if (x && !memcmp (pixel, pixel - 4, 4))
          *label = label[-1];
        else
          *label = pixel[3] >= 128 ? celd_palette_find (palette, pixel) : 0;
      }
  return CELD_OK;
}
