/* Floating components of a Laplacian system: those that no diagonal holds.
 *
 * There the solution is known but for a constant, and exists only if the right-hand side sums to zero.  So the
 * residual is shifted to sum zero before, and the solution to the mean of its start after; single pixels need neither.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "laplace.h"
#include "unions.h"

/* Runs of pixels in a row that edges join; a run ends where the next one begins. */
typedef struct
{
  uint32_t *first;              /* pixel */
  uint32_t *parent;             /* the set of runs to which it belongs */
  size_t    n;
} Runs;

/* Lists the runs; joins those of neighbouring rows.  row: the run of each pixel of two rows. */
static CeldStatus
join_runs (const CeldWeights *g, Runs *runs, uint32_t *row)
{
  size_t w = (size_t) g->width, h = (size_t) g->height, n = 1;

  for (size_t i = 0; i < w * h; i++)
    n += !(g->east[i] > 0); /* which it is not in the last column */
  runs->first  = celd_alloc (n, sizeof *runs->first);
  runs->parent = celd_alloc (n, sizeof *runs->parent);
  if (!runs->first || !runs->parent)
    return CELD_NO_MEMORY;
  for (size_t y = 0, i = 0; y < h; y++)
    {
      uint32_t *here = row + (y & 1 ? w : 0), *above = row + (y & 1 ? 0 : w), last = UINT32_MAX, last_above = 0;

      for (size_t x = 0; x < w; x++, i++)
        {
          if (x == 0 || !(g->east[i - 1] > 0))
            {
              runs->first[runs->n]  = (uint32_t) i;
              runs->parent[runs->n] = (uint32_t) runs->n;
              runs->n++;
            }
          here[x] = (uint32_t) runs->n - 1;
          if (y == 0 || !(g->south[i - w] > 0) || (here[x] == last && above[x] == last_above))
            continue;
          last       = here[x];
          last_above = above[x];
          celd_join (runs->parent, last, last_above);
        }
    }
  return CELD_OK;
}

/* Numbers the sets of several pixels without a diagonal: number[k] of run k, 0 for all others; returns how many. */
static uint32_t
number_runs (const CeldWeights *g, Runs *runs, uint32_t *number)
{
  size_t   n = (size_t) g->width * (size_t) g->height;
  uint32_t count = 0;

  for (size_t k = 0; k < runs->n; k++)
    for (size_t i = runs->first[k], end = k + 1 < runs->n ? runs->first[k + 1] : n; i < end; i++)
      if (g->sink[i] > 0)
        {
          number[celd_root (runs->parent, (uint32_t) k)] = CELD_NO_NODE; /* held */
          break;
        }
  for (size_t k = 0; k < runs->n; k++) /* a root comes before its members, and is numbered when it has a second pixel */
    {
      uint32_t root = celd_root (runs->parent, (uint32_t) k);
      bool     several = root != k || (k + 1 < runs->n ? runs->first[k + 1] : n) > (size_t) runs->first[k] + 1;

      if (number[root] == 0 && several)
        number[root] = ++count;
      number[k] = number[root];
    }
  for (size_t k = 0; k < runs->n; k++)
    if (number[k] == CELD_NO_NODE)
      number[k] = 0;
  return count;
}

/* The numbers of the pixels, and sizes. */
static CeldStatus
paint_runs (const Runs *runs, const uint32_t *number, CeldLaplace *l)
{
  size_t n = (size_t) l->width * (size_t) l->height;

  l->floating      = celd_alloc (n, sizeof *l->floating);
  l->floating_size = celd_alloc0 ((size_t) l->n_floating + 1, sizeof *l->floating_size);
  if (!l->floating || !l->floating_size)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < runs->n; k++)
    for (size_t i = runs->first[k], end = k + 1 < runs->n ? runs->first[k + 1] : n; i < end; i++)
      {
        l->floating[i] = number[k];
        l->floating_size[number[k]]++;
      }
  return CELD_OK;
}

CeldStatus
celd_floating_find (const CeldWeights *pixels, CeldLaplace *l)
{
  Runs       runs   = { 0 };
  uint32_t  *row    = celd_alloc (2 * (size_t) l->width, sizeof *row), *number = NULL;
  CeldStatus status = row ? join_runs (pixels, &runs, row) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = (number = celd_alloc0 (runs.n, sizeof *number)) ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      l->n_floating = number_runs (pixels, &runs, number);
      if (l->n_floating)
        status = paint_runs (&runs, number, l);
    }
  celd_free (runs.first);
  celd_free (runs.parent);
  celd_free (row);
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
