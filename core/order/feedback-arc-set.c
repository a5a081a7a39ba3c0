/* A minimum weighted feedback arc set of a small strongly connected component: the relations with the least total
 * weight without which the others can hold.  Exact, by dynamic programming over sets of labels [Lawler 1964].
 *
 * Labels are placed from far to near in blocks of equal depth.  Whether a relation is broken is known when the first of
 * its nearer labels is placed, so that the least weight broken by placing a set S of labels does not depend on the
 * order in S.  Blocks of several labels are tried only if equalities connect them.  Of relations with equal weights
 * later ones are broken first: each weighs a little less than the one before it.
 *
 * Cost: exponential in the number of labels, limited by MOST_LABELS and MOST_WORK.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "order/order.h"

#include <math.h>

#define MOST_LABELS 18         /* of a component; larger ones are left to the order by weight; chosen */
#define SURE_LABELS 12         /* components of up to so many are solved for any number of relations; chosen */
#define MOST_WORK   (1u << 26) /* visits of a relation, about 0.1 s; bench */
#define AGE_WEIGHT  1e-9       /* fraction of the sum of weights by which weights depend on the order; chosen */

/* A relation between labels of the component, as sets of these. */
typedef struct { uint32_t far, near; bool equal; double weight; } Arc;

typedef struct
{
  const CeldGraph *graph;
  const CeldScc   *scc;
  uint32_t         label[MOST_LABELS]; /* label - 1 */
  size_t           n;
  Arc             *arc;
  uint32_t        *block;              /* sets of labels that may have one depth */
  size_t           n_blocks;
  double          *cost;               /* of a set of placed labels */
  uint32_t        *last;               /* the block of it that was placed last */
  size_t           block_capacity;
} Exact;

static void
exact_clear (Exact *x)
{
  celd_free (x->arc);
  celd_free (x->block);
  celd_free (x->cost);
  celd_free (x->last);
}

/* What it costs to leave a relation out: its weight, nothing for a suggestion. */
static double
link_cost (const CeldGraph *graph, size_t link)
{
  const CeldRelation *r = &graph->relations->item[link];

  return r->weight > 0 && r->source != CELD_SOURCE_SUGGESTION ? r->weight : 0; /* NaN: 0 */
}

/* The labels of end[first] .. end[last - 1] that are in the component, as a set. */
static uint32_t
set_of (const Exact *x, size_t first, size_t last)
{
  uint32_t set = 0;

  for (size_t e = first; e < last; e++)
    for (size_t k = 0; k < x->n; k++)
      if (x->label[k] == x->graph->end[e])
        set |= 1u << k;
  return set;
}

static void
read_arcs (Exact *x)
{
  const CeldGraph *g = x->graph;
  double           sum = 0;

  for (size_t i = 0; i < x->scc->n; i++)
    sum += link_cost (g, x->scc->item[i]);
  for (size_t i = 0; i < x->scc->n; i++)
    {
      size_t        link = x->scc->item[i];
      const size_t *f = &g->first[2 * link];
      double        age = (double) (x->scc->n - i) / (double) (x->scc->n * x->scc->n);

      x->arc[i] = (Arc) { set_of (x, f[0], f[1]), set_of (x, f[1], f[2]), celd_graph_equal (g, link),
                          link_cost (g, link) + AGE_WEIGHT * sum * age };
    }
}

/* Do equalities connect all labels of the set? */
static bool
is_connected (const Exact *x, uint32_t set)
{
  uint32_t reached = set & -set, before;

  do
    {
      before = reached;
      for (size_t i = 0; i < x->scc->n; i++)
        if (x->arc[i].equal && ((x->arc[i].far | x->arc[i].near) & reached))
          reached |= (x->arc[i].far | x->arc[i].near) & set;
    }
  while (reached != before);
  return reached == set;
}

