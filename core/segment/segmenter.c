/* The segmentation of one drawing, kept between strokes: the basin graph is built once, every stroke is solved on it,
 * and only pixels whose label changes are painted.
 *
 * The result depends on the drawing, the seeds, the relations and the settings alone; all that is remembered of the
 * last one is what is painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/segmenter.h"
#include "segment/splits.h"

#include <string.h>

/* ------------------------------------------------------------------ the object */

CeldSegmenter *
celd_segmenter_new (void)
{
  return celd_alloc0 (1, sizeof (CeldSegmenter));
}

void
celd_segmenter_free (CeldSegmenter *segmenter)
{
  if (!segmenter)
    return;
  celd_bridges_clear (&segmenter->bridges);
  celd_free (segmenter->bridged_component);
  celd_basins_clear (&segmenter->basins);
  celd_labelling_clear (&segmenter->labelling);
  celd_strokes_clear (&segmenter->strokes);
  celd_closures_clear (&segmenter->closures);
  celd_patches_clear (&segmenter->redrawn);
  celd_free (segmenter->seeded);
  celd_free (segmenter);
}

const CeldClosures *
celd_segmenter_closures (const CeldSegmenter *segmenter)
{
  return &segmenter->closures;
}

size_t
celd_segmenter_effective_relations (const CeldSegmenter *segmenter)
{
  return segmenter->n_effective;
}

CeldStatus
celd_segmenter_set_ink (CeldSegmenter *segmenter, const CeldPlane *ink, const CeldRect *changed,
                        const CeldSettings *settings, const CeldHost *host)
{
  CeldSegmenter *s = segmenter;
  float          threshold = settings->ink_threshold;
  bool           same_size = s->basins.width == ink->width && s->basins.height == ink->height;
  bool           renew = changed && same_size && s->threshold == threshold && s->bridged == settings->close_gaps;
  CeldRect       rect = changed ? *changed : (CeldRect) { 0 };
  CeldStatus     status;

  s->ink = *ink;
  if (renew && (rect.width < 1 || rect.height < 1))
    return CELD_OK; /* all that is known of the drawing stays true; components are joined over bridges already */
  celd_strokes_clear (&s->strokes);
  celd_free (s->bridged_component);
  s->bridged_component = NULL;
  if (settings->close_gaps)
    status = celd_bridges_make_basins (ink, renew ? &rect : NULL, threshold, host, &s->bridges, &s->basins,
                                       &s->bridged_component);
  else
    {
      celd_bridges_clear (&s->bridges);
      status = celd_basins_make (ink, renew ? &rect : NULL, threshold, host, &s->basins);
    }
  if (status == CELD_OK)
    status = celd_labelling_reset (&s->labelling, &s->basins);
  if (status == CELD_OK)
    {
      s->threshold = threshold;
      s->bridged   = settings->close_gaps;
    }
  else
    s->basins.width = 0; /* invalid: the next drawing starts from the beginning */
  return status;
}

/* ------------------------------------------------------------------ the seeds */

static bool
has_seeds (const CeldSeedRows *seeds)
{
  for (int y = 0; y < seeds->height; y++)
    if (seeds->row[y].n)
      return true;
  return false;
}

/* Adds the seeds of arrows and of the background to those of the artist, and removes spills. */
static CeldStatus
prepare_seeds (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task)
{
  CeldStatus status;

  celd_task_set_soft_cost (task); /* needs the artist's seeds alone */
  status = relations ? celd_arrow_seeds_add (relations, host, task) : CELD_OK;
  if (status == CELD_OK && !has_seeds (&task->seeds))
    status = CELD_NOTHING_TO_GO_BY;
  if (status == CELD_OK && task->settings->flats)
    status = celd_task_drop_ink_seeds (task);
  if (status == CELD_OK)
    status = celd_spills_remove (host, task);
  if (status == CELD_OK)
    status = celd_background_seed (relations, host, task);
  return status;
}

/* ------------------------------------------------------------------ solving on basins */

static CeldStatus
split (CeldSegmenter *s, const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task,
       CeldLabels *labels)
{
  CeldPatches patches = { 0 };
  CeldStatus  status = celd_regions_split (relations, host, labels, task, &patches);

  if (status == CELD_OK)
    status = celd_labelling_add (&s->labelling, &patches, labels);
  celd_patches_clear (&patches);
  return status;
}

