/* Contour ownership: which label each pixel belongs to, ink included.
 *
 *   contour-edges.c        traces the edges of ink and measures how thick the ink is
 *   contour-pens.c         reads the labels beside each point of an edge, and keeps pens up to date
 *   contour-owners.c       finds the region whose pen drew the ink next to each point
 *   line-shades.c          finds of what fills the lines of a coloured drawing are shades
 *   line-pieces.c          gives pieces of lines in one colour to the regions of these fills
 *   pen-width.c            estimates the width of each pen
 *   claims.c               assigns ink to the pens that cover it
 *   claim-remainder.c      assigns the pixels that no pen covers
 *   corrections.c          applies the artist's corrections
 *   expansion.c            the paper's depth expansion, by the thickness of contours
 *   expansion-region.c     expands one level
 *   ownership.c            the step, with the coverage of antialiased pixels
 *   ownership-cache.c      updates ownership after an edit
 *   ownership-changes.c    finds the tiles that an edit affects
 *   ownership-of-levels.c  ownership of pictures that have levels but no labels
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OWNERSHIP_H
#define CELD_OWNERSHIP_H

#include "base/base.h"

/* The label that covers most of a pixel. */
static inline uint32_t
celd_larger_label (const CeldOwnership *own, int x, int y)
{
  return CELD_AT (&own->coverage, x, y) < 0.5f ? CELD_AT (&own->under, x, y) : CELD_AT (&own->owner, x, y);
}

/* ------------------------------------------------------------------ tiles */

#define CELD_TILE 16 /* pixels a side (chosen) */

/* One byte of marks for each square tile of a picture. */
typedef struct { int across, down; uint8_t *at; } CeldTiles;

/* Tiles that cover the picture, all marks 0; the caller frees `at` with celd_free. */
static inline CeldStatus
celd_tiles_new (int width, int height, CeldTiles *tiles)
{
  *tiles    = (CeldTiles) { (width + CELD_TILE - 1) / CELD_TILE, (height + CELD_TILE - 1) / CELD_TILE, NULL };
  tiles->at = celd_alloc0 ((size_t) tiles->across * (size_t) tiles->down, 1);
  return tiles->at ? CELD_OK : CELD_NO_MEMORY;
}

/* The marks of the tile of pixel (x,y). */
static inline uint8_t *
celd_tile_of (const CeldTiles *tiles, int x, int y)
{
  return &tiles->at[(size_t) (y / CELD_TILE) * (size_t) tiles->across + (size_t) (x / CELD_TILE)];
}

/* Tiles left .. right, top .. bottom, inclusive; none if right < left. */
typedef struct { int left, top, right, bottom; } CeldTileSpan;

/* The tiles that a box of places, in pixels, touches. */
static inline CeldTileSpan
celd_tile_span (const CeldTiles *tiles, float left, float top, float right, float bottom)
{
  float most_x = (float) (tiles->across * CELD_TILE - 1), most_y = (float) (tiles->down * CELD_TILE - 1);

  if (!(left <= most_x && top <= most_y && right >= 0 && bottom >= 0))
    return (CeldTileSpan) { 0, 0, -1, -1 };
  return (CeldTileSpan) {
    left > 0 ? (int) left / CELD_TILE : 0, top > 0 ? (int) top / CELD_TILE : 0,
    (int) (right < most_x ? right : most_x) / CELD_TILE, (int) (bottom < most_y ? bottom : most_y) / CELD_TILE
  };
}

/* Whether any tile of the span has any of these bits set. */
static inline bool
celd_tiles_any (const CeldTiles *tiles, CeldTileSpan span, uint8_t bits)
{
  for (int y = span.top; y <= span.bottom; y++)
    for (int x = span.left; x <= span.right; x++)
      if (tiles->at[(size_t) y * (size_t) tiles->across + (size_t) x] & bits)
        return true;
  return false;
}

/* Sets these bits in all tiles of the span. */
static inline void
celd_tiles_mark (CeldTiles *tiles, CeldTileSpan span, uint8_t bits)
{
  for (int y = span.top; y <= span.bottom; y++)
    for (int x = span.left; x <= span.right; x++)
      tiles->at[(size_t) y * (size_t) tiles->across + (size_t) x] |= bits;
}

