/* What the files of the Laplacian solver share.  In the order of a solution:
 *
 *   laplace-system.c       boundary conditions: the free pixels as a weighted graph
 *   laplace-null-space.c   floating components of it
 *   laplace-direct.c       elimination: of small systems, and of the coarsest level
 *   laplace-hierarchy.c    set-up of the levels: laplace-quality.c leaves out dominant nodes, laplace-aggregation.c
 *                          aggregates the others in cells, or laplace-quality.c in pairs, and laplace-galerkin.c
 *                          sums up the coarse matrix
 *   laplace.c              conjugate gradients and when they stop
 *   laplace-pixels.c       the finest level, on the red pixels alone; laplace-residual.c its residual in double
 *   laplace-cycle.c        the K-cycle over the coarse levels; laplace-smoother.c what it does on each
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_PRIVATE_H
#define CELD_LAPLACE_PRIVATE_H

#include "solve/laplace.h"

#define CELD_STRIP 32 /* rows that one thread takes at a time; even, so that cells of 2 x 2 lie in one strip */

/* The bits of a float.  Positive floats are in the order of their bits, and loops over integers are vectorised. */
typedef uint32_t CeldBits __attribute__ ((may_alias));

/* ------------------------------------------------------------------ a weighted graph: one level during set-up */

#define CELD_NO_NODE UINT32_MAX

/* The matrix of a level as a graph: (A x)_i = diagonal_i x_i + sum over edges ij of w_ij (x_i - x_j).
 *
 * Node y * width + x is the grid node of its cell; on the finest level it is a pixel.  Where a cell has more than one
 * aggregate, since a wall runs through it, the others are extra nodes, numbered from width * height on, row by row.
 * Edges between the grid nodes of neighbouring cells are `east` and `south`.  Edges that have an extra node are listed:
 * those of extra node k from start[k] to start[k + 1] - 1; an edge between two extra nodes is in both lists. */
typedef struct
{
  int       width, height;
  int       doublings;          /* a cell has 2^doublings x 2^doublings cells of the next finer graph */
  uint32_t  n_extra;
  float    *east, *south;
  float    *diagonal;           /* of each node: what its row has on the diagonal beyond its edge weights, >= 0 */
  uint32_t *cell;               /* of each extra node */
  uint32_t *row_extra;          /* the first extra node of each row, height + 1; NULL on the finest level */
  bool      weak;               /* on the finest level: do weights differ by more than a factor of 1000? */
  uint8_t  *divided;            /* of each node: is it one of several that a strong component is divided into?  NULL if
                                 * weights do not differ by much */
  uint32_t *start, *neighbour;
  float    *weight;
} CeldWeightedGraph;

void celd_weighted_graph_clear (CeldWeightedGraph *graph);    /* accepts a zeroed one */

/* ------------------------------------------------------------------ coarsening a graph */

static inline uint32_t
celd_grid_nodes (const CeldWeightedGraph *g)
{
  return (uint32_t) g->width * (uint32_t) g->height;
}

/* The coarse cell that a cell lies in. */
static inline uint32_t
celd_coarse_cell (const CeldWeightedGraph *fine, uint32_t cell, const CeldWeightedGraph *coarse)
{
  uint32_t w = (uint32_t) fine->width;

  return (cell / w >> coarse->doublings) * (uint32_t) coarse->width + (cell % w >> coarse->doublings);
}

/* The nodes in a row of coarse cells: rows from .. to - 1 of cells, extra nodes extra .. extra_end - 1. */
typedef struct { uint32_t from, to, extra, extra_end; } CeldNodeRange;

static inline CeldNodeRange
celd_nodes_of_row (const CeldWeightedGraph *fine, const CeldWeightedGraph *coarse, int row)
{
  uint32_t from = (uint32_t) row << coarse->doublings, to = (uint32_t) (row + 1) << coarse->doublings;

  to = to < (uint32_t) fine->height ? to : (uint32_t) fine->height;
  return (CeldNodeRange) {
    from, to, fine->n_extra ? fine->row_extra[from] : 0, fine->n_extra ? fine->row_extra[to] : 0
  };
}

/* Aggregation under way. */
typedef struct
{
  const CeldWeightedGraph *graph;
  CeldWeightedGraph       *coarse;
  const CeldHost          *host;
  float                   *best;        /* of each node: the weight of its strongest edge, 0 without any */
  uint32_t                *link;        /* the node at the other end of that; in the end the aggregate */
  uint32_t                *parent;      /* the aggregates as sets, see base/base.h */
  uint8_t                 *divided;     /* does the node's strong component go on beyond its coarse cell? */
  uint32_t                *row_count;   /* of each fine row: nodes with an edge; of each coarse row: aggregates */
  uint8_t                 *taken;       /* of each coarse cell: does an aggregate have its number? */
} CeldAggregation;

