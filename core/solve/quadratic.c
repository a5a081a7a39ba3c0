/* The quadratic program of a few nodes: min 1/2 u'Ku  subject to  u_a - u_b >= gap (eq. 1 and 2 of the paper, with the
 * pixels eliminated; K is a graph Laplacian).
 *
 * The dual active-set method (D. Goldfarb and A. Idnani, Mathematical Programming 27, 1983): u is always the point of
 * least energy on which the active inequalities hold with equality, and all multipliers are >= 0.  A violated
 * inequality becomes active by moving along z = H (e_a - e_b) until it holds; on the way, active ones whose multiplier
 * reaches 0 become inactive.  The dual value rises with every step, so that no active set comes back and the method
 * ends (ties could hold it up: the number of steps is limited).  Three things are particular here:
 *
 * - active inequalities are the links of a forest (quadratic-forest.c), so that linear dependence of constraints is a
 *   question of connectivity and never of rounding;
 * - K does not say where its components are: translations are free.  A violated inequality between two bodies moves one
 *   of them at no cost;
 * - a cycle of inequalities is found beforehand by topological sorting (quadratic-order.c), so that later on there is
 *   always a step to take.
 *
 * The method starts from the inequalities that hold the nodes at their longest-path levels, or from the last active set
 * (warm), and first makes those inactive whose multiplier is negative.  Of several violated inequalities the one
 * becomes active that raises the dual value most.  In the end u and the multipliers are computed anew from the active
 * set alone, and the method goes on if that shows a violation that rounding had hidden.
 *
 * Cost: O(n^3) to begin and to end, O(n^2 + m) a step; memory 24 n^2 bytes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "solve/quadratic-private.h"
#include "solve/quadratic.h"

#include <math.h>

#define MAX_ENTRY    1e30  /* largest entry of K; far from overflow when squared in sums */
#define FAR_GAP      1e12  /* largest gap, and its inverse the smallest; chosen */
#define TINY_FLOW    1e-10 /* share of a unit force: less through a link is rounding; chosen */
#define ROUNDING     1e-15 /* relative error of u, a few units in the last place */
#define MAX_RESTARTS 10    /* times that u is computed anew and the method goes on; chosen */

typedef struct
{
  CeldForest           forest;
  double              *u, *z, *force, *r; /* n each */
  double              *y;             /* m multipliers */
  double               range;         /* of u and offsets, to judge rounding by */
  CeldTopologicalOrder topological;
  int                  steps, most_steps;
} Program;

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

/* Makes links of the inequalities that had a multiplier, as far as they are independent; without such of those that
 * hold the nodes at their longest-path levels: most of them stay. */
static void
start_links (Program *q, const double *y)
{
  CeldForest *f = &q->forest;

  for (size_t i = 0; i < f->n; i++)
    q->u[i] = 0;
  celd_raise_to_levels (&q->topological, f->n, f->inequality, q->u);
  for (size_t i = 0; i < f->n; i++)
    q->range = fmax (q->range, q->u[i]);
  celd_roots (f->tree, f->n);
  for (uint32_t i = 0; i < f->m; i++)
    {
      uint32_t a = f->inequality[i].a, b = f->inequality[i].b;
      bool     tight = y ? y[i] > 0 : q->u[a] <= q->u[b] + f->inequality[i].gap;

      if (tight && celd_root (f->tree, a) != celd_root (f->tree, b))
        {
          celd_join (f->tree, a, b);
          f->active[f->n_active++] = i;
        }
    }
  celd_forest_walk (f);
}

/* ------------------------------------------------------------------ from the active set alone */

/* The least-energy point of the links, with H as it is; bodies stay about where they are. */
static void
place_nodes (Program *q)
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
worst_link (Program *q)
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
settle (Program *q)
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

/* How far inequality i is from holding; 0 if it does but for rounding. */
static double
violation (const Program *q, size_t i)
{
  const CeldInequality *one = &q->forest.inequality[i];
  double                missing = one->gap - (q->u[one->a] - q->u[one->b]);

  return missing > 1e-13 * one->gap + 1e-14 * q->range ? missing : 0;
}

