/* The dual active-set method (D. Goldfarb and A. Idnani, Mathematical Programming 27, 1983) for a quadratic program on
 * a graph Laplacian.
 *
 * u is always the point of least energy on which the active inequalities hold with equality, and no multiplier is
 * negative.  A violated inequality becomes active by moving along z = H (e_a - e_b) until it holds; on the way, active
 * ones whose multiplier reaches 0 become inactive.  The dual value rises with every step, so that no active set comes
 * back and the method ends (ties could hold it up: the number of steps is limited).  Two things are particular here:
 *
 * - active inequalities are the links of a forest (quadratic-forest.c), so that linear dependence of constraints is a
 *   question of connectivity and never of rounding;
 * - K does not say where its components are: translations are free.  A violated inequality between two bodies moves one
 *   of them at no cost.
 *
 * Of several violated inequalities the one becomes active that raises the dual value most.  In the beginning and in the
 * end u and the multipliers are computed anew from the active set alone, inequalities with a negative multiplier become
 * inactive, and the method goes on if that shows a violation that rounding had hidden.
 *
 * Cost: O(n^3) to begin and to end, O(n^2 + m) a step.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/quadratic-private.h"

#include <math.h>

#define TINY_FLOW    1e-10 /* share of a unit force: less through a link is rounding; chosen */
#define ROUNDING     1e-15 /* relative error of u, a few units in the last place */
#define MAX_RESTARTS 10    /* times that u is computed anew and the method goes on; chosen */

/* ------------------------------------------------------------------ from the active set alone */

/* The least-energy point of the links, with H as it is; bodies stay about where they are. */
static void
place_nodes (CeldActiveSet *q)
{
  CeldForest *f = &q->forest;

  for (size_t at = 0; at < f->n; at++)
    {
      uint32_t i = f->order[at];

      if (f->link[i] == CELD_NO_LINK)
        q->z[f->tree[i]] = q->u[i];
      q->u[i] = q->z[f->tree[i]] + f->offset[i];
    }
  for (int again = 0; again < 2; again++)
    {
      celd_forest_force (f, q->u, q->force);
      celd_forest_motion (f, q->force, q->z);
      for (size_t i = 0; i < f->n; i++)
        q->u[i] -= q->z[i];
    }
}

/* The link with the most negative multiplier that rounding of u on either of its sides cannot explain; or SIZE_MAX. */
static size_t
worst_link (CeldActiveSet *q)
{
  const CeldForest *f = &q->forest;
  double           *side = q->z, *both = q->force, largest = 0;
  size_t            worst = SIZE_MAX;

  for (size_t i = 0; i < f->n; i++)
    largest = fmax (largest, fabs (q->u[i]));
  for (size_t i = 0; i < f->n; i++)
    side[i] = ROUNDING * largest * fabs (f->pull[i]);
  for (size_t at = f->n; at-- > 0;)
    if (f->link[f->order[at]] != CELD_NO_LINK)
      side[f->parent[f->order[at]]] += side[f->order[at]];
  for (size_t at = 0; at < f->n; at++)
    {
      uint32_t i = f->order[at], l = f->link[i];

      both[i] = l == CELD_NO_LINK ? side[i] : both[f->parent[i]];
      if (l != CELD_NO_LINK && q->r[l] < -fmin (side[i], both[i] - side[i]) &&
          (worst == SIZE_MAX || q->r[l] < q->r[worst]))
        worst = l;
    }
  return worst;
}

/* Computes u and the multipliers anew, and makes inequalities inactive whose multiplier is negative. */
static bool
settle (CeldActiveSet *q)
{
  CeldForest *f = &q->forest;
  double      curvature, along;
  bool        good = celd_forest_set_up (f);

  if (good)
    place_nodes (q);
  while (good)
    {
      size_t worst;

      celd_forest_force (f, q->u, q->force);
      celd_forest_flow (f, q->force, q->r);
      worst = worst_link (q);
      if (worst == SIZE_MAX)
        break;
      q->steps++;
      good = celd_forest_drop (f, worst, q->z, q->force, &curvature);
      if (good && curvature > 0)
        {
          along = 0;
          for (size_t i = 0; i < f->n; i++)
            along += q->u[i] * q->force[i];
          for (size_t i = 0; i < f->n; i++)
            q->u[i] -= along / curvature * q->z[i];
        }
      else if (good)
        place_nodes (q);
    }
  for (size_t i = 0; i < f->m; i++)
    q->y[i] = 0;
  for (size_t l = 0; good && l < f->n_active; l++)
    q->y[f->active[l]] = fmax (q->r[l], 0);
  return good;
}

/* ------------------------------------------------------------------ the dual method */

double
celd_violation (const CeldActiveSet *q, size_t i)
{
  const CeldInequality *one = &q->forest.inequality[i];
  double                missing = one->gap - (q->u[one->a] - q->u[one->b]);

  return missing > 1e-13 * one->gap + 1e-14 * q->range ? missing : 0;
}

