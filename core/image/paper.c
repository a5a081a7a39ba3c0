/* The kind of drawing (dark lines, chalk, or lines on a transparent layer), and its luma.
 *
 * Automatic detection: a layer of which little is opaque, and that little is thin and of one tone, has lines on a
 * transparent layer; a picture that is mostly dark, along its edge as well, is chalk.  Everything else is dark on
 * light, so solid black areas stay ink as long as most of the edge is paper.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>

#define LEAST_BOARD 0.55 /* of a picture in chalk is dark; measured: .61 and more of 110 drawings as chalk, with lines of all
                          * breadths, and .50 at most of these in black, and of parts cut out of them */

/* ------------------------------------------------------------------ one value a pixel */

/* Luma of encoded colours, with the weights of Rec. 709.  All hosts use this function, because their own greys differ:
 * babl's Y' is encoded luminance, which is much lighter for saturated colours. */
void
celd_luma (const float *rgba, size_t n, float *luma, float *alpha)
{
  for (size_t i = 0; i < n; i++, rgba += 4)
    {
      luma[i] = 0.2126f * rgba[0] + 0.7152f * rgba[1] + 0.0722f * rgba[2];
      if (alpha)
        alpha[i] = rgba[3];
    }
}

static float
in_unit (float value, float otherwise)
{
  return value >= 0 ? (value < 1 ? value : 1) : value < 0 ? 0 : otherwise;
}

static float
opacity (const CeldDrawing *drawing, int x, int y)
{
  return drawing->alpha.data ? in_unit (CELD_AT (&drawing->alpha, x, y), 0) : 1;
}

/* The value of a pixel on paper that is white, or black for chalk. */
static float
paper_value (const CeldDrawing *drawing, CeldInkMode mode, int x, int y)
{
  float luma = CELD_AT (&drawing->luma, x, y), alpha = opacity (drawing, x, y);

  if (isnan (luma))
    return 1;
  luma = in_unit (luma, 1);
  return mode == CELD_INK_ALPHA ? 1 - alpha : mode == CELD_INK_LIGHT ? 1 - luma * alpha : 1 - (1 - luma) * alpha;
}

CELD_CLONES static void
opaque_values (const float *restrict luma, bool light, int n, float *restrict value)
{
  for (int x = 0; x < n; x++)
    {
      float v = luma[x] < 0 ? 0 : luma[x] > 1 ? 1 : luma[x];

      value[x] = isnan (v) ? 1 : light ? 1 - v : v;
    }
}

/* The values of n pixels of a row, from (x,y) on. */
static void
take_values (const CeldDrawing *drawing, CeldInkMode mode, int x, int y, int n, float *value)
{
  if (!drawing->alpha.data && mode != CELD_INK_ALPHA)
    opaque_values (&CELD_AT (&drawing->luma, x, y), mode == CELD_INK_LIGHT, n, value);
  else
    for (int i = 0; i < n; i++)
      value[i] = paper_value (drawing, mode, x + i, y);
}

static bool
has_transparency (const CeldDrawing *drawing)
{
  if (drawing->alpha.data)
    for (int y = 0; y < drawing->alpha.height; y++)
      for (int x = 0; x < drawing->alpha.width; x++)
        if (opacity (drawing, x, y) < 1)
          return true;
  return false;
}

/* Lines on a transparent layer: most of it is transparent, the rest is thin, and there is no contrast inside it as
 * there is between the outline and the fill of a sprite. */
bool
celd_is_line_layer (const CeldDrawing *drawing)
{
  int    width = drawing->luma.width, height = drawing->luma.height, side = width < height ? width : height;
  double opaque = 0, outline = 0, inside = 0;

  if (!has_transparency (drawing))
    return false;
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        float alpha = opacity (drawing, x, y), luma = in_unit (CELD_AT (&drawing->luma, x, y), 1);

        opaque += alpha;
        for (int k = 0; k < 2; k++)
          {
            int u = x + !k, v = y + k;

            if (u < width && v < height)
              {
                float beyond = opacity (drawing, u, v);

                outline += fabsf (alpha - beyond);
                inside += fminf (alpha, beyond) * fabsf (luma - in_unit (CELD_AT (&drawing->luma, u, v), 1));
              }
          }
      }
  return opaque < 0.6 * width * height && inside < 0.15 * outline && 2 * opaque < 0.06 * side * outline;
}

