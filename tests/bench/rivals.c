/* CHOLMOD, and conjugate gradients with an incomplete Cholesky factor.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "rivals.h"
#include "base/base.h"

#include <math.h>
#include <suitesparse/cholmod.h>

#define NONE UINT32_MAX

/* ------------------------------------------------------------------ CHOLMOD */

static void
add_entry (cholmod_triplet *t, size_t row, size_t column, double value)
{
  ((int *) t->i)[t->nnz] = (int) row;
  ((int *) t->j)[t->nnz] = (int) column;
  ((double *) t->x)[t->nnz++] = value;
}

/* The lower triangle. */
static cholmod_sparse *
sparse_of (const Matrix *m, cholmod_common *common)
{
  cholmod_triplet *t = cholmod_allocate_triplet (m->n, m->n, 3 * m->n, -1, CHOLMOD_REAL, common);
  cholmod_sparse  *a;

  if (!t)
    must (CELD_NO_MEMORY);
  for (size_t i = 0; i < m->n; i++)
    {
      add_entry (t, i, i, m->diagonal[i]);
      if (m->right[i] != NONE)
        add_entry (t, m->right[i], i, -(double) m->to_right[i]);
      if (m->below[i] != NONE)
        add_entry (t, m->below[i], i, -(double) m->to_below[i]);
    }
  a = cholmod_triplet_to_sparse (t, t->nnz, common);
  cholmod_free_triplet (&t, common);
  return a;
}

/* x += the solution for the right-hand side b. */
static void
add_solution (cholmod_factor *factor, cholmod_common *common, cholmod_dense *b, size_t n, double *x)
{
  cholmod_dense *solution = cholmod_solve (CHOLMOD_A, factor, b, common);

  if (!solution)
    must (CELD_NO_MEMORY);
  for (size_t i = 0; i < n; i++)
    x[i] += ((double *) solution->x)[i];
  cholmod_free_dense (&solution, common);
}

Cholmod
cholmod_of (const Matrix *m, double *x)
{
  cholmod_common  common;
  cholmod_sparse *a;
  cholmod_factor *factor;
  cholmod_dense  *b;
  Cholmod         time;
  double          start;

  cholmod_start (&common);
  a = sparse_of (m, &common);
  b = cholmod_zeros (m->n, 1, CHOLMOD_REAL, &common);
  start  = seconds ();
  factor = cholmod_analyze (a, &common);
  time.analyse = seconds () - start;
  start = seconds ();
  if (!factor || !b || !cholmod_factorize (a, factor, &common))
    must (CELD_NO_MEMORY);
  time.factorize = seconds () - start;
  for (size_t i = 0; i < m->n; i++)
    {
      x[i] = 0;
      ((double *) b->x)[i] = m->b[i];
    }
  start = seconds ();
  add_solution (factor, &common, b, m->n, x);
  time.solve = seconds () - start;
  for (int refinement = 0; refinement < 2; refinement++)
    {
      matrix_residual (m, x, b->x);
      add_solution (factor, &common, b, m->n, x);
    }
  cholmod_free_dense (&b, &common);
  cholmod_free_factor (&factor, &common);
  cholmod_free_sparse (&a, &common);
  cholmod_finish (&common);
  return time;
}

/* ------------------------------------------------------------------ IC-CG */

/* The unknowns to the left and above; each has one at most. */
typedef struct { uint32_t *left, *above; double *pivot; } Incomplete;

/* A = (L + D) D^-1 (L + D)^T where A has entries, D the pivots. */
static Incomplete
factorize (const Matrix *m)
{
  Incomplete f = { celd_alloc (m->n, sizeof *f.left), celd_alloc (m->n, sizeof *f.above),
                   celd_alloc (m->n, sizeof *f.pivot) };

  if (!f.left || !f.above || !f.pivot)
    must (CELD_NO_MEMORY);
  for (size_t i = 0; i < m->n; i++)
    f.left[i] = f.above[i] = NONE;
  for (uint32_t i = 0; i < m->n; i++)
    {
      if (m->right[i] != NONE)
        f.left[m->right[i]] = i;
      if (m->below[i] != NONE)
        f.above[m->below[i]] = i;
    }
  for (size_t i = 0; i < m->n; i++)
    {
      f.pivot[i] = m->diagonal[i];
      if (f.left[i] != NONE)
        f.pivot[i] -= (double) m->to_right[f.left[i]] * (double) m->to_right[f.left[i]] / f.pivot[f.left[i]];
      if (f.above[i] != NONE)
        f.pivot[i] -= (double) m->to_below[f.above[i]] * (double) m->to_below[f.above[i]] / f.pivot[f.above[i]];
    }
  return f;
}

