/* Suggestions: which region is in front, from the drawing and from a depth picture, and their place beside the artist's
 * relations.
 *
 * The cues of each pair of touching regions (suggest-cues.c) are weighted and summed to log-odds, as if they were
 * independent.  The weights come from a logistic regression on random scenes of overlapping shapes, except two that
 * such scenes cannot teach: that the background is behind is almost certain, and that a line inside a region ends where
 * something covers it is a weak cue, because folds also end at the outline of their own region.  Pairs are taken by
 * falling confidence, and one that would close a cycle with those before it is left out.
 *
 * Contradictions between the artist's relations and the suggestions are resolved as those of an order (conflicts.c),
 * with each suggestion lighter than any relation of the artist.  Suggestions that are not kept are dropped silently.
 *
 * The cues are those from which human vision takes order in line drawings: T-junctions (Guzman, Decomposition of a
 * visual scene into three-dimensional bodies, 1968), surroundedness, convexity and compactness of figures (Rubin 1921;
 * Palou and Salembier, Monocular depth ordering using T-junctions and convexity occlusion cues, IEEE TIP 22(5), 2013).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/order.h"

#include <math.h>
#include <stdlib.h>

#define BACKGROUND_ODDS  6.0    /* log-odds of the background being behind; chosen: as good as certain */
#define CONFIDENCE_STEP 0.001   /* the least confidence, and what confidences are rounded to: people read them */

/* The weight of each cue in log-odds per unit (the regression's; MARKS and FRAME chosen), and the largest value of the
 * cue that counts. */
static const struct { double weight, most; } weights[CELD_N_CUES] = {
  [CELD_CUE_BAR]      = { 0.79, 6 },
  [CELD_CUE_ENCLOSED] = { 3.3, 1 },
  [CELD_CUE_CONVEX]   = { 1.6, 1 },
  [CELD_CUE_COMPACT]  = { 1.6, 1 },
  [CELD_CUE_MARKS]    = { 0.3, 2 },
  [CELD_CUE_FRAME]    = { 6.0, 1 },
};

/* Log-odds of a being in front. */
static double
odds_of_cues (const CeldPairCues *pair, const CeldPalette *palette)
{
  bool   a = palette->item[pair->a - 1].background, b = palette->item[pair->b - 1].background;
  double odds = 0;

  if (a != b)
    return b ? BACKGROUND_ODDS : -BACKGROUND_ODDS;
  for (int k = 0; k < CELD_N_CUES; k++)
    odds += weights[k].weight * fmax (-weights[k].most, fmin (weights[k].most, pair->cue[k]));
  return odds;
}

/* ------------------------------------------------------------------ without contradictions */

typedef struct { double odds; size_t pair; } RankedPair;

/* By falling confidence, then in the order given. */
static int
compare_ranked (const void *one, const void *two)
{
  const RankedPair *a = one, *b = two;

  if (fabs (a->odds) != fabs (b->odds))
    return fabs (a->odds) > fabs (b->odds) ? -1 : 1;
  return a->pair < b->pair ? -1 : 1;
}

/* The suggestions accepted so far, as a graph with an edge from each label to every label behind it. */
typedef struct
{
  size_t   *first;              /* of label l: its first edge; SIZE_MAX: none */
  size_t   *next;               /* of an edge: the next one of its label; SIZE_MAX: none */
  uint32_t *edge;               /* the label that an edge leads to */
  size_t    n;
  uint32_t *stack;
  size_t   *seen;               /* of a label: number of the last search that visited it */
  size_t    number;             /* of this search, from 1 */
} Behind;

/* Is there a path from `nearer` to `farther`? */
static bool
is_behind (Behind *b, uint32_t farther, uint32_t nearer)
{
  size_t n = 0;

  b->number++;
  b->stack[n++] = nearer;
  b->seen[nearer] = b->number;
  while (n)
    {
      uint32_t label = b->stack[--n];

      if (label == farther)
        return true;
      for (size_t k = b->first[label]; k != SIZE_MAX; k = b->next[k])
        if (b->seen[b->edge[k]] != b->number)
          {
            b->seen[b->edge[k]] = b->number;
            b->stack[n++]       = b->edge[k];
          }
    }
  return false;
}

