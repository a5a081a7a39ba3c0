/* Small systems of the Laplacian solver: elimination in a band, row by row along the shorter side.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-private.h"
#include "solve/laplace.h"

#define BAND_LENGTH  (1u << 20) /* largest size of a direct solution, in doubles ... */
#define BAND_WORK    (1u << 26) /* ... and in multiplications */
#define WEAK_MORE    4          /* weak links are hard for the cycle: so many times as much is worth while */

bool
celd_is_direct (const CeldWeights *g, bool weak)
{
  size_t n = (size_t) g->width * (size_t) g->height, band = (size_t) (g->width < g->height ? g->width : g->height);
  size_t more = weak ? WEAK_MORE : 1;

  return n * band <= more * BAND_LENGTH && n * band * band <= more * BAND_WORK;
}

/* Every pixel's edges are at most the shorter side long. */
CeldStatus
celd_direct_new (const CeldWeights *g, CeldLaplace *l)
{
  bool       tall = l->width <= l->height;
  size_t     w = (size_t) l->width, n = w * (size_t) l->height;
  uint32_t   band = (uint32_t) (tall ? l->width : l->height);
  CeldStatus status = celd_band_new ((uint32_t) n, band, &l->band);

  if (status != CELD_OK)
    return status;
  if (!(l->keep = celd_alloc (n, 1)))
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < n; i++)
    {
      size_t  node   = tall ? i : i % w * (size_t) l->height + i / w;
      double *weight = l->band.weight + node * band;

      l->band.sink[node] = (double) g->sink[i];
      weight[0]        += (double) (tall ? g->east[i] : g->south[i]);
      weight[band - 1] += (double) (tall ? g->south[i] : g->east[i]);
      l->keep[i] = !(g->sink[i] > 0 || g->east[i] > 0 || g->south[i] > 0 || (i % w && g->east[i - 1] > 0) ||
                     (i >= w && g->south[i - w] > 0));
    }
  celd_band_eliminate (&l->band);
  return CELD_OK;
}

CeldStatus
celd_direct_solve (const CeldLaplace *l, int lanes, const float *b, const double *b_mean, float *x)
{
  bool    tall = l->width <= l->height;
  size_t  w = (size_t) l->width, h = (size_t) l->height, many = (size_t) lanes;
  double *v = celd_alloc (w * h, many * sizeof *v);

  if (!v)
    return CELD_NO_MEMORY;
#define NODE(i) ((size_t) (tall ? (i) : (i) % w * h + (i) / w))
  for (size_t i = 0; i < w * h; i++)
    for (size_t k = 0; k < many; k++)
      v[NODE (i) * many + k] = b ? (double) b[i * many + k] : 0;
  for (size_t f = 0; f < celd_floating_runs (l) && b_mean; f++)
    for (size_t i = l->floating[f].first; i < l->floating[f].end; i++)
      for (size_t k = 0; k < many; k++)
        v[NODE (i) * many + k] -= b_mean[l->floating[f].component * many + k];
  for (size_t i = 0; i < l->held_row[h]; i++)
    for (size_t k = 0; k < many; k++)
      v[NODE (l->held[i].free) * many + k] += (double) l->held[i].weight * (double) x[l->held[i].fixed * many + k];
  celd_band_solve (&l->band, lanes, v);
  for (size_t i = 0; i < w * h; i++)
    for (size_t k = 0; k < many && !l->keep[i]; k++)
      x[i * many + k] = (float) v[NODE (i) * many + k];
#undef NODE
  celd_free (v);
  return CELD_OK;
}
