/* The numbers that layers can be stored in.
 *
 * Linear light that is stored encoded as sRGB in 8 bits (IEC 61966-2-1) has 256 values; the nearest one is the one
 * whose code is nearest, so that the limits between them lie half a code away.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "layers/layers.h"

#include <math.h>

static float
decode (double encoded)
{
  return (float) (encoded <= 0.04045 ? encoded / 12.92 : pow ((encoded + 0.055) / 1.055, 2.4));
}

void
celd_store_prepare (CeldLayers *layers)
{
  for (int k = 0; k < 256; k++)
    {
      layers->shade[k] = decode (k / 255.0);
      layers->limit[k] = decode ((k + 0.5) / 255);
    }
}

float
celd_store_alpha (const CeldLayers *layers, float alpha)
{
  return layers->store == CELD_STORE_FLOAT ? alpha : (float) (int) (alpha * 255 + 0.5f) / 255;
}

float
celd_store_colour (const CeldLayers *layers, float value)
{
  int least = 0, most = 255;

  if (layers->store != CELD_STORE_8_BIT_SRGB)
    return celd_store_alpha (layers, value);
  while (least < most)
    {
      int middle = (least + most) / 2;

      if (value < layers->limit[middle])
        most = middle;
      else
        least = middle + 1;
    }
  return layers->shade[least];
}