/* The pixels of tile (tile_x,tile_y), cut to the picture of this size. */
static inline CeldRect
celd_tile_rect (int tile_x, int tile_y, int width, int height)
{
  int x = tile_x * CELD_TILE, y = tile_y * CELD_TILE, right = width - x, below = height - y;

  return (CeldRect) { x, y, right < CELD_TILE ? right : CELD_TILE, below < CELD_TILE ? below : CELD_TILE };
}

/* ------------------------------------------------------------------ contour-edges.c */

/* Of which paper the line next to the paper on this side is a shade: of that, or of the one on the other side. */
typedef enum { CELD_SHADE_UNKNOWN, CELD_SHADE_NEAR, CELD_SHADE_FAR } CeldLineShade;

/* A point of an edge, with the precision of antialiasing. */
typedef struct
{
  float   x, y;
  float   nx, ny;               /* unit normal, into the ink */
  float   thickness;            /* distance through the ink along the normal, in pixels; INFINITY if no other side
                                 * is found */
  float   step;                 /* distance to the next point of the loop, in pixels */
  int32_t paper, across;        /* pixels of paper, y * width + x: on this side, and on the other side of the ink; -1
                                 * = outside the picture */
  bool    corner;               /* the edge turns sharply here */
  bool    skewed;               /* a corner is so close that the normal is unreliable */
  bool    faces_corner;         /* the edge on the other side of the ink turns sharply near there */
  CeldLineShade shade;          /* see line-shades.c */
  uint32_t      piece;          /* of a line, which has that shade; 0: unknown */
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
  uint32_t      *piece;         /* of pixel y * width + x: which piece of a line it is in, from 1, or 0; NULL: colours
                                 * do not tell whose lines are */
  uint32_t       n_pieces;
} CeldContourEdges;

CeldStatus celd_contour_edges_new (const CeldPlane *ink, const CeldHost *host, CeldContourEdges *edges);
void       celd_contour_edges_clear (CeldContourEdges *edges);  /* accepts a zeroed record */

/* Rounds down, also below 0: the pixel that a coordinate lies in. */
static inline int
celd_floor (float value)
{
  int down = (int) value;

  return down - ((float) down > value);
}

/* ------------------------------------------------------------------ line-shades.c, line-pieces.c */

#define CELD_INK_FADES 1.f /* pixels from the edge of ink to where that is not antialiased; chosen */

/* A pixel of the line whose shade a point knows, as y * width + x. */
static inline uint32_t
celd_shade_pixel (const CeldContourEdges *edges, const CeldEdgePoint *p)
{
  float along = p->shade == CELD_SHADE_NEAR ? CELD_INK_FADES : p->thickness / 2;

  return (uint32_t) (celd_floor (p->y + along * p->ny) * edges->width + celd_floor (p->x + along * p->nx));
}

/* Finds of what paper lines are shades, in the colours that the drawing was painted in, and divides them into pieces:
 * sets `shade` and `piece` of all points, and `piece` of the edges if colours tell whose lines are. */
CeldStatus celd_line_shades_read (const CeldPaint *colours, const CeldPlane *ink, CeldContourEdges *edges);

/* Its second step: by the shades of all points. */
CeldStatus celd_line_pieces_find (const CeldPaint *colours, const CeldPlane *ink, CeldContourEdges *edges);

/* ------------------------------------------------------------------ contour-pens.c */

/* A point of an edge under a labelling. */
typedef struct
{
  uint32_t near, far;           /* labels of the paper on this side and on the other side; 0 = outside the picture */
  uint32_t owner;               /* label whose pen drew the ink at this point; 0 = unknown */
  float    width;               /* of that pen, in pixels */
  uint32_t thickened;           /* 1: the ink is thicker all along the contact of `near` and `far` than the pen of the
                                 * nearer one: it contains another line */
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
                                  size_t n, CeldContourPens *pens);
/* Like celd_contour_pens_new, but reuses `old`, from which `labels` differ only within `changed`. */
CeldStatus celd_contour_pens_update (const CeldContourPens *old, const CeldLabels *labels, CeldRect changed,
                                     const uint32_t *level, size_t n, CeldContourPens *pens);
void       celd_contour_pens_clear (CeldContourPens *pens);    /* accepts a zeroed record */

