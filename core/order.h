/* The graph of an order: labels, and relations as links between them.  Made by links.c, freed from contradictions by
 * conflicts.c, sorted by order.c.
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

bool       celd_graph_equal (const CeldGraph *graph, size_t link);
CeldStatus celd_graph_add (CeldGraph *graph, uint32_t label); /* one more nearer label of the last link */
CeldStatus celd_graph_index (const CeldGraph *graph, CeldSide side, CeldIndex *index);

/* Does not keep relations that contradict heavier or earlier ones, appends the cycle of each to `order`, and completes
 * the last link. */
CeldStatus celd_graph_settle (CeldGraph *graph, const CeldRun *run, CeldOrder *order);

/* Where an artist finds a relation: an end inside the drawing; -1,-1 if none is. */
void celd_relation_place (const CeldLabels *labels, const CeldPalette *palette, const CeldRelation *relation,
                          int *x, int *y);

#endif
