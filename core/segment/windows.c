/* Strokes in basins of another label: the LazyBrush energy [SDC09b] solved on pixels, in windows round them.
 *
 * A window's pixels are contracted to a graph (window-cells.c) and cut like the basin graph (partition.c); where a
 * border then runs across paper the blocks along it are opened to pixels, and the window is cut once more.  Small
 * windows are pixels from the start, and exact for each cut.  An answer is taken only if its energy is lower than that
 * of the basins' labels with hard paint on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/painting.h"
#include "segment/windows.h"
#include "solve/partition.h"

#include <string.h>

#define PIXELS  4096            /* a window of so many is solved on pixels */
#define BLOCKS  4096            /* larger ones on about so many blocks, */
#define LARGEST 5               /* of at most 1 << so many pixels a side */

typedef struct
{
  const CeldCanvas *canvas;
  const uint32_t   *label;      /* of each basin */
  const CeldHost   *host;
  uint32_t         *free;       /* of each basin: the last window, from 1, in which it is free */
  uint32_t         *order;      /* all labels, as they are told apart */
  uint32_t         *local;      /* of each label, from 1: its place among those of this window, 0 if it is not there */
  uint32_t         *global;     /* the other way round, from 0 */
  int64_t          *votes;      /* of each label, from 1: the sum of its votes in this window */
  CeldPatches       patches;
  size_t            hint;       /* of celd_basin_run_at */
} Solver;

/* ------------------------------------------------------------------ cutting a graph */

/* Numbers the labels that matter to a graph from 1, in their order; returns how many there are.  A label that no node
 * has, and whose votes together pay for no edge of paper, gets no paper. */
static size_t
number_labels (Solver *s, const CeldWindowCells *cells)
{
  int64_t paper = s->canvas->basins->costs.by_ink[CELD_INK_STEPS];
  size_t  n_labels = s->canvas->palette.n, n = 0;

  memset (s->votes, 0, (n_labels + 1) * sizeof *s->votes);
  for (size_t i = 0; i < cells->n_votes; i++)
    s->votes[cells->vote[i].label] += cells->vote[i].cost;
  for (size_t k = 0; k < cells->n; k++)
    s->votes[cells->present[k]] = paper;
  for (size_t i = 0; i < n_labels; i++)
    {
      uint32_t label = s->order[i];

      s->local[label] = 0;
      if (s->votes[label] < paper)
        continue;
      s->global[n]    = label;
      s->local[label] = (uint32_t) ++n;
    }
  return n;
}

/* Votes for the labels of this graph, by their local numbers; others are lost whatever happens. */
static void
number_votes (const Solver *s, CeldWindowCells *cells)
{
  size_t n = 0;

  for (size_t i = 0; i < cells->n_votes; i++)
    {
      CeldVote vote = cells->vote[i];

      vote.label = s->local[vote.label];
      if (vote.label)
        cells->vote[n++] = vote;
    }
  cells->n_votes = n;
}

/* With two labels one cut is all there is to do. */
static CeldStatus
cut_in_two (const CeldPartition *problem, const CeldHost *host, uint32_t *label)
{
  int64_t   *terminal = celd_alloc0 (problem->n, sizeof *terminal);
  uint8_t   *side = celd_alloc (problem->n, 1);
  CeldStatus status = CELD_NO_MEMORY;

  if (!terminal || !side)
    goto done;
  for (size_t i = 0; i < problem->n_votes; i++)
    terminal[problem->vote[i].node] += problem->vote[i].label == 1 ? problem->vote[i].cost : -problem->vote[i].cost;
  status = celd_flow (problem->n, problem->link, problem->n_links, terminal, host, side, NULL);
  for (size_t k = 0; k < problem->n && status == CELD_OK; k++)
    label[k] = side[k] ? 1 : 2;

done:
  celd_free (terminal);
  celd_free (side);
  return status;
}

/* The labels of the graph's nodes: their present ones, unless others cost less.  *better: do they? */
static CeldStatus
cut (Solver *s, CeldWindowCells *cells, bool *better)
{
  size_t        n_labels = number_labels (s, cells);
  uint32_t     *order = celd_alloc (n_labels, sizeof *order), *present = celd_alloc (cells->n, sizeof *present);
  CeldHostPart      part;
  CeldHost      host = celd_host_part (&part, s->host, 0, 0);
  CeldPartition problem;
  CeldStatus    status = CELD_NO_MEMORY;

  if (!order || !present)
    goto done;
  for (size_t k = 0; k < n_labels; k++)
    order[k] = (uint32_t) k + 1;
  for (size_t k = 0; k < cells->n; k++)
    present[k] = s->local[cells->present[k]];
  number_votes (s, cells);
  problem = (CeldPartition) {
    cells->n, cells->link, cells->n_links, cells->vote, cells->n_votes, NULL, order, n_labels
  };
  status = n_labels == 2 ? cut_in_two (&problem, &host, cells->label)
                         : celd_partition (&problem, &host, cells->label, NULL, NULL);
  if (status != CELD_OK)
    goto done;
  *better = celd_partition_energy (&problem, cells->label) < celd_partition_energy (&problem, present);
  for (size_t k = 0; k < cells->n; k++)
    cells->label[k] = *better ? s->global[cells->label[k] - 1] : cells->present[k];

done:
  celd_free (order);
  celd_free (present);
  return status;
}

