/* Values that only fall or only rise, and the pieces of others that do.
 *
 * The nearest values to given ones that only rise are found by isotonic regression (pool adjacent violators, Ayer et
 * al. 1955); one pass gives the error of every beginning of a row of values.  So the best division into few pieces,
 * each of which falls or rises, follows by dynamic programming.
 *
 * Cost: O(n) for a row as a whole, O(n^2) for its pieces.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "input/joined-arrows.h"

#include <math.h>

/* Blocks of equal values of a regression, the last one at the end. */
typedef struct { double sum; size_t n; } Block;

/* error[i]: the sum of squares between the first i values, or the last i ones, and the nearest that only rise, times
 * `sign`, in that order. */
static void
regress (const double *value, size_t n, bool backwards, double sign, Block *block, double *error)
{
  size_t blocks = 0;

  error[0] = 0;
  for (size_t i = 0; i < n; i++)
    {
      error[i + 1]    = error[i];
      block[blocks++] = (Block) { sign * value[backwards ? n - 1 - i : i], 1 };
      while (blocks > 1 && block[blocks - 2].sum * (double) block[blocks - 1].n >
                             block[blocks - 1].sum * (double) block[blocks - 2].n)
        {
          Block *a = &block[blocks - 2], b = block[--blocks];
          double off = a->sum / (double) a->n - b.sum / (double) b.n;

          error[i + 1] += off * off * (double) (a->n * b.n) / (double) (a->n + b.n);
          a->sum += b.sum;
          a->n += b.n;
        }
    }
}

/* Errors of the first i values, or the last i ones, for all i: [0] from values that only fall, [1] that only rise. */
typedef struct { double *error[2]; Block *block; } Errors;

static CeldStatus
errors_new (size_t n, Errors *e)
{
  *e = (Errors) { { celd_alloc (2 * (n + 1), sizeof (double)), NULL }, celd_alloc (n, sizeof *e->block) };
  e->error[1] = e->error[0] ? e->error[0] + n + 1 : NULL;
  return e->error[0] && e->block ? CELD_OK : CELD_NO_MEMORY;
}

static void
errors_clear (Errors *e)
{
  celd_free (e->error[0]);
  celd_free (e->block);
}

static void
find_errors (const double *value, size_t n, bool backwards, Errors *e)
{
  regress (value, n, backwards, backwards ? 1 : -1, e->block, e->error[0]);
  regress (value, n, backwards, backwards ? -1 : 1, e->block, e->error[1]);
}

/* Of the first i values, the error from those that only fall or only rise, whichever is less. */
static double
least_error (const Errors *e, size_t i)
{
  return fmin (e->error[0][i], e->error[1][i]);
}

CeldStatus
celd_monotone_error (const double *value, size_t n, bool *rises, double *error)
{
  Errors     e;
  CeldStatus status = errors_new (n, &e);

  if (status == CELD_OK)
    {
      find_errors (value, n, false, &e);
      *rises = e.error[1][n] < e.error[0][n];
      *error = least_error (&e, n);
    }
  errors_clear (&e);
  return status;
}

CeldStatus
celd_monotone_range (const double *value, size_t n, size_t part, double slack, size_t range[2])
{
  Errors     before, behind = { 0 };
  double     least = INFINITY;
  bool       found = false;
  CeldStatus status = errors_new (n, &before);

  if (status == CELD_OK)
    status = errors_new (n, &behind);
  range[0] = range[1] = n / 2;
  if (status == CELD_OK)
    {
      find_errors (value, n, false, &before);
      find_errors (value, n, true, &behind);
      for (size_t i = part; i + part <= n; i++)
        least = fmin (least, least_error (&before, i) + least_error (&behind, n - i));
      for (size_t i = part; i + part <= n; i++)
        if (least_error (&before, i) + least_error (&behind, n - i) <= least + slack)
          {
            range[0] = found ? range[0] : i;
            range[1] = i;
            found    = true;
          }
    }
  errors_clear (&before);
  errors_clear (&behind);
  return status;
}

/* ------------------------------------------------------------------ pieces */

/* cost[k (n + 1) + j]: the least error of the first j values in k pieces, the last of which begins at from[k (n + 1) +
 * j]. */
typedef struct { size_t n, part; double *cost; size_t *from; } Division;

/* Finds the best division of values into 1 to CELD_MOST_PIECES pieces, by dynamic programming. */
static CeldStatus
find_pieces (const double *value, Division *p)
{
  size_t     row = p->n + 1, all = (CELD_MOST_PIECES + 1) * row;
  Errors     e;
  CeldStatus status = errors_new (p->n, &e);

  p->cost = celd_alloc (all, sizeof *p->cost);
  p->from = celd_alloc0 (all, sizeof *p->from);
  if (!p->cost || !p->from)
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < all && status == CELD_OK; i++)
    p->cost[i] = i ? INFINITY : 0;
  for (size_t i = 0; i + p->part <= p->n && status == CELD_OK; i++)
    {
      find_errors (value + i, p->n - i, false, &e);
      for (size_t k = 0; k < CELD_MOST_PIECES; k++)
        for (size_t j = i + p->part; j <= p->n && isfinite (p->cost[k * row + i]); j++)
          {
            double cost = p->cost[k * row + i] + least_error (&e, j - i);

            if (cost < p->cost[(k + 1) * row + j])
              {
                p->cost[(k + 1) * row + j] = cost;
                p->from[(k + 1) * row + j] = i;
              }
          }
    }
  errors_clear (&e);
  return status;
}

CeldStatus
celd_monotone_divide (const double *value, size_t n, size_t part, double most, size_t *cut, size_t *n_pieces)
{
  Division     p = { .n = n, .part = part };
  CeldStatus status = find_pieces (value, &p);
  size_t     k = 1;

  *n_pieces = 0;
  while (status == CELD_OK && k <= CELD_MOST_PIECES && p.cost[k * (n + 1) + n] > most)
    k++;
  if (status == CELD_OK && k <= CELD_MOST_PIECES)
    {
      *n_pieces = k;
      cut[k]    = n;
      for (size_t i = k; i > 0; i--)
        cut[i - 1] = p.from[i * (n + 1) + cut[i]];
    }
  celd_free (p.cost);
  celd_free (p.from);
  return status;
}
