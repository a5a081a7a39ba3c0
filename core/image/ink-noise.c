/* The noise of a drawing on paper: grain, compression artefacts, and a filter against grain.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>

#define ENOUGH_NOISE ((size_t) 1 << 17) /* pixels: more do not change a quantile by which noise is known; chosen */
#define LEAST_ECHO   256 /* pixels beside dark lines: by fewer, a few hairlines are taken for ripple; chosen */

/* Odd, because compressed pictures repeat themselves every 8 rows. */
int
celd_ink_rows_apart (int width, int height)
{
  size_t pixels = (size_t) width * (size_t) height;

  return pixels > ENOUGH_NOISE ? (int) (pixels / ENOUGH_NOISE) | 1 : 1;
}

float
celd_ink_noise (const CeldPlane *contrast, int step)
{
  size_t of[CELD_INK_BANKS][CELD_INK_BINS] = { { 0 } }, all = 0, below = 0;
  int    bin = 0, apart = celd_ink_rows_apart (contrast->width, contrast->height);

  for (int y = apart / 2; y < contrast->height; y += apart)
    for (int x = step; x < contrast->width - step; x++)
      {
        const float *c = &CELD_AT (contrast, x, y);

        if (celd_most (celd_most (c[-step], c[0]), c[step]) >= 0.25f)
          continue;
        of[x % CELD_INK_BANKS][(int) celd_least (fabsf (c[-step] - 2 * c[0] + c[step]) * 1024, CELD_INK_BINS - 1)]++;
        all++;
      }
  for (int k = 1; k < CELD_INK_BANKS; k++)
    for (int i = 0; i < CELD_INK_BINS; i++)
      of[0][i] += of[k][i];
  while (bin < CELD_INK_BINS - 1 && 2 * (below += of[0][bin]) < all)
    bin++;
  /* 0.6745 is the median of |x| for a unit normal distribution, 2.4495 the norm of (1 -2 1). */
  return (float) bin / 1024 / (0.6745f * 2.4495f);
}

float
celd_ink_echo (const CeldPlane *contrast, const CeldMask *around, float dark)
{
  size_t of[CELD_INK_BINS] = { 0 }, all = 0, above = 0;
  int    bin = CELD_INK_BINS - 1, apart = celd_ink_rows_apart (contrast->width, contrast->height);

  for (int y = apart > 1 ? apart / 2 : 1; y < contrast->height - 1; y += apart)
    for (int x = 1; x < contrast->width - 1; x++)
      {
        const float *c = &CELD_AT (contrast, x, y), *up = c - contrast->stride, *down = c + contrast->stride;
        float        beside = celd_most (celd_most (up[-1], up[0]), celd_most (up[1], c[-1]));

        beside = celd_most (beside, celd_most (celd_most (c[1], down[-1]), celd_most (down[0], down[1])));
        if (CELD_AT (around, x, y) < 255 * 0.7f * dark || celd_most (beside, c[0]) > 0.25f * dark)
          continue;
        of[(int) (0.5f * fabsf (c[-1] - 2 * c[0] + c[1]) * (CELD_INK_BINS - 1))]++;
        all++;
      }
  while (bin > 0 && 10 * (above += of[bin]) < all)
    bin--;
  return all >= LEAST_ECHO ? (float) bin / (CELD_INK_BINS - 1) : 0;
}

void
celd_ink_smooth (CeldPlane *plane, CeldPlane *spare)
{
  int width = plane->width, height = plane->height;

  for (int y = 0; y < height; y++)
    {
      const float *from = &CELD_AT (plane, 0, y);
      float       *to = &CELD_AT (spare, 0, y);

      to[0] = 0.25f * (from[0] + from[width > 1]) + 0.5f * from[0];
      for (int x = 1; x < width - 1; x++)
        to[x] = 0.25f * (from[x - 1] + from[x + 1]) + 0.5f * from[x];
      to[width - 1] = 0.25f * (from[width > 1 ? width - 2 : 0] + from[width - 1]) + 0.5f * from[width - 1];
    }
  for (int y = 0; y < height; y++)
    {
      const float *above = &CELD_AT (spare, 0, y > 0 ? y - 1 : 0);
      const float *below = &CELD_AT (spare, 0, y < height - 1 ? y + 1 : y);
      const float *from = &CELD_AT (spare, 0, y);
      float       *to = &CELD_AT (plane, 0, y);

      for (int x = 0; x < width; x++)
        to[x] = 0.25f * (above[x] + below[x]) + 0.5f * from[x];
    }
}
