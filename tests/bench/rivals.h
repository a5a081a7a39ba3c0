/* Solvers that the Laplacian solver is measured against, on the same systems.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef RIVALS_H
#define RIVALS_H

#include "bench.h"

/* Eq. (3) of a drawing: weights, and which pixels keep their value. */
typedef struct
{
  int      width, height;
  size_t   n;
  float   *east, *south, *value;    /* value: of fixed pixels */
  uint8_t *fixed;
} System;

/* The same for the pixels that a fixed one reaches and that are not fixed themselves, with folded-in values. */
typedef struct
{
  size_t    n;
  size_t   *pixel;                  /* of unknown i */
  uint32_t *unknown;                /* of a pixel; UINT32_MAX: none */
  uint32_t *right, *below;          /* the unknown there, or UINT32_MAX */
  float    *to_right, *to_below;    /* weights */
  double   *diagonal, *b;
} Matrix;

Matrix matrix_of (const System *system);
void   matrix_clear (Matrix *matrix);

/* r = b - A x, summed over differences as far as there are any. */
void matrix_residual (const Matrix *matrix, const double *x, double *r);

/* CHOLMOD's sparse Cholesky factors (supernodal if it thinks so): seconds of analysis, factorization and one solution,
 * and the solution, refined twice outside that time: the truth for all others. */
typedef struct { double analyse, factorize, solve; } Cholmod;
Cholmod cholmod_of (const Matrix *matrix, double *x);

/* Conjugate gradients with an incomplete Cholesky factor without fill.  Stops when the largest error, as a share of
 * the range, is at most `error`, which it is told (not part of the time), or after `limit` seconds: then it returns
 * INFINITY. */
double iccg_seconds (const Matrix *matrix, const double *truth, double range, double error, double limit,
                     int *iterations);

#endif
