/* Light from the picture of a lit ball (a matcap), which is read where the ball has the normal of the surface.
 *
 * The ball fills the picture; nothing is read beside it, nor where its outline is mixed with what is beside it.
 *
 * Art shows surfaces that face the viewer, so its colour takes the place of that in the middle of the ball: darker
 * places of the ball darken it by the quotient, brighter ones lighten it up to CELD_MOST_TONE times, and what is even
 * brighter, in all three colours, is gloss.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "light/light.h"

#define OUTLINE 2.2  /* pixels between the outline of the ball and the middle of what is interpolated: then all four
                      * pixels lie within the ball */
#define DIM     1e-3 /* added to both sides of a quotient of colours, so that black is not divided by (chosen) */

/* Bilinear interpolation, weighted by alpha; black where all is transparent. */
static void
sample (const CeldColours *picture, double u, double v, double rgb[3])
{
  double x = fmax (0, fmin (u * picture->width - 0.5, picture->width - 1));
  double y = fmax (0, fmin (v * picture->height - 0.5, picture->height - 1));
  int    left = (int) x, top = (int) y;
  double sum = 0;

  rgb[0] = rgb[1] = rgb[2] = 0;
  for (int k = 0; k < 4; k++)
    {
      int          px = left + (k & 1 && left + 1 < picture->width), py = top + (k & 2 && top + 1 < picture->height);
      const float *rgba = CELD_RGBA (picture, px, py);
      double       weight = (k & 1 ? x - left : 1 - x + left) * (k & 2 ? y - top : 1 - y + top) * (double) rgba[3];

      if (!(weight > 0))
        continue;
      sum += weight;
      for (int c = 0; c < 3; c++)
        rgb[c] += weight * (double) rgba[c];
    }
  for (int c = 0; c < 3; c++)
    rgb[c] = sum > 0 ? rgb[c] / sum : 0;
}

/* The colour of the ball where it has this normal; NaN counts as facing the viewer. */
static void
ball_at (const CeldColours *matcap, const float *normal, double rgb[3])
{
  double nx = normal[0] >= -1 && normal[0] <= 1 ? (double) normal[0] : 0;
  double ny = normal[1] >= -1 && normal[1] <= 1 ? (double) normal[1] : 0;
  double most = fmax (0, 1 - 2 * OUTLINE / fmin (matcap->width, matcap->height)), length = hypot (nx, ny);

  if (length > most)
    {
      nx *= most / length;
      ny *= most / length;
    }
  sample (matcap, 0.5 + 0.5 * nx, 0.5 - 0.5 * ny, rgb);
}

/* How much white has to lie over the art for no tone to exceed CELD_MOST_TONE; but not more than there is in the
 * brightening of each colour. */
static double
white_over (const double ball[3], const double middle[3])
{
  double needed = 0, common = 1;

  for (int c = 0; c < 3; c++)
    {
      double room = 1 - fmin (middle[c], 1 - DIM), darker = 1 - fmin (CELD_MOST_TONE * middle[c], 1 - DIM);

      needed = fmax (needed, (ball[c] - CELD_MOST_TONE * middle[c]) / darker);
      common = fmin (common, (ball[c] - middle[c]) / room);
    }
  return fmax (0, fmin (fmin (needed, common), 1));
}

void
celd_matcap_at (const CeldLamp *lamp, int x, int y, double tone[3], double *gloss)
{
  static const float facing[3] = { 0, 0, 1 };
  double             ball[3], middle[3];

  ball_at (lamp->matcap, CELD_XYZ (lamp->normals, x, y), ball);
  ball_at (lamp->matcap, facing, middle);
  *gloss = white_over (ball, middle);
  for (int c = 0; c < 3; c++)
    {
      double quotient = (ball[c] - *gloss + DIM) / ((1 - *gloss) * middle[c] + DIM);

      tone[c] = fmax (0, fmin (quotient, CELD_MOST_TONE));
    }
}
