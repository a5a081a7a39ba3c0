/* The labels separated in turn by exact cuts, as in multiway.c: in each connected component of undecided nodes the
 * first label that reaches it from all others, and so on with the connected components of both sides.  A component that
 * only one label reaches is that label's without a cut.  Many labels are first separated in halves.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "solve/partition.h"

#include <string.h>

/* A connected component: the nodes item[begin] .. item[end - 1], for which component[p] == id.  Labels of rank from ..
 * to - 1 may get it; the next cut is between those below mid and the others. */
typedef struct { uint32_t id; uint32_t begin, end; uint32_t from, mid, to; } NodeComponent;

typedef struct
{
  CeldPartitionGraph *graph;
  uint32_t           *component;
  uint32_t           *item, *found; /* nodes by component; while components are looked for, the new ones */
  uint32_t           *seen;         /* by rank: the last component that this label reaches */
  uint32_t            last_id;
  NodeComponent      *todo;         /* a component has a node at least, so that there are never more than nodes */
  size_t              n_todo, decided;
} Greedy;

/* ------------------------------------------------------------------ components */

/* Counts the labels that reach p, of those that may get the component and have not been seen in it. */
static uint32_t
see (Greedy *g, const NodeComponent *component, uint32_t p)
{
  uint32_t reached = 0;

  for (size_t i = g->graph->of_node[p]; i < g->graph->of_node[p + 1]; i++)
    {
      uint32_t rank = g->graph->vote_sum[i].rank;

      if (rank < component->from || rank >= component->to || g->seen[rank] == component->id)
        continue;
      g->seen[rank] = component->id;
      reached++;
    }
  return reached;
}

/* Makes the nodes that are connected with `start` and are of component `old` the new component, from component->begin
 * on.  Returns the number of labels that reach it. */
static uint32_t
fill (Greedy *g, uint32_t start, uint32_t old, NodeComponent *component)
{
  const CeldNetwork *network = &g->graph->network;
  uint32_t           reached = 0;

  component->end = component->begin;
  g->component[start] = component->id;
  g->found[component->end++] = start;
  for (uint32_t i = component->begin; i < component->end; i++)
    {
      uint32_t p = g->found[i];

      reached += see (g, component, p);
      for (uint32_t a = network->node[p].arc; a < network->node[p + 1].arc; a++)
        {
          uint32_t q = network->arc[a].to;

          if (g->component[q] != old)
            continue;
          g->component[q] = component->id;
          g->found[component->end++] = q;
        }
    }
  return reached;
}

/* The component belongs to the only label that reaches it, or to the first one if none does. */
static void
decide (Greedy *g, const NodeComponent *component)
{
  uint32_t rank = component->from;

  while (rank < component->to && g->seen[rank] != component->id)
    rank++;
  for (uint32_t i = component->begin; i < component->end; i++)
    g->graph->rank[g->found[i]] = rank < component->to ? rank : component->from;
  g->decided += component->end - component->begin;
}

/* The first label against the others; or the first half of them if they are many. */
static uint32_t
middle_rank (const Greedy *g, const NodeComponent *component, uint32_t reached)
{
  uint32_t left = reached < CELD_MANY_LABELS ? 1 : reached / 2;
  uint32_t rank = component->from;

  for (; left; rank++)
    left -= g->seen[rank] == component->id;
  return rank;
}

/* Finds the connected components among the items of `first` and `others`, which lie mixed.  Those that one label
 * reaches are decided, the others noted. */
static void
find_components (Greedy *g, const NodeComponent *first, const NodeComponent *others)
{
  uint32_t begin = others->begin;

  for (uint32_t i = others->begin; i < others->end; i++)
    {
      uint32_t             p = g->item[i], reached;
      const NodeComponent *old = g->component[p] == first->id ? first : others;
      NodeComponent        component = *old;

      if (g->component[p] != old->id)
        continue;
      component.id    = ++g->last_id;
      component.begin = begin;
      reached = fill (g, p, old->id, &component);
      begin   = component.end;
      if (reached < 2)
        decide (g, &component);
      else
        {
          component.mid = middle_rank (g, &component, reached);
          g->todo[g->n_todo++] = component;
        }
    }
  memcpy (g->item + others->begin, g->found + others->begin, (others->end - others->begin) * sizeof *g->item);
}

