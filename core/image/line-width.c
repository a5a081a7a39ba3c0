/* How wide the lines of a drawing are: the closing by the right window finds nearly all that one twice as wide finds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define CLEAR 36 /* of 255: how much darker a clear line is than what is beside it; chosen */

/* How many pixels are clearly darker than what is on both sides of them. */
CELD_CLONES static uint32_t
count_clear (const uint8_t *restrict value, const uint8_t *restrict closed, size_t n)
{
  uint32_t count = 0;

  for (size_t i = 0; i < n; i++)
    count += closed[i] - value[i] > CLEAR;
  return count;
}

CeldStatus
celd_line_radius (const CeldMask *luma, int widest, const CeldHost *host, void *work, CeldMask *closed, int *radius,
                  float *share)
{
  static const int sizes[] = { 1, 2, 3, 4, 6, 8, 11, 16, 22, 32, 45, 64, 91, 128 };
  enum { N = sizeof sizes / sizeof *sizes };
  size_t     pixels = (size_t) luma->width * (size_t) luma->height;
  uint32_t   count[N] = { 0 };
  CeldStatus status = CELD_OK;

  *radius = 1;
  *share = 0;
  for (int i = 0; i < N && sizes[i] <= 2 * widest && *share < 0.95f; i++)
    {
      celd_close_bytes (luma, sizes[i], work, closed);
      count[i] = count_clear (luma->data, closed->data, pixels);
      status = celd_progress (host, (double) (i + 1) / N);
      if (status != CELD_OK)
        return status;
      if (i >= 2 && 500 * (size_t) count[i - 2] > pixels && (float) count[i - 2] > *share * (float) count[i])
        {
          *share  = (float) count[i - 2] / (float) count[i];
          *radius = sizes[i - 2];
        }
    }
  return status;
}