/* The violated inequality that raises the dual value most, m if all hold. */
static size_t
choose (const CeldActiveSet *q)
{
  const CeldForest *f = &q->forest;
  size_t            best = f->m;
  double            most = 0;

  for (size_t i = 0; i < f->m; i++)
    {
      double missing = celd_violation (q, i);

      if (missing > 0)
        {
          size_t a = f->inequality[i].a, b = f->inequality[i].b, n = f->n;
          double curvature = f->inverse[a * n + a] + f->inverse[b * n + b] - 2 * f->inverse[a * n + b];
          double gain = missing * missing / fmax (curvature, 1e-30);

          if (gain > most)
            {
              most = gain;
              best = i;
            }
        }
    }
  return best;
}

/* Moves the body of the nearer node until inequality p holds, which costs nothing, and joins both bodies. */
static void
join_bodies (CeldActiveSet *q, uint32_t p, double y)
{
  CeldForest *f = &q->forest;
  uint32_t    a = f->inequality[p].a, b = f->inequality[p].b, body = f->body[f->component[a]];
  double      missing = f->inequality[p].gap - (q->u[a] - q->u[b]);

  for (size_t i = 0; i < f->n; i++)
    if (f->body[f->component[i]] == body)
      q->u[i] += missing;
  q->y[p] = y;
  celd_forest_join (f, p);
}

/* The motion that a unit force on p causes, and in r what it takes from the links.  Curvature 0: none, the tree is
 * rigid. */
static bool
find_motion (CeldActiveSet *q, uint32_t p, double *curvature)
{
  CeldForest *f = &q->forest;
  uint32_t    a = f->inequality[p].a, b = f->inequality[p].b;

  *curvature = 0;
  for (size_t i = 0; i < f->n; i++)
    q->z[i] = q->force[i] = 0;
  if (f->tree[a] != f->tree[b])
    for (;;)
      {
        for (size_t i = 0; i < f->n; i++)
          q->z[i] = f->inverse[a * f->n + i] - f->inverse[b * f->n + i];
        *curvature = q->z[a] - q->z[b];
        celd_forest_force (f, q->z, q->force);
        if (*curvature > 0 && !celd_forest_is_inaccurate (f, *curvature, q->z, q->force))
          break;
        if (f->fresh || !celd_forest_set_up (f))
          return false;
      }
  for (size_t i = 0; i < f->n; i++)
    q->force[i] = (i == a) - (double) (i == b) - q->force[i];
  celd_forest_flow (f, q->force, q->r);
  return true;
}

/* The link whose multiplier reaches 0 first, and when. */
static size_t
first_loose (const CeldActiveSet *q, double *when)
{
  const CeldForest *f = &q->forest;
  size_t            first = SIZE_MAX;

  *when = INFINITY;
  for (size_t l = 0; l < f->n_active; l++)
    if (q->r[l] > TINY_FLOW)
      {
        double y = q->y[f->active[l]] / q->r[l];

        if (y < *when || (y == *when && f->active[l] < f->active[first]))
          {
            *when = y;
            first = l;
          }
      }
  return first;
}

/* Makes inequality p active; others become inactive on the way. */
static bool
take_in (CeldActiveSet *q, uint32_t p)
{
  CeldForest           *f = &q->forest;
  const CeldInequality *one = &f->inequality[p];
  double                curvature, y = 0;

  while (q->steps++ < q->most_steps)
    {
      double full, when;
      size_t loose;

      if (f->body[f->component[one->a]] != f->body[f->component[one->b]])
        {
          join_bodies (q, p, y);
          return true;
        }
      if (!find_motion (q, p, &curvature))
        return false;
      loose = first_loose (q, &when);
      full  = curvature > 0 ? fmax (one->gap - (q->u[one->a] - q->u[one->b]), 0) / curvature : INFINITY;
      if (!(fmin (full, when) < INFINITY))
        return false;
      when = fmin (full, when);
      for (size_t i = 0; i < f->n; i++)
        q->u[i] += when * q->z[i];
      for (size_t l = 0; l < f->n_active; l++)
        {
          double *left = &q->y[f->active[l]];

          *left = *left > when * q->r[l] ? *left - when * q->r[l] : 0;
        }
      y += when;
      if (full <= when)
        {
          celd_forest_add (f, p, q->z, curvature);
          q->y[p] = y;
          return true;
        }
      q->y[f->active[loose]] = 0;
      if (!celd_forest_drop (f, loose, q->z, q->force, &curvature))
        return false;
    }
  return true;
}

bool
celd_active_set_solve (CeldActiveSet *q)
{
  bool good = settle (q);

  for (int round = 0; good && round < MAX_RESTARTS && q->steps < q->most_steps; round++)
    {
      size_t p = choose (q);

      if (p == q->forest.m)
        break;
      for (; good && p < q->forest.m && q->steps < q->most_steps; p = choose (q))
        good = take_in (q, (uint32_t) p);
      good = good && settle (q);
    }
  return good;
}
