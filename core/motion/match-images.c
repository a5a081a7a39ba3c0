/* Pictures that registration matches, from coarse to fine.
 *
 * Lines are thin, so squared differences of ink say nothing until lines overlap.  Instead of blurred ink we compare
 * nearness to ink, which falls linearly with distance: it has a slope in the whole neighbourhood of a line, does not
 * fade when it is reduced, and does not depend on how thick or dark a line is.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 * /
 */
#include "motion/motion.h"

static float
nearness (const int32_t *squared, size_t p, float reach)
{
  float d = squared[p] < 1 << 30 ? sqrtf ((float) squared[p]) : reach;

  return d < reach ? 1 - d / reach : 0;
}

CeldStatus
celd_match_images_new (int width, int height, const int32_t *source, const int32_t *nearest,
                       const int32_t *target, int factor, int pad, CeldMatchImages *images)
{
  int    w = (width + factor - 1) / factor, h = (height + factor - 1) / factor;
  size_t stride = (size_t) (w + 2 * pad), rows = (size_t) (h + 2 * pad);
  float  reach = CELD_NEARNESS * (float) factor;

  *images = (CeldMatchImages) { .factor = factor, .width = w, .height = h, .pad = pad, .nearest = nearest,
                                .source = celd_alloc ((size_t) w * (size_t) h, sizeof (float)),
                                .target = celd_alloc0 (stride * rows, sizeof (float)) };
  if (!images->source || !images->target)
    {
      celd_match_images_clear (images);
      return CELD_NO_MEMORY;
    }
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        int    px = x * factor + factor / 2, py = y * factor + factor / 2;
        size_t p = (size_t) (py < height ? py : height - 1) * (size_t) width + (size_t) (px < width ? px : width - 1);

        images->source[(size_t) y * (size_t) w + (size_t) x] = nearness (source, p, reach);
        images->target[(size_t) (y + pad) * stride + (size_t) (x + pad)] = nearness (target, p, reach);
      }
  return CELD_OK;
}

void
celd_match_images_clear (CeldMatchImages *images)
{
  celd_free (images->source);
  celd_free (images->target);
  *images = (CeldMatchImages) { .factor = 0 };
}
