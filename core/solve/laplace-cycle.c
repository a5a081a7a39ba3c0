/* The K-cycle over the coarse levels of the Laplacian solver.
 *
 * A V-cycle is not enough for plain aggregation, so each level is solved by up to two steps of a flexible conjugate
 * gradient that the next coarser level preconditions: Y. Notay and P. S. Vassilevski, "Recursive Krylov-based multigrid
 * cycles", Numerical Linear Algebra with Applications 15, 2008.  Lanes have coefficients of their own.
 *
 * Cost: at most two visits to level 2 for one to level 1, and so on; each level has at most 0.6 times the nodes of the
 * one before, mostly a quarter.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/laplace-private.h"

/* Where no more of the residual than this, in the Euclidean norm, is left after one inner step, there is no second one.
 * Chosen by the bench (tests/bench/solvers): a second step pays more on the first levels. */
#define ENOUGH(l) ((l) <= 2 ? 0.25 : 0.5)

#define SMALL     16384 /* numbers in a level's vector that are not worth other threads; chosen */

/* ------------------------------------------------------------------ vectors */

CeldStatus
celd_kcycle_new (const CeldHierarchy *hierarchy, int lanes, const CeldHost *host, CeldKCycle *cycle)
{
  *cycle = (CeldKCycle) { .hierarchy = hierarchy, .host = host, .lanes = lanes };
  cycle->coarsest = celd_alloc (hierarchy->coarsest.n, (size_t) lanes * sizeof *cycle->coarsest);
  if (!cycle->coarsest)
    return CELD_NO_MEMORY;
  for (int l = 1; l < hierarchy->n; l++)
    {
      const CeldGridLevel *level  = &hierarchy->level[l];
      CeldLevelVectors    *v      = &cycle->vectors[l];
      float              **part[] = { &v->b, &v->x, &v->step, &v->image };

      for (size_t k = 0; k < sizeof part / sizeof *part; k++)
        if (!(*part[k] = celd_alloc0 ((size_t) level->n + 8, (size_t) lanes * sizeof (float))))
          return CELD_NO_MEMORY;
      if (!(v->sum = celd_alloc ((size_t) level->height, CELD_SMOOTHER_SUMS * CELD_LANES * sizeof *v->sum)))
        return CELD_NO_MEMORY;
    }
  return CELD_OK;
}

void
celd_kcycle_free (CeldKCycle *cycle)
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
  celd_free (cycle->coarsest);
}

/* ------------------------------------------------------------------ the cycle */

static void
solve_coarsest (CeldKCycle *cycle)
{
  const CeldHierarchy    *h = cycle->hierarchy;
  const CeldLevelVectors *v = &cycle->vectors[h->n - 1];
  size_t                  many = (size_t) cycle->lanes;

  for (uint32_t i = 0; i < h->coarsest.n; i++)
    for (size_t k = 0; k < many; k++)
      cycle->coarsest[i * many + k] = (double) v->b[h->coarsest_node[i] * many + k];
  celd_band_solve (&h->coarsest, cycle->lanes, cycle->coarsest);
  for (uint32_t i = 0; i < h->coarsest.n; i++)
    for (size_t k = 0; k < many; k++)
      v->x[h->coarsest_node[i] * many + k] = (float) cycle->coarsest[i * many + k];
}

/* Is so much of b left on level l, in any lane, that a second step is worth while? */
static bool
is_much_left (const CeldKCycle *cycle, int l, const double *before, const double *after)
{
  bool much = false;

  for (int k = 0; k < cycle->lanes; k++)
    much = much || after[k] > ENOUGH (l) * ENOUGH (l) * before[k];
  return much;
}

/* Level l: a x + c step becomes approximately the solution for b, which is used up. */
static void
solve_level (CeldKCycle *cycle, int l)
{
  const CeldGridLevel *level = &cycle->hierarchy->level[l];
  CeldLevelVectors    *v = &cycle->vectors[l];
  double               xb[CELD_LANES], rho[CELD_LANES], yb[CELD_LANES], beta[CELD_LANES], gamma[CELD_LANES];
  double               before[CELD_LANES], after[CELD_LANES];
  CeldSmootherPass     p = { .level = level, .lanes = cycle->lanes, .b = v->b, .x = v->x, .image = v->image,
                             .next = v + 1, .sum = v->sum };

  for (int k = 0; k < CELD_LANES; k++)
    {
      v->a[k] = 1;
      v->c[k] = 0;
    }
  if (l == cycle->hierarchy->n - 1)
    {
      solve_coarsest (cycle);
      return;
    }
  p.host = (size_t) level->n * (size_t) cycle->lanes < SMALL ? NULL : cycle->host;
  celd_smooth_down (&p);
  solve_level (cycle, l + 1);
  celd_smooth_up (&p, v->image, xb, rho, gamma);
  for (int k = 0; k < cycle->lanes; k++)
    p.a[k] = v->a[k] = (float) (rho[k] > 0 ? xb[k] / rho[k] : 0);
  celd_smooth_reduce (&p, before, after);
  if (!is_much_left (cycle, l, before, after))
    return;

  p.x     = v->step;
  p.other = v->x;
  p.image = NULL;
  celd_smooth_down (&p);
  solve_level (cycle, l + 1);
  celd_smooth_up (&p, v->image, yb, beta, gamma);
  for (int k = 0; k < cycle->lanes; k++)
    {
      double left = rho[k] > 0 ? beta[k] - gamma[k] * gamma[k] / rho[k] : 0, second = left > 0 ? yb[k] / left : 0;

      v->c[k] = (float) second;
      if (second > 0 || second < 0)
        v->a[k] -= (float) (second * gamma[k] / rho[k]);
    }
}

void
celd_kcycle_solve (CeldKCycle *cycle)
{
  if (cycle->hierarchy->n > 1)
    solve_level (cycle, 1);
}
