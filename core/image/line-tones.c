/* The tones of lines: a thick stroke is a line, too, if it has the colour of thinner ones.
 *
 * The cores of lines are counted by coarse colours.  Each count is then added to those of the colours around it, so
 * that it does not matter where in its tone a colour lies.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/coloured-steps.h"

#define TONES        CELD_LINE_TONES
#define TONE_WIDTH   (256 / TONES)
#define LEAST_COMMON 100 /* a colour is that of lines if one core in so many has it; chosen */
#define LEAST_MAIN   0.9 /* of all cores have a colour that is that of lines in general: in drawings with lines of one
                          * colour 0.98 have it, in others at most 0.81 (measured on 96 drawings) */

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

bool
celd_main_line_tone (const CeldLineTones *tones, uint8_t tone[3])
{
  size_t of[3], most = 0, sum[3] = { 0 }, near = 0;

  for (size_t i = 1; i < TONES * TONES * TONES; i++)
    most = tones->count[i] > tones->count[most] ? i : most;
  for (size_t i = 0; i < TONES * TONES * TONES; i++)
    {
      bool inside = true;

      for (size_t c = 0, step = TONES * TONES; c < 3; c++, step /= TONES)
        {
          size_t middle = most / step % TONES;

          of[c]  = i / step % TONES;
          inside = inside && of[c] + 1 >= middle && of[c] <= middle + 1;
        }
      near += inside ? tones->count[i] : 0;
      for (size_t c = 0; c < 3 && inside; c++)
        sum[c] += tones->count[i] * (of[c] * TONE_WIDTH + TONE_WIDTH / 2);
    }
  for (size_t c = 0; c < 3 && near; c++)
    tone[c] = (uint8_t) (sum[c] / near);
  return near && (double) near >= LEAST_MAIN * tones->cores;
}

CELD_CLONES static void
measure_distance (const uint8_t *restrict red, const uint8_t *restrict green, const uint8_t *restrict blue,
                  const uint8_t tone[3], size_t n, uint8_t *restrict distance)
{
  uint8_t r = tone[0], g = tone[1], b = tone[2];

  for (size_t i = 0; i < n; i++)
    {
      uint8_t dr = red[i] > r ? (uint8_t) (red[i] - r) : (uint8_t) (r - red[i]);
      uint8_t dg = green[i] > g ? (uint8_t) (green[i] - g) : (uint8_t) (g - green[i]);
      uint8_t db = blue[i] > b ? (uint8_t) (blue[i] - b) : (uint8_t) (b - blue[i]);
      uint8_t most = dr > dg ? dr : dg;

      most = most > db ? most : db;
      distance[i] = most > TONE_WIDTH / 2 ? (uint8_t) (most - TONE_WIDTH / 2) : 0;
    }
}

void
celd_tone_distance (const CeldMask channel[3], const uint8_t tone[3], size_t n, uint8_t *distance)
{
  measure_distance (channel[0].data, channel[1].data, channel[2].data, tone, n, distance);
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
