/* The exact route: depth as the solution of a quadratic program (eq. 1 and 2 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PROGRAM_H
#define CELD_PROGRAM_H

#include "solve/laplace.h"

/* ------------------------------------------------------------------ program-bases.c: one basis for each node */

/* A node is a set of pixels that move as one, a scribble, or a single pixel, the end of a relation off every scribble.
 * The basis h_k of node k is 1 on its pixels, 0 on those of other nodes, and harmonic elsewhere: the probability that a
 * random walker who sets out there comes to node k first.  Together they are 1 everywhere, so that of node 1 is not
 * kept.  d = sum of u_k h_k is the depth of least energy that has the value u_k on node k. */
typedef struct
{
  int          width, height;
  const float *east, *south;    /* weights, borrowed */
  uint32_t    *node;            /* of each pixel, from 1; 0 in none */
  uint32_t     n, n_sets;       /* nodes; the first of them are sets, the others single pixels */
  size_t      *pixel;           /* of node n_sets + 1 + i; grown one by one */
  float      **group;           /* of CELD_LANES bases each, interleaved: h_k (p), k > 1, is lane
                                 * (k - 2) % CELD_LANES of pixel p in group[(k - 2) / CELD_LANES] */
  size_t       n_groups;
  double      *stiffness;       /* n x n: K_kl = sum over edges of w_pq (h_k(p) - h_k(q)) (h_l(p) - h_l(q)) */
  size_t       pixel_capacity, group_capacity;
} CeldHarmonicBases;

/* Nodes for these pixels, all at once: bases and stiffness.  Whatever the tolerance, bases are exactly 1 and 0 on the
 * nodes.  node: tight, 0 .. n_sets; each pixel of a point in none, and no two alike; at least one node has a pixel.
 * Starts from the bases that there are; `bases` needs width, height and weights before the first call.  After a failure
 * there are no nodes. */
CeldStatus celd_bases_make (CeldHarmonicBases *bases, const uint32_t *node, uint32_t n_sets, const size_t *point,
                            size_t n_points, double tolerance, const CeldHost *host, CeldSolve *solve);

/* No nodes any more. */
void       celd_bases_clear (CeldHarmonicBases *bases);

/* depth = sum of u_k h_k, within the extremes of u. */
CeldStatus celd_bases_compose (const CeldHarmonicBases *bases, const double *u, const CeldHost *host, CeldPlane *depth);

/* What program-nodes.c shares: the first lane of a basis, not of node 1; groups that so many nodes need. */
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

/* At least so many groups, of which new ones are zero; and at most so many. */
CeldStatus celd_bases_grow (CeldHarmonicBases *b, size_t n_groups);
void       celd_bases_shrink (CeldHarmonicBases *b, size_t n_groups);

/* The solver that knows the nodes. */
CeldStatus celd_bases_set_up (const CeldHarmonicBases *b, const CeldHost *host, CeldLaplace **laplace);

/* ------------------------------------------------------------------ program-nodes.c: nodes come and go */

/* One more node for each of these pixels, which are in none: one solution each.  After a failure the nodes are those
 * before. */
CeldStatus celd_bases_add (CeldHarmonicBases *bases, const size_t *point, size_t n_points, double tolerance,
                           const CeldHost *host, CeldSolve *solve);

/* Lets go of a single pixel, not node 1, without a solution.  The last node takes its number. */
void       celd_bases_drop (CeldHarmonicBases *bases, uint32_t node);

/* ------------------------------------------------------------------ program-stiffness.c */

/* Fills in the stiffness of the bases: the energies of their pairs, so that an inexact basis raises the energy of the
 * result a little, to second order, but never breaks a constraint. */
CeldStatus celd_stiffness (CeldHarmonicBases *bases, const CeldHost *host);

/* The energies of one more basis, a tight plane: with each of the n bases, and of its own.  room: as many numbers as
 * celd_stiffness_room says for so many nodes or more. */
void       celd_stiffness_of (const CeldHarmonicBases *bases, const float *basis, const CeldHost *host, double *room,
                              double *with, double *own);
size_t     celd_stiffness_room (size_t n);

/* ------------------------------------------------------------------ program.c, exact-depth.c: kept between edits */

/* A drawing, its scribbles, and what was solved for them. */
typedef struct CeldProgram CeldProgram;

CeldProgram *celd_program_new (void);                      /* NULL: no memory */
void         celd_program_free (CeldProgram *program);     /* accepts NULL */

/* The drawing, which the caller keeps as it is until the next call of this function; what was solved is forgotten. */
CeldStatus celd_program_set_ink (CeldProgram *program, const CeldPlane *ink, const CeldSettings *settings,
                                 const CeldHost *host);

/* The scribbles, of the size of the ink and after it; copied.  What was solved is where the next solution starts. */
CeldStatus celd_program_set_seeds (CeldProgram *program, const CeldLabels *seeds, const CeldPalette *palette,
                                   CeldSameColour same_colour, const CeldHost *host);

/* The pixel that a point means: itself, or on ink the nearest paper within one stroke width; false if it is outside. */
bool celd_program_find (CeldProgram *program, double x, double y, size_t *pixel);

/* Makes these pixels nodes beside the scribbles, each unless it is on one, and brings bases and stiffness up to date,
 * with as few solutions as possible. */
CeldStatus celd_program_place (CeldProgram *program, const size_t *point, size_t n_points, double tolerance,
                               const CeldHost *host);

/* See celd_depth_exact; of the settings those of the encoding and the tolerance matter. */
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