/* Histograms of values, filled in turn. */
typedef struct { unsigned of[CELD_INK_BANKS][CELD_INK_BINS]; } Banks;

CELD_CLONES static void
find_bins (const float *restrict value, int n, uint8_t *restrict bin)
{
  for (int x = 0; x < n; x++)
    bin[x] = (uint8_t) (value[x] * (CELD_INK_BINS - 1) + 0.5f);
}

static void
count_bins (const uint8_t *bin, int n, Banks *banks)
{
  for (int x = 0; x < n; x++)
    banks->of[x % CELD_INK_BANKS][bin[x]]++;
}

static int
within (int i, int least, int most)
{
  return i < least ? least : i < most ? i : most;
}

/* Adds the values of a row to histograms of the whole picture and of a band along its edge. */
static void
count_row (const CeldDrawing *drawing, int y, int band, Banks *whole, Banks *frame)
{
  int  width = drawing->luma.width;
  bool on_frame = y < band || y >= drawing->luma.height - band;

  for (int left = 0; left < width; left += CELD_RUN)
    {
      int     n = width - left < CELD_RUN ? width - left : CELD_RUN;
      int     inner = within (band - left, 0, n), outer = within (width - band - left, inner, n); /* off the bands */
      float   value[CELD_RUN];
      uint8_t bin[CELD_RUN];

      take_values (drawing, CELD_INK_DARK, left, y, n, value);
      find_bins (value, n, bin);
      count_bins (bin, n, whole);
      count_bins (bin, on_frame ? n : inner, frame);
      count_bins (bin + outer, on_frame ? 0 : n - outer, frame);
    }
}

/* Adds up the banks in the first of them; returns how many values there are. */
static size_t
add_banks (Banks *banks)
{
  size_t all = 0;

  for (int i = 0; i < CELD_INK_BINS; i++)
    {
      for (int k = 1; k < CELD_INK_BANKS; k++)
        banks->of[0][i] += banks->of[k][i];
      all += banks->of[0][i];
    }
  return all;
}

/* Chalk on dark paper: clearly most of the picture, and most of its edge, is darker than the middle between the darkest
 * and the lightest half per cent. */
static bool
is_chalk (const CeldDrawing *drawing)
{
  int    width = drawing->luma.width, height = drawing->luma.height, band = 1 + (width < height ? width : height) / 50;
  Banks  whole = { 0 }, frame = { 0 };
  size_t all, framed, below, dark = 0, dark_frame = 0;
  int    low = 0, high = CELD_INK_BINS - 1;

  for (int y = 0; y < height; y++)
    count_row (drawing, y, band, &whole, &frame);
  all = add_banks (&whole);
  framed = add_banks (&frame);
  for (below = whole.of[0][0]; below <= all / 200 && low < CELD_INK_BINS - 1; below += whole.of[0][++low])
    ;
  for (below = whole.of[0][high]; below <= all / 200 && high > 0; below += whole.of[0][--high])
    ;
  if (high - low < CELD_INK_BINS / 16)
    return low + high < CELD_INK_BINS - 1;
  for (int i = 0; 2 * i <= low + high; i++)
    {
      dark += whole.of[0][i];
      dark_frame += frame.of[0][i];
    }
  return (double) dark > LEAST_BOARD * (double) all && 2 * dark_frame > framed;
}

/* An opaque picture has no lines in its alpha, so CELD_INK_ALPHA is treated as CELD_INK_AUTO then. */
CeldInkMode
celd_ink_mode (const CeldDrawing *drawing, CeldInkMode mode)
{
  if (mode == CELD_INK_DARK || mode == CELD_INK_LIGHT)
    return mode;
  if (mode == CELD_INK_LINES)
    return CELD_INK_DARK; /* as celd_coloured_lines draws them */
  if (mode == CELD_INK_ALPHA ? has_transparency (drawing) : celd_is_line_layer (drawing))
    return CELD_INK_ALPHA;
  return is_chalk (drawing) ? CELD_INK_LIGHT : CELD_INK_DARK;
}

void
celd_ink_values (const CeldDrawing *drawing, CeldInkMode mode, CeldPlane *value)
{
  for (int y = 0; y < value->height; y++)
    take_values (drawing, mode, 0, y, value->width, &CELD_AT (value, 0, y));
}
