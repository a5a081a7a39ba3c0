/* Minimum cuts of grids, between two labels and between many.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_MAXFLOW_H
#define CELD_MAXFLOW_H

#include "base/base.h"

/* ------------------------------------------------------------------ maxflow.c: grid max-flow */

/* Minimum cut of a 4-connected grid, exact.  Knows nothing of pictures: nodes are pixels of the grid, capacities
 * symmetric.  east[i]: between node i and its right neighbour (last column ignored); south[i]: below (last row too).
 * terminal[i] > 0: capacity from the source; < 0: capacity to the sink.  side[i] becomes 1 where the node is reachable
 * from the source in the residual graph, 0 elsewhere.  *flow (may be NULL) is the cut's value. */
CeldStatus celd_maxflow (int width, int height, const int32_t *east, const int32_t *south, const int32_t *terminal,
                         const CeldHost *host, uint8_t *side, int64_t *flow);

/* ------------------------------------------------------------------ multiway.c: many labels on a grid */

#define CELD_HARD INT32_MAX /* a vote that is always obeyed */

typedef struct
{
  int             width, height;
  const int32_t  *east, *south; /* V_pq > 0, as in celd_maxflow */
  const uint32_t *seed;         /* painted label of each pixel, 0 = none */
  const int32_t  *vote;         /* of label l: vote[l - 1], what one of its painted pixels costs with another label */
  const uint32_t *order;        /* all labels, in the order in which they are separated from the rest */
  size_t          n_labels;     /* at least 1 */
} CeldMultiway;

/* Gives every pixel with label[p] == 0 a label.  Others keep theirs; of these only hard seeds matter to the rest. */
CeldStatus celd_multiway (const CeldMultiway *problem, const CeldHost *host, uint32_t *label);

#endif
