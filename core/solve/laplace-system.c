/* A Laplacian system as it is given: boundary conditions, and the null space.
 *
 * An edge between a free and a fixed (Dirichlet) pixel is cut: its weight is added to the free one's diagonal, and it
 * is noted, so that each solution adds weight times fixed value to the right-hand side.  Over the frame there are no
 * edges (Neumann).  What is not a positive number is no weight.  The free pixels are left as a weighted graph.
 *
 * In floating components of that, which no diagonal and no fixed pixel holds, the solution is determined but for a
 * constant, and exists only if the right-hand side sums to zero.  Floating single pixels are left out, since nothing
 * changes them.  They are found by runs of pixels that edges join.
 *
 * Cost: O(pixels), on the host's threads but for the null space.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "solve/laplace-private.h"

#define NEAR_FIXED 0x80
#define WEAK       1e-3f /* least over largest weight, below which weights differ much; chosen by the bench */

/* ------------------------------------------------------------------ boundary conditions */

typedef struct
{
  const float       *east, *south, *diagonal;   /* the caller's */
  const uint8_t     *fixed;
  CeldLaplace       *laplace;
  CeldWeightedGraph *graph;
  uint8_t           *mark;                      /* of each strip: a row */
  uint32_t          *least, *most;              /* of each row: bits of its weights; those of `least` less 1 */
} Copy;

CELD_CLONES static void
copy_weights (size_t w, const float *restrict weight, float *restrict out)
{
  for (size_t x = 0; x < w; x++)
    out[x] = weight[x] > 0 ? weight[x] : 0;
}

CELD_CLONES static void
measure_weights (size_t w, const CeldBits *bits, uint32_t *least, uint32_t *most)
{
  uint32_t low = *least, high = *most;

  for (size_t x = 0; x < w; x++)
    {
      low  = bits[x] - 1 < low ? bits[x] - 1 : low; /* that of 0 is the largest */
      high = bits[x] > high ? bits[x] : high;
    }
  *least = low;
  *most  = high;
}

/* Marks the pixels that are fixed, or beside a fixed one. */
CELD_CLONES static void
mark_beside (size_t w, const uint8_t *above, const uint8_t *here, const uint8_t *below, uint8_t *restrict mark)
{
  for (size_t x = 0; x < w; x++)
    mark[x] = above[x] | here[x] | below[x];
  for (size_t x = 1; x < w; x++)
    mark[x] |= here[x - 1];
  for (size_t x = 0; x + 1 < w; x++)
    mark[x] |= here[x + 1];
  for (size_t x = 0; x < w; x++)
    mark[x] = mark[x] ? NEAR_FIXED : 0;
}

static void
mark_fixed (const Copy *c, int y, uint8_t *mark)
{
  size_t         w = (size_t) c->laplace->width;
  const uint8_t *here = c->fixed + (size_t) y * w;

  mark_beside (w, y ? here - w : here, here, y + 1 < c->laplace->height ? here + w : here, mark);
}

/* The fixed neighbours of a free pixel, with a weight; returns how many. */
static int
find_held (const Copy *c, int x, int y, CeldDirichletLink *held)
{
  int    w = c->laplace->width, h = c->laplace->height, n = 0;
  size_t p = (size_t) y * (size_t) w + (size_t) x;

#define HOLD(is, q, weight) \
  if ((is) && c->fixed[q] && (weight) > 0) \
    held[n++] = (CeldDirichletLink) { (uint32_t) p, (uint32_t) (q), weight }
  HOLD (y > 0, p - (size_t) w, c->south[p - (size_t) w]);
  HOLD (x > 0, p - 1, c->east[p - 1]);
  HOLD (x + 1 < w, p + 1, c->east[p]);
  HOLD (y + 1 < h, p + (size_t) w, c->south[p]);
#undef HOLD
  return n;
}

/* Cuts the edges of fixed pixels in a row; counts those that have a free end in held_row of the next row. */
static void
cut_row (const Copy *c, int y, uint8_t *mark)
{
  CeldWeightedGraph *g = c->graph;
  int                w = g->width;
  size_t             i = (size_t) y * (size_t) w;
  CeldDirichletLink  held[4];

  mark_fixed (c, y, mark);
  for (int x = celd_next_marked (w, mark, 0); x < w; x = celd_next_marked (w, mark, x + 1))
    {
      size_t p = i + (size_t) x;
      int    n = c->fixed[p] ? 0 : find_held (c, x, y, held);

      if (c->fixed[p])
        g->diagonal[p] = 0;
      for (int k = 0; k < n; k++)
        g->diagonal[p] += held[k].weight;
      if (c->fixed[p] || (x + 1 < w && c->fixed[p + 1]))
        g->east[p] = 0;
      if (c->fixed[p] || (y + 1 < g->height && c->fixed[p + (size_t) w]))
        g->south[p] = 0;
      c->laplace->held_row[y + 1] += (size_t) n;
    }
}

