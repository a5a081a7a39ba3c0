/* The matrices of a quadratic program on a graph Laplacian: K, and H, the motions that forces cause.
 *
 * Trees of rigid links move as one.  With trees as its nodes the reduced matrix Z'KZ is a graph Laplacian again, and H
 * = Z (Z'KZ)^-1 Z', with one tree of each body held, is computed by eliminating tree after tree: weights between the
 * others only grow, by w_ik w_jk / s_k, and pivots s_k are sums of weights.  Nothing is subtracted, so that H is
 * accurate entry by entry whatever the range of the weights (Grassmann, Taksar and Heyman 1985 do so with Markov
 * chains).
 *
 * Cost: O(n^3) for H, O(n^2) for a force or a motion.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/quadratic-private.h"

#include <math.h>

#define TINY_WEIGHT 1e-14 /* share of the largest weight: less is no connection; some hundred units in the last place */

/* ------------------------------------------------------------------ K */

/* Weights of K, without those that are nothing beside the largest. */
static void
read_weights (CeldForest *f, const double *k)
{
  size_t n = f->n;
  double largest = 0;

  for (size_t i = 0; i < n; i++)
    for (size_t j = 0; j < n; j++)
      {
        double w = i == j ? 0 : -(k[i * n + j] + k[j * n + i]) / 2;

        f->weight[i * n + j] = w;
        if (fabs (w) > largest)
          largest = fabs (w);
      }
  for (size_t i = 0; i < n; i++)
    {
      f->pull[i] = 0;
      for (size_t j = 0; j < n; j++)
        {
          double w = fabs (f->weight[i * n + j]) > TINY_WEIGHT * largest ? f->weight[i * n + j] : 0;

          f->weight[i * n + j] = w;
          f->pull[i] += w;
        }
    }
}

static void
find_components (CeldForest *f)
{
  size_t left = f->n;

  celd_roots (f->body, f->n);
  for (uint32_t i = 0; i < f->n; i++)
    for (uint32_t j = 0; j < f->n && left > 1; j++)
      if (f->weight[i * f->n + j] != 0 && celd_root (f->body, i) != celd_root (f->body, j))
        {
          celd_join (f->body, i, j);
          left--;
        }
  f->n_components = 0;
  for (uint32_t i = 0; i < f->n; i++)
    {
      uint32_t root = celd_root (f->body, i);

      f->component[i] = root == i ? (uint32_t) f->n_components++ : f->component[root];
    }
}

void
celd_forest_read (CeldForest *f, const double *k)
{
  read_weights (f, k);
  find_components (f);
}

/* ------------------------------------------------------------------ H */

/* Numbers the trees from 0: first those that are held, one of each body, the one with the greatest weight.  Returns how
 * many these are. */
static size_t
number_trees (const CeldForest *f, uint32_t *place)
{
  uint32_t *held = f->entry + f->n; /* of a body */
  size_t    n = 0, next;

  for (size_t t = 0; t < f->n_trees; t++)
    {
      f->row[t] = 0;
      place[t] = UINT32_MAX;
    }
  for (size_t c = 0; c < f->n_components; c++)
    held[c] = UINT32_MAX;
  for (size_t i = 0; i < f->n; i++)
    f->row[f->tree[i]] += f->pull[i];
  for (size_t i = 0; i < f->n; i++)
    {
      uint32_t *best = &held[f->body[f->component[i]]];

      if (*best == UINT32_MAX || f->row[f->tree[i]] > f->row[*best])
        *best = f->tree[i];
    }
  for (size_t c = 0; c < f->n_components; c++)
    if (held[c] != UINT32_MAX)
      place[held[c]] = (uint32_t) n++;
  next = n;
  for (size_t t = 0; t < f->n_trees; t++)
    if (place[t] == UINT32_MAX)
      place[t] = (uint32_t) next++;
  return n;
}

/* Weights between trees, in the t x t matrix e; its diagonal counts nothing. */
static void
merge_weights (const CeldForest *f, const uint32_t *place, size_t t, double *e)
{
  for (size_t i = 0; i < t * t; i++)
    e[i] = 0;
  for (size_t i = 0; i < f->n; i++)
    {
      const double *weight = f->weight + i * f->n;
      double       *row = e + place[i] * t;

      for (size_t j = 0; j < f->n; j++)
        row[place[j]] += weight[j];
    }
}

/* Eliminates all trees from the last to number `held`.  Row k then has the shares of its weights, and 1 / their sum on
 * the diagonal. */
