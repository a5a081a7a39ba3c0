/* What the laplace*.c share: the parts of the Laplacian solver.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_PRIVATE_H
#define CELD_LAPLACE_PRIVATE_H

#include "solve/laplace.h"

/* ------------------------------------------------------------------ laplace-band.c: elimination of a narrow graph */

/* Nodes 0 .. n-1, edges only between i and i+1 .. i+band. */
typedef struct
{
  uint32_t n, band;
  double  *weight;              /* of the edge from i to i+k: weight[i * band + k - 1]; later divided by pivot i */
  double  *sink;                /* diagonal beyond the edge weights; later 1 / pivot, 0 for a floating node */
} CeldBandMatrix;

CeldStatus celd_band_new (uint32_t n, uint32_t band, CeldBandMatrix *matrix);   /* cleared; fill weight and sink */
void       celd_band_eliminate (CeldBandMatrix *matrix);
/* Right-hand sides in, solutions out; `lanes` numbers a node. */
void       celd_band_solve (const CeldBandMatrix *matrix, int lanes, double *x);
void       celd_band_clear (CeldBandMatrix *matrix);                            /* accepts a zeroed one */

#define CELD_STRIP 32 /* rows that a thread takes; a multiple of what cells have, unless a level says otherwise */

/* The bits of a number; positive ones are in the order of their bits, and loops over these are vectors'. */
typedef uint32_t CeldBits __attribute__ ((may_alias));

/* ------------------------------------------------------------------ laplace-graph.c: aggregation */

#define CELD_NO_NODE UINT32_MAX

/* A grid of cells, and nodes beside it.  Node y * width + x is the first one of its cell; what a wall parts from it in
 * the same cell is an extra node, from width * height.  Edges between first nodes of neighbouring cells are `east` and
 * `south`; those that an extra node has are listed, k's from start[k] to start[k+1]-1. */
typedef struct
{
  int       width, height;
  int       doublings;          /* of cells since the graph before */
  uint32_t  n_extra;
  float    *east, *south;
  float    *sink;               /* of every node: diagonal beyond the edge weights */
  uint32_t *cell;               /* of each extra node, row by row */
  uint32_t *row_extra;          /* where the extra nodes of each row begin; NULL for pixels */
  bool      weak;               /* of pixels: do weights differ very much? */
  uint8_t  *part;               /* of each node: has what it belongs to more of them?  NULL: weights are alike */
  uint32_t *start, *neighbour;
  float    *weight;
} CeldWeights;

/* The next coarser graph; coarser[i]: what node i has become, CELD_NO_NODE for nodes without an edge and for those that
 * their sink holds, whose edges `fine` loses. */
CeldStatus celd_weights_coarsen (CeldWeights *fine, const CeldHost *host, CeldWeights *coarse, uint32_t **coarser);
void       celd_weights_clear (CeldWeights *graph);                           /* accepts a zeroed one */

/* ------------------------------------------------------------------ laplace-levels.c: what is solved on */

/* A graph laid out for red-black relaxation: first nodes of cells with x + y even are red.  Red ones come first, row by
 * row in `stride` places, the first of which and at least the last are empty, and so are the rows above and below; then
 * black ones alike; then extra ones.  Place j of a row is column 2 j or 2 j + 1.  What is empty has weight 0. */
typedef struct
{
  int       width, height, half; /* half: nodes of one colour in a row */
  size_t    stride, plane;      /* plane: places of a colour */
  uint32_t  n, n_extra;         /* n: all places */
  float    *near, *far, *north, *south; /* edges of the red nodes: to the black one of the same place, beside it, ... */
  float    *sink;
  float    *inverse;            /* 1 / whole diagonal; 0 for empty places and floating nodes without an edge */
  uint32_t *coarser;            /* its place on the next level, 0 for none; NULL on the last; of pixels only red ones */
  uint32_t *start, *middle, *neighbour; /* edges of extra nodes; from `middle` on those to extra nodes after them */
  float    *weight;
  uint32_t  red_links, links;   /* edges between first and extra nodes, by the first node, red ones first */
  uint32_t *link_row;           /* where the links of each row begin, red rows first */
  uint32_t *link_first, *link_extra;
  float    *link_weight;
} CeldLevel;

#define CELD_MAX_LEVELS 40

typedef struct
{
  int       n;                  /* levels, the pixels among them; the last one is eliminated */
  CeldLevel level[CELD_MAX_LEVELS];
  CeldBandMatrix  bottom;             /* the last level */
  uint32_t *bottom_node;        /* of each node of `bottom`: its place on the last level */
} CeldLevels;

/* The place of a cell. */
static inline uint32_t
celd_level_place (const CeldLevel *level, int x, int y)
{
  return (uint32_t) (((x + y) & 1 ? level->plane : 0) + (size_t) (y + 1) * level->stride + (size_t) (x / 2) + 1);
}

/* graph: the pixels, without extra nodes; it is used up, and still has to be cleared. */
CeldStatus celd_levels_new (CeldWeights *graph, const CeldHost *host, CeldLevels *levels);
void       celd_levels_clear (CeldLevels *levels);                        /* accepts a zeroed one */

/* ------------------------------------------------------------------ laplace-cycle.c: the coarse levels */

/* The vectors of a level, `lanes` numbers a place. */
typedef struct
{
  float  *b, *x, *step, *image; /* right-hand side; the two parts of the solution; A x */
  float   a[CELD_LANES], c[CELD_LANES]; /* the solution is a x + c step */
  double *sum;                  /* of each row */
} CeldLevelVectors;