/* Closes gaps between the labels painted so far; a basin's label is that of its maximum. */
static CeldStatus
close_gaps (CeldSegmenter *s, const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels)
{
  uint32_t    *label = celd_alloc (s->basins.n, sizeof *label);
  CeldPatches  patches = { 0 };
  CeldClosures closures = { 0 };
  CeldStatus   status = label ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < s->basins.n && status == CELD_OK; k++)
    label[k] = CELD_AT (labels, s->basins.basin[k].x, s->basins.basin[k].y);
  if (status == CELD_OK)
    status = celd_closures_find (task, label, labels, &s->labelling.patches, host, &closures, &patches);
  if (status == CELD_OK)
    status = celd_labelling_add (&s->labelling, &patches, labels);
  celd_free (label);
  s->redrawn = patches;
  if (status != CELD_OK)
    {
      celd_closures_clear (&closures);
      return status;
    }
  celd_closures_clear (&s->closures);
  s->closures = closures;
  return CELD_OK;
}

/* Without closures, boundaries move to where the energy is lower. */
static CeldStatus
refine_boundaries (CeldSegmenter *s, const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels)
{
  CeldPatches patches = { 0 };
  CeldStatus  status = celd_boundaries_refine (task, host, labels, &patches);

  if (status == CELD_OK)
    status = celd_labelling_add (&s->labelling, &patches, labels);
  s->redrawn = patches;
  return status;
}

/* Paints the basins' labels, and over them windows, split regions and closed gaps.  From here on a failure invalidates
 * the labelling. */
static CeldStatus
repaint (CeldSegmenter *s, uint32_t *label, const CeldPatches *windows, const CeldRelations *relations,
         const CeldHost *host, CeldSegmentTask *task, CeldLabels *labels)
{
  CeldLabelling old;
  CeldStatus    status;

  celd_labelling_begin (&s->labelling, &s->basins, label, labels, &old);
  status = celd_labelling_add (&s->labelling, windows, labels);
  if (status == CELD_OK && relations)
    status = split (s, relations, host, task, labels);
  celd_closures_clear (&s->closures);
  celd_patches_clear (&s->redrawn);
  if (status == CELD_OK && task->settings->close_gaps)
    status = close_gaps (s, task, host, labels);
  else if (status == CELD_OK)
    status = refine_boundaries (s, task, host, labels);
  if (status == CELD_OK)
    status = celd_labelling_end (&s->labelling, &s->basins, &old, labels);
  celd_labelling_clear (&old);
  if (status != CELD_OK)
    celd_labelling_invalidate (&s->labelling, &s->basins);
  return status;
}

static CeldStatus
solve_on_basins (CeldSegmenter *s, const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task,
                 CeldLabels *labels)
{
  CeldHostPart part[3];
  CeldHost     graph = celd_host_part (&part[0], host, 0, 0.4), pixels = celd_host_part (&part[1], host, 0.4, 0.9);
  CeldHost     rest = celd_host_part (&part[2], host, 0.9, 0.9);
  uint32_t    *label = celd_alloc (s->basins.n, sizeof *label);
  CeldPatches  windows = { 0 };
  CeldStatus   status = label ? celd_basin_graph_solve (task, &graph, label) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_windows_solve (task, label, &pixels, &windows);
  if (status == CELD_OK)
    {
      status = repaint (s, label, &windows, relations, &rest, task, labels);
      label  = NULL;
    }
  if (status == CELD_OK)
    status = celd_labelling_measure (&s->labelling, &s->basins, labels, &task->palette);
  celd_patches_clear (&windows);
  celd_free (label);
  return status;
}

/* ------------------------------------------------------------------ solving on pixels */

static CeldStatus
solve_on_pixels (CeldSegmenter *s, const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task,
                 CeldLabels *labels)
{
  CeldHostPart part[3];
  CeldHost     cuts = celd_host_part (&part[0], host, 0, 0.8), splits = celd_host_part (&part[1], host, 0.8, 1);
  CeldHost     rest = celd_host_part (&part[2], host, 1, 1);
  CeldPatches  patches = { 0 };
  CeldLabels   exact;
  CeldStatus   status = celd_labels_new (labels->width, labels->height, &exact);

  if (status == CELD_OK)
    status = task->settings->method == CELD_METHOD_WALKER ? celd_random_walker_solve (task, &cuts, &exact)
                                                            : celd_lazybrush_solve (task, &cuts, &exact);
  if (status == CELD_OK && relations)
    status = celd_regions_split (relations, &splits, &exact, task, &patches);
  for (size_t i = 0; i < patches.n; i++)
    for (int x = patches.item[i].x; x < patches.item[i].end; x++)
      CELD_AT (&exact, x, patches.item[i].y) = patches.item[i].label;
  if (status == CELD_OK)
    status = celd_palette_measure (&exact, &s->ink, &rest, &task->palette);
  if (status == CELD_OK)
    status = celd_labelling_replace (&s->labelling, &s->basins, &exact, labels);
  if (status == CELD_OK)
    {
      celd_closures_clear (&s->closures);
      celd_patches_clear (&s->redrawn);
    }
  celd_patches_clear (&patches);
  celd_free (exact.data);
  return status;
}

