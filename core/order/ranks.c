/* Heights of an order kept up while relations are added to it (section 3.2, where the artist adds one after the other).
 *
 * One more relation lifts its nearer side to where it belongs, and whatever stands too low in front of that.  Classes
 * are lifted by rising old height: no relation leads from a higher one to a lower one, so each is lifted once, by as
 * much as it takes.  If that comes round to the farther side, the relation contradicts.  The heights are those that a
 * sort of all relations gives; where more than heights would change, the relation is refused, and that sort is due.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#define NO_ARC    UINT32_MAX
#define MOST_ARCS 8 /* by label and relation: where colours name many regions, relations are not kept apart */

void
celd_ranks_clear (CeldRanks *r)
{
  celd_classes_clear (&r->classes);
  celd_free (r->height);
  celd_free (r->old);
  celd_free (r->lifted);
  celd_free (r->behind);
  celd_free (r->first);
  celd_free (r->arc);
  celd_free (r->heap);
  celd_free (r->list);
  *r = (CeldRanks) { 0 };
}

/* ------------------------------------------------------------------ from an order */

static CeldStatus
add_arc (CeldRanks *r, uint32_t far, uint32_t near, double gap, bool counts)
{
  CeldArc *arcs = r->n_arcs < NO_ARC ? celd_grow (r->arc, r->n_arcs + 1, sizeof *arcs) : NULL;

  if (!arcs)
    return CELD_NO_MEMORY;
  r->arc = arcs;
  arcs[r->n_arcs] = (CeldArc) { near, r->first[far], gap, counts };
  r->first[far] = (uint32_t) r->n_arcs++;
  return CELD_OK;
}

/* Each farther end with each nearer end of a link; of an equality that was left out, each end with each, both ways. */
static CeldStatus
add_link (CeldRanks *r, const CeldGraph *g, size_t link, bool counts)
{
  const size_t *f = &g->first[2 * link];
  double        gap = link < g->relations->n ? celd_gap (g->relations->item[link].gap) : 1;
  CeldStatus    status = CELD_OK;

  for (size_t a = f[0]; a < f[g->equal[link] ? 2 : 1]; a++)
    for (size_t b = f[g->equal[link] ? 0 : 1]; b < f[2] && status == CELD_OK; b++)
      status = add_arc (r, g->end[a], g->end[b], gap, counts);
  return status;
}

static size_t
count_arcs (const CeldGraph *g)
{
  size_t n = 0;

  for (size_t i = 0; i < g->n_links; i++)
    n += (g->first[2 * i + 1] - g->first[2 * i]) * (g->first[2 * i + 2] - g->first[2 * i + 1]);
  return n;
}

static CeldStatus
copy_classes (CeldClasses *from, size_t n, CeldClasses *to)
{
  CeldStatus status = celd_classes_new (n, to);

  for (size_t k = 0; k < n && status == CELD_OK; k++)
    {
      to->parent[k] = from->parent[k];
      to->next[k]   = from->next[k];
    }
  return status;
}

CeldStatus
celd_ranks_new (const CeldGraph *g, const CeldOrder *order, CeldClasses *classes, const double *height, CeldRanks *r)
{
  size_t     n = g->n_labels, last = g->n_links - 1;
  CeldStatus status;

  *r = (CeldRanks) {
    .n = n, .knotted = order->n_knots > 0,
    .height = celd_alloc (n, sizeof (double)), .old = celd_alloc (n, sizeof (double)),
    .lifted = celd_alloc0 (n, sizeof (uint32_t)), .behind = celd_alloc (n, sizeof (bool)),
    .first = celd_alloc (n, sizeof (uint32_t)), .heap = celd_alloc (n, sizeof (uint32_t)),
    .list = celd_alloc (n, sizeof (uint32_t)),
  };
  status = r->height && r->old && r->lifted && r->behind && r->first && r->heap && r->list
         ? copy_classes (classes, n, &r->classes) : CELD_NO_MEMORY;
  for (size_t k = 0; k < n && status == CELD_OK; k++)
    {
      r->height[k] = height[k];
      r->behind[k] = g->kept[last];
      r->first[k]  = NO_ARC;
    }
  for (size_t e = g->first[2 * last + 1]; e < g->first[2 * last + 2] && status == CELD_OK; e++)
    r->behind[g->end[e]] = false;
  for (size_t i = 0; i < g->n_links && status == CELD_OK; i++)
    if (g->kept[i] && !g->equal[i])
      status = add_link (r, g, i, true);
  for (size_t k = 0; k < order->n_cycles && status == CELD_OK; k++)
    status = add_link (r, g, order->cycle[k].item[0], false);
  if (status != CELD_OK)
    celd_ranks_clear (r);
  return status;
}

bool
celd_ranks_suit (const CeldGraph *graph, const bool *visible)
{
  for (size_t k = 0; k < graph->n_labels; k++)
    if (!visible[k])
      return false;
  return count_arcs (graph) <= MOST_ARCS * (graph->n_labels + graph->n_links);
}

/* ------------------------------------------------------------------ lifting */

/* The lowest of old heights is heap[0]; none is above one of the two behind it. */
static void
push (CeldRanks *r, uint32_t class)
{
  size_t i = r->n_heap++;

  for (; i && r->old[r->heap[(i - 1) / 2]] > r->old[class]; i = (i - 1) / 2)
    r->heap[i] = r->heap[(i - 1) / 2];
  r->heap[i] = class;
}

