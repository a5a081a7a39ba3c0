/* How clearly the lines of a drawing differ from its paper: a photograph in place of a drawing has no clear ones.
 *
 * What a closing (or an opening) of a drawing adds to each pixel is either next to nothing or most of a line's
 * contrast.  In a photograph it takes all values in between.  So a drawing is told by the share of partial values: of
 * the pixels where a closing adds much, those where it adds about half of the contrast, at the closing with the fewest.
 * Of 430 drawings (ink, pencil, chalk, coloured, washed, hatched, with tones, scanned, photographed) none has more than
 * 0.44; of 108 photographs 87 have more than 0.46, and so have 6 of 66 drawings that are hard to read: faint on grain,
 * with much soft shading, or photographed with the desk that they lie on.
 *
 * The values must also separate into two classes, by Otsu's measure [A threshold selection method from gray-level
 * histograms, 1979]: the variance between the classes as a fraction of all variance.  Where it is less than 0.72, as in
 * none of these drawings, the picture is refused.  So it is if the share is large and more than 0.07 of all variation
 * stays in the closed picture: where lines explain a picture, little does, in those 6 drawings 0.05 at most.  Both
 * refuse 70 of the photographs.  Otherwise a large share is only a reason to warn.
 *
 * Strong fills beside thin lines may look alike, in grey, so a picture of flat fills is a drawing in any case.
 *
 * Grain hides lines, so a picture without clear ones is also smoothed.  A picture without an edge is shade alone, and
 * refused at once.
 *
 * Cost: O(pixels), at most eight closings, one for most drawings; 2 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_SIDE  64  /* pixels; smaller pictures tell too little; chosen */
#define DIAGONAL    60  /* the radius of the closing is this part of the diagonal, and two fifths of that; chosen */
#define LEAST_RANGE 26  /* of 255: contrast of what is no blank page; chosen */
#define CLOSINGS    8   /* at most: for progress */
#define EDGE_WIDTH  4   /* pixels across the edge of a blurred line; chosen */
#define LEAST_EDGE  12  /* of 255: the difference across an edge, at least; chosen */

#define CONTRAST_RANK  0.99 /* of what a closing adds: that of a line; chosen */
#define LITTLE_OF_LINE 0.3  /* of the contrast: less is grain or blur; chosen */
#define MOST_OF_LINE   0.6  /* of the contrast: more is the core of a line; chosen */
#define MANY_PARTIAL   0.46 /* the share of partial values in what may be no drawing (measured, see above) */
#define LEAST_CLASSES  0.72 /* Otsu's measure of drawings with as many (measured) */
#define LEAST_RADIUS   4    /* pixels: grain stays in narrower closings, too; measured */
#define MANY_FLAT      0.45 /* of pixels are flat in coloured drawings (measured: 0.5 to 0.95; photographs: up to 0.35) */
#define MOST_FLAT      0.9  /* of these have ... */
#define FILL_VALUES    40   /* ... so many values at most (measured: up to 26) */
#define MUCH_STAYS     0.07 /* the share of variation that stays in photographs with as many (measured) */

typedef struct
{
  const CeldHost *host;
  CeldMask        picture, changed;
  void           *work;     /* of celd_close_bytes */
  int             radius;   /* of the widest closing */
  int             closings; /* made so far */
  double          partial;  /* the least share of partial values so far */
  double          classes;  /* the best separation so far */
  double          stays;    /* the least share of variation that stays, so far */
} ClarityWork;

/* ------------------------------------------------------------------ partial values */

/* Of what a closing added to the pixels, in a histogram; 0 if it added little everywhere. */
static double
partial_share (const size_t histogram[256], size_t pixels)
{
  size_t below = 0, partial = 0, much = 0;
  int    contrast = 0;

  while (contrast < 255 && (double) (below += histogram[contrast]) < CONTRAST_RANK * (double) pixels)
    contrast++;
  contrast = contrast > LEAST_RANGE ? contrast : LEAST_RANGE;
  for (int i = (int) ceil (LITTLE_OF_LINE * contrast); i < 256; i++)
    {
      much += histogram[i];
      partial += i < MOST_OF_LINE * contrast ? histogram[i] : 0;
    }
  return much ? (double) partial / (double) much : 0;
}

/* ------------------------------------------------------------------ Otsu's measure */

/* Of a histogram; 1 if all values are about the same. */
static double
separation (const size_t histogram[256])
{
  double n = 0, mean = 0, variance = 0, below = 0, below_sum = 0, best = 0;

  for (int i = 0; i < 256; i++)
    {
      n    += (double) histogram[i];
      mean += i * (double) histogram[i];
    }
  mean /= n;
  for (int i = 0; i < 256; i++)
    variance += (i - mean) * (i - mean) * (double) histogram[i];
  for (int i = 0; i < 255; i++)
    {
      below     += (double) histogram[i];
      below_sum += i * (double) histogram[i];
      if (below > 0 && below < n)
        best = fmax (best, (mean * below - below_sum) * (mean * below - below_sum) / (below * (n - below) / n));
    }
  return variance > 0 ? best / variance : 1;
}

