/* Which relations can hold together (section 3.2: a consistent order exists if there is no directed cycle), and the
 * cycles of those that cannot.
 *
 * Only relations inside a strongly connected component can contradict others.  They are added to an incremental order
 * by falling weight, then in the order given.  A relation is left out if those added before it already lead from its
 * farther to its nearer side; an equality, if they lead through an inequality from one of its labels to another.  The
 * shortest such path with the relation itself is the cycle that is reported, including the equalities on it.  This
 * greedy choice does not minimise the total weight left out, but is predictable: a heavier arrow never yields to
 * lighter ones.  For the least total weight, feedback-arc-set.c chooses which relations are added last.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "order/order.h"

#include <stdlib.h>
#include <string.h>

#define BETWEEN_REPORTS 256 /* relations between two reports of progress; chosen */

/* A relation to be added: by rising round, then by falling weight, then in the order given. */
typedef struct { int round; double weight; size_t relation; } Trial;

/* Appends the cycle that the last search has found. */
static CeldStatus
add_cycle (const CeldCycleSearch *s, size_t scc, CeldOrder *order)
{
  CeldCycle  cycle = { 0 };
  CeldStatus status = celd_cycle_search_cycle (s, &cycle);

  cycle.scc = scc;
  if (status != CELD_OK)
    return status;
  status = celd_append_uncounted (order->cycle, order->n_cycles, cycle);
  if (status != CELD_OK)
    celd_free (cycle.item);
  return status;
}

/* The background goes behind every label that it is neither in front of nor equal to.  With several background labels
 * (separate regions of its colour), those behind one of them are left as they are, so that no cycle can close. */
static CeldStatus
complete_background (CeldGraph *g, CeldCycleSearch *s)
{
  size_t      *f = &g->first[2 * (g->n_links - 1)];
  CeldArcIndex down;
  CeldStatus   status;

  if (f[0] == f[1])
    return CELD_OK;
  status = celd_graph_index (g, CELD_NEARER, g->kept, &down);
  if (status != CELD_OK)
    return status;
  s->arcs[CELD_FARTHER] = celd_arc_index_view (&down);
  celd_cycle_search_behind (s, f[0], f[1]);
  celd_arc_index_clear (&down);
  for (size_t k = 0; k < g->n_labels && status == CELD_OK; k++)
    if (!celd_cycle_search_was_at (s, k))
      status = celd_graph_add (g, (uint32_t) k + 1);
  f[2] = g->n_ends;
  g->kept[g->n_links - 1] = true;
  return status;
}