static uint32_t
pop (CeldRanks *r)
{
  uint32_t top = r->heap[0], last = r->heap[--r->n_heap];
  size_t   i = 0, child;

  for (; (child = 2 * i + 1) < r->n_heap; i = child)
    {
      child += child + 1 < r->n_heap && r->old[r->heap[child + 1]] < r->old[r->heap[child]];
      if (r->old[r->heap[child]] >= r->old[last])
        break;
      r->heap[i] = r->heap[child];
    }
  r->heap[i] = last;
  return top;
}

static void
lift (CeldRanks *r, uint32_t class, double height)
{
  if (r->lifted[class] != r->number)
    {
      r->lifted[class] = r->number;
      r->old[class] = r->height[class];
      r->list[r->n_list++] = class;
      push (r, class);
    }
  r->height[class] = height;
}

/* Lifts what stands too low in front of a class; false if that is class `stop`. */
static bool
lift_nearer (CeldRanks *r, uint32_t class, uint32_t stop)
{
  uint32_t k = class;

  do
    {
      for (uint32_t j = r->first[k]; j != NO_ARC; j = r->arc[j].next)
        {
          uint32_t c = celd_class_of (&r->classes, r->arc[j].to);
          double   height = r->height[class] + r->arc[j].gap;

          if (!r->arc[j].counts || r->height[c] >= height)
            continue;
          if (c == stop)
            return false;
          lift (r, c, height);
        }
      k = r->classes.next[k];
    }
  while (k != class);
  return true;
}

/* Lifts a class and all that it takes; false, and nothing is lifted, if class `stop` would be. */
static bool
lift_all (CeldRanks *r, uint32_t class, double height, uint32_t stop)
{
  r->number++;
  r->n_heap = r->n_list = 0;
  if (r->height[class] >= height)
    return true;
  lift (r, class, height);
  while (r->n_heap)
    if (!lift_nearer (r, pop (r), stop))
      {
        for (size_t i = 0; i < r->n_list; i++)
          r->height[r->list[i]] = r->old[r->list[i]];
        return false;
      }
  return true;
}

/* ------------------------------------------------------------------ one more relation */

/* Do relations, those that were left out as well, lead from one class to another?  Then the relation would join a
 * knot, or make one. */
static bool
leads_to (CeldRanks *r, uint32_t from, uint32_t to)
{
  r->number++;
  r->n_list = 0;
  r->lifted[from] = r->number;
  r->list[r->n_list++] = from;
  for (size_t i = 0; i < r->n_list; i++)
    {
      uint32_t k = r->list[i];

      do
        {
          for (uint32_t j = r->first[k]; j != NO_ARC; j = r->arc[j].next)
            {
              uint32_t c = celd_class_of (&r->classes, r->arc[j].to);

              if (c == to)
                return true;
              if (r->lifted[c] != r->number)
                r->list[r->n_list++] = c;
              r->lifted[c] = r->number;
            }
          k = r->classes.next[k];
        }
      while (k != r->list[i]);
    }
  return false;
}

static bool
add_inequality (CeldRanks *r, uint32_t near, uint32_t far, double gap)
{
  uint32_t a = celd_class_of (&r->classes, near), b = celd_class_of (&r->classes, far);

  if (a == b || (r->behind[near] && !r->behind[far]) || (r->knotted && leads_to (r, a, b)) ||
      add_arc (r, far, near, gap, true) != CELD_OK)
    return false;
  return lift_all (r, a, r->height[b] + gap, b);
}

static bool
add_equality (CeldRanks *r, uint32_t near, uint32_t far)
{
  uint32_t a = celd_class_of (&r->classes, near), b = celd_class_of (&r->classes, far);
  uint32_t low = r->height[a] < r->height[b] ? a : b, high = low == a ? b : a, merged;
  double   height = r->height[high];

  r->n_list = 0;
  if (r->knotted) /* an equality with a label of a knot is in the knot */
    return false;
  if (a == b)
    return true;
  if (r->behind[near] != r->behind[far] || !lift_all (r, low, height, high))
    return false;
  celd_classes_join (&r->classes, a, b);
  merged = celd_class_of (&r->classes, a);
  r->height[merged] = height;
  for (size_t i = 0; i < r->n_list; i++)
    r->list[i] = celd_class_of (&r->classes, r->list[i]);
  return true;
}

bool
celd_ranks_add (CeldRanks *r, const CeldRelation *relation, uint32_t near, uint32_t far, CeldOrder *order)
{
  bool whole = !order->height;

  if (!(relation->equal ? add_equality (r, near - 1, far - 1)
                        : near != far && add_inequality (r, near - 1, far - 1, celd_gap (relation->gap))))
    return false;
  for (size_t i = 0; i < r->n_list; i++)
    whole = whole && r->height[r->list[i]] == (double) (uint32_t) r->height[r->list[i]];
  if (!whole)
    return !r->n_list || celd_levels_write (&r->classes, r->height, NULL, order) == CELD_OK;
  for (size_t i = 0; i < r->n_list; i++)
    {
      uint32_t level = (uint32_t) r->height[r->list[i]], k = r->list[i];

      do
        {
          order->level[k] = level;
          k = r->classes.next[k];
        }
      while (k != r->list[i]);
      order->levels = level >= order->levels ? level + 1 : order->levels;
    }
  return true;
}
