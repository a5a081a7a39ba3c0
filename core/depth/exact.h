/* The exact program: depth as the solution of the paper's quadratic program, eq. (1) and (2).
 *
 *   exact-program.c    the program: relations to inequalities, its solution, depth
 *   exact-kept.c       what is kept between edits
 *   exact-bases.c      harmonic bases of the nodes
 *   exact-nodes.c      adding and removing single nodes
 *   exact-stiffness.c  the stiffness matrix
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PROGRAM_H
#define CELD_PROGRAM_H

#include "solve/laplace.h"

/* ------------------------------------------------------------------ exact-bases.c: one basis for each node */

/* A node is a set of pixels of equal depth: a scribble, or the single pixel of a relation's end off every scribble.
 * The harmonic basis h_k of node k is 1 on its pixels, 0 on those of other nodes, and harmonic elsewhere: the
 * probability that a random walker from there reaches node k first.  The bases add up to 1, so that of node 1 is not
 * stored.  d = sum of u_k h_k is the depth of least energy with the value u_k on each node k. */
typedef struct
{
  int          width, height;
  const float *east, *south;    /* weights, borrowed */
  uint32_t    *node;            /* of each pixel, from 1; 0 in none */
  uint32_t     n, n_sets;       /* nodes; the first n_sets may have many pixels, the others have one */
  size_t      *pixel;           /* of node n_sets + 1 + i; grown one by one */
  float      **group;           /* of CELD_LANES bases each, interleaved: h_k (p), k > 1, is lane
                                 * (k - 2) % CELD_LANES of pixel p in group[(k - 2) / CELD_LANES] */
  size_t       n_groups;
  double      *stiffness;       /* n x n: K_kl = sum over edges of w_pq (h_k(p) - h_k(q)) (h_l(p) - h_l(q)) */
  size_t       pixel_capacity, group_capacity;
} CeldHarmonicBases;

/* Makes bases and stiffness for the nodes given by `node`, a tight plane of 0 .. n_sets, and the pixels point[i], which
 * must be distinct and in no node; at least one node must have a pixel.  Bases are exactly 1 and 0 on the nodes,
 * elsewhere within the tolerance.  The solver starts from the present bases, if any; before the first call `bases`
 * needs width, height and weights.  After a failure there are no nodes. */
CeldStatus celd_bases_make (CeldHarmonicBases *bases, const uint32_t *node, uint32_t n_sets, const size_t *point,
                            size_t n_points, double tolerance, const CeldHost *host, CeldSolve *solve);

/* Removes all nodes; size and weights stay. */
void       celd_bases_clear (CeldHarmonicBases *bases);

/* depth = sum of u_k h_k, clamped to the least and largest u_k; u has n numbers, depth the size of the bases. */
CeldStatus celd_bases_compose (const CeldHarmonicBases *bases, const double *u, const CeldHost *host, CeldPlane *depth);

/* Shared with exact-nodes.c: the first lane of the basis of a node other than 1; the groups that n nodes need. */
static inline float *
celd_bases_lane (const CeldHarmonicBases *b, uint32_t node)
{
  return b->group[(node - 2) / CELD_LANES] + (node - 2) % CELD_LANES;
}

static inline size_t
celd_bases_groups (uint32_t n)
{
  return n > 1 ? (n - 2) / CELD_LANES + 1 : 0;
}

/* Adds groups, with bases of 0, until there are n_groups; removes groups until there are n_groups. */
CeldStatus celd_bases_grow (CeldHarmonicBases *b, size_t n_groups);
void       celd_bases_shrink (CeldHarmonicBases *b, size_t n_groups);

/* Sets up a solver with the pixels of all nodes fixed; freed with celd_lap_free. */
CeldStatus celd_bases_set_up (const CeldHarmonicBases *b, const CeldHost *host, CeldLaplace **laplace);

/* ------------------------------------------------------------------ exact-nodes.c */

/* Adds a node for each of these pixels, which must be in none: one solution each.  After a failure the nodes are as
 * before. */
CeldStatus celd_bases_add (CeldHarmonicBases *bases, const size_t *point, size_t n_points, double tolerance,
                           const CeldHost *host, CeldSolve *solve);

/* Removes a node of one pixel, other than node 1, without a solution.  The last node takes its number. */
void       celd_bases_drop (CeldHarmonicBases *bases, uint32_t node);

/* ------------------------------------------------------------------ exact-stiffness.c */

/* Fills in the stiffness matrix: the energies of pairs of bases as they are.  So an inexact basis raises the energy of
 * the result to second order, but never violates a constraint. */
CeldStatus celd_stiffness (CeldHarmonicBases *bases, const CeldHost *host);

/* The energies of another basis, a tight plane, with each of the n bases and with itself.  `room` is work space of
 * celd_stiffness_room (n) numbers. */
void       celd_stiffness_of (const CeldHarmonicBases *bases, const float *basis, const CeldHost *host, double *room,
                              double *with, double *own);
size_t     celd_stiffness_room (size_t n);

/* ------------------------------------------------------------------ exact-kept.c, exact-program.c */

/* A drawing, its scribbles, and what was solved for them, for reuse after edits. */
typedef struct CeldProgram CeldProgram;

CeldProgram *celd_program_new (void);                      /* NULL: no memory */
void         celd_program_free (CeldProgram *program);     /* accepts NULL */

/* Sets the drawing, and discards what was solved.  The ink is borrowed: it must stay as it is until this function is
 * called again or the program is freed.  After a failure there is no drawing. */
CeldStatus celd_program_set_ink (CeldProgram *program, const CeldPlane *ink, const CeldSettings *settings,
                                 const CeldHost *host);

/* Sets the scribbles, which have the size of the ink and are copied; the ink must be set.  The next solution starts
 * from what was solved before. */
CeldStatus celd_program_set_seeds (CeldProgram *program, const CeldLabels *seeds, const CeldPalette *palette,
                                   CeldSameColour same_colour, const CeldHost *host);

/* Finds the pixel for the end of a relation at (x,y): the pixel there or, on ink, the nearest paper within one stroke
 * width; *pixel = y * width + x.  False if the point is outside the drawing. */
bool celd_program_find (CeldProgram *program, double x, double y, size_t *pixel);

/* Makes each of these pixels a node, unless it is on a scribble, and updates bases and stiffness with as few solutions
 * as possible. */
CeldStatus celd_program_place (CeldProgram *program, const size_t *point, size_t n_points, double tolerance,
                               const CeldHost *host);

/* As celd_depth_exact; of the settings only encoding, tolerance and on_cycle matter. */
CeldStatus celd_program_solve (CeldProgram *program, const CeldRelations *relations, const CeldSettings *settings,
                               const CeldHost *host, CeldPlane *depth, CeldExact *exact, CeldProblems *problems);

struct CeldProgram
{
  const CeldPlane *ink;         /* borrowed */
  float           *east, *south;
  double           sigma;
  int              stroke;      /* width of the strokes of the ink; -1: not measured yet */
  CeldLabels       nodes;       /* the scribbles; data NULL: none yet */
  CeldPalette      palette;     /* of the nodes */
  uint32_t        *label;       /* of each node: its label as the caller numbers them */
  bool             stale;       /* the nodes are not those of the bases */
  CeldHarmonicBases        bases;
  double           tolerance;   /* that the bases were made to */
  CeldSolve        solve;       /* how that went */
};

#endif
