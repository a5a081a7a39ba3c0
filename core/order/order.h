/* The graph of an order: labels, and relations as links between them.
 *
 *   links.c       which labels a relation joins
 *   knots.c       which relations go round in circles
 *   sequence.c    labels from far to near, kept up while relations are added
 *   feedback-arc-set.c   relations of the least total weight that break all cycles
 *   conflicts.c   which relations can hold together, and the cycles of those that cannot
 *   cycle-search.c   shortest cycles
 *   order.c       levels
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ORDER_H
#define CELD_ORDER_H

#include "base/unions.h"

#include <math.h>

#define CELD_LEAST_GAP   1e-6
#define CELD_LARGEST_GAP 1000

/* A link joins all its farther labels with all its nearer ones, since a colour may name several regions.
 * Link i < relations->n is relation i; the last one is no relation: it puts the background behind what nothing else
 * puts behind it. */
typedef struct
{
  const CeldRelations *relations;
  size_t               n_labels, n_links, n_ends;
  size_t              *first; /* of link i: farther labels from end[first[2i]], nearer ones from end[first[2i+1]] */
  uint32_t            *end;   /* label - 1 */
  bool                *kept;  /* does link i count? */
  bool                *equal; /* is link i an equality? */
} CeldGraph;

typedef enum { CELD_FARTHER, CELD_NEARER } CeldSide;

/* A link that leads from a label to one side: an inequality to the label end + 1 alone; or if end is CELD_ENDS,
 * whatever the graph says. */
typedef struct { uint32_t link, end; } CeldWay;
#define CELD_ENDS UINT32_MAX

/* The links that have a label on one side (an equality has it on both) and lead to the other: those of label k are
 * way[first[k-1]] .. before way[first[k]], by rising number. */
typedef struct { size_t *first; CeldWay *way; } CeldIndex;

/* The same as a view: way[first[k-1]] .. before way[last[k-1]]. */
typedef struct { const size_t *first, *last; const CeldWay *way; } CeldWays;

/* Finds the labels of every relation; reports and does not keep those that join nothing.  The last link has its farther
 * labels and is not kept yet. */
CeldStatus celd_graph_new (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                           const CeldPlane *ink, CeldGraph *graph, CeldProblems *problems);
void       celd_graph_clear (CeldGraph *graph);

static inline bool
celd_graph_equal (const CeldGraph *graph, size_t link)
{
  return graph->equal[link];
}

CeldStatus celd_graph_add (CeldGraph *graph, uint32_t label); /* one more nearer label of the last link */
CeldWay    celd_graph_way (const CeldGraph *graph, size_t link, CeldSide to);
CeldStatus celd_graph_index (const CeldGraph *graph, CeldSide side, const bool *use, CeldIndex *index);
void       celd_index_clear (CeldIndex *index);

static inline CeldWays
celd_index_ways (const CeldIndex *index)
{
  return (CeldWays) { index->first, index->first + 1, index->way };
}

/* ------------------------------------------------------------------ classes.c */

/* Labels of equal depth, numbered from 0: a class has the number of one of its labels; next goes round them. */
typedef struct { uint32_t *parent, *next; } CeldClasses;

CeldStatus celd_classes_new (size_t n, CeldClasses *classes); /* also after a failure celd_classes_clear is to follow */
void       celd_classes_clear (CeldClasses *classes);
void       celd_classes_join (CeldClasses *classes, uint32_t a, uint32_t b);

static inline uint32_t
celd_class_of (CeldClasses *classes, uint32_t k)
{
  return celd_root (classes->parent, k);
}

/* ------------------------------------------------------------------ knots.c */

/* Knots, from 1, of labels (index label - 1) and of links; 0: in none. */
typedef struct { uint32_t *label, *link; size_t n; } CeldKnots;

/* Of kept links. */
CeldStatus celd_knots_find (const CeldGraph *graph, CeldKnots *knots);
void       celd_knots_clear (CeldKnots *knots);

/* ------------------------------------------------------------------ sequence.c */

typedef struct
{
  const CeldGraph *graph;
  CeldClasses      classes;
  CeldIndex        way[2];   /* room for the links that lead from a label to its CeldSide */
  size_t          *last[2];  /* of label k: where its admitted ones end; they begin at way[side].first[k] */
  uint32_t        *at;       /* the class at a place; UINT32_MAX: none */
  uint32_t        *place;    /* of a class; an admitted inequality leads to a higher one */
  uint32_t        *mark[2];  /* by side: number of the search that was at a place last */
  uint32_t         number;   /* of this search, from 1 */
  uint32_t         window[2]; /* first and last place that it may go to */
  uint32_t        *moved;
} CeldSequence;

/* Nothing is admitted yet; also after a failure celd_sequence_clear is to follow. */
CeldStatus celd_sequence_new (const CeldGraph *graph, CeldSequence *sequence);
void       celd_sequence_clear (CeldSequence *sequence);

