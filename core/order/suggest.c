/* Suggestions: which region is in front, from the drawing alone.
 *
 * The cues of each pair (suggest-cues.c) are weighed and added up to log-odds, as if each spoke for itself.  The
 * weights are those of a logistic regression on random scenes of sheets laid over each other, but for two that such
 * scenes cannot tell: that the background is behind is as good as certain, and that a line in a region ends where
 * something covers it is little more than a guess, as folds end at outlines of their own, too.  Pairs are then taken
 * by falling confidence, and one that would close a cycle with those before it is left out.
 *
 * The cues are those that vision takes order from in line drawings: T-junctions (Guzman, Decomposition of a visual
 * scene into three-dimensional bodies, 1968), surroundedness, convexity and compactness of figures (Rubin 1921; Palou
 * and Salembier, Monocular depth ordering using T-junctions and convexity occlusion cues, IEEE TIP 22(5), 2013).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "order/suggest.h"

#include <math.h>
#include <stdlib.h>

#define CERTAIN 6.0             /* log-odds of the background being behind */
#define LEAST   0.001           /* confidence, and its steps: it is to be read by people */

/* Weight of each cue, and how much of it counts at most. */
static const struct { double weight, most; } weights[CELD_N_CUES] = {
  [CELD_CUE_BAR]      = { 0.79, 6 },
  [CELD_CUE_ENCLOSED] = { 3.3, 1 },
  [CELD_CUE_CONVEX]   = { 1.6, 1 },
  [CELD_CUE_COMPACT]  = { 1.6, 1 },
  [CELD_CUE_MARKS]    = { 0.3, 2 },
  [CELD_CUE_FRAME]    = { 6.0, 1 },
};

static double
odds_of (const CeldPairCues *pair, const CeldPalette *palette)
{
  bool   a = palette->item[pair->a - 1].background, b = palette->item[pair->b - 1].background;
  double odds = 0;

  if (a != b)
    return b ? CERTAIN : -CERTAIN;
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

/* What is behind what so far: edge[k] leads from a label to one behind it, next[k] is that label's next edge. */
typedef struct
{
  size_t   *first;              /* of label l: its first edge; SIZE_MAX */
  size_t   *next;
  uint32_t *edge;
  size_t    n;
  uint32_t *stack;
  size_t   *seen;               /* number of the search that saw a label last */
  size_t    number;
} Behind;

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

  double   confidence = round (tanh (fabs (odds) / 2) / LEAST) * LEAST;

  return (CeldRelation) {
    .nearer = odds > 0 ? a : b, .farther = odds > 0 ? b : a, .gap = 1,
    .weight = fmax (LEAST, fmin (1 - LEAST, confidence)),
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

CeldStatus
celd_suggestions_add (const CeldPairCues *pairs, const double *odds, size_t n, size_t n_labels,
                      CeldRelations *suggested)
{
  RankedPair   *ranked = celd_alloc (n, sizeof *ranked);
  Behind  behind = {
    .first = celd_alloc (n_labels + 1, sizeof (size_t)), .next = celd_alloc (n, sizeof (size_t)),
    .edge = celd_alloc (n, sizeof (uint32_t)), .stack = celd_alloc (n_labels + 1, sizeof (uint32_t)),
    .seen = celd_alloc0 (n_labels + 1, sizeof (size_t)),
  };
  size_t     n_ranked = 0, before = suggested->n;
  CeldStatus status = CELD_NO_MEMORY;

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

/* ------------------------------------------------------------------ the whole */

CeldStatus
celd_suggest (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink, const CeldHost *host,
              CeldRelations *suggested)
{
  CeldPairCues *pairs = NULL;
  double       *odds = NULL;
  size_t        n = 0;
  CeldStatus    status;

  if (!CELD_SAME_SIZE (labels, labels) || (ink && !CELD_SAME_SIZE (labels, ink)))
    return CELD_BAD_SIZE;
  status = celd_cues_gather (labels, palette, ink, host, &pairs, &n);
  if (status == CELD_OK && !(odds = celd_alloc (n, sizeof *odds)))
    status = CELD_NO_MEMORY;
  for (size_t i = 0; i < n && status == CELD_OK; i++)
    odds[i] = odds_of (&pairs[i], palette);
  if (status == CELD_OK)
    status = celd_suggestions_add (pairs, odds, n, palette->n, suggested);
  celd_free (pairs);
  celd_free (odds);
  return status == CELD_OK ? celd_progress (host, 1) : status;
}