/* ------------------------------------------------------------------ the whole */

static CeldStatus
solve (CeldSegmenter *s, const CeldSeedRows *seeds, const CeldRelations *relations, const CeldHost *host,
       CeldSegmentTask *task, CeldLabels *labels, CeldProblems *problems)
{
  CeldHostPart part[3];
  CeldHost     first = celd_host_part (&part[0], host, 0, 0), solving = celd_host_part (&part[1], host, 0.1, 0.95);
  CeldHost     last = celd_host_part (&part[2], host, 0.95, 0.95);
  bool         arrows = relations && task->settings->seeds == CELD_SEEDS_AUTO;
  CeldStatus   status = prepare_seeds (arrows ? relations : NULL, &first, task);

  if (status == CELD_OK && task->settings->method != CELD_METHOD_BASINS)
    status = solve_on_pixels (s, arrows ? relations : NULL, &solving, task, labels);
  else if (status == CELD_OK)
    status = solve_on_basins (s, arrows ? relations : NULL, &solving, task, labels);
  if (status == CELD_OK)
    {
      celd_task_count_arrow_seeds (task);
      status = celd_segment_report (task, seeds, &s->labelling, labels, &last, problems);
    }
  return status;
}

static void
remember_background (CeldSegmenter *s, const CeldPalette *palette)
{
  s->background = 0;
  for (uint32_t k = 0; k < palette->n; k++)
    if (palette->item[k].background)
      {
        s->background        = k + 1;
        s->background_region = palette->item[k];
      }
}

CeldStatus
celd_segmenter_solve (CeldSegmenter *segmenter, const CeldSeedRows *seeds, const CeldRelations *relations,
                      const CeldSettings *settings, const CeldHost *host, CeldPalette *palette, CeldProblems *problems,
                      CeldLabels *labels, CeldRect *changed)
{
  CeldSegmentTask task = {
    .settings = settings, .ink = &segmenter->ink, .basins = &segmenter->basins, .bridges = &segmenter->bridges,
    .bridged_component = segmenter->bridged_component, .kept = &segmenter->strokes
  };
  CeldProblems    found = { 0 };
  size_t          before = problems ? problems->n : 0;
  CeldStatus      status = celd_settings_check (settings);

  if (status == CELD_OK)
    status = celd_task_new (seeds, palette, &task);
  if (status == CELD_OK)
    status = solve (segmenter, seeds, relations, host, &task, labels, &found);
  for (size_t i = 0; i < found.n && status == CELD_OK; i++)
    status = celd_problem_add (problems, found.item[i]);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    {
      CeldPalette old = *palette;

      *palette       = task.palette;
      task.palette = old;
      celd_free (segmenter->seeded);
      segmenter->seeded = task.seeded;
      segmenter->n_effective  = task.n_effective;
      remember_background (segmenter, palette);
      task.seeded     = NULL;
      *changed       = segmenter->labelling.changed;
      segmenter->labelling.changed = (CeldRect) { 0 };
    }
  else if (problems)
    problems->n = before;
  celd_problems_clear (&found);
  celd_task_clear (&task);
  return status;
}

/* ------------------------------------------------------------------ in one call, without keeping anything */

CeldStatus
celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
              const CeldSettings *settings, const CeldHost *host,
              CeldLabels *labels, CeldPalette *palette, CeldProblems *problems)
{
  CeldSegmenter *segmenter = NULL;
  CeldSeedRows   rows = { 0 };
  CeldLabels     result = { 0 };
  CeldRect       changed;
  CeldHostPart   part[2];
  CeldHost       build = celd_host_part (&part[0], host, 0, 0.3), solve = celd_host_part (&part[1], host, 0.3, 1);
  CeldStatus     status;

  if (!CELD_SAME_SIZE (ink, seeds) || !CELD_SAME_SIZE (ink, labels))
    return CELD_BAD_SIZE;
  status = celd_settings_check (settings);
  if (status != CELD_OK)
    return status;
  segmenter = celd_segmenter_new ();
  status = segmenter ? celd_segmenter_set_ink (segmenter, ink, NULL, settings, &build) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_seed_rows_read (seeds, &rows);
  if (status == CELD_OK)
    status = celd_labels_new (ink->width, ink->height, &result);
  if (status == CELD_OK)
    status = celd_segmenter_solve (segmenter, &rows, relations, settings, &solve, palette, problems, &result, &changed);
  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    memcpy (&CELD_AT (labels, 0, y), &CELD_AT (&result, 0, y), (size_t) ink->width * sizeof *labels->data);
  celd_segmenter_free (segmenter);
  celd_seed_rows_clear (&rows);
  celd_free (result.data);
  return status;
}
