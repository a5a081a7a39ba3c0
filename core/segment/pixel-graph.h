/* A graph of the pixels in a box, for minimum cuts, which windows, gaps and split regions are solved on; and windows.
 *
 * The caller goes over the box in squares and gives the pixels of each a state.  Connected pixels of equal state in a
 * square are one node; pixels whose label is fixed are no node.  An edge between two nodes is part of their link, an
 * edge to a fixed pixel is a data cost.  A cut costs the same along any monotone staircase of pixels, so squares of
 * empty paper lose only the distance from a square's corner to where the cut would begin.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PIXEL_GRAPH_H
#define CELD_PIXEL_GRAPH_H

#include "segment/task.h"
#include "solve/partition.h"

#define CELD_LARGEST_SQUARE 64 /* pixels a side */

/* The state of a pixel: a value, flags, and the label of a soft seed on it in the upper 32 bits. */
#define CELD_STATE_FIXED    (UINT64_C (1) << 31) /* is no node; the value is its label */
#define CELD_STATE_DIAGONAL (UINT64_C (1) << 30) /* is connected to its diagonal neighbours, too */
#define CELD_STATE_WIDE     (UINT64_C (1) << 29) /* is connected to neighbours in other cells of the square, too */
#define CELD_STATE_VALUE    (CELD_STATE_WIDE - 1)
#define CELD_STATE_SEED     32                   /* shift of the seed's label */

#define CELD_PART_FIXED UINT32_C (0x80000000) /* plus the label; label 0: there are no edges to this pixel */

/* A node: pixels of the square of this size whose first pixel is (x,y), clipped by the box. */
typedef struct
{
  int32_t  x, y, size;
  bool     whole;  /* all of the square, without seeds */
  uint32_t value;  /* of its pixels' state */
} CeldPixelNode;

typedef struct CeldPixelGraph CeldPixelGraph;

struct CeldPixelGraph
{
  const CeldSegmentTask *task;
  CeldRect               box;
  uint32_t              *part;   /* of each pixel of the box: the number of its node, or CELD_PART_FIXED + its label */
  CeldPixelNode         *node;   /* those of a square one after the other */
  size_t                 n;
  CeldLink              *link;   /* a < b; each pair of nodes once */
  CeldVote              *vote;
  size_t                 n_links, n_votes;
  uint32_t              *parent; /* of the pixels of a square: a disjoint-set forest (base/base.h) */
  size_t                 node_capacity, link_capacity, vote_capacity;

  /* celd_distance_to_paper of the picture, if that is known; NULL: distances are measured where they are needed. */
  const int32_t *distance;

  /* For edges between ink of two parts: the squared distance to paper that they cost as much as; if negative, the true
   * one of each edge, at most so much.  NULL: the true one. */
  int32_t (*to_paper) (const CeldPixelGraph *graph, uint32_t a, uint32_t b);
};

/* Makes a graph without nodes; the parts are not set.  Clear it also after a failure. */
CeldStatus celd_pixel_graph_new (const CeldSegmentTask *task, CeldRect box, CeldPixelGraph *graph);
void       celd_pixel_graph_clear (CeldPixelGraph *graph); /* accepts a zeroed record */

/* Removes all nodes, links and data costs; the parts stay. */
void celd_pixel_graph_empty (CeldPixelGraph *graph);

/* Adds the nodes of a square and sets the parts of its pixels.  `state` is that of its first pixel, with `stride`
 * states a row.  Unless their state is wide, nodes end at cells of 1 << cell pixels a side. */
CeldStatus celd_pixel_graph_add_square (CeldPixelGraph *graph, int x, int y, int size, const uint64_t *state,
                                        size_t stride, int cell);

/* Adds a square that is one node, for pixels of this state. */
CeldStatus celd_pixel_graph_add_whole (CeldPixelGraph *graph, int x, int y, int size, uint64_t state);

/* Fills in the links between nodes, and the data costs for fixed neighbours. */
CeldStatus celd_pixel_graph_connect (CeldPixelGraph *graph);

