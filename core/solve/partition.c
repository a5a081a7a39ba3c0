/* Many labels on a graph of any shape: the Potts energy of LazyBrush [SDC09b],
 *   E(c) = sum over links p, q with c_p != c_q of their cost  +  sum over votes on p that are not for c_p,
 * on the nodes of a basin graph.  First the labels are separated one after the other by exact binary cuts
 * (partition-greedy.c), which is exact for two of them; then every label may expand (partition-expand.c), which lowers
 * the energy further.
 *
 * Before that the problem is made ready for cuts: fixed nodes are taken out, votes are sorted and added up.
 *
 * Cost: O(links + votes), and a few minimum cuts for each label.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/partition.h"

#include <string.h>

/* ------------------------------------------------------------------ the graph */

#define FIXED UINT32_MAX

typedef struct
{
  const CeldPartition *problem;
  uint32_t            *free_node;    /* of node k: its number among those that are not fixed, or FIXED */
  uint32_t            *rank;         /* of label l: rank[l - 1] */
  CeldLink            *link;         /* between nodes that are not fixed */
  size_t               n_links;
  CeldVoteSum         *raw, *sorted; /* votes as they come; by rank */
  size_t               n_raw;
  size_t              *count;        /* n_ranks + 1 */
} Draft;

static void
draft_free (Draft *draft)
{
  celd_free (draft->free_node);
  celd_free (draft->rank);
  celd_free (draft->link);
  celd_free (draft->raw);
  celd_free (draft->sorted);
  celd_free (draft->count);
}

static CeldStatus
draft_new (const CeldPartition *m, Draft *draft)
{
  size_t n_raw = m->n_votes + m->n_links;

  *draft = (Draft) { .problem = m };
  if (m->n >= FIXED || m->n_labels >= UINT32_MAX || n_raw < m->n_links || n_raw >= UINT32_MAX)
    return CELD_BAD_SIZE;
  draft->free_node = celd_alloc (m->n, sizeof *draft->free_node);
  draft->rank      = celd_alloc (m->n_labels, sizeof *draft->rank);
  draft->link      = celd_alloc (m->n_links, sizeof *draft->link);
  draft->raw       = celd_alloc (n_raw, sizeof *draft->raw);
  draft->sorted    = celd_alloc (n_raw, sizeof *draft->sorted);
  draft->count     = celd_alloc0 (m->n_labels + 1, sizeof *draft->count);
  return draft->free_node && draft->rank && draft->link && draft->raw && draft->sorted && draft->count
       ? CELD_OK : CELD_NO_MEMORY;
}

/* Nodes that are not fixed are numbered on. */
static size_t
number (Draft *draft)
{
  const CeldPartition *m = draft->problem;
  uint32_t             n = 0;

  for (size_t i = 0; i < m->n_labels; i++)
    draft->rank[m->order[i] - 1] = (uint32_t) i;
  for (size_t k = 0; k < m->n; k++)
    draft->free_node[k] = m->fixed && m->fixed[k] ? FIXED : n++;
  return n;
}

static void
add_vote (Draft *draft, uint32_t node, uint32_t label, int64_t cost)
{
  if (draft->free_node[node] != FIXED)
    draft->raw[draft->n_raw++] = (CeldVoteSum) { draft->free_node[node], draft->rank[label - 1], cost };
}

static void
sort_out (Draft *draft)
{
  const CeldPartition *m = draft->problem;

  for (size_t k = 0; k < m->n_votes; k++)
    add_vote (draft, m->vote[k].node, m->vote[k].label, m->vote[k].cost);
  for (size_t k = 0; k < m->n_links; k++)
    {
      const CeldLink *link = &m->link[k];
      uint32_t        a = draft->free_node[link->a], b = draft->free_node[link->b];

      if (a != FIXED && b != FIXED)
        draft->link[draft->n_links++] = (CeldLink) { a, b, link->cost };
      else if (a != FIXED)
        add_vote (draft, link->a, m->fixed[link->b], link->cost);
      else if (b != FIXED)
        add_vote (draft, link->b, m->fixed[link->a], link->cost);
    }
}

