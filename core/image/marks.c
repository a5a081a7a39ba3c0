/* Marks that show an artist where problems are: a red ring with a white rim, which is visible on ink, paper and
 * colours, and a dot at the place itself.  The sizes are chosen.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <math.h>

#define LEAST_RADIUS 5.0        /* pixels */
#define SIDE_PER_RADIUS        60.0       /* shorter side of the picture divided by the radius */
#define LINE         0.3        /* width of the ring's line, in radii */
#define RIM          0.2        /* width of the white on either side, in radii */
#define DOT          0.2        /* radius of the dot, in radii */

/* Coverage of a pixel whose centre is `outside` pixels beyond the edge of a shape. */
static double
cover (double outside)
{
  return fmax (0, fmin (1, 0.5 - outside));
}

/* Draws a colour over a pixel with straight alpha. */
static void
blend (uint8_t *rgba, const uint8_t colour[3], double opacity)
{
  double below = rgba[3] / 255.0 * (1 - opacity), alpha = opacity + below;

  if (opacity <= 0)
    return;
  for (int c = 0; c < 3; c++)
    rgba[c] = (uint8_t) lround ((opacity * colour[c] + below * rgba[c]) / alpha);
  rgba[3] = (uint8_t) lround (255 * alpha);
}

static void
paint_mark (CeldPaint *paint, int x, int y, double radius)
{
  static const uint8_t red[3] = { 230, 0, 0 }, white[3] = { 255, 255, 255 };
  double               line = fmax (1, LINE * radius) / 2, rim = line + fmax (1, RIM * radius), dot = DOT * radius;
  int                  reach = (int) ceil (radius + rim) + 1;

  for (int v = y - reach; v <= y + reach; v++)
    for (int u = x - reach; u <= x + reach; u++)
      {
        double away = hypot (u - x, v - y), off = fabs (away - radius);

        if (u < 0 || v < 0 || u >= paint->width || v >= paint->height)
          continue;
        blend (CELD_RGBA (paint, u, v), white, fmax (cover (off - rim), cover (away - dot - (rim - line))));
        blend (CELD_RGBA (paint, u, v), red, fmax (cover (off - line), cover (away - dot)));
      }
}

void
celd_problems_paint (const CeldProblems *problems, CeldPaint *paint)
{
  int    side = paint->width < paint->height ? paint->width : paint->height;
  double radius = fmax (LEAST_RADIUS, side / SIDE_PER_RADIUS);

  for (size_t i = 0; i < problems->n; i++)
    if (problems->item[i].x >= 0 && problems->item[i].y >= 0)
      paint_mark (paint, problems->item[i].x, problems->item[i].y, radius);
}