/* ------------------------------------------------------------------ where a closer look is wanted */

/* Marks the nodes on both sides of a new border, where it runs across paper.  Returns whether there are any. */
static bool
mark_nodes (const CeldWindowCells *cells, uint8_t *crossed)
{
  int64_t paper = cells->canvas->basins->costs.by_ink[CELD_INK_STEPS];
  bool    any = false;

  for (size_t i = 0; i < cells->n_links; i++)
    {
      const CeldLink *link = &cells->link[i];

      if (cells->label[link->a] == cells->label[link->b] || link->cost < paper)
        continue;
      crossed[link->a] = crossed[link->b] = 1;
      any = true;
    }
  return any;
}

/* fine[block]: does it hold a marked node? */
static void
mark_blocks (const CeldWindowCells *cells, const uint8_t *crossed, uint8_t *fine)
{
  size_t area = (size_t) 1 << 2 * cells->shift;

  for (size_t k = 0; k < (size_t) cells->columns * (size_t) cells->rows; k++)
    {
      uint32_t        block = cells->block[k];
      const uint32_t *detail = cells->detail + (block & ~CELD_CELL_MIXED) * area;

      fine[k] = 0;
      if (block & CELD_CELL_FIXED || block == CELD_CELL_ABOVE)
        continue;
      if (!(block & CELD_CELL_MIXED))
        {
          fine[k] = crossed[block];
          continue;
        }
      for (size_t i = 0; i < area; i++)
        fine[k] |= !(detail[i] & CELD_CELL_FIXED) && crossed[detail[i]];
    }
}

/* Looks again at the blocks along new borders.  *finer is left empty where that is no better. */
static CeldStatus
refine (Solver *s, const CeldWindowCells *cells, CeldWindowCells *finer)
{
  uint8_t   *crossed = celd_alloc0 (cells->n, 1);
  uint8_t   *fine = celd_alloc ((size_t) cells->columns * (size_t) cells->rows, 1);
  bool       better = false;
  CeldStatus status = crossed && fine ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && mark_nodes (cells, crossed))
    {
      mark_blocks (cells, crossed, fine);
      status = celd_cells_refine (cells, fine, finer);
      if (status == CELD_OK)
        status = cut (s, finer, &better);
    }
  if (!better)
    celd_cells_clear (finer);
  celd_free (crossed);
  celd_free (fine);
  return status;
}

/* ------------------------------------------------------------------ one window */

/* Could a pixel of the block have another label than its basin? */
static bool
is_changed (const CeldWindowCells *cells, size_t k)
{
  uint32_t        block = cells->block[k];
  size_t          area = (size_t) 1 << 2 * cells->shift;
  const uint32_t *detail = cells->detail + (block & ~CELD_CELL_MIXED) * area;

  if (block == CELD_CELL_ABOVE)
    return cells->coarse && is_changed (cells->coarse, k);
  if (block & CELD_CELL_FIXED)
    return false;
  if (!(block & CELD_CELL_MIXED))
    return cells->label[block] != cells->present[block];
  if (cells->hard[k] || cells->coarse)
    return true;
  for (size_t i = 0; i < area; i++)
    if (!(detail[i] & CELD_CELL_FIXED) && cells->label[detail[i]] != cells->present[detail[i]])
      return true;
  return false;
}

/* Pixels x .. end - 1 of row y whose label is not that of their basin. */
static CeldStatus
add_patch (Solver *s, const CeldWindowCells *cells, int y, int x, int end)
{
  const CeldBasins *basins = s->canvas->basins;
  size_t            i = celd_basin_run_at (basins, y, x, &s->hint);
  CeldStatus        status = CELD_OK;

  for (; x < end && status == CELD_OK; x++)
    {
      uint32_t label = celd_cell_label (cells, celd_cell_at (cells, x, y));

      i += i + 1 < basins->row[y + 1] && basins->run[i + 1].x == x;
      if (label != s->label[basins->run[i].basin])
        status = celd_patch_add (&s->patches, (CeldPatch) { y, x, x + 1, label });
    }
  return status;
}

