/* The Laplacian solver: flexible conjugate gradients over the pixels, preconditioned by an aggregation multigrid cycle.
 *
 * Eq. (3), contour thickness (section 3.3), normals, heights and harmonic bases are all  A x = b  with a weighted graph
 * Laplacian A.  The direction follows Polak and Ribiere, since the cycle is not linear.  Small systems are eliminated
 * directly (laplace-direct.c).  Several right-hand sides on the same weights can be solved at once, as lanes, which
 * share all reads of the weights: 1.25 to 1.75 times as fast as one by one.
 *
 * Stopping: where weights differ by a factor of a million, a relative residual of 1e-8 can hide an error of half the
 * range.  The preconditioned residual z estimates the error itself, too small by at most the least eigenvalue of the
 * preconditioned matrix, which the coefficients of the conjugate gradient give (Lanczos).  So the estimate is max |z|
 * over that eigenvalue.
 *
 * Cost: five to ten rounds at any size, up to 25 where a drawing is all lines; 0.12 s a megapixel for an error of 1e-3.
 * Sums are taken row by row and then over the rows, so that the result does not depend on threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-private.h"

#include <math.h>

#define MAX_CG_ROUNDS 200 /* then the error is reported as it is; chosen */
#define RENEW         6   /* rounds after which the residual is computed anew in double; chosen by the bench */
#define RENEW_WEAK    3   /* RENEW where weights differ much: rounding errors in the residual grow with the condition */
#define SAFETY        1.7 /* factor of the estimated error, as the cycle is not linear: it was seen 1.6 short */

/* ------------------------------------------------------------------ set-up */

CeldStatus
celd_lap_setup (int width, int height, const float *east, const float *south, const float *diagonal,
                const uint8_t *fixed, const CeldHost *host, CeldLaplace **laplace)
{
  CeldLaplace      *l = celd_alloc0 (1, sizeof *l);
  CeldWeightedGraph graph = { 0 };
  CeldStatus        status;

  if (!l)
    return CELD_NO_MEMORY;
  l->width  = width;
  l->height = height;
  status    = celd_progress (host, 0);
  if (status == CELD_OK)
    status = celd_system_read (east, south, diagonal, fixed, host, l, &graph);
  if (status == CELD_OK)
    status = celd_null_space_find (&graph, l);
  if (status == CELD_OK)
    {
      l->direct = celd_is_direct (&graph, l->weak);
      status    = l->direct ? celd_direct_new (&graph, l) : celd_hierarchy_new (&graph, host, &l->hierarchy);
    }
  celd_weighted_graph_clear (&graph);
  if (status == CELD_OK)
    *laplace = l;
  else
    celd_lap_free (l);
  return status;
}

void
celd_lap_free (CeldLaplace *laplace)
{
  if (!laplace)
    return;
  celd_band_clear (&laplace->band);
  celd_hierarchy_clear (&laplace->hierarchy);
  celd_free (laplace->keep);
  celd_free (laplace->held);
  celd_free (laplace->held_row);
  celd_free (laplace->floating);
  celd_free (laplace->floating_row);
  celd_free (laplace->floating_size);
  celd_free (laplace);
}

/* ------------------------------------------------------------------ the conjugate gradient */

/* The state of one lane. */
typedef struct
{
  double alpha[MAX_CG_ROUNDS], beta[MAX_CG_ROUNDS];
  double pq;                    /* of the last direction */
  double scale;                 /* range of x */
  double error;
  bool   done;
} Lane;

/* Least eigenvalue of the preconditioned matrix, as far as the rounds so far tell: that of the Lanczos matrix with the
 * diagonal 1/alpha_k + beta_k/alpha_(k-1) and the squares beta_k/alpha_(k-1)^2 beside it. */
