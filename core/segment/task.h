/* The task that the steps of a segmentation work on: the drawing's basins, the seeds, and which stroke lies where.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TASK_H
#define CELD_TASK_H

#include "image/image.h"
#include "segment/basins.h"
#include "segment/bridges.h"

/* ------------------------------------------------------------------ labelling.c: labels of basins, and patches */

typedef struct { int32_t y, x, end; uint32_t label; } CeldPatch; /* pixels x .. end - 1 of row y have this label */
typedef struct { CeldPatch *item; size_t n, item_capacity; } CeldPatches; /* no pixel twice in one record */

CeldStatus celd_patch_add (CeldPatches *patches, CeldPatch patch);
void       celd_patches_clear (CeldPatches *patches);             /* accepts a zeroed record */

typedef struct
{
  uint32_t   *label;    /* of each basin; 0: unknown, to be painted */
  CeldPatches patches;  /* in reading order */
  CeldRect    changed;  /* bounding box of all changes not reported so far */
} CeldLabelling;

void celd_labelling_clear (CeldLabelling *labelling);               /* accepts a zeroed record */

/* Prepares for the basins of a new drawing: nothing counts as painted.  `changed` is kept. */
CeldStatus celd_labelling_reset (CeldLabelling *labelling, const CeldBasins *basins);

/* Call it after a failure between begin and end: the picture's content is unknown then, and all of it counts as
 * changed. */
void celd_labelling_invalidate (CeldLabelling *labelling, const CeldBasins *basins);

/* A new labelling is painted over the old one, in `labels`, in three steps.  Begin: paints the basins and removes old
 * patches; takes ownership of `label`, and moves the old labelling to *old, which the caller clears.  Add: paints
 * patches, one over the other.  End: sorts the patches and adds to `changed` what differs from *old.  After a failure
 * call celd_labelling_invalidate. */
void       celd_labelling_begin (CeldLabelling *labelling, const CeldBasins *basins, uint32_t *label,
                                 CeldLabels *labels, CeldLabelling *old);
CeldStatus celd_labelling_add   (CeldLabelling *labelling, const CeldPatches *patches, CeldLabels *labels);
CeldStatus celd_labelling_end   (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabelling *old,
                                 const CeldLabels *labels);

/* Copies a whole picture over the old one, and adds what differs to `changed`; no basin counts as painted
 * afterwards. */
CeldStatus celd_labelling_replace (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *from,
                                   CeldLabels *labels);

/* Fills in the area of each label, and its pixel farthest from ink, as well as that is known from maxima; -1,-1 for
 * labels without a pixel. */
CeldStatus celd_labelling_measure (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels,
                                   CeldPalette *palette);

/* ------------------------------------------------------------------ records */

/* How many pixels of paper a connected stroke covers in one part of the drawing (a component, enclosure or merged
 * basin).  `odds` of being meant for it, 1 if they are just enough, and `spill`: see spills.c; 0 until spills are
 * sought. */
typedef struct { uint32_t part, label, stroke; size_t pixels; double odds; bool spill; } CeldStrokeOverlap;

/* The pixels x .. end - 1 of row y, of one stroke and in one basin.  `paper`: how many of them are paper.  `stroke`:
 * connected strokes are numbered from 0. */
typedef struct { int32_t y, x, end; uint32_t label, basin, stroke; uint32_t paper; } CeldStrokePiece;

typedef struct
{
  CeldStrokePiece   *piece;     /* in reading order */
  size_t             n_pieces;
  size_t            *total;     /* of stroke k: its pixels of paper */
  size_t            *in_cores;  /* of stroke k: its pixels of ink in solid basins */
  size_t             n_strokes;
  CeldStrokeOverlap *overlap;   /* by part, label, stroke; ink alone (part 0) is left out */
  size_t             n;
  size_t             piece_capacity, overlap_capacity;
} CeldStrokes;

typedef struct
{
  const CeldSettings *settings;
  const CeldPlane    *ink;
  const CeldBasins   *basins;
  const CeldBridges  *bridges;
  const uint32_t     *bridged_component; /* of each basin: its component with bridges as lines; NULL: none */
  CeldSeedRows        seeds;             /* painted ones, and those added for arrows and the frame */
  CeldPalette         palette;           /* of all labels so far */
  int32_t             soft_cost;         /* data cost of a pixel of a soft stroke */
  double              brush;             /* mean width of the artist's strokes, in pixels */
  CeldStrokes         painted;           /* the strokes before spills were removed; empty until then */
  bool                spilled;           /* has a spill been removed? */
  bool               *seeded;            /* of each enclosure: is there a seed on its paper?  NULL without arrows */
  bool               *unpainted;         /* of each enclosure: has it seeds of a painted background along the frame, and
                                          * nothing else?  NULL: none has */
  size_t              n_effective;       /* relations up to the last one that added seeds, split a region or ruled out a
                                          * background */
  CeldStrokes        *kept;              /* strokes of the last solve, to be reused; NULL: none are kept */
} CeldSegmentTask;