/* ------------------------------------------------------------------ variation */

CELD_CLONES static uint32_t
sum_differences (const uint8_t *a, const uint8_t *b, int n)
{
  uint32_t sum = 0;

  for (int x = 0; x < n; x++)
    sum += (uint32_t) (a[x] > b[x] ? a[x] - b[x] : b[x] - a[x]);
  return sum;
}

/* The sum of the differences of neighbours. */
static double
variation (const CeldMask *picture)
{
  double sum = 0;

  for (int y = 0; y < picture->height; y++)
    {
      const uint8_t *row = &CELD_AT (picture, 0, y);

      sum += sum_differences (row, row + 1, picture->width - 1);
      if (y > 0)
        sum += sum_differences (row, &CELD_AT (picture, 0, y - 1), picture->width);
    }
  return sum;
}

/* ------------------------------------------------------------------ closings */

static bool
is_clear (const ClarityWork *w)
{
  return w->partial < MANY_PARTIAL && w->classes >= LEAST_CLASSES;
}

/* Of a picture whose lines are not clear. */
static bool
is_without_lines (const ClarityWork *w)
{
  return w->classes < LEAST_CLASSES || (w->radius >= LEAST_RADIUS && w->stays >= MUCH_STAYS);
}

/* What a closing adds to the picture, and what it leaves if there are still no clear lines. */
static CeldStatus
measure_closing (ClarityWork *w, int radius)
{
  size_t of[CELD_INK_BANKS][256] = { { 0 } }, n = (size_t) w->picture.width * (size_t) w->picture.height;

  celd_close_bytes (&w->picture, radius, w->work, &w->changed);
  for (size_t i = 0; i < n; i++)
    of[i % CELD_INK_BANKS][w->changed.data[i] - w->picture.data[i]]++;
  for (int k = 1; k < CELD_INK_BANKS; k++)
    for (int i = 0; i < 256; i++)
      of[0][i] += of[k][i];
  w->partial = fmin (w->partial, partial_share (of[0], n));
  w->classes = fmax (w->classes, separation (of[0]));
  if (!is_clear (w))
    w->stays = fmin (w->stays, variation (&w->changed) / variation (&w->picture));
  return celd_progress (w->host, (double) ++w->closings / CLOSINGS);
}

/* By closings and openings of two sizes, until there are clear lines. */
static CeldStatus
measure_lines (ClarityWork *w)
{
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 4 && !is_clear (w) && status == CELD_OK; i++)
    {
      int fine = 2 * w->radius / 5;

      if (i % 2)
        celd_invert_bytes (&w->picture); /* its closing is the opening */
      status = measure_closing (w, i < 2 ? w->radius : fine > 2 ? fine : 2);
      if (i % 2)
        celd_invert_bytes (&w->picture);
    }
  return status;
}

/* ------------------------------------------------------------------ the picture */

static CeldStatus
start_work (int width, int height, ClarityWork *w)
{
  w->radius = (int) (hypot (width, height) / DIAGONAL + 0.5);
  w->picture = w->changed = (CeldMask) { width, height, (size_t) width, NULL };
  w->picture.data = celd_alloc ((size_t) width * (size_t) height, 1);
  w->changed.data = celd_alloc ((size_t) width * (size_t) height, 1);
  w->work = celd_alloc (celd_erosion_work (width, w->radius > 2 ? w->radius : 2), 1);
  return w->picture.data && w->changed.data && w->work ? CELD_OK : CELD_NO_MEMORY;
}

static void
end_work (ClarityWork *w)
{
  celd_free (w->picture.data);
  celd_free (w->changed.data);
  celd_free (w->work);
}

/* Composites the drawing on white. */
static void
take_picture (const CeldDrawing *drawing, CeldMask *picture)
{
  for (int y = 0; y < picture->height; y++)
    for (int x = 0; x < picture->width; x++)
      {
        float luma = CELD_AT (&drawing->luma, x, y);
        float alpha = drawing->alpha.data ? CELD_AT (&drawing->alpha, x, y) : 1;
        float on_white = 1 - alpha * (1 - luma);

        CELD_AT (picture, x, y) = (uint8_t) (255 * (on_white > 0 ? celd_least (on_white, 1) : 0) + 0.5f);
      }
}

static bool
is_blank (const CeldMask *picture)
{
  uint8_t least = 255, most = 0;

  for (size_t i = 0; i < (size_t) picture->width * (size_t) picture->height; i++)
    {
      least = picture->data[i] < least ? picture->data[i] : least;
      most = picture->data[i] > most ? picture->data[i] : most;
    }
  return most - least < LEAST_RANGE;
}

/* Whether pixels differ from others a few pixels away; a picture that is not blank and has no edges is shade alone. */
static bool
has_edges (const CeldMask *picture)
{
  for (int y = 0; y < picture->height; y++)
    for (int x = 0; x < picture->width; x++)
      {
        int value = CELD_AT (picture, x, y);

        if ((x >= EDGE_WIDTH && abs (value - CELD_AT (picture, x - EDGE_WIDTH, y)) >= LEAST_EDGE) ||
            (y >= EDGE_WIDTH && abs (value - CELD_AT (picture, x, y - EDGE_WIDTH)) >= LEAST_EDGE))
          return true;
      }
  return false;
}

