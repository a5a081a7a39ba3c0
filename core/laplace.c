/* The one Laplacian solver: flexible conjugate gradients over the pixels, preconditioned by a multigrid cycle.
 *
 * Eq. (3), contour thickness (section 3.3), normals and heights are all  A x = b  with a weighted graph Laplacian.
 * The outer vectors are double and A x is summed over differences, so that weak links (weights down to 1e-6 beside 1)
 * keep their meaning.  The direction follows Polak and Ribiere, because the cycle is not linear.  Narrow or small grids
 * are eliminated directly instead.
 *
 * When to stop: with weak links a residual of 1e-8 can hide an error of half the range.  The preconditioned residual z
 * is an estimate of the error itself, too small by at most the least eigenvalue of the preconditioned matrix, which
 * the coefficients of the conjugate gradient tell (Lanczos); so the estimate is max|z| over that eigenvalue.
 *
 * Cost: about a dozen rounds whatever the size; memory about 75 bytes a pixel beside the caller's planes.  Sums are
 * taken row by row and then over the rows, so that the result does not depend on threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"

#include <math.h>

#define MOST_ROUNDS  200
#define SAFETY       1.5        /* of the estimated error, as the cycle is not quite linear; it was seen 1.4 short */
#define BAND_LENGTH  (1u << 20) /* largest size of a direct solution, in doubles ... */
#define BAND_WORK    (1u << 26) /* ... and in multiplications */

/* ------------------------------------------------------------------ pinned pixels */

/* The edge of weight *w between pixels i and j: what a fixed end says goes to the other end's equation. */
static void
pin_edge (size_t i, size_t j, float *w, size_t plane, const uint8_t *fixed, int nrhs, const float *value,
          float *diagonal, float *b)
{
  size_t held = fixed[i] ? i : j, other = fixed[i] ? j : i;

  if (!fixed[held])
    return;
  if (!fixed[other])
    {
      diagonal[other] += *w;
      for (int k = 0; k < nrhs; k++)
        b[(size_t) k * plane + other] += *w * value[(size_t) k * plane + held];
    }
  *w = 0;
}

void
celd_lap_pin (int width, int height, const uint8_t *fixed, int nrhs, const float *value,
              float *east, float *south, float *diagonal, float *b)
{
  size_t w = (size_t) width, plane = w * (size_t) height;

  for (size_t i = 0; i < plane; i++)
    {
      if (i % w + 1 < w)
        pin_edge (i, i + 1, &east[i], plane, fixed, nrhs, value, diagonal, b);
      if (i + w < plane)
        pin_edge (i, i + w, &south[i], plane, fixed, nrhs, value, diagonal, b);
    }
  for (size_t i = 0; i < plane; i++)
    if (fixed[i])
      {
        diagonal[i] = 1;
        for (int k = 0; k < nrhs; k++)
          b[(size_t) k * plane + i] = value[(size_t) k * plane + i];
      }
}

/* ------------------------------------------------------------------ set-up */

/* Row by row along the shorter side, every pixel's edges are at most that side long. */
static CeldStatus
set_up_band (CeldLaplace *l)
{
  bool       tall = l->width <= l->height;
  uint32_t   band = (uint32_t) (tall ? l->width : l->height);
  CeldStatus status = celd_band_new ((uint32_t) l->width * (uint32_t) l->height, band, &l->band);

  if (status != CELD_OK)
    return status;
  for (int y = 0; y < l->height; y++)
    for (int x = 0; x < l->width; x++)
      {
        size_t  i    = (size_t) y * (size_t) l->width + (size_t) x;
        size_t  node = tall ? i : (size_t) x * (size_t) l->height + (size_t) y;
        double *w    = l->band.weight + node * band;
        double  east = x + 1 < l->width ? (double) l->east[i] : 0, south = y + 1 < l->height ? (double) l->south[i] : 0;

        l->band.sink[node] = (double) l->diagonal[i];
        w[0]        += tall ? east : south;
        w[band - 1] += tall ? south : east;
      }
  celd_band_eliminate (&l->band);
  return CELD_OK;
}

/* A copy of n items, or of zeros. */
static void *
copy (const void *items, size_t n, size_t size)
{
  void *result = items ? celd_alloc (n, size) : celd_alloc0 (n, size);

  if (items && result)
    memcpy (result, items, n * size);
  return result;
}

/* The matrix without the fixed pixels. */
static CeldStatus
copy_system (const float *east, const float *south, const float *diagonal, const uint8_t *fixed, CeldLaplace *l)
{
  size_t n = (size_t) l->width * (size_t) l->height;

  l->east     = copy (east, n, sizeof *l->east);
  l->south    = copy (south, n, sizeof *l->south);
  l->diagonal = copy (diagonal, n, sizeof *l->diagonal);
  if (!l->east || !l->south || !l->diagonal)
    return CELD_NO_MEMORY;
  if (!fixed)
    return CELD_OK;
  l->fixed      = copy (fixed, n, 1);
  l->held_east  = copy (east, n, sizeof *l->held_east);
  l->held_south = copy (south, n, sizeof *l->held_south);
  if (!l->fixed || !l->held_east || !l->held_south)
    return CELD_NO_MEMORY;
  celd_lap_pin (l->width, l->height, fixed, 0, NULL, l->east, l->south, l->diagonal, NULL);
  return CELD_OK;
}