/* laplace-quality.c: cuts the edges of nodes whose diagonal dominates these; the diagonals of the nodes at the other
 * ends get their weights. */
CeldStatus celd_leave_out_dominant (CeldWeightedGraph *graph, const CeldHost *host);

/* laplace-quality.c: aggregates of all nodes, wherever they lie, at most `most` of them if that can be; parent as in
 * base/base.h. */
CeldStatus celd_pairwise_aggregate (const CeldWeightedGraph *graph, uint32_t most, uint32_t *parent);

/* laplace-galerkin.c: numbers the aggregates, a->link[i] becoming that of node i, and fills in the number of extra
 * nodes and `divided` of the coarse graph, whose grid is known. */
CeldStatus celd_number_aggregates (CeldAggregation *a);

/* Edges and diagonals of the coarse graph, whose nodes are known. */
CeldStatus celd_galerkin (const CeldWeightedGraph *fine, const uint32_t *coarser, const CeldHost *host,
                          CeldWeightedGraph *coarse);

/* laplace-aggregation.c: the next coarser graph.  coarser[i] is the aggregate of node i, CELD_NO_NODE for nodes without
 * an edge and for dominant ones, whose edges `fine` loses.  The caller ends both with their clear and celd_free. */
CeldStatus celd_coarsen (CeldWeightedGraph *fine, const CeldHost *host, CeldWeightedGraph *coarse, uint32_t **coarser);

/* ------------------------------------------------------------------ a level, laid out for red-black Gauss-Seidel */

/* Places first .. end - 1 of a row. */
typedef struct { size_t first, end; } CeldPlaceSpan;

/* Grid nodes with x + y even are red, the others black.  Vectors of a level have a place for each node: first the red
 * ones, row by row, `stride` places a row, of which the first and at least the last are empty, as are the rows above
 * and below the grid; then the black ones in the same layout; then the extra ones.  Place j of a row is column 2 j or 2
 * j + 1.  Empty places have weight 0, so that no loop asks for the frame.
 *
 * Loops leave out what is empty at both ends of a row: there vectors keep the 0 that they are made with.  A span begins
 * a multiple of 8 places after the first one of its row, so that sums of eight do not depend on it. */
typedef struct
{
  int       width, height, half; /* half: nodes of one colour in a row */
  size_t    stride, plane;      /* plane: places of one colour */
  uint32_t  n, n_extra;         /* n: all places */
  CeldPlaceSpan *row;           /* of the red places of each row, and of the black ones */
  float    *near, *far, *north, *south; /* edges of the red nodes: to the black node of the same place and of the one
                                         * beside it in the row, and to those above and below */
  float    *diagonal;           /* as in the graph */
  float    *inverse;            /* 1 / (diagonal + sum of edge weights); 0 for empty places and floating single nodes */
  uint32_t *coarser;            /* the place of the aggregate on the next level, 0 for none; NULL on the coarsest level;
                                 * on the finest of red nodes only */
  uint32_t *start, *middle, *neighbour; /* edges of extra nodes; from `middle` on those to extra nodes after them */
  float    *weight;
  uint32_t  red_links, links;   /* edges between grid and extra nodes, sorted by grid node, the red ones first */
  uint32_t *link_row;           /* the first link of each row, red rows before black ones */
  uint32_t *link_first, *link_extra;
  float    *link_weight;
} CeldGridLevel;

/* The place of a grid node. */
static inline uint32_t
celd_grid_place (const CeldGridLevel *level, int x, int y)
{
  return (uint32_t) (((x + y) & 1 ? level->plane : 0) + (size_t) (y + 1) * level->stride + (size_t) (x / 2) + 1);
}

/* The place of any node of the graph; 0, which is empty, for CELD_NO_NODE. */
static inline uint32_t
celd_node_place (const CeldGridLevel *level, uint32_t node)
{
  uint32_t w = (uint32_t) level->width, n = w * (uint32_t) level->height;

  if (node == CELD_NO_NODE)
    return 0;
  return node < n ? celd_grid_place (level, (int) (node % w), (int) (node / w))
                  : (uint32_t) (2 * level->plane) + node - n;
}

/* ------------------------------------------------------------------ laplace-direct.c: elimination in a band */