static CeldStatus
allocate (const Draft *draft, CeldPartitionGraph *graph)
{
  graph->cost    = celd_alloc (2 * draft->n_links, sizeof *graph->cost);
  graph->vote_sum  = celd_alloc (draft->n_raw, sizeof *graph->vote_sum);
  graph->of_node = celd_alloc0 (graph->n + 1, sizeof *graph->of_node);
  graph->by_rank = celd_alloc (draft->n_raw, sizeof *graph->by_rank);
  graph->of_rank = celd_alloc0 (graph->n_ranks + 1, sizeof *graph->of_rank);
  graph->rank    = celd_alloc (graph->n, sizeof *graph->rank);
  return graph->cost && graph->vote_sum && graph->of_node && graph->by_rank && graph->of_rank && graph->rank
       ? CELD_OK : CELD_NO_MEMORY;
}

/* From how many there are of each to where those of each begin. */
static void
sum_up (size_t *count, size_t n)
{
  size_t sum = 0;

  for (size_t i = 0; i <= n; i++)
    {
      size_t own = count[i];

      count[i] = sum;
      sum += own;
    }
}

/* By rank first and then, keeping that order, by node: counting sorts, as a node may have any number of votes. */
static void
sort_votes (Draft *draft, CeldPartitionGraph *graph)
{
  for (size_t i = 0; i < draft->n_raw; i++)
    {
      draft->count[draft->raw[i].rank]++;
      graph->of_node[draft->raw[i].node]++;
    }
  sum_up (draft->count, graph->n_ranks);
  sum_up (graph->of_node, graph->n);
  for (size_t i = 0; i < draft->n_raw; i++)
    draft->sorted[draft->count[draft->raw[i].rank]++] = draft->raw[i];
  for (size_t i = 0; i < draft->n_raw; i++)
    draft->raw[graph->of_node[draft->sorted[i].node]++] = draft->sorted[i];
}

/* Votes of a node for one label become one; then the index by rank. */
static void
add_up_votes (Draft *draft, CeldPartitionGraph *graph)
{
  size_t n = 0;

  memset (graph->of_node, 0, (graph->n + 1) * sizeof *graph->of_node);
  for (size_t i = 0; i < draft->n_raw; i++)
    if (i && draft->raw[i].node == draft->raw[i - 1].node && draft->raw[i].rank == draft->raw[i - 1].rank)
      graph->vote_sum[n - 1].cost += draft->raw[i].cost;
    else
      {
        graph->vote_sum[n++] = draft->raw[i];
        graph->of_node[draft->raw[i].node]++;
        graph->of_rank[draft->raw[i].rank]++;
      }
  sum_up (graph->of_node, graph->n);
  sum_up (graph->of_rank, graph->n_ranks);
  memcpy (draft->count, graph->of_rank, (graph->n_ranks + 1) * sizeof *draft->count);
  for (size_t i = 0; i < n; i++)
    graph->by_rank[draft->count[graph->vote_sum[i].rank]++] = (uint32_t) i;
}

/* The graph's nodes are those of the problem that are not fixed, in the same order.  To be cleared, also after a
 * failure. */
static CeldStatus
graph_new (const CeldPartition *problem, CeldPartitionGraph *graph)
{
  Draft      draft;
  CeldStatus status = draft_new (problem, &draft);

  *graph = (CeldPartitionGraph) { .n_ranks = problem->n_labels };
  if (status != CELD_OK)
    goto done;
  graph->n = number (&draft);
  sort_out (&draft);
  status = celd_network_new (graph->n, draft.link, draft.n_links, &graph->network);
  if (status == CELD_OK)
    status = allocate (&draft, graph);
  if (status != CELD_OK)
    goto done;
  for (size_t a = 0; a < 2 * draft.n_links; a++)
    graph->cost[a] = graph->network.arc[a].left[0];
  sort_votes (&draft, graph);
  add_up_votes (&draft, graph);

done:
  draft_free (&draft);
  return status;
}

static void
graph_clear (CeldPartitionGraph *graph)
{
  celd_network_clear (&graph->network);
  celd_free (graph->cost);
  celd_free (graph->vote_sum);
  celd_free (graph->of_node);
  celd_free (graph->by_rank);
  celd_free (graph->of_rank);
  celd_free (graph->rank);
  *graph = (CeldPartitionGraph) { 0 };
}

/* ------------------------------------------------------------------ the partition */

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
  CeldHostPart       part[2];
  CeldHost           half[2] = { celd_host_part (&part[0], host, 0, 0.5), celd_host_part (&part[1], host, 0.5, 1) };
  uint32_t          *result = celd_alloc (problem->n, sizeof *result);
  CeldStatus         status = result ? graph_new (problem, &graph) : CELD_NO_MEMORY;
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
  graph_clear (&graph);
  celd_free (result);
  return status;
}
