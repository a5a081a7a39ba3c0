/* The depth order: a graph of labels with relations as links, its cycles, and suggestions from the drawing.
 *
 *   order-graph.c         which labels a relation joins; classes of labels of equal depth
 *   strong-components.c   which relations lie on common cycles
 *   incremental-order.c   a topological order of classes to which relations are added
 *   feedback-arc-set.c    relations of the least total weight that break all cycles
 *   cycle-search.c        shortest cycles
 *   conflicts.c           which relations can hold together, and the cycles of those that cannot
 *   order.c               levels
 *   label-levels.c        levels of labels that have them already
 *   cracks.c              labels between which registration may tear
 *   split-cycles.c        contradictions resolved by splitting regions
 *   region-outlines.c     the outlines of all regions' surfaces
 *   t-junctions.c         where three regions meet, and which outline continues there without a corner: the bar of a T
 *   suggest-cues.c        what the drawing says about each pair of touching regions
 *   suggest-depth.c       what a depth picture says about each pair
 *   suggest.c             relations from these, and the order of them and the artist's relations
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ORDER_H
#define CELD_ORDER_H

#include "base/base.h"

#include <math.h>

#define CELD_LEAST_GAP   1e-6 /* levels; chosen */
#define CELD_LARGEST_GAP 1000 /* levels; chosen */

/* ------------------------------------------------------------------ order-graph.c */

/* A link joins all its farther labels with all its nearer ones, since a colour may name several regions.
 * Link i < relations->n is relation i.  The last link is no relation: it puts the background behind all labels that no
 * relation puts behind it. */
typedef struct
{
  const CeldRelations *relations;
  size_t               n_labels, n_links, n_ends;
  size_t              *first; /* of link i: farther labels from end[first[2i]], nearer ones from end[first[2i+1]] */
  uint32_t            *end;   /* label - 1 */
  bool                *kept;  /* does link i count? */
  bool                *equal; /* is link i an equality? */
  size_t               end_capacity;
} CeldGraph;

typedef enum { CELD_FARTHER, CELD_NEARER } CeldSide;

/* A link as seen from a label: an inequality that leads to the one label end + 1; or any link, whose labels are in the
 * graph, if end is CELD_MANY_ENDS. */
typedef struct { uint32_t link, end; } CeldLinkArc;
#define CELD_MANY_ENDS UINT32_MAX

/* For each label the links that have it on one side (an equality has it on both) and lead to the other side: those of
 * label k are arc[first[k-1]] to arc[first[k] - 1], by rising number. */
typedef struct { size_t *first; CeldLinkArc *arc; } CeldArcIndex;

/* A borrowed view of such lists: those of label k are arc[first[k-1]] to arc[last[k-1] - 1]. */
typedef struct { const size_t *first, *last; const CeldLinkArc *arc; } CeldLinkArcs;

/* Finds the labels of every relation.  Relations that join nothing are reported as problems and not kept.  The last
 * link has its farther labels only, and is not kept yet.  ink and problems may be NULL. */
CeldStatus celd_graph_new (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                           const CeldPlane *ink, CeldGraph *graph, CeldProblems *problems);
void       celd_graph_clear (CeldGraph *graph);

static inline bool
celd_graph_equal (const CeldGraph *graph, size_t link)
{
  return graph->equal[link];
}

/* Appends a label to the ends of the last link. */
CeldStatus celd_graph_add (CeldGraph *graph, uint32_t label);

/* What the ends of relations refer to. */
typedef struct
{
  const CeldLabels  *labels;
  const CeldPalette *palette;
  const CeldPlane   *ink;       /* may be NULL */
  int                stroke;    /* width in pixels; 0 = not measured yet */
} CeldTermPicture;

/* Appends the labels of a term, each increased by `before`, by rising number; none if it names nothing. */
CeldStatus celd_graph_add_term (CeldTermPicture *picture, const CeldTerm *term, size_t before, CeldGraph *graph);

/* A label on both sides of a link, or 0; both sides are sorted. */
uint32_t   celd_graph_common_label (const CeldGraph *graph, size_t link);

/* A link as an arc that leads to one side. */
CeldLinkArc celd_graph_arc (const CeldGraph *graph, size_t link, CeldSide to);

/* The pixel at which relation i ends on this side, and its label there; false if that end names a colour.  The pixel
 * may be ink of another label. */
bool celd_graph_point (const CeldGraph *graph, size_t i, CeldSide side, uint32_t *label, int *x, int *y);

