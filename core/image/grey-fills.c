/* Whether a drawing has flat fills in greys or pale colours: in some channel a fiftieth of it lies in flat blocks of
 * tones that are neither its paper's, the commonest one, nor those of what is darkest and lightest; or an eighth of what
 * is no paper does, if the drawing is small on its page.
 *
 * A flat fill has one tone.  Uneven light and gradients have tones side by side, so that none of them stands out; the
 * grain of paper and pencil leaves no flat blocks.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <stdlib.h>
#include <string.h>

#define GREY_BLOCK  8    /* pixels, a side; chosen */
#define FLAT        2    /* of 255: what a value may differ within a flat block, from rounding; chosen */
#define TONES_APART 16   /* of 255: between tones that differ; chosen */
#define STANDS_OUT  4    /* times as many blocks have a fill's tone, but for rounding, as those next to it; chosen */
#define EXTREME     1000 /* a tone is the darkest or the lightest if one pixel in so many goes beyond; chosen */
#define LEAST_FILLS 50   /* fills are at least one part in so many of a drawing, as for colours; ... */
#define LEAST_DRAWN 8    /* ... or one in so many of the blocks that are no paper, ... */
#define FEW_BLOCKS  8    /* ... if there are so many; chosen */

/* Counts values of a channel in a block, and its tone if it is flat. */
static void
count_block (const CeldMask *channel, int left, int top, uint32_t of[256], uint32_t flat[256])
{
  int least = 255, most = 0;

  for (int y = top; y < top + GREY_BLOCK; y++)
    for (int x = left; x < left + GREY_BLOCK; x++)
      {
        int v = CELD_AT (channel, x, y);

        of[v]++;
        least = v < least ? v : least;
        most  = v > most ? v : most;
      }
  if (most - least <= FLAT)
    flat[(least + most) / 2]++;
}

/* How many blocks have about this tone: `from` to `to` away from it, on both sides. */
static uint32_t
blocks_near (const uint32_t flat[256], int tone, int from, int to)
{
  uint32_t sum = 0;

  for (int i = 0; i < 256; i++)
    sum += abs (i - tone) >= from && abs (i - tone) <= to ? flat[i] : 0;
  return sum;
}

/* The value beyond which one pixel in so many is, from 0 or 255 on. */
static int
extreme (const uint32_t of[256], uint32_t all, bool lightest)
{
  uint32_t beyond = 0;
  int      i = 0;

  while (i < 255 && EXTREME * (size_t) (beyond += of[lightest ? 255 - i : i]) < all)
    i++;
  return lightest ? 255 - i : i;
}

static bool
has_fills (const CeldMask *channel)
{
  uint32_t of[256] = { 0 }, flat[256] = { 0 }, blocks = 0, fills = 0;
  int      paper = 0, darkest, lightest;

  for (int y = 0; y + GREY_BLOCK <= channel->height; y += GREY_BLOCK)
    for (int x = 0; x + GREY_BLOCK <= channel->width; x += GREY_BLOCK, blocks++)
      count_block (channel, x, y, of, flat);
  for (int i = 1; i < 256; i++)
    paper = flat[i] > flat[paper] ? i : paper;
  darkest  = extreme (of, blocks * GREY_BLOCK * GREY_BLOCK, false);
  lightest = extreme (of, blocks * GREY_BLOCK * GREY_BLOCK, true);
  for (int i = 0; i < 256; i++)
    if (flat[i] && i - darkest >= TONES_APART && lightest - i >= TONES_APART && abs (i - paper) >= TONES_APART &&
        blocks_near (flat, i, 0, 1) > STANDS_OUT * blocks_near (flat, i, 2, 2))
      fills += flat[i];
  return LEAST_FILLS * fills > blocks ||
         (fills >= FEW_BLOCKS && LEAST_DRAWN * fills > blocks - blocks_near (flat, paper, 0, FLAT));
}

bool
celd_has_grey_fills (const CeldMask channel[3])
{
  size_t n = (size_t) channel->width * (size_t) channel->height;

  if (has_fills (&channel[1]))
    return true;
  for (int c = 0; c < 3; c += 2)
    if (memcmp (channel[c].data, channel[1].data, n) && has_fills (&channel[c])) /* in greys they are the same */
      return true;
  return false;
}
