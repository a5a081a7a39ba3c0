/* Where the artist's strokes lie: how much of each falls on which part of the drawing.
 *
 * Runs of seeds are cut where basins meet.  The cost of everything here is the number of these pieces, whatever the
 * size of the picture.  Finding the basins and the paper under a run takes longest, because it is scattered memory
 * access; so the pieces of the last solve are reused.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#include <stdlib.h>

/* ------------------------------------------------------------------ connected strokes */

/* Joins the runs of two rows that touch, also by a corner.  Runs are numbered from `first_above` and `first_below`. */
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

/* stroke[k] becomes the connected stroke of the k-th run in reading order; strokes are numbered from 0 in that order.
 */
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
    parent[k] = parent[k] == k ? (uint32_t) strokes++ : parent[parent[k]]; /* a parent comes first and has its number
                                                                            * already */
  *n_strokes = strokes;
  return CELD_OK;
}

/* ------------------------------------------------------------------ stroke pieces */

/* The pieces of the last solve of this drawing: the next one that may be reused. */
typedef struct { const CeldStrokePiece *piece, *end; } KnownPieces;

static const CeldStrokePiece *
take_known_piece (KnownPieces *known, int y, int x, int end)
{
  while (known->piece < known->end && (known->piece->y < y || (known->piece->y == y && known->piece->x < x)))
    known->piece++;
  return known->piece < known->end && known->piece->y == y && known->piece->x == x && known->piece->end <= end
         ? known->piece : NULL;
}

/* Adds a piece; a reused one may end before its basin does and is joined with the next. */
static CeldStatus
add_piece (CeldStrokePiece piece, bool first, CeldStrokes *strokes)
{
  CeldStrokePiece *last = strokes->n_pieces ? &strokes->piece[strokes->n_pieces - 1] : NULL;

  if (!first && last->basin == piece.basin)
    {
      last->end    = piece.end;
      last->paper += piece.paper;
      return CELD_OK;
    }
  return celd_append (strokes->piece, strokes->n_pieces, strokes->piece_capacity, piece);
}

static CeldStatus
cut_run (const CeldBasins *basins, int y, CeldSeedRun run, uint32_t stroke, KnownPieces *known, CeldStrokes *strokes)
{
  CeldStatus status = CELD_OK;

  for (int x = run.x, end; x < run.end && status == CELD_OK; x = end)
    {
      const CeldStrokePiece *same = take_known_piece (known, y, x, run.end);
      uint32_t               basin, paper;

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
      status = add_piece ((CeldStrokePiece) { y, x, end, run.label, basin, stroke, paper }, x == run.x, strokes);
    }
  return status;
}

static CeldStatus
gather_pieces (const CeldSegmentTask *task, CeldStrokes *strokes)
{
  const CeldSeedRows *seeds = &task->seeds;
  const CeldStrokes  *kept = task->kept;
  KnownPieces         known = { NULL, NULL };
  uint32_t           *stroke = NULL;
  size_t              k = 0;
  CeldStatus          status = find_strokes (seeds, &stroke, &strokes->n_strokes);

  if (kept && kept->n_pieces)
    known = (KnownPieces) { kept->piece, kept->piece + kept->n_pieces };
  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      status = cut_run (task->basins, y, seeds->row[y].run[i], stroke[k++], &known, strokes);
  celd_free (stroke);
  return status;
}

/* ------------------------------------------------------------------ overlaps */

int
celd_stroke_overlap_compare (const void *a, const void *b)
{
  const CeldStrokeOverlap *p = a, *q = b;

  if (p->part != q->part)
    return p->part < q->part ? -1 : 1;
  if (p->label != q->label)
    return p->label < q->label ? -1 : 1;
  return p->stroke < q->stroke ? -1 : p->stroke > q->stroke;
}

/* Sorts the pieces by parts: sorted[from[k]] to sorted[from[k + 1] - 1] are those with paper in part k. */
static void
sort_pieces (const CeldStrokes *strokes, const uint32_t *part, uint32_t n_parts, size_t *from, size_t *sorted)
{
  for (size_t i = 0; i < strokes->n_pieces; i++)
    from[part[strokes->piece[i].basin]] += strokes->piece[i].paper > 0;
  for (uint32_t k = 1; k <= n_parts + 1; k++)
    from[k] += from[k - 1];
  for (size_t i = strokes->n_pieces; i-- > 0;)
    if (strokes->piece[i].paper)
      sorted[--from[part[strokes->piece[i].basin]]] = i;
}

