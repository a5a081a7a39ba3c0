/* Strongly connected components [Tar72] of the graph whose nodes are labels and, alternating with them, links:
 * relations that lie on common cycles.
 *
 * Edges lead from a label to the links that have it on their nearer side, and from a link to its farther labels; for an
 * equality in both directions.  Only components with an inequality are listed, because not all of their relations can
 * hold.  All other relations can, whatever is kept of those.  Linear time.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

/* Node k < n_labels is label k + 1, node n_labels + i is link i. */
typedef struct
{
  const CeldGraph *graph;
  CeldArcIndex     down;
  uint32_t        *number;       /* in the order in which nodes are found, from 1; 0: not yet */
  uint32_t        *low;          /* the least number that is known to be reached from a node */
  size_t          *cursor;       /* of a node: the next step from it */
  bool            *open;         /* is its component not complete yet? */
  uint32_t        *path, *stack; /* from the start to the node at hand; nodes whose component is not complete */
  size_t           n_path, n_stack, found;
} SccWalk;

static void
walk_end (SccWalk *w)
{
  celd_arc_index_clear (&w->down);
  celd_free (w->number);
  celd_free (w->low);
  celd_free (w->cursor);
  celd_free (w->open);
  celd_free (w->path);
  celd_free (w->stack);
}

static CeldStatus
walk_new (const CeldGraph *g, SccWalk *w)
{
  size_t n = g->n_labels + g->n_links;

  *w = (SccWalk) {
    .graph = g,
    .number = celd_alloc0 (n, sizeof (uint32_t)), .low = celd_alloc (n, sizeof (uint32_t)),
    .cursor = celd_alloc (n, sizeof (size_t)), .open = celd_alloc0 (n, sizeof (bool)),
    .path = celd_alloc (n, sizeof (uint32_t)), .stack = celd_alloc (n, sizeof (uint32_t)),
  };
  return w->number && w->low && w->cursor && w->open && w->path && w->stack
       ? celd_graph_index (g, CELD_NEARER, NULL, &w->down) : CELD_NO_MEMORY;
}

/* The nodes that steps from a node lead to: where they begin and end in down.link or in graph->end. */
static void
steps_from (const SccWalk *w, size_t node, size_t *first, size_t *last)
{
  const CeldGraph *g = w->graph;

  if (node < g->n_labels)
    {
      *first = w->down.first[node];
      *last  = w->down.first[node + 1];
    }
  else
    {
      size_t link = node - g->n_labels;

      *first = g->first[2 * link];
      *last  = g->first[2 * link + (celd_graph_equal (g, link) ? 2 : 1)];
    }
}

static void
enter (SccWalk *w, size_t node)
{
  size_t last;

  w->number[node] = w->low[node] = (uint32_t) ++w->found;
  steps_from (w, node, &w->cursor[node], &last);
  w->open[node] = true;
  w->stack[w->n_stack++] = (uint32_t) node;
  w->path[w->n_path++]   = (uint32_t) node;
}

/* All that lies on the stack from the node on is one component: gives it the next number if there is an inequality
 * in it. */
static void
close_component (SccWalk *w, size_t node, CeldSccs *sccs)
{
  const CeldGraph *g = w->graph;
  size_t           from = w->n_stack;
  bool             strict = false;

  do
    {
      size_t top = w->stack[--from];

      w->open[top] = false;
      strict |= top >= g->n_labels && !celd_graph_equal (g, top - g->n_labels);
    }
  while (w->stack[from] != node);
  if (strict && w->n_stack - from > 1)
    {
      sccs->n++;
      for (size_t i = from; i < w->n_stack; i++)
        if (w->stack[i] < g->n_labels)
          sccs->label[w->stack[i]] = (uint32_t) sccs->n;
        else
          sccs->link[w->stack[i] - g->n_labels] = (uint32_t) sccs->n;
    }
  w->n_stack = from;
}

/* Goes on with the node at the end of the path: one step, or back. */
static void
go_on (SccWalk *w, CeldSccs *sccs)
{
  const CeldGraph *g = w->graph;
  size_t           node = w->path[w->n_path - 1], first, last;

  steps_from (w, node, &first, &last);
  if (w->cursor[node] < last)
    {
      size_t step = w->cursor[node]++;
      size_t next = node < g->n_labels ? g->n_labels + w->down.arc[step].link : g->end[step];

      if (next >= g->n_labels && !g->kept[next - g->n_labels])
        return;
      if (!w->number[next])
        enter (w, next);
      else if (w->open[next] && w->number[next] < w->low[node])
        w->low[node] = w->number[next];
      return;
    }
  if (w->low[node] == w->number[node])
    close_component (w, node, sccs);
  if (--w->n_path && w->low[node] < w->low[w->path[w->n_path - 1]])
    w->low[w->path[w->n_path - 1]] = w->low[node];
}

/* Numbers the components by their first relation. */
static CeldStatus
renumber (const CeldGraph *g, CeldSccs *sccs)
{
  uint32_t *number = celd_alloc0 (sccs->n + 1, sizeof *number), n = 0;

  if (!number)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < g->n_links; i++)
    if (sccs->link[i] && !number[sccs->link[i]])
      number[sccs->link[i]] = ++n;
  for (size_t i = 0; i < g->n_links; i++)
    sccs->link[i] = number[sccs->link[i]];
  for (size_t k = 0; k < g->n_labels; k++)
    sccs->label[k] = number[sccs->label[k]];
  celd_free (number);
  return CELD_OK;
}

void
celd_sccs_clear (CeldSccs *sccs)
{
  celd_free (sccs->label);
  celd_free (sccs->link);
  *sccs = (CeldSccs) { 0 };
}

CeldStatus
celd_sccs_find (const CeldGraph *graph, CeldSccs *sccs)
{
  SccWalk    walk;
  CeldStatus status = walk_new (graph, &walk);

  *sccs = (CeldSccs) { celd_alloc0 (graph->n_labels, sizeof (uint32_t)),
                         celd_alloc0 (graph->n_links, sizeof (uint32_t)), 0 };
  if (!sccs->label || !sccs->link)
    status = CELD_NO_MEMORY;
  for (size_t k = 0; k < graph->n_labels && status == CELD_OK; k++)
    if (!walk.number[k])
      for (enter (&walk, k); walk.n_path; )
        go_on (&walk, sccs);
  if (status == CELD_OK)
    status = renumber (graph, sccs);
  walk_end (&walk);
  if (status != CELD_OK)
    celd_sccs_clear (sccs);
  return status;
}
