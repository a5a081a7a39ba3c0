/* Which region's pen drew the ink behind each place on its edges, how wide that pen is, and what it covers.
 *
 *   contour-pens.c         owners of the ink next to the edges
 *   pen-width.c   how wide each pen is
 *   pen-lines.c    where lines run on below others, and the tips of corners
 *   claims.c   ink goes to the pens, edge by edge
 *   claim-remainder.c     and what no pen explains
 *   corrections.c  what the artist gives to whom
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_CONTOURS_H
#define CELD_CONTOURS_H

#include "base/base.h"

/* ------------------------------------------------------------------ contour-edges.c */

/* A place on an edge, as exact as the antialiasing. */
typedef struct
{
  float   x, y;
  float   nx, ny;               /* unit normal, into the ink */
  float   thickness;              /* to the other side of the ink along the normal; INFINITY if that is not found */
  float   step;                 /* to the next place of the loop */
  int32_t paper, across;        /* pixels of paper, y * width + x: here, and at the other side; -1 = off the picture */
  bool    corner;               /* the edge turns sharply here */
  bool    skewed;                /* or so close by that the normal does not tell how thick the ink is */
} CeldEdgePoint;

/* A closed edge: points first .. first + n - 1, paper on the right hand of who follows it. */
typedef struct { size_t first, n; } CeldEdgeLoop;

typedef struct
{
  int            width, height, stroke; /* stroke: how thick lines are, see celd_stroke_width */
  CeldEdgePoint *point;
  size_t         n_points;
  CeldEdgeLoop  *loop;
  size_t         n_loops;
} CeldContourEdges;

CeldStatus celd_contour_edges_new (const CeldPlane *ink, const CeldHost *host, CeldContourEdges *edges);
void       celd_contour_edges_clear (CeldContourEdges *edges);  /* accepts a zeroed record */

/* Pixels between two places. */
float celd_edge_distance (const CeldEdgePoint *a, const CeldEdgePoint *b);

/* The pixel that a place lies in. */
static inline int
celd_floor (float value)
{
  int down = (int) value;

  return down - ((float) down > value);
}

/* ------------------------------------------------------------------ contour-pens.c */

/* What a place on an edge means for a labelling. */
typedef struct
{
  uint32_t near, far;           /* labels of the paper here and across; 0 = none */
  uint32_t owner;               /* whose pen drew the ink next to it; 0 = not known */
  float    width;               /* of that ink */
} CeldEdgePen;

/* The pens of a labelling: pen[i] is for edges->point[i].  Labels 1 .. n. */
typedef struct
{
  const CeldContourEdges *edges;
  const uint32_t     *level;
  size_t              n;
  CeldEdgePen            *pen;
  float              *typical_width, *max_width;  /* width of label k's pen, and how wide it may be: at k - 1; 0 = not known */
} CeldContourPens;

CeldStatus celd_contour_pens_new (const CeldContourEdges *edges, const CeldLabels *labels, const uint32_t *level, size_t n,
                          CeldContourPens *pens);
/* The same where an earlier one is known, from which labels differ within a rectangle only. */
CeldStatus celd_contour_pens_update (const CeldContourPens *old, const CeldLabels *labels, CeldRect changed, const uint32_t *level,
                            size_t n, CeldContourPens *pens);
void       celd_contour_pens_clear (CeldContourPens *pens);    /* accepts a zeroed record */

/* Of the two labels at a place the one whose pen drew the ink between them; 0 if neither is nearer. */
static inline uint32_t
celd_pen_front (const CeldContourPens *pens, const CeldEdgePen *pen)
{
  if (!pen->near || !pen->far || pens->level[pen->near - 1] == pens->level[pen->far - 1])
    return 0;
  return pens->level[pen->near - 1] > pens->level[pen->far - 1] ? pen->near : pen->far;
}

/* ------------------------------------------------------------------ pen-width.c */

/* Fills in how wide the labels' pens are, and then widths along a loop. */
CeldStatus celd_pen_widths_measure (CeldContourPens *pens);
void       celd_pen_widths_smooth (const CeldEdgeLoop *loop, CeldContourPens *pens);

