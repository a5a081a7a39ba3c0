/* Windows: where the labels of basins are not enough, and a graph of the pixels in a window.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_WINDOWS_H
#define CELD_WINDOWS_H

#include "segment/basins.h"
#include "segment/task.h"
#include "solve/partition.h"

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

/* The part that a pixel or a block belongs to: the number of a node, or a fixed label.  A block can also consist of
 * several parts, or be left to the coarser graph or, where there is none, to the labels of the basins. */
#define CELD_PART_FIXED UINT32_C (0x80000000) /* plus the label */
#define CELD_PART_MIXED UINT32_C (0x40000000) /* plus the number of its detail */
#define CELD_PART_ABOVE UINT32_C (0x3fffffff)

typedef struct CeldWindowGraph CeldWindowGraph;

struct CeldWindowGraph
{
  const CeldSegmentTask *task;
  const CeldWindowGraph *coarse;        /* the graph that this one refines; NULL: none */
  const uint32_t        *basin_label;
  CeldWindow             window;
  int                    shift;         /* square blocks of side 1 << shift; the last ones may be clipped */
  int                    columns, rows; /* in blocks */
  uint32_t              *block;
  bool                  *hard;          /* of each block: has it a hard seed of another label than its basin's? */
  uint32_t              *detail;        /* the parts of the pixels of each mixed block, as if none were clipped */
  size_t                 n_details;
  size_t                 n;             /* nodes */
  uint32_t              *present;       /* of node k: the present label of its pixels */
  uint32_t              *label;         /* and their new one */
  CeldLink              *link;
  CeldVote              *vote;
  size_t                 n_links, n_votes;
  size_t                 detail_capacity, present_capacity, link_capacity, vote_capacity;
};

/* Contracts the window to a graph: pixels of the basins with free[basin] == id become nodes, all others are fixed to
 * the label of their basin.  Makes the record; so does celd_window_graph_refine. */
CeldStatus celd_window_graph_new (const CeldSegmentTask *task, const uint32_t *label, const uint32_t *free, uint32_t id,
                                  const CeldWindow *window, int shift, CeldWindowGraph *graph);

/* Contracts less the blocks with fine[block], of a graph whose nodes have their labels; everything else is fixed. */
CeldStatus celd_window_graph_refine (const CeldWindowGraph *coarse, const uint8_t *fine, CeldWindowGraph *graph);

void celd_window_graph_clear (CeldWindowGraph *graph);                    /* accepts a zeroed record */

/* The label of a part. */
static inline uint32_t
celd_window_part_label (const CeldWindowGraph *graph, uint32_t part)
{
  return part & CELD_PART_FIXED ? part & ~CELD_PART_FIXED : graph->label[part];
}

/* The part of pixel (x,y) of the picture, which must be inside the window. */
static inline uint32_t
celd_window_part_at (const CeldWindowGraph *graph, int x, int y)
{
  int      i = x - graph->window.left, j = y - graph->window.top, mask = (1 << graph->shift) - 1;
  size_t   k = (size_t) (j >> graph->shift) * (size_t) graph->columns + (size_t) (i >> graph->shift);
  uint32_t block = graph->block[k];

  if (block == CELD_PART_ABOVE)
    return CELD_PART_FIXED |
           (graph->coarse ? celd_window_part_label (graph->coarse, celd_window_part_at (graph->coarse, x, y))
            : graph->basin_label[celd_basin_at (graph->task->basins, x, y)]);
  if (block & CELD_PART_FIXED || !(block & CELD_PART_MIXED))
    return block;
  return graph->detail[((size_t) (block & ~CELD_PART_MIXED) << 2 * graph->shift)
                       + ((size_t) (j & mask) << graph->shift) + (size_t) (i & mask)];
}

/* ------------------------------------------------------------------ window-edges.c */

/* Adds the cost of a node without this label. */
CeldStatus celd_window_graph_add_data_cost (CeldWindowGraph *graph, uint32_t node, uint32_t label, int64_t cost);

/* Fills in the links between nodes, and data costs for neighbours that are fixed. */
CeldStatus celd_window_graph_connect (CeldWindowGraph *graph);

/* ------------------------------------------------------------------ building the graph */

/* The state of a pixel: CELD_PART_FIXED, its label, and its kind unless it is fixed. */
#define CELD_PART_LABELS   UINT32_C (0x1fffffff)
#define CELD_PART_KINDS    UINT32_C (0x60000000)
#define CELD_PART_KIND_INK UINT32_C (0x20000000) /* once: ink; twice: dark ink */

typedef struct
{
  CeldWindowGraph *graph;
  const uint32_t  *free;         /* by basin */
  uint32_t         id;
  size_t           hint;         /* of celd_basin_run_at */
  const uint8_t   *fine;         /* by block; NULL: for coarse blocks */
  float            dark;         /* ink below this value is dark */
  uint32_t        *state;        /* states of the pixels in a row of blocks */
  uint32_t        *paint;        /* their soft seeds, 0: none */
  uint32_t        *change;       /* of each column of these pixels: not 0 where states differ */
  uint32_t        *common;       /* and the bits that all of its states have */
  bool            *painted;      /* of each block of the row: has it soft seeds? */
  bool            *hard;         /* and a hard seed of another label than its basin's? */
  uint32_t        *parent;       /* of the pixels of a block: a disjoint-set forest (unions.h) */
} CeldWindowBuilder;

static inline int
celd_window_width (const CeldWindowGraph *graph)
{
  return graph->window.right - graph->window.left + 1;
}

/* ------------------------------------------------------------------ window-pixels.c */

/* Reads the states of the pixels of row y of the picture from the basins' labels, and their soft seeds; sets `painted`
 * and `hard`. */
void celd_window_read (CeldWindowBuilder *builder, int y, uint32_t *state, uint32_t *paint);

/* Reads the states of the pixels of row y from the coarser graph's new labels, for the blocks with fine[column], and
 * their soft seeds. */
void celd_window_read_fine (CeldWindowBuilder *builder, int y, const uint8_t *fine, uint32_t *state, uint32_t *paint);

#endif
