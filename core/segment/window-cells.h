/* What window-cells.c, which contracts windows, and window-pixels.c, which reads them, share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_WINDOW_CELLS_H
#define CELD_WINDOW_CELLS_H

#include "segment/window.h"

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
