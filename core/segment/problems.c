/* What the artist should know of a segmentation: strokes overruled, regions that no stroke reaches, colours lost.
 *
 * All of it is told from the seeds, the basins and what was painted over them, without a look at most of the pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/painting.h"

#define SMALLEST_SHARE 2000 /* regions below 1/2000 of the picture are not worth a word */
#define SMALLEST_WIDTH 3    /* nor are those below the square of so many stroke widths */
#define SCRAP          8    /* nor 1/8 of a colour's paint, which another stroke has cut off */

/* How a connected stroke fared.  `other` is the label that most of its overruled pixels have, found by majority vote:
 * `lead` is how far it leads.  (x,y): the middle of the longest row of overruled pixels. */
typedef struct { uint32_t label, other; size_t area, overruled, lead; int longest, x, y; } Fate;

/* ------------------------------------------------------------------ strokes */

/* Pixels x .. end - 1 of row y, painted by a stroke, all have the label `other`. */
static void
overrule (Fate *fate, uint32_t other, int y, int x, int end)
{
  size_t n = (size_t) (end - x);

  fate->overruled += n;
  if (fate->other == other)
    fate->lead += n;
  else if (fate->lead >= n)
    fate->lead -= n;
  else
    {
      fate->lead  = n - fate->lead;
      fate->other = other;
    }
  if (end - x > fate->longest)
    {
      fate->longest = end - x;
      fate->x       = x + (end - x) / 2;
      fate->y       = y;
    }
}

static void
follow_pixels (const CeldDab *dab, const CeldLabels *labels, Fate *fate)
{
  const uint32_t *label = &CELD_AT (labels, 0, dab->y);

  for (int x = dab->x, end; x < dab->end; x = end)
    {
      for (end = x + 1; end < dab->end && label[end] == label[x]; end++)
        ;
      if (label[x] != dab->label)
        overrule (fate, label[x], dab->y, x, end);
    }
}

/* Where no patch lies over it, a dab has the label of its basin. */
static void
follow_strokes (const CeldSpread *spread, const CeldPainting *painting, const CeldLabels *labels, Fate *fate)
{
  const CeldPatch *patch = painting->patches.item, *last = patch ? patch + painting->patches.n : NULL;

  for (size_t i = 0; i < spread->n_dabs; i++)
    {
      const CeldDab *dab = &spread->dab[i];
      Fate          *f = &fate[dab->stroke];
      uint32_t       label = painting->label[dab->basin];

      while (patch < last && (patch->y < dab->y || (patch->y == dab->y && patch->end <= dab->x)))
        patch++;
      f->label = dab->label;
      f->area += (size_t) (dab->end - dab->x);
      if (!label || (patch < last && patch->y == dab->y && patch->x < dab->end))
        follow_pixels (dab, labels, f);
      else if (label != dab->label)
        overrule (f, label, dab->y, dab->x, dab->end);
    }
}

/* Seeds of arrows are nobody's strokes. */
static bool
is_painted (const CeldCanvas *canvas, uint32_t label)
{
  return label <= canvas->palette.n && canvas->palette.item[label - 1].origin != CELD_FROM_ARROW;
}

static CeldStatus
report_overruled (const CeldCanvas *canvas, const CeldSpread *spread, const CeldPainting *painting,
                  const CeldLabels *labels, CeldProblems *problems)
{
  Fate      *fate = celd_alloc0 (spread->n_strokes, sizeof *fate);
  CeldStatus status = fate ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    follow_strokes (spread, painting, labels, fate);
  for (size_t k = 0; k < spread->n_strokes && status == CELD_OK; k++)
    if (is_painted (canvas, fate[k].label) && 2 * fate[k].overruled > fate[k].area &&
        SCRAP * fate[k].area >= canvas->palette.item[fate[k].label - 1].seeds)
      status = celd_problem_add (problems, (CeldProblem) {
        CELD_PROBLEM_STROKE_OVERRULED, fate[k].x, fate[k].y, fate[k].label, fate[k].other, CELD_NO_INDEX });
  celd_free (fate);
  return status;
}

static CeldStatus
report_lost (const CeldCanvas *canvas, const CeldSeedRows *seeds, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;
  bool      *told = celd_alloc0 (canvas->palette.n + 1, sizeof *told);

  if (!told)
    return CELD_NO_MEMORY;
  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      {
        uint32_t l = seeds->row[y].run[i].label;

        if (l > canvas->palette.n || canvas->palette.item[l - 1].area || told[l])
          continue;
        told[l] = true;
        status  = celd_problem_add (problems, (CeldProblem) {
          CELD_PROBLEM_COLOUR_LOST, seeds->row[y].run[i].x, y, l, 0, CELD_NO_INDEX });
      }
  celd_free (told);
  return status;
}

