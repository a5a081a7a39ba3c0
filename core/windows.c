/* Strokes in basins of another label: the LazyBrush energy [SDC09b] solved on pixels, in windows round them.
 *
 * A window's pixels are contracted to a graph (window-cells.c) and cut like the basin graph (partition.c); where a
 * border then runs across paper the blocks along it are opened to pixels, and the window is cut once more.  Small
 * windows are pixels from the start, and exact for each cut.  An answer is taken only if its energy is lower than that
 * of the basins' labels with hard paint on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "window.h"

#include <string.h>

#define PIXELS  4096            /* a window of so many is solved on pixels */
#define BLOCKS  4096            /* larger ones on about so many blocks, */
#define LARGEST 32              /* of at most so many pixels a side */

typedef struct
{
  const CeldCanvas *canvas;
  const uint32_t   *label;      /* of each basin */
  const CeldRun    *run;
  uint32_t         *free;       /* of each basin: the last window, from 1, in which it is free */
  uint32_t         *order;      /* all labels, as they are told apart */
  uint32_t         *local;      /* of each label, from 1: its place among those of this window, 0 if it is not there */
  uint32_t         *global;     /* the other way round, from 0 */
  CeldPatches       patches;
} Solver;

/* ------------------------------------------------------------------ cutting a graph */

/* Numbers the labels that a graph knows from 1, in their order; returns how many there are. */
static size_t
number_labels (Solver *s, const CeldCells *cells)
{
  size_t n = 0;

  memset (s->local, 0, (s->canvas->palette.n + 1) * sizeof *s->local);
  for (size_t k = 0; k < cells->n; k++)
    s->local[cells->present[k]] = 1;
  for (size_t i = 0; i < cells->n_votes; i++)
    s->local[cells->vote[i].label] = 1;
  for (size_t i = 0; i < s->canvas->palette.n; i++)
    if (s->local[s->order[i]])
      {
        s->global[n] = s->order[i];
        s->local[s->order[i]] = (uint32_t) ++n;
      }
  return n;
}

/* Labels of the graph's nodes, no worse than the present ones; *energy is theirs. */
static CeldStatus
cut (Solver *s, CeldCells *cells, int64_t *energy)
{
  size_t        n_labels = number_labels (s, cells);
  uint32_t     *order = celd_alloc (n_labels, sizeof *order), *present = celd_alloc (cells->n, sizeof *present);
  CeldPart      part;
  CeldRun       run = celd_run_part (&part, s->run, 0, 0);
  CeldPartition problem = {
    cells->n, cells->link, cells->n_links, cells->vote, cells->n_votes, NULL, order, n_labels
  };
  CeldStatus    status = CELD_NO_MEMORY;
  int64_t       before;

  if (!order || !present)
    goto done;
  for (size_t k = 0; k < n_labels; k++)
    order[k] = (uint32_t) k + 1;
  for (size_t k = 0; k < cells->n; k++)
    present[k] = s->local[cells->present[k]];
  for (size_t i = 0; i < cells->n_votes; i++)
    cells->vote[i].label = s->local[cells->vote[i].label];
  status = celd_partition (&problem, &run, cells->label, energy, NULL);
  if (status != CELD_OK)
    goto done;
  before = celd_partition_energy (&problem, present);
  for (size_t k = 0; k < cells->n; k++)
    cells->label[k] = *energy < before ? s->global[cells->label[k] - 1] : cells->present[k];
  *energy = *energy < before ? *energy : before;

done:
  celd_free (order);
  celd_free (present);
  return status;
}

/* ------------------------------------------------------------------ where pixels are wanted */

/* Does the new border run across paper between (x,y) and the pixel to the right, or below? */
static bool
is_crossed (const CeldCells *cells, int x, int y, bool south)
{
  uint32_t a = celd_cell_at (cells, x, y), b = celd_cell_at (cells, x + !south, y + south);

  if (a == b || (a | b) & CELD_CELL_FIXED || cells->label[a] == cells->label[b])
    return false;
  return celd_is_paper (CELD_AT (cells->canvas->ink, x, y))
         && celd_is_paper (CELD_AT (cells->canvas->ink, x + !south, y + south));
}

static bool
is_block_crossed (const CeldCells *cells, int column, int row)
{
  int left = cells->window.left + column * cells->size, top = cells->window.top + row * cells->size;

  for (int y = top; y < top + cells->size && y <= cells->window.bottom; y++)
    for (int x = left; x < left + cells->size && x <= cells->window.right; x++)
      if ((x < cells->window.right && is_crossed (cells, x, y, false))
          || (y < cells->window.bottom && is_crossed (cells, x, y, true)))
        return true;
  return false;
}

/* Are all pixels of the block fixed, or one node that keeps its label, as those of its neighbours are? */
static bool
is_quiet (const CeldCells *cells, int column, int row)
{
  for (int j = row; j <= row + 1 && j < cells->rows; j++)
    for (int i = column; i <= column + 1 && i < cells->columns; i++)
      {
        uint32_t block = cells->block[(size_t) j * (size_t) cells->columns + (size_t) i];

        if (block & CELD_CELL_FIXED)
          continue;
        if (block & CELD_CELL_MIXED || cells->label[block] != cells->present[block])
          return false;
      }
  return true;
}

