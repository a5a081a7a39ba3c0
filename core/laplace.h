/* What the laplace*.c share: the parts of the Laplacian solver.
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
  double  *weight;              /* of the edge from i to i+k: weight[i * band + k - 1]; later divided by pivot i */
  double  *sink;                /* diagonal beyond the edge weights; later 1 / pivot, 0 for a floating node */
  double  *x;                   /* right-hand side in, solution out */
} CeldBand;

CeldStatus celd_band_new (uint32_t n, uint32_t band, CeldBand *matrix);   /* cleared; fill weight and sink */
void       celd_band_eliminate (CeldBand *matrix);
void       celd_band_solve (CeldBand *matrix);
void       celd_band_clear (CeldBand *matrix);                            /* accepts a zeroed one */

/* ------------------------------------------------------------------ laplace-levels.c, -cycle.c: coarse levels */

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
void       celd_levels_clear (CeldLevels *levels);                        /* accepts a zeroed one */

/* level[0].x becomes approximately the solution for level[0].b, which is used up. */
void       celd_levels_cycle (CeldLevels *levels);

/* ------------------------------------------------------------------ laplace.c: the system */

struct CeldLaplace
{
  int          width, height;
  float       *east, *south, *diagonal;   /* fixed pixels are cut off, with diagonal 1 */
  uint8_t     *fixed;                     /* or NULL, as the next two: the couplings with fixed pixels */
  float       *held_east, *held_south;
  float       *inverse;                   /* 1 / whole diagonal; 0 for a floating single pixel */
  float       *nothing;                   /* a row of edges of weight 0, above the first and below the last row */
  uint32_t    *floating;                  /* of each pixel: its floating component from 1, or 0; NULL if none */
  size_t      *floating_size;             /* pixels of each floating component */
  uint32_t     n_floating;
  bool         direct;                    /* by elimination of `band`, without levels */
  CeldBand     band;
  CeldLevels   levels;
};

/* The vectors of one solution. */
typedef struct
{
  double *x, *r, *p, *q;        /* solution, residual, direction, A p */
  float  *z, *b;                /* preconditioned residual, right-hand side */
  double *row[3];               /* sums and extremes of each row */
} CeldSolution;

/* ------------------------------------------------------------------ laplace-floating.c: parts that nothing holds */

/* Finds the floating components of more than one pixel. */
CeldStatus celd_floating_find (CeldLaplace *laplace);
/* Means of v over each; mean has n_floating + 1 items. */
void       celd_floating_means (const CeldLaplace *laplace, const double *v, double *mean);
/* Shifts v in each to the wanted mean (NULL: zero); mean: workspace of n_floating + 1. */
void       celd_floating_shift (const CeldLaplace *laplace, const double *wanted, double *mean, double *v);

/* ------------------------------------------------------------------ laplace-pixels.c: passes over the pixels */

void   celd_pixels_invert (CeldLaplace *laplace);                         /* fills inverse */
void   celd_pixels_residual (const CeldLaplace *laplace, const CeldRun *run, CeldSolution *s);  /* r = -A x */
void   celd_pixels_cycle (CeldLaplace *laplace, const CeldRun *run, CeldSolution *s);           /* z = about A^-1 r */
/* *zr = z r, *zq = z q, *largest = max |z|. */
void   celd_pixels_measure (const CeldLaplace *laplace, const CeldRun *run, CeldSolution *s,
                            double *zr, double *zq, double *largest);
/* p = z + beta p, q = A p; returns p q. */
double celd_pixels_turn (const CeldLaplace *laplace, const CeldRun *run, CeldSolution *s, double beta);
/* x += alpha p, r -= alpha q; *low and *high are the extremes of x. */
void   celd_pixels_advance (const CeldLaplace *laplace, const CeldRun *run, CeldSolution *s, double alpha,
                            double *low, double *high);

#endif
