/* The null space of a Laplacian system: floating components, which no diagonal and no fixed pixel holds.
 *
 * There the solution is determined but for a constant, and exists only if the right-hand side sums to zero.  So the
 * mean of the right-hand side is subtracted before a solution, and the solution shifted to the mean of its start after
 * it. Single pixels need neither.
 *
 * Cost: O(pixels) by runs of pixels that edges join.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "base/vector.h"
#include "solve/laplace-private.h"

/* Runs of pixels in a row that edges join; a run ends where the next one begins. */
typedef struct
{
  uint32_t *first;              /* pixel; in the end the number of pixels */
  uint32_t *parent;             /* the set of runs to which it belongs */
  size_t   *row;                /* where the runs of each row begin */
  size_t    n;
  size_t    first_capacity;
} Runs;

/* Marks the pixels that no edge joins with the next one, which is so in the last column. */
CELD_CLONES static void
mark_ends (size_t w, const float *east, uint8_t *mark)
{
  for (size_t x = 0; x < w; x++)
    mark[x] = east[x] > 0 ? 0 : 0x80;
}

static CeldStatus
list_runs (const CeldWeightedGraph *g, Runs *runs, uint8_t *mark)
{
  int w = g->width;

  for (int y = 0; y < g->height; y++)
    {
      size_t i = (size_t) y * (size_t) w;

      runs->row[y] = runs->n;
      mark_ends ((size_t) w, g->east + i, mark);
      for (int x = 0; x < w; x = celd_next_marked (w, mark, x) + 1)
        {
          if (celd_append (runs->first, runs->n, runs->first_capacity, (uint32_t) (i + (size_t) x)) != CELD_OK)
            return CELD_NO_MEMORY;
        }
    }
  runs->row[g->height] = runs->n;
  return CELD_OK;
}

/* Does an edge lead down from any pixel of from .. to-1? */
static bool
leads_down (const float *south, uint32_t from, uint32_t to)
{
  while (from < to && !(south[from] > 0))
    from++;
  return from < to;
}

/* Joins the runs of two rows, of which `below` is the lower one. */
static void
join_rows (const CeldWeightedGraph *g, Runs *runs, size_t below)
{
  uint32_t w = (uint32_t) g->width;
  size_t   a = runs->row[below - 1], b = runs->row[below];

  while (a < runs->row[below] && b < runs->row[below + 1])
    {
      uint32_t from_a = runs->first[a], from_b = runs->first[b] - w;
      uint32_t end_a = runs->first[a + 1], end_b = runs->first[b + 1] - w;

      if (leads_down (g->south, from_a > from_b ? from_a : from_b, end_a < end_b ? end_a : end_b))
        celd_join (runs->parent, (uint32_t) a, (uint32_t) b);
      a += end_a <= end_b;
      b += end_b <= end_a;
    }
}

/* Lists the runs and joins those that edges join. */
static CeldStatus
join_runs (const CeldWeightedGraph *g, Runs *runs)
{
  uint8_t   *mark = celd_alloc ((size_t) g->width, 1);
  CeldStatus status = CELD_NO_MEMORY;

  runs->row = celd_alloc ((size_t) g->height + 1, sizeof *runs->row);
  if (mark && runs->row)
    status = list_runs (g, runs, mark);
  celd_free (mark);
  if (status != CELD_OK)
    return status;
  if (!celd_reserve_one (runs->first, runs->n, runs->first_capacity))
    return CELD_NO_MEMORY;
  runs->parent = celd_alloc (runs->n, sizeof *runs->parent);
  if (!runs->parent)
    return CELD_NO_MEMORY;
  runs->first[runs->n] = (uint32_t) g->width * (uint32_t) g->height;
  celd_roots (runs->parent, runs->n);
  for (size_t y = 1; y < (size_t) g->height; y++)
    join_rows (g, runs, y);
  return CELD_OK;
}

