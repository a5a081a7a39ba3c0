/* What the files that coarsen a graph of the Laplacian solver share: aggregation and the coarse matrix.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_AGGREGATION_H
#define CELD_LAPLACE_AGGREGATION_H

#include "solve/laplace-private.h"

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
  float                    most;        /* weight of the strongest edge of all */
  float                   *best;        /* of each node: the weight of its strongest edge, 0 without any */
  uint32_t                *link;        /* the node at the other end of that; in the end the aggregate */
  uint32_t                *parent;      /* the aggregates as sets, see base/unions.h */
  uint8_t                 *divided;     /* does the node's strong component go on beyond its coarse cell? */
  uint32_t                *row_most;    /* of each fine row: bits of the strongest edge's weight */
  uint32_t                *row_count;   /* of each fine row: nodes with an edge; of each coarse row: aggregates */
  uint8_t                 *taken;       /* of each coarse cell: does an aggregate have its number? */
} CeldAggregation;

/* laplace-dominance.c: cuts the edges of nodes whose diagonal dominates these; the diagonals of the nodes at the other
 * ends get their weights. */
CeldStatus celd_leave_out_dominant (CeldWeightedGraph *graph, const CeldHost *host);

/* laplace-pairwise.c: aggregates of all nodes, wherever they lie, at most `most` of them if that can be; parent as in
 * base/unions.h. */
CeldStatus celd_pairwise_aggregate (const CeldWeightedGraph *graph, uint32_t most, uint32_t *parent);

/* laplace-galerkin.c: numbers the aggregates, a->link[i] becoming that of node i, and fills in the number of extra
 * nodes and `divided` of the coarse graph, whose grid is known. */
CeldStatus celd_number_aggregates (CeldAggregation *a);

/* Edges and diagonals of the coarse graph, whose nodes are known. */
CeldStatus celd_galerkin (const CeldWeightedGraph *fine, const uint32_t *coarser, const CeldHost *host,
                          CeldWeightedGraph *coarse);

#endif