/* A graph Laplacian of nodes 0 .. n - 1 with edges only between i and i + 1 .. i + band. */
typedef struct
{
  uint32_t n, band;
  double  *weight;              /* of the edge from i to i + k: weight[i * band + k - 1]; later divided by pivot i */
  double  *diagonal;            /* beyond the edge weights; later 1 / pivot, 0 for the last node of what floats */
} CeldBandMatrix;

CeldStatus celd_band_new (uint32_t n, uint32_t band, CeldBandMatrix *matrix);   /* zero; fill weight and diagonal */
void       celd_band_eliminate (CeldBandMatrix *matrix);
/* Right-hand sides in, solutions out; node i has x[i * lanes] .. x[i * lanes + lanes - 1]. */
void       celd_band_solve (const CeldBandMatrix *matrix, int lanes, double *x);
void       celd_band_clear (CeldBandMatrix *matrix);                            /* accepts a zeroed one */

/* The coarsest level, eliminated: *node has the place of each node of the matrix. */
CeldStatus celd_eliminate_coarsest (const CeldWeightedGraph *graph, const CeldGridLevel *level, CeldBandMatrix *matrix,
                                    uint32_t **node);

/* ------------------------------------------------------------------ laplace-hierarchy.c: all levels */

#define CELD_MAX_LEVELS 40

typedef struct
{
  int            n;             /* levels, at least 2: level 0 is the finest, the pixels; the coarsest is eliminated */
  CeldGridLevel  level[CELD_MAX_LEVELS];
  CeldBandMatrix coarsest;
  uint32_t      *coarsest_node; /* the place of each node of `coarsest` on the coarsest level */
} CeldHierarchy;

/* graph: the finest level; it is used up, and still has to be cleared. */
CeldStatus celd_hierarchy_new (CeldWeightedGraph *graph, const CeldHost *host, CeldHierarchy *hierarchy);
void       celd_hierarchy_clear (CeldHierarchy *hierarchy);               /* accepts a zeroed one */

/* ------------------------------------------------------------------ laplace-smoother.c: one coarse level */

/* The vectors of a coarse level, `lanes` numbers a place. */
typedef struct
{
  float  *b, *x, *step, *image;         /* right-hand side; the x of either step of the Krylov iteration; A x */
  float   a[CELD_LANES], c[CELD_LANES]; /* the solution is a x + c step */
  double *sum;                          /* workspace: CELD_SMOOTHER_SUMS sums of each row, of every lane */
} CeldLevelVectors;

#define CELD_SMOOTHER_SUMS 3

/* One V-cycle's visit to a level. */
typedef struct
{
  const CeldGridLevel *level;
  const CeldHost      *host;          /* NULL where the level is too small to be worth threads */
  int                  lanes;         /* 1 or CELD_LANES */
  float               *b, *x, *image; /* image: A x of the grid nodes; NULL if it is not needed */
  const float         *other;         /* NULL, or the x of the first step */
  CeldLevelVectors    *next;          /* of the next coarser level */
  float                a[CELD_LANES];
  double              *sum;           /* of each row, as in CeldLevelVectors */
} CeldSmootherPass;

/* Relaxes x from 0 and restricts the residual to the next level's b, which is zero before. */
void celd_smooth_down (CeldSmootherPass *pass);
/* Adds the prolongation of the next level's solution to x and relaxes.  image: A x of the extra nodes; pass->image: A x
 * of the grid nodes.  xb = x b, xi = x A x, oi = other A x (0 without one), of every lane. */
void celd_smooth_up (CeldSmootherPass *pass, float *image, double *xb, double *xi, double *oi);
/* b -= a A x; before, after: b b, of every lane. */
void celd_smooth_reduce (CeldSmootherPass *pass, double *before, double *after);

/* ------------------------------------------------------------------ laplace-cycle.c: the coarse levels */

typedef struct
{
  const CeldHierarchy *hierarchy;
  const CeldHost      *host;
  int                  lanes;    /* 1 or CELD_LANES */
  CeldLevelVectors     vectors[CELD_MAX_LEVELS];
  double              *coarsest; /* right-hand side and solution of the coarsest level */
} CeldKCycle;

CeldStatus celd_kcycle_new (const CeldHierarchy *hierarchy, int lanes, const CeldHost *host, CeldKCycle *cycle);
void       celd_kcycle_free (CeldKCycle *cycle);                            /* accepts a zeroed one */
/* a x + c step of vectors[1] becomes approximately the solution for its b, which is used up. */
void       celd_kcycle_solve (CeldKCycle *cycle);