/* The arcs of all labels that are on `side` of a link with use[link] (NULL: of any).  Cleared by the caller. */
CeldStatus celd_graph_index (const CeldGraph *graph, CeldSide side, const bool *use, CeldArcIndex *index);
void       celd_arc_index_clear (CeldArcIndex *index);

static inline CeldLinkArcs
celd_arc_index_view (const CeldArcIndex *index)
{
  return (CeldLinkArcs) { index->first, index->first + 1, index->arc };
}

/* Equivalence classes of labels of equal depth.  Labels count from 0 here, and a class has the number of one of its
 * labels.  parent: a union-find forest; next: the next label of the class, in a ring. */
typedef struct { uint32_t *parent, *next; } CeldEquivalence;

/* Each label in a class of its own.  To be cleared by the caller, also after a failure. */
CeldStatus celd_equivalence_new (size_t n, CeldEquivalence *classes);
void       celd_equivalence_clear (CeldEquivalence *classes);
void       celd_equivalence_join (CeldEquivalence *classes, uint32_t a, uint32_t b);

static inline uint32_t
celd_class_of (CeldEquivalence *classes, uint32_t k)
{
  return celd_root (classes->parent, k);
}

/* A place to report a relation at: an end of it inside the drawing; -1,-1 if there is none. */
void celd_relation_place (const CeldLabels *labels, const CeldPalette *palette, const CeldRelation *relation,
                          int *x, int *y);

/* ------------------------------------------------------------------ strong-components.c */

/* The strongly connected component, from 1, of each label (index label - 1) and of each link; 0: in none. */
typedef struct { uint32_t *label, *link; size_t n; } CeldSccs;

/* The components of the kept links that have an inequality, numbered by their first link.  Cleared by the caller. */
CeldStatus celd_sccs_find (const CeldGraph *graph, CeldSccs *sccs);
void       celd_sccs_clear (CeldSccs *sccs);

/* ------------------------------------------------------------------ incremental-order.c */

/* Classes in a sequence from far to near in which every admitted inequality leads to a higher place. */
typedef struct
{
  const CeldGraph *graph;
  CeldEquivalence  classes;
  CeldArcIndex     arc[2];    /* room for the links that lead from a label to its CeldSide */
  size_t          *last[2];   /* of label k: where its admitted ones end; they begin at arc[side].first[k] */
  uint32_t        *at;        /* the class at a place; UINT32_MAX: none */
  uint32_t        *place;     /* of a class */
  uint32_t        *mark[2];   /* by side: number of the last search that reached a place */
  uint32_t         number;    /* of this search, from 1 */
  uint32_t         window[2]; /* first and last place that this search may reach */
  uint32_t        *moved;     /* work space: classes of the window in their new order */
} CeldIncrementalOrder;

/* No link is admitted yet.  To be cleared by the caller, also after a failure. */
CeldStatus celd_incremental_order_new (const CeldGraph *graph, CeldIncrementalOrder *sequence);
void       celd_incremental_order_clear (CeldIncrementalOrder *sequence);

/* Admits a link and returns true, unless it contradicts the links admitted before. */
bool       celd_incremental_order_admit (CeldIncrementalOrder *sequence, size_t link);

/* The admitted links that lead from each label to one side; valid until the next one is admitted. */
static inline CeldLinkArcs
celd_incremental_order_arcs (const CeldIncrementalOrder *sequence, CeldSide to)
{
  return (CeldLinkArcs) { sequence->arc[to].first, sequence->last[to], sequence->arc[to].arc };
}

/* ------------------------------------------------------------------ cycle-search.c */

/* How a search came to a state: its number, the state before, and by which link. */
typedef struct { uint32_t number, from; size_t link; } CeldSearchStep;

typedef struct
{
  const CeldGraph      *graph;
  CeldLinkArcs          arcs[2];   /* by CeldSide: links that a search may take; set by the caller */
  size_t                except;    /* a link that it may not take; CELD_NO_INDEX: none */
  CeldIncrementalOrder *sequence;  /* of all these links: bounds the search; NULL: unbounded */
  uint32_t              limit[2];  /* first and last place of the sequence that it may reach */
  bool                  loose;     /* may a path begin with equalities? */
  size_t                relation;  /* the one whose contradiction is looked for */
  CeldSearchStep       *step[2];   /* by the side a search goes to: of each state */
  uint32_t             *passed[2]; /* number of the last search that took a link: at 2 link + (behind an inequality) */
  uint32_t             *queue[2];  /* of states */
  size_t                n[2];
  uint32_t              number;    /* of this search, from 1 */
  uint32_t              met;       /* the state in which both sides of a search met */
} CeldCycleSearch;