/* Lists the sets of labels that may have one depth: single labels, and those that equalities connect. */
static CeldStatus
list_blocks (Exact *x)
{
  bool any = false;

  for (size_t i = 0; i < x->scc->n; i++)
    any |= x->arc[i].equal;
  for (uint32_t set = 1; set < 1u << x->n; set++)
    if (!(set & (set - 1)) || (any && is_connected (x, set)))
      {
        if (celd_append (x->block, x->n_blocks, x->block_capacity, set) != CELD_OK)
          return CELD_NO_MEMORY;
      }
  return CELD_OK;
}

/* The weight of relations that break when a block is placed in front of the set. */
static double
broken_weight (const Exact *x, uint32_t set, uint32_t block)
{
  double sum = 0;

  for (size_t i = 0; i < x->scc->n; i++)
    {
      const Arc *a = &x->arc[i];
      uint32_t   all = a->far | a->near;

      if (a->equal ? (all & block) && !(all & set) && (all & ~block)
                   : (a->near & block) && !(a->near & set) && (a->far & ~set))
        sum += a->weight;
    }
  return sum;
}

/* Fills in cost and last for all sets of labels. */
static CeldStatus
place_labels (Exact *x)
{
  size_t n_sets = (size_t) 1 << x->n;

  x->cost = celd_alloc (n_sets, sizeof *x->cost);
  x->last = celd_alloc0 (n_sets, sizeof *x->last);
  if (!x->cost || !x->last)
    return CELD_NO_MEMORY;
  for (size_t s = 1; s < n_sets; s++)
    x->cost[s] = INFINITY;
  x->cost[0] = 0;
  for (uint32_t set = 0; set < n_sets - 1; set++)
    for (size_t b = 0; b < x->n_blocks; b++)
      if (!(x->block[b] & set))
        {
          uint32_t both = set | x->block[b];
          double   cost = x->cost[set] + broken_weight (x, set, x->block[b]);

          if (cost < x->cost[both])
            {
              x->cost[both] = cost;
              x->last[both] = x->block[b];
            }
        }
  return CELD_OK;
}

/* Marks the relations that break when all labels are placed at the least cost. */
static void
mark_broken (const Exact *x, bool *broken)
{
  uint32_t set = (1u << x->n) - 1;

  for (size_t i = 0; i < x->scc->n; i++)
    broken[x->scc->item[i]] = false;
  while (set)
    {
      uint32_t block = x->last[set];

      set &= ~block;
      for (size_t i = 0; i < x->scc->n; i++)
        {
          const Arc *a = &x->arc[i];
          uint32_t   all = a->far | a->near;

          if (a->equal ? (all & block) && (all & ~block)
                       : (a->near & block) && !(a->near & set) && (a->far & ~set))
            broken[x->scc->item[i]] = true;
        }
    }
}

/* Is the component small enough, once its blocks are known? */
static bool
is_small (const Exact *x)
{
  double pairs = fmin (ldexp ((double) x->n_blocks, (int) x->n), pow (3, (double) x->n));

  return x->n <= SURE_LABELS || pairs * (double) x->scc->n <= MOST_WORK;
}

CeldStatus
celd_feedback_arc_set (const CeldGraph *graph, const CeldSccs *sccs, const CeldScc *scc, uint32_t number,
                       bool *broken)
{
  Exact      x = { .graph = graph, .scc = scc };
  CeldStatus status;

  for (uint32_t k = 0; k < graph->n_labels; k++)
    if (sccs->label[k] == number)
      {
        if (x.n == MOST_LABELS)
          return CELD_OK;
        x.label[x.n++] = k;
      }
  x.arc  = celd_alloc (scc->n, sizeof *x.arc);
  status = x.arc ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    {
      read_arcs (&x);
      status = list_blocks (&x);
    }
  if (status == CELD_OK && is_small (&x))
    {
      status = place_labels (&x);
      if (status == CELD_OK)
        mark_broken (&x, broken);
    }
  exact_clear (&x);
  return status;
}
