/* What adding seeds for arrows and splitting regions share: the ends of relations, the seed discs that stand for them,
 * and the graph that a region is cut on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SPLITS_H
#define CELD_SPLITS_H

#include "segment/pixel-graph.h"
#include "segment/task.h"

/* An end of a relation on the drawing: the paper nearest to its point, if there is any near. */
typedef struct { bool there; int x, y; } CeldRelationEnd;

typedef struct { int x, y; double radius; } CeldSeedDisc; /* centre and radius in pixels */

/* The discs of an end: one round the end and one on the peak of the distance to ink above it.  `clearance`: the squared
 * distance to ink at the peak. */
typedef struct { CeldSeedDisc disc[2]; int32_t clearance; } CeldSeedDiscs;

/* Of the way between both ends: how far discs extend where nothing else separates the ends (chosen). */
#define CELD_DISC_RANGE 0.45

/* ------------------------------------------------------------------ arrow-seeds.c */

/* The end of a relation on the drawing. */
CeldRelationEnd celd_relation_end_find (const CeldSegmentTask *task, const CeldTerm *term);

/* The distance of two ends in pixels. */
double celd_relation_end_distance (CeldRelationEnd a, CeldRelationEnd b);

/* The discs of an end.  None extends farther than `farthest` from the end or has a radius above `widest`; INFINITY: no
 * limit. */
CeldSeedDiscs celd_seed_discs_find (const CeldSegmentTask *task, CeldRelationEnd end, double farthest, double widest);

/* The pixels *x .. *end - 1 of a disc in row y, not clipped to the picture; false if there are none. */
bool celd_seed_disc_row (const CeldSeedDisc *disc, int y, int *x, int *end);

/* Is the pixel in one of the discs? */
bool celd_seed_discs_contain (const CeldSeedDiscs *discs, int x, int y);

/* ------------------------------------------------------------------ cuts of a region between two points of it */

/* Marks of pixels.  Before the cut: outside the region or inside.  After it: the end that gets the pixel. */
enum { CELD_OUTSIDE, CELD_INSIDE, CELD_NEAR_FIRST, CELD_NEAR_SECOND };

typedef struct
{
  const CeldSegmentTask *task;
  uint32_t               label;                    /* of the region: its seeds count */
  int                    left, top, right, bottom; /* bounding box of the region, inclusive */
  CeldRelationEnd        end[2];
  CeldSeedDiscs          discs[2];                 /* always assigned to their ends */
  uint32_t              *basin;                    /* the basins of the region */
  size_t                 n;
  uint32_t              *at;                       /* of basin k: its index in `basin` plus one, or 0 */
  bool                   any;                      /* its basins need not be connected */
  uint8_t               *mark;                     /* tight plane of the picture's size */
} CeldCut;

/* Cuts the region between its ends, down to single pixels, and sets the marks.  *kept is the end, 0 or 1, with the
 * shorter path within the region to the seeds of its label; -1 if the region does not connect the ends: then nothing is
 * cut. */
CeldStatus celd_cut_pixels (CeldCut *cut, const CeldHost *host, int *kept);

/* Cuts the region between whole basins, for ends in different merged basins: side[i] becomes CELD_NEAR_FIRST or
 * CELD_NEAR_SECOND for basin[i].  *kept as in celd_cut_pixels. */
CeldStatus celd_cut_basins (const CeldCut *cut, const CeldHost *host, uint8_t *side, int *kept);

/* ------------------------------------------------------------------ the graph that a region is cut on */

#define CELD_CUT_SQUARE CELD_LARGEST_SQUARE /* side of tiles */
#define CELD_CUT_PAPER  (UINT32_C (1) << 28)  /* flag of the value of a node of paper; the rest is its basin */

/* A node: connected pixels of a square, either paper or ink of one basin; or the whole square, if it is nothing but
 * paper. */
typedef struct
{
  int      x, y, size;          /* the square */
  bool     whole;               /* the whole square, nothing but paper */
  bool     ink;
  uint32_t basin;               /* of a node that is not whole */
  bool     unreachable;         /* not connected to the first end */
  bool     forced[2];           /* belongs to an end at any cost */
  bool     seeded;              /* has a seed of the region's label, at (seed_x, seed_y) */
  int      seed_x, seed_y;
  int64_t  terminal;            /* capacity to the first end (> 0) or the second (< 0) */
  uint8_t  side;                /* CELD_NEAR_FIRST ... */
  bool     cut;                 /* is adjacent to the cut */
} CeldCutNode;

typedef struct
{
  const CeldCut *cut;
  uint32_t       at_end[2];     /* nodes of the ends */
  int            columns, rows; /* of tiles, in the region's box */
  uint8_t       *size;          /* side of the squares in each tile: a power of two */
  bool          *active;        /* does the tile have pixels to be cut? */
  uint64_t      *state;         /* workspace: of the pixels of a square */
  CeldPixelGraph pixels;        /* of a cut between basins, only its links are set */
  CeldCutNode   *node;
  size_t         n;
  bool          *uncertain;     /* of each link: is the exact place of a cut through it open? */
  size_t         node_capacity, uncertain_capacity;
} CeldCutGraph;

/* The index of pixel (x,y) in a tight plane. */
static inline size_t
celd_cut_index (const CeldCut *cut, int x, int y)
{
  return (size_t) y * (size_t) cut->task->basins->width + (size_t) x;
}

/* ------------------------------------------------------------------ cut.c */

/* Makes the nodes of the cut from those of the pixels, and the capacities from their data costs. */
CeldStatus celd_cut_graph_read_pixels (CeldCutGraph *graph);

/* Notes that the pixels x .. end - 1 of row y, in node k, are seeds of the region. */
void celd_cut_graph_note_seeds (CeldCutGraph *graph, uint32_t k, int x, int end, int y);

/* Finds *kept as in celd_cut_pixels, from the seeds noted; nodes not connected to the first end become unreachable. */
CeldStatus celd_cut_graph_find_kept_end (CeldCutGraph *graph, int *kept);

void celd_cut_graph_clear (CeldCutGraph *graph); /* accepts a zeroed record */

/* Sets the side of each node by a minimum cut. */
CeldStatus celd_cut_graph_solve (CeldCutGraph *graph, int kept, const CeldHost *host);

#endif
