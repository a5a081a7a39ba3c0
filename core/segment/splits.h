/* What adding seeds for arrows and splitting regions share: where a relation's ends lie, the discs that stand for them,
 * and the graph that a region is cut on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SPLITS_H
#define CELD_SPLITS_H

#include "segment/canvas.h"
#include "solve/partition.h"

/* An end of a relation on the drawing: the paper nearest to its point. */
typedef struct { bool there; int x, y; } CeldRelationEnd;

typedef struct { int x, y; double radius; } CeldDisc;

/* The discs of an end: round the end itself and on the summit above it, with the squared distance to ink there, which
 * is how much room the end has. */
typedef struct { CeldDisc disc[2]; int32_t room; } CeldDiscs;

#define CELD_REACH 0.45 /* of the way between both ends, for the discs of each where nothing else parts them */

/* ------------------------------------------------------------------ discs.c */

CeldRelationEnd celd_end_find (const CeldCanvas *canvas, const CeldTerm *term);

double celd_ends_apart (CeldRelationEnd a, CeldRelationEnd b);

/* No disc reaches farther than `reach` from the end, or has a larger radius than `widest`; INFINITY for no limit. */
CeldDiscs celd_discs_find (const CeldCanvas *canvas, CeldRelationEnd end, double reach, double widest);

/* The pixels *x .. *end - 1 of a disc in row y, not cut to the picture; false if there are none. */
bool celd_disc_row (const CeldDisc *disc, int y, int *x, int *end);

/* ------------------------------------------------------------------ cuts of a region between two points of it */

/* Of each pixel of the picture.  Before the cut: outside the region, or inside; after it, which end has it. */
enum { CELD_OUTSIDE, CELD_INSIDE, CELD_NEAR_FIRST, CELD_NEAR_SECOND };

typedef struct
{
  const CeldCanvas *canvas;
  uint32_t          label;             /* of the region: whose seeds pull */
  int               left, top, right, bottom; /* box round the region, inclusive */
  CeldRelationEnd           end[2];
  CeldDiscs         discs[2];          /* they belong to their ends whatever it costs */
  uint32_t         *basin;             /* the region's basins */
  size_t            n;
  uint32_t         *at;                /* of basin k: basin[at[k] - 1] == k, or 0 */
  bool              any;               /* not all of its basins need to be joined */
  uint8_t          *mark;              /* tight plane of the picture's size */
  uint32_t         *node;              /* the same: work space */
} CeldCut;

/* Cuts the region between its ends, pixel by pixel.  *kept is the end that is nearer, within the region, to the seeds
 * of its label; -1 if the region does not join the ends: then nothing is cut. */
CeldStatus celd_cut (CeldCut *cut, const CeldHost *host, int *kept);

/* The same between whole basins, where a narrow place parts the ends' blocks: side[i] becomes CELD_NEAR_FIRST or
 * CELD_NEAR_SECOND for basin[i]. */
CeldStatus celd_cut_basins (const CeldCut *cut, const CeldHost *host, uint8_t *side, int *kept);

/* ------------------------------------------------------------------ the graph that a region is cut on */

#define CELD_CUT_SQUARE   64   /* pixels; squares are at most as large */
#define CELD_RECENT 4096 /* links that are found again by their pair; a power of two */

/* Connected pixels of a square: paper of one basin, or ink of one; or all of it, where there is nothing but paper. */
typedef struct
{
  int     x, y, size;           /* the square */
  bool    whole;                /* all of it, and nothing but paper */
  bool    ink;
  uint32_t basin;               /* of a node that is not whole */
  bool    lost;                 /* does not join the ends */
  bool    pulled[2];            /* to an end, whatever it costs */
  bool    seeded;               /* by the region's label, for one at (seed_x, seed_y) */
  int     seed_x, seed_y;
  int64_t pull;                 /* to the first end (> 0) or the second (< 0) */
  uint8_t side;                 /* CELD_NEAR_FIRST ... */
  bool    cut;                  /* the cut runs along it */
} CeldCutNode;

typedef struct
{
  const CeldCut *cut;
  uint32_t     at_end[2];       /* nodes of the ends */
  int          columns, rows;   /* of tiles, from the corner of the region's box */
  uint8_t     *size;            /* of the squares in each tile: a power of two */
  bool        *open;            /* does the tile have pixels inside? */
  uint32_t    *kind;            /* scratch for one square: basin and paper or ink */
  uint16_t    *stack;
  CeldCutNode *node;
  size_t       n;
  CeldLink    *link;            /* a pair of nodes may come more than once */
  bool        *loose;           /* of each link: does it cross paper, or lie in one basin? */
  size_t       n_links;
  uint32_t    *recent;          /* links by pair, as far as there is room */
} CeldMesh;

/* Where the pixel (x,y) is in a tight plane. */
static inline size_t
celd_cut_pixel (const CeldCut *cut, int x, int y)
{
  return (size_t) y * (size_t) cut->canvas->basins->width + (size_t) x;
}

/* ------------------------------------------------------------------ cut-mesh.c */

/* Makes nodes of all pixels inside, square by square, and the links among them; pixels that have an end already pull
 * their neighbours to it. */
CeldStatus celd_mesh_build (CeldMesh *mesh);

/* Calls `visit` for the first pixel of each square of the open tiles; the rest up to *right and *bottom, exclusive. */
typedef CeldStatus (*CeldSquareVisit) (CeldMesh *mesh, int x, int y, int right, int bottom, int size);
CeldStatus celd_mesh_squares (CeldMesh *mesh, CeldSquareVisit visit);

/* The node of a pixel inside: the first pixel of a whole square has it for all of them. */
uint32_t celd_mesh_at (const CeldMesh *mesh, int x, int y);

/* The x up to which a row has this node for sure, at most `end`. */
static inline int
celd_mesh_next (const CeldCutNode *node, int x, int end)
{
  int next = node->whole ? node->x + node->size : x + 1;

  return next < end ? next : end;
}

/* Calls `visit` for the pixels inside that are seeds of the region, x .. end - 1 of row y in one node. */
typedef void (*CeldSeedVisit) (CeldMesh *mesh, uint32_t k, int x, int end, int y, int kept);
void celd_mesh_seeds (CeldMesh *mesh, CeldSeedVisit visit, int kept);

/* ------------------------------------------------------------------ cut-ways.c */

/* The region's seeds x .. end - 1 in row y lie in a node. */
void celd_mesh_note_seeds (CeldMesh *mesh, uint32_t k, int x, int end, int y);

/* *kept as in celd_cut, from the seeds that nodes note; nodes that do not join the first end are lost. */
CeldStatus celd_mesh_kept (CeldMesh *mesh, int *kept);

/* ------------------------------------------------------------------ cut.c */

void celd_mesh_clear (CeldMesh *mesh);                        /* accepts a zeroed record */

/* Tells the side of each node by the smallest cut. */
CeldStatus celd_mesh_solve (CeldMesh *mesh, int kept, const CeldHost *host);

#endif