CELD_CLONES static bool
eliminate (size_t t, size_t held, double *restrict e, double *restrict share)
{
  for (size_t k = t; k-- > held;)
    {
      double *row = e + k * t, sum = 0;

      for (size_t l = 0; l < k; l++)
        sum += row[l];
      if (!(sum > 0))
        return false;
      for (size_t l = 0; l < k; l++)
        share[l] = row[l] / sum;
      for (size_t i = 1; i < k; i++)
        if (row[i] != 0)
          {
            double *other = e + i * t, part = share[i];

            for (size_t j = 0; j < i; j++)
              other[j] += part * row[j];
          }
      for (size_t l = 0; l < k; l++)
        row[l] = share[l];
      row[k] = 1 / sum;
    }
  return true;
}

/* Takes the trees back in: a unit force on tree k moves tree l by the shares of k of what it moves the others. */
CELD_CLONES static void
take_back (size_t t, size_t held, double *restrict e, double *restrict moved)
{
  for (size_t i = 0; i < held; i++)
    for (size_t j = 0; j < held; j++)
      e[i * t + j] = 0;
  for (size_t k = held; k < t; k++)
    {
      double *row = e + k * t, own = row[k];

      for (size_t l = 0; l < k; l++)
        moved[l] = 0;
      for (size_t l = held; l < k; l++)
        if (row[l] != 0)
          {
            const double *other = e + l * t;
            double        share = row[l];

            for (size_t j = 0; j < k; j++)
              moved[j] += share * other[j];
          }
      for (size_t l = 0; l < k; l++)
        own += row[l] * moved[l];
      for (size_t l = 0; l < k; l++)
        row[l] = e[l * t + k] = moved[l];
      row[k] = own;
    }
}

bool
celd_forest_set_up (CeldForest *f)
{
  uint32_t *place = f->entry + 2 * f->n; /* of a node */
  size_t    t = f->n_trees, held = number_trees (f, f->entry);

  for (size_t i = 0; i < f->n; i++)
    place[i] = f->entry[f->tree[i]];
  merge_weights (f, place, t, f->work);
  if (!eliminate (t, held, f->work, f->row))
    return false;
  take_back (t, held, f->work, f->row);
  for (size_t i = 0; i < f->n; i++)
    {
      const double *row = f->work + place[i] * t;

      for (size_t j = 0; j < f->n; j++)
        f->inverse[i * f->n + j] = row[place[j]];
    }
  f->fresh = true;
  return true;
}

/* ------------------------------------------------------------------ forces and motions */

/* image = sum of w_ij (x_i - x_j): four rows at once, for the sake of the image. */
CELD_CLONES static void
force_of (size_t n, const double *restrict weight, const double *restrict x, double *restrict image)
{
  size_t i = 0;

  for (size_t j = 0; j < n; j++)
    image[j] = 0;
  for (; i + 4 <= n; i += 4)
    {
      const double *row = weight + i * n;
      double        x0 = x[i], x1 = x[i + 1], x2 = x[i + 2], x3 = x[i + 3];

      for (size_t j = 0; j < n; j++)
        image[j] += row[j] * (x[j] - x0) + row[j + n] * (x[j] - x1) +
                    (row[j + 2 * n] * (x[j] - x2) + row[j + 3 * n] * (x[j] - x3));
    }
  for (; i < n; i++)
    for (size_t j = 0; j < n; j++)
      image[j] += weight[i * n + j] * (x[j] - x[i]);
}

CELD_CLONES static void
motion_of (size_t n, const double *restrict inverse, const double *restrict x, double *restrict image)
{
  size_t i = 0;

  for (size_t j = 0; j < n; j++)
    image[j] = 0;
  for (; i + 4 <= n; i += 4)
    {
      const double *row = inverse + i * n;
      double        x0 = x[i], x1 = x[i + 1], x2 = x[i + 2], x3 = x[i + 3];

      for (size_t j = 0; j < n; j++)
        image[j] += row[j] * x0 + row[j + n] * x1 + (row[j + 2 * n] * x2 + row[j + 3 * n] * x3);
    }
  for (; i < n; i++)
    for (size_t j = 0; j < n; j++)
      image[j] += inverse[i * n + j] * x[i];
}

void
celd_forest_force (const CeldForest *f, const double *x, double *image)
{
  force_of (f->n, f->weight, x, image);
}

void
celd_forest_motion (const CeldForest *f, const double *x, double *image)
{
  motion_of (f->n, f->inverse, x, image);
}
