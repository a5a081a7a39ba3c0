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

#include "solve/partition.h"

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

/* A ring with room for every node once. */
typedef struct { uint32_t *item; size_t first, n, room; } CeldFlowQueue;

typedef struct
{
  size_t         n;
  CeldFlowNode  *node;      /* n + 1, the last one only as the end of the arcs */
  CeldFlowArc       *arc;
  uint32_t      *reached;   /* after celd_network_drain: nodes that remaining excess can reach, in no order */
  size_t         n_reached;
  CeldFlowQueue  active[2], orphans;
  uint32_t       augmentations;
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

#endif
