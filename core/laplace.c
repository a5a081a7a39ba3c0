/* The one Laplacian solver: flexible conjugate gradients over the pixels, preconditioned by a multigrid cycle.
 *
 * Eq. (3), contour thickness (section 3.3), normals and heights are all  A x = b  with a weighted graph Laplacian.
 * The preconditioner is one red-black Gauss-Seidel sweep before and one in reverse order after the coarse correction
 * of laplace-levels.c; narrow or small grids are eliminated directly instead.  The outer vectors are double and A x
 * is summed over differences, so that weak links (weights down to 1e-6 beside 1) keep their meaning.  The direction
 * follows Polak and Ribiere, because the cycle is not linear.
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
#include <string.h>

#define MOST_ROUNDS  200
#define STRIP        32         /* rows in one piece of work; even, so that no cell of 2 x 2 pixels is divided */
#define BAND_LENGTH  (1u << 20) /* largest size of a direct solution, in doubles ... */
#define BAND_WORK    (1u << 26) /* ... and in multiplications */
#define STRETCH      1.4f       /* of the coarse correction, which is too short where it is constant on aggregates */

struct CeldLaplace
{
  int          width, height;
  const float *east, *south, *diagonal;   /* borrowed */
  float       *inverse;                   /* 1 / whole diagonal; 0 for a floating single pixel */
  uint32_t    *floating;                  /* of each pixel: its floating component, 1 .. n_floating; 0 if held by a diagonal */
  uint32_t     n_floating;                /* of more than one pixel; floating is NULL if there is none */
  bool         direct;                    /* by elimination of `band`, without levels */
  CeldBand     band;
  CeldLevels   levels;
};

/* The vectors of one solution, and what the strips of a pass need. */
typedef struct
{
  const CeldLaplace *laplace;
  CeldLevels *levels;
  double *x, *r, *p, *q;        /* solution, residual, direction, A p */
  float  *z;                    /* preconditioned residual */
  double *sum, *sum2, *top;     /* of each row */
  double  factor;               /* of this pass */
  int     colour;               /* of this pass */
} Solution;

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

/* ------------------------------------------------------------------ the matrix */

/* The four edges of a pixel; 0 outside the grid. */
typedef struct { float north, west, east, south; } Edges;

static inline Edges
edges_at (const CeldLaplace *l, int x, int y, size_t i)
{
  return (Edges) {
    y > 0             ? l->south[i - (size_t) l->width] : 0.f,
    x > 0             ? l->east[i - 1]                  : 0.f,
    x + 1 < l->width  ? l->east[i]                      : 0.f,
    y + 1 < l->height ? l->south[i]                     : 0.f,
  };
}

/* Sum over the neighbours of weight times v. */
static inline float
pull (const CeldLaplace *l, int x, int y, size_t i, const float *v)
{
  Edges e   = edges_at (l, x, y, i);
  float sum = 0;

  if (y > 0)
    sum += e.north * v[i - (size_t) l->width];
  if (x > 0)
    sum += e.west * v[i - 1];
  if (x + 1 < l->width)
    sum += e.east * v[i + 1];
  if (y + 1 < l->height)
    sum += e.south * v[i + (size_t) l->width];
  return sum;
}

/* (A v)_i; differences first, so that flat parts give exactly nothing. */
static inline double
apply (const CeldLaplace *l, int x, int y, size_t i, const double *v)
{
  Edges  e   = edges_at (l, x, y, i);
  double sum = (double) l->diagonal[i] * v[i];

  if (y > 0)
    sum += (double) e.north * (v[i] - v[i - (size_t) l->width]);
  if (x > 0)
    sum += (double) e.west * (v[i] - v[i - 1]);
  if (x + 1 < l->width)
    sum += (double) e.east * (v[i] - v[i + 1]);
  if (y + 1 < l->height)
    sum += (double) e.south * (v[i] - v[i + (size_t) l->width]);
  return sum;
}

static void
invert_diagonal (CeldLaplace *l)
{
  for (int y = 0; y < l->height; y++)
    for (int x = 0; x < l->width; x++)
      {
        size_t i    = (size_t) y * (size_t) l->width + (size_t) x;
        Edges  e    = edges_at (l, x, y, i);
        float  full = l->diagonal[i] + (e.north + e.west + e.east + e.south);

        l->inverse[i] = full > 0 ? 1 / full : 0;
      }
}

