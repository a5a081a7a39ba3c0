/* What the artist should know about a segmentation: strokes overruled, regions that no stroke reaches, labels that got
 * no pixel.
 *
 * All of it follows from the seeds, the basins and the labelling; hardly any pixels are read.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"

#define SMALLEST_SHARE     2000 /* regions below 1/2000 of the picture are not reported (chosen) */
#define SMALLEST_WIDTH     3    /* nor those below the square of so many stroke widths, */
#define LARGE_SHARE        1000 /* unless they are 1/1000 of the picture */
#define SMALLEST_AREA      9    /* pixels: smaller ones are specks on any page (chosen) */
#define LEAST_STROKE_SHARE 8    /* nor strokes below 1/8 of a label's paint, which another stroke may have cut off, ... */
#define LONG_STROKE        5    /* ... unless they are so many brush widths long (both chosen) */

/* The outcome of a connected stroke.  `other` is the label that most of its overruled pixels have, found by majority
 * vote with the margin `lead`. (x,y): the middle of the longest run of overruled pixels. */
typedef struct { uint32_t label, other; size_t area, overruled, lead; int longest, x, y; } StrokeOutcome;

/* ------------------------------------------------------------------ strokes */

/* Counts pixels x .. end - 1 of row y, painted by a stroke but labelled `other`. */
static void
count_overruled (StrokeOutcome *outcome, uint32_t other, int y, int x, int end)
{
  size_t n = (size_t) (end - x);

  outcome->overruled += n;
  if (outcome->other == other)
    outcome->lead += n;
  else if (outcome->lead >= n)
    outcome->lead -= n;
  else
    {
      outcome->lead  = n - outcome->lead;
      outcome->other = other;
    }
  if (end - x > outcome->longest)
    {
      outcome->longest = end - x;
      outcome->x       = x + (end - x) / 2;
      outcome->y       = y;
    }
}

static void
follow_pixels (const CeldStrokePiece *piece, const CeldLabels *labels, StrokeOutcome *outcome)
{
  const uint32_t *label = &CELD_AT (labels, 0, piece->y);

  for (int x = piece->x, end; x < piece->end; x = end)
    {
      for (end = x + 1; end < piece->end && label[end] == label[x]; end++)
        ;
      if (label[x] != piece->label)
        count_overruled (outcome, label[x], piece->y, x, end);
    }
}

/* A piece has the label of its basin, unless a patch lies over it.  Spills are not meant to have any. */
static void
follow_strokes (const CeldSegmentTask *task, const CeldStrokes *strokes, const CeldLabelling *labelling,
                const CeldLabels *labels, StrokeOutcome *outcome)
{
  const CeldPatch *patch = labelling->patches.item, *last = patch ? patch + labelling->patches.n : NULL;

  for (size_t i = 0; i < strokes->n_pieces; i++)
    {
      const CeldStrokePiece *piece = &strokes->piece[i];
      StrokeOutcome         *f = &outcome[piece->stroke];
      uint32_t               label = labelling->label[piece->basin];

      while (patch < last && (patch->y < piece->y || (patch->y == piece->y && patch->end <= piece->x)))
        patch++;
      f->label = piece->label;
      if (task->spilled && celd_stroke_piece_is_spill (task, piece))
        continue;
      f->area += (size_t) (piece->end - piece->x);
      if (!label || (patch < last && patch->y == piece->y && patch->x < piece->end))
        follow_pixels (piece, labels, f);
      else if (label != piece->label)
        count_overruled (f, label, piece->y, piece->x, piece->end);
    }
}

/* Is this the label of a stroke, rather than of an arrow? */
static bool
is_painted (const CeldSegmentTask *task, uint32_t label)
{
  return label <= task->palette.n && task->palette.item[label - 1].origin != CELD_FROM_ARROW;
}

