/* What planting and splitting share: where a relation's ends lie, and the discs that stand for them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEEDS_H
#define CELD_SEEDS_H

#include "segment/canvas.h"

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

/* ------------------------------------------------------------------ hues.c */

/* One more label, of a colour that is far from all others. */
CeldStatus celd_hue_add (CeldCanvas *canvas, uint32_t *label);

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

#endif