/* ------------------------------------------------------------------ laplace.c: the system */

/* The edge between a free pixel and a fixed one. */
typedef struct { uint32_t free, fixed; float weight; } CeldDirichletLink;

/* Pixels first .. end - 1 of a row, which belong to a floating component, numbered from 1. */
typedef struct { uint32_t first, end, component; } CeldFloatingRun;

struct CeldLaplace
{
  int                width, height;
  CeldDirichletLink *held;      /* by the rows of the free pixels */
  size_t            *held_row;  /* the first link of each row, height + 1 */
  CeldFloatingRun   *floating;  /* by rows; NULL if nothing floats */
  size_t            *floating_row;  /* the first one of each row, height + 1 */
  size_t            *floating_size; /* pixels of each floating component */
  uint32_t           n_floating;
  bool               weak;      /* do weights differ by more than a factor of 1000? */
  bool               direct;    /* small enough to be solved by elimination: `band` and `keep`, no hierarchy */
  CeldBandMatrix     band;
  uint8_t           *keep;      /* of each pixel: has it neither an edge nor a diagonal, so that x stays as it is? */
  CeldHierarchy      hierarchy;
};

/* laplace-system.c: the graph of the free pixels; `held`, `held_row` and `weak` of the system. */
CeldStatus celd_system_read (const float *east, const float *south, const float *diagonal, const uint8_t *fixed,
                             const CeldHost *host, CeldLaplace *laplace, CeldWeightedGraph *graph);

/* laplace-direct.c: small systems.  b may be NULL; b_mean: the means to subtract from b in floating components, NULL if
 * there are none. */
bool       celd_is_direct (const CeldWeightedGraph *pixels, bool weak); /* is elimination worth while? */
CeldStatus celd_direct_new (const CeldWeightedGraph *pixels, CeldLaplace *laplace);
CeldStatus celd_direct_solve (const CeldLaplace *laplace, int lanes, const float *b, const double *b_mean, float *x);

/* ------------------------------------------------------------------ laplace-null-space.c */

static inline size_t
celd_null_space_runs (const CeldLaplace *laplace)
{
  return laplace->n_floating ? laplace->floating_row[laplace->height] : 0;
}

/* Finds the floating components of more than one pixel. */
CeldStatus celd_null_space_find (const CeldWeightedGraph *pixels, CeldLaplace *laplace);

/* ------------------------------------------------------------------ laplace-pixels.c: the finest level */

/* One solution under way.  Its vectors have the red pixels alone, since black ones follow from them. */
typedef struct
{
  const CeldLaplace *laplace;
  const CeldHost    *host;
  int                lanes;
  const float       *b;         /* the caller's, or NULL */
  const double      *b_mean;    /* mean of b over each floating component, to be subtracted; NULL if there is none */
  float             *user;      /* the caller's x */
  float             *x, *r, *p, *q; /* solution, residual, direction, A p */
  float             *z, *t;     /* preconditioned residual, A z */
  float             *black;     /* workspace of the black pixels */
  double            *row;       /* sums of each row */
  double            *scratch;   /* three rows for each strip */
  float             *side;      /* one row's right-hand side for each strip */
  CeldKCycle         cycle;
} CeldSolution;

/* What a round measures, of each lane: products of z, its largest magnitude, extremes of x. */
typedef struct
{
  double zr[CELD_LANES], zq[CELD_LANES], zt[CELD_LANES], largest[CELD_LANES], low[CELD_LANES], high[CELD_LANES];
} CeldRoundMeasures;

CeldStatus celd_solution_new (const CeldLaplace *laplace, int lanes, const float *b, float *x, const CeldHost *host,
                              CeldSolution *s);
void       celd_solution_free (CeldSolution *s);                          /* accepts a zeroed one */
/* One round of the conjugate gradient: unless alpha is NULL a step p = z + beta p, q = t + beta q, x += alpha p,
 * r -= alpha q; if `fresh` r = b - A x anew; then z = about A^-1 r by one multigrid cycle, and t = A z. */
void       celd_pixels_round (CeldSolution *s, const double *alpha, const double *beta, bool fresh,
                              CeldRoundMeasures *m);

/* laplace-residual.c */
void       celd_pixels_begin (CeldSolution *s);                           /* x from the caller's, r = b - A x */
void       celd_pixels_refresh (CeldSolution *s);                         /* r = b - A x anew */
void       celd_pixels_deliver (CeldSolution *s);                         /* the caller's x */

#endif
