/* Motion: a square lattice that a drawing is embedded into, and its registration to another drawing.
 *
 *   silhouette.c        what of a drawing moves
 *   lattice.c           embedding into squares that are torn at cracks
 *   lattice-cells.c     labels, levels and pieces of cells
 *   lattice-shape.c     the shape of a lattice: as rigid as possible
 *   lattice-maps.c      where each pixel goes
 *   lattice-warp.c      a drawing as a lattice carries it
 *   lattice-of-levels.c the lattice of a picture of levels
 *   match-images.c      pictures that are matched, coarse to fine
 *   match-blocks.c      the push phase: where the squares fit the target
 *   alignment.c         rigid alignment of all that moves
 *   swing.c             poses of parts that move far
 *   swing-pieces.c      pieces of the lattice, for these poses
 *   register.c          registration
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_MOTION_H
#define CELD_MOTION_H

#include "image/image.h"

#include <math.h>

/* Whether item i of n is among about `most` evenly spread ones. */
static inline bool
celd_is_sample (size_t i, size_t n, size_t most)
{
  return n <= most || i * most / n != (i + 1) * most / n;
}

/* ------------------------------------------------------------------ lattice.c */

/* Corner k of a cell is at x = k % 2, y = k / 2. */
struct CeldLattice
{
  int       width, height;     /* of the drawing */
  int       side;              /* of a cell in pixels */
  size_t    n_vertices, n_cells, n_seams;
  float    *rest, *place;      /* x, y of each vertex: in the drawing, and where it is now */
  uint32_t *corner;            /* four vertices of each cell */
  uint32_t *label, *level;     /* of each cell: of most of its pixels */
  uint32_t *piece;             /* of each cell; cells with common vertices are of one piece, 0, 1, ... */
  size_t    n_pieces;
  uint32_t *seam;              /* pairs of vertices that were torn apart by a crack */
  uint32_t *cell;              /* of each pixel, + 1; 0 outside the silhouette */
};

/* Whether two labels are one of the pairs. */
static inline bool
celd_is_crack (const CeldCrack *crack, size_t n, uint32_t a, uint32_t b)
{
  for (size_t i = 0; i < n; i++)
    if ((crack[i].nearer == a && crack[i].farther == b) || (crack[i].nearer == b && crack[i].farther == a))
      return true;
  return false;
}

/* The side of cells for a drawing of this size: that of the settings, or one by its diagonal. */
int celd_cell_side (int width, int height, const CeldSettings *settings);

/* lattice-cells.c: fills in rest, label and level; and piece.  Corners, cells of pixels and memory are there. */
CeldStatus celd_lattice_describe (const CeldLabels *labels, const CeldMovingParts *parts, CeldLattice *lattice);
CeldStatus celd_lattice_pieces   (CeldLattice *lattice);

static inline uint32_t
celd_lattice_cell (const CeldLattice *lattice, int x, int y)
{
  return lattice->cell[(size_t) y * (size_t) lattice->width + (size_t) x];
}

/* Where a cell takes the point (x,y) of the drawing, even outside of it: bilinear in the places of its corners. */
static inline void
celd_cell_map (const CeldLattice *lattice, size_t cell, float x, float y, float place[2])
{
  const uint32_t *corner = lattice->corner + 4 * cell;
  const float    *from = lattice->rest + 2 * (size_t) corner[0], *p[4];
  float           u = (x - from[0]) / (float) lattice->side, v = (y - from[1]) / (float) lattice->side;

  for (int k = 0; k < 4; k++)
    p[k] = lattice->place + 2 * (size_t) corner[k];
  for (int i = 0; i < 2; i++)
    place[i] = (1 - v) * ((1 - u) * p[0][i] + u * p[1][i]) + v * ((1 - u) * p[2][i] + u * p[3][i]);
}

/* ------------------------------------------------------------------ silhouette.c */

/* Labels of what moves, 1 without parts, in a tight picture of the ink's size; 0 elsewhere.  Without parts it is what
 * paper along the frame does not reach except through gaps, which may be as wide as cells of that side.
 * CELD_NOTHING_TO_GO_BY if nothing moves. */
CeldStatus celd_silhouette (const CeldPlane *ink, const CeldMovingParts *parts, int side, const CeldHost *host,
                            CeldLabels *label);

/* ------------------------------------------------------------------ lattice-shape.c */

/* What pulls at a vertex: a place with a weight, in multiples of the pull of a cell; weight 0: nothing. */
typedef struct { float x, y, weight; } CeldPull;

/* Makes all cells as rigid as possible by `sweeps` sweeps [SDC09a]: each cell proposes the rigid motion of its rest
 * pose that is nearest to its corners' places, and each vertex moves to the mean of proposals.  `pull` (may be NULL)
 * has an item for each vertex; `seams` is the weight by which torn vertices attract each other.  `scratch` has room for
 * 3 x n_vertices floats. */
void celd_lattice_relax (CeldLattice *lattice, int sweeps, const CeldPull *pull, float seams, float *scratch);