static CeldRelation
relation_of (const CeldPairCues *pair, double odds)
{
  CeldTerm a = { .x = floor (pair->ax), .y = floor (pair->ay) }, b = { .x = floor (pair->bx), .y = floor (pair->by) };
  double   confidence = round (tanh (fabs (odds) / 2) / CONFIDENCE_STEP) * CONFIDENCE_STEP;

  return (CeldRelation) {
    .nearer = odds > 0 ? a : b, .farther = odds > 0 ? b : a, .gap = 1,
    .weight = fmax (CONFIDENCE_STEP, fmin (1 - CONFIDENCE_STEP, confidence)),
    .source = CELD_SOURCE_SUGGESTION,
  };
}

static CeldStatus
add_consistent (const CeldPairCues *pairs, const RankedPair *ranked, size_t n, Behind *behind, CeldRelations *suggested)
{
  CeldStatus status = CELD_OK;

  for (size_t i = 0; i < n && status == CELD_OK; i++)
    {
      const CeldPairCues *pair = &pairs[ranked[i].pair];
      double              odds = ranked[i].odds;
      uint32_t            nearer = odds > 0 ? pair->a : pair->b, farther = odds > 0 ? pair->b : pair->a;

      if (is_behind (behind, nearer, farther))
        continue;
      status = celd_relation_add (suggested, relation_of (pair, odds));
      behind->edge[behind->n] = farther;
      behind->next[behind->n] = behind->first[nearer];
      behind->first[nearer]   = behind->n++;
    }
  return status;
}

/* Appends a relation for each pair with odds (a is in front where odds[i] > 0), most confident first, except those that
 * contradict the ones before them. */
static CeldStatus
add_suggestions (const CeldPairCues *pairs, const double *odds, size_t n, size_t n_labels, CeldRelations *suggested)
{
  RankedPair *ranked = celd_alloc (n, sizeof *ranked);
  Behind      behind = {
    .first = celd_alloc (n_labels + 1, sizeof (size_t)), .next = celd_alloc (n, sizeof (size_t)),
    .edge = celd_alloc (n, sizeof (uint32_t)), .stack = celd_alloc (n_labels + 1, sizeof (uint32_t)),
    .seen = celd_alloc0 (n_labels + 1, sizeof (size_t)),
  };
  size_t      n_ranked = 0, before = suggested->n;
  CeldStatus  status = CELD_NO_MEMORY;

  if (ranked && behind.first && behind.next && behind.edge && behind.stack && behind.seen)
    {
      for (size_t k = 0; k <= n_labels; k++)
        behind.first[k] = SIZE_MAX;
      for (size_t i = 0; i < n; i++)
        if (odds[i] < 0 || odds[i] > 0)
          ranked[n_ranked++] = (RankedPair) { odds[i], i };
      qsort (ranked, n_ranked, sizeof *ranked, compare_ranked);
      status = add_consistent (pairs, ranked, n_ranked, &behind, suggested);
    }
  if (status != CELD_OK)
    suggested->n = before;
  celd_free (ranked);
  celd_free (behind.first);
  celd_free (behind.next);
  celd_free (behind.edge);
  celd_free (behind.stack);
  celd_free (behind.seen);
  return status;
}