/* ------------------------------------------------------------------ floating components */

static uint32_t
root_of (uint32_t *parent, uint32_t i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

static void
unite (uint32_t *parent, uint32_t i, uint32_t j)
{
  i = root_of (parent, i);
  j = root_of (parent, j);
  if (i < j)
    parent[j] = i;
  else
    parent[i] = j;
}

/* Numbers the components of more than one pixel that have no diagonal. */
static CeldStatus
find_floating (CeldLaplace *l)
{
  size_t     w = (size_t) l->width, n = w * (size_t) l->height;
  uint32_t  *parent = celd_alloc (n, sizeof *parent);
  uint32_t  *number = celd_alloc0 (n, sizeof *number);
  CeldStatus status = parent && number ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      for (size_t i = 0; i < n; i++)
        parent[i] = (uint32_t) i;
      for (size_t i = 0; i < n; i++)
        {
          if (i % w + 1 < w && l->east[i] > 0)
            unite (parent, (uint32_t) i, (uint32_t) i + 1);
          if (i + w < n && l->south[i] > 0)
            unite (parent, (uint32_t) i, (uint32_t) (i + w));
        }
      for (size_t i = 0; i < n; i++)
        if (l->diagonal[i] > 0)
          number[root_of (parent, (uint32_t) i)] = CELD_NO_NODE; /* held */
      for (size_t i = 0; i < n; i++) /* a root comes before its members, and is numbered when the first one comes */
        {
          uint32_t root = root_of (parent, (uint32_t) i);

          if (root != i && number[root] == 0)
            number[root] = ++l->n_floating;
          if (root != i)
            number[i] = number[root];
        }
      for (size_t i = 0; i < n; i++)
        if (number[i] == CELD_NO_NODE)
          number[i] = 0;
    }
  celd_free (parent);
  if (status == CELD_OK && l->n_floating)
    l->floating = number;
  else
    celd_free (number);
  return status;
}

/* Sums of v over each floating component and its size; sum and size have n_floating + 1 items. */
static void
sum_floating (const CeldLaplace *l, const double *v, double *sum, size_t *size)
{
  size_t n = (size_t) l->width * (size_t) l->height;

  for (uint32_t c = 0; c <= l->n_floating; c++)
    {
      sum[c]  = 0;
      size[c] = 0;
    }
  for (size_t i = 0; i < n; i++)
    {
      sum[l->floating[i]] += v[i];
      size[l->floating[i]]++;
    }
}

/* Shifts v in each floating component so that its sum is that of `wanted` (NULL: zero). */
static CeldStatus
shift_floating (const CeldLaplace *l, const double *wanted_sum, double *v)
{
  size_t  n    = (size_t) l->width * (size_t) l->height;
  double *sum  = celd_alloc ((size_t) l->n_floating + 1, sizeof *sum);
  size_t *size = celd_alloc ((size_t) l->n_floating + 1, sizeof *size);

  if (sum && size)
    {
      sum_floating (l, v, sum, size);
      for (uint32_t c = 1; c <= l->n_floating; c++)
        sum[c] = ((wanted_sum ? wanted_sum[c] : 0) - sum[c]) / (double) size[c];
      for (size_t i = 0; i < n; i++)
        if (l->floating[i])
          v[i] += sum[l->floating[i]];
    }
  celd_free (sum);
  celd_free (size);
  return sum && size ? CELD_OK : CELD_NO_MEMORY;
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
        Edges   e    = edges_at (l, x, y, i);

        l->band.sink[node] = (double) l->diagonal[i];
        w[0]        += (double) (tall ? e.east : e.south);
        w[band - 1] += (double) (tall ? e.south : e.east);
      }
  celd_band_eliminate (&l->band);
  return CELD_OK;
}