static CeldStatus
add_patches (Solver *s, const CeldWindowCells *cells)
{
  const CeldWindow *window = &cells->window;
  size_t            n = (size_t) cells->columns * (size_t) cells->rows;
  bool             *changed = celd_alloc (n, sizeof *changed);
  CeldStatus        status = changed ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < n && status == CELD_OK; k++)
    changed[k] = is_changed (cells, k);
  for (int y = window->top; y <= window->bottom; y++)
    for (int column = 0; column < cells->columns && status == CELD_OK; column++)
      {
        int x = window->left + (column << cells->shift), end = x + (1 << cells->shift);

        if (changed[(size_t) ((y - window->top) >> cells->shift) * (size_t) cells->columns + (size_t) column])
          status = add_patch (s, cells, y, x, end <= window->right ? end : window->right + 1);
      }
  celd_free (changed);
  return status;
}

static int
block_shift (const CeldWindow *window)
{
  int64_t area = (int64_t) (window->right - window->left + 1) * (window->bottom - window->top + 1);
  int     shift = 2;

  if (area <= PIXELS)
    return 0;
  while (area >> 2 * shift > BLOCKS && shift < LARGEST)
    shift++;
  return shift;
}

/* Cuts the window to the pixels of its basins, and those round them. */
static CeldWindow
trim (const Solver *s, uint32_t id, const CeldWindow *window)
{
  const CeldBasins *basins = s->canvas->basins;
  CeldWindow        inner = *window;
  size_t            hint = 0;

  inner.left   = window->right;
  inner.top    = window->bottom;
  inner.right  = window->left;
  inner.bottom = window->top;
  for (int y = window->top; y <= window->bottom; y++)
    for (size_t i = celd_basin_run_at (basins, y, window->left, &hint);
         i < basins->row[y + 1] && basins->run[i].x <= window->right; i++)
      {
        int x = basins->run[i].x, end = celd_basin_run_end (basins, i, y);

        if (s->free[basins->run[i].basin] != id)
          continue;
        inner.left   = x - 1 < inner.left ? x - 1 : inner.left;
        inner.right  = end > inner.right ? end : inner.right;
        inner.top    = y - 1 < inner.top ? y - 1 : inner.top;
        inner.bottom = y + 1;
      }
  inner.left   = inner.left > window->left ? inner.left : window->left;
  inner.top    = inner.top > window->top ? inner.top : window->top;
  inner.right  = inner.right < window->right ? inner.right : window->right;
  inner.bottom = inner.bottom < window->bottom ? inner.bottom : window->bottom;
  return inner;
}

static CeldStatus
solve_window (Solver *s, uint32_t id, const CeldWindow *place, const uint32_t *basin)
{
  CeldWindowCells  cells = { .canvas = NULL }, finer = { .canvas = NULL };
  CeldWindow window;
  bool       better = false;
  CeldStatus status;

  for (size_t k = 0; k < place->n; k++)
    s->free[basin[place->first + k]] = id;
  window = trim (s, id, place);
  status = celd_cells_new (s->canvas, s->label, s->free, id, &window, block_shift (&window), &cells);
  if (status == CELD_OK && cells.n)
    status = cut (s, &cells, &better);
  if (status == CELD_OK && better && cells.shift)
    status = refine (s, &cells, &finer);
  if (status == CELD_OK)
    status = add_patches (s, finer.block ? &finer : &cells);
  celd_cells_clear (&finer);
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
  s->votes  = celd_alloc (n_labels + 1, sizeof *s->votes);
  if (s->free && s->order && s->local && s->global && s->votes)
    status = celd_canvas_order (s->canvas, s->order);
  for (size_t k = 0; k < windows->n && status == CELD_OK; k++)
    {
      status = solve_window (s, (uint32_t) k + 1, &windows->item[k], windows->basin);
      if (status == CELD_OK)
        status = celd_progress (s->host, (double) (k + 1) / (double) windows->n);
    }
  celd_free (s->free);
  celd_free (s->order);
  celd_free (s->local);
  celd_free (s->global);
  celd_free (s->votes);
  return status;
}

CeldStatus
celd_windows_solve (const CeldCanvas *canvas, const uint32_t *label, const CeldHost *host, CeldPatches *patches)
{
  CeldWindows windows = { 0 };
  Solver      s = { .canvas = canvas, .label = label, .host = host };
  size_t      before = patches->n;
  CeldStatus  status = celd_windows_find (canvas, label, host, &windows);

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
