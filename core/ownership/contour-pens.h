/* Contours and pens: the edges of ink, the region whose pen drew the ink behind each of their points, the width of that
 * pen, and the pixels that it covers.
 *
 *   contour-edges.c    traces the edges and measures how thick the ink is
 *   contour-pens.c     finds the owner of the ink next to each point
 *   pen-width.c        estimates the width of each pen
 *   claims.c           assigns ink to the pens that cover it
 *   claim-remainder.c  assigns the pixels that no pen covers
 *   corrections.c      applies the artist's corrections
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_CONTOUR_PENS_H
#define CELD_CONTOUR_PENS_H

#include "base/base.h"

/* ------------------------------------------------------------------ contour-edges.c */

/* A point of an edge, with the precision of antialiasing. */
typedef struct
{
  float   x, y;
  float   nx, ny;               /* unit normal, into the ink */
  float   thickness;              /* distance through the ink along the normal, in pixels; INFINITY if no other side
                                   * is found */
  float   step;                 /* distance to the next point of the loop, in pixels */
  int32_t paper, across;        /* pixels of paper, y * width + x: on this side, and on the other side of the ink; -1
                                 * = outside the picture */
  bool    corner;               /* the edge turns sharply here */
  bool    skewed;                /* a corner is so close that the normal is unreliable */
} CeldEdgePoint;

/* A closed edge: the points first .. first + n - 1, in an order that has paper on the right. */
typedef struct { size_t first, n; } CeldEdgeLoop;

typedef struct
{
  int            width, height, stroke; /* stroke: the median line width in pixels, see celd_stroke_width */
  CeldEdgePoint *point;
  size_t         n_points, point_capacity;
  CeldEdgeLoop  *loop;
  size_t         n_loops, loop_capacity;
} CeldContourEdges;

CeldStatus celd_contour_edges_new (const CeldPlane *ink, const CeldHost *host, CeldContourEdges *edges);
void       celd_contour_edges_clear (CeldContourEdges *edges);  /* accepts a zeroed record */

/* Distance in pixels. */
float celd_edge_distance (const CeldEdgePoint *a, const CeldEdgePoint *b);

/* Rounds down, also below 0: the pixel that a coordinate lies in. */
static inline int
celd_floor (float value)
{
  int down = (int) value;

  return down - ((float) down > value);
}

/* ------------------------------------------------------------------ contour-pens.c */

/* A point of an edge under a labelling. */
typedef struct
{
  uint32_t near, far;           /* labels of the paper on this side and on the other side; 0 = outside the picture */
  uint32_t owner;               /* label whose pen drew the ink at this point; 0 = unknown */
  float    width;               /* of that pen, in pixels */
} CeldEdgePen;

/* The pens of a labelling with labels 1 .. n: pen[i] belongs to edges->point[i]. */
typedef struct
{
  const CeldContourEdges *edges;
  const uint32_t         *level;
  size_t                  n;
  CeldEdgePen            *pen;
  float                  *typical_width, *max_width; /* width of label k's pen, and the largest that it may have along
                                                   * the line, in pixels: at k - 1; 0 = unknown */
} CeldContourPens;

CeldStatus celd_contour_pens_new (const CeldContourEdges *edges, const CeldLabels *labels, const uint32_t *level,
                                  size_t n,
                          CeldContourPens *pens);
/* Like celd_contour_pens_new, but reuses `old`, from which `labels` differ only within `changed`. */
CeldStatus celd_contour_pens_update (const CeldContourPens *old, const CeldLabels *labels, CeldRect changed,
                                     const uint32_t *level,
                            size_t n, CeldContourPens *pens);
void       celd_contour_pens_clear (CeldContourPens *pens);    /* accepts a zeroed record */

/* The nearer one of the two labels at a point, whose pen drew the ink between them; 0 if neither is nearer. */
static inline uint32_t
celd_pen_front (const CeldContourPens *pens, const CeldEdgePen *pen)
{
  if (!pen->near || !pen->far || pens->level[pen->near - 1] == pens->level[pen->far - 1])
    return 0;
  return pens->level[pen->near - 1] > pens->level[pen->far - 1] ? pen->near : pen->far;
}

/* ------------------------------------------------------------------ pen-width.c */

/* Estimates typical_width and max_width of each label, and the pen's width at each point of a loop. */
CeldStatus celd_pen_widths_measure (CeldContourPens *pens);
void       celd_pen_widths_smooth (const CeldEdgeLoop *loop, CeldContourPens *pens);

