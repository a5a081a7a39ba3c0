/* How wide the lines of a drawing are: the closing by the right window finds nearly all that one twice as wide finds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define CLEAR        36                 /* of 255: how much darker a clear line is than what is beside it; chosen */
#define COUNTED      128                /* pixels whose number fits into a byte; chosen */
#define BAND         128                /* rows that are closed together, so that they stay in the cache; chosen */
#define ENOUGH_LINES ((size_t) 1 << 19) /* pixels that are looked at; chosen */

/* How many pixels are clearly darker than what is on both sides of them. */
CELD_CLONES static uint32_t
count_clear (const uint8_t *restrict value, const uint8_t *restrict closed, size_t n)
{
  uint32_t count = 0;

  for (size_t i = 0; i < n; i += COUNTED)
    {
      size_t  piece = n - i < COUNTED ? n - i : COUNTED;
      uint8_t here = 0;

      for (size_t k = i; k < i + piece; k++)
        here = (uint8_t) (here + ((uint8_t) (closed[k] - value[k]) > CLEAR)); /* no pixel is lighter than its closing */
      count += here;
    }
  return count;
}

/* The bands of rows that are looked at: the first of each `apart`. */
typedef struct { int apart; size_t pixels; } Bands;

static int
band_height (const CeldMask *luma, int top)
{
  return luma->height - top < BAND ? luma->height - top : BAND;
}

static Bands
choose_bands (const CeldMask *luma)
{
  size_t all = (size_t) luma->width * (size_t) luma->height;
  Bands  bands = { all > ENOUGH_LINES ? (int) ((all + ENOUGH_LINES / 2) / ENOUGH_LINES) : 1, 0 };

  for (int y = 0; y < luma->height; y += BAND * bands.apart)
    bands.pixels += (size_t) luma->width * (size_t) band_height (luma, y);
  return bands;
}

/* How many pixels are clearly darker than their closing by this radius. */
static uint32_t
count_lines (const CeldMask *luma, Bands bands, int radius, void *work, CeldMask *closed)
{
  uint32_t count = 0;

  for (int y = 0; y < luma->height; y += BAND * bands.apart)
    {
      int      height = band_height (luma, y);
      CeldMask band = { luma->width, height, luma->stride, &CELD_AT (luma, 0, y) };
      CeldMask result = { luma->width, height, luma->stride, closed->data };

      celd_close_bytes (&band, radius, work, &result);
      count += count_clear (band.data, result.data, (size_t) band.width * (size_t) height);
    }
  return count;
}

CeldStatus
celd_line_radius (const CeldMask *luma, int widest, const CeldHost *host, void *work, CeldMask *closed, int *radius,
                  float *share)
{
  static const int sizes[] = { 1, 2, 3, 4, 6, 8, 11, 16, 22, 32, 45, 64, 91, 128 };
  enum { N = sizeof sizes / sizeof *sizes };
  Bands      bands = choose_bands (luma);
  uint32_t   count[N] = { 0 };
  CeldStatus status = CELD_OK;

  *radius = 1;
  *share = 0;
  for (int i = 0; i < N && sizes[i] <= 2 * widest && *share < 0.95f; i++)
    {
      count[i] = count_lines (luma, bands, sizes[i], work, closed);
      status = celd_progress (host, (double) (i + 1) / N);
      if (status != CELD_OK)
        return status;
      if (i >= 2 && 500 * (size_t) count[i - 2] > bands.pixels && (float) count[i - 2] > *share * (float) count[i])
        {
          *share  = (float) count[i - 2] / (float) count[i];
          *radius = sizes[i - 2];
        }
    }
  return status;
}
