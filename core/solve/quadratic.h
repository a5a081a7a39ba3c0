/* A dense quadratic program of few unknowns and inequalities between two of them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_QUADRATIC_H
#define CELD_QUADRATIC_H

#include "base/base.h"

/* ------------------------------------------------------------------ quadratic.c: the program of a few nodes */

/* One inequality u[a] - u[b] >= gap, gap > 0. */
typedef struct { uint32_t a, b; double gap; } CeldInequality;

typedef struct
{
  double energy;    /* 1/2 u'Ku */
  double gap;       /* energy less the value of the dual problem: how far from the least energy at most */
  double violation; /* largest gap - (u[a] - u[b]), as a share of the largest gap; 0 if all hold */
  size_t active;    /* inequalities with a multiplier > 0 */
  int    steps;     /* inequalities taken in and let go */
} CeldCertificate;

/* Minimises 1/2 u'Ku subject to the inequalities.
 * k: n x n, row by row, a weighted graph Laplacian (weights w_ij = -k_ij; of k_ij and k_ji the mean counts, and the
 * diagonal is taken to be their sums, so that rounding does no harm).
 * u: n, out.  Of several minimisers the least: the least u of each component of K is 0, or as little more as the
 * inequalities between components ask for.
 * y: m multipliers >= 0, out, K u = sum of y_i (e_a - e_b); may be NULL.
 * It takes milliseconds for hundreds of nodes and cannot be cancelled.  Should its steps run out, u still obeys the
 * inequalities, and the certificate tells how good it is.
 * CELD_BAD_VALUE: the inequalities close a loop (a == b is one), a gap is not within 1e-12 .. 1e12 or an entry of K
 * beyond 1e30 or NaN, K has a negative eigenvalue.  u, y and the certificate then stay as they were. */
CeldStatus celd_quadratic (size_t n, const double *k, size_t m, const CeldInequality *inequality, double *u, double *y,
                           CeldCertificate *certificate);

#endif
