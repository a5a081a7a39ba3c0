/* Frame packing: a left and a right view in one picture, side by side, one over the other, interlaced in rows or
 * columns, or as an anaglyph.
 *
 * Anaglyphs are linear maps of both colours in linear light that preserve white and greys.  Dubois's matrices for red
 * and cyan glasses approximate the view meant for each eye by least squares, as seen through its glass [Dub01].
 *
 *   [Dub01]  E. Dubois: A Projection Method to Generate Anaglyph Stereo Images.  ICASSP 2001.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"

#include <math.h>

/* Matrices from r, g, b of the left and of the right view to those of the anaglyph. */
typedef struct { float left[3][3], right[3][3]; } Anaglyph;

#define GREY     { 0.2126f, 0.7152f, 0.0722f } /* luminance of linear sRGB (IEC 61966-2-1) */
#define ZERO_ROW { 0, 0, 0 }

static const Anaglyph grey = { { GREY, ZERO_ROW, ZERO_ROW }, { ZERO_ROW, GREY, GREY } };
static const Anaglyph colour = { { { 1, 0, 0 }, ZERO_ROW, ZERO_ROW }, { ZERO_ROW, { 0, 1, 0 }, { 0, 0, 1 } } };
static const Anaglyph half_colour = { { GREY, ZERO_ROW, ZERO_ROW }, { ZERO_ROW, { 0, 1, 0 }, { 0, 0, 1 } } };
static const Anaglyph dubois = {
  { { 0.437f, 0.449f, 0.164f }, { -0.062f, -0.062f, -0.024f }, { -0.048f, -0.050f, -0.017f } },
  { { -0.011f, -0.032f, -0.007f }, { 0.377f, 0.761f, 0.009f }, { -0.026f, -0.093f, 1.234f } },
};

static const Anaglyph *
anaglyph_of (CeldStereo format)
{
  switch (format)
    {
    case CELD_STEREO_GREY:        return &grey;
    case CELD_STEREO_COLOUR:      return &colour;
    case CELD_STEREO_HALF_COLOUR: return &half_colour;
    case CELD_STEREO_DUBOIS:      return &dubois;
    default:                      return NULL;
    }
}

/* Transparent parts of a view add nothing. */
static void
mix_anaglyph (const Anaglyph *g, const float *left, const float *right, float *to)
{
  float alpha = fmaxf (left[3], right[3]);
  float one = alpha > 0 ? left[3] / alpha : 0, other = alpha > 0 ? right[3] / alpha : 0;

  for (int c = 0; c < 3; c++)
    {
      float sum = 0;

      for (int k = 0; k < 3; k++)
        sum += g->left[c][k] * one * left[k] + g->right[c][k] * other * right[k];
      to[c] = fmaxf (0, fminf (sum, 1));
    }
  to[3] = alpha;
}

void
celd_stereo_size (CeldStereo format, int *width, int *height)
{
  if (format == CELD_STEREO_SIDE_BY_SIDE || format == CELD_STEREO_CROSSED)
    *width *= 2;
  else if (format == CELD_STEREO_OVER_UNDER)
    *height *= 2;
}

/* The mean of two pixels, weighted by alpha. */
static void
average (const float *a, const float *b, float *to)
{
  float alpha = a[3] + b[3];

  for (int c = 0; c < 3; c++)
    to[c] = alpha > 0 ? (a[c] * a[3] + b[c] * b[3]) / alpha : 0;
  to[3] = alpha / 2;
}

/* Makes pixel (x,y) of the packed picture, of the pixel (x,y) of each view or later ones where it has the size of a
 * view. */
static void
join_pixel (const CeldColours *left, const CeldColours *right, CeldStereo format, int x, int y, float *to)
{
  int                w = left->width, h = left->height, half = (w + 1) / 2, low = (h + 1) / 2;
  const CeldColours *view = left;

  switch (format)
    {
    case CELD_STEREO_SIDE_BY_SIDE:
    case CELD_STEREO_CROSSED:
      view = (x >= w) == (format == CELD_STEREO_SIDE_BY_SIDE) ? right : left;
      memcpy (to, CELD_RGBA (view, x % w, y), 4 * sizeof *to);
      break;
    case CELD_STEREO_HALF_SIDE_BY_SIDE:
      view = x >= half ? right : left;
      x    = 2 * (x >= half ? x - half : x);
      average (CELD_RGBA (view, x, y), CELD_RGBA (view, x + 1 < w ? x + 1 : x, y), to);
      break;
    case CELD_STEREO_OVER_UNDER:
      memcpy (to, CELD_RGBA (y >= h ? right : left, x, y % h), 4 * sizeof *to);
      break;
    case CELD_STEREO_HALF_OVER_UNDER:
      view = y >= low ? right : left;
      y    = 2 * (y >= low ? y - low : y);
      average (CELD_RGBA (view, x, y), CELD_RGBA (view, x, y + 1 < h ? y + 1 : y), to);
      break;
    case CELD_STEREO_INTERLACED:
      memcpy (to, CELD_RGBA (y % 2 ? right : left, x, y), 4 * sizeof *to);
      break;
    case CELD_STEREO_COLUMNS:
      memcpy (to, CELD_RGBA (x % 2 ? right : left, x, y), 4 * sizeof *to);
      break;
    case CELD_STEREO_LEFT:
    case CELD_STEREO_RIGHT:
      memcpy (to, CELD_RGBA (format == CELD_STEREO_LEFT ? left : right, x, y), 4 * sizeof *to);
      break;
    default:
      mix_anaglyph (anaglyph_of (format), CELD_RGBA (left, x, y), CELD_RGBA (right, x, y), to);
    }
}

CeldStatus
celd_stereo_join (const CeldColours *left, const CeldColours *right, CeldStereo format, CeldColours *joined)
{
  int width = left->width, height = left->height;

  celd_stereo_size (format, &width, &height);
  if (!CELD_SAME_SIZE (left, right) || !joined->data || joined->width != width || joined->height != height)
    return CELD_BAD_SIZE;
  if ((unsigned) format > CELD_STEREO_DUBOIS)
    return CELD_BAD_VALUE;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        float pixel[4];

        join_pixel (left, right, format, x, y, pixel);
        memcpy (CELD_RGBA (joined, x, y), pixel, sizeof pixel);
      }
  return CELD_OK;
}