/* To be cleared by the caller, also after a failure. */
CeldStatus celd_cycle_search_new (const CeldGraph *graph, CeldCycleSearch *search);
void       celd_cycle_search_clear (CeldCycleSearch *search);

/* Finds a shortest path that relation i contradicts: from a farther end to a nearer one, or, for an equality, from one
 * end to another with an inequality on it.  False if there is none. */
bool       celd_cycle_search_contradiction (CeldCycleSearch *search, size_t i);

/* After true: does the path visit no label and take no link twice?  And the relation with the links of the path. */
bool       celd_cycle_search_is_simple (CeldCycleSearch *search);
CeldStatus celd_cycle_search_cycle (const CeldCycleSearch *search, CeldCycle *cycle);

/* Finds all labels behind, or equal to, those of end[first] to end[last - 1] of the graph; then: is label k + 1 one of
 * them? */
void       celd_cycle_search_behind (CeldCycleSearch *search, size_t first, size_t last);
bool       celd_cycle_search_was_at (const CeldCycleSearch *search, size_t k);

/* ------------------------------------------------------------------ feedback-arc-set.c */

/* Marks the relations of component `number` that are to be left out so that the rest is consistent: a set of the least
 * total weight.  Marks nothing if the component is too large for that. */
CeldStatus celd_feedback_arc_set (const CeldGraph *graph, const CeldSccs *sccs, const CeldScc *scc, uint32_t number,
                                  bool *broken);

/* ------------------------------------------------------------------ conflicts.c */

/* Makes the kept links consistent: drops relations that contradict heavier or earlier ones, or, unless on_cycle is
 * CELD_ON_CYCLE_REPORT, those with the least total weight.  Appends the strongly connected components and a cycle for
 * each dropped relation to `order`, and completes the last link. */
CeldStatus celd_graph_resolve (CeldGraph *graph, CeldOnCycle on_cycle, const CeldHost *host, CeldOrder *order);

/* For each cycle of the order, finds the label, if any, whose separate regions must have one depth for it to exist. */
CeldStatus celd_cycles_explain (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                                const CeldGraph *graph, CeldOrder *order);

/* ------------------------------------------------------------------ order.c */

/* The least difference in levels that a relation demands, from its gap as read. */
static inline double
celd_gap (double gap)
{
  return gap > 0 ? fmin (fmax (gap, CELD_LEAST_GAP), CELD_LARGEST_GAP) : 1; /* NaN: 1 */
}

/* ------------------------------------------------------------------ split-cycles.c */

/* A region split in two: x[0],y[0] is in the part that keeps the label, x[1],y[1] in the other. */
typedef struct { uint32_t label, other; int x[2], y[2]; } CeldSplit;
typedef struct { CeldSplit *item; size_t n, item_capacity; } CeldSplits;

/* Splits regions of `labels` until no contradiction is left that a split can resolve; new labels are appended to the
 * palette.  After a failure labels and palette are undefined, but can be cleared. */
CeldStatus celd_cycles_split (const CeldRelations *relations, const CeldPlane *ink, const CeldSettings *settings,
                              const CeldHost *host, CeldLabels *labels, CeldPalette *palette, CeldSplits *splits);

/* Has the label been split, or split off another one? */
static inline bool
celd_splits_have (const CeldSplits *splits, uint32_t label)
{
  for (size_t i = 0; i < splits->n; i++)
    if (splits->item[i].label == label || splits->item[i].other == label)
      return true;
  return false;
}

/* Turns ink along the new boundaries into paper, but not within `stroke` pixels of the regions' outlines. */
void celd_splits_erase (const CeldSplits *splits, const CeldLabels *labels, int stroke, CeldPlane *ink);

/* Draws the new boundaries into the ink, one pixel wide. */
void celd_splits_draw (const CeldSplits *splits, const CeldLabels *labels, CeldPlane *ink);

/* ------------------------------------------------------------------ region-outlines.c */

#define CELD_FACES_FRAME   UINT32_MAX
#define CELD_SHORTEST_MARK 6 /* stroke widths along both sides of a line inside a surface; chosen */

/* A point on the outline of a surface, between two pixels; where ink begins, with the precision of antialiasing. */
typedef struct
{
  float    x, y;
  uint32_t faces;               /* the label behind the ink there, or CELD_FACES_FRAME; 0: none */
} CeldOutlinePoint;

