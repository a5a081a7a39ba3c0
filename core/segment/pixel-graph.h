/* A graph of the pixels in a box, for minimum cuts: what windows, gaps and split regions are solved on.
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
  uint32_t              *parent; /* of the pixels of a square: a disjoint-set forest (unions.h) */
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

#endif
