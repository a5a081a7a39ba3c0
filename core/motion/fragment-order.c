/* The order of the regions of several drawings.
 *
 * Nodes are the regions of all drawings.  Admitted to an incremental order are, one after the other:
 *   1. the relations that hold in each drawing, or where only its levels are known, each level in front of the one
 *      below;
 *   2. the relations between drawings, by falling weight and then in the order given; one that contradicts those before
 *      it is left out and reported with a shortest cycle;
 *   3. a wish for each two regions of different drawings that overlap, the largest overlap first: the later drawing is
 *      in front.  It is dropped if it contradicts anything.
 * Before that nodes are in the order of drawings and of their layers, of which an incremental order changes as little
 * as it has to, so that the layers of a drawing that nothing goes between stay in their order.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/compose.h"

#include <stdlib.h>

typedef struct
{
  CeldFragmentGraph     regions;
  CeldComposition      *composition;
  CeldIncrementalOrder  sequence;
  uint32_t             *height;      /* of each class */
} FragmentSort;

/* ------------------------------------------------------------------ one after the other */

typedef struct { double weight; size_t relation; } RelationTrial;

static int
compare_trials (const void *one, const void *two)
{
  const RelationTrial *a = one, *b = two;

  if (a->weight < b->weight || a->weight > b->weight)
    return a->weight > b->weight ? -1 : 1;
  return a->relation < b->relation ? -1 : 1;
}

/* Keeps of the cycle of a relation that is left out those between drawings. */
static CeldStatus
report (FragmentSort *s, const CeldCycleSearch *search, CeldProblems *problems)
{
  CeldComposition *c = s->composition;
  CeldCycle        cycle = { 0 };
  CeldProblem      problem = { .kind = CELD_PROBLEM_CONTRADICTION, .x = -1, .y = -1, .relation = search->relation,
                               .other = (uint32_t) c->n_cycles };
  size_t           n = 0;
  CeldStatus       status = celd_cycle_search_cycle (search, &cycle);

  if (status != CELD_OK)
    return status;
  for (size_t i = 0; i < cycle.n; i++)
    if (cycle.item[i] < s->regions.n_relations)
      cycle.item[n++] = cycle.item[i];
  cycle.n = n;
  status = celd_append_uncounted (c->cycle, c->n_cycles, cycle);
  if (status != CELD_OK)
    celd_free (cycle.item);
  return status == CELD_OK ? celd_problem_add (problems, problem) : status;
}

static CeldStatus
admit_relations (FragmentSort *s, CeldCycleSearch *search, CeldProblems *problems)
{
  RelationTrial     *trial = celd_alloc (s->regions.n_relations, sizeof *trial);
  size_t     n = 0;
  CeldStatus status = trial ? CELD_OK : CELD_NO_MEMORY;

  for (size_t i = 0; i < s->regions.n_relations && status == CELD_OK; i++)
    if (s->regions.graph.first[2 * i] < s->regions.graph.first[2 * i + 2])
      {
        double weight = s->regions.relations->item[i].weight;

        trial[n++] = (RelationTrial) { weight > 0 ? weight : 0, i }; /* NaN cannot be sorted */
      }
  if (n)
    qsort (trial, n, sizeof *trial, compare_trials);
  for (size_t t = 0; t < n && status == CELD_OK; t++)
    if (!celd_incremental_order_admit (&s->sequence, trial[t].relation) &&
        celd_cycle_search_contradiction (search, trial[t].relation))
      status = report (s, search, problems);
  celd_free (trial);
  return status;
}

static CeldStatus
admit_all (FragmentSort *s, CeldProblems *problems)
{
  CeldCycleSearch search = { 0 };
  CeldStatus      status = celd_incremental_order_new (&s->regions.graph, &s->sequence);

  if (status == CELD_OK)
    status = celd_cycle_search_new (&s->regions.graph, &search);
  search.sequence = &s->sequence;
  for (int to = CELD_FARTHER; to <= CELD_NEARER; to++)
    search.arcs[to] = celd_incremental_order_arcs (&s->sequence, (CeldSide) to);
  for (size_t i = 0; i < s->regions.n_own && status == CELD_OK; i++)
    celd_incremental_order_admit (&s->sequence, s->regions.n_relations + i);
  if (status == CELD_OK)
    status = admit_relations (s, &search, problems);
  for (size_t i = s->regions.n_relations + s->regions.n_own; i < s->regions.graph.n_links && status == CELD_OK; i++)
    celd_incremental_order_admit (&s->sequence, i);
  celd_cycle_search_clear (&search);
  return status;
}