/* The nearer one of the two labels at a point, whose pen drew the ink between them; 0 if neither is nearer. */
static inline uint32_t
celd_pen_front (const CeldContourPens *pens, const CeldEdgePen *pen)
{
  if (!pen->near || !pen->far || pens->level[pen->near - 1] == pens->level[pen->far - 1])
    return 0;
  return pens->level[pen->near - 1] > pens->level[pen->far - 1] ? pen->near : pen->far;
}

/* Some labels, without duplicates; n > CELD_LISTED_LABELS: more than that. */
#define CELD_LISTED_LABELS 7
typedef struct { uint32_t label[CELD_LISTED_LABELS], n; } CeldLabelList;

void celd_label_list_add (uint32_t label, CeldLabelList *list);

/* Has the order of any two of these labels changed between two labellings?  That of labels that are new, or too many to
 * be listed, counts as changed. */
bool celd_label_order_changed (const CeldLabelList *list, const CeldContourPens *old, const CeldContourPens *new);

/* ------------------------------------------------------------------ contour-owners.c */

/* Finds the owners of a loop's points, whose labels and widths are known; `distance` is work space of loop->n
 * numbers. */
void celd_contour_owners_find (const CeldEdgeLoop *loop, CeldContourPens *pens, float *distance);

/* ------------------------------------------------------------------ pen-width.c */

/* Estimates typical_width and max_width of each label and finds the thickened points; estimates the pen's width at each
 * point of a loop. */
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
  int      direction;           /* of a line: along the loop (1) or against it (-1) */
  uint32_t tentative;           /* 1: yields to every other claim (a line that is assumed to continue under
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
  CeldLabels            *owner;   /* 0 = unclaimed ink */
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
                               const bool *solid, const CeldHost *host, CeldLabels *owner, CeldPlane *excess);

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

/* The pixels that were reassigned after all claims, in this order, with their former owners. */
typedef struct { CeldPixelOwner *item; size_t n, capacity; } CeldReassigned;

void celd_reassigned_clear (CeldReassigned *reassigned);

/* ------------------------------------------------------------------ enclosed-ink.c */

/* Gives pieces of ink that have no paper of their owner beside them, and lie wholly within what another label owns, to
 * that label.  `excess` is that of the claims.  Appends the pixels to `reassigned`, also when it fails, which
 * CELD_NO_MEMORY alone makes it do. */
CeldStatus celd_enclosed_ink_join (const CeldPlane *excess, CeldLabels *owner, CeldReassigned *reassigned);

/* ------------------------------------------------------------------ line-pieces.c */

/* Gives pieces of lines to the labels that nearly all points along them say.  `excess` is that of the claims.  Appends
 * the pixels to `reassigned`, also when it fails, which CELD_NO_MEMORY alone makes it do. */
CeldStatus celd_line_pieces_give (const CeldContourPens *pens, const CeldPlane *excess, CeldLabels *owner,
                                  CeldReassigned *reassigned);

/* ------------------------------------------------------------------ corrections.c */

/* Gives the ink under strokes (0 = no stroke), and the pieces of line that they touch, to the strokes' labels.
 * Appends the reassigned pixels to `reassigned`, also when it fails. */
CeldStatus celd_corrections_apply (const CeldContourPens *pens, const CeldPlane *ink, const CeldLabels *corrections,
                                   CeldLabels *owner, CeldReassigned *reassigned);

/* ------------------------------------------------------------------ expansion.c, expansion-region.c */

/* A picture during expansion; planes without padding. */
typedef struct
{
  int       width, height;
  size_t    pixels;
  uint32_t *level;           /* 1 .. n from back to front; 0 for ink that is still free */
  int32_t  *distance_in_ink; /* squared distance to the nearest pixel that was not free at the beginning */
  uint32_t *rank;            /* the rank that level k stands for: rank[k-1] */
  CeldRect *box;             /* bounding box of level k at the beginning: box[k-1]; width 0 if it has no pixels */
  size_t    n;
} CeldExpansionState;

/* Replaces each number of a tight picture by its place, from 1, among the *n distinct ones in rising order.  *list (may
 * be NULL) has these; to be freed with celd_free. */
CeldStatus celd_number_ranks (CeldLabels *picture, uint32_t **list, size_t *n);

/* Expands level k into free ink; all nearer levels have to be expanded already. */
CeldStatus celd_expand_region (CeldExpansionState *state, uint32_t k, const CeldHost *host);

