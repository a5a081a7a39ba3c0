/* Regions in which both ends of an inequality lie, split between them.
 *
 * The end with the shorter path, within the region, to the seeds of the region keeps its label; the other gets a new
 * one.  Only the region is cut again, and regions that earlier relations made of it.  A region consists of basins that
 * touch: those with the label at their maximum, or where they touch.  Pixels of other labels in these basins keep them,
 * and so do pixels under hard strokes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "segment/task.h"
#include "solve/maxflow.h"

#include <math.h>
#include <string.h>

typedef struct
{
  CeldSegmentTask  *task;
  const CeldLabels *labels;
  CeldSeedRows      taken;      /* labels that relations have changed so far */
  CeldSeedRows      painted;    /* seeds before relations added any */
  size_t           *first;      /* of basin k: its boundaries are boundary[first[k]] .. boundary[first[k + 1] - 1] */
  uint32_t         *boundary;
  uint32_t         *basin, *at; /* the current region, as in CeldCut */
  uint8_t          *side;       /* of its basins, after a cut between basins */
  uint8_t          *mark;       /* of each pixel, for celd_cut_pixels; CELD_OUTSIDE between two cuts */
} Split;

static uint32_t
label_at (const Split *split, int x, int y)
{
  uint32_t label = celd_seed_rows_at (&split->taken, x, y);

  return label ? label : CELD_AT (split->labels, x, y);
}

/* Are strokes of the label obeyed, whatever arrows say?  A flat colouring has no strokes: arrows split its areas. */
static bool
is_hard (const CeldSegmentTask *task, uint32_t label)
{
  return !task->settings->flats && task->palette.item[label - 1].origin == CELD_FROM_SCRIBBLE &&
         celd_task_data_cost (task, label) == CELD_HARD;
}

static bool
on_hard_stroke (const Split *split, CeldRelationEnd end, uint32_t label)
{
  return is_hard (split->task, label) && celd_seed_rows_at (&split->painted, end.x, end.y) == label;
}

/* ------------------------------------------------------------------ workspace, allocated for the first region */

static CeldStatus
split_new (Split *split)
{
  const CeldBasins *basins = split->task->basins;
  size_t           *first = celd_alloc0 (basins->n + 2, sizeof *first);

  split->first    = first;
  split->boundary = celd_alloc (2 * basins->n_boundaries, sizeof *split->boundary);
  split->basin    = celd_alloc (basins->n, sizeof *split->basin);
  split->at       = celd_alloc0 (basins->n, sizeof *split->at);
  split->side     = celd_alloc (basins->n, 1);
  split->mark     = celd_alloc0 ((size_t) basins->width * (size_t) basins->height, 1);
  if (!first || !split->boundary || !split->basin || !split->at || !split->side || !split->mark)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < basins->n_boundaries; i++)
    {
      first[basins->boundary[i].a + 2]++;
      first[basins->boundary[i].b + 2]++;
    }
  for (size_t k = 1; k < basins->n + 2; k++)
    first[k] += first[k - 1];
  for (size_t i = 0; i < basins->n_boundaries; i++)
    {
      split->boundary[first[basins->boundary[i].a + 1]++] = (uint32_t) i;
      split->boundary[first[basins->boundary[i].b + 1]++] = (uint32_t) i;
    }
  return celd_seed_rows_copy (&split->task->seeds, &split->painted);
}

static void
split_clear (Split *split)
{
  celd_seed_rows_clear (&split->taken);
  celd_seed_rows_clear (&split->painted);
  celd_free (split->first);
  celd_free (split->boundary);
  celd_free (split->basin);
  celd_free (split->at);
  celd_free (split->side);
  celd_free (split->mark);
}

/* ------------------------------------------------------------------ the region round an end */

static bool
basin_has (const Split *split, uint32_t k, uint32_t label)
{
  const CeldBasin *basin = &split->task->basins->basin[k];

  return label_at (split, basin->x, basin->y) == label;
}