static void
copy_strip (void *data, int strip)
{
  const Copy        *c = data;
  CeldWeightedGraph *g = c->graph;
  size_t             w = (size_t) g->width;
  int                end = (strip + 1) * CELD_STRIP < g->height ? (strip + 1) * CELD_STRIP : g->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      size_t i = (size_t) y * w;

      copy_weights (w, c->east + i, g->east + i);
      g->east[i + w - 1] = 0;
      if (y + 1 < g->height)
        copy_weights (w, c->south + i, g->south + i);
      else
        memset (g->south + i, 0, w * sizeof *g->south);
      if (c->diagonal)
        copy_weights (w, c->diagonal + i, g->diagonal + i);
      else
        memset (g->diagonal + i, 0, w * sizeof *g->diagonal);
      if (c->fixed)
        cut_row (c, y, c->mark + (size_t) strip * w);
      c->least[y] = UINT32_MAX;
      c->most[y]  = 0;
      measure_weights (w, (const CeldBits *) (g->east + i), &c->least[y], &c->most[y]);
      measure_weights (w, (const CeldBits *) (g->south + i), &c->least[y], &c->most[y]);
      measure_weights (w, (const CeldBits *) (g->diagonal + i), &c->least[y], &c->most[y]);
    }
}

/* Notes the edges between free and fixed pixels of a strip. */
static void
hold_strip (void *data, int strip)
{
  const Copy  *c = data;
  CeldLaplace *l = c->laplace;
  uint8_t     *mark = c->mark + (size_t) strip * (size_t) l->width;
  int          end = (strip + 1) * CELD_STRIP < l->height ? (strip + 1) * CELD_STRIP : l->height;

  for (int y = strip * CELD_STRIP; y < end; y++)
    {
      CeldDirichletLink *held = l->held + l->held_row[y];

      if (l->held_row[y] == l->held_row[y + 1])
        continue;
      mark_fixed (c, y, mark);
      for (int x = celd_next_marked (l->width, mark, 0); x < l->width; x = celd_next_marked (l->width, mark, x + 1))
        if (!c->fixed[(size_t) y * (size_t) l->width + (size_t) x])
          held += find_held (c, x, y, held);
    }
}

/* Do weights differ very much? */
static bool
differ (const Copy *c)
{
  uint32_t bits[2] = { UINT32_MAX, 0 };
  float    least, most;

  for (int y = 0; y < c->laplace->height; y++)
    {
      bits[0] = c->least[y] < bits[0] ? c->least[y] : bits[0];
      bits[1] = c->most[y] > bits[1] ? c->most[y] : bits[1];
    }
  bits[0]++;
  memcpy (&least, &bits[0], sizeof least);
  memcpy (&most, &bits[1], sizeof most);
  return bits[1] && least < WEAK * most;
}

CeldStatus
celd_system_read (const float *east, const float *south, const float *diagonal, const uint8_t *fixed,
                  const CeldHost *host, CeldLaplace *l, CeldWeightedGraph *g)
{
  size_t     w = (size_t) l->width, h = (size_t) l->height, n = w * h, strips = (h + CELD_STRIP - 1) / CELD_STRIP;
  Copy       c = { east, south, diagonal, fixed, l, g, celd_alloc (strips, w), celd_alloc (h, sizeof *c.least),
                   celd_alloc (h, sizeof *c.most) };
  CeldStatus status = CELD_NO_MEMORY;

  *g = (CeldWeightedGraph) { .width = l->width, .height = l->height, .east = celd_alloc (n, sizeof *g->east),
                       .south = celd_alloc (n, sizeof *g->south), .diagonal = celd_alloc (n, sizeof *g->diagonal) };
  l->held_row = celd_alloc0 (h + 1, sizeof *l->held_row);
  if (!c.mark || !c.least || !c.most || !g->east || !g->south || !g->diagonal || !l->held_row)
    goto done;
  celd_parallel_for (host, (int) strips, copy_strip, &c);
  for (size_t y = 0; y < h; y++)
    l->held_row[y + 1] += l->held_row[y];
  l->weak = g->weak = differ (&c);
  l->held = celd_alloc (l->held_row[h], sizeof *l->held);
  if (!l->held)
    goto done;
  celd_parallel_for (host, (int) strips, hold_strip, &c);
  status = CELD_OK;

done:
  celd_free (c.mark);
  celd_free (c.least);
  celd_free (c.most);
  return status;
}

/* ------------------------------------------------------------------ null space */

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
