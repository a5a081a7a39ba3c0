/* The segmentation of one drawing, kept between strokes: the basin graph is built once, every stroke is answered on it,
 * and only pixels whose label changes are painted.
 *
 * An answer depends on the drawing and the seeds alone; what is remembered of the last one is only what is painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/canvas.h"
#include "segment/painting.h"
#include "segment/segment.h"

#include <string.h>

struct CeldSegmenter
{
  CeldPlane    ink;             /* borrowed */
  CeldBridges  bridges;
  uint32_t    *cell;            /* of each basin: its piece, parted by bridges; NULL without any */
  CeldBasins   basins;
  float        threshold;       /* that the basins were made with, */
  bool         bridged;         /* and whether over bridges */
  CeldPainting painting;
  CeldSpread   spread;          /* of the last answer's seeds */
  CeldClosures closures;
  CeldPatches  redrawn;         /* what closing gaps and settling borders have changed of the last answer */
  bool        *reached;         /* of the last answer, as in CeldCanvas; NULL: none that arrows could plant for */
  size_t       acting;
};

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
  celd_free (segmenter->cell);
  celd_basins_clear (&segmenter->basins);
  celd_painting_clear (&segmenter->painting);
  celd_spread_clear (&segmenter->spread);
  celd_closures_clear (&segmenter->closures);
  celd_patches_clear (&segmenter->redrawn);
  celd_free (segmenter->reached);
  celd_free (segmenter);
}

