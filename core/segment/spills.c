/* Spills: paint that ran on through a contour, and is not meant for what lies behind.
 *
 * A spill says nothing about the region behind the contour, but would outweigh the cost of cutting that region at a
 * narrow place.  So the overlap of a stroke with a component is weighed by the odds that the stroke is meant for it:
 * the stroke's pixels there to those elsewhere, times the pixels of its label there to those of others.  Below
 * LEAST_ODDS, or LESSER_ODDS where other paint outweighs the label's, the overlap is a spill and is ignored; then what
 * is left is weighed again, because spills speak for no label.  If correct paint outweighs foreign paint 3:1, this
 * finds every spill of a stroke that has a quarter of its paint outside the component; a label alone in its component,
 * a stroke within one component, or where a stroke is most likely meant, is never a spill.  What other paint cut off a
 * stroke is weighed as part of it.
 *
 * Hardly anybody paints a bold outline, so that no other paint tells that a stroke ran on into one.  A stroke is meant
 * for solid areas, such as a black wing, only if a third of it lies in their cores.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#include <math.h>
#include <stdlib.h>

#define LEAST_ODDS  0.5 /* of being meant, below which an overlap is a spill, ... */
#define LESSER_ODDS 1   /* ... and where other labels have more paint (both chosen) */
#define CORE_SHARE  0.5 /* pixels in cores of solid areas to one on paper, at least; chosen */

/* ------------------------------------------------------------------ removal */

/* Removes the seeds of a stroke piece that lie on paper, or else those on ink. */
static CeldStatus
remove_pixels (CeldSegmentTask *task, const CeldStrokePiece *piece, bool on_paper)
{
  const float *ink = &CELD_AT (task->ink, 0, piece->y);
  CeldStatus   status = CELD_OK;

  for (int x = piece->x, end; x < piece->end && status == CELD_OK; x = end)
    {
      bool paper = celd_is_paper (ink[x]);

      for (end = x + 1; end < piece->end && celd_is_paper (ink[end]) == paper; end++)
        ;
      if (paper == on_paper)
        status = celd_seed_rows_paint (&task->seeds, piece->y, x, end, 0);
    }
  return status;
}

CeldStatus
celd_stroke_piece_remove (CeldSegmentTask *task, const CeldStrokePiece *piece)
{
  return remove_pixels (task, piece, true);
}

/* ------------------------------------------------------------------ behind a contour */

/* Pixels of paint that is no spill, in the overlaps first .. last - 1. */
static double
paint_in (const CeldStrokes *strokes, size_t first, size_t last)
{
  double pixels = 0;

  for (size_t i = first; i < last; i++)
    pixels += strokes->overlap[i].spill ? 0 : (double) strokes->overlap[i].pixels;
  return pixels;
}

/* Finds the odds of the overlaps first .. last - 1, which are those of one component. */
static void
find_odds (CeldStrokes *strokes, size_t first, size_t last)
{
  double all = paint_in (strokes, first, last);

  for (size_t i = first, j; i < last; i = j)
    {
      double mine, least;

      for (j = i; j < last && strokes->overlap[j].label == strokes->overlap[i].label; j++)
        ;
      mine  = paint_in (strokes, i, j);
      least = mine < all - mine ? LESSER_ODDS : LEAST_ODDS;
      for (size_t k = i; k < j; k++)
        {
          CeldStrokeOverlap *o = &strokes->overlap[k];
          double             here = (double) o->pixels, elsewhere = (double) strokes->total[o->stroke] - here;
          double             against = elsewhere * (all - mine) * least;

          o->odds = against > 0 ? here * mine / against : INFINITY;
        }
    }
}

/* Marks the spills that show when those marked already do not count; whether there are any. has_spill[k]: stroke k has
 * one.  `best` is work space: what each stroke's odds are where it is most likely meant. */
static bool
mark_spills (CeldStrokes *strokes, double *best, bool *has_spill)
{
  bool any = false;

  for (size_t i = 0, j; i < strokes->n; i = j)
    {
      for (j = i; j < strokes->n && strokes->overlap[j].part == strokes->overlap[i].part; j++)
        ;
      find_odds (strokes, i, j);
    }
  for (size_t k = 0; k < strokes->n_strokes; k++)
    best[k] = 0;
  for (size_t i = 0; i < strokes->n; i++)
    if (!strokes->overlap[i].spill)
      best[strokes->overlap[i].stroke] = fmax (best[strokes->overlap[i].stroke], strokes->overlap[i].odds);
  for (size_t i = 0; i < strokes->n; i++)
    {
      CeldStrokeOverlap *o = &strokes->overlap[i];

      if (!o->spill && o->odds < 1 && o->odds < best[o->stroke])
        o->spill = has_spill[o->stroke] = any = true;
    }
  return any;
}

/* ------------------------------------------------------------------ the whole */

static bool
is_in_core (const CeldSegmentTask *task, const CeldStrokePiece *piece)
{
  return task->basins->basin[piece->basin].solid;
}

/* Did a stroke run on into a solid area that it is not meant for? */
static bool
ran_into_core (const CeldStrokes *strokes, size_t stroke)
{
  return (double) strokes->in_cores[stroke] < CORE_SHARE * (double) strokes->total[stroke];
}

bool
celd_stroke_piece_is_spill (const CeldSegmentTask *task, const CeldStrokePiece *piece)
{
  CeldStrokeOverlap        key = { task->basins->component[piece->basin], piece->label, piece->stroke, 0, 0, false };
  const CeldStrokeOverlap *overlap;

  if (is_in_core (task, piece))
    return ran_into_core (&task->painted, piece->stroke);
  overlap = bsearch (&key, task->painted.overlap, task->painted.n, sizeof key, celd_stroke_overlap_compare);
  return overlap && overlap->spill;
}

/* Finds the spills of all strokes and removes their seeds. */
static CeldStatus
remove_spills (CeldSegmentTask *task)
{
  CeldStrokes *strokes = &task->painted;
  double      *best = celd_alloc (strokes->n_strokes, sizeof *best);
  bool        *has_spill = celd_alloc0 (strokes->n_strokes, sizeof *has_spill); /* few have: no others are looked up */
  CeldStatus   status = best && has_spill ? CELD_OK : CELD_NO_MEMORY;

  while (status == CELD_OK && mark_spills (strokes, best, has_spill))
    ;
  for (size_t i = 0; i < strokes->n_pieces && status == CELD_OK; i++)
    {
      const CeldStrokePiece *piece = &strokes->piece[i];
      bool                   in_core = is_in_core (task, piece);

      if ((in_core || has_spill[piece->stroke]) && celd_stroke_piece_is_spill (task, piece))
        {
          task->spilled = true;
          status = remove_pixels (task, piece, !in_core);
        }
    }
  celd_free (best);
  celd_free (has_spill);
  return status;
}

CeldStatus
celd_spills_remove (const CeldHost *host, CeldSegmentTask *task)
{
  CeldStatus status = celd_strokes_new (task, NULL, &task->painted);
  bool       soft = !celd_task_all_hard (task);

  if (status == CELD_OK && soft)
    status = celd_strokes_join_severed (task, &task->painted);
  if (status == CELD_OK)
    status = celd_strokes_overlap (task->basins, task->basins->component, &task->painted);
  if (status == CELD_OK && soft)
    status = remove_spills (task);
  return status == CELD_OK && soft ? celd_progress (host, 1) : status;
}