/* Can link i hold beside all that is admitted?  Then it is, too. */
bool       celd_sequence_admit (CeldSequence *sequence, size_t link);

static inline CeldWays
celd_sequence_ways (const CeldSequence *sequence, CeldSide to)
{
  return (CeldWays) { sequence->way[to].first, sequence->last[to], sequence->way[to].way };
}

/* ------------------------------------------------------------------ cycle-search.c */

/* How a search came to a state: its number, the state before, and by which link. */
typedef struct { uint32_t number, from; size_t link; } CeldStep;

typedef struct
{
  const CeldGraph *graph;
  CeldWays         ways[2];    /* by CeldSide: links that a search may take; for the caller to set */
  size_t           except;     /* but for this one; CELD_NO_INDEX */
  CeldSequence    *sequence;   /* of all these links, between whose places paths are looked for; NULL: anywhere */
  uint32_t         limit[2];
  bool             loose;      /* does a path begin before any inequality? */
  size_t           relation;
  CeldStep        *step[2];    /* by the side a search goes to: of each state */
  uint32_t        *passed[2];  /* of each link, without and behind an inequality: number of the search */
  uint32_t        *queue[2];   /* of states */
  size_t           n[2];
  uint32_t         number;     /* of this search, from 1 */
  uint32_t         met;        /* the state in which both sides of a search met */
} CeldSearch;

/* Also after a failure celd_search_clear is to follow. */
CeldStatus celd_search_new (const CeldGraph *graph, CeldSearch *search);
void       celd_search_clear (CeldSearch *search);

/* Is there a path that relation i contradicts: from a farther end to a nearer one, or, if it is an equality, through an
 * inequality from one end to another?  Then it is a shortest one; does it pass nothing twice; and the relation with
 * what the path consists of. */
bool       celd_search_contradiction (CeldSearch *search, size_t i);
bool       celd_search_is_simple (CeldSearch *search);
CeldStatus celd_search_cycle (const CeldSearch *search, CeldCycle *cycle);

/* Finds all that is behind end[first] .. end[last - 1] of the graph, or equal; is label k + 1 among it? */
void       celd_search_behind (CeldSearch *search, size_t first, size_t last);
bool       celd_search_was_at (const CeldSearch *search, size_t k);

/* ------------------------------------------------------------------ feedback-arc-set.c */

/* Marks the relations of knot `number` that are to be left out so that the rest is consistent: a set of the least total
 * weight.  Nothing is marked if the knot is too large for that. */
CeldStatus celd_feedback_arc_set (const CeldGraph *graph, const CeldKnots *knots, const CeldKnot *knot, uint32_t number,
                                  bool *broken);

/* ------------------------------------------------------------------ conflicts.c */

/* Does not keep relations that contradict heavier or earlier ones, or, unless contradictions are only to be reported,
 * those whose weight is the least in sum; appends knots and the cycle of each to `order`, and completes the last
 * link. */
CeldStatus celd_graph_settle (CeldGraph *graph, CeldOnCycle on_cycle, const CeldHost *host, CeldOrder *order);

/* ------------------------------------------------------------------ order.c */

/* Least distance in levels that a relation asks for. */
static inline double
celd_gap (double gap)
{
  return gap > 0 ? fmin (fmax (gap, CELD_LEAST_GAP), CELD_LARGEST_GAP) : 1; /* NaN: 1 */
}

/* ------------------------------------------------------------------ cycle-colours.c */

/* Finds the label of each cycle that needs regions of it that do not touch to have one depth. */
CeldStatus celd_cycles_explain (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                                const CeldGraph *graph, CeldOrder *order);

/* ------------------------------------------------------------------ split-cycles.c */

/* A region split between two anchors: x[0],y[0] is in what keeps the label, x[1],y[1] in the other. */
typedef struct { uint32_t label, other; int x[2], y[2]; } CeldSplit;
typedef struct { CeldSplit *item; size_t n; } CeldSplits;

/* Splits regions of `labels` until no contradiction is left that this can resolve; labels and palette grow.  After a
 * failure they are undefined, but can be cleared. */
CeldStatus celd_cycles_split (const CeldRelations *relations, const CeldPlane *ink, const CeldSettings *settings,
                              const CeldHost *host, CeldLabels *labels, CeldPalette *palette, CeldSplits *splits);

/* Has the label been split? */
bool celd_splits_have (const CeldSplits *splits, uint32_t label);

/* Ink along the new borders becomes paper; that of the regions' outlines, `stroke` wide, stays. */
void celd_splits_erase (const CeldSplits *splits, const CeldLabels *labels, int stroke, CeldPlane *ink);

/* ------------------------------------------------------------------ links.c */

/* Where an artist finds a relation: an end inside the drawing; -1,-1 if none is. */
void celd_relation_place (const CeldLabels *labels, const CeldPalette *palette, const CeldRelation *relation,
                          int *x, int *y);

#endif