CeldStatus
celd_lap_setup (int width, int height, const float *east, const float *south, const float *diagonal,
                const CeldRun *run, CeldLaplace **laplace)
{
  size_t       n = (size_t) width * (size_t) height, band = (size_t) (width < height ? width : height);
  CeldLaplace *l = celd_alloc0 (1, sizeof *l);
  CeldStatus   status;

  if (!l)
    return CELD_NO_MEMORY;
  l->width    = width;
  l->height   = height;
  l->east     = east;
  l->south    = south;
  l->diagonal = diagonal;
  l->direct   = n * band <= BAND_LENGTH && n * band * band <= BAND_WORK;
  l->inverse  = celd_alloc (n, sizeof *l->inverse);
  status      = l->inverse ? celd_step (run, 0) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      invert_diagonal (l);
      status = find_floating (l);
    }
  if (status == CELD_OK)
    status = l->direct ? set_up_band (l) : celd_levels_new (width, height, east, south, diagonal, run, &l->levels);
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
  celd_free (laplace->inverse);
  celd_free (laplace->floating);
  celd_free (laplace);
}

/* ------------------------------------------------------------------ passes over the pixels, strip by strip */

/* The rows of strip number `strip`: from the first to before the last. */
static int first_row (int strip) { return strip * STRIP; }
static int last_row (const CeldLaplace *l, int strip) { return (strip + 1) * STRIP < l->height ? (strip + 1) * STRIP : l->height; }

static void
each_strip (Solution *s, const CeldRun *run, void (*pass) (void *solution, int strip))
{
  celd_each (run, (s->laplace->height + STRIP - 1) / STRIP, pass, s);
}

static double
sum_rows (const CeldLaplace *l, const double *sum)
{
  double total = 0;

  for (int y = 0; y < l->height; y++)
    total += sum[y];
  return total;
}

/* Gauss-Seidel for the pixels of one colour. */
static void
pass_relax (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    for (int x = (y + s->colour) & 1; x < l->width; x += 2)
      {
        size_t i = (size_t) y * (size_t) l->width + (size_t) x;

        s->z[i] = l->inverse[i] * ((float) s->r[i] + pull (l, x, y, i, s->z));
      }
}

/* The same from z = 0 for the first colour. */
static void
pass_first_guess (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    for (int x = 0; x < l->width; x++)
      {
        size_t i = (size_t) y * (size_t) l->width + (size_t) x;

        s->z[i] = (x + y) & 1 ? 0 : l->inverse[i] * (float) s->r[i];
      }
}

/* After the second colour only the first has a residual, and that is what its neighbours pull. */
static void
pass_restrict (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;
  float             *b = s->levels->level[0].b;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    for (int x = y & 1; x < l->width; x += 2)
      {
        size_t   i    = (size_t) y * (size_t) l->width + (size_t) x;
        uint32_t node = s->levels->coarser[i];

        if (node != CELD_NO_NODE)
          b[node] += pull (l, x, y, i, s->z);
      }
}

static void
pass_prolong (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    for (int x = 0; x < l->width; x++)
      {
        size_t   i    = (size_t) y * (size_t) l->width + (size_t) x;
        uint32_t node = s->levels->coarser[i];

        if (node != CELD_NO_NODE)
          s->z[i] += STRETCH * s->levels->level[0].x[node];
      }
}

/* r = - A x, to which the caller adds b. */
static void
pass_residual (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    for (int x = 0; x < l->width; x++)
      {
        size_t i = (size_t) y * (size_t) l->width + (size_t) x;

        s->r[i] = -apply (l, x, y, i, s->x);
      }
}

/* sum = z r, sum2 = z q, top = max |z|. */
static void
pass_measure (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    {
      size_t i  = (size_t) y * (size_t) l->width;
      double zr = 0, zq = 0, top = 0;

      for (int x = 0; x < l->width; x++, i++)
        {
          double z = (double) s->z[i], size = z < 0 ? -z : z;

          zr += z * s->r[i];
          zq += z * s->q[i];
          top = size > top ? size : top;
        }
      s->sum[y]  = zr;
      s->sum2[y] = zq;
      s->top[y]  = top;
    }
}

/* p = z + factor p. */
static void
pass_direction (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;
  size_t             from = (size_t) first_row (strip) * (size_t) l->width;
  size_t             to   = (size_t) last_row (l, strip) * (size_t) l->width;

  for (size_t i = from; i < to; i++)
    s->p[i] = (double) s->z[i] + s->factor * s->p[i];
}