/* Are all strokes hard, and obeyed even where they run over a contour? */
static inline bool
celd_task_all_hard (const CeldSegmentTask *task)
{
  return task->settings->flats || task->settings->hardness >= 1;
}

/* ------------------------------------------------------------------ task.c */

/* Fills in seeds and palette of a task whose settings, drawing and basins are set: the seeds whose label is in the
 * palette, and the labels without results of an earlier solve.  Clear the task also after a failure. */
CeldStatus celd_task_new (const CeldSeedRows *seeds, const CeldPalette *palette, CeldSegmentTask *task);
void       celd_task_clear (CeldSegmentTask *task);

/* Appends a label without seeds; *label is its number. */
CeldStatus celd_task_add_label (CeldSegmentTask *task, CeldRegion region, uint32_t *label);

/* Appends an opaque label for an arrow's end, of a colour far from all others. */
CeldStatus celd_task_add_arrow_label (CeldSegmentTask *task, uint32_t *label);

/* Adds the pixels of seeds that arrows made to the palette's counts. */
void celd_task_count_arrow_seeds (CeldSegmentTask *task);

/* Data cost: what a pixel of a seed costs if it gets another label; CELD_HARD where the seed must be obeyed. */
int32_t celd_task_data_cost (const CeldSegmentTask *task, uint32_t label);

/* Computes soft_cost and brush from the seeds that the artist painted: must be called before any seeds are added. */
void celd_task_set_soft_cost (CeldSegmentTask *task);

/* All labels by the number of their seeds, the largest first: most of the picture is decided early, so later cuts are
 * small. */
CeldStatus celd_task_label_order (const CeldSegmentTask *task, uint32_t *order);

/* In a flat colouring ink lines may be painted over, too: removes the seeds there, unless a label has a whole dark
 * area. */
CeldStatus celd_task_drop_ink_seeds (CeldSegmentTask *task);

/* ------------------------------------------------------------------ strokes.c: where strokes lie */

/* The strokes of the task's seeds; makes the record. part[basin] says which part a basin belongs to: basins->component,
 * enclosure or merged; NULL: no overlaps are computed. */
CeldStatus celd_strokes_new (const CeldSegmentTask *task, const uint32_t *part, CeldStrokes *strokes);
void       celd_strokes_clear (CeldStrokes *strokes);

/* Computes `total` and `in_cores`, which have room for n_strokes. */
void celd_strokes_sum (const CeldBasins *basins, CeldStrokes *strokes);

/* severed-strokes.c: makes one stroke of those that other paint or ink cut in two.  Overlaps are not updated. */
CeldStatus celd_strokes_join_severed (const CeldSegmentTask *task, CeldStrokes *strokes);

/* Clears *strokes, or moves them to task->kept if the task keeps any. */
void celd_strokes_keep (const CeldSegmentTask *task, CeldStrokes *strokes);

/* Computes the overlaps with these parts in place of the present ones. */
CeldStatus celd_strokes_overlap (const CeldBasins *basins, const uint32_t *part, CeldStrokes *strokes);

/* The order of overlaps: by part, label, stroke; for qsort and bsearch. */
int celd_stroke_overlap_compare (const void *a, const void *b);

/* ------------------------------------------------------------------ spills.c */

/* Removes the seeds of a stroke piece that lie on paper. */
CeldStatus celd_stroke_piece_remove (CeldSegmentTask *task, const CeldStrokePiece *piece);

/* Removes the seeds where a soft stroke ran on through a contour onto a component that is mostly painted otherwise, or
 * into a solid area; fills in task->painted. */
CeldStatus celd_spills_remove (const CeldHost *host, CeldSegmentTask *task);

/* Is this piece of task->painted a spill? */
bool celd_stroke_piece_is_spill (const CeldSegmentTask *task, const CeldStrokePiece *piece);

/* ------------------------------------------------------------------ background.c */

/* Adds seeds along the frame where no stroke reaches, and marks the background in the palette.  No label is the
 * background that a relation (NULL: there are none) puts in front of something. */
CeldStatus celd_background_seed (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task);

/* ------------------------------------------------------------------ arrow-seeds.c and split.c: arrows as strokes */

/* Adds seeds for each end of a relation that lies in an enclosure without any; fills in task->seeded. */
CeldStatus celd_arrow_seeds_add (const CeldRelations *relations, const CeldHost *host, CeldSegmentTask *task);

/* Does an end of the relation lie in an enclosure without seeds? */
bool       celd_arrow_seeds_needed (const CeldSegmentTask *task, const CeldRelation *relation);

/* Splits the regions of `labels` in which both ends of an inequality lie, unless both are under hard strokes; pixels
 * under hard strokes keep their labels.  The changed pixels are appended to the patches, each once, and the discs of
 * both ends are added to the task's seeds.  After a failure the patches are as before. */
