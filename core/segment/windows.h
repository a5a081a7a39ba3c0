/* Windows: where the labels of basins are not enough, and a graph of what lies in one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_WINDOWS_H
#define CELD_WINDOWS_H

#include "segment/basins.h"
#include "segment/task.h"
#include "solve/partition.h"

/* ------------------------------------------------------------------ window-places.c */

/* Pixels left .. right, top .. bottom, in which the pixels of these basins get labels anew. */
typedef struct { int left, top, right, bottom; uint32_t group; size_t first, n; } CeldWindow;
typedef struct { CeldWindow *item; size_t n; uint32_t *basin; } CeldWindows; /* basins first .. first + n - 1 */

/* The places where paint lies in basins of another label, and might get pixels of its own.  No two windows of a family
 * of basins overlap; families have no basin in common. */
CeldStatus celd_windows_find (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host,
                              CeldWindows *windows);
void       celd_windows_clear (CeldWindows *windows);        /* accepts a zeroed record */

/* The last run of basins in row y that begins at or before x.  It is looked for near *hint, 0 at first, which is left
 * at a good one for what is near in the same row or the next. */
size_t celd_basin_run_at (const CeldBasins *basins, int y, int x, size_t *hint);

/* ------------------------------------------------------------------ window-cells.c */

/* What a pixel or a block is part of: a node, or a fixed label.  A block can also be of several parts, or fixed as the
 * coarser cells have it, or where there are none as the basins do. */
#define CELD_PART_FIXED UINT32_C (0x80000000) /* and the label */
#define CELD_PART_MIXED UINT32_C (0x40000000) /* and the number of its detail */
#define CELD_PART_ABOVE UINT32_C (0x3fffffff)

typedef struct CeldWindowGraph CeldWindowGraph;

struct CeldWindowGraph
{
  const CeldSegmentTask *task;
  const CeldWindowGraph *coarse;        /* that these ones are finer than; NULL: none */
  const uint32_t        *basin_label;
  CeldWindow             window;
  int                    shift;         /* square blocks of 1 << shift pixels a side; the last ones may be cut off */
  int                    columns, rows; /* of blocks */
  uint32_t              *block;
  bool                  *hard;          /* of each block: is there hard paint of another label than the basin's? */
  uint32_t              *detail;        /* of each mixed block its pixels, as if no block was cut off */
  size_t                 n_details;
  size_t                 n;             /* nodes */
  uint32_t              *present;       /* of node k: the label that its pixels have now */
  uint32_t              *label;         /* and the one they get */
  CeldLink              *link;
  CeldVote              *vote;
  size_t                 n_links, n_votes;
};

/* Contracts the window to a graph: pixels of the basins with free[basin] == id become nodes, others count with the
 * label of their basin. */
CeldStatus celd_window_graph_new (const CeldSegmentTask *task, const uint32_t *label, const uint32_t *free, uint32_t id,
                                  const CeldWindow *window, int shift, CeldWindowGraph *graph);

/* The blocks with fine[block] of cells that have got their labels, contracted less; everything else is fixed. */
CeldStatus celd_window_graph_refine (const CeldWindowGraph *coarse, const uint8_t *fine, CeldWindowGraph *graph);

void celd_window_graph_clear (CeldWindowGraph *graph);                    /* accepts a zeroed record */

/* The label of a part. */
static inline uint32_t
celd_window_part_label (const CeldWindowGraph *graph, uint32_t part)
{
  return part & CELD_PART_FIXED ? part & ~CELD_PART_FIXED : graph->label[part];
}

/* The part of pixel (x,y) of the picture, inside the window. */
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

/* ------------------------------------------------------------------ window-links.c */

/* A vote for a label, or one that is added to the last. */
CeldStatus celd_window_graph_add_data_cost (CeldWindowGraph *graph, uint32_t node, uint32_t label, int64_t cost);

/* Fills in the links between nodes, and what is fixed as votes. */
CeldStatus celd_window_graph_connect (CeldWindowGraph *graph);

/* ------------------------------------------------------------------ building the graph */

/* In the state of a pixel, besides CELD_PART_FIXED: its label, and unless it is fixed its kind. */
#define CELD_PART_LABELS   UINT32_C (0x1fffffff)
#define CELD_PART_KINDS    UINT32_C (0x60000000)
#define CELD_PART_KIND_INK UINT32_C (0x20000000)        /* once: ink; twice: dark ink */

typedef struct
{
  CeldWindowGraph *graph;
  const uint32_t  *free;         /* by basin */
  uint32_t         id;
  size_t           hint;         /* of celd_basin_run_at */
  const uint8_t   *fine;         /* by block; NULL: blocks are to be coarse */
  float            dark;         /* ink below this is dark */
  uint32_t        *state;        /* of the pixels of a row of blocks: label, kind, CELD_PART_FIXED */
  uint32_t        *paint;        /* and the label of soft paint on them, 0 if there is none */
  uint32_t        *change;       /* of the columns of pixels in it: not 0 where states differ */
  uint32_t        *common;       /* and the bits that all states have */
  bool            *painted;      /* by block of the row */
  bool            *hard;         /* the same: is there hard paint in it that changes something? */
  uint32_t        *parent;       /* of the pixels of a block: another one of its piece, itself for the first */
} CeldWindowBuilder;

static inline int
celd_window_width (const CeldWindowGraph *graph)
{
  return graph->window.right - graph->window.left + 1;
}

/* ------------------------------------------------------------------ window-pixels.c */

/* The states of the pixels of row y of the picture, as the basins have them, and soft paint.  Notes in what blocks
 * there is paint, and hard paint. */
void celd_window_read (CeldWindowBuilder *builder, int y, uint32_t *state, uint32_t *paint);

/* The same as coarser cells have found them, of the blocks with fine[column]. */
void celd_window_read_fine (CeldWindowBuilder *builder, int y, const uint8_t *fine, uint32_t *state, uint32_t *paint);

#endif
