/* Gaps that hold depth: where the ink between two levels is interrupted only for a short way, depth changes abruptly
 * there too.
 *
 * In eq. (3) of the paper a boundary of levels on paper is virtual, and depth is smooth across it.  That is right where
 * a limb runs open into the body.  But where an outline is broken for a few stroke widths, a region would flood the
 * other through the break.  The two are told apart by their length: the boundary of levels on paper, from ink to ink,
 * is a gap if it fits into a short distance, and an opening otherwise.
 *
 * A drawing may have broader lines than most of it: a gap may also be as many widths long of the lines that it
 * interrupts.  How broad these are is looked at only where a piece is too long otherwise.
 *
 * Boundaries run along pixel edges.  Edges on paper that share a corner make one piece, whose bounding box is measured.
 * A piece that nowhere meets ink is no gap in it.  Contours that are for segmentation only stay smooth.
 *
 * Cost: O(pixels), and the window of discontinuities.c for each pixel edge between different levels, which then need
 * not be weighed again; 1 byte a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "depth/depth.h"

#include <math.h>

#define LONGEST_GAP   12 /* half stroke widths, rounded up; chosen */
#define HAIRLINE_GAP  24 /* pixels: the width of a line of one or two pixels is hardly a measure; chosen, as the next two */
#define SMALLEST_GAP  16 /* pixels of that in a small picture, ... */
#define GAPS_A_SIDE   42 /* ... of which this many have room along the longer side in a larger one */
#define MOST_BROADER  4  /* times as broad as most lines; broader ink is an area; chosen */
#define BROADEST_AREA 3  /* times as broad as a line has to be; broader ink is an area; chosen */
#define DISC_PLACES   16 /* on the rim of a disc, and halfway to it, that are looked at; chosen */

/* While edges are examined: levels differ across the pixel's right (down 0) or lower edge (down 1), and it is not known
 * yet what that makes of it; and this is so for one of the two. */
#define OPEN_EDGE(down) (uint8_t) (4u << (down))
#define OPEN_PIXEL      0x80u

/* The edge between pixel (x,y) and its right (down 0) or lower neighbour (down 1). */
typedef struct { int x, y, down; } PixelEdge;

/* The edges of one piece, with the bounding box of their corners. */
typedef struct
{
  const CeldDepthEdges *edges;
  uint8_t              *cut;
  PixelEdge            *item;
  size_t                n, item_capacity;
  int                   left, top, right, bottom;
  bool                  meets_ink;
  PixelEdge             end[2]; /* where it first meets ink, and where it does farthest from there */
} OpenPiece;

/* ------------------------------------------------------------------ which edges are on paper */

/* Whether the edge lies on a contour that is for segmentation only. */
static bool
stays_smooth (const CeldDepthEdges *edges, const CeldPlane *borders, int x, int y, int down)
{
  CeldDepthEdges drawn = { borders, edges->threshold, edges->radius, NULL };

  return borders && celd_discontinuity_weight (&drawn, x, y, !down, down) <= 0;
}

/* Marks where a row's levels differ from those of their right neighbours, and of the row below. */
CELD_CLONES static void
mark_open (const float *restrict here, const float *restrict below, int n, uint8_t *restrict cut)
{
  for (int x = 0; x < n; x++)
    cut[x] = here[x] != below[x] ? OPEN_PIXEL | OPEN_EDGE (1) : 0;
  for (int x = 0; x + 1 < n; x++)
    cut[x] |= here[x] != here[x + 1] ? OPEN_PIXEL | OPEN_EDGE (0) : 0;
}