CeldStatus celd_regions_split (const CeldRelations *relations, const CeldHost *host, const CeldLabels *labels,
                               CeldSegmentTask *task, CeldPatches *patches);

/* Is there nothing to split for the relation?  False if an end lies on one of the patches, where labels changed after
 * regions were split. */
bool       celd_regions_are_separate (const CeldSegmentTask *task, const CeldRelation *relation,
                                      const CeldLabels *labels, const CeldPatches *patches);

/* ------------------------------------------------------------------ pinches.c: parts of one region */

/* Two basins that are probably one region, and how weak the ink between them is as a barrier: as 4096 or 1024 pixels of
 * the thinnest line (chosen). */
typedef struct { uint32_t a, b; int64_t weakness; } CeldPinch;

#define CELD_PINCH_CORNER   ((int64_t) 1 << 22) /* they touch at a corner */
#define CELD_PINCH_MERGED   ((int64_t) 1 << 20) /* the lines between them are one over some pixels */

/* Lists the pinches of the basins with wanted[basin], in drawings with lines up to two pixels wide; others have none.
 * A pair of basins may be listed several times.  To be freed with celd_free; CELD_NO_MEMORY is the only failure. */
CeldStatus celd_pinches_find (const CeldPlane *ink, const CeldBasins *basins, const bool *wanted, CeldPinch **pinch,
                              size_t *n);

/* ------------------------------------------------------------------ unpainted-basins.c: basins without paint */

/* Gives the nodes without paint the label behind the weakest barrier.  node[k] < n is that of basin k, fixed[k] the
 * label of node k, or 0 if it has no paint; `order` is by celd_task_label_order.  label[k] becomes that of node k. */
CeldStatus celd_unpainted_solve (const CeldSegmentTask *task, const uint32_t *node, size_t n, const uint32_t *fixed,
                                 const uint32_t *order, const CeldHost *host, uint32_t *label);

/* ------------------------------------------------------------------ solve-pixels.c, solve-basins.c */

/* The labels of all pixels by greedy cuts of LazyBrush [SDC09b]; `labels` is tight. */
CeldStatus celd_lazybrush_solve (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels);

/* The labels of all pixels by a random walker [Gra06]; `labels` is tight. */
CeldStatus celd_random_walker_solve (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels);

/* The label of every basin, by cuts on the graph of basins; label[n] has room for all basins. */
CeldStatus celd_basin_graph_solve (const CeldSegmentTask *task, const CeldHost *host, uint32_t *label);

/* ------------------------------------------------------------------ solve-windows.c: misplaced strokes, solved on
 * pixels */

/* label[basin] is the result of celd_basin_graph_solve.  Where a stroke lies in a basin with another label, the pixels
 * of that basin are labelled one by one in a window round the stroke, with everything outside fixed.  Hard seeds are
 * always obeyed, soft ones where that lowers the energy.  Appends the pixels whose label differs from their basin's;
 * after a failure the patches are as before. */
CeldStatus celd_windows_solve (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host,
                               CeldPatches *patches);

/* Where a boundary between two labels crosses paper, the energy is minimised on pixels: in a window that has room for
 * the line ends on both sides, with everything outside fixed.  Changes `labels` where that lowers the energy, and
 * appends the changed pixels, also those before a failure.  `to_paper`: celd_distance_to_paper. */
CeldStatus celd_gaps_solve (const CeldSegmentTask *task, const int32_t *to_paper, const CeldHost *host,
                            CeldLabels *labels, CeldPatches *patches);

/* ------------------------------------------------------------------ refine-boundaries.c: boundaries of lower energy */

/* Moves the boundaries between `labels` in place to where the energy is lower, within lines and across gaps.  Appends
 * the pixels that changed; after a failure some changed pixels are missing from the patches. */
CeldStatus celd_boundaries_refine (const CeldSegmentTask *task, const CeldHost *host, CeldLabels *labels,
                                   CeldPatches *patches);

/* ------------------------------------------------------------------ closures.c: gaps closed by curves */

/* `label` are the labels of the basins, and `labels` those with the patches `windows` on top.  Where two labels meet on
 * paper between two line ends, the boundary is redrawn as a curve that continues the lines.  Returns the closures and
 * the pixels that change sides (makes both records); no seed changes its label. */
CeldStatus celd_closures_find (const CeldSegmentTask *task, const uint32_t *label, const CeldLabels *labels,
                               const CeldPatches *windows, const CeldHost *host, CeldClosures *closures,
                               CeldPatches *patches);

/* ------------------------------------------------------------------ problems.c */

/* Appends what the artist should know.  `seeds` are those that the artist painted, `labels` the result, described by
 * `labelling`. */
CeldStatus celd_segment_report (const CeldSegmentTask *task, const CeldSeedRows *seeds, const CeldLabelling *labelling,
                                const CeldLabels *labels, const CeldHost *host, CeldProblems *problems);

#endif
