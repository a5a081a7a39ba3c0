/* A network for minimum cuts that is built once and cut many times: what flow.c and the parts of partition.c share.
 *
 * Its state is a pseudo-flow: what arcs have left, and an excess at each node, which counts what comes in more than
 * goes out, from a terminal or along arcs.  Any such state stands for the same cuts as the one that it was made from,
 * so that capacities may be changed between two cuts and the flow kept.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_FLOW_H
#define CELD_FLOW_H

#include "partition.h"

#define CELD_FLOW_CLOSED UINT32_MAX /* level of a node that no search enters */

/* `back` is what the arc in the other direction has left: nodes[to].arc[sister].left. */
typedef struct { int64_t left, back; uint32_t to, sister; } CeldArc;

typedef struct
{
  int64_t  excess;    /* > 0: looks for a way to a node with < 0 */
  uint32_t arc;       /* its first one; they end where those of the next node begin */
  uint32_t level;     /* 1 + arcs to the root of its tree; 0: in no tree; CELD_FLOW_CLOSED */
  uint32_t parent;    /* its arc to the parent, if any */
  uint32_t current;   /* no arc before this one leads to a possible parent of this level */
  uint32_t queued;    /* the last level for which it was noted; 0: none in this search */
  uint32_t next;      /* orphan of this level */
} CeldFlowNode;

typedef struct
{
  size_t        n;
  CeldFlowNode *node;       /* n + 1, the last one only as the end of the arcs */
  CeldArc      *arc;
  uint32_t     *reached;    /* after celd_network_drain: nodes that remaining excess can reach, in no order */
  size_t        n_reached;
  /* Work space of the search. */
  uint32_t     *queue[2];   /* nodes of the level that grows and of the one above it */
  size_t        n_queue[2];
  uint32_t      depth;      /* the level that grows */
  uint32_t     *orphan;     /* the first one of each level */
  uint32_t      lowest, highest;  /* levels with orphans are between these */
} CeldNetwork;

/* Arcs of both directions for each link, with its cost left in both; no excess. */
CeldStatus celd_network_new (size_t n, const CeldLink *link, size_t n_links, CeldNetwork *network);
void       celd_network_clear (CeldNetwork *network); /* accepts a zeroed one */

/* Before celd_network_drain, for each node with excess > 0 that is not closed. */
void celd_network_root (CeldNetwork *network, uint32_t p);

/* Moves excess to nodes that lack some until no way is left.  Nothing is lost if it is cancelled: the state stands for
 * the same cuts. */
CeldStatus celd_network_drain (CeldNetwork *network, const CeldRun *run);

#endif
