/* What laplace.c, laplace-levels.c and laplace-band.c share: the parts of the Laplacian solver.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_H
#define CELD_LAPLACE_H

#include "private.h"

/* ------------------------------------------------------------------ laplace-band.c: elimination of a narrow graph */

/* Nodes 0 .. n-1, edges only between i and i+1 .. i+band. */
typedef struct
{
  uint32_t n, band;
  double  *weight;              /* of the edge from i to i+k: weight[i * band + k - 1]; after elimination divided by pivot i */
  double  *sink;                /* diagonal beyond the edge weights; after elimination 1 / pivot, 0 for a floating node */
  double  *x;                   /* right-hand side in, solution out */
} CeldBand;

CeldStatus celd_band_new (uint32_t n, uint32_t band, CeldBand *matrix);   /* cleared; fill weight and sink */
void       celd_band_eliminate (CeldBand *matrix);
void       celd_band_solve (CeldBand *matrix);
void       celd_band_clear (CeldBand *matrix);                            /* accepts a zeroed one */

/* ------------------------------------------------------------------ laplace-levels.c: the coarse levels */

#define CELD_NO_NODE UINT32_MAX

/* A graph: nodes 0 .. n-1, node i has the neighbours start[i] .. start[i+1]-1. */
typedef struct
{
  uint32_t  n;
  uint32_t *start, *neighbour;
  uint32_t *middle;             /* where neighbours > i begin; only in levels that are ready for the cycle */
  float    *weight;             /* of each neighbour */
  float    *sink;               /* diagonal beyond the edge weights */
  float    *inverse;            /* 1 / whole diagonal; 0 for a floating node */
  uint32_t *coarser;            /* its node on the next level; CELD_NO_NODE for nodes without an edge */
  uint16_t *cell;               /* x, y of its cell; only during the set-up */
  float    *b, *x;              /* right-hand side and solution on this level */
  float    *step, *image, *image2; /* workspace of the cycle */
} CeldLevel;

#define CELD_MAX_LEVELS 40

typedef struct
{
  int       n;                  /* levels below the pixels; 0 if there is nothing to solve */
  CeldLevel level[CELD_MAX_LEVELS];
  CeldBand  bottom;             /* the last level */
  uint32_t *coarser;            /* of each pixel: its node on level[0] */
} CeldLevels;

CeldStatus celd_levels_new (int width, int height, const float *east, const float *south, const float *diagonal,
                            const CeldRun *run, CeldLevels *levels);
/* level[0].x becomes approximately the solution for level[0].b. */
void       celd_levels_solve (CeldLevels *levels);
void       celd_levels_clear (CeldLevels *levels);                        /* accepts a zeroed one */

#endif
