/* How opaque each pixel of an arrows layer is.
 *
 * A layer with transparency has its alpha.  In an opaque layer the commonest colour is taken for paper, and a pixel's
 * opacity is its largest difference from that colour in any channel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "input/arrows.h"

#include <stdlib.h>

#define KEPT_BITS 5 /* of each channel, when colours are counted: similar ones are counted together */

int
celd_arrow_opacity (const CeldArrowLayer *layer, int x, int y)
{
  const uint8_t *c = CELD_RGBA (layer->paint, x, y);
  int            contrast = 0;

  if (!layer->opaque)
    return c[3];
  for (int i = 0; i < 3; i++)
    if (abs (c[i] - layer->paper[i]) > contrast)
      contrast = abs (c[i] - layer->paper[i]);
  return contrast;
}

CeldStatus
celd_arrow_layer_new (const CeldPaint *paint, CeldArrowLayer *layer)
{
  uint32_t *count = celd_alloc0 (1 << 3 * KEPT_BITS, sizeof *count), most = 0;

  if (!count)
    return CELD_NO_MEMORY;
  *layer = (CeldArrowLayer) { .paint = paint, .opaque = true };
  for (int y = 0; y < paint->height && layer->opaque; y++)
    for (int x = 0; x < paint->width; x++)
      {
        const uint8_t *c   = CELD_RGBA (paint, x, y);
        uint32_t       key = 0;

        for (int i = 0; i < 3; i++)
          key = key << KEPT_BITS | (uint32_t) (c[i] >> (8 - KEPT_BITS));
        layer->opaque &= c[3] == 255;
        if (++count[key] > most)
          {
            most = count[key];
            for (int i = 0; i < 3; i++)
              layer->paper[i] = c[i];
          }
      }
  celd_free (count);
  return CELD_OK;
}
