/* Many labels on a small graph of any shape: the Potts energy of LazyBrush [SDC09b] on the nodes of a basin graph.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PARTITION_H
#define CELD_PARTITION_H

#include "base/base.h"

/* The sum of all costs of a problem, terminals included, is at most 2^60: nothing overflows then. */

#define CELD_MANY_LABELS 24 /* labels from which on a component is first cut between two halves of them; chosen */

typedef struct { uint32_t a, b; int64_t cost; } CeldLink;           /* of different labels on the nodes a and b; > 0 */
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

/* flow.c: minimum cut of a graph, exact.  Link k joins a and b with the same capacity both ways.  terminal[i] > 0:
 * capacity from the source; < 0: to the sink.  side[i] becomes 1 where node i can be reached from the source in the
 * residual graph, else 0.  *flow (may be NULL) is the cut's value. */
CeldStatus celd_flow (size_t n, const CeldLink *link, size_t n_links, const int64_t *terminal, const CeldHost *host,
                      uint8_t *side, int64_t *flow);

#endif