/* A closed outline, followed with the surface on the right. */
typedef struct { size_t first, n; uint32_t label; double length; } CeldOutlineLoop;

/* A region's surface is its paper; of a region that is almost wholly ink, all of it. */
typedef struct
{
  int               width, height;
  int               stroke;     /* width in pixels */
  uint32_t         *surface;    /* of each pixel: the label whose surface it is, 0 = contour; with a margin of 1 */
  size_t            stride;
  CeldOutlinePoint *point;
  size_t            n_points;
  CeldOutlineLoop  *loop;
  size_t            n_loops;
  size_t            point_capacity, loop_capacity;
} CeldRegionOutlines;

/* Labels above n_labels count as 0.  ink may be NULL: then all is paper. */
CeldStatus celd_region_outlines_new (const CeldLabels *labels, size_t n_labels, const CeldPlane *ink,
                                     const CeldHost *host, CeldRegionOutlines *outlines);
void       celd_region_outlines_clear (CeldRegionOutlines *outlines); /* accepts a zeroed record */

/* The label whose surface pixel (x,y) belongs to, 0 outside the picture. */
static inline uint32_t
celd_surface_at (const CeldRegionOutlines *outlines, int x, int y)
{
  return x < 0 || y < 0 || x >= outlines->width || y >= outlines->height
         ? 0 : outlines->surface[(size_t) (y + 1) * outlines->stride + (size_t) (x + 1)];
}

/* ------------------------------------------------------------------ t-junctions.c */

/* A point where three regions meet, and the angle by which the outline of each turns there: radians, > 0 = its corner
 * is convex; NaN if it cannot be measured. */
typedef struct { float x, y; uint32_t label[3]; float turn[3]; } CeldJunction;

/* Finds all junctions; *junctions is the caller's, freed with celd_free. */
CeldStatus celd_junctions_find (const CeldLabels *labels, size_t n_labels, const CeldRegionOutlines *outlines,
                                const CeldHost *host, CeldJunction **junctions, size_t *n);

/* ------------------------------------------------------------------ suggest-cues.c */

/* Cues that a, > 0, or b, < 0, is in front. */
typedef enum
{
  CELD_CUE_BAR,         /* at junctions where a's outline runs on and b's has a corner: the sum of log-odds */
  CELD_CUE_ENCLOSED,    /* fraction of a's outline that faces b, less the fraction of b's that faces a */
  CELD_CUE_CONVEX,      /* 1: a bulges into b, 0: their boundary is straight, -1: b bulges into a */
  CELD_CUE_COMPACT,     /* compactness of a, less that of b; a disc has 1 */
  CELD_CUE_MARKS,       /* number of lines in b that end at the boundary with a, less those in a */
  CELD_CUE_FRAME,       /* 1: b has all of the frame, 0: neither has more than half of it */
  CELD_N_CUES
} CeldCue;

typedef struct
{
  uint32_t a, b;                /* labels, a < b */
  double   length;              /* of their boundary, pixels */
  double   cue[CELD_N_CUES];
  double   ax, ay, bx, by;      /* a point well inside each of them, near their boundary */
} CeldPairCues;

/* The pairs of touching regions, sorted by labels; *pairs is the caller's, freed with celd_free.  ink may be NULL. */
CeldStatus celd_cues_gather (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                             const CeldHost *host, CeldPairCues **pairs, size_t *n);

/* ------------------------------------------------------------------ suggest-depth.c */

/* Log-odds of pairs[i].a being in front of pairs[i].b by a depth picture of the size of `labels`; 0 where it has no
 * depth of one of them.  ink may be NULL. */
CeldStatus celd_depth_odds (const CeldLabels *labels, const CeldPalette *palette, const CeldPlane *ink,
                            const CeldPlane *depth, const CeldPairCues *pairs, size_t n, double *odds);

/* ------------------------------------------------------------------ suggest.c */

/* The artist's relations, and behind them in the list those suggestions that do not contradict them (as far as
 * settings->on_cycle keeps them) or heavier suggestions; with settings->suggest = CELD_SUGGEST_FILL_GAPS only where the
 * artist's relations do not decide, directly or through others; with CELD_SUGGEST_OFF none.  Suggestions get weights
 * below all of the artist's.  Replaces `both`, which may be `relations`. */
CeldStatus celd_suggestions_join (const CeldLabels *labels, const CeldPalette *palette, const CeldRelations *relations,
                                  const CeldRelations *suggested, const CeldSettings *settings, const CeldPlane *ink,
                                  const CeldHost *host, CeldRelations *both);

#endif