/* Sums up the pieces of one part by stroke. in_part[stroke] is 0 for all strokes before and after. */
static CeldStatus
add_part (uint32_t part, const size_t *sorted, size_t n, size_t *in_part, CeldStrokes *strokes)
{
  size_t first = strokes->n;

  for (size_t i = 0; i < n; i++)
    {
      const CeldStrokePiece *piece = &strokes->piece[sorted[i]];

      if (!in_part[piece->stroke])
        {
          if (celd_append (strokes->overlap, strokes->n, strokes->overlap_capacity,
                           (CeldStrokeOverlap) { part, piece->label, piece->stroke, 0, 0, false }) != CELD_OK)
            return CELD_NO_MEMORY;
        }
      in_part[piece->stroke] += piece->paper;
    }
  for (size_t i = first; i < strokes->n; i++)
    {
      strokes->overlap[i].pixels = in_part[strokes->overlap[i].stroke];
      in_part[strokes->overlap[i].stroke] = 0;
    }
  if (strokes->n > first + 1)
    qsort (strokes->overlap + first, strokes->n - first, sizeof *strokes->overlap, celd_stroke_overlap_compare);
  return CELD_OK;
}

CeldStatus
celd_strokes_overlap (const CeldBasins *basins, const uint32_t *part, CeldStrokes *strokes)
{
  uint32_t   n_parts = 0;
  size_t    *sorted = celd_alloc (strokes->n_pieces, sizeof *sorted), *from = NULL, *in_part = NULL;
  CeldStatus status = CELD_NO_MEMORY;

  for (size_t k = 0; k < basins->n; k++)
    n_parts = part[k] > n_parts ? part[k] : n_parts;
  from    = celd_alloc0 ((size_t) n_parts + 2, sizeof *from);
  in_part = celd_alloc0 (strokes->n_strokes, sizeof *in_part);
  strokes->n = 0;
  if (sorted && from && in_part)
    {
      status = CELD_OK;
      sort_pieces (strokes, part, n_parts, from, sorted);
    }
  for (uint32_t k = 1; k <= n_parts && status == CELD_OK; k++)
    status = add_part (k, sorted + from[k], from[k + 1] - from[k], in_part, strokes);
  celd_free (sorted);
  celd_free (from);
  celd_free (in_part);
  return status;
}

void
celd_strokes_clear (CeldStrokes *strokes)
{
  celd_free (strokes->piece);
  celd_free (strokes->total);
  celd_free (strokes->in_cores);
  celd_free (strokes->overlap);
  *strokes = (CeldStrokes) { 0 };
}

void
celd_strokes_sum (const CeldBasins *basins, CeldStrokes *strokes)
{
  for (size_t k = 0; k < strokes->n_strokes; k++)
    strokes->total[k] = strokes->in_cores[k] = 0;
  for (size_t i = 0; i < strokes->n_pieces; i++)
    {
      const CeldStrokePiece *piece = &strokes->piece[i];

      strokes->total[piece->stroke] += piece->paper;
      if (basins->basin[piece->basin].solid)
        strokes->in_cores[piece->stroke] += (size_t) (piece->end - piece->x) - piece->paper;
    }
}

CeldStatus
celd_strokes_new (const CeldSegmentTask *task, const uint32_t *part, CeldStrokes *strokes)
{
  CeldStrokes made = { 0 };
  CeldStatus  status = gather_pieces (task, &made);

  if (status == CELD_OK)
    {
      made.total    = celd_alloc (made.n_strokes, sizeof *made.total);
      made.in_cores = celd_alloc (made.n_strokes, sizeof *made.in_cores);
      status = made.total && made.in_cores ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK && part)
    status = celd_strokes_overlap (task->basins, part, &made);
  if (status != CELD_OK)
    {
      celd_strokes_clear (&made);
      return status;
    }
  celd_strokes_sum (task->basins, &made);
  *strokes = made;
  return CELD_OK;
}

void
celd_strokes_keep (const CeldSegmentTask *task, CeldStrokes *strokes)
{
  if (task->kept)
    {
      celd_strokes_clear (task->kept);
      *task->kept = *strokes;
      *strokes = (CeldStrokes) { 0 };
    }
  celd_strokes_clear (strokes);
}
