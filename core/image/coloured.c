/* Whether a drawing is coloured: more than a fiftieth of it has another hue than the commonest one, which is the
 * paper's; or a few fills do that are quite flat, if the drawing is small on its page: neither stains nor the noise of a
 * photograph are flat.  Hues are those of blocks without lines in them, by the shares of red and green, so that shadows
 * on paper make none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#include <stdlib.h>

#define FLAT_BLOCK 8  /* pixels, a side; chosen */
#define LINELESS   40 /* of 255: green differs by less in a block without lines; chosen */
#define QUITE_FLAT 2  /* of 255: what each channel may differ in a quite flat block, from rounding; chosen */
#define FEW_FILLS  16 /* quite flat blocks of other hues, at least; chosen */

/* The mean and the range of each channel in a block. */
static void
read_block (const CeldMask channel[3], int left, int top, float mean[3], int range[3])
{
  for (int c = 0; c < 3; c++)
    {
      int least = 255, most = 0, sum = 0;

      for (int y = top; y < top + FLAT_BLOCK; y++)
        for (int x = left; x < left + FLAT_BLOCK; x++)
          {
            int v = CELD_AT (&channel[c], x, y);

            sum += v;
            least = v < least ? v : least;
            most  = v > most ? v : most;
          }
      mean[c]  = (float) sum / (FLAT_BLOCK * FLAT_BLOCK);
      range[c] = most - least;
    }
}

/* Counts the blocks without lines that are light enough to have a hue, and those of them that are quite flat. */
static void
count_hues (const CeldMask channel[3], CeldHueCounts all, CeldHueCounts flat)
{
  float mean[3];
  int   range[3];

  for (int y = 0; y + FLAT_BLOCK <= channel->height; y += FLAT_BLOCK)
    for (int x = 0; x + FLAT_BLOCK <= channel->width; x += FLAT_BLOCK)
      {
        read_block (channel, x, y, mean, range);
        if (range[1] < LINELESS && mean[0] + mean[1] + mean[2] > 100)
          {
            (*celd_hue_count (all, mean[0], mean[1], mean[2]))++;
            *celd_hue_count (flat, mean[0], mean[1], mean[2]) +=
              range[0] <= QUITE_FLAT && range[1] <= QUITE_FLAT && range[2] <= QUITE_FLAT;
          }
      }
}

/* How many of these blocks have another hue than one, or those next to it; *all becomes how many there are. */
static uint32_t
count_others (CeldHueCounts of, int red, int green, uint32_t *all)
{
  uint32_t others = 0;

  *all = 0;
  for (int r = 0; r < CELD_HUE_SHARES; r++)
    for (int g = 0; g < CELD_HUE_SHARES; g++)
      {
        *all += of[r][g];
        others += abs (r - red) > 1 || abs (g - green) > 1 ? of[r][g] : 0;
      }
  return others;
}

bool
celd_is_coloured (const CeldMask channel[3])
{
  CeldHueCounts of = { { 0 } }, flat = { { 0 } };
  int           red = 0, green = 0;
  uint32_t      all;

  count_hues (channel, of, flat);
  for (int r = 0; r < CELD_HUE_SHARES; r++)
    for (int g = 0; g < CELD_HUE_SHARES; g++)
      if (of[r][g] > of[red][green])
        {
          red   = r;
          green = g;
        }
  return count_others (flat, red, green, &all) >= FEW_FILLS || 50 * count_others (of, red, green, &all) > all;
}
