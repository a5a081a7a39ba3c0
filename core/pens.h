/* Which region's pen drew the ink behind each place on its edges, how wide that pen is, and what it covers.
 *
 *   pens.c         corners of the edges, and owners of the ink next to them
 *   pen-widths.c   how wide each pen is
 *   pen-claims.c   ink goes to the pens, edge by edge
 *   pen-lines.c    where lines run on below others, and the tips of corners
 *   pen-corrections.c  what the artist gives to whom
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PENS_H
#define CELD_PENS_H

#include "ink-edges.h"

/* What a place on an edge means for a labelling. */
typedef struct
{
  uint32_t near, far;           /* labels of the paper here and across; 0 = none */
  uint32_t owner;               /* whose pen drew the ink next to it; 0 = not known */
  float    width;               /* of that ink */
  bool     corner;              /* the edge turns sharply here */
  bool     askew;               /* or so close by that the normal does not tell how thick the ink is */
} CeldPen;

/* The pens of a labelling: pen[i] is for edges->point[i].  Labels 1 .. n. */
typedef struct
{
  const CeldInkEdges *edges;
  const uint32_t     *level;
  size_t              n;
  CeldPen            *pen;
  float              *usual, *most;  /* width of label k's pen, and how wide it may be: at k - 1; 0 = not known */
} CeldPens;

CeldStatus celd_pens_new (const CeldInkEdges *edges, const CeldLabels *labels, const uint32_t *level, size_t n,
                          CeldPens *pens);
void       celd_pens_clear (CeldPens *pens);    /* accepts a zeroed record */

/* Of the two labels at a place the one whose pen drew the ink between them; 0 if neither is nearer. */
static inline uint32_t
celd_pen_front (const CeldPens *pens, const CeldPen *pen)
{
  if (!pen->near || !pen->far || pens->level[pen->near - 1] == pens->level[pen->far - 1])
    return 0;
  return pens->level[pen->near - 1] > pens->level[pen->far - 1] ? pen->near : pen->far;
}

/* Pixels between two places. */
float celd_edge_distance (const CeldEdgePoint *a, const CeldEdgePoint *b);

/* ------------------------------------------------------------------ pen-widths.c */

/* Fills in the widths, from labels and corners. */
CeldStatus celd_pens_measure (CeldPens *pens);

/* ------------------------------------------------------------------ pen-claims.c */

/* Who has claimed which ink. */
typedef struct
{
  const CeldPens  *pens;
  const CeldPlane *ink;
  CeldLabels      *owner;       /* 0 = ink that nobody has claimed */
  CeldPlane       *over;        /* of ink: by how much its owner's pen misses it, <= 0 not at all; of paper -INFINITY */
} CeldClaims;

/* Ink goes to the pens.  In: `owner` holds the labels; out: the owners.  `over` is workspace. */
CeldStatus celd_pens_claim (const CeldPens *pens, const CeldPlane *ink, const CeldRun *run, CeldLabels *owner,
                            CeldPlane *over);

/* The band that a pen covers beside one place of an edge. */
void celd_claim_ray (const CeldClaims *claims, uint32_t label, const CeldEdgePoint *from, float width, float length,
                     bool guess);
/* The pixel at (x,y), with so much of the pen left round it. */
void celd_claim_pixel (const CeldClaims *claims, uint32_t label, int x, int y, float over, bool guess);

/* ------------------------------------------------------------------ pen-corrections.c */

/* Gives the ink below strokes, 0 where there is none, and the pieces of line that they touch, to their labels. */
CeldStatus celd_pens_correct (const CeldPens *pens, const CeldPlane *ink, const CeldLabels *corrections,
                              CeldLabels *owner);

/* ------------------------------------------------------------------ pen-lines.c */

void celd_claim_lines (const CeldClaims *claims, const CeldEdgeLoop *loop);

#endif
