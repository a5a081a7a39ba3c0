/* What the steps of the segmentation share: the drawing's basins, the seeds on them, and who has paint where.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TASK_H
#define CELD_TASK_H

#include "image/image.h"
#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/labelling.h"

/* ------------------------------------------------------------------ records */

/* What a connected stroke of one label leaves on the paper of one part of the drawing. */
typedef struct { uint32_t part, label, stroke; size_t pixels; bool spill; } CeldStrokeOverlap;

/* A piece of a run of seeds that lies in one basin; ink and paper.  `stroke`: connected strokes from 0. */
typedef struct { int32_t y, x, end; uint32_t label, basin, stroke; uint32_t paper; } CeldStrokePiece;

typedef struct
{
  CeldStrokePiece   *piece;     /* in reading order */
  size_t             n_pieces;
  size_t            *total;     /* of stroke k: its pixels on paper */
  size_t             n_strokes;
  CeldStrokeOverlap *overlap;   /* by part, label, stroke; without part 0 */
  size_t             n;
} CeldStrokes;

typedef struct
{
  const CeldSettings *settings;
  const CeldPlane    *ink;
  const CeldBasins   *basins;
  const CeldBridges  *bridges;
  const uint32_t     *bridged_component; /* pieces, parted by bridges too; NULL: the same as pieces */
  CeldSeedRows        seeds;             /* painted ones, and those that arrows and the frame add */
  CeldPalette         palette;           /* of all labels so far */
  int32_t             soft_cost;         /* cost of a pixel of a soft stroke with another label */
  CeldStrokes         painted;           /* where seeds lay before stains were taken back; empty before they are looked for */
  bool                spilled;           /* and some have been taken back */
  bool               *seeded;            /* by room: does a seed lie on its paper?  NULL before arrows have planted any */
  size_t              n_effective;       /* relations from the first to the last that planted or split anything */
  CeldStrokes        *kept;              /* of seeds that the last answer for these basins was made from; NULL: none is kept */
} CeldSegmentTask;

/* Is every stroke obeyed, wherever it runs? */
static inline bool
celd_task_all_hard (const CeldSegmentTask *task)
{
  return task->settings->flats || task->settings->hardness >= 1;
}

/* ------------------------------------------------------------------ canvas.c */

/* The seeds that the palette knows, and its labels without what an earlier answer said of them, on a canvas that has
 * its settings, drawing and basins; to be cleared also after a failure. */
CeldStatus celd_task_new (const CeldSeedRows *seeds, const CeldPalette *palette, CeldSegmentTask *task);
void       celd_task_clear (CeldSegmentTask *task);

/* One more label, without seeds so far: *label is its number. */
CeldStatus celd_task_add_label (CeldSegmentTask *task, CeldRegion region, uint32_t *label);

/* One more label for an arrow's end, of a colour that is far from all others. */
CeldStatus celd_task_add_arrow_label (CeldSegmentTask *task, uint32_t *label);

/* Enters the seeds of labels that arrows made into the palette. */
void celd_task_count_arrow_seeds (CeldSegmentTask *task);

/* What a seed's pixel costs with another label: CELD_HARD where it must be obeyed. */
int32_t celd_task_data_cost (const CeldSegmentTask *task, uint32_t label);

/* Fills in soft_vote from the seeds that the artist painted: call it before anything else adds some. */
void celd_task_set_soft_cost (CeldSegmentTask *task);

/* Labels by falling paint: most of the picture is decided first, and later cuts are small. */
CeldStatus celd_task_label_order (const CeldSegmentTask *task, uint32_t *order);

/* In a flat colouring the ink lines may be painted too: takes these seeds back. */
CeldStatus celd_task_drop_ink_seeds (CeldSegmentTask *task);

/* ------------------------------------------------------------------ paint.c: where strokes lie */

/* part[basin] is the part it belongs to: basins->piece, room or block; NULL: no shares. */
CeldStatus celd_strokes_new (const CeldSegmentTask *task, const uint32_t *part, CeldStrokes *strokes);
void       celd_strokes_clear (CeldStrokes *strokes);

