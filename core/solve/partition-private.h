/* A partition problem made ready: what the parts of partition.c share.
 *
 * Labels are ranks here, their places in the order, from 0; nodes are those that are not fixed.  A link to a fixed node
 * is a vote for that node's label, and votes for the same label are added up.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PARTITION_PRIVATE_H
#define CELD_PARTITION_PRIVATE_H

#include "solve/flow.h"
#include "solve/partition.h"

typedef struct { uint32_t node, rank; int64_t cost; } CeldVoteSum;

typedef struct
{
  size_t       n, n_ranks;
  CeldNetwork  network;
  int64_t     *cost;       /* of arc a: of different labels on its two nodes */
  CeldVoteSum  *vote_sum;     /* votes by node, then by rank */
  size_t      *of_node;    /* n + 1: those of node p are vote_sum[of_node[p]] .. */
  uint32_t    *by_rank;    /* the vote sums by rank, then by node */
  size_t      *of_rank;    /* n_ranks + 1 */
  uint32_t    *rank;       /* of each node: the answer */
} CeldPartitionGraph;

/* partition.c.  The graph's nodes are those of the problem that are not fixed, in the same order. */
CeldStatus celd_partition_graph_new (const CeldPartition *problem, CeldPartitionGraph *graph);
void       celd_partition_graph_clear (CeldPartitionGraph *graph); /* accepts a zeroed one */

/* partition-greedy.c: a first answer. */
CeldStatus celd_partition_greedy (CeldPartitionGraph *graph, const CeldHost *host);

/* partition-expand.c: a better one. */
CeldStatus celd_partition_expand (CeldPartitionGraph *graph, const CeldHost *host);

#endif
