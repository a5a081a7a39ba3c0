/* Where the strokes of an artist lie: how much of each falls on which part of the drawing, and what of it is a stain.
 *
 * Runs of seeds are cut where basins meet; that makes dabs, and their number is what all of this costs, whatever the
 * size of the picture.  To look for basins and paper under a run takes longest, as it is somewhere else in memory for
 * each; so what was found for the last answer is taken over.
 *
 * A soft stroke may run on through a contour.  The paint behind it says nothing about the region there, but it would
 * outvote the cost of cutting that region at a narrow place.  So a stroke's share of a piece of paper is weighed by the
 * odds that the stroke is meant for the piece: what the stroke leaves there to what it leaves elsewhere, times the
 * paint of its colour there to that of others.  Below one half the share is a stain and does not count.  Where right
 * paint outweighs foreign paint 3:1 this finds every stain of a stroke that keeps 2/5 of its paint out of the piece,
 * and a colour alone in its piece, or a stroke within one piece, never is one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"

#include <stdlib.h>

#define LEAST_ODDS 0.5

/* ------------------------------------------------------------------ connected strokes */

/* Joins the runs of two rows, numbered from `first_above` and `first_below`, that touch, be it by a corner. */
static void
join_rows (const CeldSeedRow *above, uint32_t first_above, const CeldSeedRow *below, uint32_t first_below,
           uint32_t *parent)
{
  size_t start = 0;

  for (size_t j = 0; j < below->n; j++)
    {
      const CeldSeedRun *run = &below->run[j];

      while (start < above->n && above->run[start].end < run->x)
        start++;
      for (size_t i = start; i < above->n && above->run[i].x <= run->end; i++)
        if (above->run[i].label == run->label)
          celd_join (parent, first_above + (uint32_t) i, first_below + (uint32_t) j);
    }
}

/* stroke[k]: the connected stroke that the k-th run in reading order belongs to, from 0 in reading order too. */
static CeldStatus
find_strokes (const CeldSeedRows *seeds, uint32_t **stroke, size_t *n_strokes)
{
  size_t    n = 0, strokes = 0;
  uint32_t *parent, above = 0, below = 0;

  for (int y = 0; y < seeds->height; y++)
    n += seeds->row[y].n;
  *stroke = parent = celd_alloc (n, sizeof *parent);
  if (!parent)
    return CELD_NO_MEMORY;
  celd_roots (parent, n);
  for (int y = 1; y < seeds->height; y++)
    {
      above  = below;
      below += (uint32_t) seeds->row[y - 1].n;
      join_rows (&seeds->row[y - 1], above, &seeds->row[y], below, parent);
    }
  for (uint32_t k = 0; k < n; k++)
    parent[k] = parent[k] == k ? (uint32_t) strokes++ : parent[parent[k]]; /* a parent has its number already */
  *n_strokes = strokes;
  return CELD_OK;
}

/* ------------------------------------------------------------------ dabs */

/* Dabs of the same drawing, gathered before: the next one in reading order that may be taken over. */
typedef struct { const CeldDab *dab, *end; } Known;

static const CeldDab *
take_known (Known *known, int y, int x, int end)
{
  while (known->dab < known->end && (known->dab->y < y || (known->dab->y == y && known->dab->x < x)))
    known->dab++;
  return known->dab < known->end && known->dab->y == y && known->dab->x == x && known->dab->end <= end
         ? known->dab : NULL;
}

/* Adds what pixels x .. end - 1 are in one basin; a known dab may end before its basin does. */
static CeldStatus
add_dab (CeldDab dab, bool first, CeldSpread *spread)
{
  CeldDab *last = spread->n_dabs ? &spread->dab[spread->n_dabs - 1] : NULL;

  if (!first && last->basin == dab.basin)
    {
      last->end    = dab.end;
      last->paper += dab.paper;
      return CELD_OK;
    }
  last = celd_grow (spread->dab, spread->n_dabs + 1, sizeof *last);
  if (!last)
    return CELD_NO_MEMORY;
  spread->dab = last;
  last[spread->n_dabs++] = dab;
  return CELD_OK;
}