CELD_CLONES static void
mean_of_three (const uint8_t *a, const uint8_t *b, const uint8_t *c, int n, uint8_t *restrict mean)
{
  for (int x = 0; x < n; x++)
    mean[x] = (uint8_t) ((uint16_t) (a[x] + b[x] + c[x] + 1) / 3);
}

/* Removes grain, which would hide lines: means of 3 x 3 pixels.  Sides are at least two pixels long. */
static void
smooth (CeldMask *picture, CeldMask *spare)
{
  int width = picture->width, height = picture->height;

  for (int y = 0; y < height; y++)
    {
      const uint8_t *row = &CELD_AT (picture, 0, y);
      uint8_t       *mean = &CELD_AT (spare, 0, y);

      mean_of_three (row, row, row + 1, 1, mean);
      mean_of_three (row, row + 1, row + 2, width - 2, mean + 1);
      mean_of_three (row + width - 2, row + width - 1, row + width - 1, 1, mean + width - 1);
    }
  for (int y = 0; y < height; y++)
    mean_of_three (&CELD_AT (spare, 0, y > 0 ? y - 1 : 0), &CELD_AT (spare, 0, y),
                   &CELD_AT (spare, 0, y + 1 < height ? y + 1 : y), width, &CELD_AT (picture, 0, y));
}

static int
commonest (const size_t histogram[256])
{
  int most = 0;

  for (int i = 1; i < 256; i++)
    most = histogram[i] > histogram[most] ? i : most;
  return most;
}

/* How many of the commonest values together have this share of all; empties their counts. */
static int
values_of_most (size_t histogram[256], double share)
{
  size_t all = 0, taken = 0;
  int    values = 0;

  for (int i = 0; i < 256; i++)
    all += histogram[i];
  for (; (double) taken < share * (double) all; values++)
    {
      int next = commonest (histogram);

      taken += histogram[next];
      histogram[next] = 0;
    }
  return values;
}

/* Does the picture consist of flat fills, as a coloured drawing and no photograph?  Of the pixels that are not of the
 * commonest value, which is the paper, most equal those beside and below them, and these have few values. */
static bool
has_flat_fills (const CeldMask *picture)
{
  size_t all[256] = { 0 }, of[256] = { 0 }, pixels = 0, flat = 0;
  int    paper;

  for (size_t i = 0; i < (size_t) picture->width * (size_t) picture->height; i++)
    all[picture->data[i]]++;
  paper = commonest (all);
  for (int y = 0; y + 1 < picture->height; y++)
    for (int x = 0; x + 1 < picture->width; x++)
      {
        const uint8_t *v = &CELD_AT (picture, x, y), *below = v + picture->stride;

        if (*v == paper)
          continue;
        pixels++;
        if (v[1] == *v && below[0] == *v && below[1] == *v)
          {
            of[*v]++;
            flat++;
          }
      }
  return (double) flat >= MANY_FLAT * (double) pixels && values_of_most (of, MOST_FLAT) <= FILL_VALUES;
}

static CeldStatus
measure_picture (ClarityWork *w)
{
  CeldStatus status = measure_lines (w);

  if (status == CELD_OK && !is_clear (w))
    {
      smooth (&w->picture, &w->changed);
      status = measure_lines (w);
    }
  return status;
}

CeldStatus
celd_line_clarity (const CeldDrawing *drawing, const CeldHost *host, CeldLineClarity *clarity)
{
  int             width = drawing->luma.width, height = drawing->luma.height;
  ClarityWork     w = { .host = host, .partial = 1, .stays = 1 };
  CeldLineClarity found = CELD_LINES_CLEAR;
  CeldStatus      status;

  if (drawing->alpha.data && !CELD_SAME_SIZE (&drawing->alpha, &drawing->luma))
    return CELD_BAD_SIZE;
  if (width < LEAST_SIDE || height < LEAST_SIDE)
    {
      *clarity = CELD_LINES_CLEAR;
      return CELD_OK;
    }
  status = start_work (width, height, &w);
  if (status == CELD_OK)
    {
      take_picture (drawing, &w.picture);
      if (!is_blank (&w.picture) && !has_edges (&w.picture))
        found = CELD_LINES_NONE;
      else if (!is_blank (&w.picture))
        {
          status = measure_picture (&w);
          if (!is_clear (&w))
            found = is_without_lines (&w) ? CELD_LINES_NONE : CELD_LINES_UNSURE;
          if (found != CELD_LINES_CLEAR)
            {
              take_picture (drawing, &w.picture); /* it may have been smoothed */
              found = has_flat_fills (&w.picture) ? CELD_LINES_CLEAR : found;
            }
        }
    }
  end_work (&w);
  if (status == CELD_OK)
    *clarity = found;
  return status;
}
