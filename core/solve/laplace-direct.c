/* Direct solution of a graph Laplacian whose edges are short in the order of the nodes: the coarsest level of the
 * multigrid hierarchy, and small systems as a whole, for which float vectors and an estimated error would not do where
 * weights differ by a factor of a million.
 *
 * Gaussian elimination on the graph: eliminating node i joins its neighbours j, k by w_ij w_ik / pivot and adds w_ij
 * s_i / pivot to the diagonal s_j, with pivot = s_i + sum_j w_ij.  Nothing is ever subtracted, so that weights of any
 * range keep full relative precision, and a floating component ends in a pivot that is exactly zero: its last node
 * stays 0.
 *
 * Cost: n band^2, memory 8 n band bytes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-private.h"

#define BAND_LENGTH  (1u << 20) /* doubles in the band of a small system at most, 8 MB; chosen */
#define BAND_WORK    (1u << 21) /* multiplications to eliminate it at most: a millisecond, which the cycle takes, too */
#define WEAK_LENGTH  (1u << 22) /* both where weights differ much, which is hard for the cycle; chosen */
#define WEAK_WORK    (1u << 23)

/* ------------------------------------------------------------------ elimination */

CeldStatus
celd_band_new (uint32_t n, uint32_t band, CeldBandMatrix *matrix)
{
  *matrix = (CeldBandMatrix) {
    .n = n, .band = band,
    .weight = celd_alloc0 ((size_t) n * band, sizeof (double)),
    .diagonal   = celd_alloc0 (n, sizeof (double)),
  };
  return matrix->weight && matrix->diagonal ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_band_clear (CeldBandMatrix *matrix)
{
  celd_free (matrix->weight);
  celd_free (matrix->diagonal);
  *matrix = (CeldBandMatrix) { 0 };
}

/* How many nodes after i its row reaches. */
static uint32_t
nodes_reached (const CeldBandMatrix *matrix, uint32_t i)
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
      uint32_t m     = nodes_reached (matrix, i);
      double   diagonal  = matrix->diagonal[i];
      double   pivot = diagonal;

      for (uint32_t j = 0; j < m; j++)
        pivot += w[j];
      matrix->diagonal[i] = pivot > 0 ? 1 / pivot : 0;
      for (uint32_t j = 0; j < m; j++)
        if (w[j] > 0)
          {
            double  share = w[j] / pivot;
            double *other = matrix->weight + (size_t) (i + 1 + j) * matrix->band;

            matrix->diagonal[i + 1 + j] += share * diagonal;
            for (uint32_t k = j + 1; k < m; k++)
              other[k - j - 1] += share * w[k];
          }
      for (uint32_t j = 0; j < m; j++)
        w[j] *= matrix->diagonal[i];
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
      size_t        m = nodes_reached (matrix, (uint32_t) i);

      for (size_t j = 0; j < m; j++)
        for (size_t k = 0; k < lanes; k++)
          x[(i + 1 + j) * lanes + k] += w[j] * x[i * lanes + k];
    }
  for (size_t i = matrix->n; i-- > 0;)
    {
      const double *w = matrix->weight + i * matrix->band;
      size_t        m = nodes_reached (matrix, (uint32_t) i);
      double        sum[CELD_LANES];

      for (size_t k = 0; k < lanes; k++)
        sum[k] = matrix->diagonal[i] * x[i * lanes + k];
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

/* ------------------------------------------------------------------ the coarsest level */

CeldStatus
celd_eliminate_coarsest (const CeldWeightedGraph *g, const CeldGridLevel *level, CeldBandMatrix *matrix,
                         uint32_t **node)
{
  uint32_t   n = (uint32_t) g->width * (uint32_t) g->height, all = n + g->n_extra, count = 0, band;
  uint32_t  *number = celd_alloc (all, sizeof *number);
  CeldStatus status = CELD_NO_MEMORY;

  *node = celd_alloc (all, sizeof **node);
  if (!number || !*node)
    goto done;
  for (uint32_t i = 0; i < all; i++)
    if (level->inverse[celd_node_place (level, i)] > 0)
      {
        (*node)[count] = celd_node_place (level, i);
        number[i] = count++;
      }
  band   = count > 1 ? count - 1 : 1;
  status = celd_band_new (count, band, matrix);
  if (status != CELD_OK)
    goto done;
#define JOIN(i, j, w) matrix->weight[(size_t) number[i] * band + number[j] - number[i] - 1] = (double) (w)
  for (uint32_t i = 0; i < n; i++)
    {
      if (i % (uint32_t) g->width + 1 < (uint32_t) g->width && g->east[i] > 0)
        JOIN (i, i + 1, g->east[i]);
      if (i + (uint32_t) g->width < n && g->south[i] > 0)
        JOIN (i, i + (uint32_t) g->width, g->south[i]);
    }
  for (uint32_t k = 0; k < g->n_extra; k++)
    for (uint32_t e = g->start[k]; e < g->start[k + 1]; e++)
      if (g->neighbour[e] < n + k)
        JOIN (g->neighbour[e], n + k, g->weight[e]);
#undef JOIN
  for (uint32_t i = 0; i < all; i++)
    if (level->inverse[celd_node_place (level, i)] > 0)
      matrix->diagonal[number[i]] = (double) g->diagonal[i];
  celd_band_eliminate (matrix);

done:
  celd_free (number);
  return status;
}

/* ------------------------------------------------------------------ small systems */

bool
celd_is_direct (const CeldWeightedGraph *g, bool weak)
{
  size_t n = (size_t) g->width * (size_t) g->height, band = (size_t) (g->width < g->height ? g->width : g->height);

  return n * band <= (weak ? WEAK_LENGTH : BAND_LENGTH) && n * band * band <= (weak ? WEAK_WORK : BAND_WORK);
}

/* Every pixel's edges are at most the shorter side long. */
CeldStatus
celd_direct_new (const CeldWeightedGraph *g, CeldLaplace *l)
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

      l->band.diagonal[node] = (double) g->diagonal[i];
      weight[0]        += (double) (tall ? g->east[i] : g->south[i]);
      weight[band - 1] += (double) (tall ? g->south[i] : g->east[i]);
      l->keep[i] = !(g->diagonal[i] > 0 || g->east[i] > 0 || g->south[i] > 0 || (i % w && g->east[i - 1] > 0) ||
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
  for (size_t f = 0; f < celd_null_space_runs (l) && b_mean; f++)
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