/* ------------------------------------------------------------------ one cut */

/* The terminal capacity of p, to the labels below mid (> 0) or to the others (< 0). */
static int64_t
terminal_capacity (const Greedy *g, const NodeComponent *component, uint32_t p)
{
  int64_t sum = 0;

  for (size_t i = g->graph->of_node[p]; i < g->graph->of_node[p + 1]; i++)
    {
      const CeldVoteSum *vote_sum = &g->graph->vote_sum[i];

      if (vote_sum->rank >= component->from && vote_sum->rank < component->to)
        sum += vote_sum->rank < component->mid ? vote_sum->cost : -vote_sum->cost;
    }
  return sum;
}

/* Arcs only within the component. */
static void
lay_out (Greedy *g, const NodeComponent *component)
{
  CeldNetwork *network = &g->graph->network;

  celd_network_begin (network);
  for (uint32_t i = component->begin; i < component->end; i++)
    {
      uint32_t p = g->item[i];

      for (uint32_t a = network->node[p].arc; a < network->node[p + 1].arc; a++)
        {
          CeldFlowArc *arc = &network->arc[a];

          arc->left[0] = arc->left[1] = g->component[arc->to] == component->id ? g->graph->cost[a] : 0;
        }
      network->node[p].excess = terminal_capacity (g, component, p);
      if (network->node[p].excess)
        celd_network_root (network, p);
    }
}

static CeldStatus
cut (Greedy *g, const NodeComponent *component, const CeldHost *host)
{
  CeldNetwork  *network = &g->graph->network;
  NodeComponent first = *component, others = *component;
  double        done = (double) g->decided / (double) g->graph->n;
  CeldHostPart  part;
  CeldHost      still = celd_host_part (&part, host, done, done);
  CeldStatus    status = celd_progress (host, done);

  if (status != CELD_OK)
    return status;
  lay_out (g, component);
  status = celd_network_drain (network, &still);
  if (status != CELD_OK)
    return status;
  first.id = ++g->last_id;
  first.to = others.from = component->mid;
  for (size_t i = 0; i < network->n_reached; i++)
    g->component[network->reached[i]] = first.id;
  find_components (g, &first, &others);
  return CELD_OK;
}

/* ------------------------------------------------------------------ the whole */

CeldStatus
celd_partition_greedy (CeldPartitionGraph *graph, const CeldHost *host)
{
  size_t        n = graph->n;
  Greedy        g = { .graph = graph, .last_id = 1 };
  NodeComponent all = { 1, 0, (uint32_t) n, 0, 0, (uint32_t) graph->n_ranks }, none = { 0 };
  CeldStatus    status = CELD_NO_MEMORY;

  g.component = celd_alloc (n, sizeof *g.component);
  g.item  = celd_alloc (n, sizeof *g.item);
  g.found = celd_alloc (n, sizeof *g.found);
  g.seen  = celd_alloc0 (graph->n_ranks, sizeof *g.seen);
  g.todo  = celd_alloc (n, sizeof *g.todo);
  if (!g.component || !g.item || !g.found || !g.seen || !g.todo)
    goto done;
  for (uint32_t p = 0; p < n; p++)
    {
      g.component[p] = 1;
      g.item[p]  = p;
    }
  find_components (&g, &none, &all);
  status = celd_progress (host, 0);
  while (status == CELD_OK && g.n_todo)
    {
      NodeComponent component = g.todo[--g.n_todo];

      status = cut (&g, &component, host);
    }

done:
  celd_free (g.component);
  celd_free (g.item);
  celd_free (g.found);
  celd_free (g.seen);
  celd_free (g.todo);
  return status;
}