static CeldStatus
cut_run (const CeldBasins *basins, int y, CeldSeedRun run, uint32_t stroke, Known *known, CeldSpread *spread)
{
  CeldStatus status = CELD_OK;

  for (int x = run.x, end; x < run.end && status == CELD_OK; x = end)
    {
      const CeldDab *same = take_known (known, y, x, run.end);
      uint32_t       basin, paper;

      if (same)
        {
          end   = same->end;
          basin = same->basin;
          paper = same->paper;
        }
      else
        {
          size_t k = celd_basin_run (basins, x, y);

          end   = celd_basin_run_end (basins, k, y);
          end   = end < run.end ? end : run.end;
          basin = basins->run[k].basin;
          paper = celd_paper_count (basins, y, x, end);
        }
      status = add_dab ((CeldDab) { y, x, end, run.label, basin, stroke, paper }, x == run.x, spread);
    }
  return status;
}

static CeldStatus
gather_dabs (const CeldCanvas *canvas, CeldSpread *spread)
{
  const CeldSeedRows *seeds = &canvas->seeds;
  const CeldSpread   *kept = canvas->kept;
  Known               known = { NULL, NULL };
  uint32_t           *stroke = NULL;
  size_t              k = 0;
  CeldStatus          status = find_strokes (seeds, &stroke, &spread->n_strokes);

  if (kept && kept->n_dabs)
    known = (Known) { kept->dab, kept->dab + kept->n_dabs };
  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      status = cut_run (canvas->basins, y, seeds->row[y].run[i], stroke[k++], &known, spread);
  celd_free (stroke);
  return status;
}

/* ------------------------------------------------------------------ shares */

static int
compare_shares (const void *a, const void *b)
{
  const CeldShare *p = a, *q = b;

  if (p->part != q->part)
    return p->part < q->part ? -1 : 1;
  if (p->label != q->label)
    return p->label < q->label ? -1 : 1;
  return p->stroke < q->stroke ? -1 : p->stroke > q->stroke;
}

/* sorted[from[k]] to sorted[from[k + 1] - 1]: the dabs with paper in part k, for k up to n_parts. */
static void
sort_dabs (const CeldSpread *spread, const uint32_t *part, uint32_t n_parts, size_t *from, size_t *sorted)
{
  for (size_t i = 0; i < spread->n_dabs; i++)
    from[part[spread->dab[i].basin]] += spread->dab[i].paper > 0;
  for (uint32_t k = 1; k <= n_parts + 1; k++)
    from[k] += from[k - 1];
  for (size_t i = spread->n_dabs; i-- > 0;)
    if (spread->dab[i].paper)
      sorted[--from[part[spread->dab[i].basin]]] = i;
}

/* Adds up the dabs of one part by stroke.  in_part[stroke] is all 0, before and after. */
static CeldStatus
add_part (uint32_t part, const size_t *sorted, size_t n, size_t *in_part, CeldSpread *spread)
{
  size_t first = spread->n;

  for (size_t i = 0; i < n; i++)
    {
      const CeldDab *dab = &spread->dab[sorted[i]];

      if (!in_part[dab->stroke])
        {
          CeldShare *share = celd_grow (spread->share, spread->n + 1, sizeof *share);

          if (!share)
            return CELD_NO_MEMORY;
          spread->share = share;
          share[spread->n++] = (CeldShare) { part, dab->label, dab->stroke, 0, false };
        }
      in_part[dab->stroke] += dab->paper;
    }
  for (size_t i = first; i < spread->n; i++)
    {
      spread->share[i].pixels = in_part[spread->share[i].stroke];
      in_part[spread->share[i].stroke] = 0;
    }
  if (spread->n > first + 1)
    qsort (spread->share + first, spread->n - first, sizeof *spread->share, compare_shares);
  return CELD_OK;
}

CeldStatus
celd_spread_share (const CeldBasins *basins, const uint32_t *part, CeldSpread *spread)
{
  uint32_t   n_parts = 0;
  size_t    *sorted = celd_alloc (spread->n_dabs, sizeof *sorted), *from = NULL, *in_part = NULL;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t k = 0; k < basins->n; k++)
    n_parts = part[k] > n_parts ? part[k] : n_parts;
  from    = celd_alloc0 ((size_t) n_parts + 2, sizeof *from);
  in_part = celd_alloc0 (spread->n_strokes, sizeof *in_part);
  spread->n = 0;
  if (sorted && from && in_part)
    {
      status = CELD_OK;
      sort_dabs (spread, part, n_parts, from, sorted);
    }
  for (uint32_t k = 1; k <= n_parts && status == CELD_OK; k++)
    status = add_part (k, sorted + from[k], from[k + 1] - from[k], in_part, spread);
  celd_free (sorted);
  celd_free (from);
  celd_free (in_part);
  return status;
}