/* Cuts the edges of a row that ink cuts, and leaves those open that are on paper. */
static void
examine_row (const CeldDepthEdges *edges, const CeldPlane *borders, const float *level, int y, uint8_t *cut)
{
  int          w = edges->ink->width;
  const float *here = level + (size_t) y * (size_t) w;

  mark_open (here, y + 1 < edges->ink->height ? here + w : here, w, cut);
  for (int x = celd_next_marked (w, cut, 0); x < w; x = celd_next_marked (w, cut, x + 1))
    for (int down = 0; down < 2; down++)
      if (cut[x] & OPEN_EDGE (down))
        {
          if (celd_discontinuity_weight (edges, x, y, !down, down) <= 0)
            cut[x] = (uint8_t) (cut[x] ^ (OPEN_EDGE (down) | CELD_CUT (down)));
          else if (stays_smooth (edges, borders, x, y, down))
            cut[x] = (uint8_t) (cut[x] ^ OPEN_EDGE (down));
        }
}

/* ------------------------------------------------------------------ pieces */

/* The piece meets ink at this edge. */
static void
add_end (OpenPiece *p, PixelEdge at)
{
  if (!p->meets_ink)
    p->end[0] = p->end[1] = at;
  p->meets_ink = true;
  if (hypot (at.x - p->end[0].x, at.y - p->end[0].y) >
      hypot (p->end[1].x - p->end[0].x, p->end[1].y - p->end[0].y))
    p->end[1] = at;
}

/* Adds the edge to the piece if it is on paper. */
static CeldStatus
visit_edge (OpenPiece *p, int x, int y, int down)
{
  uint8_t *here;

  if (x < 0 || y < 0 || x >= p->edges->ink->width || y >= p->edges->ink->height)
    return CELD_OK;
  here = p->cut + (size_t) y * (size_t) p->edges->ink->width + (size_t) x;
  if (*here & CELD_CUT (down))
    add_end (p, (PixelEdge) { x, y, down });
  if (!(*here & OPEN_EDGE (down)))
    return CELD_OK;
  *here &= (uint8_t) ~OPEN_EDGE (down);
  return celd_append (p->item, p->n, p->item_capacity, ((PixelEdge) { x, y, down }));
}

/* Visits the four edges that meet in the upper left corner of pixel (x,y). */
static CeldStatus
visit_corner (OpenPiece *p, int x, int y)
{
  CeldStatus status = visit_edge (p, x - 1, y - 1, 0);

  if (status == CELD_OK)
    status = visit_edge (p, x - 1, y, 0);
  if (status == CELD_OK)
    status = visit_edge (p, x - 1, y - 1, 1);
  if (status == CELD_OK)
    status = visit_edge (p, x, y - 1, 1);
  p->left   = x < p->left ? x : p->left;
  p->top    = y < p->top ? y : p->top;
  p->right  = x > p->right ? x : p->right;
  p->bottom = y > p->bottom ? y : p->bottom;
  return status;
}

/* ------------------------------------------------------------------ gaps of broad lines */

/* Is nearly all ink in a disc? */
static bool
is_inked (const CeldPlane *ink, double x, double y, double radius)
{
  for (int i = 0; i < 2 * DISC_PLACES; i++)
    {
      double angle = 2 * CELD_PI * i / DISC_PLACES, r = i < DISC_PLACES ? radius : radius / 2;
      int    u = (int) floor (x + r * cos (angle)), v = (int) floor (y + r * sin (angle));

      if (u < 0 || v < 0 || u >= ink->width || v >= ink->height || celd_is_paper (CELD_AT (ink, u, v)))
        return false;
    }
  return true;
}

/* Does ink have room for a disc of this diameter beside the edge? */
static bool
has_room (const CeldDepthEdges *edges, PixelEdge at, double diameter)
{
  double reach = edges->radius + diameter, step = fmax (1, diameter / 4);

  for (double dy = -reach; dy <= reach; dy += step)
    for (double dx = -reach; dx <= reach; dx += step)
      if (hypot (dx, dy) <= reach && is_inked (edges->ink, at.x + 0.5 + dx, at.y + 0.5 + dy, diameter / 2))
        return true;
  return false;
}

