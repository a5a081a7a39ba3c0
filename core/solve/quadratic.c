/* The quadratic program of a few nodes: min 1/2 u'Ku  subject to  u_a - u_b >= gap (eq. 1 and 2 of the paper, with the
 * pixels eliminated; K is a graph Laplacian).
 *
 * A cycle of inequalities is found beforehand by topological sorting, so that there is always a step to take.  The
 * method (quadratic-active-set.c) starts from the inequalities that hold the nodes at their longest-path levels.  Its
 * result fixes each component of K but for a constant; in the end every component is put as far back as the others let
 * it.
 *
 * Cost: O(n^3), and O(n^2 + m) for each change of the active set; memory 24 n^2 bytes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/quadratic-private.h"
#include "solve/quadratic.h"

#include <math.h>

#define MAX_ENTRY 1e30 /* largest entry of K; far from overflow when squared in sums */
#define FAR_GAP   1e12 /* largest gap, and its inverse the smallest; chosen */

/* The nodes in topological order. */
typedef struct
{
  uint32_t *first, *item; /* the inequalities whose b is i: item[first[i]] .. before first[i + 1] */
  uint32_t *sorted;       /* nodes, every b before its a */
} TopologicalOrder;

/* ------------------------------------------------------------------ topological order */

/* Fills in the order; false if the inequalities close a cycle.  waits: workspace of n numbers. */
static bool
sort_topologically (TopologicalOrder *o, size_t n, size_t m, const CeldInequality *inequality, uint32_t *waits)
{
  size_t done = 0;

  for (size_t i = 0; i <= n; i++)
    o->first[i] = 0;
  for (size_t i = 0; i < n; i++)
    waits[i] = 0;
  for (size_t i = 0; i < m; i++)
    {
      o->first[inequality[i].b]++;
      waits[inequality[i].a]++;
    }
  for (size_t i = 0; i < n; i++)
    o->first[i + 1] += o->first[i];
  for (size_t i = m; i-- > 0;)
    o->item[--o->first[inequality[i].b]] = (uint32_t) i;
  for (uint32_t i = 0; i < n; i++)
    if (!waits[i])
      o->sorted[done++] = i;
  for (size_t at = 0; at < done; at++)
    for (uint32_t e = o->first[o->sorted[at]]; e < o->first[o->sorted[at] + 1]; e++)
      if (!--waits[inequality[o->item[e]].a])
        o->sorted[done++] = inequality[o->item[e]].a;
  return done == n;
}

/* Raises u node by node, in topological order, until every inequality holds: from u = 0 to the longest-path levels. */
static void
raise_to_levels (const TopologicalOrder *o, size_t n, const CeldInequality *inequality, double *u)
{
  for (size_t at = 0; at < n; at++)
    {
      uint32_t b = o->sorted[at];

      for (uint32_t e = o->first[b]; e < o->first[b + 1]; e++)
        {
          const CeldInequality *one = &inequality[o->item[e]];

          if (u[one->a] < u[b] + one->gap)
            u[one->a] = u[b] + one->gap;
        }
    }
}

/* ------------------------------------------------------------------ the start */

static bool
good_numbers (size_t n, const double *k, size_t m, const CeldInequality *inequality)
{
  for (size_t i = 0; i < n * n; i++)
    if (!(fabs (k[i]) <= MAX_ENTRY))
      return false;
  for (size_t i = 0; i < m; i++)
    if (inequality[i].a >= n || inequality[i].b >= n || inequality[i].a == inequality[i].b ||
        !(inequality[i].gap >= 1 / FAR_GAP && inequality[i].gap <= FAR_GAP))
      return false;
  return true;
}

/* Makes links of the inequalities that hold the nodes at their longest-path levels, as far as they are independent:
 * most of them stay. */
static void
start_links (const TopologicalOrder *order, CeldActiveSet *q)
{
  CeldForest *f = &q->forest;

  for (size_t i = 0; i < f->n; i++)
    q->u[i] = 0;
  raise_to_levels (order, f->n, f->inequality, q->u);
  for (size_t i = 0; i < f->n; i++)
    q->range = fmax (q->range, q->u[i]);
  celd_roots (f->tree, f->n);
  for (uint32_t i = 0; i < f->m; i++)
    {
      uint32_t a = f->inequality[i].a, b = f->inequality[i].b;
      bool     tight = q->u[a] <= q->u[b] + f->inequality[i].gap;

      if (tight && celd_root (f->tree, a) != celd_root (f->tree, b))
        {
          celd_join (f->tree, a, b);
          f->active[f->n_active++] = i;
        }
    }
  celd_forest_walk (f);
}

/* ------------------------------------------------------------------ the answer */