CeldStatus
celd_lap_setup (int width, int height, const float *east, const float *south, const float *diagonal,
                const uint8_t *fixed, const CeldRun *run, CeldLaplace **laplace)
{
  size_t       n = (size_t) width * (size_t) height, band = (size_t) (width < height ? width : height);
  CeldLaplace *l = celd_alloc0 (1, sizeof *l);
  CeldStatus   status;

  if (!l)
    return CELD_NO_MEMORY;
  l->width    = width;
  l->height   = height;
  l->direct   = n * band <= BAND_LENGTH && n * band * band <= BAND_WORK;
  l->inverse  = celd_alloc (n, sizeof *l->inverse);
  l->nothing  = celd_alloc0 ((size_t) width, sizeof *l->nothing);
  status      = l->inverse && l->nothing ? celd_step (run, 0) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = copy_system (east, south, diagonal, fixed, l);
  if (status == CELD_OK)
    {
      celd_pixels_invert (l);
      status = celd_floating_find (l);
    }
  if (status == CELD_OK)
    status = l->direct ? set_up_band (l)
                       : celd_levels_new (width, height, l->east, l->south, l->diagonal, run, &l->levels);
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
  celd_levels_clear (&laplace->levels);
  celd_free (laplace->east);
  celd_free (laplace->south);
  celd_free (laplace->diagonal);
  celd_free (laplace->fixed);
  celd_free (laplace->held_east);
  celd_free (laplace->held_south);
  celd_free (laplace->inverse);
  celd_free (laplace->nothing);
  celd_free (laplace->floating);
  celd_free (laplace->floating_size);
  celd_free (laplace);
}

/* ------------------------------------------------------------------ one solution */

/* x and r from the start; pixels without an edge are solved at once, floating components made solvable. */
static void
begin (const CeldLaplace *l, const float *b, const float *start, const CeldRun *run, double *mean, CeldSolution *s)
{
  size_t n = (size_t) l->width * (size_t) l->height;

  for (size_t i = 0; i < n; i++)
    {
      bool alone = (double) l->inverse[i] * (double) l->diagonal[i] >= 1 - 1e-7;

      s->x[i] = alone ? (double) b[i] / (double) l->diagonal[i] : (double) start[i];
      s->p[i] = s->q[i] = 0;
      s->z[i] = 0; /* finite: at the frame a pixel pulls itself with weight 0 */
    }
  celd_pixels_residual (l, run, s);
  for (size_t i = 0; i < n; i++)
    s->r[i] = l->inverse[i] > 0 ? s->r[i] + (double) b[i] : 0;
  celd_floating_shift (l, NULL, mean, s->r);
}

/* z becomes the solution of A z = r. */
static void
eliminate (CeldLaplace *l, CeldSolution *s)
{
  bool    tall = l->width <= l->height;
  size_t  w = (size_t) l->width, h = (size_t) l->height;
  double *x = l->band.x;

  for (size_t i = 0; i < w * h; i++)
    x[tall ? i : i % w * h + i / w] = s->r[i];
  celd_band_solve (&l->band);
  for (size_t i = 0; i < w * h; i++)
    s->z[i] = (float) x[tall ? i : i % w * h + i / w];
}

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

/* How far the error has come on its way from `first` to the tolerance, on a logarithmic scale. */
static double
share_done (double first, double error, double tolerance)
{
  return first > tolerance ? fmin (fmax (log (first / error) / log (first / tolerance), 0), 1) : 0;
}

/* The rounds of the conjugate gradient, from s->x and s->r. */
static CeldStatus
iterate (CeldLaplace *l, double tolerance, int most, const CeldRun *run, CeldSolution *s, CeldSolve *solve)
{
  double alpha[MOST_ROUNDS], beta[MOST_ROUNDS], zr_before = 0, done = 0, first = 0, scale = 0;

  *solve = (CeldSolve) { .converged = false, .error = 1 };
  for (int k = 0; k < MOST_ROUNDS; k++)
    {
      double zr, zq, largest, pq, low, high;

      if (l->direct)
        eliminate (l, s);
      else
        celd_pixels_cycle (l, run, s);
      celd_pixels_measure (l, run, s, &zr, &zq, &largest);
      if (zr == 0)
        solve->error = 0;
      else if (k > 0)
        solve->error = SAFETY * largest / least_eigenvalue (k, alpha, beta) / scale;
      solve->converged = solve->error <= tolerance;
      if (solve->converged || !(zr > 0) || (most && k == most))
        break;

      first = k <= 1 ? solve->error : first;
      done  = fmax (done, share_done (first, solve->error, tolerance));
      if (celd_step (run, done) != CELD_OK)
        return CELD_CANCELLED;

      beta[k]   = k ? fmax (-alpha[k - 1] * zq / zr_before, 0) : 0;
      pq        = celd_pixels_turn (l, run, s, beta[k]);
      zr_before = zr;
      if (!(pq > 0))
        break;
      alpha[k] = zr / pq;
      celd_pixels_advance (l, run, s, alpha[k], &low, &high);
      solve->iterations = k + 1;
      /* Where all is nearly constant, the last digits of float are enough. */
      scale = fmax (high - low, 1e-6 * fmax (fabs (low), fabs (high)) / tolerance);
    }
  return CELD_OK;
}