/* Ends a spread: the canvas keeps it, if it keeps any. */
void celd_strokes_keep (const CeldSegmentTask *task, CeldStrokes *strokes);

/* Makes the shares anew, by other parts. */
CeldStatus celd_strokes_overlap (const CeldBasins *basins, const uint32_t *part, CeldStrokes *strokes);

/* Takes back the seeds of a dab that lie on paper. */
CeldStatus celd_stroke_piece_remove (CeldSegmentTask *task, const CeldStrokePiece *piece);

/* Takes back the seeds where a stroke ran on through a contour into a piece that other paint holds. */
CeldStatus celd_spills_remove (const CeldHost *host, CeldSegmentTask *task);

/* ------------------------------------------------------------------ background.c */

/* Seeds along the frame where nothing reaches; marks the background in the palette. */
CeldStatus celd_background_seed (const CeldHost *host, CeldSegmentTask *task);

/* ------------------------------------------------------------------ seeds.c: arrows as strokes */

/* Seeds for each end of a relation that lies in a room which nothing reaches; canvas->reached says which those are. */
CeldStatus celd_arrow_seeds_add (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task);

/* Does an end of the relation lie in such a room? */
bool       celd_arrow_seeds_needed (const CeldSegmentTask *task, const CeldRelation *relation);

/* split.c: splits regions of `labels` in which both ends of an inequality lie, unless both are under hard strokes: what
 * is under these keeps its label.  What changes is appended to the patches, no pixel twice among them, and the discs of
 * both ends to the canvas' seeds. */
CeldStatus celd_regions_split (const CeldRelations *relations, const CeldHost *host, const CeldLabels *labels,
                               CeldSegmentTask *task, CeldPatches *patches);

/* Has it nothing to split for the relation, whose ends are settled: not on any of the patches? */
bool       celd_regions_are_separate (const CeldSegmentTask *task, const CeldRelation *relation,
                                      const CeldLabels *labels,
                                      const CeldPatches *patches);

/* ------------------------------------------------------------------ exact.c, graph.c: the labels of lowest energy */

/* Of every pixel; `labels` is tight. */
CeldStatus celd_lazybrush_solve (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels);

/* walker.c: of every pixel, those that a random walker likely reaches first; `labels` is tight. */
CeldStatus celd_random_walker_solve (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels);

/* Of every basin. */
CeldStatus celd_basin_graph_solve (const CeldSegmentTask *task, const CeldHost *host, uint32_t *label);

/* ------------------------------------------------------------------ windows.c: conflicts, solved on pixels */

/* label[basin] is the answer of the basin graph.  Where a stroke lies in a basin that has another label, the basin is
 * told apart pixel by pixel, in a window round the strokes, with everything outside as it is.  Hard seeds are always
 * obeyed; soft ones where that lowers the energy. */
CeldStatus celd_windows_solve (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host,
                               CeldPatches *patches);

/* ------------------------------------------------------------------ settle.c: borders of least energy */

/* Moves the borders between `labels`, which are what basins and windows make, to where they cost less: in lines, and
 * across gaps.  The pixels that change sides are painted, and appended to the patches; after a failure some are painted
 * that are in no patch. */
CeldStatus celd_boundaries_refine (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels,
                                   CeldPatches *patches);

/* ------------------------------------------------------------------ closures.c: gaps as a person would close them */

/* `labels` is what basins and windows make.  Where two labels meet on paper, from one line end to another, the border
 * is redrawn as a curve that continues the lines: the closures, and the pixels that change sides.  No seed gets another
 * label by this.  Makes both records. */
CeldStatus celd_closures_find (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels,
                               const CeldPatches *windows, const CeldHost *host, CeldClosures *closures,
                               CeldPatches *patches);

/* ------------------------------------------------------------------ report.c */

/* `seeds` are those that the artist painted, `labels` the result, `painting` what is known of it. */
CeldStatus celd_segment_report (const CeldSegmentTask *task, const CeldSeedRows *seeds, const CeldLabelling *labelling,
                                const CeldLabels *labels, const CeldHost *host, CeldProblems *problems);

#endif
