/* A photograph in place of a drawing or of scribbles.
 *
 * The lines of a drawing differ clearly from its paper: what a closing (or an opening) of the picture adds to each
 * pixel is either next to nothing or most of a line's contrast.  In a photograph it takes all values in between.  The
 * measure is that of Otsu [A threshold selection method from gray-level histograms, 1979]: the variance between the two
 * classes of pixels that a threshold separates best, as a fraction of all variance.  Of 50 drawings of all kinds (ink,
 * pencil, chalk, coloured, scanned, photographed on a desk) the least has 0.80, most have more than 0.9; of 26
 * photographs, renderings and textures 17 have less than 0.74.  Grain hides lines, so the picture is also smoothed.
 *
 * Scribbles are told by their flat colours: neighbours that are equal are 0.88 of all pixels at least, in a photograph
 * less than 0.36; or if they are scanned by their blank page.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <math.h>
#include <string.h>

#define PHOTOGRAPH   0.74 /* Otsu's measure of photographs, at most (measured, see above) */
#define ODD          0.78 /* of what is no common drawing, at most (measured) */
#define LEAST_SIDE   64   /* pixels; smaller pictures tell too little (chosen) */
#define RADIUS       60   /* of the closing: this part of the diagonal, and two fifths of that (chosen) */
#define LEAST_RANGE  0.1  /* contrast of what is no blank page, of 1 (chosen) */
#define BINS         256
#define LEAST_FLAT   0.5  /* the share of equal neighbours in scribbles, at least (measured, see above) */
#define LEAST_BLANK  0.6  /* the share of the commonest colour in scribbles on scanned paper, at least (chosen) */

/* ------------------------------------------------------------------ closings */

/* The least or the largest of each 2 r + 1 values, by the algorithm of van Herk and Gil-Werman: of each block of that
 * length from its start to each value, and from each value to its end. */
static void
running_extreme (const float *from, size_t step, int n, int r, float sign, float *work, float *to, size_t to_step)
{
  int    length = 2 * r + 1, padded = (n + 2 * r + length - 1) / length * length;
  float *value = work, *behind = work + padded, *before = work + 2 * (size_t) padded;

  for (int i = 0; i < padded; i++)
    value[i] = sign * from[(size_t) CLAMP (i - r, 0, n - 1) * step];
  for (int i = 0; i < padded; i++)
    behind[i] = i % length ? MAX (behind[i - 1], value[i]) : value[i];
  for (int i = padded - 1; i >= 0; i--)
    before[i] = (i + 1) % length ? MAX (before[i + 1], value[i]) : value[i];
  for (int i = 0; i < n; i++)
    to[(size_t) i * to_step] = sign * MAX (before[i], behind[i + 2 * r]);
}

/* The largest (sign 1) or least (-1) value of each square, in place. */
static void
square_extreme (CeldPlane *plane, int r, float sign, float *work)
{
  int    w = plane->width, h = plane->height, longest = MAX (w, h);
  float *line = work + 3 * ((size_t) longest + 4 * (size_t) r + 2);

  for (int y = 0; y < h; y++)
    {
      float *row = plane->data + (size_t) y * plane->stride;

      running_extreme (row, 1, w, r, sign, work, line, 1);
      memcpy (row, line, (size_t) w * sizeof *row);
    }
  for (int x = 0; x < w; x++)
    {
      running_extreme (plane->data + x, plane->stride, h, r, sign, work, line, 1);
      for (int y = 0; y < h; y++)
        plane->data[(size_t) y * plane->stride + (size_t) x] = line[y];
    }
}

/* ------------------------------------------------------------------ Otsu's measure */

/* Of a histogram; 1 if all values are about the same. */
static double
separation (const size_t *histogram)
{
  double n = 0, mean = 0, variance = 0, below = 0, below_sum = 0, best = 0;

  for (int i = 0; i < BINS; i++)
    {
      n    += (double) histogram[i];
      mean += i * (double) histogram[i];
    }
  mean /= n;
  for (int i = 0; i < BINS; i++)
    variance += (i - mean) * (i - mean) * (double) histogram[i];
  for (int i = 0; i < BINS - 1; i++)
    {
      below     += (double) histogram[i];
      below_sum += i * (double) histogram[i];
      if (below > 0 && below < n)
        best = fmax (best, (mean * below - below_sum) * (mean * below - below_sum) / (below * (n - below) / n));
    }
  return variance > 0 ? best / variance : 1;
}

/* How well what the closing (sign 1) or opening (-1) of a picture adds to it separates into two classes. */
static double
line_separation (const CeldPlane *picture, int r, float sign, CeldPlane *changed, float *work)
{
  size_t histogram[BINS] = { 0 }, n = (size_t) picture->width * (size_t) picture->height;

  memcpy (changed->data, picture->data, n * sizeof *changed->data);
  square_extreme (changed, r, sign, work);
  square_extreme (changed, r, -sign, work);
  for (size_t i = 0; i < n; i++)
    {
      int bin = (int) (sign * (changed->data[i] - picture->data[i]) * (BINS - 1) + 0.5f);

      histogram[CLAMP (bin, 0, BINS - 1)]++;
    }
  return separation (histogram);
}

