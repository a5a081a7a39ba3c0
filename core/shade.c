/* Lambert shading (section 5): the light's share is ambient + (1 - ambient) max (0, n . l).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "private.h"

#include <math.h>

#define RADIANS (3.14159265358979323846 / 180)

CeldStatus
celd_shade (const CeldVectors *normals, const CeldSettings *settings, CeldPlane *shading)
{
  if (!CELD_SAME_SIZE (normals, shading))
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK)
    return CELD_BAD_VALUE;

  double azimuth = (double) settings->light_azimuth * RADIANS, elevation = (double) settings->light_elevation * RADIANS;
  double lx = cos (elevation) * cos (azimuth), ly = cos (elevation) * sin (azimuth), lz = sin (elevation);
  double ambient = (double) settings->ambient;

  for (int y = 0; y < shading->height; y++)
    for (int x = 0; x < shading->width; x++)
      {
        const float *n = CELD_XYZ (normals, x, y);
        double       lit = (double) n[0] * lx + (double) n[1] * ly + (double) n[2] * lz;

        lit = lit > 0 ? fmin (lit, 1) : 0; /* NaN is unlit */
        CELD_AT (shading, x, y) = (float) (ambient + (1 - ambient) * lit);
      }
  return CELD_OK;
}
