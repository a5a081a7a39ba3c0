/* The weights of eq. (1), as in [Gra06]:  w_pq = exp (-(I_p - I_q)^2 / sigma), least a floor.
 *
 * The paper calls sigma "a mean contrast of edges".  We take the mean of (I_p - I_q)^2 over all pairs of neighbours of
 * the ink, whether they differ or not.  Then a step of the whole contrast weighs next to nothing and a contour is as
 * good as closed, as in the fast route; over the pairs alone that differ the mean would be some 0.2, an antialiased
 * contour would weigh 0.3, and depth would leak through every one.  (It would also be the noise of a scan that decides
 * which pairs differ.)  Where nothing differs every weight is 1.
 *
 * Weights below about 1e-16 would be lost beside 1, hence the floor: the program is exact for the weights with it.  It
 * also joins all pixels, so that the solution is unique but for a constant.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "program.h"

#include <math.h>

typedef struct
{
  const CeldPlane *ink;
  float           *east, *south;   /* squared differences first, then weights */
  double          *sum;            /* of each row */
  double           scale;          /* 1 / sigma, 0 if nothing differs */
  float            floor;
} Affinities;

static float
ink_at (const CeldPlane *ink, int x, int y)
{
  float value = CELD_AT (ink, x, y);

  return isfinite (value) ? value : 1;
}

static void
square_row (void *data, int y)
{
  Affinities *a = data;
  size_t      w = (size_t) a->ink->width, i = (size_t) y * w;
  double      sum = 0;

  for (int x = 0; x < a->ink->width; x++, i++)
    {
      float here  = ink_at (a->ink, x, y);
      float east  = x + 1 < a->ink->width ? ink_at (a->ink, x + 1, y) - here : 0;
      float south = y + 1 < a->ink->height ? ink_at (a->ink, x, y + 1) - here : 0;

      a->east[i]  = east * east;
      a->south[i] = south * south;
      sum += (double) a->east[i] + (double) a->south[i];
    }
  a->sum[y] = sum;
}

static float
weight (const Affinities *a, float square)
{
  return square > 0 ? fmaxf ((float) exp (-(double) square * a->scale), a->floor) : 1;
}

static void
weigh_row (void *data, int y)
{
  Affinities *a = data;
  size_t      w = (size_t) a->ink->width, i = (size_t) y * w;

  for (int x = 0; x < a->ink->width; x++, i++)
    {
      a->east[i]  = x + 1 < a->ink->width ? weight (a, a->east[i]) : 0;
      a->south[i] = y + 1 < a->ink->height ? weight (a, a->south[i]) : 0;
    }
}

CeldStatus
celd_affinities (const CeldPlane *ink, float contrast, float floor, const CeldRun *run, float *east, float *south,
                 double *mean)
{
  double     w = ink->width, h = ink->height, pairs = (w - 1) * h + w * (h - 1), sum = 0;
  Affinities a = { ink, east, south, celd_alloc ((size_t) ink->height, sizeof (double)), 0, floor };
  CeldStatus status = a.sum ? celd_step (run, 0) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_each (run, ink->height, square_row, &a);
      for (int y = 0; y < ink->height; y++)
        sum += a.sum[y];
      *mean   = pairs > 0 ? sum / pairs : 0;
      a.scale = *mean > 0 ? 1 / (*mean * (double) contrast) : 0;
      status  = celd_step (run, 0.5);
    }
  if (status == CELD_OK)
    celd_each (run, ink->height, weigh_row, &a);
  celd_free (a.sum);
  return status;
}
