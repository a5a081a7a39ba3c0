/* The task of a segmentation: its labels, the data cost of their seeds, and which seeds count.
 *
 * A painted pixel costs hardness K in LazyBrush [SDC09b], so a stroke closes gaps up to hardness x its area, and the
 * same stroke with a thicker brush closes wider ones until the cheapest cut goes round the stroke itself.  Here the
 * data cost is divided by the mean width of all strokes, in units of 20 pixels: at hardness 0.05 a stroke closes gaps
 * up to its own length, whatever the brush and the resolution; a cut round the stroke costs twice that, so the majority
 * of paint wins.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/task.h"
#include "solve/maxflow.h"

#include <math.h>
#include <stdlib.h>

#define MOST_COST             (1 << 28)               /* of a seed's pixel: sums of costs stay below 2^60 */
#define BRUSH                 20.0                    /* pixels: at this width the data cost is hardness K (chosen) */
#define HUES                  360                     /* colours to choose from */
#define FIRST_HUE             ((uint32_t) 1417339208) /* hues are fractions of 2^32, round the circle: 0.33 */
#define HUE_STEP              ((uint32_t) 2654435769) /* from one to the next: the golden section */
#define THIRD                 ((uint32_t) 1431655765)
#define LEAST_COLOUR_DISTANCE 150                     /* sum over three channels of 0 .. 255, to aim at (chosen) */

/* ------------------------------------------------------------------ the record, and its labels */

CeldStatus
celd_task_add_label (CeldSegmentTask *task, CeldRegion region, uint32_t *label)
{
  if (celd_append_uncounted (task->palette.item, task->palette.n, region) != CELD_OK)
    return CELD_NO_MEMORY;
  *label = (uint32_t) task->palette.n;
  return CELD_OK;
}

CeldStatus
celd_task_new (const CeldSeedRows *seeds, const CeldPalette *palette, CeldSegmentTask *task)
{
  CeldStatus status = celd_seed_rows_copy (seeds, &task->seeds);

  for (size_t k = 0; k < palette->n && status == CELD_OK; k++)
    {
      CeldRegion region = palette->item[k];
      uint32_t   label;

      region.seeds      = 0;
      region.background = false;
      status = celd_task_add_label (task, region, &label);
    }
  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      {
        const CeldSeedRun *run = &seeds->row[y].run[i];

        if (run->label <= palette->n)
          task->palette.item[run->label - 1].seeds += (size_t) (run->end - run->x);
        else
          status = celd_seed_rows_paint (&task->seeds, y, run->x, run->end, 0);
      }
  return status;
}

void
celd_task_clear (CeldSegmentTask *task)
{
  celd_seed_rows_clear (&task->seeds);
  celd_strokes_clear (&task->painted);
  celd_palette_clear (&task->palette);
  celd_free (task->seeded);
  celd_free (task->unpainted);
}

void
celd_task_count_arrow_seeds (CeldSegmentTask *task)
{
  for (int y = 0; y < task->seeds.height; y++)
    for (size_t i = 0; i < task->seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &task->seeds.row[y].run[i];

        if (task->palette.item[run->label - 1].origin == CELD_FROM_ARROW)
          task->palette.item[run->label - 1].seeds += (size_t) (run->end - run->x);
      }
}

/* ------------------------------------------------------------------ colours of labels without a scribble */

static void
from_hue (uint32_t hue, double saturation, double value, uint8_t colour[4])
{
  for (uint32_t i = 0; i < 3; i++)
    {
      double t = (hue - i * THIRD) * (6 / 4294967296.0); /* 0 at this channel's own hue */
      double distance = t < 3 ? t : 6 - t;               /* 0 .. 3 */
      double share = distance < 1 ? 1 : distance < 2 ? 2 - distance : 0;

      colour[i] = (uint8_t) (255 * value * (1 - saturation + saturation * share) + 0.5);
    }
  colour[3] = 255;
}

