/* What the steps of the segmentation share: the picture that celd_segment works on, and where paint lies on it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEGMENT_H
#define CELD_SEGMENT_H

#include "private.h"

typedef struct
{
  const CeldSettings *settings;
  const CeldPlane    *ink;
  int                 width, height;
  size_t              n;        /* pixels */
  int                 stroke;   /* width of the drawing's strokes */
  CeldLabels          seeds;    /* painted labels, and those that arrows and the frame add; tight */
  CeldLabels          labels;   /* the result; tight */
  CeldLabels          pieces;   /* closed pieces of paper from 1; 0 = ink; tight */
  CeldLabels          rooms;    /* the same, but parted where a contour has a small gap */
  size_t              n_pieces, n_rooms;
  int32_t            *east, *south; /* V_pq */
  int32_t             soft_vote; /* cost of a pixel of a soft stroke with another label */
  CeldPalette         palette;  /* of all labels so far */
} CeldCanvas;

/* Is every stroke obeyed, wherever it runs? */
static inline bool
celd_canvas_obeys (const CeldCanvas *canvas)
{
  return canvas->settings->flats || canvas->settings->hardness >= 1;
}

/* One more label, without seeds so far: *label is its number. */
CeldStatus celd_canvas_add (CeldCanvas *canvas, CeldRegion region, uint32_t *label);

/* ------------------------------------------------------------------ rooms.c */

/* Fills in pieces, rooms and their numbers. */
CeldStatus celd_rooms (const CeldRun *run, CeldCanvas *canvas);

/* ------------------------------------------------------------------ paint.c: where strokes lie */

/* What a connected stroke of one label leaves in one piece, or one room. */
typedef struct { uint32_t piece, label, stroke; size_t pixels; bool stain; } CeldShare;

typedef struct
{
  CeldLabels strokes;           /* connected strokes from 1; 0 = no paint */
  size_t    *total;             /* of stroke k: its pixels on paper, total[k] */
  CeldShare *share;             /* by piece, label, stroke */
  size_t     n;
} CeldSpread;

/* `pieces` are the canvas' pieces or rooms. */
CeldStatus celd_spread_new (const CeldCanvas *canvas, const CeldLabels *pieces, const CeldRun *run, CeldSpread *spread);
void       celd_spread_clear (CeldSpread *spread);

/* Takes back the seeds where a stroke ran on through a contour into a piece that other paint holds. */
CeldStatus celd_stains_remove (const CeldRun *run, CeldCanvas *canvas);

/* ------------------------------------------------------------------ background.c */

/* Seeds along the frame where nothing reaches; marks the background in the palette. */
CeldStatus celd_background_seed (const CeldRun *run, CeldCanvas *canvas);

/* ------------------------------------------------------------------ seeds.c: arrows as strokes */

/* Seeds for each end of a relation that lies in a room which nothing reaches. */
CeldStatus celd_seeds_plant (const CeldRelations *relations, const CeldRun *run, CeldCanvas *canvas);

/* Splits regions in which both ends of an inequality lie. */
CeldStatus celd_seeds_split (const CeldRelations *relations, const CeldRun *run, CeldCanvas *canvas);

/* ------------------------------------------------------------------ segment.c */

/* The vote of a label, as celd_multiway wants it. */
int32_t celd_canvas_vote (const CeldCanvas *canvas, uint32_t label);

/* ------------------------------------------------------------------ report.c */

/* `seeds` are those that the artist painted. */
CeldStatus celd_segment_report (const CeldCanvas *canvas, const CeldLabels *seeds, const CeldRun *run,
                                CeldProblems *problems);

#endif
