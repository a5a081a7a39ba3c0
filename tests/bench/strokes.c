/* Strokes as an artist might add them: anywhere, in a colour that there is, with the brush of the others.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "base/base.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint64_t state; /* of xorshift64* [Vigna 2016] */

void
random_start (void)
{
  state = 0x9e3779b97f4a7c15u;
}

static uint64_t
random_bits (void)
{
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  return state * 0x2545f4914f6cdd1du;
}

static double
random_share (void)
{
  return (double) (random_bits () >> 11) / 9007199254740992.0;
}

/* Mean width of the case's strokes: twice their area over their outline. */
double
brush_width (const CeldPaint *scribbles)
{
  size_t area = 0, outline = 0;

  for (int y = 0; y + 1 < scribbles->height; y++)
    for (int x = 0; x + 1 < scribbles->width; x++)
      {
        bool here = CELD_RGBA (scribbles, x, y)[3] > 127;

        area    += here;
        outline += here != (CELD_RGBA (scribbles, x + 1, y)[3] > 127);
        outline += here != (CELD_RGBA (scribbles, x, y + 1)[3] > 127);
      }
  return outline ? 2.0 * (double) area / (double) outline : 8;
}

static void
dab (CeldMask *mask, double x, double y, double radius)
{
  for (int py = (int) fmax (0, floor (y - radius)); py <= y + radius && py < mask->height; py++)
    for (int px = (int) fmax (0, floor (x - radius)); px <= x + radius && px < mask->width; px++)
      if (hypot (px + 0.5 - x, py + 0.5 - y) <= radius)
        CELD_AT (mask, px, py) = 1;
}

/* 100 to 400 pixels along a slightly bent line from a random place, in a colour that there is. */
Stroke
random_stroke (int width, int height, const CeldPalette *palette, double brush)
{
  Stroke   s = { .length = 100 + 300 * random_share () };
  double   x = width * random_share (), y = height * random_share ();
  double   heading = 6.283185307179586 * random_share (), bend = (random_share () - 0.5) / 100;
  double   place[500][2], left = width, top = height, right = 0, bottom = 0, margin = brush / 2 + 2;
  size_t   k = (size_t) (random_share () * (double) palette->n);
  int      n = 0;

  while (palette->item[k].origin != CELD_FROM_SCRIBBLE)
    k = (k + 1) % palette->n;
  memcpy (s.colour, palette->item[k].colour, 3);
  for (; n < s.length; n++, heading += bend)
    {
      x = place[n][0] = fmin (fmax (x + cos (heading), 0), width);
      y = place[n][1] = fmin (fmax (y + sin (heading), 0), height);
      left   = fmin (left, x);
      right  = fmax (right, x);
      top    = fmin (top, y);
      bottom = fmax (bottom, y);
    }
  s.x = (int) (left - margin);
  s.y = (int) (top - margin);
  if (celd_mask_new ((int) (right + margin) - s.x + 1, (int) (bottom + margin) - s.y + 1, &s.mask) != CELD_OK)
    abort ();
  for (int i = 0; i < n; i++)
    dab (&s.mask, place[i][0] - s.x, place[i][1] - s.y, brush / 2);
  return s;
}
