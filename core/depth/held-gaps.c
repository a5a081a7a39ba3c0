/* Gaps that hold depth: where the ink between two levels is interrupted only for a short way, depth changes abruptly
 * there too.
 *
 * In eq. (3) of the paper a boundary of levels on paper is virtual, and depth is smooth across it.  That is right where
 * a limb runs open into the body.  But where an outline is broken for a few stroke widths, a region would flood the
 * other through the break.  The two are told apart by their length: the boundary of levels on paper, from ink to ink,
 * is a gap if it fits into a short distance, and an opening otherwise.
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

#define LONGEST_GAP 12 /* half stroke widths, rounded up; chosen */

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

/* Adds the edge to the piece if it is on paper. */
static CeldStatus
visit_edge (OpenPiece *p, int x, int y, int down)
{
  uint8_t *here;

  if (x < 0 || y < 0 || x >= p->edges->ink->width || y >= p->edges->ink->height)
    return CELD_OK;
  here = p->cut + (size_t) y * (size_t) p->edges->ink->width + (size_t) x;
  p->meets_ink = p->meets_ink || *here & CELD_CUT (down);
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

/* Collects the piece of this edge, and cuts it if it is a gap. */
static CeldStatus
hold_piece (OpenPiece *p, int x, int y, int down, double longest)
{
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
  if (status == CELD_OK && p->meets_ink && hypot (p->right - p->left, p->bottom - p->top) <= longest)
    for (size_t i = 0; i < p->n; i++)
      p->cut[(size_t) p->item[i].y * (size_t) p->edges->ink->width + (size_t) p->item[i].x] |=
        CELD_CUT (p->item[i].down);
  return status;
}

CeldStatus
celd_gaps_hold (const CeldDepthEdges *edges, const CeldPlane *borders, const float *level, double longest,
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

double
celd_longest_gap (int stroke)
{
  return LONGEST_GAP * (stroke > 2 ? (stroke + 1) / 2 : 1);
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
    status = celd_gaps_hold (edges, borders, level, celd_longest_gap (stroke), host, *cut);
  edges->cut = *cut;
  return status;
}