/* Does the label continue from one basin to the other? */
static bool
continues (const Split *split, const CeldBasinBoundary *boundary, uint32_t label)
{
  if (basin_has (split, boundary->a, label) && basin_has (split, boundary->b, label))
    return true;
  return boundary->opening && label_at (split, boundary->x, boundary->y) == label &&
         label_at (split, boundary->x + !boundary->south, boundary->y + boundary->south) == label;
}

static void
join (uint32_t k, CeldCut *cut)
{
  if (cut->at[k])
    return;
  cut->basin[cut->n] = k;
  cut->at[k] = (uint32_t) ++cut->n;
}

/* Sets the bounding box of the region's basins. */
static void
find_box (const CeldBasins *basins, CeldCut *cut)
{
  cut->left = basins->width;
  cut->top  = basins->height;
  for (int y = 0; y < basins->height; y++)
    for (size_t i = basins->row[y]; i < basins->row[y + 1]; i++)
      {
        int left = basins->run[i].x, right = celd_basin_run_end (basins, i, y) - 1;

        if (!cut->at[basins->run[i].basin])
          continue;
        cut->left   = left < cut->left ? left : cut->left;
        cut->right  = right > cut->right ? right : cut->right;
        cut->top    = y < cut->top ? y : cut->top;
        cut->bottom = y;
      }
}

/* Finds the basins of the region round the first end; does it contain the second?  If earlier cuts have left only
 * pieces of basins at the ends, the region may continue through such pieces: then all basins are taken. */
static bool
find_region (Split *split, CeldCut *cut)
{
  const CeldBasins *basins = split->task->basins;
  uint32_t          first = celd_basin_at (basins, cut->end[0].x, cut->end[0].y);
  uint32_t          second = celd_basin_at (basins, cut->end[1].x, cut->end[1].y);
  bool              whole = basin_has (split, first, cut->label) && basin_has (split, second, cut->label);

  join (first, cut);
  for (size_t i = 0; i < cut->n; i++)
    for (size_t j = split->first[cut->basin[i]]; j < split->first[cut->basin[i] + 1]; j++)
      {
        const CeldBasinBoundary *boundary = &basins->boundary[split->boundary[j]];

        if (continues (split, boundary, cut->label))
          join (boundary->a == cut->basin[i] ? boundary->b : boundary->a, cut);
      }
  cut->any = !whole && !cut->at[second];
  for (uint32_t k = 0; k < basins->n && cut->any; k++)
    join (k, cut);
  find_box (basins, cut);
  return cut->at[second] != 0;
}

/* Marks the pixels of the label in row y of the region's basins: as inside, or with the side of their basin. */
static void
mark_row (const Split *split, const CeldCut *cut, const uint8_t *side, int y)
{
  const CeldBasins  *basins = split->task->basins;
  const CeldSeedRow *taken = &split->taken.row[y];
  const uint32_t    *label = &CELD_AT (split->labels, 0, y);
  uint8_t           *mark = cut->mark + (size_t) y * (size_t) basins->width;
  size_t             k = celd_basin_run (basins, cut->left, y), t = 0;

  for (int x = cut->left, end; x <= cut->right; x = end, k++)
    {
      uint32_t at = cut->at[basins->run[k].basin];
      uint8_t  value = !at ? CELD_OUTSIDE : side ? side[at - 1] : CELD_INSIDE;

      end = celd_basin_run_end (basins, k, y);
      end = end > cut->right ? cut->right + 1 : end;
      if (!at)
        continue;
      for (int u = x; u < end; u++)
        mark[u] = label[u] == cut->label ? value : CELD_OUTSIDE;
      for (; t < taken->n && taken->run[t].x < end; t++)
        {
          int from = taken->run[t].x > x ? taken->run[t].x : x, to = taken->run[t].end < end ? taken->run[t].end : end;

          if (from < to)
            memset (mark + from, taken->run[t].label == cut->label ? value : CELD_OUTSIDE, (size_t) (to - from));
          if (taken->run[t].end > end)
            break; /* continues in the next basin */
        }
    }
}

