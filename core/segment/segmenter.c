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
#include "segment/patches.h"
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

/* Makes the basins of ink on which bridges are drawn; again what has changed, or all of them. */
static CeldStatus
make_basins (CeldSegmenter *s, const CeldPlane *ink, const CeldRect *changed, float threshold, const CeldHost *host)
{
  CeldBasins basins = { 0 };
  CeldStatus status;

  if (changed)
    return celd_basins_renew (ink, changed, host, &s->basins);
  status = celd_basins_new (ink, threshold, host, &basins);
  if (status != CELD_OK)
    return status;
  celd_basins_clear (&s->basins);
  s->basins = basins;
  return CELD_OK;
}

/* Remembers what the bridges part, before pieces are joined over them. */
static CeldStatus
keep_cells (CeldSegmenter *s)
{
  s->cell = celd_alloc (s->basins.n, sizeof *s->cell);
  if (!s->cell)
    return CELD_NO_MEMORY;
  memcpy (s->cell, s->basins.piece, s->basins.n * sizeof *s->cell);
  return CELD_OK;
}

/* The same for ink without bridges: they are drawn on a copy. */
static CeldStatus
make_bridged_basins (CeldSegmenter *s, const CeldPlane *ink, CeldRect *changed, float threshold, const CeldHost *host)
{
  CeldHostPart    part[2];
  CeldHost    find = celd_host_part (&part[0], host, 0, 0.2), make = celd_host_part (&part[1], host, 0.2, 1);
  CeldBridges bridges = { 0 };
  CeldPlane   copy = { 0 };
  CeldStatus  status = celd_bridges_find (ink, celd_stroke_width (ink), &find, &bridges);

  if (status == CELD_OK && changed)
    status = celd_bridges_compare (&s->bridges, &bridges, changed);
  if (status == CELD_OK && bridges.n)
    status = celd_plane_new (ink->width, ink->height, &copy);
  for (int y = 0; y < ink->height && copy.data; y++)
    memcpy (&CELD_AT (&copy, 0, y), &CELD_AT (ink, 0, y), (size_t) ink->width * sizeof *copy.data);
  if (status == CELD_OK && bridges.n)
    celd_bridges_draw (&bridges, &copy);
  if (status == CELD_OK)
    status = make_basins (s, bridges.n ? &copy : ink, changed, threshold, &make);
  if (status == CELD_OK && bridges.n)
    status = keep_cells (s);
  if (status == CELD_OK)
    status = celd_bridges_join (&bridges, ink, &s->basins);
  celd_free (copy.data);
  if (status != CELD_OK)
    {
      celd_bridges_clear (&bridges);
      return status;
    }
  celd_bridges_clear (&s->bridges);
  s->bridges = bridges;
  return CELD_OK;
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
    status = make_bridged_basins (s, ink, renew ? &rect : NULL, threshold, host);
  else
    {
      celd_bridges_clear (&s->bridges);
      status = make_basins (s, ink, renew ? &rect : NULL, threshold, host);
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

/* The seeds that the palette knows, and its labels without what an earlier answer said of them. */
static CeldStatus
canvas_new (CeldSegmenter *s, const CeldSeedRows *seeds, const CeldPalette *palette, const CeldSettings *settings,
            CeldCanvas *canvas)
{
  CeldStatus status;

  *canvas = (CeldCanvas) {
    .settings = settings, .ink = &s->ink, .basins = &s->basins, .bridges = &s->bridges, .cell = s->cell,
    .kept = &s->spread
  };
  status = celd_seed_rows_copy (seeds, &canvas->seeds);
  for (size_t k = 0; k < palette->n && status == CELD_OK; k++)
    {
      CeldRegion region = palette->item[k];
      uint32_t   label;

      region.seeds      = 0;
      region.background = false;
      status = celd_canvas_add (canvas, region, &label);
    }
  for (int y = 0; y < seeds->height && status == CELD_OK; y++)
    for (size_t i = 0; i < seeds->row[y].n && status == CELD_OK; i++)
      {
        const CeldSeedRun *run = &seeds->row[y].run[i];

        if (run->label <= palette->n)
          canvas->palette.item[run->label - 1].seeds += (size_t) (run->end - run->x);
        else
          status = celd_seed_rows_paint (&canvas->seeds, y, run->x, run->end, 0);
      }
  return status;
}

static void
canvas_clear (CeldCanvas *canvas)
{
  celd_seed_rows_clear (&canvas->seeds);
  celd_spread_clear (&canvas->painted);
  celd_palette_clear (&canvas->palette);
  celd_free (canvas->reached);
}

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

static void
count_arrow_seeds (CeldCanvas *canvas)
{
  for (int y = 0; y < canvas->seeds.height; y++)
    for (size_t i = 0; i < canvas->seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &canvas->seeds.row[y].run[i];

        if (canvas->palette.item[run->label - 1].origin == CELD_FROM_ARROW)
          canvas->palette.item[run->label - 1].seeds += (size_t) (run->end - run->x);
      }
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
      count_arrow_seeds (canvas);
      status = celd_segment_report (canvas, seeds, &s->painting, labels, &last, problems);
    }
  return status;
}

CeldStatus
celd_segmenter_solve (CeldSegmenter *segmenter, const CeldSeedRows *seeds, const CeldRelations *relations,
                      const CeldSettings *settings, const CeldHost *host, CeldPalette *palette, CeldProblems *problems,
                      CeldLabels *labels, CeldRect *changed)
{
  CeldCanvas   canvas = { 0 };
  CeldProblems found = { 0 };
  size_t       before = problems ? problems->n : 0;
  CeldStatus   status = celd_settings_check (settings);

  if (status == CELD_OK)
    status = canvas_new (segmenter, seeds, palette, settings, &canvas);
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
  canvas_clear (&canvas);
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