static int
colour_distance (const uint8_t a[4], const uint8_t b[4])
{
  return abs (a[0] - b[0]) + abs (a[1] - b[1]) + abs (a[2] - b[2]);
}

/* The first of a fixed series of colours that is far from all labels; how far depends on the number of labels. */
static void
new_colour (const CeldPalette *palette, uint8_t colour[4])
{
  for (int least = LEAST_COLOUR_DISTANCE; ; least = least * 2 / 3)
    for (uint32_t i = 0; i < HUES; i++)
      {
        bool far = true;

        from_hue (FIRST_HUE + i * HUE_STEP, i % 3 == 1 ? 0.55 : 0.8, i % 3 == 2 ? 0.65 : 0.95, colour);
        for (size_t k = 0; k < palette->n && far; k++)
          far = !palette->item[k].colour[3] || colour_distance (palette->item[k].colour, colour) >= least;
        if (far)
          return;
      }
}

CeldStatus
celd_task_add_arrow_label (CeldSegmentTask *task, uint32_t *label)
{
  CeldRegion region = { .origin = CELD_FROM_ARROW, .hard = true };

  new_colour (&task->palette, region.colour);
  return celd_task_add_label (task, region, label);
}

/* ------------------------------------------------------------------ what seeds cost */

int32_t
celd_task_data_cost (const CeldSegmentTask *task, uint32_t label)
{
  bool all_hard = celd_task_all_hard (task);

  return all_hard || task->palette.item[label - 1].hard ? CELD_HARD : task->soft_cost;
}

/* Counts the pixels whose label differs between two rows of seeds. */
static size_t
count_changes (const CeldSeedRow *above, const CeldSeedRow *below, int width)
{
  size_t changes = 0, i = 0, j = 0;

  for (int x = 0, next; x < width; x = next)
    {
      uint32_t a = 0, b = 0;

      while (i < above->n && above->run[i].end <= x)
        i++;
      while (j < below->n && below->run[j].end <= x)
        j++;
      next = width;
      if (i < above->n)
        {
          bool in = above->run[i].x <= x;

          a    = in ? above->run[i].label : 0;
          next = in ? above->run[i].end : above->run[i].x;
        }
      if (j < below->n)
        {
          bool in = below->run[j].x <= x;
          int  end = in ? below->run[j].end : below->run[j].x;

          b    = in ? below->run[j].label : 0;
          next = end < next ? end : next;
        }
      if (a != b)
        changes += (size_t) (next - x);
    }
  return changes;
}

/* The mean width of the artist's strokes in pixels: twice their area divided by the length of their outline. */
static double
brush_width (const CeldSeedRows *seeds)
{
  size_t area = 0, outline = 0;

  for (int y = 0; y < seeds->height; y++)
    {
      const CeldSeedRow *row = &seeds->row[y];

      for (size_t i = 0; i < row->n; i++)
        {
          bool joined = i > 0 && row->run[i - 1].end == row->run[i].x;

          area    += (size_t) (row->run[i].end - row->run[i].x);
          outline += (row->run[i].x > 0 && !joined) + (size_t) (row->run[i].end < seeds->width);
        }
      if (y > 0)
        outline += count_changes (&seeds->row[y - 1], row, seeds->width);
    }
  return outline ? fmax (1, 2.0 * (double) area / (double) outline) : BRUSH;
}

void
celd_task_set_soft_cost (CeldSegmentTask *task)
{
  double hardness = (double) task->settings->hardness;
  double cost;

  task->brush = brush_width (&task->seeds);
  cost = CELD_COST_UNIT * task->basins->costs.paper_cost * hardness * BRUSH / task->brush;
  task->soft_cost = (int32_t) fmax (1, fmin (cost, MOST_COST));
}

/* ------------------------------------------------------------------ order of labels */

typedef struct { uint32_t label; size_t seeds; } LabelPixels;

