/* Which regions may hide which, and the order of the sheets from back to front.
 *
 * A region lies behind another if a chain of relations says so.  Regions that nobody compared may hide each other; in
 * which order their sheets then lie is decided by how much of each would be hidden.  Where only levels are known,
 * higher ones hide lower ones.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sheets/sheets.h"

#include <stdlib.h>

CeldStatus
celd_hiding_new (const CeldOrder *order, CeldHiding *hiding)
{
  const CeldOrderLinks *links = &order->links;

  *hiding = (CeldHiding) { .order = order };
  if (!links->n)
    return CELD_OK;
  hiding->graph = (CeldGraph) {
    .n_labels = order->n, .n_links = links->n, .n_ends = links->first[2 * links->n], .first = links->first,
    .end = links->end, .equal = links->equal,
  };
  return celd_graph_index (&hiding->graph, CELD_NEARER, NULL, &hiding->down);
}

void
celd_hiding_clear (CeldHiding *hiding)
{
  celd_arc_index_clear (&hiding->down);
  *hiding = (CeldHiding) { 0 };
}

static void
compare_levels (const CeldOrder *order, uint32_t label, uint8_t *standing)
{
  uint32_t level = order->level[label - 1];

  for (size_t l = 0; l < order->n; l++)
    standing[l] = order->level[l] > level ? CELD_HIDING : order->level[l] < level ? CELD_BEHIND : CELD_LEVEL;
}

/* Queues the labels on one side of a link that are not yet known to stand so. */
static size_t
enqueue (const CeldGraph *graph, size_t first, size_t last, CeldStanding as, uint8_t *standing, uint32_t *queue,
         size_t n)
{
  for (size_t e = first; e < last; e++)
    if (standing[graph->end[e]] == CELD_HIDING)
      {
        standing[graph->end[e]] = (uint8_t) as;
        queue[n++] = graph->end[e];
      }
  return n;
}

/* First all that are level with the label, then what is behind any of these. */
void
celd_hiding_of (const CeldHiding *hiding, uint32_t label, uint8_t *standing, uint32_t *queue)
{
  const CeldGraph *graph = &hiding->graph;
  size_t           n = 1;

  if (!graph->n_links)
    {
      compare_levels (hiding->order, label, standing);
      return;
    }
  memset (standing, CELD_HIDING, hiding->order->n);
  standing[label - 1] = CELD_LEVEL;
  queue[0] = label - 1;
  for (int pass = 0; pass < 2; pass++)
    for (size_t i = 0; i < n; i++)
      for (size_t a = hiding->down.first[queue[i]]; a < hiding->down.first[queue[i] + 1]; a++)
        {
          size_t        link = hiding->down.arc[a].link;
          const size_t *first = &graph->first[2 * link];

          if (graph->equal[link])
            n = enqueue (graph, first[0], first[2], standing[queue[i]], standing, queue, n);
          else if (pass == 1)
            n = enqueue (graph, first[0], first[1], CELD_BEHIND, standing, queue, n);
        }
}

/* ------------------------------------------------------------------ ranks */

typedef struct { uint32_t label, key; } Ranked;

static int
compare_ranked (const void *a, const void *b)
{
  const Ranked *one = a, *other = b;

  if (one->key != other->key)
    return one->key < other->key ? -1 : 1;
  return one->label < other->label ? -1 : one->label > other->label;
}

static int
compare_wishes (const void *a, const void *b)
{
  const CeldHidden *one = a, *other = b;

  if (one->area < other->area || one->area > other->area)
    return one->area > other->area ? -1 : 1;
  if (one->nearer != other->nearer)
    return one->nearer < other->nearer ? -1 : 1;
  return one->farther < other->farther ? -1 : one->farther > other->farther;
}

/* The links of the order and then one for each wish, between labels numbered by place[] instead of label - 1. */
static CeldStatus
graph_with_wishes (const CeldGraph *links, const uint32_t *place, const CeldHidden *wish, size_t n, CeldGraph *graph)
{
  size_t m = links->n_links, ends = links->n_ends;

  graph->n_links = m + n;
  graph->n_ends  = ends + 2 * n;
  graph->first   = celd_alloc (2 * (m + n) + 1, sizeof *graph->first);
  graph->end     = celd_alloc (ends + 2 * n, sizeof *graph->end);
  graph->equal   = celd_alloc0 (m + n, sizeof *graph->equal);
  if (!graph->first || !graph->end || !graph->equal)
    return CELD_NO_MEMORY;
  for (size_t e = 0; e < ends; e++)
    graph->end[e] = place[links->end[e]];
  for (size_t i = 0; i < m; i++)
    {
      graph->first[2 * i]     = links->first[2 * i];
      graph->first[2 * i + 1] = links->first[2 * i + 1];
      graph->equal[i]         = links->equal[i];
    }
  for (size_t i = 0; i < n; i++)
    {
      graph->first[2 * (m + i)]     = ends + 2 * i;
      graph->first[2 * (m + i) + 1] = ends + 2 * i + 1;
      graph->end[ends + 2 * i]      = place[wish[i].farther - 1];
      graph->end[ends + 2 * i + 1]  = place[wish[i].nearer - 1];
    }
  graph->first[2 * (m + n)] = ends + 2 * n;
  return CELD_OK;
}

/* Sorts the labels by their keys; place[label - 1] becomes the index of each. */
static void
sort_ranked (Ranked *list, size_t n, uint32_t *place)
{
  qsort (list, n, sizeof *list, compare_ranked);
  for (size_t i = 0; i < n; i++)
    place[list[i].label - 1] = (uint32_t) i;
}

CeldStatus
celd_hiding_rank (const CeldHiding *hiding, CeldHidden *wish, size_t n, uint32_t *rank)
{
  const CeldOrder     *order = hiding->order;
  CeldGraph            graph = { .n_labels = order->n };
  CeldIncrementalOrder sequence = { 0 };
  Ranked              *list = celd_alloc (order->n, sizeof *list);
  CeldStatus           status = list ? CELD_OK : CELD_NO_MEMORY;

  for (uint32_t l = 0; l < order->n && status == CELD_OK; l++)
    list[l] = (Ranked) { l + 1, order->level[l] };
  if (status == CELD_OK)
    {
      sort_ranked (list, order->n, rank);
      qsort (wish, n, sizeof *wish, compare_wishes);
      status = graph_with_wishes (&hiding->graph, rank, wish, n, &graph);
    }
  if (status == CELD_OK)
    status = celd_incremental_order_new (&graph, &sequence);
  for (size_t i = 0; i < graph.n_links && status == CELD_OK; i++)
    celd_incremental_order_admit (&sequence, i);
  if (status == CELD_OK)
    {
      for (size_t i = 0; i < order->n; i++)
        list[i].key = hiding->graph.n_links ? sequence.place[celd_class_of (&sequence.classes, (uint32_t) i)]
                                            : order->level[list[i].label - 1];
      sort_ranked (list, order->n, rank);
      for (size_t i = 1; i < order->n; i++)
        if (list[i].key == list[i - 1].key)
          rank[list[i].label - 1] = rank[list[i - 1].label - 1];
    }
  celd_incremental_order_clear (&sequence);
  celd_graph_clear (&graph);
  celd_free (list);
  return status;
}