/* The violated inequality that raises the dual value most, m if all hold. */
static size_t
choose (const Program *q)
{
  const CeldForest *f = &q->forest;
  size_t            best = f->m;
  double            most = 0;

  for (size_t i = 0; i < f->m; i++)
    {
      double missing = violation (q, i);

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

/* Two bodies of which one can move freely: it does, and they are one. */
static void
join_bodies (Program *q, uint32_t p, double y)
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
find_motion (Program *q, uint32_t p, double *curvature)
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
first_loose (const Program *q, double *when)
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

/* Makes inequality p active. */
static bool
take_in (Program *q, uint32_t p)
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

/* From a settled start to a settled end. */
static bool
solve (Program *q)
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

/* ------------------------------------------------------------------ the answer */

/* Puts every component as far back as the others let it, and makes up for rounding. */
static void
lay_out (Program *q)
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
            least[a] = fmax (least[a], violation (q, i));
        }
      for (size_t i = 0; i < f->n; i++)
        {
          again = again || least[f->component[i]] > 0;
          q->u[i] += least[f->component[i]];
        }
    }
  celd_raise_to_levels (&q->topological, f->n, f->inequality, q->u);
}

static CeldCertificate
certify (Program *q)
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

/* Cuts the two blocks of memory up. */
static void
share_out (Program *q, double *numbers, uint32_t *indices)
{
  CeldForest *f = &q->forest;
  size_t      n = f->n;
  double    **vector[] = { &f->offset, &f->row, &f->pull, &q->u, &q->z, &q->force, &q->r };
  uint32_t  **list[] = { &f->active, &f->order, &f->parent, &f->link, &f->tree, &f->component, &f->body,
                             &q->topological.sorted };

  f->weight  = numbers;
  f->inverse = numbers + n * n;
  f->work    = numbers + 2 * n * n;
  for (size_t i = 0; i < sizeof vector / sizeof *vector; i++)
    *vector[i] = numbers + (3 * n + i) * n;
  for (size_t i = 0; i < sizeof list / sizeof *list; i++)
    *list[i] = indices + i * n;
  q->topological.first = indices + 8 * n;
  f->entry = indices + 9 * n + 1;
}

CeldStatus
celd_quadratic (size_t n, const double *k, size_t m, const CeldInequality *inequality,
                double *u, double *y, bool warm, CeldCertificate *certificate)
{
  Program    q = { .forest = { .n = n, .m = m, .inequality = inequality } };
  CeldStatus status = CELD_NO_MEMORY;
  double    *numbers;
  uint32_t  *indices;

  if (n >= UINT32_MAX / 16 || m >= UINT32_MAX || !good_numbers (n, k, m, inequality))
    return CELD_BAD_VALUE;
  numbers      = celd_alloc (3 * n + 7, n * sizeof (double));
  indices      = celd_alloc (13 * n + 4, sizeof (uint32_t));
  q.y          = celd_alloc0 (m, sizeof (double));
  q.topological.item = celd_alloc (m, sizeof (uint32_t));
  if (numbers && indices && q.y && q.topological.item)
    {
      share_out (&q, numbers, indices);
      q.most_steps = (int) fmin (100 + 20 * ((double) n + (double) m), INT32_MAX);
      status = CELD_BAD_VALUE;
      if (celd_topological_sort (&q.topological, n, m, inequality, q.forest.order))
        {
          celd_forest_read (&q.forest, k);
          start_links (&q, warm ? y : NULL);
          if (solve (&q))
            status = CELD_OK;
        }
    }
  if (status == CELD_OK)
    {
      lay_out (&q);
      *certificate = certify (&q);
      if (n)
        memcpy (u, q.u, n * sizeof *u);
      if (y && m)
        memcpy (y, q.y, m * sizeof *y);
    }
  celd_free (numbers);
  celd_free (indices);
  celd_free (q.y);
  celd_free (q.topological.item);
  return status;
}