/* fine[block]: blocks that a new border crosses on paper, and those round them.  Returns whether there are any. */
static bool
mark_fine (const CeldCells *cells, uint8_t *fine)
{
  bool any = false;

  memset (fine, 0, (size_t) cells->columns * (size_t) cells->rows);
  for (int row = 0; row < cells->rows; row++)
    for (int column = 0; column < cells->columns; column++)
      {
        if (is_quiet (cells, column, row) || !is_block_crossed (cells, column, row))
          continue;
        any = true;
        for (int j = row - 1; j <= row + 1; j++)
          for (int i = column - 1; i <= column + 1; i++)
            if (j >= 0 && j < cells->rows && i >= 0 && i < cells->columns)
              fine[(size_t) j * (size_t) cells->columns + (size_t) i] = 1;
      }
  return any;
}

/* ------------------------------------------------------------------ one window */

/* The label of a part. */
static uint32_t
label_of (const CeldCells *cells, uint32_t part)
{
  return part & CELD_CELL_FIXED ? part & ~CELD_CELL_FIXED : cells->label[part];
}

/* Pixels whose label is not that of their basin. */
static CeldStatus
add_patches (Solver *s, const CeldCells *cells)
{
  const CeldBasins *basins = s->canvas->basins;
  CeldStatus        status = CELD_OK;

  for (int y = cells->window.top; y <= cells->window.bottom; y++)
    {
      size_t i = basins->row[y];

      while (i + 1 < basins->row[y + 1] && basins->run[i + 1].x <= cells->window.left)
        i++;
      for (int x = cells->window.left; x <= cells->window.right && status == CELD_OK; x++)
        {
          uint32_t label = label_of (cells, celd_cell_at (cells, x, y));

          i += i + 1 < basins->row[y + 1] && basins->run[i + 1].x == x;
          if (label != s->label[basins->run[i].basin])
            status = celd_patch_add (&s->patches, (CeldPatch) { y, x, x + 1, label });
        }
    }
  return status;
}

static int
block_size (const CeldWindow *window)
{
  int64_t area = (int64_t) (window->right - window->left + 1) * (window->bottom - window->top + 1);
  int     size = 4;

  if (area <= PIXELS)
    return 1;
  while (area / (size * size) > BLOCKS && size < LARGEST)
    size *= 2;
  return size;
}

/* A second look with the blocks along new borders opened: *cells are replaced by those of the lower energy. */
static CeldStatus
refine (Solver *s, uint32_t id, int64_t energy, CeldCells *cells)
{
  uint8_t   *fine = celd_alloc ((size_t) cells->columns * (size_t) cells->rows, 1);
  CeldCells  finer = { .canvas = NULL };
  int64_t    lower = energy;
  CeldStatus status = fine ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && mark_fine (cells, fine))
    {
      status = celd_cells_new (s->canvas, s->label, s->free, id, &cells->window, cells->size, fine, &finer);
      if (status == CELD_OK)
        status = cut (s, &finer, &lower);
    }
  if (status == CELD_OK && lower < energy)
    {
      CeldCells swap = *cells;

      *cells = finer;
      finer  = swap;
    }
  celd_cells_clear (&finer);
  celd_free (fine);
  return status;
}

static CeldStatus
solve_window (Solver *s, uint32_t id, const CeldWindow *window, const uint32_t *basin)
{
  CeldCells  cells = { .canvas = NULL };
  int64_t    energy;
  CeldStatus status;

  for (size_t k = 0; k < window->n; k++)
    s->free[basin[window->first + k]] = id;
  status = celd_cells_new (s->canvas, s->label, s->free, id, window, block_size (window), NULL, &cells);
  if (status == CELD_OK && cells.n)
    {
      status = cut (s, &cells, &energy);
      if (status == CELD_OK && cells.size > 1)
        status = refine (s, id, energy, &cells);
    }
  if (status == CELD_OK)
    status = add_patches (s, &cells);
  celd_cells_clear (&cells);
  return status;
}

/* ------------------------------------------------------------------ the whole */

static CeldStatus
solve_windows (Solver *s, const CeldWindows *windows)
{
  size_t     n_labels = s->canvas->palette.n;
  CeldStatus status = CELD_NO_MEMORY;

  s->free   = celd_alloc0 (s->canvas->basins->n, sizeof *s->free);
  s->order  = celd_alloc (n_labels, sizeof *s->order);
  s->local  = celd_alloc (n_labels + 1, sizeof *s->local);
  s->global = celd_alloc (n_labels, sizeof *s->global);
  if (s->free && s->order && s->local && s->global)
    status = celd_canvas_order (s->canvas, s->order);
  for (size_t k = 0; k < windows->n && status == CELD_OK; k++)
    {
      status = solve_window (s, (uint32_t) k + 1, &windows->item[k], windows->basin);
      if (status == CELD_OK)
        status = celd_step (s->run, (double) (k + 1) / (double) windows->n);
    }
  celd_free (s->free);
  celd_free (s->order);
  celd_free (s->local);
  celd_free (s->global);
  return status;
}

CeldStatus
celd_windows_solve (const CeldCanvas *canvas, const uint32_t *label, const CeldRun *run, CeldPatches *patches)
{
  CeldWindows windows = { 0 };
  Solver      s = { .canvas = canvas, .label = label, .run = run };
  size_t      before = patches->n;
  CeldStatus  status = celd_windows_find (canvas, label, run, &windows);

  if (status == CELD_OK && windows.n)
    status = solve_windows (&s, &windows);
  for (size_t i = 0; i < s.patches.n && status == CELD_OK; i++)
    status = celd_patch_add (patches, s.patches.item[i]);
  if (status != CELD_OK)
    patches->n = before;
  celd_patches_clear (&s.patches);
  celd_windows_clear (&windows);
  return status;
}