/* Does a piece of this length end at two lines of which it is a gap, by their widths?  Areas are none. */
static bool
is_gap_of_broad_lines (const OpenPiece *p, double length)
{
  double least = 2 * length / LONGEST_GAP;

  for (int i = 0; i < 2; i++)
    if (!has_room (p->edges, p->end[i], least) || has_room (p->edges, p->end[i], BROADEST_AREA * least))
      return false;
  return true;
}

/* ------------------------------------------------------------------ the whole */

/* Collects the piece of this edge, and cuts it if it is a gap. */
static CeldStatus
hold_piece (OpenPiece *p, int x, int y, int down, CeldGapLength longest)
{
  double     length;
  CeldStatus status;

  p->n         = 0;
  p->left      = p->right = x + 1;
  p->top       = p->bottom = y + 1;
  p->meets_ink = false;
  status       = visit_edge (p, x, y, down);
  for (size_t i = 0; i < p->n && status == CELD_OK; i++)
    {
      PixelEdge e = p->item[i];

      status = visit_corner (p, e.x + 1, e.y + 1);
      if (status == CELD_OK)
        status = visit_corner (p, e.x + !e.down, e.y + e.down);
    }
  length = hypot (p->right - p->left, p->bottom - p->top);
  if (status == CELD_OK && p->meets_ink &&
      (length <= longest.usual || (length <= longest.most && is_gap_of_broad_lines (p, length))))
    for (size_t i = 0; i < p->n; i++)
      p->cut[(size_t) p->item[i].y * (size_t) p->edges->ink->width + (size_t) p->item[i].x] |=
        CELD_CUT (p->item[i].down);
  return status;
}

CeldStatus
celd_gaps_hold (const CeldDepthEdges *edges, const CeldPlane *borders, const float *level, CeldGapLength longest,
                const CeldHost *host, uint8_t *cut)
{
  int        w = edges->ink->width, h = edges->ink->height;
  OpenPiece  piece = { .edges = edges, .cut = cut };
  CeldStatus status = CELD_OK;

  for (int y = 0; y < h && status == CELD_OK; y++)
    {
      examine_row (edges, borders, level, y, cut + (size_t) y * (size_t) w);
      if (y % 64 == 0)
        status = celd_progress (host, (double) y / h);
    }
  for (int y = 0; y < h && status == CELD_OK; y++)
    {
      uint8_t *row = cut + (size_t) y * (size_t) w;

      for (int x = celd_next_marked (w, row, 0); x < w; x = celd_next_marked (w, row, x + 1))
        for (int down = 0; down < 2 && status == CELD_OK; down++)
          if (row[x] & OPEN_EDGE (down))
            status = hold_piece (&piece, x, y, down, longest);
    }
  for (size_t i = 0; i < (size_t) w * (size_t) h; i++)
    cut[i] &= CELD_CUT (0) | CELD_CUT (1);
  celd_free (piece.item);
  return status;
}

CeldGapLength
celd_longest_gap (int stroke, int width, int height)
{
  int    side = width > height ? width : height;
  double hairline = fmin (HAIRLINE_GAP, fmax (SMALLEST_GAP, (double) side / GAPS_A_SIDE));
  double usual = fmax (hairline, LONGEST_GAP * ((stroke + 1) / 2));

  return (CeldGapLength) { usual, MOST_BROADER * usual };
}

CeldStatus
celd_depth_edges (const CeldPlane *ink, const CeldPlane *borders, const float *level, int stroke,
                  const CeldSettings *settings, const CeldHost *host, CeldDepthEdges *edges, uint8_t **cut)
{
  CeldStatus status = CELD_NO_MEMORY;

  *cut   = NULL;
  *edges = (CeldDepthEdges) { ink, settings->ink_threshold, celd_edge_radius (stroke), NULL };
  if (!settings->hold_gaps)
    return CELD_OK;
  *cut = celd_alloc ((size_t) ink->width * (size_t) ink->height, sizeof **cut);
  if (*cut)
    status = celd_gaps_hold (edges, borders, level, celd_longest_gap (stroke, ink->width, ink->height), host,
                             *cut);
  edges->cut = *cut;
  return status;
}
