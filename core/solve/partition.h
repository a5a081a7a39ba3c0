/* Minimum cuts of graphs, and labels on them: the Potts energy of LazyBrush [SDC09b] on the nodes of a basin graph.
 *
 *   flow.c                minimum cuts
 *   links.c               links that are listed several times, summed up
 *   partition.c           many labels: the problem made ready
 *   partition-greedy.c    separates the labels in turn
 *   partition-expand.c    alpha-expansion
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PARTITION_H
#define CELD_PARTITION_H

#include "base/base.h"

/* The sum of all costs of a problem, terminals included, is at most 2^60: nothing overflows then. */

typedef struct { uint32_t a, b; int64_t cost; } CeldLink;           /* of different labels on the nodes a and b; > 0 */

/* ------------------------------------------------------------------ partition.c: many labels */

#define CELD_MANY_LABELS 24 /* labels from which on a component is first cut between two halves of them; chosen */

typedef struct { uint32_t node, label; int64_t cost; } CeldVote;    /* of another label than this on the node; > 0 */

typedef struct
{
  size_t          n;            /* nodes 0 .. n - 1 */
  const CeldLink *link;         /* each pair of nodes at most once */
  size_t          n_links;
  const CeldVote *vote;         /* any order; several for one node and label add up */
  size_t          n_votes;
  const uint32_t *fixed;        /* of node k: the label it must have, or 0; NULL: none must */
  const uint32_t *order;        /* all labels, 1 .. n_labels, in the order in which they are separated */
  size_t          n_labels;     /* at least 1 */
} CeldPartition;

/* label[k] becomes the label of node k: the labels are separated in turn by exact binary cuts as in celd_multiway,
 * then alpha-expansion lowers the energy until no expansion does.  *energy and *greedy (may be NULL) are the energies
 * after and before expansion: energy <= greedy.  A connected part of the graph that no label reaches gets the first
 * label of the order.  The order of nodes, links and votes does not matter. */
CeldStatus celd_partition (const CeldPartition *problem, const CeldHost *host, uint32_t *label, int64_t *energy,
                           int64_t *greedy);

/* The energy of any labelling. */
int64_t celd_partition_energy (const CeldPartition *problem, const uint32_t *label);

/* ------------------------------------------------------------------ links.c: links summed up */

/* Sums up what is listed of each two of n nodes, in any order, to a link; of a node and itself nothing counts.  `link`
 * has room for all that is listed. */
CeldStatus celd_links_sum (size_t n, const CeldLink *listed, size_t n_listed, CeldLink *link, size_t *n_links);

/* ------------------------------------------------------------------ flow.c: minimum cuts */

/* Minimum cut of a graph, exact.  Link k joins a and b with the same capacity both ways.  terminal[i] > 0:
 * capacity from the source; < 0: to the sink.  side[i] becomes 1 where node i can be reached from the source in the
 * residual graph, else 0.  *flow (may be NULL) is the cut's value. */
CeldStatus celd_flow (size_t n, const CeldLink *link, size_t n_links, const int64_t *terminal, const CeldHost *host,
                      uint8_t *side, int64_t *flow);

/* A ring with room for every node once. */
typedef struct { uint32_t *item; size_t first, n, room; } CeldFlowQueue;

static inline void
celd_queue_put (CeldFlowQueue *queue, uint32_t p)
{
  size_t last = queue->first + queue->n++;

  queue->item[last < queue->room ? last : last - queue->room] = p;
}

static inline uint32_t
celd_queue_take (CeldFlowQueue *queue)
{
  uint32_t p = queue->item[queue->first];

  queue->n--;
  if (++queue->first == queue->room)
    queue->first = 0;
  return p;
}

/* A network that is built once and cut many times.
 *
 * Its state is a pseudo-flow: what arcs have left, and an excess at each node, which counts what comes in more than
 * goes out, from a terminal or along arcs.  Any such state stands for the same cuts as the one that it was made from,
 * so that capacities may be changed between two cuts and the flow kept. */

/* The trees of a search, and where a node can be besides: no search enters a closed one, from which its arcs must have
 * nothing left. */
enum { CELD_SOURCE, CELD_SINK, CELD_NO_TREE, CELD_CLOSED };

/* left[CELD_SOURCE]: what may still flow from the node of the arc to `to`; left[CELD_SINK]: from `to` to it, which is
 * what the sister, the arc in the other direction, has for left[CELD_SOURCE]. */
typedef struct { int64_t left[2]; uint32_t to, sister; } CeldFlowArc;

typedef struct
{
  int64_t  excess;      /* > 0: looks for a way to a node with < 0 */
  uint32_t arc;         /* its first one; they end where those of the next node begin */
  uint32_t parent;      /* its arc to the parent, if any */
  uint32_t stamp;       /* the augmentation after which `distance` was last found right */
  uint32_t distance;    /* 1 + arcs to the root, along the parents */
  uint8_t  tree;
  bool     waits[2];    /* among the active nodes of this tree, though it may have left it since */
  bool     seen;        /* was in a tree in this search */
} CeldFlowNode;

typedef struct
{
  size_t        n;
  CeldFlowNode *node;       /* n + 1, the last one only as the end of the arcs */
  CeldFlowArc  *arc;
  uint32_t     *reached;    /* after celd_network_drain: nodes that remaining excess can reach, in no order */
  size_t        n_reached;
  CeldFlowQueue active[2], orphans;
  uint32_t      augmentations;
} CeldNetwork;

/* Arcs of both directions for each link, with its cost left in both; no excess. */
CeldStatus celd_network_new (size_t n, const CeldLink *link, size_t n_links, CeldNetwork *network);
void       celd_network_clear (CeldNetwork *network); /* accepts a zeroed one */

/* To begin a search; then a root for each node that has an excess and is not closed, and may be for nodes that lack
 * something, which are found in any case: their tree can grow from the start if all of them are told. */
void celd_network_begin (CeldNetwork *network);
void celd_network_root (CeldNetwork *network, uint32_t p);

/* Moves excess to nodes that lack some until no way is left, and fills in `reached`.  If it is cancelled the state
 * still stands for the same cuts. */
CeldStatus celd_network_drain (CeldNetwork *network, const CeldHost *host);

/* ------------------------------------------------------------------ partition-*.c: a problem made ready
 *
 * Labels are ranks here, their places in the order, from 0; nodes are those that are not fixed.  A link to a fixed node
 * is a vote for that node's label, and votes for the same label are added up. */

typedef struct { uint32_t node, rank; int64_t cost; } CeldVoteSum;

typedef struct
{
  size_t       n, n_ranks;
  CeldNetwork  network;
  int64_t     *cost;       /* of arc a: of different labels on its two nodes */
  CeldVoteSum *vote_sum;   /* votes by node, then by rank */
  size_t      *of_node;    /* n + 1: those of node p are vote_sum[of_node[p]] .. */
  uint32_t    *by_rank;    /* the vote sums by rank, then by node */
  size_t      *of_rank;    /* n_ranks + 1 */
  uint32_t    *rank;       /* of each node: the answer */
} CeldPartitionGraph;

/* partition-greedy.c: a first answer. */
CeldStatus celd_partition_greedy (CeldPartitionGraph *graph, const CeldHost *host);

/* partition-expand.c: a better one. */
CeldStatus celd_partition_expand (CeldPartitionGraph *graph, const CeldHost *host);

#endif