static void
clear_region (Split *split, const CeldCut *cut)
{
  for (size_t i = 0; i < cut->n; i++)
    cut->at[cut->basin[i]] = 0;
  for (int y = cut->top; y <= cut->bottom; y++)
    memset (split->mark + (size_t) y * (size_t) split->labels->width + (size_t) cut->left, CELD_OUTSIDE,
            (size_t) (cut->right - cut->left + 1));
}

/* ------------------------------------------------------------------ applying a cut */

/* Pixels under hard strokes keep the region's label, wherever the cut runs. */
static void
keep_hard_strokes (const Split *split, const CeldCut *cut, uint8_t kept_side)
{
  for (int y = cut->top; y <= cut->bottom; y++)
    {
      const CeldSeedRow *row = &split->painted.row[y];
      uint8_t           *mark = split->mark + (size_t) y * (size_t) split->labels->width;

      for (size_t i = 0; i < row->n; i++)
        for (int x = row->run[i].x; row->run[i].label == cut->label && x < row->run[i].end; x++)
          mark[x] = mark[x] == CELD_OUTSIDE ? CELD_OUTSIDE : kept_side;
    }
}

/* Adds the pixels of a disc on its side of the cut to the seeds. */
static CeldStatus
seed_disc (Split *split, const CeldSeedDisc *disc, uint8_t side, uint32_t label)
{
  int        w = split->labels->width, r = (int) disc->radius, top = disc->y - r, bottom = disc->y + r, x, end;
  CeldStatus status = CELD_OK;

  bottom = bottom < split->labels->height ? bottom : split->labels->height - 1;
  for (int y = top < 0 ? 0 : top; y <= bottom; y++)
    if (celd_seed_disc_row (disc, y, &x, &end))
      for (int next = x = x < 0 ? 0 : x; x < end && x < w && status == CELD_OK; x = next + 1)
        {
          const uint8_t *mark = split->mark + (size_t) y * (size_t) w;

          for (next = x; next < end && next < w && mark[next] == side; next++)
            ;
          status = celd_seed_rows_paint (&split->task->seeds, y, x, next, label);
        }
  return status;
}

/* Gives an end's side of the cut to the new label. */
static CeldStatus
label_side (Split *split, const CeldCut *cut, uint8_t side, uint32_t label)
{
  CeldStatus status = CELD_OK;

  for (int y = cut->top; y <= cut->bottom; y++)
    {
      const uint8_t *mark = split->mark + (size_t) y * (size_t) split->labels->width, *last = mark + cut->right + 1;
      const uint8_t *from = mark + cut->left, *to;

      while (status == CELD_OK && (from = memchr (from, side, (size_t) (last - from))))
        {
          for (to = from; to < last && *to == side; to++)
            ;
          status = celd_seed_rows_paint (&split->taken, y, (int) (from - mark), (int) (to - mark), label);
          from = to;
        }
    }
  return status;
}

static CeldStatus
apply_cut (Split *split, const CeldCut *cut, int kept)
{
  const uint8_t side[2] = { CELD_NEAR_FIRST, CELD_NEAR_SECOND };
  uint32_t      label[2] = { cut->label, cut->label };
  CeldStatus    status = celd_task_add_arrow_label (split->task, &label[1 - kept]);

  if (is_hard (split->task, cut->label))
    keep_hard_strokes (split, cut, side[kept]);
  if (status == CELD_OK)
    status = label_side (split, cut, side[1 - kept], label[1 - kept]);
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 2 && status == CELD_OK; k++)
      status = seed_disc (split, &cut->discs[i].disc[k], side[i], label[i]);
  return status;
}