static int
compare_label_pixels (const void *a, const void *b)
{
  const LabelPixels *p = a, *q = b;

  if (p->seeds != q->seeds)
    return p->seeds > q->seeds ? -1 : 1;
  return p->label < q->label ? -1 : 1;
}

CeldStatus
celd_task_label_order (const CeldSegmentTask *task, uint32_t *order)
{
  LabelPixels *entry = celd_alloc0 (task->palette.n, sizeof *entry);

  if (!entry)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < task->palette.n; k++)
    entry[k].label = (uint32_t) k + 1;
  for (int y = 0; y < task->seeds.height; y++)
    for (size_t i = 0; i < task->seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &task->seeds.row[y].run[i];

        entry[run->label - 1].seeds += (size_t) (run->end - run->x);
      }
  qsort (entry, task->palette.n, sizeof *entry, compare_label_pixels);
  for (size_t k = 0; k < task->palette.n; k++)
    order[k] = entry[k].label;
  celd_free (entry);
  return CELD_OK;
}

/* ------------------------------------------------------------------ flat colourings */

/* The seeds of a label: all pixels, those on paper, and runs. */
typedef struct { size_t pixels, paper, runs; } PaintCounts;

/* The end of the pixels from x on that are all paper, or all ink. */
static int
end_of_kind (const float *ink, int x, int end)
{
  bool paper = celd_is_paper (ink[x]);

  while (x < end && celd_is_paper (ink[x]) == paper)
    x++;
  return x;
}

static void
count_paint (const CeldSegmentTask *task, PaintCounts *counts)
{
  for (int y = 0; y < task->seeds.height; y++)
    for (size_t i = 0; i < task->seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &task->seeds.row[y].run[i];
        const float       *ink = &CELD_AT (task->ink, 0, y);
        PaintCounts       *of = &counts[run->label];

        of->pixels += (size_t) (run->end - run->x);
        of->runs++;
        for (int x = run->x; x < run->end; x++)
          of->paper += celd_is_paper (ink[x]);
      }
}

/* Hardly any of it is on paper, and it is wider than strokes are: the colour of a black area. */
static bool
is_dark_area (const PaintCounts *counts, int stroke)
{
  return 20 * counts->paper < counts->pixels && counts->pixels > 3 * (size_t) stroke * counts->runs;
}

/* Adds to `kept` the part of a run that counts; runs come in reading order. */
static CeldStatus
keep_run (const CeldSegmentTask *task, const PaintCounts *counts, int y, CeldSeedRun run, CeldSeedRows *kept)
{
  const float *ink = &CELD_AT (task->ink, 0, y);
  CeldStatus   status = CELD_OK;

  if (is_dark_area (&counts[run.label], task->basins->stroke))
    return celd_seed_rows_paint (kept, y, run.x, run.end, run.label);
  for (int x = run.x, end; x < run.end && status == CELD_OK; x = end)
    {
      end = end_of_kind (ink, x, run.end);
      if (celd_is_paper (ink[x]))
        status = celd_seed_rows_paint (kept, y, x, end, run.label);
    }
  return status;
}

/* Seeds on ink count only for labels of dark areas. */
CeldStatus
celd_task_drop_ink_seeds (CeldSegmentTask *task)
{
  CeldSeedRows kept = { 0 };
  PaintCounts *counts = celd_alloc0 (task->palette.n + 1, sizeof *counts);
  CeldStatus   status = counts ? celd_seed_rows_new (task->seeds.width, task->seeds.height, &kept) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    count_paint (task, counts);
  for (int y = 0; y < kept.height && status == CELD_OK; y++)
    for (size_t i = 0; i < task->seeds.row[y].n && status == CELD_OK; i++)
      status = keep_run (task, counts, y, task->seeds.row[y].run[i], &kept);
  if (status == CELD_OK)
    {
      CeldSeedRows all = task->seeds;

      task->seeds = kept;
      kept          = all;
    }
  celd_seed_rows_clear (&kept);
  celd_free (counts);
  return status;
}