static int
compare_trials (const void *one, const void *two)
{
  const Trial *a = one, *b = two;

  if (a->round != b->round)
    return a->round < b->round ? -1 : 1;
  if (a->weight != b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

/* Lists all relations of strongly connected components in the order in which they are added, and marks them as not
 * kept. */
static size_t
list_trials (CeldGraph *g, const CeldSccs *sccs, Trial *trials)
{
  size_t n = 0;

  for (size_t i = 0; i < g->relations->n; i++)
    if (g->kept[i] && sccs->link[i])
      {
        double weight = g->relations->item[i].weight;

        g->kept[i] = false;
        trials[n++] = (Trial) { 0, weight > 0 ? weight : 0, i }; /* NaN cannot be sorted */
      }
  qsort (trials, n, sizeof *trials, compare_trials);
  return n;
}

static bool
is_suggestion (const CeldGraph *g, size_t link)
{
  return g->relations->item[link].source == CELD_SOURCE_SUGGESTION;
}

/* Marks a set of the least total weight whose removal breaks all cycles.  Nothing is marked in components that are too
 * large for that; their relations are added by weight alone. */
static CeldStatus
find_lightest (const CeldGraph *g, const CeldSccs *sccs, const CeldScc *scc, const CeldHost *host, bool *broken)
{
  CeldStatus status = CELD_OK;

  for (size_t k = 0; k < sccs->n && status == CELD_OK; k++)
    {
      status = celd_feedback_arc_set (g, sccs, &scc[k], (uint32_t) k + 1, broken);
      if (status == CELD_OK)
        status = celd_progress (host, (double) (k + 1) / (double) sccs->n);
    }
  return status;
}

/* Puts the relations that are best left out behind the others, and suggestions last. */
static CeldStatus
postpone (CeldGraph *g, const CeldSccs *sccs, const CeldHost *host, const CeldScc *scc, Trial *trials, size_t n)
{
  bool      *broken = celd_alloc0 (g->n_links, sizeof *broken);
  CeldStatus status = broken ? find_lightest (g, sccs, scc, host, broken) : CELD_NO_MEMORY;

  for (size_t t = 0; t < n && status == CELD_OK; t++)
    trials[t].round = is_suggestion (g, trials[t].relation) ? 2 : broken[trials[t].relation];
  if (status == CELD_OK)
    qsort (trials, n, sizeof *trials, compare_trials);
  celd_free (broken);
  return status;
}

/* Keeps each relation that does not contradict those kept before it; a cycle for each of the others. */
static CeldStatus
add_all (CeldGraph *g, const CeldSccs *sccs, const Trial *trials, size_t n, const CeldHost *host,
         CeldCycleSearch *search, CeldOrder *order)
{
  CeldIncrementalOrder sequence;
  CeldStatus           status = celd_incremental_order_new (g, &sequence);

  search->sequence = &sequence;
  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    search->arcs[to] = celd_incremental_order_arcs (&sequence, (CeldSide) to);
  for (size_t t = 0; t < n && status == CELD_OK; t++)
    {
      size_t i = trials[t].relation;

      g->kept[i] = celd_incremental_order_admit (&sequence, i);
      if (!g->kept[i] && celd_cycle_search_contradiction (search, i))
        status = add_cycle (search, sccs->link[i] - 1, order);
      if (status == CELD_OK && t % BETWEEN_REPORTS == 0)
        status = celd_progress (host, (double) t / (double) n);
    }
  search->sequence = NULL;
  celd_incremental_order_clear (&sequence);
  return status;
}

/* Makes the kept relations consistent. */
static CeldStatus
break_cycles (CeldGraph *g, const CeldSccs *sccs, CeldOnCycle on_cycle, const CeldHost *host,
             CeldCycleSearch *search, CeldOrder *order)
{
  CeldHostPart part[2];
  CeldHost     choose = celd_host_part (&part[0], host, 0, 0.5);
  CeldHost     add = celd_host_part (&part[1], host, on_cycle == CELD_ON_CYCLE_REPORT ? 0 : 0.5, 1);
  Trial       *trials = celd_alloc (g->n_links, sizeof *trials);
  size_t       n = trials ? list_trials (g, sccs, trials) : 0;
  CeldStatus   status = trials ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && on_cycle != CELD_ON_CYCLE_REPORT)
    status = postpone (g, sccs, &choose, order->scc, trials, n);
  if (status == CELD_OK)
    status = add_all (g, sccs, trials, n, &add, search, order);
  celd_free (trials);
  return status;
}

/* The shortest cycle through the newest relation of a component that lies on one. */
static CeldStatus
find_newest_cycle (CeldCycleSearch *s, CeldScc *scc)
{
  CeldStatus status = CELD_OK;

  for (size_t k = scc->n; k-- > 0 && !scc->newest.n && status == CELD_OK; )
    {
      s->except = scc->item[k];
      if (celd_cycle_search_contradiction (s, scc->item[k]) && celd_cycle_search_is_simple (s))
        status = celd_cycle_search_cycle (s, &scc->newest);
    }
  s->except = CELD_NO_INDEX;
  return status;
}

/* Finds the newest cycle of every component.  One index serves all, because no cycle passes two of them. */
static CeldStatus
find_newest_cycles (CeldCycleSearch *s, const bool *use, CeldOrder *order)
{
  CeldArcIndex index[2] = { { 0 } };
  CeldStatus   status = celd_graph_index (s->graph, CELD_NEARER, use, &index[CELD_FARTHER]);

  if (status == CELD_OK)
    status = celd_graph_index (s->graph, CELD_FARTHER, use, &index[CELD_NEARER]);
  for (int to = CELD_FARTHER; to <= CELD_NEARER && status == CELD_OK; to++)
    s->arcs[to] = celd_arc_index_view (&index[to]);
  for (size_t k = 0; k < order->n_sccs && status == CELD_OK; k++)
    status = find_newest_cycle (s, &order->scc[k]);
  celd_arc_index_clear (&index[CELD_FARTHER]);
  celd_arc_index_clear (&index[CELD_NEARER]);
  return status;
}

/* Lists the relations of each strongly connected component, and its newest cycle. */
static CeldStatus
describe_sccs (CeldCycleSearch *s, const CeldSccs *sccs, CeldOrder *order)
{
  size_t     n_links = s->graph->n_links;
  bool      *use = celd_alloc0 (n_links, sizeof *use);
  CeldStatus status = use ? CELD_OK : CELD_NO_MEMORY;

  order->scc = celd_alloc0 (sccs->n, sizeof *order->scc);
  order->n_sccs = order->scc ? sccs->n : 0;
  if (!order->scc)
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < n_links && status == CELD_OK; i++)
    if (sccs->link[i])
      {
        CeldScc *scc = &order->scc[sccs->link[i] - 1];

        status = celd_append_uncounted (scc->item, scc->n, i);
        use[i] = status == CELD_OK;
      }
  if (status == CELD_OK)
    status = find_newest_cycles (s, use, order);
  celd_free (use);
  return status;
}