/* The area of a cell relative to its rest pose; negative if it is folded over. */
float celd_cell_area (const CeldLattice *lattice, size_t cell);

/* ------------------------------------------------------------------ match-images.c */

#define CELD_ON_INK   0.6f /* nearness to ink of what counts as ink of a scale; chosen */
#define CELD_NEARNESS 4 /* pixels of a scale: from here on there is no ink near; chosen */

/* Two drawings at one scale, as nearness to ink: 1 on ink, falling to 0 at CELD_NEARNESS pixels of this scale. */
typedef struct
{
  int    factor;               /* pixels of the drawing in one of this scale, along each side */
  int    width, height;
  int    pad;                  /* pixels around `target` */
  float *source, *target;      /* the second is padded; stride width + 2 pad */
  const int32_t *nearest;      /* pixel of ink of the source that is nearest to each pixel of the drawing */
  const uint8_t *hidden[2];    /* of source and target, of each pixel of the drawing: 1 where nothing is known; NULL: all
                                * is */
} CeldMatchImages;

/* Squared distances to ink, in pixels of the drawing.  `nearest` must outlive the images. */
CeldStatus celd_match_images_new   (int width, int height, const int32_t *source, const int32_t *nearest,
                                    const int32_t *target, int factor, int pad, CeldMatchImages *images);
void       celd_match_images_clear (CeldMatchImages *images);              /* accepts a zeroed record */

/* Whether the pixel (x,y) of the drawing, in that cell, sees no ink near, or ink of its own piece.  Lines of others
 * move on their own, and say nothing about where it goes. */
static inline bool
celd_match_own (const CeldMatchImages *images, const CeldLattice *lattice, size_t cell, int x, int y)
{
  int32_t  ink = images->nearest[(size_t) y * (size_t) lattice->width + (size_t) x];
  uint32_t owner = ink < 0 ? 0 : lattice->cell[ink];

  return images->source[(y / images->factor) * images->width + x / images->factor] <= 0 ||
         (owner && lattice->piece[owner - 1] == lattice->piece[cell]);
}

/* ------------------------------------------------------------------ match-blocks.c */

#define CELD_MATCH_REACH 4     /* pixels of a scale: how far a vertex is pushed at once; chosen */

typedef struct CeldMatcher CeldMatcher;

/* The state of the push phase at one scale.  It reads lattice and images, which must outlive it. */
CeldStatus celd_matcher_new  (const CeldLattice *lattice, const CeldMatchImages *images, CeldMatcher **matcher);
void       celd_matcher_free (CeldMatcher *matcher);                       /* accepts NULL */

/* Finds where the cells around each vertex fit the target best, within CELD_MATCH_REACH, and how badly all of the
 * lattice fits as it lies: the mean squared difference.  Pixels that nearer cells hide have no part in it, and a vertex
 * with little ink or little that is visible is not pulled. */
void celd_matcher_push (CeldMatcher *matcher, const CeldHost *host, CeldPull *pull, double *misfit);

/* Visible ink as the lattice lies, in pixels of the scale: lists at most `most` places, evenly chosen, with their
 * cells. Returns their number. */
typedef struct { float x, y; uint32_t cell; } CeldInkPlace;
size_t celd_matcher_ink (CeldMatcher *matcher, size_t most, CeldInkPlace *ink);

/* How well each vertex fits, 0 .. 1: the part of the ink around it, in either drawing, that lies on ink of the other;
 * negative where there is nothing to see. */
void celd_matcher_fit (CeldMatcher *matcher, float *fit);

/* ------------------------------------------------------------------ alignment.c */

/* Moves all of the lattice by the rigid motion, of those that turn it by at most half a right angle, that takes most
 * ink to ink.  Not at all if that is hardly better than no motion. */
CeldStatus celd_align (CeldLattice *lattice, const CeldMatchImages *images, CeldMatcher *matcher, const CeldHost *host);

/* ------------------------------------------------------------------ swing.c */

/* Moves each piece of the lattice, as a rigid whole, to where it fits the target best, however far its limbs swing. */
CeldStatus celd_swing (CeldLattice *lattice, const CeldMatchImages *images, const CeldHost *host);

/* ------------------------------------------------------------------ register.c */

/* Tight pictures of a drawing: 1 on lines; and 1 where nothing is known of them (NULL: all is). */
typedef struct { const uint8_t *line, *hidden; } CeldLineMarks;

/* Registers a lattice so that lines of the source lie on lines of the target, which have its size.  If it lies in the
 * right pose already, `posed`, there is no search for one.  `fit` gets what celd_matcher_fit finds.
 * CELD_NOTHING_TO_GO_BY if there are no lines in one of them; after a failure the lattice is as before. */
CeldStatus celd_register_lines (CeldLineMarks source, CeldLineMarks target, bool posed, const CeldSettings *settings,
                                const CeldHost *host, CeldLattice *lattice, float *fit);

#endif
