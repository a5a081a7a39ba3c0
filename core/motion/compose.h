/* The inside of CeldComposition.
 *
 *   placement.c       similarities
 *   resample.c        which regions of which drawings a pixel of the composition shows, and how much of each
 *   overlaps.c        which regions of different drawings lie over each other
 *   fragment-graph.c  the regions of all drawings as one graph, with all relations
 *   fragment-order.c  the order of the regions of all drawings
 *   compose.c         the composition, as a picture and as layers
 *   compose-levels.c  two pictures of which levels are known
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_COMPOSE_H
#define CELD_COMPOSE_H

#include "motion/page-strokes.h"

#include <math.h>

/* ------------------------------------------------------------------ placement.c */

/* (x,y) goes to (xx x + xy y + x0, yx x + yy y + y0). */
typedef struct { double xx, xy, x0, yx, yy, y0; } CeldSimilarity;

static inline void
celd_similarity_map (const CeldSimilarity *s, double x, double y, double place[2])
{
  place[0] = s->xx * x + s->xy * y + s->x0;
  place[1] = s->yx * x + s->yy * y + s->y0;
}

/* How a drawing of this size gets to its place, and back.  CELD_BAD_VALUE for numbers out of range. */
CeldStatus celd_placement_read (const CeldPlacement *placement, int width, int height, CeldSimilarity *there,
                                CeldSimilarity *back);

/* The pixels of a picture whose value depends on pixels of a box of the drawing: a pixel depends on those within
 * `reach` of its place.  Width 0: none. */
CeldRect celd_similarity_box (const CeldSimilarity *there, double reach, CeldRect box, int width, int height);

/* ------------------------------------------------------------------ compose.c */

#define CELD_NO_ITEM UINT32_MAX

typedef struct
{
  const CeldLayers *layers;
  CeldSimilarity    there, back;
  double            reach;      /* half the side of the square of the drawing that a pixel shows */
  CeldRect          box;        /* pixels of the composition that show anything of the drawing */
  uint32_t         *item;       /* of each of its layers; CELD_NO_ITEM: left out */
  CeldPageStrokes   strokes;    /* that go with parts, if the page is left out */
} CeldPlacedFragment;

struct CeldComposition
{
  int                 width, height;
  CeldPlacedFragment *fragment;
  size_t              n;
  CeldComposedLayer  *item;     /* from back to front */
  size_t              n_items;
  uint32_t            levels;
  CeldCycle          *cycle;
  size_t              n_cycles;
};

/* ------------------------------------------------------------------ resample.c */

/* What a pixel shows of an item: premultiplied. */
typedef struct { uint32_t item, fragment; float colour[4]; } CeldShare;

/* All shares of a pixel, and work space. */
typedef struct
{
  CeldShare *share;
  size_t     n;
  uint32_t  *slot;              /* of each item: its share's index + 1, 0 = none; all 0 between pixels */
  float     *covered;           /* of each fragment: by those of its shares that are in front; 0 between pixels */
  uint32_t  *front;             /* the fragments that cover anything yet */
} CeldShares;

#define CELD_COMPOSE_BAND  16   /* rows that a task paints in one round; chosen */
#define CELD_COMPOSE_TASKS 32   /* in one round; chosen */

/* To be cleared by the caller, also after a failure. */
CeldStatus celd_shares_new (const CeldComposition *composition, CeldShares *shares);
void       celd_shares_clear (CeldShares *shares);            /* accepts a zeroed record */

/* Finds what each drawing by itself shows at a pixel.  What is visible in a drawing is divided between its regions, so
 * the shares of one drawing add up to its picture, resampled. */
void       celd_shares_gather (const CeldComposition *composition, int x, int y, CeldShares *shares);

/* Sorts the shares from front to back, and reduces each to what it adds to the composition: their sum is the pixel. */
void       celd_shares_combine (CeldShares *shares);

/* The colour of a picture, a box of a drawing with straight alpha, at a pixel of the composition: premultiplied. */
void       celd_resample (const CeldPlacedFragment *fragment, CeldRect box, const float *rgba, int x, int y,
                          float colour[4]);

/* ------------------------------------------------------------------ overlaps.c */

/* Two items of different drawings, and how many pixels they share. */
typedef struct { uint32_t nearer, farther; double area; } CeldOverlap;
typedef struct { CeldOverlap *item; size_t n, capacity; } CeldOverlaps;

/* All overlaps, the largest first; the later item is `nearer`.  Cleared by the caller with celd_free. */
CeldStatus celd_overlaps_find (const CeldComposition *composition, const CeldHost *host, CeldOverlaps *overlaps);

/* ------------------------------------------------------------------ fragment-graph.c */

/* Nodes are the labels of all fragments, in the order of fragments and of their layers.  Links are first the relations
 * between fragments (without ends if they join nothing), then those within, then a wish for each overlap. */
typedef struct
{
  const CeldFragment    *fragment;
  const CeldRelations   *relations;
  const CeldComposition *composition;
  size_t                *before;      /* of each fragment: the number of labels of those before it */
  uint32_t              *node;        /* of each label of all fragments */
  uint32_t              *node_of;     /* of each item */
  CeldGraph              graph;
  size_t                 n_relations, n_own;
} CeldFragmentGraph;

/* Relations that join nothing are reported as problems.  To be cleared by the caller, also after a failure. */
CeldStatus celd_fragment_graph_new (const CeldFragment *fragment, const CeldRelations *relations,
                                    const CeldOverlaps *overlaps, const CeldComposition *composition,
                                    CeldProblems *problems, CeldFragmentGraph *graph);
void       celd_fragment_graph_clear (CeldFragmentGraph *graph);

/* ------------------------------------------------------------------ fragment-order.c */

/* Sorts the items, which are in the order of fragments and of their layers, from back to front, and sets their levels
 * and the cycles of the composition.  Indices of items elsewhere are not changed. */
CeldStatus celd_fragments_order (const CeldFragment *fragment, const CeldRelations *relations,
                                 const CeldOverlaps *overlaps, CeldProblems *problems, CeldComposition *composition);

#endif
