/* Suggestions beside the artist's relations.
 *
 * All of them are settled together, as contradictions are for an order (conflicts.c), with suggestions lighter than
 * anything of the artist's: those that are not kept are left out without a word.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#include <math.h>
#include <string.h>

/* Walks from nearer to farther labels over the first `n_own` links, which are the artist's. */
typedef struct
{
  const CeldGraph *graph;
  size_t           n_own;
  CeldArcIndex        down;
  uint32_t        *queue;
  size_t          *seen, number;
} Walk;

static CeldStatus
walk_new (const CeldGraph *graph, size_t n_own, Walk *w)
{
  *w = (Walk) { .graph = graph, .n_own = n_own, .queue = celd_alloc (graph->n_labels, sizeof *w->queue),
                .seen = celd_alloc0 (graph->n_labels, sizeof *w->seen) };
  return w->queue && w->seen ? celd_graph_index (graph, CELD_NEARER, NULL, &w->down) : CELD_NO_MEMORY;
}

static void
walk_clear (Walk *w)
{
  celd_free (w->queue);
  celd_free (w->seen);
  celd_arc_index_clear (&w->down);
}

static size_t
visit (Walk *w, size_t n, uint32_t label)
{
  if (w->seen[label] == w->number)
    return n;
  w->seen[label] = w->number;
  w->queue[n]    = label;
  return n + 1;
}

/* Do the artist's relations put the farther label of a link behind its nearer one? */
static bool
is_decided (Walk *w, size_t link)
{
  const CeldGraph *g = w->graph;
  size_t           n;

  w->number++;
  n = visit (w, 0, g->end[g->first[2 * link + 1]]);
  for (size_t i = 0; i < n; i++)
    for (size_t j = w->down.first[w->queue[i]]; j < w->down.first[w->queue[i] + 1]; j++)
      {
        size_t        l = w->down.arc[j].link;
        const size_t *f = &g->first[2 * l];

        if (l >= w->n_own || !g->kept[l])
          continue;
        for (size_t e = f[0]; e < (celd_graph_equal (g, l) ? f[2] : f[1]); e++)
          n = visit (w, n, g->end[e]);
      }
  return w->seen[g->end[g->first[2 * link]]] == w->number;
}

/* One list, suggestions last and lighter than the artist's lightest. */
static CeldStatus
list_all (const CeldRelations *relations, const CeldRelations *suggested, CeldRelations *all)
{
  CeldStatus status = CELD_OK;
  double     least = 1;

  for (size_t i = 0; i < relations->n && status == CELD_OK; i++)
    {
      status = celd_relation_add (all, relations->item[i]);
      if (relations->item[i].weight > 0)
        least = fmin (least, relations->item[i].weight);
    }
  for (size_t i = 0; i < suggested->n && status == CELD_OK; i++)
    {
      status = celd_relation_add (all, suggested->item[i]);
      if (status == CELD_OK)
        all->item[all->n - 1].weight *= least;
    }
  return status;
}

/* Keeps of the suggestions in `all` those that the settled graph keeps. */
static CeldStatus
select_kept (const CeldGraph *graph, size_t n_own, CeldSuggest suggest, CeldRelations *all)
{
  Walk       walk = { 0 };
  size_t     n = n_own;
  CeldStatus status = walk_new (graph, n_own, &walk);

  for (size_t i = n_own; i < all->n && status == CELD_OK; i++)
    if (graph->kept[i] && (suggest == CELD_SUGGEST_ALL || !is_decided (&walk, i)))
      all->item[n++] = all->item[i];
  walk_clear (&walk);
  if (status == CELD_OK)
    all->n = n;
  return status;
}

CeldStatus
celd_suggestions_join (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                       const CeldRelations *suggested, const CeldSettings *settings, const CeldPlane *ink,
                       const CeldHost *host, CeldRelations *both)
{
  static const CeldRelations none = { 0 };

  CeldRelations all = { 0 };
  CeldGraph     graph = { 0 };
  CeldOrder     order = { 0 };
  CeldStatus    status;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  status = list_all (relations, settings->suggest == CELD_SUGGEST_OFF ? &none : suggested, &all);
  if (status == CELD_OK && all.n > relations->n)
    {
      status = celd_graph_new (labels, palette, &all, ink, &graph, NULL);
      if (status == CELD_OK)
        status = celd_graph_resolve (&graph, settings->on_cycle, host, &order);
      if (status == CELD_OK)
        status = select_kept (&graph, relations->n, settings->suggest, &all);
    }
  if (status == CELD_OK)
    {
      celd_relations_clear (both);
      *both = all;
    }
  else
    celd_relations_clear (&all);
  celd_graph_clear (&graph);
  celd_order_clear (&order);
  return status;
}
