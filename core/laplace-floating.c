/* Floating components of a Laplacian system: those that no diagonal holds.
 *
 * There the solution is known but for a constant, and exists only if the right-hand side sums to zero.  So the
 * residual is shifted to sum zero before, and the solution to the mean of its start after; single pixels need neither.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"
#include "unions.h"

/* The component of each pixel, by its root. */
static void
join_pixels (const CeldWeights *g, uint32_t *parent)
{
  size_t w = (size_t) g->width, n = w * (size_t) g->height;

  celd_roots (parent, n);
  for (size_t i = 0; i < n; i++)
    {
      if (i % w + 1 < w && g->east[i] > 0)
        celd_join (parent, (uint32_t) i, (uint32_t) i + 1);
      if (i + w < n && g->south[i] > 0)
        celd_join (parent, (uint32_t) i, (uint32_t) (i + w));
    }
}

/* Numbers the components of several pixels without a diagonal; returns how many there are. */
static uint32_t
number_floating (const CeldWeights *g, uint32_t *parent, uint32_t *number)
{
  size_t   n = (size_t) g->width * (size_t) g->height;
  uint32_t count = 0;

  for (size_t i = 0; i < n; i++)
    if (g->sink[i] > 0)
      number[celd_root (parent, (uint32_t) i)] = CELD_NO_NODE; /* held */
  for (size_t i = 0; i < n; i++) /* a root comes before its members, and is numbered when the first of them comes */
    {
      uint32_t root = celd_root (parent, (uint32_t) i);

      if (root == i)
        continue;
      if (number[root] == 0)
        number[root] = ++count;
      number[i] = number[root];
    }
  for (size_t i = 0; i < n; i++)
    if (number[i] == CELD_NO_NODE)
      number[i] = 0;
  return count;
}

CeldStatus
celd_floating_find (const CeldWeights *pixels, CeldLaplace *l)
{
  size_t     n      = (size_t) l->width * (size_t) l->height;
  uint32_t  *parent = celd_alloc (n, sizeof *parent), *number = celd_alloc0 (n, sizeof *number);
  CeldStatus status = parent && number ? CELD_OK : CELD_NO_MEMORY;
  uint32_t   count  = 0;

  if (status == CELD_OK)
    {
      join_pixels (pixels, parent);
      count = number_floating (pixels, parent, number);
    }
  celd_free (parent);
  if (count)
    {
      l->floating      = number;
      l->n_floating    = count;
      l->floating_size = celd_alloc0 ((size_t) count + 1, sizeof *l->floating_size);
      if (!l->floating_size)
        return CELD_NO_MEMORY;
      for (size_t i = 0; i < n; i++)
        l->floating_size[number[i]]++;
    }
  else
    celd_free (number);
  return status;
}

void
celd_floating_means (const CeldLaplace *l, int lanes, const float *v, double *mean)
{
  size_t n = (size_t) l->width * (size_t) l->height, many = (size_t) lanes;

  memset (mean, 0, ((size_t) l->n_floating + 1) * many * sizeof *mean);
  for (size_t i = 0; i < n && l->n_floating; i++)
    for (size_t k = 0; k < many && l->floating[i]; k++)
      mean[l->floating[i] * many + k] += (double) v[i * many + k];
  for (size_t c = 1; c <= l->n_floating; c++)
    for (size_t k = 0; k < many; k++)
      mean[c * many + k] /= (double) l->floating_size[c];
}

void
celd_floating_shift (const CeldLaplace *l, int lanes, const double *plus, const double *minus, float *v)
{
  size_t n = (size_t) l->width * (size_t) l->height, many = (size_t) lanes;

  for (size_t i = 0; i < n && l->n_floating; i++)
    for (size_t k = 0; k < many && l->floating[i]; k++)
      {
        size_t at = l->floating[i] * many + k;

        v[i * many + k] = (float) ((double) v[i * many + k] + plus[at] - minus[at]);
      }
}
