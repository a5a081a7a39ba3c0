/* Where the strokes of an artist lie: how much of each falls on which piece of paper, and what of it is a stain.
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
#include "segment.h"

#include <stdlib.h>

#define LEAST_ODDS 0.5

static int
compare_shares (const void *a, const void *b)
{
  const CeldShare *p = a, *q = b;

  if (p->piece != q->piece)
    return p->piece < q->piece ? -1 : 1;
  if (p->label != q->label)
    return p->label < q->label ? -1 : 1;
  return p->stroke < q->stroke ? -1 : p->stroke > q->stroke;
}

/* Paint on paper as runs of pixels of one stroke and piece. */
static CeldStatus
gather_runs (const CeldCanvas *canvas, const CeldLabels *pieces, CeldSpread *spread)
{
  uint32_t piece = 0, stroke = 0;

  for (size_t p = 0; p < canvas->n; p++)
    {
      CeldShare *share;

      if (!canvas->seeds.data[p] || !pieces->data[p])
        continue;
      spread->total[spread->strokes.data[p]]++;
      if (spread->n && pieces->data[p] == piece && spread->strokes.data[p] == stroke)
        {
          spread->share[spread->n - 1].pixels++;
          continue;
        }
      share = celd_grow (spread->share, spread->n + 1, sizeof *share);
      if (!share)
        return CELD_NO_MEMORY;
      piece  = pieces->data[p];
      stroke = spread->strokes.data[p];
      spread->share = share;
      share[spread->n++] = (CeldShare) { piece, canvas->seeds.data[p], stroke, 1, false };
    }
  return CELD_OK;
}

/* Adds up the runs of the same stroke and piece. */
static void
add_up (CeldSpread *spread)
{
  size_t n = 0;

  if (spread->n)
    qsort (spread->share, spread->n, sizeof *spread->share, compare_shares);
  for (size_t i = 0; i < spread->n; i++)
    if (n && !compare_shares (&spread->share[n - 1], &spread->share[i]))
      spread->share[n - 1].pixels += spread->share[i].pixels;
    else
      spread->share[n++] = spread->share[i];
  spread->n = n;
}

void
celd_spread_clear (CeldSpread *spread)
{
  celd_free (spread->strokes.data);
  celd_free (spread->total);
  celd_free (spread->share);
  *spread = (CeldSpread) { 0 };
}

CeldStatus
celd_spread_new (const CeldCanvas *canvas, const CeldLabels *pieces, const CeldRun *run, CeldSpread *spread)
{
  CeldComponent *stroke = NULL;
  size_t         n = 0;
  CeldStatus     status;

  *spread = (CeldSpread) { 0 };
  status = celd_labels_new (canvas->width, canvas->height, &spread->strokes);
  if (status == CELD_OK)
    status = celd_components (&canvas->seeds, 0, true, run, &spread->strokes, &stroke, &n);
  if (status == CELD_OK)
    {
      spread->total = celd_alloc0 (n + 1, sizeof *spread->total);
      status = spread->total ? gather_runs (canvas, pieces, spread) : CELD_NO_MEMORY;
    }
  celd_free (stroke);
  if (status != CELD_OK)
    {
      celd_spread_clear (spread);
      return status;
    }
  add_up (spread);
  return CELD_OK;
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
is_stain (const CeldCanvas *canvas, const CeldSpread *spread, size_t p)
{
  CeldShare        key = { canvas->pieces.data[p], canvas->seeds.data[p], spread->strokes.data[p], 0, false };
  const CeldShare *share;

  if (!key.piece || !key.label)
    return false;
  share = bsearch (&key, spread->share, spread->n, sizeof key, compare_shares);
  return share && share->stain;
}

CeldStatus
celd_stains_remove (const CeldRun *run, CeldCanvas *canvas)
{
  CeldSpread spread;
  CeldStatus status;

  if (celd_canvas_obeys (canvas))
    return CELD_OK;
  status = celd_spread_new (canvas, &canvas->pieces, run, &spread);
  if (status != CELD_OK)
    return status;
  for (size_t i = 0, j; i < spread.n; i = j)
    {
      for (j = i; j < spread.n && spread.share[j].piece == spread.share[i].piece; j++)
        ;
      judge_piece (&spread, i, j);
    }
  for (size_t p = 0; p < canvas->n; p++)
    if (is_stain (canvas, &spread, p))
      canvas->seeds.data[p] = 0;
  celd_spread_clear (&spread);
  return CELD_OK;
}
