/* Whether a drawing is coloured: more than a fiftieth of it has another hue than the commonest one, which is the
 * paper's.  Hues are those of blocks without lines in them, by the shares of red and green, so that shadows on paper
 * make none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define FLAT_BLOCK 8  /* pixels, a side; chosen */
#define SHARES     32 /* by which red's and green's shares of a colour are counted; chosen */

/* The mean colour of a block without lines in it; false if there is one, or it is too dark to have a hue. */
static bool
flat_block (const CeldMask channel[3], int left, int top, float mean[3])
{
  int least = 255, most = 0, sum[3] = { 0 };

  for (int y = top; y < top + FLAT_BLOCK; y++)
    for (int x = left; x < left + FLAT_BLOCK; x++)
      for (int c = 0; c < 3; c++)
        {
          int v = CELD_AT (&channel[c], x, y);

          sum[c] += v;
          if (c == 1)
            {
              least = v < least ? v : least;
              most  = v > most ? v : most;
            }
        }
  for (int c = 0; c < 3; c++)
    mean[c] = (float) sum[c] / (FLAT_BLOCK * FLAT_BLOCK);
  return most - least < 40 && sum[0] + sum[1] + sum[2] > 100 * FLAT_BLOCK * FLAT_BLOCK;
}

bool
celd_is_coloured (const CeldMask channel[3])
{
  uint32_t of[SHARES][SHARES] = { { 0 } }, all = 0, alike = 0;
  int      red = 0, green = 0;
  float    mean[3];

  for (int y = 0; y + FLAT_BLOCK <= channel->height; y += FLAT_BLOCK)
    for (int x = 0; x + FLAT_BLOCK <= channel->width; x += FLAT_BLOCK)
      if (flat_block (channel, x, y, mean))
        {
          float whole = (mean[0] + mean[1] + mean[2]) * (1.0f + 1e-6f);

          of[(int) (mean[0] / whole * SHARES)][(int) (mean[1] / whole * SHARES)]++;
          all++;
        }
  for (int r = 0; r < SHARES; r++)
    for (int g = 0; g < SHARES; g++)
      if (of[r][g] > of[red][green])
        {
          red   = r;
          green = g;
        }
  for (int r = red > 0 ? red - 1 : 0; r <= red + 1 && r < SHARES; r++)
    for (int g = green > 0 ? green - 1 : 0; g <= green + 1 && g < SHARES; g++)
      alike += of[r][g];
  return 50 * (all - alike) > all;
}