CeldStatus
celd_suggest (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink, const CeldPlane *hint,
              const CeldHost *host, CeldRelations *suggested)
{
  CeldPairCues *pairs = NULL;
  double       *odds = NULL;
  size_t        n = 0, before = suggested->n;
  CeldStatus    status;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)) ||
      (hint && !CELD_SAME_SIZE (labels, hint)))
    return CELD_BAD_SIZE;
  status = celd_cues_gather (labels, palette, ink, host, &pairs, &n);
  if (status == CELD_OK && !(odds = celd_alloc (n, sizeof *odds)))
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    odds[i] = odds_of_cues (&pairs[i], palette);
  if (status == CELD_OK)
    status = add_suggestions (pairs, odds, n, palette->n, suggested);
  if (status == CELD_OK && hint)
    status = celd_depth_odds (labels, palette, ink, hint, pairs, n, odds);
  if (status == CELD_OK && hint)
    status = add_suggestions (pairs, odds, n, palette->n, suggested);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status != CELD_OK)
    suggested->n = before;
  celd_free (pairs);
  celd_free (odds);
  return status;
}

/* ------------------------------------------------------------------ beside the artist's relations */

/* Both in one list, suggestions (may be NULL) last and each lighter than the artist's lightest relation. */
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
  for (size_t i = 0; suggested && i < suggested->n && status == CELD_OK; i++)
    {
      status = celd_relation_add (all, suggested->item[i]);
      if (status == CELD_OK)
        all->item[all->n - 1].weight *= least;
    }
  return status;
}

/* Do the links that a search may take put the farther label of a link behind its nearer one? */
static bool
is_decided (CeldCycleSearch *search, size_t link)
{
  const CeldGraph *g = search->graph;

  celd_cycle_search_behind (search, g->first[2 * link + 1], g->first[2 * link + 1] + 1);
  return celd_cycle_search_was_at (search, g->end[g->first[2 * link]]);
}

/* Drops the suggestions in `all`, behind the artist's n_own relations, that the resolved graph does not keep, or that
 * are not wanted. */
static CeldStatus
select_kept (const CeldGraph *graph, size_t n_own, CeldSuggest suggest, CeldRelations *all)
{
  CeldCycleSearch search;
  CeldArcIndex    down = { 0 };
  bool           *own = celd_alloc0 (graph->n_links, sizeof *own);
  size_t          n = n_own;
  CeldStatus      status = celd_cycle_search_new (graph, &search);

  for (size_t i = 0; own && i < n_own; i++)
    own[i] = graph->kept[i];
  if (status == CELD_OK)
    status = own ? celd_graph_index (graph, CELD_NEARER, own, &down) : CELD_NO_MEMORY;
  if (status == CELD_OK)
    search.arcs[CELD_FARTHER] = celd_arc_index_view (&down);
  for (size_t i = n_own; i < all->n && status == CELD_OK; i++)
    if (graph->kept[i] && (suggest == CELD_SUGGEST_ALL || !is_decided (&search, i)))
      all->item[n++] = all->item[i];
  if (status == CELD_OK)
    all->n = n;
  celd_cycle_search_clear (&search);
  celd_arc_index_clear (&down);
  celd_free (own);
  return status;
}

CeldStatus
celd_suggestions_join (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                       const CeldRelations *suggested, const CeldSettings *settings, const CeldPlane *ink,
                       const CeldHost *host, CeldRelations *both)
{
  CeldRelations all = { 0 };
  CeldGraph     graph = { 0 };
  CeldOrder     order = { 0 };
  CeldStatus    status;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  status = list_all (relations, settings->suggest == CELD_SUGGEST_OFF ? NULL : suggested, &all);
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

CeldStatus
celd_order_suggested (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                      const CeldRelations *suggested, const CeldPlane *ink, const CeldSettings *settings,
                      const CeldHost *host, CeldRelations *joined, CeldOrder *order, CeldProblems *problems)
{
  CeldHostPart  part[2];
  CeldHost      first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldRelations both = { 0 };
  CeldStatus    status = celd_suggestions_join (labels, palette, relations, suggested, settings, ink, &first, &both);

  if (status == CELD_OK)
    status = celd_order (labels, palette, &both, ink, settings, &second, order, problems);
  if (status == CELD_OK)
    {
      celd_relations_clear (joined);
      *joined = both;
    }
  else
    celd_relations_clear (&both);
  return status;
}
