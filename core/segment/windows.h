/* Windows: where the labels of basins are not enough, and a graph of what lies in one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_WINDOWS_H
#define CELD_WINDOWS_H

#include "segment/basins.h"
#include "segment/canvas.h"
#include "solve/partition.h"

/* ------------------------------------------------------------------ window-places.c */

/* Pixels left .. right, top .. bottom, in which the pixels of these basins get labels anew. */
typedef struct { int left, top, right, bottom; uint32_t family; size_t first, n; } CeldWindow;
typedef struct { CeldWindow *item; size_t n; uint32_t *basin; } CeldWindows; /* basins first .. first + n - 1 */

/* The places where paint lies in basins of another label, and might get pixels of its own.  No two windows of a family
 * of basins overlap; families have no basin in common. */
CeldStatus celd_windows_find (const CeldCanvas *canvas, const uint32_t *label, const CeldHost *host,
                              CeldWindows *windows);
void       celd_windows_clear (CeldWindows *windows);        /* accepts a zeroed record */

/* The last run of basins in row y that begins at or before x.  It is looked for near *hint, 0 at first, which is left
 * at a good one for what is near in the same row or the next. */
size_t celd_basin_run_at (const CeldBasins *basins, int y, int x, size_t *hint);

/* ------------------------------------------------------------------ window-cells.c */

/* What a pixel or a block is part of: a node, or a fixed label.  A block can also be of several parts, or fixed as the
 * coarser cells have it, or where there are none as the basins do. */
#define CELD_CELL_FIXED UINT32_C (0x80000000) /* and the label */
#define CELD_CELL_MIXED UINT32_C (0x40000000) /* and the number of its detail */
#define CELD_CELL_ABOVE UINT32_C (0x3fffffff)

typedef struct CeldWindowCells CeldWindowCells;

struct CeldWindowCells
{
  const CeldCanvas *canvas;
  const CeldWindowCells  *coarse;        /* that these ones are finer than; NULL: none */
  const uint32_t   *basin_label;
  CeldWindow        window;
  int               shift;         /* square blocks of 1 << shift pixels a side; the last ones may be cut off */
  int               columns, rows; /* of blocks */
  uint32_t         *block;
  bool             *hard;          /* of each block: is there hard paint of another label than the basin's? */
  uint32_t         *detail;        /* of each mixed block its pixels, as if no block was cut off */
  size_t            n_details;
  size_t            n;             /* nodes */
  uint32_t         *present;       /* of node k: the label that its pixels have now */
  uint32_t         *label;         /* and the one they get */
  CeldLink         *link;
  CeldVote         *vote;
  size_t            n_links, n_votes;
};

/* Contracts the window to a graph: pixels of the basins with free[basin] == id become nodes, others count with the
 * label of their basin. */
CeldStatus celd_cells_new (const CeldCanvas *canvas, const uint32_t *label, const uint32_t *free, uint32_t id,
                           const CeldWindow *window, int shift, CeldWindowCells *cells);

/* The blocks with fine[block] of cells that have got their labels, contracted less; everything else is fixed. */
CeldStatus celd_cells_refine (const CeldWindowCells *coarse, const uint8_t *fine, CeldWindowCells *cells);

void celd_cells_clear (CeldWindowCells *cells);                    /* accepts a zeroed record */

/* The label of a part. */
static inline uint32_t
celd_cell_label (const CeldWindowCells *cells, uint32_t part)
{
  return part & CELD_CELL_FIXED ? part & ~CELD_CELL_FIXED : cells->label[part];
}

/* The part of pixel (x,y) of the picture, inside the window. */
static inline uint32_t
celd_cell_at (const CeldWindowCells *cells, int x, int y)
{
  int      i = x - cells->window.left, j = y - cells->window.top, mask = (1 << cells->shift) - 1;
  size_t   k = (size_t) (j >> cells->shift) * (size_t) cells->columns + (size_t) (i >> cells->shift);
  uint32_t block = cells->block[k];

  if (block == CELD_CELL_ABOVE)
    return CELD_CELL_FIXED | (cells->coarse ? celd_cell_label (cells->coarse, celd_cell_at (cells->coarse, x, y))
                                            : cells->basin_label[celd_basin_at (cells->canvas->basins, x, y)]);
  if (block & CELD_CELL_FIXED || !(block & CELD_CELL_MIXED))
    return block;
  return cells->detail[((size_t) (block & ~CELD_CELL_MIXED) << 2 * cells->shift)
                       + ((size_t) (j & mask) << cells->shift) + (size_t) (i & mask)];
}

/* ------------------------------------------------------------------ window-links.c */

/* A vote for a label, or one that is added to the last. */
CeldStatus celd_cells_vote (CeldWindowCells *cells, uint32_t node, uint32_t label, int64_t cost);

/* Fills in the links between nodes, and what is fixed as votes. */
CeldStatus celd_cells_link (CeldWindowCells *cells);

/* ------------------------------------------------------------------ building the graph */

/* In the state of a pixel, besides CELD_CELL_FIXED: its label, and unless it is fixed its kind. */
#define CELD_CELL_LABELS   UINT32_C (0x1fffffff)
#define CELD_CELL_KINDS    UINT32_C (0x60000000)
#define CELD_CELL_KIND_INK UINT32_C (0x20000000)        /* once: ink; twice: dark ink */

typedef struct
{
  CeldWindowCells       *cells;
  const uint32_t  *free;         /* by basin */
  uint32_t         id;
  size_t           hint;         /* of celd_basin_run_at */
  const uint8_t   *fine;         /* by block; NULL: blocks are to be coarse */
  float            dark;         /* ink below this is dark */
  uint32_t        *state;        /* of the pixels of a row of blocks: label, kind, CELD_CELL_FIXED */
  uint32_t        *paint;        /* and the label of soft paint on them, 0 if there is none */
  uint32_t        *change;       /* of the columns of pixels in it: not 0 where states differ */
  uint32_t        *common;       /* and the bits that all states have */
  bool            *painted;      /* by block of the row */
  bool            *hard;         /* the same: is there hard paint in it that changes something? */
  uint32_t        *parent;       /* of the pixels of a block: another one of its piece, itself for the first */
} CeldCellBuilder;

static inline int
celd_cells_width (const CeldWindowCells *cells)
{
  return cells->window.right - cells->window.left + 1;
}

/* ------------------------------------------------------------------ window-pixels.c */

/* The states of the pixels of row y of the picture, as the basins have them, and soft paint.  Notes in what blocks
 * there is paint, and hard paint. */
void celd_cells_read (CeldCellBuilder *builder, int y, uint32_t *state, uint32_t *paint);

/* The same as coarser cells have found them, of the blocks with fine[column]. */
void celd_cells_read_again (CeldCellBuilder *builder, int y, const uint8_t *fine, uint32_t *state, uint32_t *paint);

#endif
