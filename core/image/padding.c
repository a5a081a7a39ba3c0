/* Colours under transparent pixels, for textures: game engines blend neighbouring pixels, so the colour just outside
 * the edge of a sprite must be that of the sprite.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define SOLID_ALPHA 0.5f /* alpha from which a pixel's colour is used (chosen) */

static void
pad_pixel (const CeldColours *picture, int64_t most, const float blank[3], int32_t squared, int32_t nearest,
           float *rgba)
{
  const float *from = CELD_RGBA (picture, nearest < 0 ? 0 : nearest % picture->width,
                                 nearest < 0 ? 0 : nearest / picture->width);

  if (rgba[3] >= SOLID_ALPHA)
    return;
  if (nearest >= 0 && squared <= most)
    memcpy (rgba, from, 3 * sizeof *rgba);
  else if (!(rgba[3] > 0))
    memcpy (rgba, blank, 3 * sizeof *rgba);
}

CeldStatus
celd_pad_colours (int reach, const float blank[3], const CeldHost *host, CeldColours *picture)
{
  if (!CELD_SAME_SIZE (picture, picture))
    return CELD_BAD_SIZE;
  if (reach < 0)
    return CELD_BAD_VALUE;

  size_t     n = (size_t) picture->width * (size_t) picture->height, i = 0;
  uint8_t   *solid = celd_alloc (n, sizeof *solid);
  int32_t   *squared = celd_alloc (n, sizeof *squared), *nearest = celd_alloc (n, sizeof *nearest);
  CeldStatus status = solid && squared && nearest ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++)
          solid[i++] = CELD_RGBA (picture, x, y)[3] >= SOLID_ALPHA;
      status = celd_nearest (picture->width, picture->height, solid, host, squared, nearest);
    }
  i = 0;
  for (int y = 0; y < picture->height && status == CELD_OK; y++)
    for (int x = 0; x < picture->width; x++, i++)
      pad_pixel (picture, (int64_t) reach * reach, blank, squared[i], nearest[i], CELD_RGBA (picture, x, y));
  celd_free (solid);
  celd_free (squared);
  celd_free (nearest);
  return status;
}