/* ------------------------------------------------------------------ claims.c */

/* A place, and the unit vector along which ink is claimed from there. */
typedef struct { float x, y, nx, ny; } CeldRay;

/* What one place of an edge claims for its pen.  All members take four bytes, so that equal ones are equal bytes. */
typedef struct
{
  enum { CELD_CLAIM_BAND, CELD_CLAIM_LINE, CELD_CLAIM_DISC } shape;
  uint32_t label;
  CeldRay  from, to;            /* a band: its sides; a line: where it begins, twice; a disc: its middle, twice */
  float    width;               /* of the pen; half of it for a disc */
  float    length;              /* how far a band goes behind the edge, and a line along it */
  int      direction;                 /* in which direction a line goes: along the loop (1) or against it (-1) */
  uint32_t tentative;               /* 1: only what is not known otherwise */
} CeldClaim;

#define CELD_MAX_CLAIMS 6           /* of one place at most */

/* The claims of place i; their number. */
size_t celd_claims_at_point (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim claim[CELD_MAX_CLAIMS]);

/* Who has claimed which ink. */
typedef struct
{
  const CeldContourPens  *pens;
  const CeldPlane *ink;
  CeldLabels      *owner;       /* 0 = ink that nobody has claimed */
  CeldPlane       *excess;        /* of ink: by how much its owner's pen misses it, <= 0 not at all, INFINITY as long as
                                 * nobody has claimed it; of what is settled without claims -INFINITY */
} CeldClaimMap;

/* How far a line goes; a guess only as long as its middle is ink. */
float celd_claim_line_length (const CeldPlane *ink, const CeldClaim *line);

/* Whoever claims first: the same claims come to the same, also if some are made twice. */
void celd_claim_apply (const CeldClaimMap *claims, const CeldClaim *claim);

/* All steps from labels to owners; `owner` may alias `labels`. */
CeldStatus celd_claims_assign (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels, const bool *solid,
                            const CeldHost *host, CeldLabels *owner, CeldPlane *excess);

/* ------------------------------------------------------------------ claim-remainder.c */

/* Which labels are ink throughout: of label k at k - 1. */
CeldStatus celd_solid_labels_find (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels, bool *solid);

/* As if nothing were claimed within the rectangle. */
void celd_claims_reset (const CeldClaimMap *claims, const CeldLabels *labels, const bool *solid, CeldRect rect);

/* A pixel, as y * width + x, and whose it is. */
typedef struct { int32_t pixel; uint32_t owner; } CeldPixelOwner;

#define CELD_OWNER_PENDING UINT32_MAX /* in place of an owner: a pixel of a list */

/* Gives owners to all pixels without one, which are listed in any order. */
void       celd_claims_spread (const CeldClaimMap *claims, CeldPixelOwner *rest, size_t n);
CeldStatus celd_claims_finish (const CeldClaimMap *claims);  /* lists them, too */

/* The up to four neighbours of a pixel; their number. */
int celd_pixel_neighbours (const CeldPlane *ink, int32_t pixel, int near[4][2]);

/* ------------------------------------------------------------------ pen-lines.c */

/* The claims of place i where a line runs on, up to five. */
size_t celd_line_claims (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i, CeldClaim *claim);

/* The place so far on along a line. */
static inline CeldRay
celd_claim_line_at (const CeldClaim *line, float along)
{
  CeldRay at = line->from;

  at.x -= (float) line->direction * along * at.ny;
  at.y += (float) line->direction * along * at.nx;
  return at;
}

/* ------------------------------------------------------------------ corrections.c */

/* What corrections took, in this order, from whom. */
typedef struct { CeldPixelOwner *item; size_t n; } CeldReassigned;

/* Gives the ink below strokes, 0 where there is none, and the pieces of line that they touch, to their labels.  What
 * they took is appended, also after a failure. */
CeldStatus celd_corrections_apply (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *corrections,
                              CeldLabels *owner, CeldReassigned *reassigned);
void       celd_reassigned_clear (CeldReassigned *reassigned);

#endif
