/* Depth order: topological sort of the regions (section 3.2 and appendix, [Kah62]) with longest-path heights.
 *
 * Equalities are contracted by union-find.  Then classes are placed from the farthest on, each when everything behind
 * it is placed, one level (or the relation's gap) in front of the nearest of those.  So every region is as far back as
 * the relations allow, heights do not depend on the order of choices, and two unrelated regions are both directly in
 * front of the background.  Of all heights >= 0 that satisfy the relations, these are the least for every region at
 * once, which also minimises every sum that increases with heights, such as the convex program of fractional gaps.
 * Linear time; conflicts.c has broken all cycles.
 *
 * Choices where the paper is silent: gaps are at most CELD_LARGEST_GAP.  If all gaps are whole numbers, heights are
 * levels; else levels number the different heights.  A label without a pixel (a colour that lost its region) still
 * transmits relations to others, but has no level of its own: it is on the level of what is behind it, so that there
 * are no gaps between visible levels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#include <stdlib.h>

#define SAME_HEIGHT 1e-9 /* levels; heights that differ by less are rounding errors of sums of gaps; chosen */

/* The classes of equal depth, and the state of the sort. */
typedef struct
{
  const CeldGraph *graph;
  CeldArcIndex     up;      /* links that lead up from a label */
  CeldEquivalence  classes;
  bool            *visible; /* of a class, at its root: has it a pixel? */
  double          *level;   /* of a class: its height; -1: not visible, and nothing visible behind it */
  size_t          *waits;   /* of a class: nearer ends in links that are not placed yet */
  size_t          *behind;  /* of a link: farther ends that are not placed yet */
  double          *height;  /* of a link: least height of a visible nearer end */
  uint32_t        *queue;   /* classes to place */
  size_t           n_queue;
} Sort;

static void
sort_end (Sort *s)
{
  celd_arc_index_clear (&s->up);
  celd_equivalence_clear (&s->classes);
  celd_free (s->visible);
  celd_free (s->level);
  celd_free (s->waits);
  celd_free (s->behind);
  celd_free (s->height);
  celd_free (s->queue);
}

static CeldStatus
sort_new (const CeldGraph *g, Sort *s)
{
  size_t     n = g->n_labels, m = g->n_links;
  CeldStatus status;

  *s = (Sort) {
    .graph = g,
    .visible = celd_alloc0 (n, sizeof (bool)), .level = celd_alloc (n, sizeof (double)),
    .waits = celd_alloc0 (n, sizeof (size_t)), .behind = celd_alloc0 (m, sizeof (size_t)),
    .height = celd_alloc0 (m, sizeof (double)), .queue = celd_alloc (n, sizeof (uint32_t)),
  };
  status = s->visible && s->level && s->waits && s->behind && s->height && s->queue
         ? celd_equivalence_new (n, &s->classes) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_graph_index (g, CELD_FARTHER, NULL, &s->up);
  if (status != CELD_OK)
    sort_end (s);
  return status;
}

static uint32_t
class_of (Sort *s, uint32_t k)
{
  return celd_class_of (&s->classes, k);
}

static void
contract_equalities (Sort *s)
{
  const CeldGraph *g = s->graph;

  for (size_t i = 0; i < g->n_links; i++)
    if (g->kept[i] && celd_graph_equal (g, i))
      for (size_t e = g->first[2 * i] + 1; e < g->first[2 * i + 2]; e++)
        celd_equivalence_join (&s->classes, g->end[e - 1], g->end[e]);
}

static void
mark_visible (Sort *s, const CeldLabels *labels)
{
  for (int y = 0; y < labels->height; y++)
    for (int x = 0; x < labels->width; x++)
      {
        uint32_t label = CELD_AT (labels, x, y);

        if (label >= 1 && label <= s->graph->n_labels)
          s->visible[label - 1] = true;
      }
  for (uint32_t k = 0; k < s->graph->n_labels; k++)
    if (s->visible[k])
      s->visible[class_of (s, k)] = true;
}

