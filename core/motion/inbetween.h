/* In-betweens: the drawings between two keys, of which each is a puppet of completed layers.
 *
 *   cell-motion.c        motions of cells, and what they carry
 *   part-lines.c         the lines of a part in each key
 *   part-pose.c          the rigid motion of a part from one key to the other
 *   part-match.c         where each vertex of a key's lattice is in the other key
 *   part-hiding.c        where parts go that are seen in one key alone
 *   between-shape.c      the lattices between the keys, as rigid as possible
 *   between-flags.c      which pixels of a layer are known from which key
 *   between-draw.c       parts from back to front, each from one key
 *   inbetween.c          the steps
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_INBETWEEN_H
#define CELD_INBETWEEN_H

#include "motion/puppet.h"

/* Lengths of these files are made for drawings whose longer side has so many pixels, and scale with it. */
#define CELD_KEY_SIDE 640.f

/* An affine motion of the plane: takes `from` to `to`, and vectors by the matrix xx, xy, yx, yy. */
typedef struct { float from[2], to[2], matrix[4]; } CeldAffine;

static inline void
celd_affine_map (const CeldAffine *motion, float x, float y, float place[2])
{
  float dx = x - motion->from[0], dy = y - motion->from[1];

  place[0] = motion->to[0] + motion->matrix[0] * dx + motion->matrix[1] * dy;
  place[1] = motion->to[1] + motion->matrix[2] * dx + motion->matrix[3] * dy;
}

#define CELD_CARRIERS 4 /* cells that carry a vertex of the other key's lattice */

/* The cells of the first key's lattice that carry a vertex of the second key's, and their shares. */
typedef struct { uint32_t cell[CELD_CARRIERS]; float share[CELD_CARRIERS]; } CeldCarriers;

/* A part: the layers of one label in both keys. */
typedef struct
{
  uint32_t     label;
  size_t       layer[2];       /* of each key; CELD_NO_INDEX: it is not seen there */
  /* of a part that is seen in one key alone: */
  bool         follows;        /* whether it moves with another part, or stays where it is */
  float        joint[2];       /* where it is attached to that part */
  CeldCarriers carriers;       /* cells of that part there */
  float        away[2];        /* its own motion to where it is hidden in the other key */
  bool         hides;          /* whether it is hidden there, and so can be drawn all the way */
  bool         mixed[2];       /* of a part of both keys: whether the other key shows more of it than this one */
} CeldBetweenPart;

/* A vertex of a layer, and where it is at rest. */
typedef struct { float x, y; uint32_t vertex; size_t layer; } CeldRestVertex;

typedef struct CeldShaping CeldShaping; /* between-shape.c */

struct CeldInbetween
{
  int              width, height;
  CeldPuppet      *key[2];
  float          **flags[2];   /* of each layer of a key: a picture as its rgba; see between-flags.c */
  CeldBetweenPart *part;
  size_t           n;
  CeldBetweenPart **of_layer[2]; /* the part of each layer of a key */
  float           *end[2];     /* of each vertex of a key's lattice: its place in the other key */
  bool            *known[2];   /* whether that is known: not of parts of one key alone */
  CeldRestVertex  *rest;       /* the vertices of all layers of the first key, by place */
  size_t           n_rest;
  CeldCarriers    *carrier;    /* of each vertex of the second key's lattice */
  CeldShaping     *shaping;
};

/* Whether a part moves and is seen in both keys. */
static inline bool
celd_between_both (const CeldInbetween *between, const CeldBetweenPart *part)
{
  return part->layer[0] != CELD_NO_INDEX && part->layer[1] != CELD_NO_INDEX &&
         between->key[0]->layer[part->layer[0]].n_cells && between->key[1]->layer[part->layer[1]].n_cells;
}

/* The share of the way from which on parts are drawn from the second key. */
#define CELD_SECOND_KEY 0.5

/* ------------------------------------------------------------------ cell-motion.c */

/* The motion of a cell between two sets of places of its vertices, in the middle affine. */
CeldAffine celd_cell_motion (const CeldLattice *lattice, size_t cell, const float *from, const float *to);

