/* What the files of the dense quadratic program share: the matrices, and the forest of active inequalities.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_QUADRATIC_PRIVATE_H
#define CELD_QUADRATIC_PRIVATE_H

#include "solve/quadratic.h"

#define CELD_NO_LINK UINT32_MAX

/* Active inequalities hold with equality: they join nodes to trees that move as one, each node at a fixed offset from
 * the root of its tree.  Trees that K or a link connects are a body: deforming it costs energy, a translation does
 * not. */
typedef struct
{
  size_t                n, m;
  const CeldInequality *inequality;

  uint32_t *active;                   /* the links: numbers of inequalities, n - 1 at most */
  size_t    n_active;
  uint32_t *order;                    /* nodes, each after its parent */
  uint32_t *parent;                   /* of a node, in its tree */
  uint32_t *link;                     /* to the parent, a place in `active`; CELD_NO_LINK: a root */
  uint32_t *tree;                     /* of a node, numbered from 0 */
  double   *offset;                   /* of a node from its root */
  size_t    n_trees;
  uint32_t *component;                /* of a node, in K alone, numbered from 0 */
  uint32_t *body;                     /* of a component: the number of one of its components */
  size_t    n_components;

  double   *weight;                   /* n x n, w_ij of K */
  double   *pull;                     /* of a node, the sum of its weights */
  double   *inverse;                  /* n x n, H: the motion that forces cause; trees are rigid, each body is held at
                                       * one of its trees */
  double   *work;                     /* n x n */
  double   *row;                      /* n */
  uint32_t *entry;                    /* 5 n, for walks */
  bool      fresh;                    /* no update of H since its set-up */
} CeldForest;

/* ------------------------------------------------------------------ quadratic-matrix.c */

/* Weights and components of K. */
void celd_forest_read (CeldForest *forest, const double *k);

/* Computes H anew; false if K has an eigenvalue that is not positive, other than those of its components.  O(n^3). */
bool celd_forest_set_up (CeldForest *forest);

/* image = K x, of differences; image = H x. */
void celd_forest_force (const CeldForest *forest, const double *x, double *image);
void celd_forest_motion (const CeldForest *forest, const double *x, double *image);

/* ------------------------------------------------------------------ quadratic-forest.c */

/* Follows a change of the active inequalities: trees, offsets, bodies. */
void celd_forest_walk (CeldForest *forest);

/* What each link carries of forces that are balanced on each tree: r[place], positive if it pushes its ends apart.
 * The forces are used up. */
void celd_forest_flow (const CeldForest *forest, double *force, double *r);

/* Joins two bodies by inequality p; they are one body from then on. */
void celd_forest_join (CeldForest *forest, uint32_t p);

/* Joins two trees of a body by inequality p, with z = H (e_a - e_b) and its curvature z_a - z_b. */
void celd_forest_add (CeldForest *forest, uint32_t p, const double *z, double curvature);

/* Parts a tree at the link in this place of `active`; the last link takes that place.  One side can then move past the
 * other: `way` is its cheapest motion by 1, force = K way, and the curvature is what that costs twice; 0 if the body
 * falls apart, and if H had to be computed anew (there is no way then).  False if K has a negative eigenvalue. */
bool celd_forest_drop (CeldForest *forest, size_t place, double *way, double *force, double *curvature);

/* Has H lost digits?  x is a motion by H, force = K x. */
bool celd_forest_is_inaccurate (const CeldForest *forest, double curvature, const double *x, const double *force);

/* ------------------------------------------------------------------ quadratic-active-set.c */

typedef struct
{
  CeldForest forest;
  double    *u, *z, *force, *r; /* n each */
  double    *y;                 /* m multipliers */
  double     range;             /* of u and offsets, to judge rounding by */
  int        steps, most_steps;
} CeldActiveSet;

/* From the links of the forest to the solution, the last active set and its multipliers.  False if K has a negative
 * eigenvalue. */
bool   celd_active_set_solve (CeldActiveSet *set);

/* How far inequality i is from holding; 0 if it does but for rounding. */
double celd_violation (const CeldActiveSet *set, size_t i);

#endif