static void
precondition (const Matrix *m, const Incomplete *f, const double *r, double *z)
{
  for (size_t i = 0; i < m->n; i++)
    {
      double sum = r[i];

      if (f->left[i] != NONE)
        sum += (double) m->to_right[f->left[i]] * z[f->left[i]];
      if (f->above[i] != NONE)
        sum += (double) m->to_below[f->above[i]] * z[f->above[i]];
      z[i] = sum / f->pivot[i];
    }
  for (size_t i = m->n; i-- > 0;)
    {
      double sum = 0;

      if (m->right[i] != NONE)
        sum += (double) m->to_right[i] * z[m->right[i]];
      if (m->below[i] != NONE)
        sum += (double) m->to_below[i] * z[m->below[i]];
      z[i] += sum / f->pivot[i];
    }
}

/* q = A p; returns p q. */
static double
apply (const Matrix *m, const double *p, double *q)
{
  double sum = 0;

  for (size_t i = 0; i < m->n; i++)
    q[i] = m->diagonal[i] * p[i];
  for (size_t i = 0; i < m->n; i++)
    {
      if (m->right[i] != NONE)
        {
          q[i] -= (double) m->to_right[i] * p[m->right[i]];
          q[m->right[i]] -= (double) m->to_right[i] * p[i];
        }
      if (m->below[i] != NONE)
        {
          q[i] -= (double) m->to_below[i] * p[m->below[i]];
          q[m->below[i]] -= (double) m->to_below[i] * p[i];
        }
      sum += p[i] * q[i]; /* entry i is complete: all before it have passed */
    }
  return sum;
}

static double
dot (size_t n, const double *a, const double *b)
{
  double sum = 0;

  for (size_t i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

static double
largest_difference (size_t n, const double *a, const double *b)
{
  double most = 0;

  for (size_t i = 0; i < n; i++)
    most = fmax (most, fabs (a[i] - b[i]));
  return most;
}

double
iccg_seconds (const Matrix *m, const double *truth, double range, double error, double limit, int *iterations)
{
  double      start = seconds (), asking = 0, zr, next;
  Incomplete  f = factorize (m);
  double     *vector = celd_alloc0 (5 * m->n, sizeof *vector);
  double     *x = vector, *r = x + m->n, *z = r + m->n, *p = z + m->n, *q = p + m->n;

  if (!vector)
    must (CELD_NO_MEMORY);
  memcpy (r, m->b, m->n * sizeof *r);
  precondition (m, &f, r, z);
  memcpy (p, z, m->n * sizeof *p);
  zr = dot (m->n, z, r);
  for (*iterations = 0;; ++*iterations)
    {
      double asked = seconds (), alpha;
      bool   good = *iterations % 8 == 0 && largest_difference (m->n, x, truth) <= error * range;

      asking += seconds () - asked;
      if (good || asked - start > limit)
        {
          if (!good)
            start = -INFINITY;
          break;
        }
      alpha = zr / apply (m, p, q);
      for (size_t i = 0; i < m->n; i++)
        {
          x[i] += alpha * p[i];
          r[i] -= alpha * q[i];
        }
      precondition (m, &f, r, z);
      next = dot (m->n, z, r);
      for (size_t i = 0; i < m->n; i++)
        p[i] = z[i] + next / zr * p[i];
      zr = next;
    }
  celd_free (f.left);
  celd_free (f.above);
  celd_free (f.pivot);
  celd_free (vector);
  return seconds () - start - asking;
}
