/* The turntable: a relief as a scene, with heights for its depth.
 *
 * A point at height z is seen at  x cos a - z sin a  when the relief has turned by the angle a, which is what the views
 * of a scene on a turntable are if the disparity for all of its heights is  2 z sin a / width.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "stereo/scene.h"

#define MOST_DISPARITY 0.2 /* that the setting takes */

CeldStatus
celd_turntable_depth (const CeldRelief *relief, CeldPlane *depth, double *range)
{
  size_t n = (size_t) relief->width * (size_t) relief->height;
  float  least = FLT_MAX, most = -FLT_MAX;

  if (!CELD_SAME_SIZE (depth, depth) || depth->width != relief->width || depth->height != relief->height)
    return CELD_BAD_SIZE;
  for (size_t i = 0; i < n; i++)
    {
      least = fminf (least, relief->z[i]);
      most  = fmaxf (most, relief->z[i]);
    }
  for (int y = 0; y < depth->height; y++)
    for (int x = 0; x < depth->width; x++)
      {
        float z = relief->z[(size_t) y * (size_t) relief->width + (size_t) x];

        CELD_AT (depth, x, y) = most > least ? (z - least) / (most - least) : 0;
      }
  *range = (double) (most - least);
  return CELD_OK;
}

void
celd_turntable_settings (double range, int width, CeldSettings *settings)
{
  double side = sin (CELD_TURNTABLE_ANGLE * CELD_PI / 180);

  settings->disparity   = (float) fmin (2 * side * range / width, MOST_DISPARITY);
  settings->convergence = 0.5f; /* the middle of all heights */
}

/* The frames are the half of a round from three quarters of it on. */
CeldCamera
celd_turntable_sweep (int frame, int frames)
{
  return celd_camera_on_path (CELD_PATH_TURNTABLE, 2 * frame + 3 * (frames - 1), 4 * (frames - 1));
}
