/* Exact minimum cut of a sparse graph by shortest augmenting paths along a breadth-first forest that is repaired, not
 * grown anew, after each of them: A. V. Goldberg, S. Hed, H. Kaplan, R. E. Tarjan and R. F. Werneck, "Maximum Flows by
 * Incremental Breadth-First Search", ESA 2011.
 *
 * The forest grows from nodes with excess, level by level, along arcs that have something left.  Where it finds a node
 * that lacks something, excess is moved there from the root.  Nodes below arcs that this fills up are orphans, and so
 * is a root without excess: they take another parent of the same level if there is one, else the lowest parent there
 * is, on a higher level, and drop out of the forest if that is above the level that grows.  Levels never sink, which
 * bounds the work; no node knows its root, so that orphans cost their own arcs only.
 *
 * Of the two forests of that paper only that of the source is grown: the work is then done round the nodes with excess,
 * however large the rest of the graph is, and alpha-expansion (partition-expand.c) has few of them.  What it holds in
 * the end is all that the source still reaches: the smallest source side of a least cut.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "flow.h"

#include <string.h>

#define NONE UINT32_MAX

/* ------------------------------------------------------------------ the network */

static CeldStatus
allocate (size_t n, size_t n_arcs, CeldNetwork *network)
{
  *network = (CeldNetwork) { .n = n };
  network->node     = celd_alloc0 (n + 1, sizeof *network->node);
  network->arc      = celd_alloc (n_arcs, sizeof *network->arc);
  network->reached  = celd_alloc (n, sizeof *network->reached);
  network->queue[0] = celd_alloc (n, sizeof *network->queue[0]);
  network->queue[1] = celd_alloc (n, sizeof *network->queue[1]);
  network->orphan   = celd_alloc (n + 2, sizeof *network->orphan);
  return network->node && network->arc && network->reached && network->queue[0] && network->queue[1] &&
         network->orphan ? CELD_OK : CELD_NO_MEMORY;
}

/* Counts the arcs of each node, gives them room one node behind the other, and lays them in. */
static void
lay_out (const CeldLink *link, size_t n_links, CeldNetwork *network)
{
  CeldFlowNode *node = network->node;
  uint32_t      sum = 0;

  for (size_t k = 0; k < n_links; k++)
    {
      node[link[k].a].arc++;
      node[link[k].b].arc++;
    }
  for (size_t p = 0; p <= network->n; p++)
    {
      sum += node[p].arc;
      node[p].arc    = sum; /* the end of its arcs, for now */
      node[p].parent = NONE;
    }
  for (size_t k = n_links; k--; )
    {
      uint32_t a = --node[link[k].a].arc, b = --node[link[k].b].arc;

      network->arc[a] = (CeldArc) { link[k].cost, link[k].cost, link[k].b, b };
      network->arc[b] = (CeldArc) { link[k].cost, link[k].cost, link[k].a, a };
    }
  for (size_t level = 0; level < network->n + 2; level++)
    network->orphan[level] = NONE;
}

CeldStatus
celd_network_new (size_t n, const CeldLink *link, size_t n_links, CeldNetwork *network)
{
  CeldStatus status;

  *network = (CeldNetwork) { 0 };
  if (n >= NONE - 1 || n_links >= NONE / 2)
    return CELD_BAD_SIZE;
  status = allocate (n, 2 * n_links, network);
  if (status == CELD_OK)
    lay_out (link, n_links, network);
  return status;
}

void
celd_network_clear (CeldNetwork *network)
{
  celd_free (network->node);
  celd_free (network->arc);
  celd_free (network->reached);
  celd_free (network->queue[0]);
  celd_free (network->queue[1]);
  celd_free (network->orphan);
  *network = (CeldNetwork) { 0 };
}

/* ------------------------------------------------------------------ the forest */

/* The node p has come on the level above the one that grows: that will be its turn, unless it is noted already. */
static void
note (CeldNetwork *network, uint32_t p)
{
  CeldFlowNode *node = &network->node[p];

  if (!node->queued)
    network->reached[network->n_reached++] = p;
  else if (node->queued == node->level)
    return;
  node->queued = node->level;
  network->queue[1][network->n_queue[1]++] = p;
}

void
celd_network_root (CeldNetwork *network, uint32_t p)
{
  network->node[p].level  = 1;
  network->node[p].queued = 1;
  network->queue[0][network->n_queue[0]++] = p;
}

static void
make_orphan (CeldNetwork *network, uint32_t p)
{
  CeldFlowNode *node = &network->node[p];

  node->parent = NONE;
  node->next   = network->orphan[node->level];
  network->orphan[node->level] = p;
  if (node->level < network->lowest)
    network->lowest = node->level;
  if (node->level > network->highest)
    network->highest = node->level;
}

/* ------------------------------------------------------------------ augmentation */

/* Moves as much as q lacks and the way from its root allows. */
static void
augment (CeldNetwork *network, uint32_t q)
{
  CeldFlowNode *node = network->node;
  uint32_t      p;
  int64_t       amount = -node[q].excess;

  for (p = q; node[p].parent != NONE; p = network->arc[node[p].parent].to)
    if (network->arc[node[p].parent].back < amount)
      amount = network->arc[node[p].parent].back;
  if (node[p].excess < amount)
    amount = node[p].excess;
  node[q].excess += amount;
  node[p].excess -= amount;
  if (!node[p].excess)
    make_orphan (network, p);
  for (p = q; node[p].parent != NONE; )
    {
      CeldArc *arc = &network->arc[node[p].parent], *sister = &network->arc[arc->sister];

      arc->left    += amount;
      sister->back += amount;
      arc->back    -= amount;
      sister->left -= amount;
      if (!arc->back)
        make_orphan (network, p);
      p = arc->to;
    }
}

