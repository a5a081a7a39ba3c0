/* What the steps of the segmentation share: the drawing's basins, the seeds on them, and who has paint where.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_CANVAS_H
#define CELD_CANVAS_H

#include "image/image.h"
#include "segment/basins.h"
#include "segment/bridges.h"
#include "segment/painting.h"

/* ------------------------------------------------------------------ records */

/* What a connected stroke of one label leaves on the paper of one part of the drawing. */
typedef struct { uint32_t part, label, stroke; size_t pixels; bool stain; } CeldShare;

/* A piece of a run of seeds that lies in one basin; ink and paper.  `stroke`: connected strokes from 0. */
typedef struct { int32_t y, x, end; uint32_t label, basin, stroke; uint32_t paper; } CeldDab;

typedef struct
{
  CeldDab   *dab;               /* in reading order */
  size_t     n_dabs;
  size_t    *total;             /* of stroke k: its pixels on paper */
  size_t     n_strokes;
  CeldShare *share;             /* by part, label, stroke; without part 0 */
  size_t     n;
} CeldSpread;

typedef struct
{
  const CeldSettings *settings;
  const CeldPlane    *ink;
  const CeldBasins   *basins;
  const CeldBridges  *bridges;
  const uint32_t     *cell;      /* pieces, parted by bridges too; NULL: the same as pieces */
  CeldSeedRows        seeds;     /* painted ones, and those that arrows and the frame add */
  CeldPalette         palette;   /* of all labels so far */
  int32_t             soft_vote; /* cost of a pixel of a soft stroke with another label */
  CeldSpread          painted;   /* where seeds lay before stains were taken back; empty before they are looked for */
  bool                stained;   /* and some have been taken back */
  bool               *reached;   /* by room: does a seed lie on its paper?  NULL before arrows have planted any */
  size_t              acting;    /* relations from the first to the last that planted or split anything */
  CeldSpread         *kept;      /* of seeds that the last answer for these basins was made from; NULL: none is kept */
} CeldCanvas;

/* Is every stroke obeyed, wherever it runs? */
static inline bool
celd_canvas_obeys (const CeldCanvas *canvas)
{
  return canvas->settings->flats || canvas->settings->hardness >= 1;
}

/* ------------------------------------------------------------------ canvas.c */

/* The seeds that the palette knows, and its labels without what an earlier answer said of them, on a canvas that has
 * its settings, drawing and basins; to be cleared also after a failure. */
CeldStatus celd_canvas_new (const CeldSeedRows *seeds, const CeldPalette *palette, CeldCanvas *canvas);
void       celd_canvas_clear (CeldCanvas *canvas);

/* One more label, without seeds so far: *label is its number. */
CeldStatus celd_canvas_add (CeldCanvas *canvas, CeldRegion region, uint32_t *label);

/* One more label for an arrow's end, of a colour that is far from all others. */
CeldStatus celd_hue_add (CeldCanvas *canvas, uint32_t *label);

/* Enters the seeds of labels that arrows made into the palette. */
void celd_canvas_count_arrow_seeds (CeldCanvas *canvas);

/* What a seed's pixel costs with another label: CELD_HARD where it must be obeyed. */
int32_t celd_canvas_vote (const CeldCanvas *canvas, uint32_t label);

/* Fills in soft_vote from the seeds that the artist painted: call it before anything else adds some. */
void celd_canvas_weigh (CeldCanvas *canvas);

/* Labels by falling paint: most of the picture is decided first, and later cuts are small. */
CeldStatus celd_canvas_order (const CeldCanvas *canvas, uint32_t *order);

/* In a flat colouring the ink lines may be painted too: takes these seeds back. */
CeldStatus celd_canvas_keep_paper (CeldCanvas *canvas);

/* ------------------------------------------------------------------ paint.c: where strokes lie */

/* part[basin] is the part it belongs to: basins->piece, room or block; NULL: no shares. */
CeldStatus celd_spread_new (const CeldCanvas *canvas, const uint32_t *part, CeldSpread *spread);
void       celd_spread_clear (CeldSpread *spread);

/* Ends a spread: the canvas keeps it, if it keeps any. */
void celd_spread_keep (const CeldCanvas *canvas, CeldSpread *spread);