/* Where the cells of a place carry it, by their motions. */
void celd_carry (const CeldCarriers *carriers, const CeldAffine *motion, float x, float y, float place[2]);

/* The cells, of n, whose middles are nearest to a place; their motions begin at their middles. */
CeldCarriers celd_carriers_at (const CeldAffine *motion, size_t n, float side, float x, float y);

/* ------------------------------------------------------------------ part-lines.c */

typedef struct { float x, y, weight; } CeldLinePoint;    /* in the window */

#define CELD_LINE_POINTS 200

/* The lines of a part in one key: its outline, and the ink that is seen on it.  Tight pictures of a window. */
typedef struct
{
  CeldRect      window;        /* of the drawing */
  uint8_t      *seen;          /* 1 on lines that are seen */
  uint8_t      *all;           /* also on those that nearer parts hide */
  uint8_t      *hidden;        /* 1 where something is in front of the part, or would be */
  int32_t      *squared;       /* squared distance to lines */
  size_t        n_seen, n_all; /* pixels */
  float         centre[2];     /* of the part, in the window */
  float         extent;        /* of its box, the longer side */
  CeldLinePoint point[CELD_LINE_POINTS];
  size_t        n_points;
} CeldPartLines;

CeldStatus celd_part_lines_new   (const CeldPuppet *puppet, size_t layer, const CeldPlane *ink, CeldRect window,
                                  const CeldHost *host, CeldPartLines *lines);
void       celd_part_lines_clear (CeldPartLines *lines);           /* accepts a zeroed record */

/* ------------------------------------------------------------------ part-pose.c */

/* A rigid motion: turned by an angle in radians round (x,y), which it takes to (to_x,to_y). */
typedef struct { float angle, x, y, to_x, to_y; } CeldPartPose;

/* A place of the part that touches another part, and where that is in the second key; in the window. */
typedef struct { size_t layer; float from[2], to[2]; } CeldPartBond;

/* Where a pose takes a place; and the inverse pose. */
void         celd_part_pose_map  (const CeldPartPose *pose, float x, float y, float place[2]);
CeldPartPose celd_part_pose_back (const CeldPartPose *pose);

/* The best rigid motion from the first key's lines to the second one's.  Bonds are in the order of their layers. */
void celd_part_pose_find (const CeldPartLines lines[2], float scale, const CeldPartBond *bond, size_t n,
                          const CeldHost *host, CeldPartPose *pose);

/* ------------------------------------------------------------------ part-match.c */

/* Finds the ends of both keys' vertices, and the carriers of the second key's. */
CeldStatus celd_parts_match (CeldInbetween *between, const CeldKey key[2], const CeldSettings *settings,
                             const CeldHost *host);

/* ------------------------------------------------------------------ part-hiding.c */

/* Finds what parts of one key alone move with, and where they are hidden in the other key. */
CeldStatus celd_parts_hide (CeldInbetween *between, const CeldKey key[2], const CeldHost *host);

/* Places the vertices of the parts that key s alone has, whose others are placed, at a share of the way to the other
 * key. */
void       celd_parts_follow (CeldInbetween *between, int s, float share);

/* ------------------------------------------------------------------ between-shape.c */

CeldStatus celd_shaping_new  (CeldInbetween *between);
void       celd_shaping_free (CeldShaping *shaping);               /* accepts NULL */

/* Places the vertices of both keys' lattices for the share t of the way, [0,1]. */
void       celd_between_shape (CeldInbetween *between, double t);

/* ------------------------------------------------------------------ between-flags.c */

/* Finds the flags of the pixels of all layers, as pictures of two shares, times alpha, a third that is 0, and alpha.
 * CELD_KEY_SEEN is 1 where the layer is seen in its own key, CELD_KEY_UNKNOWN where the other key says nothing of the
 * place: it is hidden there, or outside of the frame. */
enum { CELD_KEY_SEEN, CELD_KEY_UNKNOWN };
CeldStatus celd_between_flags (CeldInbetween *between);

#endif
