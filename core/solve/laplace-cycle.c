/* The cycle over the coarse levels of the Laplacian solver.
 *
 * Plain aggregation needs help: each level is solved by up to two steps of a flexible conjugate gradient round the next
 * cycle (K-cycle; Y. Notay and P. S. Vassilevski, "Recursive Krylov-based multigrid cycles", 2008).  Relaxation is
 * Gauss-Seidel, red, black and extra nodes before the correction and the other way round after it, so that the cycle is
 * symmetric.  Lanes have coefficients of their own.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-coarse.h"
#include "solve/laplace-private.h"
#include "solve/laplace.h"

/* So much of the residual left after one inner step: no second one.  It pays more on the first levels. */
#define ENOUGH(l) ((l) <= 2 ? 0.25 : 0.5)

/* ------------------------------------------------------------------ vectors */

CeldStatus
celd_coarse_new (const CeldLevels *levels, int lanes, const CeldHost *host, CeldCoarse *cycle)
{
  *cycle = (CeldCoarse) { .levels = levels, .host = host, .lanes = lanes };
  cycle->bottom = celd_alloc (levels->bottom.n, (size_t) lanes * sizeof *cycle->bottom);
  if (!cycle->bottom)
    return CELD_NO_MEMORY;
  for (int l = 1; l < levels->n; l++)
    {
      const CeldLevel  *level  = &levels->level[l];
      CeldLevelVectors *v      = &cycle->vectors[l];
      float           **part[] = { &v->b, &v->x, &v->step, &v->image };

      for (size_t k = 0; k < sizeof part / sizeof *part; k++)
        if (!(*part[k] = celd_alloc0 ((size_t) level->n + 8, (size_t) lanes * sizeof (float))))
          return CELD_NO_MEMORY;
      if (!(v->sum = celd_alloc ((size_t) level->height, CELD_COARSE_SUMS * CELD_LANES * sizeof *v->sum)))
        return CELD_NO_MEMORY;
    }
  return CELD_OK;
}

void
celd_coarse_free (CeldCoarse *cycle)
{
  for (int l = 1; l < CELD_MAX_LEVELS; l++)
    {
      CeldLevelVectors *v = &cycle->vectors[l];

      celd_free (v->b);
      celd_free (v->x);
      celd_free (v->step);
      celd_free (v->image);
      celd_free (v->sum);
    }
  celd_free (cycle->bottom);
}

/* ------------------------------------------------------------------ the cycle */

static void krylov (CeldCoarse *cycle, int l);

/* Adds up what a pass has summed row by row. */
static void
sum_rows (const CeldPass *p, int which, double *sum)
{
  for (int k = 0; k < CELD_LANES; k++)
    sum[k] = 0;
  for (int y = 0; y < p->level->height; y++)
    for (int k = 0; k < CELD_LANES; k++)
      sum[k] += p->sum[((size_t) y * CELD_COARSE_SUMS + (size_t) which) * CELD_LANES + (size_t) k];
}

/* One cycle of level l, not the last: x becomes approximately the solution for b; xb = x b, xi = x A x, oi = other A x.
 * image: for A x; of the extra nodes even if p->image is NULL. */
static void
descend (CeldCoarse *cycle, int l, CeldPass *p, float *image, double *xb, double *xi, double *oi)
{
  const CeldLevel *level = p->level;
  int              lanes = cycle->lanes;

  p->next = &cycle->vectors[l + 1];
  memset (p->next->b, 0, (size_t) level[1].n * (size_t) lanes * sizeof *p->next->b);
  celd_first_down (cycle, p);
  celd_extra_down (p, lanes);
  krylov (cycle, l + 1);
  celd_first_correct (cycle, p);
  celd_extra_up (p, lanes);
  celd_first_up (cycle, p);
  sum_rows (p, 0, xb);
  sum_rows (p, 1, xi);
  sum_rows (p, 2, oi);
  if (!level->n_extra)
    return;
  celd_extra_apply (p, image, lanes);
  celd_extra_dot (level, p->x, p->b, xb, lanes);
  celd_extra_dot (level, p->x, image, xi, lanes);
  if (p->other)
    celd_extra_dot (level, p->other, image, oi, lanes);
}

static void
solve_last (CeldCoarse *cycle)
{
  const CeldLevels       *levels = cycle->levels;
  const CeldLevelVectors *v = &cycle->vectors[levels->n - 1];
  size_t                  many = (size_t) cycle->lanes;

  for (uint32_t i = 0; i < levels->bottom.n; i++)
    for (size_t k = 0; k < many; k++)
      cycle->bottom[i * many + k] = (double) v->b[levels->bottom_node[i] * many + k];
  celd_band_solve (&levels->bottom, cycle->lanes, cycle->bottom);
  for (uint32_t i = 0; i < levels->bottom.n; i++)
    for (size_t k = 0; k < many; k++)
      v->x[levels->bottom_node[i] * many + k] = (float) cycle->bottom[i * many + k];
}

/* b -= a A x on level l; is so much of it left, in any lane, that a second step is worth while? */
static bool
reduce_all (CeldCoarse *cycle, CeldPass *p, int l)
{
  double before[CELD_LANES], after[CELD_LANES];
  bool   again = false;

  celd_first_reduce (cycle, p);
  sum_rows (p, 0, before);
  sum_rows (p, 1, after);
  celd_extra_dot (p->level, p->b, p->b, before, cycle->lanes);
  celd_extra_reduce (p, cycle->lanes);
  celd_extra_dot (p->level, p->b, p->b, after, cycle->lanes);
  for (int k = 0; k < cycle->lanes; k++)
    again = again || after[k] > ENOUGH (l) * ENOUGH (l) * before[k];
  return again;
}

/* Level l: a x + c step becomes approximately the solution for b, which is used up. */
static void
krylov (CeldCoarse *cycle, int l)
{
  CeldLevelVectors *v = &cycle->vectors[l];
  double            xb[CELD_LANES], rho[CELD_LANES], yb[CELD_LANES], beta[CELD_LANES], gamma[CELD_LANES];
  CeldPass          p = { .level = &cycle->levels->level[l], .b = v->b, .x = v->x, .image = v->image, .sum = v->sum };

  for (int k = 0; k < CELD_LANES; k++)
    {
      v->a[k] = 1;
      v->c[k] = 0;
    }
  if (l == cycle->levels->n - 1)
    {
      solve_last (cycle);
      return;
    }
  descend (cycle, l, &p, v->image, xb, rho, gamma);
  for (int k = 0; k < cycle->lanes; k++)
    p.a[k] = v->a[k] = (float) (rho[k] > 0 ? xb[k] / rho[k] : 0);
  if (!reduce_all (cycle, &p, l))
    return;

  p.x     = v->step;
  p.other = v->x;
  p.image = NULL;
  descend (cycle, l, &p, v->image, yb, beta, gamma);
  for (int k = 0; k < cycle->lanes; k++)
    {
      double left = rho[k] > 0 ? beta[k] - gamma[k] * gamma[k] / rho[k] : 0, second = left > 0 ? yb[k] / left : 0;

      v->c[k] = (float) second;
      if (second > 0 || second < 0)
        v->a[k] -= (float) (second * gamma[k] / rho[k]);
    }
}

void
celd_coarse_solve (CeldCoarse *cycle)
{
  if (cycle->levels->n > 1)
    krylov (cycle, 1);
}