CeldStatus
celd_graph_resolve (CeldGraph *g, CeldOnCycle on_cycle, const CeldHost *host, CeldOrder *order)
{
  CeldCycleSearch search;
  CeldSccs        sccs = { 0 };
  CeldStatus      status = celd_cycle_search_new (g, &search);

  if (status == CELD_OK)
    status = celd_sccs_find (g, &sccs);
  if (status == CELD_OK && sccs.n)
    status = describe_sccs (&search, &sccs, order);
  if (status == CELD_OK && sccs.n)
    status = break_cycles (g, &sccs, on_cycle, host, &search, order);
  if (status == CELD_OK)
    status = complete_background (g, &search);
  celd_sccs_clear (&sccs);
  celd_cycle_search_clear (&search);
  return status;
}

/* ------------------------------------------------------------------ cycles because of one depth for a colour */

typedef struct
{
  const CeldLabels *labels;
  const CeldPlane  *ink;        /* may be NULL */
  const CeldGraph  *graph;
  CeldLabels        component;  /* of labels; data NULL: not found yet */
  int               stroke;     /* width in pixels; 0: not measured yet */
} LabelledPicture;

/* One end of a relation: its label, and a pixel of that label. */
typedef struct { uint32_t label; int x, y; } Place;

/* Where a relation ends; false if it names a colour or lies on ink that is far from paper of the label. */
static bool
find_place (LabelledPicture *picture, size_t link, CeldSide side, Place *place)
{
  if (!celd_graph_point (picture->graph, link, side, &place->label, &place->x, &place->y))
    return false;
  if (CELD_AT (picture->labels, place->x, place->y) != place->label && picture->ink)
    {
      if (!picture->stroke)
        picture->stroke = celd_stroke_width (picture->ink);
      celd_paper_near (picture->ink, picture->stroke, &place->x, &place->y);
    }
  return CELD_AT (picture->labels, place->x, place->y) == place->label;
}

static CeldStatus
find_components (LabelledPicture *picture)
{
  CeldComponent *list = NULL;
  size_t         n;
  CeldStatus     status = celd_labels_new (picture->labels->width, picture->labels->height, &picture->component);

  if (status == CELD_OK)
    status = celd_components (picture->labels, UINT32_MAX, false, NULL, &picture->component, &list, &n);
  celd_free (list);
  return status;
}

/* Sets the label and the points of `cycle` if consecutive relations i and j meet in two components of one label: then
 * the cycle exists only because both have one depth, which the artist may not have meant. */
static CeldStatus
compare_components (LabelledPicture *picture, size_t i, size_t j, CeldCycle *cycle)
{
  const CeldGraph *g = picture->graph;
  CeldStatus       status = CELD_OK;

  for (int from = CELD_FARTHER; from <= (celd_graph_equal (g, i) ? CELD_NEARER : CELD_FARTHER); from++)
    for (int to = celd_graph_equal (g, j) ? CELD_FARTHER : CELD_NEARER; to <= CELD_NEARER; to++)
      {
        Place a, b;

        if (status != CELD_OK || cycle->label || !find_place (picture, i, (CeldSide) from, &a) ||
            !find_place (picture, j, (CeldSide) to, &b) || a.label != b.label || (a.x == b.x && a.y == b.y))
          continue;
        if (!picture->component.data)
          status = find_components (picture);
        if (status != CELD_OK ||
            CELD_AT (&picture->component, a.x, a.y) == CELD_AT (&picture->component, b.x, b.y))
          continue;
        cycle->label = a.label;
        cycle->x[0] = a.x;
        cycle->y[0] = a.y;
        cycle->x[1] = b.x;
        cycle->y[1] = b.y;
      }
  return status;
}

CeldStatus
celd_cycles_explain (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                     const CeldGraph *graph, CeldOrder *order)
{
  LabelledPicture picture = { .labels = labels, .ink = ink, .graph = graph };
  CeldStatus      status = CELD_OK;

  for (size_t k = 0; k < order->n_cycles && status == CELD_OK; k++)
    {
      CeldCycle *cycle = &order->cycle[k];

      for (size_t i = 0; i < cycle->n && status == CELD_OK; i++)
        status = compare_components (&picture, cycle->item[i], cycle->item[(i + 1) % cycle->n], cycle);
      if (cycle->label)
        memcpy (cycle->colour, palette->item[cycle->label - 1].colour, sizeof cycle->colour);
    }
  celd_free (picture.component.data);
  return status;
}
