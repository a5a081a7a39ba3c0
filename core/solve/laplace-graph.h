/* What the files of the Laplacian solver's graphs share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAPLACE_GRAPH_H
#define CELD_LAPLACE_GRAPH_H

#include "solve/laplace-private.h"

static inline uint32_t
celd_weights_cells (const CeldWeights *g)
{
  return (uint32_t) g->width * (uint32_t) g->height;
}

/* The coarse cell in which a cell lies. */
static inline uint32_t
celd_weights_above (const CeldWeights *fine, uint32_t cell, const CeldWeights *coarse)
{
  uint32_t w = (uint32_t) fine->width;

  return (cell / w >> coarse->doublings) * (uint32_t) coarse->width + (cell % w >> coarse->doublings);
}

/* What lies in a row of coarse cells: rows from .. to-1 of cells, extra nodes extra .. extra_end-1. */
typedef struct { uint32_t from, to, extra, extra_end; } CeldNodes;

static inline CeldNodes
celd_weights_nodes (const CeldWeights *fine, const CeldWeights *coarse, int row)
{
  uint32_t from = (uint32_t) row << coarse->doublings, to = (uint32_t) (row + 1) << coarse->doublings;

  to = to < (uint32_t) fine->height ? to : (uint32_t) fine->height;
  return (CeldNodes) { from, to, fine->n_extra ? fine->row_extra[from] : 0, fine->n_extra ? fine->row_extra[to] : 0 };
}

/* What aggregation knows of the nodes. */
typedef struct
{
  const CeldWeights *graph;
  CeldWeights       *coarse;
  const CeldHost     *host;
  float              most;        /* weight of the strongest link of all */
  float             *best;        /* weight of the strongest link */
  uint32_t          *link;        /* the node at its other end; in the end the aggregate */
  uint32_t          *parent;
  uint8_t           *open;        /* does what it is part of go on beyond its coarse cell? */
  uint32_t          *row_most;    /* of each fine row: bits of the strongest link */
  uint32_t          *row_count;   /* of each fine row: nodes with a link; of each coarse row: aggregates */
  uint8_t           *taken;       /* of each coarse cell: has an aggregate its number? */
} CeldAggregation;

/* ------------------------------------------------------------------ laplace-links.c */

/* The strongest link of every node: best and link; returns how many have one. */
uint32_t celd_weights_see (CeldAggregation *a);

/* ------------------------------------------------------------------ laplace-ground.c */

/* Cuts the edges of nodes that their sinks hold far more; what is at the other ends is held by these edges. */
CeldStatus celd_weights_ground (CeldWeights *graph, const CeldHost *host);

/* ------------------------------------------------------------------ laplace-pairs.c */

/* Aggregates of all nodes, wherever they lie, at most so many if that can be: parent as in unions.h. */
CeldStatus celd_weights_pair (const CeldWeights *graph, uint32_t most, uint32_t *parent);

/* ------------------------------------------------------------------ laplace-number.c */

/* Turns a->link into the number of each node's aggregate. */
CeldStatus celd_weights_number (CeldAggregation *a);

/* ------------------------------------------------------------------ laplace-contract.c */

/* Edges and sinks of the coarse graph, whose sizes are known. */
CeldStatus celd_weights_contract (const CeldWeights *fine, const uint32_t *coarser, const CeldHost *host,
                                  CeldWeights *coarse);

#endif