/* The part of pixel (x,y) of the picture, which must be inside the box. */
static inline uint32_t *
celd_pixel_graph_part (const CeldPixelGraph *graph, int x, int y)
{
  return graph->part + (size_t) (y - graph->box.y) * (size_t) graph->box.width + (size_t) (x - graph->box.x);
}

/* The x, or y, after a square's last pixel. */
static inline int
celd_pixel_graph_right (const CeldPixelGraph *graph, int x, int size)
{
  int right = graph->box.x + graph->box.width;

  return x + size < right ? x + size : right;
}

static inline int
celd_pixel_graph_bottom (const CeldPixelGraph *graph, int y, int size)
{
  int bottom = graph->box.y + graph->box.height;

  return y + size < bottom ? y + size : bottom;
}

/* ------------------------------------------------------------------ window-search.c */

/* The pixels left .. right, top .. bottom (inclusive), in which the pixels of these basins are labelled again. */
typedef struct { int left, top, right, bottom; uint32_t group; size_t first, n; } CeldWindow;
typedef struct { CeldWindow *item; size_t n; uint32_t *basin; } CeldWindows; /* basins first .. first + n - 1 */

/* Finds windows where paint lies in basins of another label.  Windows of a group of basins do not overlap; groups have
 * no basin in common.  Makes the record. */
CeldStatus celd_windows_find (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host,
                              CeldWindows *windows);
void       celd_windows_clear (CeldWindows *windows);        /* accepts a zeroed record */

/* The index of the run of basins that contains (x,y).  The search starts near *hint, 0 at first, which is updated for
 * pixels nearby in the same row or the next. */
size_t celd_basin_run_at (const CeldBasins *basins, int y, int x, size_t *hint);

/* ------------------------------------------------------------------ window-graph.c */

/* The labels that pixels have before a window is cut: those of a picture, whose celd_distance_to_paper is known; or of
 * their basins, where pixels of basins with free[basin] != id are fixed. */
typedef struct
{
  const CeldLabels *picture;
  const int32_t    *to_paper;
  const uint32_t   *label, *free;
  uint32_t          id;
} CeldPresentLabels;

/* The graph of a window in square blocks of side 1 << shift; shift 0: of pixels.  The values of its nodes are their
 * present labels.  The window's outermost pixels are fixed, except along the frame of the picture.  Clear it also after
 * a failure. */
CeldStatus celd_window_graph_new (const CeldSegmentTask *task, const CeldPresentLabels *present, CeldRect box,
                                  int shift, CeldPixelGraph *graph);

/* Divides the blocks that have a node with crossed[node], and fixes all other pixels to their labels.  label[node]
 * becomes the present label. */
CeldStatus celd_window_graph_refine (CeldPixelGraph *graph, const uint32_t *label, const bool *crossed);

/* Workspace for cuts of windows. */
typedef struct
{
  const CeldSegmentTask *task;
  const CeldHost        *host;
  uint32_t              *order;  /* all labels in the order of cuts */
  uint32_t              *local;  /* of each label, from 1: its number in this window, or 0 */
  uint32_t              *global; /* of each such number, from 0: the label */
  int64_t               *votes;  /* of each label, from 1: the sum of its data costs here */
} CeldWindowCutter;

CeldStatus celd_window_cutter_new (const CeldSegmentTask *task, const CeldHost *host, CeldWindowCutter *cutter);
void       celd_window_cutter_clear (CeldWindowCutter *cutter);     /* also after a failure */

/* Finds the labels of the nodes: the present ones, unless others cost less (*better).  A label that no node has now
 * must have data costs of at least `least` > 0 together.  The caller frees *label; the labels of the graph's data costs
 * are not valid afterwards. */
CeldStatus celd_window_cut (CeldWindowCutter *cutter, CeldPixelGraph *graph, int64_t least, uint32_t **label,
                            bool *better);

#endif
