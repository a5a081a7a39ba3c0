/* What adding seeds for arrows and splitting regions share: where a relation's ends lie, the discs that stand for them,
 * and the graph that a region is cut on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SPLITS_H
#define CELD_SPLITS_H

#include "segment/task.h"
#include "solve/partition.h"

/* An end of a relation on the drawing: the paper nearest to its point. */
typedef struct { bool there; int x, y; } CeldRelationEnd;

typedef struct { int x, y; double radius; } CeldSeedDisc;

/* The discs of an end: round the end itself and on the summit above it, with the squared distance to ink there, which
 * is how much room the end has. */
typedef struct { CeldSeedDisc disc[2]; int32_t clearance; } CeldSeedDiscs;

#define CELD_DISC_RANGE 0.45 /* of the way between both ends, for the discs of each where nothing else parts them */

/* ------------------------------------------------------------------ discs.c */

CeldRelationEnd celd_relation_end_find (const CeldSegmentTask *task, const CeldTerm *term);

double celd_relation_end_distance (CeldRelationEnd a, CeldRelationEnd b);

/* No disc reaches farther than `reach` from the end, or has a larger radius than `widest`; INFINITY for no limit. */
CeldSeedDiscs celd_seed_discs_find (const CeldSegmentTask *task, CeldRelationEnd end, double farthest, double widest);

/* The pixels *x .. *end - 1 of a disc in row y, not cut to the picture; false if there are none. */
bool celd_seed_disc_row (const CeldSeedDisc *disc, int y, int *x, int *end);

/* ------------------------------------------------------------------ cuts of a region between two points of it */

/* Of each pixel of the picture.  Before the cut: outside the region, or inside; after it, which end has it. */
enum { CELD_OUTSIDE, CELD_INSIDE, CELD_NEAR_FIRST, CELD_NEAR_SECOND };

typedef struct
{
  const CeldSegmentTask *task;
  uint32_t               label;                    /* of the region: whose seeds pull */
  int                    left, top, right, bottom; /* box round the region, inclusive */
  CeldRelationEnd        end[2];
  CeldSeedDiscs          discs[2];                 /* they belong to their ends whatever it costs */
  uint32_t              *basin;                    /* the region's basins */
  size_t                 n;
  uint32_t              *at;                       /* of basin k: basin[at[k] - 1] == k, or 0 */
  bool                   any;                      /* not all of its basins need to be joined */
  uint8_t               *mark;                     /* tight plane of the picture's size */
  uint32_t              *node;                     /* the same: work space */
} CeldCut;

/* Cuts the region between its ends, pixel by pixel.  *kept is the end that is nearer, within the region, to the seeds
 * of its label; -1 if the region does not join the ends: then nothing is cut. */
CeldStatus celd_cut_pixels (CeldCut *cut, const CeldHost *host, int *kept);

/* The same between whole basins, where a narrow place parts the ends' blocks: side[i] becomes CELD_NEAR_FIRST or
 * CELD_NEAR_SECOND for basin[i]. */
CeldStatus celd_cut_basins (const CeldCut *cut, const CeldHost *host, uint8_t *side, int *kept);

/* ------------------------------------------------------------------ the graph that a region is cut on */

#define CELD_CUT_SQUARE   64   /* pixels; squares are at most as large */
#define CELD_RECENT_LINKS 4096 /* links that are found again by their pair; a power of two */

/* Connected pixels of a square: paper of one basin, or ink of one; or all of it, where there is nothing but paper. */
typedef struct
{
  int      x, y, size;          /* the square */
  bool     whole;               /* all of it, and nothing but paper */
  bool     ink;
  uint32_t basin;               /* of a node that is not whole */
  bool     unreachable;         /* does not join the ends */
  bool     forced[2];           /* to an end, whatever it costs */
  bool     seeded;              /* by the region's label, for one at (seed_x, seed_y) */
  int      seed_x, seed_y;
  int64_t  terminal;            /* to the first end (> 0) or the second (< 0) */
  uint8_t  side;                /* CELD_NEAR_FIRST ... */
  bool     cut;                 /* the cut runs along it */
} CeldCutNode;

typedef struct
{
  const CeldCut *cut;
  uint32_t       at_end[2];     /* nodes of the ends */
  int            columns, rows; /* of tiles, from the corner of the region's box */
  uint8_t       *size;          /* of the squares in each tile: a power of two */
  bool          *active;        /* does the tile have pixels inside? */
  uint32_t      *kind;          /* scratch for one square: basin and paper or ink */
  uint16_t      *stack;
  CeldCutNode   *node;
  size_t         n;
  CeldLink      *link;          /* a pair of nodes may come more than once */
  bool          *uncertain;     /* of each link: does it cross paper, or lie in one basin? */
  size_t         n_links;
  uint32_t      *recent;        /* links by pair, as far as there is room */
} CeldCutGraph;

/* Where the pixel (x,y) is in a tight plane. */
static inline size_t
celd_cut_index (const CeldCut *cut, int x, int y)
{
  return (size_t) y * (size_t) cut->task->basins->width + (size_t) x;
}

/* ------------------------------------------------------------------ cut-mesh.c */

/* Makes nodes of all pixels inside, square by square, and the links among them; pixels that have an end already pull
 * their neighbours to it. */
CeldStatus celd_cut_graph_build (CeldCutGraph *graph);

/* Calls `visit` for the first pixel of each square of the open tiles; the rest up to *right and *bottom, exclusive. */
typedef CeldStatus (*CeldSquareVisit) (CeldCutGraph *graph, int x, int y, int right, int bottom, int size);
CeldStatus celd_cut_graph_visit_squares (CeldCutGraph *graph, CeldSquareVisit visit);

/* The node of a pixel inside: the first pixel of a whole square has it for all of them. */
uint32_t celd_cut_graph_node_at (const CeldCutGraph *graph, int x, int y);

/* The x up to which a row has this node for sure, at most `end`. */
static inline int
celd_cut_graph_node_end (const CeldCutNode *node, int x, int end)
{
  int next = node->whole ? node->x + node->size : x + 1;

  return next < end ? next : end;
}

/* Calls `visit` for the pixels inside that are seeds of the region, x .. end - 1 of row y in one node. */
typedef void (*CeldSeedVisit) (CeldCutGraph *graph, uint32_t k, int x, int end, int y, int kept);
void celd_cut_graph_visit_seeds (CeldCutGraph *graph, CeldSeedVisit visit, int kept);

/* ------------------------------------------------------------------ cut-ways.c */

/* The region's seeds x .. end - 1 in row y lie in a node. */
void celd_cut_graph_note_seeds (CeldCutGraph *graph, uint32_t k, int x, int end, int y);

/* *kept as in celd_cut_pixels, from the seeds that nodes note; nodes that do not join the first end are lost. */
CeldStatus celd_cut_graph_find_kept_end (CeldCutGraph *graph, int *kept);

/* ------------------------------------------------------------------ cut.c */

void celd_cut_graph_clear (CeldCutGraph *graph);                        /* accepts a zeroed record */

/* Tells the side of each node by the smallest cut. */
CeldStatus celd_cut_graph_solve (CeldCutGraph *graph, int kept, const CeldHost *host);

#endif
