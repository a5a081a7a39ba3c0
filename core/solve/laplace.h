/* The Laplacian solver.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_H
#define CELD_LAPLACE_H

#include "base/base.h"

/* ------------------------------------------------------------------ laplace.c: the one Laplacian solver */

/* The system  A x = b  on the 4-grid, with  (A x)_p = diagonal_p x_p + sum over neighbours q of w_pq (x_p - x_q).
 * east, south: edge weights (last column / last row ignored), 1e-6 .. 1 of the largest or 0; what is not a positive
 * number is 0, in the diagonal, too.  b, starts and fixed values are finite.  Zero weights make walls and masks, and
 * edges over the frame do not exist (Neumann).  Components without any diagonal or fixed pixel are floating: they
 * keep the mean of their start. */
typedef struct CeldLaplace CeldLaplace;

/* Set-up once per weights; nothing is borrowed beyond it.  fixed (may be NULL): pixels whose x is prescribed
 * (Dirichlet), by the x that each solution starts from; there b and diagonal are not read.  diagonal may be NULL: 0. */
CeldStatus celd_lap_setup (int width, int height, const float *east, const float *south, const float *diagonal,
                           const uint8_t *fixed, const CeldHost *host, CeldLaplace **laplace);
/* Solves for nrhs right-hand sides, planes one behind the other.  x: start in, result out (also when cancelled).
 * tolerance: largest error |x - x*| as a share of the range of x, estimated from the preconditioned residual. */
CeldStatus celd_lap_solve (CeldLaplace *laplace, int nrhs, const float *b, float *x, double tolerance,
                           const CeldHost *host, CeldSolve *solve);
/* Solves for CELD_LANES right-hand sides at once, much faster than one by one: lane k of pixel p is at
 * p * CELD_LANES + k, in b (NULL: 0 everywhere) as in x; lanes that are 0 everywhere are done at once.
 * Stops when every lane is within the tolerance; solve (may be NULL) has the worst lane. */
#define CELD_LANES 8
CeldStatus celd_lap_solve_lanes (CeldLaplace *laplace, const float *b, float *x, double tolerance, const CeldHost *host,
                                 CeldSolve *solve);
void celd_lap_free (CeldLaplace *laplace);                    /* accepts NULL */

#endif
