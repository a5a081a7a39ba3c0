/* What depth enhancement changes, as a layer, laid over the art, and over a picture of depth itself.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/shadows.h"

#define FAR_GREY 0.3f  /* encoded; darker paper would hide the shadows on it */

/* Lighter colours are brighter ones, so that ink stays ink; none becomes brighter than white. */
static float
changed (float value, float change)
{
  return change < 0 || value >= 1 ? value * fminf (1 + change, 1) : fminf (value * (1 + change), 1);
}

CeldStatus
celd_enhance_colours (const CeldPlane *change, CeldColours *colours)
{
  if (!CELD_SAME_SIZE (change, colours))
    return CELD_BAD_SIZE;
  for (int y = 0; y < change->height; y++)
    for (int x = 0; x < change->width; x++)
      for (int c = 0; c < 3; c++)
        CELD_RGBA (colours, x, y)[c] = changed (CELD_RGBA (colours, x, y)[c], CELD_AT (change, x, y));
  return CELD_OK;
}

CeldStatus
celd_enhance_layer (const CeldPlane *change, CeldColours *layer)
{
  if (!CELD_SAME_SIZE (change, layer))
    return CELD_BAD_SIZE;
  for (int y = 0; y < change->height; y++)
    for (int x = 0; x < change->width; x++)
      {
        float *rgba = CELD_RGBA (layer, x, y);

        rgba[0] = rgba[1] = rgba[2] = 0;
        rgba[3] = fmaxf (0, -CELD_AT (change, x, y));
      }
  return CELD_OK;
}

CeldStatus
celd_enhance_view (const CeldPlane *levels, const CeldPlane *change, CeldPlane *view)
{
  float least, most;

  if (!CELD_SAME_SIZE (levels, change) || !CELD_SAME_SIZE (levels, view))
    return CELD_BAD_SIZE;
  celd_level_range (levels, &least, &most);
  for (int y = 0; y < levels->height; y++)
    for (int x = 0; x < levels->width; x++)
      {
        float near = most > least ? (celd_level_at (levels, x, y) - least) / (most - least) : 1;
        float grey = powf (FAR_GREY + (1 - FAR_GREY) * near, 2.2f);

        CELD_AT (view, x, y) = changed (grey, CELD_AT (change, x, y));
      }
  return CELD_OK;
}