static double
least_eigenvalue (int rounds, const double *alpha, const double *beta)
{
  double low = 0, high = 1;

  for (int halving = 0; halving < 40; halving++)
    {
      double t = 0.5 * (low + high), pivot = 1;

      for (int k = 0; k < rounds && pivot > 0; k++)
        {
          double before = k ? beta[k] / alpha[k - 1] : 0;

          pivot = 1 / alpha[k] + before - t - (k ? before / alpha[k - 1] / pivot : 0);
        }
      if (pivot > 0)
        low = t;
      else
        high = t;
    }
  return fmax (low, 1e-6);
}

/* Progress of the error from `first` to the tolerance, on a logarithmic scale: 0 .. 1. */
static double
share_done (double first, double error, double tolerance)
{
  return first > tolerance ? fmin (fmax (log (first / error) / log (first / tolerance), 0), 1) : 0;
}

/* Estimates the error of a lane from the measures of a round, and chooses alpha and beta of the next step, which are 0
 * when the lane is done. */
static void
judge (Lane *lane, int round, double tolerance, const CeldRoundMeasures *m, int k, double *alpha, double *beta)
{
  *alpha = *beta = 0;
  if (!(m->zr[k] > 0))
    {
      lane->error = lane->done ? lane->error : 0;
      lane->done  = true;
    }
  else if (round > 0 && !lane->done)
    {
      lane->error = SAFETY * m->largest[k] / least_eigenvalue (round, lane->alpha, lane->beta) / lane->scale;
      lane->done  = lane->error <= tolerance;
    }
  if (lane->done)
    return;
  *beta    = round ? fmax (-m->zq[k] / lane->pq, 0) : 0;
  lane->pq = m->zt[k] + 2 * *beta * m->zq[k] + *beta * *beta * lane->pq;
  *alpha   = lane->pq > 0 ? m->zr[k] / lane->pq : 0;
  if (!(*alpha > 0) || !isfinite (*alpha))
    {
      *alpha = *beta = 0;
      lane->done = true;
      return;
    }
  lane->alpha[round] = *alpha;
  lane->beta[round]  = *beta;
}

/* The rounds of the conjugate gradient. */
static CeldStatus
iterate (CeldSolution *s, double tolerance, Lane *lane, CeldSolve *solve)
{
  double            done = 0, first = 0, alpha[CELD_LANES], beta[CELD_LANES];
  CeldRoundMeasures m;
  int               renew = s->laplace->weak ? RENEW_WEAK : RENEW;

  celd_pixels_begin (s);
  for (int k = 0; k < s->lanes; k++)
    lane[k] = (Lane) { .error = 1 };
  for (int round = 0;; round++)
    {
      bool all = true;

      celd_pixels_round (s, round ? alpha : NULL, beta, round && round % renew == 0, &m);
      solve->iterations = round;
      solve->error      = 0;
      for (int k = 0; k < s->lanes; k++)
        {
          if (round) /* where all is nearly constant, the last digits of float are enough */
            lane[k].scale = fmax (m.high[k] - m.low[k], 1e-6 * fmax (fabs (m.low[k]), fabs (m.high[k])) / tolerance);
          judge (&lane[k], round, tolerance, &m, k, &alpha[k], &beta[k]);
          all          = all && lane[k].done;
          solve->error = fmax (solve->error, lane[k].error);
        }
      solve->converged = solve->error <= tolerance;
      if (all || round == MAX_CG_ROUNDS)
        return CELD_OK;

      first = round <= 1 ? solve->error : first;
      done  = fmax (done, share_done (first, solve->error, tolerance));
      if (celd_progress (s->host, done) != CELD_OK)
        return CELD_CANCELLED;
    }
}

static CeldStatus
converge (const CeldLaplace *l, int lanes, const float *b, const double *b_mean, float *x, double tolerance,
          const CeldHost *host, CeldSolve *solve)
{
  CeldSolution s;
  Lane        *lane   = celd_alloc ((size_t) lanes, sizeof *lane);
  CeldStatus   status = celd_solution_new (l, lanes, b, x, host, &s);

  s.b_mean = b_mean;
  if (!lane)
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      status = iterate (&s, tolerance, lane, solve);
      celd_pixels_deliver (&s);
    }
  celd_solution_free (&s);
  celd_free (lane);
  return status;
}

/* ------------------------------------------------------------------ solutions */

