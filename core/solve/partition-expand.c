/* Alpha-expansion: Y. Boykov, O. Veksler and R. Zabih, "Fast Approximate Energy Minimization via Graph Cuts", PAMI
 * 2001.  The best set of nodes that can take the label alpha at once is a minimum cut: the source side takes it.  This
 * is repeated with all labels in turn until none of them lowers the energy.
 *
 * A link of cost w costs, by who keeps its label (k) and who takes alpha (t), in units of half the cost, so that all
 * capacities are symmetric:
 *   same label now:             kk 0, tk = kt 2w, tt 0:    capacity 2w both ways;
 *   different labels:           kk = tk = kt 2w, tt 0:     capacity w both ways, and w for each of the two that keeps;
 *   the other is alpha already: k 2w, t 0:                 2w for keeping.
 * A vote v costs 2v for taking alpha if it is for the label that the node has, and for keeping if it is for alpha.
 *
 * Only the last rule and the votes for alpha depend on alpha.  Without them the network is that of a label that has
 * neither nodes nor votes; its pseudo-flow is kept from one expansion to the next, so that only what borders on alpha
 * and what votes for it is new.  Nodes that are alpha stand for the source: all they have left flows to the neighbours,
 * and they are closed.  What the votes for alpha added is taken away in the end; a node that has a
 * deficit then is one that the same expansion finds again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/partition.h"

typedef struct
{
  CeldPartitionGraph *graph;
  int64_t            *current;     /* of each node: the votes for the label that it has */
  int64_t            *for_alpha;   /* the votes for alpha, while it expands; else 0 */
  uint32_t           *excess_node; /* nodes whose excess does not come from alpha; at first all nodes */
  size_t              n_excess;
  bool               *is_listed;
} Expansion;

/* ------------------------------------------------------------------ the network without alpha */

/* Nothing flows yet. */
static void
lay_out (Expansion *e)
{
  CeldPartitionGraph *graph = e->graph;

  for (size_t i = 0; i < graph->of_rank[graph->n_ranks]; i++)
    if (graph->vote_sum[i].rank == graph->rank[graph->vote_sum[i].node])
      e->current[graph->vote_sum[i].node] = graph->vote_sum[i].cost;
  for (uint32_t p = 0; p < graph->n; p++)
    {
      CeldFlowNode *node = &graph->network.node[p];

      node->excess   = -2 * e->current[p];
      e->is_listed[p] = true;
      e->excess_node[e->n_excess++] = p;
      for (uint32_t a = node->arc; a < node[1].arc; a++)
        {
          CeldFlowArc *arc = &graph->network.arc[a];
          bool         same = graph->rank[arc->to] == graph->rank[p];

          arc->left[0] = arc->left[1] = same ? 2 * graph->cost[a] : graph->cost[a];
          node->excess += same ? 0 : graph->cost[a];
        }
    }
}

static void
move (CeldNetwork *network, uint32_t p, CeldFlowArc *arc, int64_t amount)
{
  CeldFlowArc *sister = &network->arc[arc->sister];

  arc->left[CELD_SOURCE]    -= amount;
  arc->left[CELD_SINK]      += amount;
  sister->left[CELD_SINK]   -= amount;
  sister->left[CELD_SOURCE] += amount;
  network->node[p].excess       -= amount;
  network->node[arc->to].excess += amount;
}

/* Adds to the capacity of a link, and takes from what keeping costs its two nodes, after an end of it has changed. */
static void
widen (CeldNetwork *network, uint32_t p, CeldFlowArc *arc, int64_t cost)
{
  CeldFlowArc *sister = &network->arc[arc->sister];

  for (int t = 0; t < 2; t++)
    {
      arc->left[t]    += cost;
      sister->left[t] += cost;
    }
  network->node[p].excess       -= cost;
  network->node[arc->to].excess -= cost;
}

/* Gives p the label alpha in the network.  Where a link gets narrower than what flows there, less flows. */
static void
take (Expansion *e, uint32_t p, uint32_t alpha)
{
  CeldPartitionGraph *graph = e->graph;
  CeldNetwork        *network = &graph->network;
  CeldFlowNode       *node = &network->node[p];

  for (uint32_t a = node->arc; a < node[1].arc; a++)
    {
      CeldFlowArc *arc = &network->arc[a];
      int64_t      cost = graph->cost[a];

      if (graph->rank[arc->to] == alpha)
        widen (network, p, arc, cost);
      else if (graph->rank[arc->to] == graph->rank[p])
        {
          if (arc->left[CELD_SOURCE] < cost)
            move (network, p, arc, arc->left[CELD_SOURCE] - cost);
          else if (arc->left[CELD_SINK] < cost)
            move (network, p, arc, cost - arc->left[CELD_SINK]);
          widen (network, p, arc, -cost);
        }
    }
  node->excess  += 2 * (e->current[p] - e->for_alpha[p]);
  e->current[p]     = e->for_alpha[p];
  graph->rank[p] = alpha;
}

/* ------------------------------------------------------------------ one expansion */

/* Begins a search at p if it has an excess.  Nodes with a deficit need no root: the search finds them. */
static void
root (Expansion *e, uint32_t p)
{
  const CeldFlowNode *node = &e->graph->network.node[p];

  if (node->excess > 0 && node->tree == CELD_NO_TREE)
    celd_network_root (&e->graph->network, p);
}