static CeldStatus
report_overruled (const CeldSegmentTask *task, const CeldStrokes *strokes, const CeldLabelling *labelling,
                  const CeldLabels *labels, CeldProblems *problems)
{
  StrokeOutcome *outcome = celd_alloc0 (strokes->n_strokes, sizeof *outcome);
  CeldStatus     status = outcome ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK)
    follow_strokes (task, strokes, labelling, labels, outcome);
  for (size_t k = 0; k < strokes->n_strokes && status == CELD_OK; k++)
    if (is_painted (task, outcome[k].label) && 2 * outcome[k].overruled > outcome[k].area &&
        (LEAST_STROKE_SHARE * outcome[k].area >= task->palette.item[outcome[k].label - 1].seeds ||
         (double) outcome[k].area >= LONG_STROKE * task->brush * task->brush))
      status = celd_problem_add (problems, (CeldProblem) {
        .kind = CELD_PROBLEM_STROKE_OVERRULED, .x = outcome[k].x, .y = outcome[k].y, .label = outcome[k].label,
        .other = outcome[k].other, .relation = CELD_NO_INDEX });
  celd_free (outcome);
  return status;
}

/* Sets `outline` of the labels that are painted on ink only: in a flat colouring with lines, the colours of lines. */
static void
find_outlines (const CeldSegmentTask *task, const CeldSeedRows *seeds, bool *outline)
{
  for (uint32_t l = 1; l <= task->palette.n; l++)
    outline[l] = true;
  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n; i++)
      {
        const CeldSeedRun *run = &seeds->row[y].run[i];

        for (int x = run->x; x < run->end && run->label <= task->palette.n && outline[run->label]; x++)
          outline[run->label] = !celd_is_paper (CELD_AT (task->ink, x, y));
      }
}

static CeldStatus
report_lost (const CeldSegmentTask *task, const CeldSeedRows *seeds, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;
  bool      *reported = celd_alloc0 (task->palette.n + 1, sizeof *reported);

  if (!reported)
    return CELD_NO_MEMORY;
  if (task->settings->flats)
    find_outlines (task, seeds, reported);
  for (int y = 0; y < seeds->height; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      {
        uint32_t l = seeds->row[y].run[i].label;

        if (l > task->palette.n || task->palette.item[l - 1].area || reported[l])
          continue;
        reported[l] = true;
        status  = celd_problem_add (problems, (CeldProblem) {
          .kind = CELD_PROBLEM_COLOUR_LOST, .x = seeds->row[y].run[i].x, .y = y, .label = l,
          .relation = CELD_NO_INDEX });
      }
  celd_free (reported);
  return status;
}

/* ------------------------------------------------------------------ regions */

/* A part of the paper that nobody painted.  `area`: of its basins, ink included; 0: not worth reporting.  `missing`:
 * paper still to be found for it to be.  `basin`: the basin farthest from ink, from 1. */
typedef struct { size_t area, missing, basin; } PaperPart;

/* The parts that count: connected paper, with gaps closed by bridges, as a stroke reaches through a narrow neck. */
static const uint32_t *
parts_of (const CeldSegmentTask *task)
{
  return task->bridged_component ? task->bridged_component : task->basins->component;
}

static void
gather_parts (const CeldBasins *b, const uint32_t *part_of, PaperPart *part)
{
  for (size_t k = 0; k < b->n; k++)
    {
      PaperPart *p = &part[part_of[k]];

      p->area += b->basin[k].area;
      if (!p->basin || b->basin[k].squared > b->basin[p->basin - 1].squared)
        p->basin = k + 1;
    }
}

/* Drops the parts with seeds, but for those that a painted background got along the frame. */
static void
drop_reached (const CeldSegmentTask *task, const CeldStrokes *strokes, const uint32_t *part_of, PaperPart *part)
{
  for (size_t i = 0; i < strokes->n_pieces; i++)
    {
      const CeldStrokePiece *piece = &strokes->piece[i];

      if (piece->paper && !(task->unpainted && task->unpainted[task->basins->enclosure[piece->basin]]))
        part[part_of[piece->basin]].area = 0;
    }
}

/* Selects parts of sufficient size, and returns their number. */
static size_t
choose_parts (const CeldBasins *b, PaperPart *part, size_t n_parts)
{
  size_t side = (size_t) (SMALLEST_WIDTH * b->stroke), page = (size_t) b->width * (size_t) b->height, n = 0;
  size_t least = page / SMALLEST_SHARE + 1, large = page / LARGE_SHARE + 1;

  least = least > side * side ? least : side * side;
  least = least < large ? least : large;
  least = least > SMALLEST_AREA ? least : SMALLEST_AREA;
  part[0].area = 0;
  for (size_t k = 1; k <= n_parts; k++)
    if (part[k].area >= least)
      {
        part[k].missing = least;
        n++;
      }
    else
      part[k].area = 0;
  return n;
}

/* Counts the paper of n parts until each has enough. */
static void
find_paper (const CeldBasins *b, const uint32_t *part_of, size_t n, PaperPart *part)
{
  for (int y = 0; y < b->height && n; y++)
    for (size_t i = b->row[y]; i < b->row[y + 1] && n; i++)
      {
        int        end = celd_basin_run_end (b, i, y);
        PaperPart *p = &part[part_of[b->run[i].basin]];
        size_t     paper;

        if (!p->missing)
          continue;
        paper = celd_paper_count (b, y, b->run[i].x, end);
        p->missing -= paper < p->missing ? paper : p->missing;
        n -= !p->missing;
      }
}

static CeldStatus
report_unreached (const CeldSegmentTask *task, const CeldLabels *labels, CeldProblems *problems)
{
  const CeldBasins *b = task->basins;
  const uint32_t   *part_of = parts_of (task);
  CeldStrokes       strokes = { 0 };
  PaperPart        *part;
  size_t            n_parts = 0;
  CeldStatus        status;

  for (size_t k = 0; k < b->n; k++)
    n_parts = part_of[k] > n_parts ? part_of[k] : n_parts;
  part   = celd_alloc0 (n_parts + 1, sizeof *part);
  status = part ? celd_strokes_new (task, NULL, &strokes) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      gather_parts (b, part_of, part);
      drop_reached (task, &strokes, part_of, part);
      find_paper (b, part_of, choose_parts (b, part, n_parts), part);
    }
  for (size_t k = 1; k <= n_parts && status == CELD_OK; k++)
    if (part[k].area && !part[k].missing)
      {
        const CeldBasin *basin = &b->basin[part[k].basin - 1];

        status = celd_problem_add (problems, (CeldProblem) {
          .kind = CELD_PROBLEM_REGION_UNREACHED, .x = basin->x, .y = basin->y,
          .label = CELD_AT (labels, basin->x, basin->y), .relation = CELD_NO_INDEX });
      }
  celd_strokes_clear (&strokes);
  celd_free (part);
  return status;
}