/* Shifts every component as far back as the inequalities between components allow, and corrects rounding. */
static void
lay_out (const TopologicalOrder *order, CeldActiveSet *q)
{
  CeldForest *f = &q->forest;
  double     *least = q->z;
  bool        again = true;

  for (size_t c = 0; c < f->n_components; c++)
    least[c] = INFINITY;
  for (size_t i = 0; i < f->n; i++)
    least[f->component[i]] = fmin (least[f->component[i]], q->u[i]);
  for (size_t i = 0; i < f->n; i++)
    q->u[i] -= least[f->component[i]];
  for (size_t round = 0; again && round < f->n_components; round++)
    {
      again = false;
      for (size_t c = 0; c < f->n_components; c++)
        least[c] = 0;
      for (size_t i = 0; i < f->m; i++)
        {
          uint32_t a = f->component[f->inequality[i].a], b = f->component[f->inequality[i].b];

          if (a != b)
            least[a] = fmax (least[a], celd_violation (q, i));
        }
      for (size_t i = 0; i < f->n; i++)
        {
          again = again || least[f->component[i]] > 0;
          q->u[i] += least[f->component[i]];
        }
    }
  raise_to_levels (order, f->n, f->inequality, q->u);
}

static CeldCertificate
certify (CeldActiveSet *q)
{
  CeldForest     *f = &q->forest;
  CeldCertificate c = { .steps = q->steps };
  double          largest = 0;

  for (size_t i = 0; i < f->n; i++)
    for (size_t j = 0; j < i; j++)
      c.energy += f->weight[i * f->n + j] * (q->u[i] - q->u[j]) * (q->u[i] - q->u[j]) / 2;
  celd_forest_force (f, q->u, q->force);
  c.gap = 2 * c.energy;
  for (size_t i = 0; i < f->m; i++)
    {
      const CeldInequality *one = &f->inequality[i];

      largest = fmax (largest, one->gap);
      c.violation = fmax (c.violation, one->gap - (q->u[one->a] - q->u[one->b]));
      c.active += q->y[i] > 0;
      c.gap -= q->y[i] * one->gap;
      q->force[one->a] -= q->y[i];
      q->force[one->b] += q->y[i];
    }
  for (size_t i = 0; i < f->n; i++)
    c.gap -= q->force[i] * q->u[i];
  if (c.violation > 0)
    c.violation /= largest;
  return c;
}

/* Divides the two blocks of memory among the vectors and lists. */
static void
share_out (double *numbers, uint32_t *indices, TopologicalOrder *order, CeldActiveSet *q)
{
  CeldForest *f = &q->forest;
  size_t      n = f->n;
  double    **vector[] = { &f->offset, &f->row, &f->pull, &q->u, &q->z, &q->force, &q->r };
  uint32_t  **list[] = { &f->active, &f->order, &f->parent, &f->link, &f->tree, &f->component, &f->body,
                         &order->sorted };

  f->weight  = numbers;
  f->inverse = numbers + n * n;
  f->work    = numbers + 2 * n * n;
  for (size_t i = 0; i < sizeof vector / sizeof *vector; i++)
    *vector[i] = numbers + (3 * n + i) * n;
  for (size_t i = 0; i < sizeof list / sizeof *list; i++)
    *list[i] = indices + i * n;
  order->first = indices + 8 * n;
  f->entry = indices + 9 * n + 1;
}

CeldStatus
celd_quadratic (size_t n, const double *k, size_t m, const CeldInequality *inequality, double *u, double *y,
                CeldCertificate *certificate)
{
  CeldActiveSet    q = { .forest = { .n = n, .m = m, .inequality = inequality } };
  TopologicalOrder order = { 0 };
  CeldStatus       status = CELD_NO_MEMORY;
  double          *numbers;
  uint32_t        *indices;

  if (n >= UINT32_MAX / 16 || m >= UINT32_MAX || !good_numbers (n, k, m, inequality))
    return CELD_BAD_VALUE;
  numbers    = celd_alloc (3 * n + 7, n * sizeof (double));
  indices    = celd_alloc (13 * n + 4, sizeof (uint32_t));
  q.y        = celd_alloc0 (m, sizeof (double));
  order.item = celd_alloc (m, sizeof (uint32_t));
  if (numbers && indices && q.y && order.item)
    {
      share_out (numbers, indices, &order, &q);
      q.most_steps = (int) fmin (100 + 20 * ((double) n + (double) m), INT32_MAX);
      status = CELD_BAD_VALUE;
      if (sort_topologically (&order, n, m, inequality, q.forest.order))
        {
          celd_forest_read (&q.forest, k);
          start_links (&order, &q);
          if (celd_active_set_solve (&q))
            status = CELD_OK;
        }
    }
  if (status == CELD_OK)
    {
      lay_out (&order, &q);
      *certificate = certify (&q);
      if (n)
        memcpy (u, q.u, n * sizeof *u);
      if (y && m)
        memcpy (y, q.y, m * sizeof *y);
    }
  celd_free (numbers);
  celd_free (indices);
  celd_free (q.y);
  celd_free (order.item);
  return status;
}
