/* What the files of the coarse levels' cycle share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_COARSE_H
#define CELD_LAPLACE_COARSE_H

#include "solve/laplace-private.h"
#include "solve/laplace-rows.h"
#include "solve/laplace.h"

#define CELD_COARSE_SUMS 3      /* kept of a row */

/* What the rows of a pass need. */
typedef struct
{
  const CeldLevel        *level;
  float                  *b, *x, *image; /* image: NULL where it is not needed */
  const float            *other;         /* NULL, or the x of the first step */
  CeldLevelVectors       *next;
  float                   a[CELD_LANES];
  double                 *sum;
} CeldPass;

/* x += the next level's solution, at the places from .. to-1 */
CELD_INLINE void
celd_correct (const CeldPass *p, size_t from, size_t to, int lanes)
{
  const CeldLevelVectors *next = p->next;
  const uint32_t         *coarser = p->level->coarser;
  CeldEight               a = LANES (next->a), c = LANES (next->c);

  for (size_t i = from; i < to; i++)
    if (lanes == 1)
      p->x[i] += next->a[0] * next->x[coarser[i]] + next->c[0] * next->step[coarser[i]];
    else
      PUT (p->x, i, EIGHT (p->x, i) + a * EIGHT (next->x, coarser[i]) + c * EIGHT (next->step, coarser[i]));
}

/* ------------------------------------------------------------------ laplace-first.c: passes over the first nodes */

void celd_first_down (const CeldCoarse *cycle, CeldPass *p);    /* x from 0, and its residual to the next level's b */
void celd_first_correct (const CeldCoarse *cycle, CeldPass *p); /* x += the next level's solution, of the red ones */
/* Relaxes; image = A x; sums: of x b, x A x, and other A x, with what extra nodes add to them. */
void celd_first_up (const CeldCoarse *cycle, CeldPass *p);
void celd_first_reduce (const CeldCoarse *cycle, CeldPass *p);  /* b -= a A x; sums: of b b before and after */

/* ------------------------------------------------------------------ laplace-extra.c: the same for extra nodes */

void celd_extra_down (const CeldPass *p, int lanes);
void celd_extra_up (const CeldPass *p, int lanes);              /* corrects the black nodes that they see, too */
void celd_extra_apply (const CeldPass *p, float *image, int lanes);
void celd_extra_reduce (const CeldPass *p, int lanes);
/* Adds products of their a and b to the sum. */
void celd_extra_dot (const CeldLevel *level, const float *a, const float *b, double *sum, int lanes);

#endif