/* ------------------------------------------------------------------ claims.c */

/* A point, and the unit vector along which ink is claimed from there. */
typedef struct { float x, y, nx, ny; } CeldRay;

/* Ink that one point of an edge claims for its pen.  All members have four bytes and there is no padding, so that
 * memcmp compares claims. */
typedef struct
{
  enum { CELD_CLAIM_BAND, CELD_CLAIM_LINE, CELD_CLAIM_DISC } shape;
  uint32_t label;
  CeldRay  from, to;            /* band: its two sides; line: its beginning, in both; disc: its centre, in both */
  float    width;               /* of the pen, in pixels; of a disc the radius */
  float    length;              /* of a band behind the edge, or of a line along it, in pixels */
  int      direction;                 /* of a line: along the loop (1) or against it (-1) */
  uint32_t tentative;               /* 1: yields to every other claim (a line that is assumed to continue under
                                     * another) */
} CeldClaim;

#define CELD_MAX_CLAIMS 6 /* largest number of claims of one point */

/* Writes the claims of point i of the loop; returns their number. */
size_t celd_claims_at_point (const CeldContourPens *pens, const CeldEdgeLoop *loop, size_t i,
                             CeldClaim claim[CELD_MAX_CLAIMS]);

/* The state of the assignment of ink. */
typedef struct
{
  const CeldContourPens *pens;
  const CeldPlane       *ink;
  CeldLabels            *owner; /* 0 = unclaimed ink */
  CeldPlane             *excess;  /* of each ink pixel: its distance beyond its owner's pen in pixels, <= 0 if the
                                   * pen covers it; INFINITY if unclaimed; -INFINITY if settled without claims */
} CeldClaimMap;

/* The point at distance `along` from the beginning of a line. */
static inline CeldRay
celd_claim_line_at (const CeldClaim *line, float along)
{
  CeldRay at = line->from;

  at.x -= (float) line->direction * along * at.ny;
  at.y += (float) line->direction * along * at.nx;
  return at;
}

/* Length of a line in pixels; a tentative line ends where its centre leaves the ink. */
float celd_claim_line_length (const CeldPlane *ink, const CeldClaim *line);

/* Makes a claim.  The result depends neither on the order of claims nor on repetitions. */
void celd_claim_apply (const CeldClaimMap *claims, const CeldClaim *claim);

/* Assigns all pixels to owners; `owner` may alias `labels`. */
CeldStatus celd_claims_assign (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels,
                               const bool *solid,
                            const CeldHost *host, CeldLabels *owner, CeldPlane *excess);

/* ------------------------------------------------------------------ claim-remainder.c */

/* Finds labels that consist almost wholly of ink: solid[k - 1] for label k. */
CeldStatus celd_solid_labels_find (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *labels,
                                   bool *solid);

/* Resets the pixels of a rectangle to the state before any claim. */
void celd_claims_reset (const CeldClaimMap *claims, const CeldLabels *labels, const bool *solid, CeldRect rect);

/* A pixel, as y * width + x, and its owner. */
typedef struct { int32_t pixel; uint32_t owner; } CeldPixelOwner;

#define CELD_OWNER_PENDING UINT32_MAX /* in place of an owner: the pixel is queued */

/* Assigns the listed pixels, which have no owner, to the owner nearest to them; the order of the list has no
 * influence. */
void       celd_claims_spread (const CeldClaimMap *claims, CeldPixelOwner *rest, size_t n);
CeldStatus celd_claims_finish (const CeldClaimMap *claims);  /* lists the pixels first */

/* Writes the up to four neighbours of a pixel; returns their number. */
int celd_pixel_neighbours (const CeldPlane *ink, int32_t pixel, int near[4][2]);

/* ------------------------------------------------------------------ corrections.c */

/* The pixels that corrections reassigned, in this order, with their former owners. */
typedef struct { CeldPixelOwner *item; size_t n, capacity; } CeldReassigned;

/* Gives the ink under strokes (0 = no stroke), and the pieces of line that they touch, to the strokes' labels.
 * Appends the reassigned pixels to `reassigned`, also when it fails. */
CeldStatus celd_corrections_apply (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *corrections,
                              CeldLabels *owner, CeldReassigned *reassigned);
void       celd_reassigned_clear (CeldReassigned *reassigned);

#endif
