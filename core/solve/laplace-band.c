/* Direct solution of a weighted graph Laplacian whose edges are short in the order of the nodes.
 *
 * Gaussian elimination on the graph: taking out node i joins its neighbours by w_ij w_ik / pivot and hands them its
 * sink, s_j += w_ij s_i / pivot, with pivot = s_i + sum_j w_ij.  Nothing is ever subtracted, so that weights of any
 * range keep full relative precision, and a floating component ends in a pivot that is exactly zero: its last node
 * stays 0.  Cost n band^2, memory 8 n band.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-private.h"
#include "solve/laplace.h"

CeldStatus
celd_band_new (uint32_t n, uint32_t band, CeldBandMatrix *matrix)
{
  *matrix = (CeldBandMatrix) {
    .n = n, .band = band,
    .weight = celd_alloc0 ((size_t) n * band, sizeof (double)),
    .sink   = celd_alloc0 (n, sizeof (double)),
  };
  return matrix->weight && matrix->sink ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_band_clear (CeldBandMatrix *matrix)
{
  celd_free (matrix->weight);
  celd_free (matrix->sink);
  *matrix = (CeldBandMatrix) { 0 };
}

/* How many nodes after i its row reaches. */
static uint32_t
reach (const CeldBandMatrix *matrix, uint32_t i)
{
  uint32_t rest = matrix->n - 1 - i;

  return rest < matrix->band ? rest : matrix->band;
}

CELD_CLONES static void
eliminate_band (CeldBandMatrix *matrix)
{
  for (uint32_t i = 0; i < matrix->n; i++)
    {
      double  *w     = matrix->weight + (size_t) i * matrix->band;
      uint32_t m     = reach (matrix, i);
      double   sink  = matrix->sink[i];
      double   pivot = sink;

      for (uint32_t j = 0; j < m; j++)
        pivot += w[j];
      matrix->sink[i] = pivot > 0 ? 1 / pivot : 0;
      for (uint32_t j = 0; j < m; j++)
        if (w[j] > 0)
          {
            double  share = w[j] / pivot;
            double *other = matrix->weight + (size_t) (i + 1 + j) * matrix->band;

            matrix->sink[i + 1 + j] += share * sink;
            for (uint32_t k = j + 1; k < m; k++)
              other[k - j - 1] += share * w[k];
          }
      for (uint32_t j = 0; j < m; j++)
        w[j] *= matrix->sink[i];
    }
}

void
celd_band_eliminate (CeldBandMatrix *matrix)
{
  eliminate_band (matrix);
}

/* The constant `lanes` lets the inner loops be vectors. */
static inline void
solve (const CeldBandMatrix *matrix, double *x, size_t lanes)
{
  for (size_t i = 0; i < matrix->n; i++)
    {
      const double *w = matrix->weight + i * matrix->band;
      size_t        m = reach (matrix, (uint32_t) i);

      for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k < lanes; k++)
          x[(i + 1 + j) * lanes + k] += w[j] * x[i * lanes + k];
    }
  for (size_t i = matrix->n; i-- > 0;)
    {
      const double *w = matrix->weight + i * matrix->band;
      size_t        m = reach (matrix, (uint32_t) i);
      double        sum[CELD_LANES];

      for (size_t k = 0; k < lanes; k++)
        sum[k] = matrix->sink[i] * x[i * lanes + k];
      for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k < lanes; k++)
          sum[k] += w[j] * x[(i + 1 + j) * lanes + k];
      for (size_t k = 0; k < lanes; k++)
        x[i * lanes + k] = sum[k];
    }
}

CELD_CLONES static void
solve_band (const CeldBandMatrix *matrix, int lanes, double *x)
{
  if (lanes == 1)
    solve (matrix, x, 1);
  else
    solve (matrix, x, CELD_LANES);
}

void
celd_band_solve (const CeldBandMatrix *matrix, int lanes, double *x)
{
  solve_band (matrix, lanes, x);
}