/* Numbers the sets of several pixels without a diagonal: number[k] of run k, 0 for all others; returns how many. */
static uint32_t
number_runs (const CeldWeightedGraph *g, Runs *runs, uint32_t *number)
{
  uint32_t count = 0;

  for (size_t k = 0; k < runs->n; k++)
    {
      uint32_t *held = &number[celd_root (runs->parent, (uint32_t) k)];

      for (size_t i = runs->first[k]; i < runs->first[k + 1] && !*held; i++)
        *held = g->diagonal[i] > 0 ? CELD_NO_NODE : 0;
    }
  for (size_t k = 0; k < runs->n; k++) /* a root comes before its members, and is numbered when it has a second pixel */
    {
      uint32_t root = celd_root (runs->parent, (uint32_t) k);
      bool     several = root != k || runs->first[k + 1] > runs->first[k] + 1;

      if (number[root] == 0 && several)
        number[root] = ++count;
      number[k] = number[root];
    }
  for (size_t k = 0; k < runs->n; k++)
    if (number[k] == CELD_NO_NODE)
      number[k] = 0;
  return count;
}

/* The runs that float, and sizes. */
static CeldStatus
keep_runs (const Runs *runs, const uint32_t *number, CeldLaplace *l)
{
  size_t   kept = 0;
  uint32_t w = (uint32_t) l->width;

  for (size_t k = 0; k < runs->n; k++)
    kept += number[k] != 0;
  l->floating      = celd_alloc (kept, sizeof *l->floating);
  l->floating_row  = celd_alloc0 ((size_t) l->height + 1, sizeof *l->floating_row);
  l->floating_size = celd_alloc0 ((size_t) l->n_floating + 1, sizeof *l->floating_size);
  if (!l->floating || !l->floating_row || !l->floating_size)
    return CELD_NO_MEMORY;
  kept = 0;
  for (size_t k = 0; k < runs->n; k++)
    if (number[k])
      {
        l->floating[kept++] = (CeldFloatingRun) { runs->first[k], runs->first[k + 1], number[k] };
        l->floating_row[runs->first[k] / w + 1]++;
        l->floating_size[number[k]] += runs->first[k + 1] - runs->first[k];
      }
  for (size_t y = 0; y < (size_t) l->height; y++)
    l->floating_row[y + 1] += l->floating_row[y];
  return CELD_OK;
}

CeldStatus
celd_null_space_find (const CeldWeightedGraph *pixels, CeldLaplace *l)
{
  Runs       runs   = { 0 };
  uint32_t  *number = NULL;
  CeldStatus status = join_runs (pixels, &runs);

  if (status == CELD_OK)
    status = (number = celd_alloc0 (runs.n, sizeof *number)) ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      l->n_floating = number_runs (pixels, &runs, number);
      if (l->n_floating)
        status = keep_runs (&runs, number, l);
    }
  celd_free (runs.first);
  celd_free (runs.parent);
  celd_free (runs.row);
  celd_free (number);
  return status;
}

void
celd_null_space_means (const CeldLaplace *l, int lanes, const float *v, double *mean)
{
  size_t many = (size_t) lanes;

  memset (mean, 0, ((size_t) l->n_floating + 1) * many * sizeof *mean);
  for (size_t f = 0; f < celd_null_space_runs (l); f++)
    for (size_t i = l->floating[f].first; i < l->floating[f].end; i++)
      for (size_t k = 0; k < many; k++)
        mean[l->floating[f].component * many + k] += (double) v[i * many + k];
  for (size_t c = 1; c <= l->n_floating; c++)
    for (size_t k = 0; k < many; k++)
      mean[c * many + k] /= (double) l->floating_size[c];
}

void
celd_null_space_shift (const CeldLaplace *l, int lanes, const double *plus, const double *minus, float *v)
{
  size_t many = (size_t) lanes;

  for (size_t f = 0; f < celd_null_space_runs (l); f++)
    for (size_t i = l->floating[f].first; i < l->floating[f].end; i++)
      for (size_t k = 0; k < many; k++)
        {
          size_t at = l->floating[f].component * many + k;

          v[i * many + k] = (float) ((double) v[i * many + k] + plus[at] - minus[at]);
        }
}
