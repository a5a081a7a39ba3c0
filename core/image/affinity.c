/* The weights of eq. (1), as in [Gra06]:  w_pq = exp (-(I_p - I_q)^2 / sigma), but at least a floor.
 *
 * The paper calls sigma "a mean contrast of edges".  We take the mean of (I_p - I_q)^2 over all pairs of neighbours of
 * the ink, whether they differ or not.  Then a step of full contrast has almost no weight, so that a contour is as good
 * as closed, as in smooth depth.  Over only the pairs that differ the mean would be about 0.2, an antialiased contour
 * would have a weight of 0.3, and depth would leak through all contours; besides, the noise of a scan would decide
 * which pairs differ.  Without any difference all weights are 1.
 *
 * In the weight itself I_p - I_q is the contrast around the pair: the range of ink within the 3 x 3 pixels around p, or
 * around q if that is less.  The difference of the two pixels alone fails with antialiasing: along a nearly horizontal
 * line ink fades into paper in dozens of tiny steps, and these paths around the large steps leak more than all other
 * contours.  The lesser of the two ranges keeps the paper beside a line connected with the paper.
 *
 * Weights below about 1e-16 would be lost beside 1, hence the floor; the program is exact for weights with the floor.
 * It also connects all pixels, so that the solution is unique up to a constant.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"

#include <math.h>

typedef struct
{
  const CeldPlane *ink;
  float           *contrast;       /* around each pixel */
  float           *east, *south;
  double          *sum;            /* of the squared differences in each row, and to the next */
  double           scale;          /* 1 / sigma, 0 if nothing differs */
  float            floor;
} Affinities;

static float
ink_at (const CeldPlane *ink, int x, int y)
{
  float value = CELD_AT (ink, x, y);

  return isfinite (value) ? value : 1;
}

typedef struct { float low, high; } InkRange;

static InkRange
join (InkRange a, InkRange b)
{
  return (InkRange) { a.low < b.low ? a.low : b.low, a.high > b.high ? a.high : b.high };
}

/* The range of a pixel and its upper and lower neighbours, as far as they are in the picture. */
static InkRange
column (const CeldPlane *ink, int x, int y)
{
  float here = ink_at (ink, x, y), above = y > 0 ? ink_at (ink, x, y - 1) : here;
  float below = y + 1 < ink->height ? ink_at (ink, x, y + 1) : here;

  return join ((InkRange) { here, here }, join ((InkRange) { above, above }, (InkRange) { below, below }));
}

static void
measure_row (void *data, int y)
{
  Affinities      *a = data;
  const CeldPlane *ink = a->ink;
  float           *contrast = a->contrast + (size_t) y * (size_t) ink->width;
  InkRange         left = column (ink, 0, y), middle = left, right;
  double           sum = 0;

  for (int x = 0; x < ink->width; x++)
    {
      bool     east = x + 1 < ink->width, south = y + 1 < ink->height;
      float    here = ink_at (ink, x, y);
      float    to_east = east ? ink_at (ink, x + 1, y) - here : 0, to_south = south ? ink_at (ink, x, y + 1) - here : 0;
      InkRange whole;

      right       = east ? column (ink, x + 1, y) : middle;
      whole       = join (join (left, middle), right);
      contrast[x] = whole.high - whole.low;
      sum        += (double) (to_east * to_east) + (double) (to_south * to_south);
      left        = middle;
      middle      = right;
    }
  a->sum[y] = sum;
}

static float
weight (const Affinities *a, float one, float other)
{
  double contrast = (double) (one < other ? one : other), exponent = contrast * contrast * a->scale;

  return exponent > 0 ? exponent < 30 ? fmaxf ((float) exp (-exponent), a->floor) : a->floor : 1;
}

static void
weigh_row (void *data, int y)
{
  Affinities *a = data;
  size_t      w = (size_t) a->ink->width, i = (size_t) y * w;

  for (int x = 0; x < a->ink->width; x++, i++)
    {
      a->east[i]  = x + 1 < a->ink->width ? weight (a, a->contrast[i], a->contrast[i + 1]) : 0;
      a->south[i] = y + 1 < a->ink->height ? weight (a, a->contrast[i], a->contrast[i + w]) : 0;
    }
}

CeldStatus
celd_affinities (const CeldPlane *ink, float contrast, float floor, const CeldHost *host, float *east, float *south,
                 double *mean)
{
  double     w = ink->width, h = ink->height, pairs = (w - 1) * h + w * (h - 1), sum = 0;
  Affinities a = {
    ink, celd_alloc ((size_t) ink->width * (size_t) ink->height, sizeof (float)), east, south,
    celd_alloc ((size_t) ink->height, sizeof (double)), 0, floor
  };
  CeldStatus status = a.contrast && a.sum ? celd_progress (host, 0) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_parallel_for (host, ink->height, measure_row, &a);
      for (int y = 0; y < ink->height; y++)
        sum += a.sum[y];
      *mean   = pairs > 0 ? sum / pairs : 0;
      a.scale = *mean > 0 ? 1 / (*mean * (double) contrast) : 0;
      status  = celd_progress (host, 0.5);
    }
  if (status == CELD_OK)
    celd_parallel_for (host, ink->height, weigh_row, &a);
  celd_free (a.contrast);
  celd_free (a.sum);
  return status;
}