const CeldClosures *
celd_segmenter_closures (const CeldSegmenter *segmenter)
{
  return &segmenter->closures;
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

  celd_spread_clear (&s->spread);
  celd_free (s->cell);
  s->cell = NULL;
  if (settings->close_gaps)
    status = celd_bridges_make_basins (ink, renew ? &rect : NULL, threshold, host, &s->bridges, &s->basins, &s->cell);
  else
    {
      celd_bridges_clear (&s->bridges);
      status = celd_basins_make (ink, renew ? &rect : NULL, threshold, host, &s->basins);
    }
  if (status == CELD_OK)
    status = celd_painting_forget (&s->painting, &s->basins);
  if (status == CELD_OK)
    {
      s->ink       = *ink;
      s->threshold = threshold;
      s->bridged   = settings->close_gaps;
    }
  else
    s->basins.width = 0; /* what is left is of no drawing: the next one starts anew */
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

/* What arrows, the background and common sense make of the artist's seeds. */
static CeldStatus
prepare_seeds (const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas)
{
  CeldStatus status;

  celd_canvas_weigh (canvas); /* before anything else adds seeds */
  status = relations ? celd_seeds_plant (relations, host, canvas) : CELD_OK;
  if (status == CELD_OK && !has_seeds (&canvas->seeds))
    status = CELD_NOTHING_TO_GO_BY;
  if (status == CELD_OK && canvas->settings->flats)
    status = celd_canvas_keep_paper (canvas);
  if (status == CELD_OK)
    status = celd_stains_remove (host, canvas);
  if (status == CELD_OK)
    status = celd_background_seed (host, canvas);
  return status;
}

/* ------------------------------------------------------------------ an answer on basins */

static CeldStatus
split (CeldSegmenter *s, const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas, CeldLabels *labels)
{
  CeldPatches patches = { 0 };
  CeldStatus  status = celd_seeds_split (relations, host, labels, canvas, &patches);

  if (status == CELD_OK)
    status = celd_painting_add (&s->painting, &patches, labels);
  celd_patches_clear (&patches);
  return status;
}

/* Closes gaps between labels as they are painted: a basin is called what its maximum is. */
static CeldStatus
close_gaps (CeldSegmenter *s, const CeldCanvas *canvas, const CeldHost *host, CeldLabels *labels)
{
  uint32_t    *label = celd_alloc (s->basins.n, sizeof *label);
  CeldPatches  patches = { 0 };
  CeldClosures closures = { 0 };
  CeldStatus   status = label ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < s->basins.n && status == CELD_OK; k++)
    label[k] = CELD_AT (labels, s->basins.basin[k].x, s->basins.basin[k].y);
  if (status == CELD_OK)
    status = celd_closures_find (canvas, label, labels, &s->painting.patches, host, &closures, &patches);
  if (status == CELD_OK)
    status = celd_painting_add (&s->painting, &patches, labels);
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

/* Without curves across gaps borders run where the energy is least. */
static CeldStatus
settle_borders (CeldSegmenter *s, const CeldCanvas *canvas, const CeldHost *host, CeldLabels *labels)
{
  CeldPatches patches = { 0 };
  CeldStatus  status = celd_borders_settle (canvas, host, labels, &patches);

  if (status == CELD_OK)
    status = celd_painting_add (&s->painting, &patches, labels);
  s->redrawn = patches;
  return status;
}

/* From here on the picture changes: the basins' labels, over them windows, split regions and closed gaps. */
static CeldStatus
repaint (CeldSegmenter *s, uint32_t *label, const CeldPatches *windows, const CeldRelations *relations,
         const CeldHost *host, CeldCanvas *canvas, CeldLabels *labels)
{
  CeldPainting old;
  CeldStatus   status;

  celd_painting_begin (&s->painting, &s->basins, label, labels, &old);
  status = celd_painting_add (&s->painting, windows, labels);
  if (status == CELD_OK && relations)
    status = split (s, relations, host, canvas, labels);
  celd_closures_clear (&s->closures);
  celd_patches_clear (&s->redrawn);
  if (status == CELD_OK && canvas->settings->close_gaps)
    status = close_gaps (s, canvas, host, labels);
  else if (status == CELD_OK)
    status = settle_borders (s, canvas, host, labels);
  if (status == CELD_OK)
    status = celd_painting_end (&s->painting, &s->basins, &old, labels);
  celd_painting_clear (&old);
  if (status != CELD_OK)
    celd_painting_lose (&s->painting, &s->basins);
  return status;
}

static CeldStatus
solve_on_basins (CeldSegmenter *s, const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas,
                 CeldLabels *labels)
{
  CeldHostPart    part[3];
  CeldHost    graph = celd_host_part (&part[0], host, 0, 0.4), pixels = celd_host_part (&part[1], host, 0.4, 0.9);
  CeldHost    rest = celd_host_part (&part[2], host, 0.9, 0.9);
  uint32_t   *label = celd_alloc (s->basins.n, sizeof *label);
  CeldPatches windows = { 0 };
  CeldStatus  status = label ? celd_graph_solve (canvas, &graph, label) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = celd_windows_solve (canvas, label, &pixels, &windows);
  if (status == CELD_OK)
    {
      status = repaint (s, label, &windows, relations, &rest, canvas, labels);
      label  = NULL;
    }
  if (status == CELD_OK)
    status = celd_painting_measure (&s->painting, &s->basins, labels, &canvas->palette);
  celd_patches_clear (&windows);
  celd_free (label);
  return status;
}

/* ------------------------------------------------------------------ an answer on pixels */

static CeldStatus
solve_on_pixels (CeldSegmenter *s, const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas,
                 CeldLabels *labels)
{
  CeldHostPart    part[3];
  CeldHost    cuts = celd_host_part (&part[0], host, 0, 0.8), splits = celd_host_part (&part[1], host, 0.8, 1);
  CeldHost    rest = celd_host_part (&part[2], host, 1, 1);
  CeldPatches patches = { 0 };
  CeldLabels  exact;
  CeldStatus  status = celd_labels_new (labels->width, labels->height, &exact);

  if (status == CELD_OK)
    status = canvas->settings->method == CELD_METHOD_WALKER ? celd_walker_solve (canvas, &cuts, &exact)
                                                            : celd_exact_solve (canvas, &cuts, &exact);
  if (status == CELD_OK && relations)
    status = celd_seeds_split (relations, &splits, &exact, canvas, &patches);
  for (size_t i = 0; i < patches.n; i++)
    for (int x = patches.item[i].x; x < patches.item[i].end; x++)
      CELD_AT (&exact, x, patches.item[i].y) = patches.item[i].label;
  if (status == CELD_OK)
    status = celd_palette_measure (&exact, &s->ink, &rest, &canvas->palette);
  if (status == CELD_OK)
    status = celd_painting_replace (&s->painting, &s->basins, &exact, labels);
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
       CeldCanvas *canvas, CeldLabels *labels, CeldProblems *problems)
{
  CeldHostPart   part[3];
  CeldHost   first = celd_host_part (&part[0], host, 0, 0), solving = celd_host_part (&part[1], host, 0.1, 0.95);
  CeldHost   last = celd_host_part (&part[2], host, 0.95, 0.95);
  bool       arrows = relations && canvas->settings->seeds == CELD_SEEDS_AUTO;
  CeldStatus status = prepare_seeds (arrows ? relations : NULL, &first, canvas);

  if (status == CELD_OK && canvas->settings->method != CELD_METHOD_BASINS)
    status = solve_on_pixels (s, arrows ? relations : NULL, &solving, canvas, labels);
  else if (status == CELD_OK)
    status = solve_on_basins (s, arrows ? relations : NULL, &solving, canvas, labels);
  if (status == CELD_OK)
    {
      celd_canvas_count_arrow_seeds (canvas);
      status = celd_segment_report (canvas, seeds, &s->painting, labels, &last, problems);
    }
  return status;
}

CeldStatus
celd_segmenter_solve (CeldSegmenter *segmenter, const CeldSeedRows *seeds, const CeldRelations *relations,
                      const CeldSettings *settings, const CeldHost *host, CeldPalette *palette, CeldProblems *problems,
                      CeldLabels *labels, CeldRect *changed)
{
  CeldCanvas   canvas = {
    .settings = settings, .ink = &segmenter->ink, .basins = &segmenter->basins, .bridges = &segmenter->bridges,
    .cell = segmenter->cell, .kept = &segmenter->spread
  };
  CeldProblems found = { 0 };
  size_t       before = problems ? problems->n : 0;
  CeldStatus   status = celd_settings_check (settings);

  if (status == CELD_OK)
    status = celd_canvas_new (seeds, palette, &canvas);
  if (status == CELD_OK)
    status = solve (segmenter, seeds, relations, host, &canvas, labels, &found);
  for (size_t i = 0; i < found.n && status == CELD_OK; i++)
    status = celd_problem_add (problems, found.item[i]);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    {
      CeldPalette old = *palette;

      *palette       = canvas.palette;
      canvas.palette = old;
      celd_free (segmenter->reached);
      segmenter->reached = canvas.reached;
      segmenter->acting  = canvas.acting;
      canvas.reached     = NULL;
      *changed       = segmenter->painting.changed;
      segmenter->painting.changed = (CeldRect) { 0 };
    }
  else if (problems)
    problems->n = before;
  celd_problems_clear (&found);
  celd_canvas_clear (&canvas);
  return status;
}

/* ------------------------------------------------------------------ relations that change nothing */

size_t
celd_segmenter_acting (const CeldSegmenter *segmenter)
{
  return segmenter->acting;
}

/* Bends of borders came after regions were split, so ends must not lie where a border has moved. */
bool
celd_segmenter_spares (const CeldSegmenter *segmenter, const CeldRelation *relation, const CeldSettings *settings,
                       const CeldLabels *labels)
{
  const CeldSegmenter *s = segmenter;
  CeldCanvas           canvas = { .settings = settings, .ink = &s->ink, .basins = &s->basins, .reached = s->reached };

  if (settings->seeds != CELD_SEEDS_AUTO)
    return true;
  return s->reached && !celd_seeds_wanted (&canvas, relation) &&
         celd_seeds_apart (&canvas, relation, labels, &s->redrawn);
}

/* ------------------------------------------------------------------ in one call, for those who keep nothing */

CeldStatus
celd_segment (const CeldPlane *ink, const CeldLabels *seeds, const CeldRelations *relations,
              const CeldSettings *settings, const CeldHost *host,
              CeldLabels *labels, CeldPalette *palette, CeldProblems *problems)
{
  CeldSegmenter *segmenter = NULL;
  CeldSeedRows   rows = { 0 };
  CeldLabels     result = { 0 };
  CeldRect       changed;
  CeldHostPart       part[2];
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
