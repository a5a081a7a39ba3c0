/* Many labels on a small graph: the Potts energy of LazyBrush [SDC09b],
 *   E(c) = sum over links p, q with c_p != c_q of their cost  +  sum over votes on p not for c_p of theirs,
 * on the nodes of a basin graph.  First the labels are told apart in turn (partition-greedy.c), as on pixels, which is
 * exact for two of them; then every label may expand (partition-expand.c), which on so small a graph costs next to
 * nothing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/partition-graph.h"
#include "solve/partition.h"

#include <string.h>

int64_t
celd_partition_energy (const CeldPartition *problem, const uint32_t *label)
{
  int64_t energy = 0;

  for (size_t k = 0; k < problem->n_links; k++)
    if (label[problem->link[k].a] != label[problem->link[k].b])
      energy += problem->link[k].cost;
  for (size_t k = 0; k < problem->n_votes; k++)
    if (label[problem->vote[k].node] != problem->vote[k].label)
      energy += problem->vote[k].cost;
  return energy;
}

/* Fixed nodes keep theirs. */
static int64_t
read_labels (const CeldPartition *problem, const CeldPartitionGraph *graph, uint32_t *label)
{
  size_t p = 0;

  for (size_t k = 0; k < problem->n; k++)
    label[k] = problem->fixed && problem->fixed[k] ? problem->fixed[k] : problem->order[graph->rank[p++]];
  return celd_partition_energy (problem, label);
}

CeldStatus
celd_partition (const CeldPartition *problem, const CeldHost *host, uint32_t *label, int64_t *energy, int64_t *greedy)
{
  CeldPartitionGraph graph = { 0 };
  CeldHostPart           part[2];
  CeldHost           half[2] = { celd_host_part (&part[0], host, 0, 0.5), celd_host_part (&part[1], host, 0.5, 1) };
  uint32_t          *result = celd_alloc (problem->n, sizeof *result);
  CeldStatus         status = result ? celd_partition_graph_new (problem, &graph) : CELD_NO_MEMORY;
  int64_t            before, after;

  if (status == CELD_OK)
    status = celd_partition_greedy (&graph, &half[0]);
  if (status != CELD_OK)
    goto done;
  before = after = read_labels (problem, &graph, result);
  if (graph.n_ranks > 2) /* else the cut was the best there is */
    status = celd_partition_expand (&graph, &half[1]);
  if (status != CELD_OK)
    goto done;
  after = read_labels (problem, &graph, result);
  memcpy (label, result, problem->n * sizeof *label);
  if (energy)
    *energy = after;
  if (greedy)
    *greedy = before;

done:
  celd_partition_graph_clear (&graph);
  celd_free (result);
  return status;
}