/* The picture on white; free data with g_free. */
static bool
composite (const CeldDrawing *drawing, CeldPlane *picture)
{
  const CeldPlane *luma = &drawing->luma, *alpha = &drawing->alpha;
  int              w = luma->width;

  if (!cli_plane_new (w, luma->height, picture))
    return false;
  for (int y = 0; y < luma->height; y++)
    for (int x = 0; x < w; x++)
      {
        float opaque = alpha->data ? alpha->data[(size_t) y * alpha->stride + (size_t) x] : 1;

        picture->data[y * w + x] = opaque * luma->data[(size_t) y * luma->stride + (size_t) x] + 1 - opaque;
      }
  return true;
}

/* Takes the mean of three pixels in each row, or column if step is the stride. */
static void
smooth_line (float *value, size_t step, int n)
{
  float before = value[0], here;

  for (int i = 0; i < n; i++)
    {
      here = value[(size_t) i * step];
      value[(size_t) i * step] = (before + here + value[(size_t) MIN (i + 1, n - 1) * step]) / 3;
      before = here;
    }
}

/* Removes grain, which would hide lines. */
static void
smooth (CeldPlane *picture)
{
  for (int y = 0; y < picture->height; y++)
    smooth_line (picture->data + (size_t) y * picture->stride, 1, picture->width);
  for (int x = 0; x < picture->width; x++)
    smooth_line (picture->data + x, picture->stride, picture->height);
}

/* The best separation by closings and openings of two sizes, of which those are left out that no longer matter. */
static double
best_separation (const CeldPlane *picture, int r, CeldPlane *changed, float *work)
{
  double best = 0;

  for (int fine = 0; fine < 2; fine++)
    for (float sign = 1; sign >= -1 && best < ODD; sign -= 2)
      best = fmax (best, line_separation (picture, fine ? MAX (2 * r / 5, 2) : r, sign, changed, work));
  return best;
}

static bool
is_blank (const CeldPlane *picture)
{
  float least = INFINITY, most = -INFINITY;

  for (size_t i = 0; i < (size_t) picture->width * (size_t) picture->height; i++)
    {
      least = fminf (least, picture->data[i]);
      most  = fmaxf (most, picture->data[i]);
    }
  return most - least < (float) LEAST_RANGE;
}

/* Blank pages are refused elsewhere, with another reason. */
bool
cli_check_drawing (const char *path, const CeldDrawing *drawing, bool quiet)
{
  int       w = drawing->luma.width, h = drawing->luma.height, r = (int) (hypot (w, h) / RADIUS + 0.5);
  CeldPlane picture = { 0 }, changed = { 0 };
  float    *work;
  double    best = 0;
  bool      good;

  if (MIN (w, h) < LEAST_SIDE)
    return true;
  work = g_new (float, 4 * ((size_t) MAX (w, h) + 4 * (size_t) r + 2));
  good = composite (drawing, &picture) && cli_plane_new (w, h, &changed);
  if (good)
    best = is_blank (&picture) ? 1 : best_separation (&picture, r, &changed, work);
  if (good && best < ODD)
    {
      smooth (&picture);
      best = fmax (best, best_separation (&picture, r, &changed, work));
    }
  g_free (picture.data);
  g_free (changed.data);
  g_free (work);
  if (good && best < PHOTOGRAPH)
    return cli_error ("\"%s\" looks like a photograph or a painting without lines; if it is a drawing, say what its "
                      "lines are, such as --ink dark.", path);
  if (good && best < ODD && !quiet)
    cli_say ("\"%s\" hardly has clear lines: if it is no drawing, the result makes no sense.", path);
  return good;
}

/* ------------------------------------------------------------------ scribbles */

/* Whether two pixels R,G,B,A look alike. */
static bool
are_equal (const uint8_t *p, const uint8_t *q)
{
  return (!p[3] && !q[3]) || !memcmp (p, q, 4);
}

/* The share of the commonest colour, of 8 steps a channel. */
static double
blank_share (const CeldPaint *paint)
{
  size_t count[512] = { 0 }, most = 0, n = (size_t) paint->width * (size_t) paint->height;

  for (size_t i = 0; i < n; i++)
    {
      const uint8_t *p = paint->data + 4 * (i / (size_t) paint->width * paint->stride + i % (size_t) paint->width);
      size_t        *of = &count[p[3] ? (p[0] >> 5) << 6 | (p[1] >> 5) << 3 | p[2] >> 5 : 511];

      most = MAX (most, ++*of);
    }
  return (double) most / (double) n;
}

bool
cli_check_scribbles (const char *path, const CeldPaint *scribbles)
{
  size_t flat = 0, n = (size_t) (scribbles->width - 1) * (size_t) (scribbles->height - 1);

  for (int y = 0; y + 1 < scribbles->height; y++)
    for (int x = 0; x + 1 < scribbles->width; x++)
      {
        const uint8_t *p = scribbles->data + 4 * ((size_t) y * scribbles->stride + (size_t) x);

        flat += are_equal (p, p + 4) && are_equal (p, p + 4 * scribbles->stride);
      }
  return MIN (scribbles->width, scribbles->height) < LEAST_SIDE || (double) flat >= LEAST_FLAT * (double) n ||
         blank_share (scribbles) >= LEAST_BLANK ||
         cli_error ("\"%s\" looks like a photograph: scribbles are strokes in flat colours on a blank layer.", path);
}