/* ------------------------------------------------------------------ regions */

/* A closed piece of paper that may be worth a word.  `area`: of its basins, with ink; 0 if it is not.  `missing`: the
 * paper that is yet to be found to make it so.  `basin`: the roomiest, from 1. */
typedef struct { size_t area, missing, basin; } Piece;

static void
gather_pieces (const CeldBasins *b, Piece *piece)
{
  for (size_t k = 0; k < b->n; k++)
    {
      Piece *p = &piece[b->piece[k]];

      p->area += b->basin[k].area;
      if (!p->basin || b->basin[k].squared > b->basin[p->basin - 1].squared)
        p->basin = k + 1;
    }
}

/* Keeps pieces of a sensible size without a seed on them; returns how many.  Pieces, not rooms: a stroke reaches
 * through a gap. */
static size_t
choose_pieces (const CeldBasins *b, const CeldSpread *spread, Piece *piece)
{
  size_t side = (size_t) (SMALLEST_WIDTH * b->stroke), n = 0;
  size_t least = (size_t) b->width * (size_t) b->height / SMALLEST_SHARE + 1;

  least = least > side * side ? least : side * side;
  piece[0].area = 0;
  for (size_t i = 0; i < spread->n; i++)
    piece[spread->share[i].part].area = 0;
  for (size_t k = 1; k <= b->n_pieces; k++)
    if (piece[k].area >= least)
      {
        piece[k].missing = least;
        n++;
      }
    else
      piece[k].area = 0;
  return n;
}

/* Looks for the paper of `n` pieces until it is enough. */
static void
find_paper (const CeldBasins *b, size_t n, Piece *piece)
{
  for (int y = 0; y < b->height && n; y++)
    for (size_t i = b->row[y]; i < b->row[y + 1] && n; i++)
      {
        int    end = celd_basin_run_end (b, i, y);
        Piece *p = &piece[b->piece[b->run[i].basin]];
        size_t paper;

        if (!p->missing)
          continue;
        paper = celd_paper_count (b, y, b->run[i].x, end);
        p->missing -= paper < p->missing ? paper : p->missing;
        n -= !p->missing;
      }
}

static CeldStatus
report_unreached (const CeldCanvas *canvas, const CeldLabels *labels, CeldProblems *problems)
{
  const CeldBasins *b = canvas->basins;
  CeldSpread        spread = { 0 };
  Piece            *piece = celd_alloc0 (b->n_pieces + 1, sizeof *piece);
  CeldStatus        status = piece ? celd_spread_new (canvas, b->piece, &spread) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      gather_pieces (b, piece);
      find_paper (b, choose_pieces (b, &spread, piece), piece);
    }
  for (size_t k = 1; k <= b->n_pieces && status == CELD_OK; k++)
    if (piece[k].area && !piece[k].missing)
      {
        const CeldBasin *basin = &b->basin[piece[k].basin - 1];

        status = celd_problem_add (problems, (CeldProblem) {
          CELD_PROBLEM_REGION_UNREACHED, basin->x, basin->y, CELD_AT (labels, basin->x, basin->y), 0, CELD_NO_INDEX });
      }
  celd_spread_clear (&spread);
  celd_free (piece);
  return status;
}

CeldStatus
celd_segment_report (const CeldCanvas *canvas, const CeldSeedRows *seeds, const CeldPainting *painting,
                     const CeldLabels *labels, const CeldHost *host, CeldProblems *problems)
{
  bool       all = !canvas->settings->flats;
  CeldCanvas before = *canvas;
  CeldSpread own = { 0 };
  CeldStatus status = CELD_OK;

  before.seeds = *seeds;
  if (all && !canvas->painted.dab)
    status = celd_spread_new (&before, NULL, &own);
  if (all && status == CELD_OK)
    status = report_overruled (canvas, own.dab ? &own : &canvas->painted, painting, labels, problems);
  if (status == CELD_OK)
    status = report_lost (canvas, seeds, problems);
  if (all && status == CELD_OK)
    status = report_unreached (canvas, labels, problems);
  celd_spread_clear (&own);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