void
celd_spread_clear (CeldSpread *spread)
{
  celd_free (spread->dab);
  celd_free (spread->total);
  celd_free (spread->share);
  *spread = (CeldSpread) { 0 };
}

CeldStatus
celd_spread_new (const CeldCanvas *canvas, const uint32_t *part, CeldSpread *spread)
{
  CeldSpread made = { 0 };
  CeldStatus status = gather_dabs (canvas, &made);

  if (status == CELD_OK)
    {
      made.total = celd_alloc0 (made.n_strokes, sizeof *made.total);
      status = made.total ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK && part)
    status = celd_spread_share (canvas->basins, part, &made);
  if (status != CELD_OK)
    {
      celd_spread_clear (&made);
      return status;
    }
  for (size_t i = 0; i < made.n_dabs; i++)
    made.total[made.dab[i].stroke] += made.dab[i].paper;
  *spread = made;
  return CELD_OK;
}

void
celd_spread_keep (const CeldCanvas *canvas, CeldSpread *spread)
{
  if (canvas->kept)
    {
      celd_spread_clear (canvas->kept);
      *canvas->kept = *spread;
      *spread = (CeldSpread) { 0 };
    }
  celd_spread_clear (spread);
}

/* ------------------------------------------------------------------ stains */

/* Marks the stains among the shares of one piece: those from share[first] to share[last - 1]. */
static void
judge_piece (CeldSpread *spread, size_t first, size_t last)
{
  double all = 0;

  for (size_t i = first; i < last; i++)
    all += (double) spread->share[i].pixels;
  for (size_t i = first, j; i < last; i = j)
    {
      double mine = 0;

      for (j = i; j < last && spread->share[j].label == spread->share[i].label; j++)
        mine += (double) spread->share[j].pixels;
      for (size_t k = i; k < j; k++)
        {
          double here = (double) spread->share[k].pixels;
          double elsewhere = (double) spread->total[spread->share[k].stroke] - here;

          spread->share[k].stain = here * mine < LEAST_ODDS * elsewhere * (all - mine);
        }
    }
}

static bool
is_stain (const CeldSpread *spread, uint32_t piece, const CeldDab *dab)
{
  CeldShare        key = { piece, dab->label, dab->stroke, 0, false };
  const CeldShare *share = bsearch (&key, spread->share, spread->n, sizeof key, compare_shares);

  return share && share->stain;
}

CeldStatus
celd_dab_remove (CeldCanvas *canvas, const CeldDab *dab)
{
  const float *ink = &CELD_AT (canvas->ink, 0, dab->y);
  CeldStatus   status = CELD_OK;

  for (int x = dab->x, end; x < dab->end && status == CELD_OK; x = end)
    {
      bool paper = celd_is_paper (ink[x]);

      for (end = x + 1; end < dab->end && celd_is_paper (ink[end]) == paper; end++)
        ;
      if (paper)
        status = celd_seed_rows_paint (&canvas->seeds, dab->y, x, end, 0);
    }
  return status;
}

CeldStatus
celd_stains_remove (const CeldHost *host, CeldCanvas *canvas)
{
  const uint32_t *piece = canvas->cell ? canvas->cell : canvas->basins->piece;
  CeldSpread     *spread = &canvas->painted;
  bool           *stained;
  CeldStatus      status = celd_spread_new (canvas, piece, spread);

  if (status != CELD_OK || celd_canvas_obeys (canvas))
    return status;
  for (size_t i = 0, j; i < spread->n; i = j)
    {
      for (j = i; j < spread->n && spread->share[j].part == spread->share[i].part; j++)
        ;
      judge_piece (spread, i, j);
    }
  stained = celd_alloc0 (spread->n_strokes, sizeof *stained); /* most strokes leave none: no need to look at dabs */
  status  = stained ? CELD_OK : CELD_NO_MEMORY;
  for (size_t i = 0; i < spread->n && status == CELD_OK; i++)
    stained[spread->share[i].stroke] |= spread->share[i].stain;
  for (size_t i = 0; i < spread->n_dabs && status == CELD_OK; i++)
    if (stained[spread->dab[i].stroke] && is_stain (spread, piece[spread->dab[i].basin], &spread->dab[i]))
      {
        canvas->stained = true;
        status = celd_dab_remove (canvas, &spread->dab[i]);
      }
  celd_free (stained);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