/* q = A p, sum = p q. */
static void
pass_apply (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    {
      double pq = 0;

      for (int x = 0; x < l->width; x++)
        {
          size_t i = (size_t) y * (size_t) l->width + (size_t) x;

          s->q[i] = apply (l, x, y, i, s->p);
          pq += s->p[i] * s->q[i];
        }
      s->sum[y] = pq;
    }
}

/* x += factor p, r -= factor q; sum = min x, sum2 = max x. */
static void
pass_advance (void *solution, int strip)
{
  Solution          *s = solution;
  const CeldLaplace *l = s->laplace;

  for (int y = first_row (strip); y < last_row (l, strip); y++)
    {
      size_t i   = (size_t) y * (size_t) l->width;
      double low = INFINITY, high = -INFINITY;

      for (int x = 0; x < l->width; x++, i++)
        {
          s->x[i] += s->factor * s->p[i];
          s->r[i] -= s->factor * s->q[i];
          low  = s->x[i] < low ? s->x[i] : low;
          high = s->x[i] > high ? s->x[i] : high;
        }
      s->sum[y]  = low;
      s->sum2[y] = high;
    }
}

/* ------------------------------------------------------------------ one solution */

static void
precondition_direct (Solution *s, CeldBand *band)
{
  const CeldLaplace *l    = s->laplace;
  bool               tall = l->width <= l->height;
  size_t             w = (size_t) l->width, h = (size_t) l->height;

  for (size_t i = 0; i < w * h; i++)
    band->x[tall ? i : i % w * h + i / w] = s->r[i];
  celd_band_solve (band);
  for (size_t i = 0; i < w * h; i++)
    s->z[i] = (float) band->x[tall ? i : i % w * h + i / w];
}

/* z becomes approximately the solution of A z = r. */
static void
precondition (Solution *s, CeldLaplace *l, const CeldRun *run)
{
  if (l->direct)
    {
      precondition_direct (s, &l->band);
      return;
    }
  each_strip (s, run, pass_first_guess);
  s->colour = 1;
  each_strip (s, run, pass_relax);

  memset (l->levels.level[0].b, 0, l->levels.level[0].n * sizeof (float));
  each_strip (s, run, pass_restrict);
  celd_levels_solve (&l->levels);
  each_strip (s, run, pass_prolong);

  each_strip (s, run, pass_relax);
  s->colour = 0;
  each_strip (s, run, pass_relax);
}

/* x and r from the start; pixels without an edge are solved at once, floating components made solvable. */
static CeldStatus
begin (Solution *s, const CeldLaplace *l, const float *b, const float *start, const CeldRun *run)
{
  size_t n = (size_t) l->width * (size_t) l->height;

  for (size_t i = 0; i < n; i++)
    {
      bool alone = (double) l->inverse[i] * (double) l->diagonal[i] >= 1 - 1e-7;

      s->x[i] = alone ? (double) b[i] / (double) l->diagonal[i] : (double) start[i];
      s->p[i] = s->q[i] = 0;
    }
  each_strip (s, run, pass_residual);
  for (size_t i = 0; i < n; i++)
    s->r[i] = l->inverse[i] > 0 ? s->r[i] + (double) b[i] : 0;
  return l->floating ? shift_floating (l, NULL, s->r) : CELD_OK;
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
      int    k;

      for (k = 0; k < rounds && pivot > 0; k++)
        {
          double before = k ? beta[k] / alpha[k - 1] : 0;
          double beside = k ? before / alpha[k - 1] : 0;

          pivot = 1 / alpha[k] + before - t - (k ? beside / pivot : 0);
        }
      if (pivot > 0)
        low = t;
      else
        high = t;
    }
  return low;
}

