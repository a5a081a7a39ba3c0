/* Levels as depth enhancement reads them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "shadows.h"

void
celd_level_range (const CeldPlane *levels, float *least, float *most)
{
  *least = *most = celd_level_at (levels, 0, 0);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        *least = fminf (*least, celd_level_at (levels, x, y));
        *most  = fmaxf (*most, celd_level_at (levels, x, y));
      }
}