/* The nodes that are alpha already are the source. */
static void
close_alpha (Expansion *e, uint32_t alpha)
{
  CeldNetwork    *network = &e->graph->network;
  const uint32_t *rank = e->graph->rank;

  for (uint32_t p = 0; p < e->graph->n; p++)
    if (rank[p] == alpha)
      network->node[p].tree = CELD_CLOSED;
  for (uint32_t p = 0; p < e->graph->n; p++)
    if (rank[p] == alpha)
      for (uint32_t a = network->node[p].arc; a < network->node[p + 1].arc; a++)
        if (rank[network->arc[a].to] != alpha)
          {
            move (network, p, &network->arc[a], network->arc[a].left[CELD_SOURCE]);
            root (e, network->arc[a].to);
          }
}

static void
open_alpha (Expansion *e, uint32_t alpha)
{
  for (uint32_t p = 0; p < e->graph->n; p++)
    if (e->graph->rank[p] == alpha)
      e->graph->network.node[p].tree = CELD_NO_TREE;
}

/* Puts (sign = 1) or takes away (-1) what the votes for alpha add. */
static void
vote (Expansion *e, uint32_t alpha, int sign)
{
  CeldPartitionGraph *graph = e->graph;

  for (size_t i = graph->of_rank[alpha]; i < graph->of_rank[alpha + 1]; i++)
    {
      const CeldVoteSum *vote_sum = &graph->vote_sum[graph->by_rank[i]];

      if (graph->rank[vote_sum->node] == alpha)
        continue;
      graph->network.node[vote_sum->node].excess += 2 * sign * vote_sum->cost;
      e->for_alpha[vote_sum->node] = vote_sum->cost;
      if (sign > 0)
        root (e, vote_sum->node);
    }
}

static void
forget_votes (Expansion *e, uint32_t alpha)
{
  for (size_t i = e->graph->of_rank[alpha]; i < e->graph->of_rank[alpha + 1]; i++)
    e->for_alpha[e->graph->vote_sum[e->graph->by_rank[i]].node] = 0;
}

static void
list_excess (Expansion *e, uint32_t p)
{
  if (e->is_listed[p] || e->graph->network.node[p].excess <= 0)
    return;
  e->is_listed[p] = true;
  e->excess_node[e->n_excess++] = p;
}

/* Lists all nodes that can have an excess now: those that had one and were closed, and those that took alpha.  Their
 * neighbours have none: the flow to them along saturated links falls by as much as keeping their label costs more. */
static void
list_all_excess (Expansion *e)
{
  const CeldNetwork *network = &e->graph->network;
  size_t             n = e->n_excess;

  e->n_excess = 0;
  for (size_t i = 0; i < n; i++)
    {
      e->is_listed[e->excess_node[i]] = false;
      list_excess (e, e->excess_node[i]);
    }
  for (size_t i = 0; i < network->n_reached; i++)
    list_excess (e, network->reached[i]);
}

/* *changed: did any node take the label? */
static CeldStatus
expand (Expansion *e, uint32_t alpha, const CeldHost *host, bool *changed)
{
  CeldNetwork *network = &e->graph->network;
  CeldStatus   status;

  celd_network_begin (network);
  close_alpha (e, alpha);
  vote (e, alpha, 1);
  for (size_t i = 0; i < e->n_excess; i++)
    if (network->node[e->excess_node[i]].excess && network->node[e->excess_node[i]].tree == CELD_NO_TREE)
      celd_network_root (network, e->excess_node[i]);
  status = celd_network_drain (network, host);
  if (status != CELD_OK)
    return status;
  open_alpha (e, alpha);
  vote (e, alpha, -1);
  for (size_t i = 0; i < network->n_reached; i++)
    take (e, network->reached[i], alpha);
  forget_votes (e, alpha);
  list_all_excess (e);
  *changed = network->n_reached;
  return CELD_OK;
}

CeldStatus
celd_partition_expand (CeldPartitionGraph *graph, const CeldHost *host)
{
  Expansion  e = { .graph = graph };
  uint32_t   alpha = 0;
  size_t     settled = 0; /* labels in a row that could not expand */
  CeldStatus status = CELD_NO_MEMORY;

  e.current     = celd_alloc0 (graph->n, sizeof *e.current);
  e.for_alpha   = celd_alloc0 (graph->n, sizeof *e.for_alpha);
  e.excess_node    = celd_alloc (graph->n, sizeof *e.excess_node);
  e.is_listed = celd_alloc (graph->n, sizeof *e.is_listed);
  if (!e.current || !e.for_alpha || !e.excess_node || !e.is_listed)
    goto done;
  lay_out (&e);
  status = celd_progress (host, 0); /* how often all labels have to be tried cannot be told */
  while (status == CELD_OK && settled < graph->n_ranks)
    {
      bool changed = false;

      status = expand (&e, alpha, host, &changed);
      if (status == CELD_OK)
        status = celd_progress (host, 0);
      settled = changed ? 1 : settled + 1; /* twice in a row is of no use */
      if (++alpha == graph->n_ranks)
        alpha = 0;
    }

done:
  celd_free (e.current);
  celd_free (e.for_alpha);
  celd_free (e.excess_node);
  celd_free (e.is_listed);
  return status;
}
