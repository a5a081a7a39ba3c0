/* The graph of an order: labels, and relations as links between them.
 *
 *   links.c       which labels a relation joins
 *   knots.c       which relations go round in circles
 *   sequence.c    labels from far to near, kept up while relations are added
 *   feedback.c, feedback-exact.c   relations of little weight that break all circles
 *   conflicts.c   which relations can hold together, and the cycles of those that cannot
 *   order.c       levels
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ORDER_H
#define CELD_ORDER_H

#include "private.h"

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
} CeldGraph;

typedef enum { CELD_FARTHER, CELD_NEARER } CeldSide;

/* The links that have a label on one side (an equality has it on both): those of label k are link[first[k-1]] .. before
 * link[first[k]], by rising number.  End both with celd_free. */
typedef struct { size_t *first, *link; } CeldIndex;

/* Finds the labels of every relation; reports and does not keep those that join nothing.  The last link has its farther
 * labels and is not kept yet. */
CeldStatus celd_graph_new (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                           const CeldPlane *ink, CeldGraph *graph, CeldProblems *problems);
void       celd_graph_clear (CeldGraph *graph);

static inline bool
celd_graph_equal (const CeldGraph *graph, size_t link)
{
  return link < graph->relations->n && graph->relations->item[link].equal;
}

CeldStatus celd_graph_add (CeldGraph *graph, uint32_t label); /* one more nearer label of the last link */
CeldStatus celd_graph_index (const CeldGraph *graph, CeldSide side, CeldIndex *index);

/* ------------------------------------------------------------------ classes.c */

/* Labels of equal depth, numbered from 0: a class has the number of one of its labels; next goes round them. */
typedef struct { uint32_t *parent, *next; } CeldClasses;

CeldStatus celd_classes_new (size_t n, CeldClasses *classes); /* also after a failure celd_classes_clear is to follow */
void       celd_classes_clear (CeldClasses *classes);
uint32_t   celd_class_of (CeldClasses *classes, uint32_t k);
void       celd_classes_join (CeldClasses *classes, uint32_t a, uint32_t b);

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
  CeldIndex        up, down;
  bool            *admitted; /* of each link */
  uint32_t        *place;  /* of a class; an admitted inequality leads to a higher one */
  size_t          *seen;   /* number of the search that saw a class last */
  size_t          *goal;   /* of a class: number of the search that looks for it */
  size_t           number; /* of this search, from 1 */
  uint64_t        *list;   /* classes that a search has found */
  uint32_t        *places;
  size_t           n;
} CeldSequence;

/* Nothing is admitted yet; also after a failure celd_sequence_clear is to follow. */
CeldStatus celd_sequence_new (const CeldGraph *graph, CeldSequence *sequence);
void       celd_sequence_clear (CeldSequence *sequence);

/* Can link i hold beside all that is admitted?  Then it is, too. */
bool       celd_sequence_admit (CeldSequence *sequence, size_t link);

/* ------------------------------------------------------------------ feedback-exact.c, feedback.c */

/* Marks the relations of knot `number` that are to be left out; *done is false if the knot is too large. */
CeldStatus celd_feedback_exact (const CeldGraph *graph, const CeldKnots *knots, const CeldKnot *knot, uint32_t number,
                                bool *broken, bool *done);

/* A relation that is tried, and what decides when. */
typedef struct { int round; double weight; size_t relation; } CeldTurn;

/* What it costs to leave a relation out: its weight, nothing for a suggestion. */
static inline double
celd_link_cost (const CeldGraph *graph, size_t link)
{
  const CeldRelation *r = &graph->relations->item[link];

  return r->weight > 0 && r->source != CELD_SOURCE_SUGGESTION ? r->weight : 0; /* NaN: 0 */
}

/* The same for all knots, whose relations are turn[0..n_turns-1], by falling weight. */
CeldStatus celd_feedback (const CeldGraph *graph, const CeldKnots *knots, const CeldKnot *knot, const CeldTurn *turn,
                          size_t n_turns, const CeldRun *run, bool *broken);

/* ------------------------------------------------------------------ conflicts.c */

/* Does not keep relations that contradict heavier or earlier ones, or, unless contradictions are only to be reported,
 * those whose weight is the least in sum; appends knots and the cycle of each to `order`, and completes the last
 * link. */
CeldStatus celd_graph_settle (CeldGraph *graph, CeldOnCycle on_cycle, const CeldRun *run, CeldOrder *order);

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
                              const CeldRun *run, CeldLabels *labels, CeldPalette *palette, CeldSplits *splits);

/* Has the label been split? */
bool celd_splits_have (const CeldSplits *splits, uint32_t label);

/* Ink along the new borders becomes paper; that of the regions' outlines, `stroke` wide, stays. */
void celd_splits_erase (const CeldSplits *splits, const CeldLabels *labels, int stroke, CeldPlane *ink);

/* ------------------------------------------------------------------ links.c */

/* Where an artist finds a relation: an end inside the drawing; -1,-1 if none is. */
void celd_relation_place (const CeldLabels *labels, const CeldPalette *palette, const CeldRelation *relation,
                          int *x, int *y);

#endif