/* Makes the shares anew, by other parts. */
CeldStatus celd_spread_share (const CeldBasins *basins, const uint32_t *part, CeldSpread *spread);

/* Takes back the seeds of a dab that lie on paper. */
CeldStatus celd_dab_remove (CeldCanvas *canvas, const CeldDab *dab);

/* Takes back the seeds where a stroke ran on through a contour into a piece that other paint holds. */
CeldStatus celd_stains_remove (const CeldHost *host, CeldCanvas *canvas);

/* ------------------------------------------------------------------ background.c */

/* Seeds along the frame where nothing reaches; marks the background in the palette. */
CeldStatus celd_background_seed (const CeldHost *host, CeldCanvas *canvas);

/* ------------------------------------------------------------------ seeds.c: arrows as strokes */

/* Seeds for each end of a relation that lies in a room which nothing reaches; canvas->reached says which those are. */
CeldStatus celd_seeds_plant (const CeldRelations *relations, const CeldHost *host, CeldCanvas *canvas);

/* Does an end of the relation lie in such a room? */
bool       celd_seeds_wanted (const CeldCanvas *canvas, const CeldRelation *relation);

/* split.c: splits regions of `labels` in which both ends of an inequality lie, unless both are under hard strokes: what
 * is under these keeps its label.  What changes is appended to the patches, no pixel twice among them, and the discs of
 * both ends to the canvas' seeds. */
CeldStatus celd_seeds_split (const CeldRelations *relations, const CeldHost *host, const CeldLabels *labels,
                             CeldCanvas *canvas, CeldPatches *patches);

/* Has it nothing to split for the relation, whose ends are settled: not on any of the patches? */
bool       celd_seeds_apart (const CeldCanvas *canvas, const CeldRelation *relation, const CeldLabels *labels,
                             const CeldPatches *patches);

/* ------------------------------------------------------------------ exact.c, graph.c: the labels of lowest energy */

/* Of every pixel; `labels` is tight. */
CeldStatus celd_exact_solve (const CeldCanvas *canvas, const CeldHost *host, CeldLabels *labels);

/* walker.c: of every pixel, those that a random walker likely reaches first; `labels` is tight. */
CeldStatus celd_walker_solve (const CeldCanvas *canvas, const CeldHost *host, CeldLabels *labels);

/* Of every basin. */
CeldStatus celd_graph_solve (const CeldCanvas *canvas, const CeldHost *host, uint32_t *label);

/* ------------------------------------------------------------------ windows.c: conflicts, solved on pixels */

/* label[basin] is the answer of the basin graph.  Where a stroke lies in a basin that has another label, the basin is
 * told apart pixel by pixel, in a window round the strokes, with everything outside as it is.  Hard seeds are always
 * obeyed; soft ones where that lowers the energy. */
CeldStatus celd_windows_solve (const CeldCanvas *canvas, const uint32_t *label, const CeldHost *host,
                               CeldPatches *patches);

/* ------------------------------------------------------------------ settle.c: borders of least energy */

/* Moves the borders between `labels`, which are what basins and windows make, to where they cost less: in lines, and
 * across gaps.  The pixels that change sides are painted, and appended to the patches; after a failure some are painted
 * that are in no patch. */
CeldStatus celd_borders_settle (const CeldCanvas *canvas, const CeldHost *host, CeldLabels *labels,
                                CeldPatches *patches);

/* ------------------------------------------------------------------ closures.c: gaps as a person would close them */

/* `labels` is what basins and windows make.  Where two labels meet on paper, from one line end to another, the border
 * is redrawn as a curve that continues the lines: the closures, and the pixels that change sides.  No seed gets another
 * label by this.  Makes both records. */
CeldStatus celd_closures_find (const CeldCanvas *canvas, const uint32_t *label, const CeldLabels *labels,
                               const CeldPatches *windows, const CeldHost *host, CeldClosures *closures,
                               CeldPatches *patches);

/* ------------------------------------------------------------------ report.c */

/* `seeds` are those that the artist painted, `labels` the result, `painting` what is known of it. */
CeldStatus celd_segment_report (const CeldCanvas *canvas, const CeldSeedRows *seeds, const CeldPainting *painting,
                                const CeldLabels *labels, const CeldHost *host, CeldProblems *problems);

#endif
