/* Settings of a distant light without ambient light.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef LIGHT_FROM_H
#define LIGHT_FROM_H

#include "celdepth.h"

/* Angles in degrees, as CeldSettings has them. */
static inline CeldSettings
light_from (double azimuth, double elevation)
{
  CeldSettings settings = celd_settings ();

  settings.light_azimuth   = (float) azimuth;
  settings.light_elevation = (float) elevation;
  settings.ambient         = 0;
  return settings;
}

#endif
