/* The artist's strokes over ink, by their colours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <string.h>

CeldStatus
celd_corrections_read (const CeldPaint *paint, const CeldPalette *palette, CeldLabels *labels)
{
  uint8_t  last[4] = { 0 };
  uint32_t label = 0;

  if (!CELD_SAME_SIZE (paint, labels))
    return CELD_BAD_SIZE;
  for (int y = 0; y < paint->height; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *pixel = CELD_RGBA (paint, x, y);

        if (memcmp (pixel, last, 4))
          {
            memcpy (last, pixel, 4);
            label = pixel[3] >= 128 ? celd_palette_find (palette, pixel) : 0;
          }
        CELD_AT (labels, x, y) = label;
      }
  return CELD_OK;
}
