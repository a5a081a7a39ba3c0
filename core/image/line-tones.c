/* The tones of lines: a thick stroke is a line, too, if it has the colour of thinner ones.
 *
 * The cores of lines are counted by coarse colours.  Each count is then added to those of the colours around it, so
 * that it does not matter where in its tone a colour lies.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#define TONES        CELD_LINE_TONES
#define LEAST_COMMON 100 /* a colour is that of lines if one core in so many has it; chosen */

static size_t
tone_of (const CeldMask channel[3], size_t pixel)
{
  size_t tone = 0;

  for (int c = 0; c < 3; c++)
    tone = tone * TONES + (size_t) channel[c].data[pixel] * TONES / 256;
  return tone;
}

void
celd_line_tone_count (CeldLineTones *tones, const CeldMask channel[3], size_t pixel)
{
  tones->cores++;
  tones->count[tone_of (channel, pixel)]++;
}

void
celd_line_tones_blur (CeldLineTones *tones)
{
  uint32_t sum[TONES + 2];

  for (size_t step = 1; step <= TONES * TONES; step *= TONES)
    for (size_t i = 0; i < TONES * TONES * TONES; i++)
      if (i / step % TONES == 0)
        {
          sum[0] = sum[TONES + 1] = 0;
          for (size_t k = 0; k < TONES; k++)
            sum[k + 1] = tones->count[i + k * step];
          for (size_t k = 0; k < TONES; k++)
            tones->count[i + k * step] = sum[k] + sum[k + 1] + sum[k + 2];
        }
}

bool
celd_is_line_tone (const CeldLineTones *tones, const CeldMask channel[3], size_t pixel)
{
  return LEAST_COMMON * (size_t) tones->count[tone_of (channel, pixel)] >= tones->cores;
}