/* ------------------------------------------------------------------ items from back to front */

/* One more than the heights of all classes that an admitted link puts behind this one. */
static uint32_t
height_of (FragmentSort *s, uint32_t class)
{
  const CeldGraph *g = &s->regions.graph;
  CeldLinkArcs     arcs = celd_incremental_order_arcs (&s->sequence, CELD_FARTHER);
  uint32_t         height = 0, k = class;

  do
    {
      for (size_t a = arcs.first[k]; a < arcs.last[k]; a++)
        {
          const size_t *f = &g->first[2 * arcs.arc[a].link];

          for (size_t e = f[0]; e < f[1] && !g->equal[arcs.arc[a].link]; e++)
            {
              uint32_t behind = s->height[celd_class_of (&s->sequence.classes, g->end[e])] + 1;

              height = behind > height ? behind : height;
            }
        }
      k = s->sequence.classes.next[k];
    }
  while (k != class);
  return height;
}

static void
find_heights (FragmentSort *s)
{
  for (uint32_t place = 0; place < s->regions.graph.n_labels; place++)
    if (s->sequence.at[place] != UINT32_MAX)
      s->height[s->sequence.at[place]] = height_of (s, s->sequence.at[place]);
}

typedef struct { uint32_t place, node, height; CeldComposedLayer item; } RankedItem;

static int
compare_places (const void *one, const void *two)
{
  const RankedItem *a = one, *b = two;

  if (a->place != b->place)
    return a->place < b->place ? -1 : 1;
  return a->node < b->node ? -1 : a->node > b->node;
}

/* Sorts the items, and gives them levels without gaps. */
static CeldStatus
sort_items (FragmentSort *s)
{
  CeldComposition *c = s->composition;
  RankedItem          *list = celd_alloc (c->n_items, sizeof *list);
  uint32_t        *level = celd_alloc0 (s->regions.graph.n_labels + 1, sizeof *level);
  bool             good = list && level;

  for (size_t i = 0; i < c->n_items && good; i++)
    {
      uint32_t class = celd_class_of (&s->sequence.classes, s->regions.node_of[i]);

      list[i] = (RankedItem) { s->sequence.place[class], s->regions.node_of[i], s->height[class], c->item[i] };
      level[s->height[class] + 1] = 1;
    }
  for (size_t h = 1; h <= s->regions.graph.n_labels && good; h++)
    level[h] += level[h - 1];
  if (good && c->n_items)
    qsort (list, c->n_items, sizeof *list, compare_places);
  for (size_t i = 0; i < c->n_items && good; i++)
    {
      c->item[i]       = list[i].item;
      c->item[i].level = level[list[i].height];
    }
  c->levels = good ? level[s->regions.graph.n_labels] : 0;
  celd_free (list);
  celd_free (level);
  return good ? CELD_OK : CELD_NO_MEMORY;
}

CeldStatus
celd_fragments_order (const CeldFragment *fragment, const CeldRelations *relations, const CeldOverlaps *overlaps,
                      CeldProblems *problems, CeldComposition *composition)
{
  FragmentSort s = { .composition = composition };
  CeldStatus   status = celd_fragment_graph_new (fragment, relations, overlaps, composition, problems, &s.regions);

  if (status == CELD_OK)
    status = admit_all (&s, problems);
  if (status == CELD_OK)
    {
      s.height = celd_alloc0 (s.regions.graph.n_labels, sizeof *s.height);
      status   = s.height ? CELD_OK : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      find_heights (&s);
      status = sort_items (&s);
    }
  celd_incremental_order_clear (&s.sequence);
  celd_fragment_graph_clear (&s.regions);
  celd_free (s.height);
  return status;
}