/* The rounds of the conjugate gradient, from s->x and s->r. */
static CeldStatus
iterate (Solution *s, CeldLaplace *l, double tolerance, const CeldRun *run, CeldSolve *solve)
{
  double     alpha[MOST_ROUNDS], beta[MOST_ROUNDS], zr_before = 0, done = 0, first = 0, scale = 0;
  CeldStatus status = CELD_OK;

  *solve = (CeldSolve) { .converged = false, .error = INFINITY };
  for (int k = 0; k < MOST_ROUNDS; k++)
    {
      precondition (s, l, run);
      each_strip (s, run, pass_measure);

      double zr = sum_rows (l, s->sum), zq = sum_rows (l, s->sum2), top = 0;

      for (int y = 0; y < l->height; y++)
        top = fmax (top, s->top[y]);
      if (k > 0)
        solve->error = top / fmax (least_eigenvalue (k, alpha, beta), 1e-6) / scale;
      first = k == 1 ? solve->error : first;
      solve->converged = zr == 0 || solve->error <= tolerance;
      if (solve->converged || !(zr > 0))
        break;
      if (k > 1)
        done = fmax (done, fmin (log (first / solve->error) / log (first / tolerance), 1));
      status = celd_step (run, done);
      if (status != CELD_OK)
        break;

      beta[k]   = k ? fmax (0, -alpha[k - 1] * zq / zr_before) : 0;
      s->factor = beta[k];
      zr_before = zr;
      each_strip (s, run, pass_direction);
      each_strip (s, run, pass_apply);

      double pq = sum_rows (l, s->sum);

      if (!(pq > 0))
        break;
      alpha[k] = s->factor = zr / pq;
      each_strip (s, run, pass_advance);
      solve->iterations = k + 1;

      double low = INFINITY, high = -INFINITY;

      for (int y = 0; y < l->height; y++)
        {
          low  = fmin (low, s->sum[y]);
          high = fmax (high, s->sum2[y]);
        }
      /* Where all is nearly constant, the last digits of float are enough. */
      scale = fmax (high - low, 1e-6 * fmax (fabs (low), fabs (high)) / tolerance);
    }
  if (solve->converged && solve->iterations == 0)
    solve->error = 0;
  return status;
}

static CeldStatus
solve_one (Solution *s, CeldLaplace *l, const float *b, float *x, double tolerance, const CeldRun *run, CeldSolve *solve)
{
  size_t     n     = (size_t) l->width * (size_t) l->height;
  double    *mean  = celd_alloc ((size_t) l->n_floating + 1, sizeof *mean);
  size_t    *size  = celd_alloc ((size_t) l->n_floating + 1, sizeof *size);
  CeldStatus status = mean && size ? begin (s, l, b, x, run) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      if (l->floating)
        sum_floating (l, s->x, mean, size);
      status = iterate (s, l, tolerance, run, solve);
      if (l->floating && shift_floating (l, mean, s->x) != CELD_OK)
        status = CELD_NO_MEMORY;
      for (size_t i = 0; i < n; i++)
        x[i] = (float) s->x[i];
    }
  celd_free (mean);
  celd_free (size);
  return status;
}

CeldStatus
celd_lap_solve (CeldLaplace *laplace, int nrhs, const float *b, float *x, double tolerance,
                const CeldRun *run, CeldSolve *solve)
{
  size_t     n = (size_t) laplace->width * (size_t) laplace->height, h = (size_t) laplace->height;
  double    *vectors = celd_alloc (n, 4 * sizeof *vectors), *rows = celd_alloc (h, 3 * sizeof *rows);
  float     *z = celd_alloc (n, sizeof *z);
  CeldSolve  worst = { .converged = true };
  CeldStatus status = vectors && rows && z ? CELD_OK : CELD_NO_MEMORY;

  for (int k = 0; k < nrhs && status == CELD_OK; k++)
    {
      CeldPart  part;
      CeldRun   share = celd_run_part (&part, run, (double) k / nrhs, (double) (k + 1) / nrhs);
      CeldSolve one = { 0 };
      Solution  s = { laplace, &laplace->levels, vectors, vectors + n, vectors + 2 * n, vectors + 3 * n, z,
                      rows, rows + h, rows + 2 * h, 0, 0 };

      status = solve_one (&s, laplace, b + (size_t) k * n, x + (size_t) k * n, tolerance, &share, &one);
      worst.converged  = worst.converged && one.converged;
      worst.iterations = one.iterations > worst.iterations ? one.iterations : worst.iterations;
      worst.error      = fmax (worst.error, one.error);
    }
  if (solve && vectors && rows && z)
    *solve = worst;
  celd_free (vectors);
  celd_free (rows);
  celd_free (z);
  return status;
}