/* Counts the nearer ends and farther ends that classes and links wait for; queues classes that wait for none. */
static void
count_waits (Sort *s)
{
  const CeldGraph *g = s->graph;

  for (size_t i = 0; i < g->n_links; i++)
    if (g->kept[i] && !celd_graph_equal (g, i))
      {
        s->behind[i] = g->first[2 * i + 1] - g->first[2 * i];
        for (size_t e = g->first[2 * i + 1]; e < g->first[2 * i + 2]; e++)
          s->waits[class_of (s, g->end[e])]++;
      }
  for (uint32_t k = 0; k < g->n_labels; k++)
    {
      s->level[k] = s->visible[k] ? 0 : -1;
      if (class_of (s, k) == k && s->waits[k] == 0)
        s->queue[s->n_queue++] = k;
    }
}

/* The least difference in levels that a link demands. */
static double
gap_of (const CeldGraph *g, size_t link)
{
  return link < g->relations->n ? celd_gap (g->relations->item[link].gap) : 1;
}

/* Raises the nearer ends of a link whose farther ends are all placed, and queues those that wait for nothing else. */
static void
raise_nearer (Sort *s, size_t link)
{
  const CeldGraph *g = s->graph;

  for (size_t e = g->first[2 * link + 1]; e < g->first[2 * link + 2]; e++)
    {
      uint32_t c     = class_of (s, g->end[e]);
      double   level = s->height[link] - !s->visible[c];

      if (s->level[c] < level)
        s->level[c] = level;
      if (--s->waits[c] == 0)
        s->queue[s->n_queue++] = c;
    }
}

/* Places a class, whose level is known: updates all links that have one of its labels as a farther end. */
static void
place_class (Sort *s, uint32_t c)
{
  const CeldGraph *g = s->graph;
  uint32_t         k = c;

  do
    {
      for (size_t j = s->up.first[k]; j < s->up.first[k + 1]; j++)
        {
          size_t link   = s->up.arc[j].link;
          double height = s->level[c] + (s->visible[c] ? gap_of (g, link) : 1);

          if (!g->kept[link] || celd_graph_equal (g, link))
            continue;
          if (s->height[link] < height)
            s->height[link] = height;
          if (--s->behind[link] == 0)
            raise_nearer (s, link);
        }
      k = s->classes.next[k];
    }
  while (k != c);
}

static int
compare_heights (const void *one, const void *two)
{
  double a = *(const double *) one, b = *(const double *) two;

  return a < b ? -1 : a > b;
}

/* Lists 0 and the heights of visible labels, each once, sorted; returns their number.  `height` has room for all labels
 * and 0. */
static size_t
list_heights (Sort *s, double *height)
{
  size_t n = 1, kept = 1;

  height[0] = 0;
  for (uint32_t k = 0; k < s->graph->n_labels; k++)
    if (s->visible[k])
      height[n++] = s->level[class_of (s, k)];
  qsort (height, n, sizeof *height, compare_heights);
  for (size_t i = 1; i < n; i++)
    if (height[i] > height[kept - 1] + SAME_HEIGHT)
      height[kept++] = height[i];
  return kept;
}

/* The highest of `n` levels whose height is at most the wanted one. */
static uint32_t
find_level (const double *height, size_t n, double wanted)
{
  size_t low = 0, high = n;

  while (high - low > 1)
    {
      size_t middle = (low + high) / 2;

      if (height[middle] <= wanted + SAME_HEIGHT)
        low = middle;
      else
        high = middle;
    }
  return (uint32_t) low;
}

/* Fills in the levels of an order that has none. */
static CeldStatus
write_levels (Sort *s, CeldOrder *order)
{
  size_t    n = s->graph->n_labels, n_heights;
  double   *height = celd_alloc (n + 1, sizeof *height), top;
  uint32_t *level = celd_alloc (n, sizeof *level);
  bool      whole = true;

  if (!level || !height)
    {
      celd_free (height);
      celd_free (level);
      return CELD_NO_MEMORY;
    }
  n_heights = list_heights (s, height);
  top       = height[n_heights - 1];
  for (size_t i = 0; i < n_heights; i++)
    whole = whole && height[i] == floor (height[i]);
  for (uint32_t k = 0; k < n; k++)
    {
      double wanted = fmin (fmax (s->level[class_of (s, k)], 0), top);

      level[k] = whole ? (uint32_t) wanted : find_level (height, n_heights, wanted);
    }
  order->n      = n;
  order->level  = level;
  order->levels = whole ? (uint32_t) top + 1 : (uint32_t) n_heights;
  order->height = whole ? NULL : height;
  if (whole)
    celd_free (height);
  return CELD_OK;
}