/* Cuts between basins if a narrow opening separates the ends; else between pixels. */
static CeldStatus
cut_region (Split *split, CeldCut *cut, const CeldHost *host, int *kept)
{
  const CeldBasins *basins = split->task->basins;
  uint32_t          first = celd_basin_at (basins, cut->end[0].x, cut->end[0].y);
  uint32_t          second = celd_basin_at (basins, cut->end[1].x, cut->end[1].y);
  bool              narrow = !cut->any && basins->merged[first] != basins->merged[second];
  CeldStatus        status = narrow ? celd_cut_basins (cut, host, split->side, kept) : CELD_OK;

  for (int y = cut->top; y <= cut->bottom && status == CELD_OK && (!narrow || *kept >= 0); y++)
    mark_row (split, cut, narrow ? split->side : NULL, y);
  return narrow || status != CELD_OK ? status : celd_cut_pixels (cut, host, kept);
}

static CeldStatus
split_region (Split *split, CeldCut *cut, size_t relation, const CeldHost *host)
{
  double     farthest = CELD_DISC_RANGE * celd_relation_end_distance (cut->end[0], cut->end[1]);
  int        kept = -1;
  CeldStatus status = CELD_OK;

  if (find_region (split, cut))
    {
      for (int i = 0; i < 2; i++)
        cut->discs[i] = celd_seed_discs_find (split->task, cut->end[i], farthest, INFINITY);
      status = cut_region (split, cut, host, &kept);
      if (status == CELD_OK && kept >= 0)
        {
          status = apply_cut (split, cut, kept);
          if (split->task->n_effective <= relation)
            split->task->n_effective = relation + 1;
        }
    }
  clear_region (split, cut);
  return status;
}

static CeldStatus
split_relation (Split *split, const CeldRelations *relations, size_t i, const CeldHost *host)
{
  const CeldRelation *relation = &relations->item[i];
  CeldSegmentTask    *task = split->task;
  CeldCut             cut = {
    .task = task,
    .end  = { celd_relation_end_find (task, &relation->nearer), celd_relation_end_find (task, &relation->farther) },
  };

  if (relation->equal || !cut.end[0].there || !cut.end[1].there ||
      (cut.end[0].x == cut.end[1].x && cut.end[0].y == cut.end[1].y))
    return CELD_OK;
  cut.label = label_at (split, cut.end[0].x, cut.end[0].y);
  if (cut.label != label_at (split, cut.end[1].x, cut.end[1].y))
    return CELD_OK;
  if (!split->first && split_new (split) != CELD_OK)
    return CELD_NO_MEMORY;
  if (on_hard_stroke (split, cut.end[0], cut.label) && on_hard_stroke (split, cut.end[1], cut.label))
    return CELD_OK; /* both labels are given */
  cut.basin = split->basin;
  cut.at    = split->at;
  cut.mark  = split->mark;
  return split_region (split, &cut, i, host);
}

/* ------------------------------------------------------------------ all relations in turn */

/* Appends the changed labels as patches; without memory the patches are as before. */
static CeldStatus
add_patches (const Split *split, CeldPatches *patches)
{
  size_t     before = patches->n;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < split->taken.height; y++)
    for (size_t i = 0; i < split->taken.row[y].n && status == CELD_OK; i++)
      {
        const CeldSeedRun *run = &split->taken.row[y].run[i];

        status = celd_patch_add (patches, (CeldPatch) { y, run->x, run->end, run->label });
      }
  if (status != CELD_OK)
    patches->n = before;
  return status;
}

CeldStatus
celd_regions_split (const CeldRelations *relations, const CeldHost *host, const CeldLabels *labels,
                    CeldSegmentTask *task, CeldPatches *patches)
{
  Split      split = { .task = task, .labels = labels };
  CeldStatus status;

  if (!relations->n)
    return CELD_OK;
  status = celd_seed_rows_new (labels->width, labels->height, &split.taken);
  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      CeldHostPart part;
      double       n = (double) relations->n;
      CeldHost     one = celd_host_part (&part, host, (double) i / n, (double) (i + 1) / n);

      status = split_relation (&split, relations, i, &one);
    }
  if (status == CELD_OK)
    status = add_patches (&split, patches);
  split_clear (&split);
  return status;
}