/* What fixed pixels say, as a right-hand side; `b` may be NULL. */
static void
fold_fixed (const CeldLaplace *l, const float *b, const float *x, float *folded)
{
  size_t w = (size_t) l->width, n = w * (size_t) l->height;

  for (size_t i = 0; i < n; i++)
    folded[i] = l->fixed && l->fixed[i] ? x[i] : b ? b[i] : 0;
  for (size_t i = 0; i < n && l->fixed; i++)
    {
      if (i % w + 1 < w && !l->fixed[i] != !l->fixed[i + 1])
        folded[l->fixed[i] ? i + 1 : i] += l->held_east[i] * x[l->fixed[i] ? i : i + 1];
      if (i + w < n && !l->fixed[i] != !l->fixed[i + w])
        folded[l->fixed[i] ? i + w : i] += l->held_south[i] * x[l->fixed[i] ? i : i + w];
    }
}

static CeldStatus
solve_one (CeldLaplace *l, const float *b, float *x, double tolerance, int most, const CeldRun *run, double *mean,
           CeldSolution *s, CeldSolve *solve)
{
  size_t     n      = (size_t) l->width * (size_t) l->height;
  double    *before = mean, *now = mean + l->n_floating + 1;
  CeldStatus status;

  fold_fixed (l, b, x, s->b);
  begin (l, s->b, x, run, now, s);
  celd_floating_means (l, s->x, before);
  status = iterate (l, tolerance, most, run, s, solve);
  celd_floating_shift (l, before, now, s->x);
  for (size_t i = 0; i < n; i++)
    x[i] = (float) s->x[i];
  return status;
}

/* Solves for the right-hand sides whose values are `stride` items apart and that begin `next` items apart. */
static CeldStatus
solve_many (CeldLaplace *l, int nrhs, size_t stride, size_t next, const float *b, float *x, double tolerance, int most,
            const CeldRun *run, CeldSolve *solve)
{
  size_t       n = (size_t) l->width * (size_t) l->height, h = (size_t) l->height;
  double      *vector = celd_alloc (n, 4 * sizeof *vector), *row = celd_alloc (h, 3 * sizeof *row);
  double      *mean = celd_alloc ((size_t) l->n_floating + 1, 2 * sizeof *mean);
  float       *plane = celd_alloc (n, 4 * sizeof *plane), *one_b = plane + 2 * n, *one_x = plane + 3 * n;
  CeldSolve    worst = { .converged = true };
  CeldStatus   status = vector && row && mean && plane ? CELD_OK : CELD_NO_MEMORY;
  CeldSolution s = { vector, vector + n, vector + 2 * n, vector + 3 * n, plane, plane + n, { row, row + h, row + 2 * h } };

  for (int k = 0; k < nrhs && status == CELD_OK; k++)
    {
      CeldPart  part;
      CeldRun   share = celd_run_part (&part, run, (double) k / nrhs, (double) (k + 1) / nrhs);
      size_t    first = (size_t) k * next;
      CeldSolve one;

      for (size_t i = 0; i < n; i++)
        {
          one_b[i] = b ? b[first + i * stride] : 0;
          one_x[i] = x[first + i * stride];
        }
      status = solve_one (l, one_b, one_x, tolerance, most, &share, mean, &s, &one);
      for (size_t i = 0; i < n; i++)
        x[first + i * stride] = one_x[i];
      worst.converged  = worst.converged && one.converged;
      worst.iterations = one.iterations > worst.iterations ? one.iterations : worst.iterations;
      worst.error      = fmax (worst.error, one.error);
    }
  if (solve && status != CELD_NO_MEMORY)
    *solve = worst;
  celd_free (vector);
  celd_free (row);
  celd_free (mean);
  celd_free (plane);
  return status;
}

CeldStatus
celd_lap_solve (CeldLaplace *laplace, int nrhs, const float *b, float *x, double tolerance,
                const CeldRun *run, CeldSolve *solve)
{
  size_t n = (size_t) laplace->width * (size_t) laplace->height;

  return solve_many (laplace, nrhs, 1, n, b, x, tolerance, 0, run, solve);
}

CeldStatus
celd_lap_solve_lanes (CeldLaplace *laplace, const float *b, float *x, double tolerance, int most,
                      const CeldRun *run, CeldSolve *solve)
{
  return solve_many (laplace, CELD_LANES, CELD_LANES, 1, b, x, tolerance, most, run, solve);
}