typedef struct
{
  const CeldLevels *levels;
  const CeldHost   *host;
  int               lanes;      /* 1 or CELD_LANES */
  CeldLevelVectors  vectors[CELD_MAX_LEVELS];
  double           *bottom;     /* right-hand side and solution */
} CeldCoarse;

CeldStatus celd_coarse_new (const CeldLevels *levels, int lanes, const CeldHost *host, CeldCoarse *cycle);
void       celd_coarse_free (CeldCoarse *cycle);                            /* accepts a zeroed one */
/* a x + c step of vectors[1] becomes approximately the solution for its b, which is used up. */
void       celd_coarse_solve (CeldCoarse *cycle);

/* ------------------------------------------------------------------ laplace.c: the system */

/* The coupling of a free pixel with a fixed one. */
typedef struct { uint32_t free, fixed; float weight; } CeldHeld;

/* Pixels first .. end-1 of a row, of a floating component from 1. */
typedef struct { uint32_t first, end, component; } CeldFloating;

struct CeldLaplace
{
  int           width, height;
  CeldHeld     *held;           /* in the order of the rows of the free pixels */
  size_t       *held_row;       /* where the rows begin in `held` */
  CeldFloating *floating;       /* in the order of the rows; NULL if none */
  size_t       *floating_row;   /* where they begin */
  size_t       *floating_size;  /* pixels of each floating component */
  uint32_t      n_floating;
  bool          weak;           /* do weights differ very much? */
  bool          direct;         /* by elimination of `band`, without levels */
  CeldBandMatrix      band;
  uint8_t      *keep;           /* of each pixel, if direct: does nothing tell its x? */
  CeldLevels    levels;
};

/* ------------------------------------------------------------------ laplace-system.c: what a caller asks for */

/* The graph of the free pixels; `held`, `held_row` and `weak` of the system. */
CeldStatus celd_system_copy (const float *east, const float *south, const float *diagonal, const uint8_t *fixed,
                             const CeldHost *host, CeldLaplace *laplace, CeldWeights *graph);

/* ------------------------------------------------------------------ laplace-direct.c: small systems */

bool       celd_is_direct (const CeldWeights *pixels, bool weak);      /* is elimination worth while? */
CeldStatus celd_direct_new (const CeldWeights *pixels, CeldLaplace *laplace);
/* b may be NULL; b_mean: what to leave out of it in floating components, NULL if there are none. */
CeldStatus celd_direct_solve (const CeldLaplace *laplace, int lanes, const float *b, const double *b_mean, float *x);

/* ------------------------------------------------------------------ laplace-floating.c: parts that nothing holds */

static inline size_t
celd_floating_runs (const CeldLaplace *laplace)
{
  return laplace->n_floating ? laplace->floating_row[laplace->height] : 0;
}

/* Finds the floating components of more than one pixel. */
CeldStatus celd_floating_find (const CeldWeights *pixels, CeldLaplace *laplace);
/* Means of v over each, of every lane; mean has n_floating + 1 items a lane. */
void       celd_floating_means (const CeldLaplace *laplace, int lanes, const float *v, double *mean);
/* v += plus - minus of each pixel's component. */
void       celd_floating_shift (const CeldLaplace *laplace, int lanes, const double *plus, const double *minus,
                                float *v);

/* ------------------------------------------------------------------ laplace-pixels.c: passes over the pixels */

/* A solution on its way: vectors of the red pixels alone, as black ones follow from them. */
typedef struct
{
  const CeldLaplace *laplace;
  const CeldHost    *host;
  int                lanes;
  const float       *b;         /* the caller's, or NULL; and the caller's x */
  const double      *b_mean;    /* of each floating component, NULL if there is none: to be left out */
  float             *user;
  float             *x, *r, *p, *q; /* solution, residual, direction, A p */
  float             *z, *t;     /* preconditioned residual, A z */
  float             *black;     /* workspace of the black pixels */
  double            *row;       /* sums of each row */
  double            *scratch;   /* rows of each strip */
  float             *side;      /* a row's right-hand side, of each strip */
  CeldCoarse          cycle;
} CeldSolution;

/* What is measured of each lane: products of z, its largest size, extremes of x. */
typedef struct
{
  double zr[CELD_LANES], zq[CELD_LANES], zt[CELD_LANES], largest[CELD_LANES], low[CELD_LANES], high[CELD_LANES];
} CeldMeasure;

CeldStatus celd_solution_new (const CeldLaplace *laplace, int lanes, const float *b, float *x, const CeldHost *host,
                              CeldSolution *s);
void       celd_solution_free (CeldSolution *s);                          /* accepts a zeroed one */
/* laplace-residual.c: */
void       celd_pixels_begin (CeldSolution *s);                           /* x from the caller's, r = b - A x */
void       celd_pixels_refresh (CeldSolution *s);                         /* r = b - A x anew */
void       celd_pixels_deliver (CeldSolution *s);                         /* the caller's x */
/* A step, p = z + beta p, q = t + beta q, x += alpha p, r -= alpha q, unless alpha is NULL; if `fresh`, r = b - A x
 * anew; then z = about A^-1 r and t = A z. */
void       celd_pixels_round (CeldSolution *s, const double *alpha, const double *beta, bool fresh, CeldMeasure *m);

#endif
