/* Windows: where the labels of basins are not enough, and a graph of what lies in one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_WINDOW_H
#define CELD_WINDOW_H

#include "partition.h"
#include "segment.h"

/* ------------------------------------------------------------------ window-places.c */

/* Pixels left .. right, top .. bottom, in which the pixels of these basins get labels anew. */
typedef struct { int left, top, right, bottom; size_t first, n; } CeldWindow;
typedef struct { CeldWindow *item; size_t n; uint32_t *basin; } CeldWindows; /* basins first .. first + n - 1 */

/* The places where paint lies in basins of another label, and might get pixels of its own.  No two windows overlap. */
CeldStatus celd_windows_find (const CeldCanvas *canvas, const uint32_t *label, const CeldRun *run,
                              CeldWindows *windows);
void       celd_windows_clear (CeldWindows *windows);        /* accepts a zeroed record */

/* ------------------------------------------------------------------ window-cells.c */

/* What a pixel or a block is part of: a node, or a fixed label; a block can also be of several parts. */
#define CELD_CELL_FIXED UINT32_C (0x80000000) /* and the label */
#define CELD_CELL_MIXED UINT32_C (0x40000000) /* and the number of its detail */

typedef struct
{
  const CeldCanvas *canvas;
  CeldWindow        window;
  int               size;          /* of a square block, in pixels; the last ones of rows and columns may be cut off */
  int               columns, rows; /* of blocks */
  uint32_t         *block;
  uint32_t         *detail;        /* of each mixed block size x size pixels */
  size_t            n_details;
  size_t            n;             /* nodes */
  uint32_t         *present;       /* of node k: the label that its pixels have now */
  uint32_t         *label;         /* and the one they get */
  CeldLink         *link;
  CeldVote         *vote;
  size_t            n_links, n_votes;
} CeldCells;

/* Contracts the window to a graph: pixels of the basins with free[basin] == id become nodes, others count with the
 * label of their basin.  Blocks with fine[block] (NULL: none) are not contracted. */
CeldStatus celd_cells_new (const CeldCanvas *canvas, const uint32_t *label, const uint32_t *free, uint32_t id,
                           const CeldWindow *window, int size, const uint8_t *fine, CeldCells *cells);
void       celd_cells_clear (CeldCells *cells);              /* accepts a zeroed record */

/* The part of pixel (x,y) of the picture, inside the window. */
static inline uint32_t
celd_cell_at (const CeldCells *cells, int x, int y)
{
  int      i = (x - cells->window.left) / cells->size, j = (y - cells->window.top) / cells->size;
  uint32_t block = cells->block[(size_t) j * (size_t) cells->columns + (size_t) i];
  size_t   size = (size_t) cells->size;

  if (block & CELD_CELL_FIXED || !(block & CELD_CELL_MIXED))
    return block;
  i = (x - cells->window.left) % cells->size;
  j = (y - cells->window.top) % cells->size;
  return cells->detail[(block & ~CELD_CELL_MIXED) * size * size + (size_t) j * size + (size_t) i];
}

/* The cost of a border between (x,y) and the pixel to the right, or below. */
int32_t celd_cells_cost (const CeldCanvas *canvas, int x, int y, bool south);

#endif
