/* The null space of a Laplacian system: floating components of the free pixels.
 *
 * In these, which no diagonal and no fixed pixel holds, the solution is determined but for a constant, and exists only
 * if the right-hand side sums to zero.  Floating single pixels are left out, since nothing changes them.  Components are
 * found by runs of pixels that edges join.
 *
 * Cost: O(pixels).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/laplace-private.h"

/* Pixels first .. end - 1 of a row, which edges join; one alone has an edge to the row above or below. */
typedef struct { uint32_t first, end; } LinkedRun;

typedef struct
{
  LinkedRun *run;
  uint32_t  *parent;            /* the set of runs to which each belongs */
  size_t    *row;               /* where the runs of each row begin */
  size_t     n, capacity;
} Runs;

/* Marks the pixels of a row with an edge to the next one, above or below, and those without an edge to the next one,
 * which is so in the last column; `north` is NULL above the first row. */
CELD_CLONES static void
mark_links (size_t w, const float *north, const float *south, const float *east, uint8_t *linked, uint8_t *last)
{
  for (size_t x = 0; x < w; x++)
    {
      last[x]   = east[x] > 0 ? 0 : 0x80;
      linked[x] = east[x] > 0 || south[x] > 0 ? 0x80 : 0;
    }
  for (size_t x = 0; x < w && north; x++)
    linked[x] |= north[x] > 0 ? 0x80 : 0;
}

/* mark: workspace for two rows. */
static CeldStatus
list_runs (const CeldWeightedGraph *g, Runs *runs, uint8_t *mark)
{
  int      w = g->width;
  uint8_t *linked = mark, *last = mark + w;

  for (int y = 0; y < g->height; y++)
    {
      uint32_t i = (uint32_t) y * (uint32_t) w;

      runs->row[y] = runs->n;
      mark_links ((size_t) w, y ? g->south + i - w : NULL, g->south + i, g->east + i, linked, last);
      for (int x = celd_next_marked (w, linked, 0), end; x < w; x = celd_next_marked (w, linked, end))
        {
          LinkedRun run = { i + (uint32_t) x, i };

          end      = celd_next_marked (w, last, x) + 1;
          run.end += (uint32_t) end;
          if (celd_append (runs->run, runs->n, runs->capacity, run) != CELD_OK)
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
      uint32_t from_a = runs->run[a].first, from_b = runs->run[b].first - w;
      uint32_t end_a = runs->run[a].end, end_b = runs->run[b].end - w;

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
  uint8_t   *mark = celd_alloc ((size_t) g->width, 2);
  CeldStatus status = CELD_NO_MEMORY;

  runs->row = celd_alloc ((size_t) g->height + 1, sizeof *runs->row);
  if (mark && runs->row)
    status = list_runs (g, runs, mark);
  celd_free (mark);
  if (status != CELD_OK)
    return status;
  runs->parent = celd_alloc (runs->n, sizeof *runs->parent);
  if (!runs->parent)
    return CELD_NO_MEMORY;
  celd_roots (runs->parent, runs->n);
  for (size_t y = 1; y < (size_t) g->height; y++)
    join_rows (g, runs, y);
  return CELD_OK;
}

/* Numbers the sets without a diagonal: number[k] of run k, 0 for all others; returns how many. */
static uint32_t
number_runs (const CeldWeightedGraph *g, Runs *runs, uint32_t *number)
{
  uint32_t count = 0;

  for (size_t k = 0; k < runs->n; k++)
    {
      uint32_t *held = &number[celd_root (runs->parent, (uint32_t) k)];

      for (size_t i = runs->run[k].first; i < runs->run[k].end && !*held; i++)
        *held = g->diagonal[i] > 0 ? CELD_NO_NODE : 0;
    }
  for (size_t k = 0; k < runs->n; k++) /* a root comes before its members */
    {
      uint32_t root = celd_root (runs->parent, (uint32_t) k);

      if (number[root] == 0)
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
        l->floating[kept++] = (CeldFloatingRun) { runs->run[k].first, runs->run[k].end, number[k] };
        l->floating_row[runs->run[k].first / w + 1]++;
        l->floating_size[number[k]] += runs->run[k].end - runs->run[k].first;
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
  celd_free (runs.run);
  celd_free (runs.parent);
  celd_free (runs.row);
  celd_free (number);
  return status;
}