static CeldStatus
sort_levels (const CeldGraph *graph, const CeldLabels *labels, CeldOrder *order)
{
  Sort       sort;
  CeldStatus status = sort_new (graph, &sort);

  if (status != CELD_OK)
    return status;
  contract_equalities (&sort);
  mark_visible (&sort, labels);
  count_waits (&sort);
  for (size_t i = 0; i < sort.n_queue; i++)
    place_class (&sort, sort.queue[i]);
  status = write_levels (&sort, order);
  sort_end (&sort);
  return status;
}

/* Copies the links that are kept. */
static CeldStatus
copy_links (const CeldGraph *g, CeldOrderLinks *links)
{
  size_t n = 0;

  links->first = celd_alloc (2 * g->n_links + 1, sizeof *links->first);
  links->end   = celd_alloc (g->n_ends, sizeof *links->end);
  links->equal = celd_alloc (g->n_links, sizeof *links->equal);
  if (!links->first || !links->end || !links->equal)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < g->n_links; i++)
    if (g->kept[i])
      {
        const size_t *f = &g->first[2 * i];

        links->equal[links->n]         = celd_graph_equal (g, i);
        links->first[2 * links->n]     = n;
        links->first[2 * links->n + 1] = n + f[1] - f[0];
        for (size_t e = f[0]; e < f[2]; e++)
          links->end[n++] = g->end[e];
        links->n++;
      }
  links->first[2 * links->n] = n;
  return CELD_OK;
}

/* One problem for each relation that was left out. */
static CeldStatus
report_cycles (const CeldOrder *order, const CeldLabels *labels, const CeldPalette *palette,
               const CeldRelations *relations, CeldProblems *problems)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < order->n_cycles && status == CELD_OK; i++)
    {
      size_t      left    = order->cycle[i].item[0];
      CeldProblem problem = { .kind = CELD_PROBLEM_CONTRADICTION, .other = (uint32_t) i, .relation = left };

      celd_relation_place (labels, palette, &relations->item[left], &problem.x, &problem.y);
      status = celd_problem_add (problems, problem);
    }
  return status;
}

CeldStatus
celd_order (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
            const CeldPlane *ink, const CeldSettings *settings, const CeldHost *host, CeldOrder *order,
            CeldProblems *problems)
{
  CeldGraph  graph  = { 0 };
  CeldOrder  made   = { 0 };
  size_t     before = problems ? problems->n : 0;
  CeldStatus status;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  status = celd_graph_new (labels, palette, relations, ink, &graph, problems);
  if (status == CELD_OK)
    status = celd_graph_resolve (&graph, settings ? settings->on_cycle : CELD_ON_CYCLE_REPORT, host, &made);
  if (status == CELD_OK)
    status = sort_levels (&graph, labels, &made);
  if (status == CELD_OK)
    status = copy_links (&graph, &made.links);
  if (status == CELD_OK)
    status = celd_cycles_explain (labels, palette, ink, &graph, &made);
  if (status == CELD_OK)
    status = report_cycles (&made, labels, palette, relations, problems);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  celd_graph_clear (&graph);
  if (status != CELD_OK)
    {
      celd_order_clear (&made);
      if (problems)
        problems->n = before;
      return status;
    }
  celd_order_clear (order);
  *order = made;
  return CELD_OK;
}

float
celd_encode_level (double level, double levels, const CeldSettings *settings)
{
  double far = (double) settings->far_level, range = (double) settings->near_level - far;

  switch (settings->encoding)
    {
    case CELD_ENCODING_RANK:  return (float) level;
    case CELD_ENCODING_FIXED: return range > 0 ? (float) ((level - far) / range) : 0;
    default:                  return levels > 1 ? (float) (level / (levels - 1)) : 0;
    }
}

float
celd_order_value (const CeldOrder *order, uint32_t level, const CeldSettings *settings)
{
  return order->height ? celd_encode_level (order->height[level], order->height[order->levels - 1] + 1, settings)
                       : celd_encode_level (level, order->levels, settings);
}