/* Means of v over each floating component, of every lane; mean has n_floating + 1 items a lane. */
static void
null_space_means (const CeldLaplace *l, int lanes, const float *v, double *mean)
{
  size_t many = (size_t) lanes;

  memset (mean, 0, ((size_t) l->n_floating + 1) * many * sizeof *mean);
  for (size_t f = 0; f < celd_null_space_runs (l); f++)
    for (size_t i = l->floating[f].first; i < l->floating[f].end; i++)
      for (size_t k = 0; k < many; k++)
        mean[l->floating[f].component * many + k] += (double) v[i * many + k];
  for (size_t c = 1; c <= l->n_floating; c++)
    for (size_t k = 0; k < many; k++)
      mean[c * many + k] /= (double) l->floating_size[c];
}

/* v += plus - minus, the numbers of each pixel's floating component. */
static void
null_space_shift (const CeldLaplace *l, int lanes, const double *plus, const double *minus, float *v)
{
  size_t many = (size_t) lanes;

  for (size_t f = 0; f < celd_null_space_runs (l); f++)
    for (size_t i = l->floating[f].first; i < l->floating[f].end; i++)
      for (size_t k = 0; k < many; k++)
        {
          size_t at = l->floating[f].component * many + k;

          v[i * many + k] = (float) ((double) v[i * many + k] + plus[at] - minus[at]);
        }
}

/* One solution, or CELD_LANES of them.  In floating components the mean of the right-hand side is subtracted before,
 * and the solution shifted to the mean of its start after it. */
static CeldStatus
solve_lanes (const CeldLaplace *l, int lanes, const float *b, float *x, double tolerance, const CeldHost *host,
             CeldSolve *solve)
{
  size_t     means = (size_t) l->n_floating + 1;
  double    *mean  = celd_alloc (3 * means, (size_t) lanes * sizeof *mean);
  double    *before, *after, *b_mean;
  CeldStatus status;

  *solve = (CeldSolve) { .converged = true };
  if (!mean)
    return CELD_NO_MEMORY;
  before = mean;
  after  = mean + means * (size_t) lanes;
  b_mean = b && l->n_floating ? after + means * (size_t) lanes : NULL;
  null_space_means (l, lanes, x, before);
  if (b_mean)
    null_space_means (l, lanes, b, b_mean);
  status = l->direct ? celd_direct_solve (l, lanes, b, b_mean, x)
                     : converge (l, lanes, b, b_mean, x, tolerance, host, solve);
  null_space_means (l, lanes, x, after);
  null_space_shift (l, lanes, before, after, x);
  celd_free (mean);
  return status;
}

CeldStatus
celd_lap_solve (CeldLaplace *laplace, int nrhs, const float *b, float *x, double tolerance, const CeldHost *host,
                CeldSolve *solve)
{
  size_t     n = (size_t) laplace->width * (size_t) laplace->height;
  CeldSolve  worst = { .converged = true };
  CeldStatus status = CELD_OK;

  for (int k = 0; k < nrhs && status == CELD_OK; k++)
    {
      CeldHostPart part;
      CeldHost     share  = celd_host_part (&part, host, (double) k / nrhs, (double) (k + 1) / nrhs);
      size_t       offset = (size_t) k * n;
      CeldSolve    one;

      status = solve_lanes (laplace, 1, b ? b + offset : NULL, x + offset, tolerance, &share, &one);
      worst.converged  = worst.converged && one.converged;
      worst.iterations = one.iterations > worst.iterations ? one.iterations : worst.iterations;
      worst.error      = fmax (worst.error, one.error);
    }
  if (solve)
    *solve = worst;
  return status;
}

CeldStatus
celd_lap_solve_lanes (CeldLaplace *laplace, const float *b, float *x, double tolerance, const CeldHost *host,
                      CeldSolve *solve)
{
  CeldSolve  worst;
  CeldStatus status = solve_lanes (laplace, CELD_LANES, b, x, tolerance, host, &worst);

  if (solve)
    *solve = worst;
  return status;
}
