/* Paper as bits: how much of it stands under a run of pixels, as is asked of every painted run after every stroke.
 *
 * The drawing itself is 32 times as large, and the strokes of an artist lie all over it, so that nearly every look at
 * it is a miss of the cache.  A byte is 8 pixels of a row, and 8 rows of such bytes stand together, so that 64 x 8
 * pixels share a line of the cache.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "basins.h"

/* The byte of pixels 8 column .. 8 column + 7 of row y. */
static inline size_t
byte_of (int width, int column, int y)
{
  return ((size_t) (y >> 3) * (size_t) ((width + 7) >> 3) + (size_t) column) << 3 | (size_t) (y & 7);
}

typedef struct { const CeldPlane *ink; uint8_t *bits; CeldRect rect; } Work;

/* Rows come in bands of 8, so that jobs share no line of the cache. */
static void
read_band (void *data, int band)
{
  const Work *work = data;
  int         top = work->rect.y & ~7, bottom = work->rect.y + work->rect.height, w = work->ink->width;

  for (int y = top + 8 * band; y < top + 8 * band + 8 && y < bottom; y++)
    for (int column = work->rect.x >> 3; 8 * column < work->rect.x + work->rect.width; column++)
      {
        const float *ink = &CELD_AT (work->ink, 8 * column, y);
        unsigned     byte = 0;

        if (8 * column + 8 <= w)
          for (int i = 0; i < 8; i++)
            byte |= (unsigned) celd_is_paper (ink[i]) << i;
        else
          for (int i = 0; i < w - 8 * column; i++)
            byte |= (unsigned) celd_is_paper (ink[i]) << i;
        work->bits[byte_of (w, column, y)] = (uint8_t) byte;
      }
}

void
celd_paper_renew (const CeldPlane *ink, const CeldRect *changed, const CeldRun *run, uint8_t *bits)
{
  Work work = { ink, bits, *changed };

  if (changed->width > 0 && changed->height > 0)
    celd_each (run, ((changed->y + changed->height + 7) >> 3) - (changed->y >> 3), read_band, &work);
}

CeldStatus
celd_paper_new (const CeldPlane *ink, const CeldRun *run, uint8_t **bits)
{
  CeldRect all = { 0, 0, ink->width, ink->height };
  uint8_t *made = celd_alloc0 ((size_t) ((ink->width + 7) >> 3) * (size_t) ((ink->height + 7) >> 3), 8);

  if (!made)
    return CELD_NO_MEMORY;
  celd_paper_renew (ink, &all, run, made);
  *bits = made;
  return CELD_OK;
}

static inline uint32_t
count_bits (unsigned byte)
{
  static const uint8_t of_half[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };

  return (uint32_t) of_half[byte & 15] + of_half[byte >> 4];
}

uint32_t
celd_paper_count (const CeldBasins *basins, int y, int x, int end)
{
  int            first = x >> 3, last = (end - 1) >> 3;
  const uint8_t *byte = basins->paper + byte_of (basins->width, first, y);
  unsigned       from_x = 0xffu << (x & 7) & 0xffu, to_end = 0xffu >> (7 - ((end - 1) & 7));
  uint32_t       n;

  if (x >= end)
    return 0;
  if (first == last)
    return count_bits (*byte & from_x & to_end);
  n = count_bits (*byte & from_x);
  for (byte += 8; ++first < last; byte += 8)
    n += count_bits (*byte);
  return n + count_bits (*byte & to_end);
}
