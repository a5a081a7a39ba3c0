/* Two discs that overlap, in any colours, and the lines that are found in them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef DISCS_H
#define DISCS_H

#include "check.h"
#include "celdepth.h"

enum { SIDE = 200, BREADTH = 5 };

typedef struct { float red, green, blue; } Tone;

static const Tone white = { 1, 1, 1 }, brown = { 0.25f, 0.12f, 0.08f }, yellow = { 1, 0.85f, 0.3f },
                  blue = { 0.3f, 0.45f, 0.9f }, pink = { 1, 0.7f, 0.75f };

static uint8_t art_of[SIDE * SIDE * 4];
static float   luma_of[SIDE * SIDE], alpha_of[SIDE * SIDE];

static inline CeldPlane
square (float *data)
{
  return (CeldPlane) { SIDE, SIDE, SIDE, data };
}

/* Of the ring round (x0,y0) with the given radius, and of what is inside its middle, the share of a pixel. */
static inline float
ring (int x, int y, float x0, float y0, float radius)
{
  float r = hypotf ((float) x + 0.5f - x0, (float) y + 0.5f - y0);

  return fminf (fmaxf (0.5f * BREADTH + 0.5f - fabsf (r - radius), 0), 1);
}

static inline bool
inside (int x, int y, float x0, float y0, float radius)
{
  return hypotf ((float) x + 0.5f - x0, (float) y + 0.5f - y0) < radius;
}

/* Two discs that overlap, the right one in front. */
static inline float
line_at (int x, int y)
{
  float left = inside (x, y, 125, 100, 45) ? 0 : ring (x, y, 75, 100, 45);

  return fmaxf (left, ring (x, y, 125, 100, 45));
}

static inline Tone
mixed (Tone a, Tone b, float share)
{
  return (Tone) { a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
                  a.blue + share * (b.blue - a.blue) };
}

static inline void
put (int x, int y, Tone tone)
{
  uint8_t *pixel = art_of + 4 * (y * SIDE + x);

  pixel[0] = (uint8_t) (255 * tone.red + 0.5f);
  pixel[1] = (uint8_t) (255 * tone.green + 0.5f);
  pixel[2] = (uint8_t) (255 * tone.blue + 0.5f);
  pixel[3] = 255;
}

static inline void
draw (Tone page, Tone left, Tone right, Tone line)
{
  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      put (x, y, mixed (inside (x, y, 125, 100, 45) ? right : inside (x, y, 75, 100, 45) ? left : page, line,
                        line_at (x, y)));
}

/* The distance from the line through two points. */
static inline float
from_line (float x, float y, float x0, float y0, float x1, float y1)
{
  return fabsf ((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) / hypotf (x1 - x0, y1 - y0);
}

/* Sets luma_of as a host does. */
static inline CeldStatus
find (CeldInkMode mode, const CeldHost *host)
{
  CeldPaint   art = { SIDE, SIDE, SIDE, art_of };
  CeldDrawing drawing = { square (luma_of), square (alpha_of) };

  for (int i = 0; i < SIDE * SIDE; i++)
    {
      const uint8_t *p = art_of + 4 * i;
      float          rgba[] = { p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f, p[3] / 255.0f };

      celd_luma (rgba, 1, &luma_of[i], &alpha_of[i]);
    }
  return celd_coloured_lines (&art, mode, host, &drawing);
}

/* How much the result differs at most from what would be drawn with black ink on white. */
static inline float
worst (void)
{
  float most = 0;

  for (int y = 0; y < SIDE; y++)
    for (int x = 0; x < SIDE; x++)
      if (abs (x - 100) > 5) /* where the rings meet, corners are filled in */
        most = fmaxf (most, fabsf (luma_of[y * SIDE + x] - (1 - line_at (x, y))));
  return most;
}

static inline bool
unchanged (void)
{
  for (int i = 0; i < SIDE * SIDE; i++)
    {
      const uint8_t *p = art_of + 4 * i;
      float          luma, rgba[] = { p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f, p[3] / 255.0f };

      celd_luma (rgba, 1, &luma, NULL);
      if (luma_of[i] < luma || luma_of[i] > luma)
        return false;
    }
  return true;
}

#endif