/* ------------------------------------------------------------------ adoption */

/* Is there another parent of the same level? */
static bool
adopt (CeldNetwork *network, CeldFlowNode *node)
{
  for (; node->current < node[1].arc; node->current++)
    {
      const CeldArc *arc = &network->arc[node->current];

      if (!arc->back || network->node[arc->to].level != node->level - 1)
        continue;
      node->parent = node->current;
      return true;
    }
  return false;
}

/* Lifts p above the lowest parent there is; or it drops out.  Its children are orphans now. */
static void
lift (CeldNetwork *network, uint32_t p)
{
  CeldFlowNode *node = &network->node[p];
  uint32_t      lowest = network->depth; /* arcs of the parent to its root */

  for (uint32_t a = node->arc; a < node[1].arc; a++)
    {
      const CeldArc *arc = &network->arc[a];
      CeldFlowNode  *other = &network->node[arc->to];

      if (other->parent == arc->sister)
        make_orphan (network, arc->to);
      if (!arc->back || other->level - 1 >= lowest)
        continue; /* 0 - 1 is large, too */
      lowest        = other->level - 1;
      node->parent  = a;
      node->current = a;
    }
  node->level = node->parent == NONE ? 0 : lowest + 2;
  if (node->level > network->depth)
    note (network, p);
}

static void
adopt_orphans (CeldNetwork *network)
{
  for (uint32_t level = network->lowest; level <= network->highest; level++)
    while (network->orphan[level] != NONE)
      {
        uint32_t      p = network->orphan[level];
        CeldFlowNode *node = &network->node[p];

        network->orphan[level] = node->next;
        if (level == 1 || !adopt (network, node))
          lift (network, p);
      }
  network->lowest  = NONE;
  network->highest = 0;
}

/* ------------------------------------------------------------------ growth */

/* All that p reaches and the forest does not have yet comes on the next level. */
static void
grow (CeldNetwork *network, uint32_t p)
{
  CeldFlowNode *node = &network->node[p];

  for (uint32_t a = node->arc; a < node[1].arc; a++)
    {
      const CeldArc *arc = &network->arc[a];
      CeldFlowNode  *other = &network->node[arc->to];

      if (!arc->left || other->level)
        continue;
      other->level   = network->depth + 1;
      other->parent  = arc->sister;
      other->current = other->arc;
      note (network, arc->to);
      while (other->excess < 0 && other->level)
        {
          augment (network, arc->to);
          adopt_orphans (network);
        }
      if (node->level != network->depth)
        return;
    }
}

/* Keeps of the nodes that were in the forest those that still are, and takes it down. */
static void
take_down (CeldNetwork *network)
{
  size_t n = 0;

  for (size_t i = 0; i < network->n_reached; i++)
    {
      uint32_t      p = network->reached[i];
      CeldFlowNode *node = &network->node[p];

      if (node->level)
        network->reached[n++] = p;
      node->level = node->queued = 0;
      node->parent = NONE;
    }
  network->n_reached  = n;
  network->n_queue[0] = network->n_queue[1] = 0;
}

CeldStatus
celd_network_drain (CeldNetwork *network, const CeldRun *run)
{
  CeldStatus status = CELD_OK;
  size_t     steps = 1;

  network->lowest    = NONE;
  network->highest   = 0;
  network->n_reached = network->n_queue[0];
  memcpy (network->reached, network->queue[0], network->n_reached * sizeof *network->reached);
  for (network->depth = 1; network->n_queue[0] && status == CELD_OK; network->depth++)
    {
      uint32_t *grown = network->queue[0];

      for (size_t i = 0; i < network->n_queue[0] && status == CELD_OK; i++)
        {
          if (network->node[grown[i]].level == network->depth)
            grow (network, grown[i]);
          if (steps++ % 65536 == 0)
            status = celd_step (run, 0); /* how much is left to do cannot be told */
        }
      network->queue[0]   = network->queue[1];
      network->n_queue[0] = network->n_queue[1];
      network->queue[1]   = grown;
      network->n_queue[1] = 0;
    }
  take_down (network);
  return status;
}

/* ------------------------------------------------------------------ one cut */

CeldStatus
celd_flow (size_t n, const CeldLink *link, size_t n_links, const int64_t *terminal, const CeldRun *run, uint8_t *side,
           int64_t *flow)
{
  CeldNetwork network;
  CeldStatus  status = celd_network_new (n, link, n_links, &network);
  int64_t     sum = 0;

  if (status != CELD_OK)
    goto done;
  for (size_t p = 0; p < n; p++)
    {
      network.node[p].excess = terminal[p];
      if (terminal[p] <= 0)
        continue;
      sum += terminal[p];
      celd_network_root (&network, (uint32_t) p);
    }
  status = celd_network_drain (&network, run);
  if (status == CELD_OK)
    status = celd_step (run, 1);
  if (status != CELD_OK)
    goto done;
  for (size_t p = 0; p < n; p++)
    side[p] = 0;
  for (size_t i = 0; i < network.n_reached; i++)
    {
      side[network.reached[i]] = 1;
      if (network.node[network.reached[i]].excess > 0)
        sum -= network.node[network.reached[i]].excess;
    }
  if (flow)
    *flow = sum;

done:
  celd_network_clear (&network);
  return status;
}
