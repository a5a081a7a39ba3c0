/* The cycle over the coarse levels of the Laplacian solver.
 *
 * Plain aggregation needs help: each level is solved by up to two steps of a flexible conjugate gradient round the next
 * cycle (K-cycle; Y. Notay and P. S. Vassilevski, "Recursive Krylov-based multigrid cycles", 2008).  Relaxation is
 * Gauss-Seidel, upwards before and downwards after the correction, so that the cycle is symmetric.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"

#include <string.h>

#define ENOUGH 0.25 /* of the residual left after one inner step: no second one */

/* Sum over the edges from .. to-1 of weight times x at their other end. */
static float
pull (const CeldLevel *level, uint32_t from, uint32_t to, const float *x)
{
  float sum = 0;

  for (uint32_t e = from; e < to; e++)
    sum += level->weight[e] * x[level->neighbour[e]];
  return sum;
}

/* Row i of A x; differences first, so that flat parts give exactly nothing. */
static float
apply (const CeldLevel *level, uint32_t i, const float *x)
{
  float sum = level->sink[i] * x[i];

  for (uint32_t e = level->start[i]; e < level->start[i + 1]; e++)
    sum += level->weight[e] * (x[i] - x[level->neighbour[e]]);
  return sum;
}

static double
apply_dot (const CeldLevel *level, const float *x, float *image)
{
  double dot = 0;

  for (uint32_t i = 0; i < level->n; i++)
    {
      image[i] = apply (level, i, x);
      dot += (double) x[i] * (double) image[i];
    }
  return dot;
}

static double
dot (const CeldLevel *level, const float *a, const float *b)
{
  double sum = 0;

  for (uint32_t i = 0; i < level->n; i++)
    sum += (double) a[i] * (double) b[i];
  return sum;
}

static void krylov (CeldLevels *levels, int l);

/* One cycle of level l, not the last: x becomes approximately the solution for level->b.
 * The first sweep starts from zero: it sees only the neighbours before, and the pull of those after is the residual. */
static void
cycle (CeldLevels *levels, int l, float *x)
{
  CeldLevel *level = &levels->level[l], *next = level + 1;

  for (uint32_t i = 0; i < level->n; i++)
    x[i] = level->inverse[i] * (level->b[i] + pull (level, level->start[i], level->middle[i], x));

  memset (next->b, 0, next->n * sizeof *next->b);
  for (uint32_t i = 0; i < level->n; i++)
    if (level->coarser[i] != CELD_NO_NODE)
      next->b[level->coarser[i]] += pull (level, level->middle[i], level->start[i + 1], x);
  krylov (levels, l + 1);
  for (uint32_t i = 0; i < level->n; i++)
    if (level->coarser[i] != CELD_NO_NODE)
      x[i] += next->x[level->coarser[i]];

  for (uint32_t i = level->n; i-- > 0;)
    x[i] = level->inverse[i] * (level->b[i] + pull (level, level->start[i], level->start[i + 1], x));
}

static void
solve_last (CeldLevels *levels)
{
  CeldLevel *last = &levels->level[levels->n - 1];

  for (uint32_t i = 0; i < last->n; i++)
    levels->bottom.x[i] = (double) last->b[i];
  celd_band_solve (&levels->bottom);
  for (uint32_t i = 0; i < last->n; i++)
    last->x[i] = (float) levels->bottom.x[i];
}

/* Level l: level->x becomes approximately the solution for level->b, which is used up. */
static void
krylov (CeldLevels *levels, int l)
{
  CeldLevel *level = &levels->level[l];
  float     *x = level->x, *y = level->step, *ax = level->image, *ay = level->image2;
  double     before, after = 0, rho, alpha;

  if (l == levels->n - 1)
    {
      solve_last (levels);
      return;
    }

  cycle (levels, l, x);
  before = dot (level, level->b, level->b);
  rho    = apply_dot (level, x, ax);
  if (!(rho > 0))
    return;
  alpha = dot (level, x, level->b) / rho;
  for (uint32_t i = 0; i < level->n; i++)
    {
      level->b[i] -= (float) alpha * ax[i];
      after += (double) level->b[i] * (double) level->b[i];
    }

  double first = alpha, second = 0;
  if (after > ENOUGH * ENOUGH * before)
    {
      cycle (levels, l, y);

      double gamma = dot (level, y, ax), beta = apply_dot (level, y, ay) - gamma * gamma / rho;

      if (beta > 0)
        {
          second = dot (level, y, level->b) / beta;
          first -= second * gamma / rho;
        }
    }
  for (uint32_t i = 0; i < level->n; i++)
    x[i] = (float) first * x[i] + (second != 0 ? (float) second * y[i] : 0.f);
}

void
celd_levels_cycle (CeldLevels *levels)
{
  if (levels->n > 0)
    krylov (levels, 0);
}
