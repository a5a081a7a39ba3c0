/* Luma of encoded colours, with the weights of Rec. 709: what ink is measured in.  All hosts use this function, because
 * their own greys differ (babl's Y' is encoded luminance, much lighter for saturated colours).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

void
celd_luma (const float *rgba, size_t n, float *luma, float *alpha)
{
  for (size_t i = 0; i < n; i++, rgba += 4)
    {
      luma[i] = 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
      if (alpha)
        alpha[i] = rgba[3];
    }
}