/* ------------------------------------------------------------------ ownership.c */

/* Fills in a rectangle of the record from `larger`, the label that covers most of each pixel: finds the second label of
 * antialiased pixels and the coverage of the first, and makes the nearer label the owner.  levels_only: nothing but
 * levels has changed since it was filled in.  Returns where the record changes. */
CeldRect celd_ownership_coverage (const CeldPlane *ink, const CeldLabels *larger, const uint32_t *level, CeldRect rect,
                                  bool levels_only, CeldOwnership *ownership);

/* ------------------------------------------------------------------ ownership-cache.c: CELD_EXPANSION_OUTLINES */

/* The input and intermediate results of the last update.  Members that depend on the drawing alone are computed
 * once. */
typedef struct
{
  CeldContourEdges edges;
  CeldTiles        antialiased; /* not 0 for tiles with antialiased pixels */
  CeldContourPens  pens;        /* includes level and n */
  uint32_t        *level;       /* owned; NULL: the cache is empty */
  bool            *solid;
  CeldLabels       owner;       /* label that covers most of each pixel, after all that is reassigned */
  CeldPlane        excess;      /* see CeldClaimMap */
  CeldReassigned   reassigned;  /* pixels of `owner` that enclosed ink and corrections changed */
} CeldOwnershipCache;

/* What ownership is computed from. */
typedef struct
{
  const CeldPlane  *ink;
  const CeldPaint  *colours;              /* that the drawing was painted in; NULL: unknown */
  const CeldLabels *labels, *corrections; /* corrections NULL: none */
  const uint32_t   *level;
  size_t            n;
} CeldOwnershipInput;

/* Compute the record from scratch, or update it after a change of levels, corrections, and of labels within
 * `new_labels`; ink and colours have to be the same.  *changed is the part of the record that changes.  After a failure the
 * record is unchanged and the cache is empty. */
CeldStatus celd_ownership_cache_make (const CeldOwnershipInput *input, const CeldHost *host, CeldOwnershipCache *kept,
                                      CeldOwnership *ownership);
CeldStatus celd_ownership_cache_update (const CeldOwnershipInput *input, CeldRect new_labels, const CeldHost *host,
                                        CeldOwnershipCache *kept, CeldOwnership *ownership, CeldRect *changed);
void       celd_ownership_cache_clear (CeldOwnershipCache *kept);    /* accepts a zeroed record */

/* ------------------------------------------------------------------ ownership-changes.c */

#define CELD_TILE_CLAIM    1 /* claims have to be repeated */
#define CELD_TILE_COVERAGE 2 /* owners may have changed */

/* Sets both bits of the tiles in which owners may change with the new pens and solid labels. */
CeldStatus celd_ownership_mark_changes (const CeldOwnershipCache *kept, const CeldOwnershipInput *input,
                                        CeldRect new_labels, const CeldContourPens *pens, const bool *solid,
                                        CeldTiles *tiles);

/* Writes the tiles that a claim may touch, as spans; returns their number. */
#define CELD_MAX_CLAIM_SPANS 17
int celd_claim_tiles (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim,
                      CeldTileSpan span[CELD_MAX_CLAIM_SPANS]);

/* ------------------------------------------------------------------ ownership-of-levels.c */

/* The ownership of a picture of levels, with labels 1 .. n for its levels, or for the regions
 * of its levels, the farthest first.  Label k has order[k - 1] as its place in depth, from 0, the original level
 * level[k - 1], and region[k - 1] (0 without regions). */
typedef struct
{
  CeldOwnership own;
  uint32_t     *order, *region;
  float        *level;
  size_t        n;
} CeldLevelOwnership;

/* See celd_expand_levels.  The record has to be cleared also after a failure. */
CeldStatus celd_level_ownership_new (const CeldPlane *ink, const CeldPaint *colours, const CeldPlane *levels,
                                     const CeldLabels *regions, const CeldLabels *corrections, CeldExpansion method,
                                     const CeldHost *host, CeldLevelOwnership *made);
/* The same of levels that are expanded already, which are the larger ones of each pixel; the pictures have one size. */
CeldStatus celd_expanded_ownership_new (const CeldPlane *ink, const CeldPlane *levels, CeldLevelOwnership *made);
void       celd_level_ownership_clear (CeldLevelOwnership *made);

#endif