/* Reports that the background should have a colour that no region has. */
static CeldStatus
report_background (const CeldSegmentTask *task, CeldProblems *problems)
{
  const CeldSettings *s = task->settings;

  if (s->background != CELD_BACKGROUND_COLOUR || celd_palette_find (&task->palette, s->background_colour))
    return CELD_OK;
  return celd_problem_add (problems, (CeldProblem) {
    .kind = CELD_PROBLEM_UNKNOWN_COLOUR, .x = -1, .y = -1, .relation = CELD_NO_INDEX,
    .label = celd_palette_nearest (&task->palette, s->background_colour) });
}

CeldStatus
celd_segment_report (const CeldSegmentTask *task, const CeldSeedRows *seeds, const CeldLabelling *labelling,
                     const CeldLabels *labels, const CeldHost *host, CeldProblems *problems)
{
  bool            all = !task->settings->flats;
  CeldSegmentTask before = *task;
  CeldStrokes     own = { 0 };
  CeldStatus      status = CELD_OK;

  before.seeds = *seeds;
  if (all && !task->painted.piece)
    status = celd_strokes_new (&before, NULL, &own);
  if (all && status == CELD_OK)
    status = report_overruled (task, own.piece ? &own : &task->painted, labelling, labels, problems);
  if (status == CELD_OK)
    status = report_lost (task, seeds, problems);
  if (all && status == CELD_OK)
    status = report_unreached (task, labels, problems);
  if (status == CELD_OK)
    status = report_background (task, problems);
  celd_strokes_clear (&own);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
