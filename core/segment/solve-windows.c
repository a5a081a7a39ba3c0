/* Strokes in basins of another label: the LazyBrush energy [SDC09b] minimised on pixels, in windows round them.
 *
 * A window's pixels are contracted to a graph (window-graph.c) and cut like the basin graph (partition.c).  Where a
 * boundary then crosses paper, the blocks along it are divided into pixels, and the window is cut once more.  Small
 * windows are pixels from the start, and each of their cuts is exact.  A result is accepted only if its energy is lower
 * than that of the basins' labels with hard seeds on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/basins.h"
#include "segment/labelling.h"
#include "segment/task.h"
#include "segment/windows.h"
#include "solve/partition.h"

#include <string.h>

#define WINDOW_PIXELS 4096 /* largest window that is solved on pixels (chosen) */
#define WINDOW_BLOCKS 4096 /* blocks of larger windows, approximately (chosen) */
#define LARGEST_BLOCK 5    /* largest block: 1 << so many pixels a side (chosen) */

typedef struct
{
  const CeldSegmentTask *task;
  const uint32_t        *label;  /* of each basin */
  const CeldHost        *host;
  uint32_t              *free;   /* of each basin: the last window, from 1, that it is free in */
  uint32_t              *order;  /* all labels in the order of cuts */
  uint32_t              *local;  /* of each label, from 1: its number in this window, or 0 */
  uint32_t              *global; /* of each such number, from 0: the label */
  int64_t               *votes;  /* of each label, from 1: the sum of its data costs here */
  CeldPatches            patches;
  size_t                 hint;   /* of celd_basin_run_at */
} WindowSolver;

/* ------------------------------------------------------------------ cutting a graph */

/* Numbers the labels that can occur in a graph from 1, in their order; returns how many there are.  A label that no
 * node has now, and whose data costs together are less than one edge of paper, cannot get paper. */
static size_t
number_labels (WindowSolver *s, const CeldWindowGraph *graph)
{
  int64_t paper = s->task->basins->costs.by_ink[CELD_INK_STEPS];
  size_t  n_labels = s->task->palette.n, n = 0;

  memset (s->votes, 0, (n_labels + 1) * sizeof *s->votes);
  for (size_t i = 0; i < graph->n_votes; i++)
    s->votes[graph->vote[i].label] += graph->vote[i].cost;
  for (size_t k = 0; k < graph->n; k++)
    s->votes[graph->present[k]] = paper;
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

/* Replaces the labels of data costs by their local numbers; those of other labels are constant and are dropped. */
static void
number_votes (const WindowSolver *s, CeldWindowGraph *graph)
{
  size_t n = 0;

  for (size_t i = 0; i < graph->n_votes; i++)
    {
      CeldVote vote = graph->vote[i];

      vote.label = s->local[vote.label];
      if (vote.label)
        graph->vote[n++] = vote;
    }
  graph->n_votes = n;
}

/* With two labels a single cut is the optimum. */
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

/* Sets the labels of the nodes: the present ones, unless others cost less (*better). */
static CeldStatus
cut (WindowSolver *s, CeldWindowGraph *graph, bool *better)
{
  size_t        n_labels = number_labels (s, graph);
  uint32_t     *order = celd_alloc (n_labels, sizeof *order), *present = celd_alloc (graph->n, sizeof *present);
  CeldHostPart  part;
  CeldHost      host = celd_host_part (&part, s->host, 0, 0);
  CeldPartition problem;
  CeldStatus    status = CELD_NO_MEMORY;

  if (!order || !present)
    goto done;
  for (size_t k = 0; k < n_labels; k++)
    order[k] = (uint32_t) k + 1;
  for (size_t k = 0; k < graph->n; k++)
    present[k] = s->local[graph->present[k]];
  number_votes (s, graph);
  problem = (CeldPartition) {
    graph->n, graph->link, graph->n_links, graph->vote, graph->n_votes, NULL, order, n_labels
  };
  status = n_labels == 2 ? cut_in_two (&problem, &host, graph->label)
                         : celd_partition (&problem, &host, graph->label, NULL, NULL);
  if (status != CELD_OK)
    goto done;
  *better = celd_partition_energy (&problem, graph->label) < celd_partition_energy (&problem, present);
  for (size_t k = 0; k < graph->n; k++)
    graph->label[k] = *better ? s->global[graph->label[k] - 1] : graph->present[k];

done:
  celd_free (order);
  celd_free (present);
  return status;
}

/* ------------------------------------------------------------------ refinement along new boundaries */

/* Marks the nodes on both sides of new boundaries across paper; are there any? */
static bool
mark_nodes (const CeldWindowGraph *graph, uint8_t *crossed)
{
  int64_t paper = graph->task->basins->costs.by_ink[CELD_INK_STEPS];
  bool    any = false;

  for (size_t i = 0; i < graph->n_links; i++)
    {
      const CeldLink *link = &graph->link[i];

      if (graph->label[link->a] == graph->label[link->b] || link->cost < paper)
        continue;
      crossed[link->a] = crossed[link->b] = 1;
      any = true;
    }
  return any;
}

/* fine[block]: does it hold a marked node? */
static void
mark_blocks (const CeldWindowGraph *graph, const uint8_t *crossed, uint8_t *fine)
{
  size_t area = (size_t) 1 << 2 * graph->shift;

  for (size_t k = 0; k < (size_t) graph->columns * (size_t) graph->rows; k++)
    {
      uint32_t        block = graph->block[k];
      const uint32_t *detail = graph->detail + (block & ~CELD_PART_MIXED) * area;

      fine[k] = 0;
      if (block & CELD_PART_FIXED || block == CELD_PART_ABOVE)
        continue;
      if (!(block & CELD_PART_MIXED))
        {
          fine[k] = crossed[block];
          continue;
        }
      for (size_t i = 0; i < area; i++)
        fine[k] |= !(detail[i] & CELD_PART_FIXED) && crossed[detail[i]];
    }
}

/* Solves again with finer blocks along new boundaries.  *finer stays empty if that is no better. */
static CeldStatus
refine (WindowSolver *s, const CeldWindowGraph *graph, CeldWindowGraph *finer)
{
  uint8_t   *crossed = celd_alloc0 (graph->n, 1);
  uint8_t   *fine = celd_alloc ((size_t) graph->columns * (size_t) graph->rows, 1);
  bool       better = false;
  CeldStatus status = crossed && fine ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && mark_nodes (graph, crossed))
    {
      mark_blocks (graph, crossed, fine);
      status = celd_window_graph_refine (graph, fine, finer);
      if (status == CELD_OK)
        status = cut (s, finer, &better);
    }
  if (!better)
    celd_window_graph_clear (finer);
  celd_free (crossed);
  celd_free (fine);
  return status;
}

/* ------------------------------------------------------------------ one window */

/* Can a pixel of the block have another label than its basin? */
static bool
is_changed (const CeldWindowGraph *graph, size_t k)
{
  uint32_t        block = graph->block[k];
  size_t          area = (size_t) 1 << 2 * graph->shift;
  const uint32_t *detail = graph->detail + (block & ~CELD_PART_MIXED) * area;

  if (block == CELD_PART_ABOVE)
    return graph->coarse && is_changed (graph->coarse, k);
  if (block & CELD_PART_FIXED)
    return false;
  if (!(block & CELD_PART_MIXED))
    return graph->label[block] != graph->present[block];
  if (graph->hard[k] || graph->coarse)
    return true;
  for (size_t i = 0; i < area; i++)
    if (!(detail[i] & CELD_PART_FIXED) && graph->label[detail[i]] != graph->present[detail[i]])
      return true;
  return false;
}

/* Adds patches for the pixels x .. end - 1 of row y whose label is not that of their basin. */
static CeldStatus
add_patch (WindowSolver *s, const CeldWindowGraph *graph, int y, int x, int end)
{
  const CeldBasins *basins = s->task->basins;
  size_t            i = celd_basin_run_at (basins, y, x, &s->hint);
  CeldStatus        status = CELD_OK;

  for (; x < end && status == CELD_OK; x++)
    {
      uint32_t label = celd_window_part_label (graph, celd_window_part_at (graph, x, y));

      i += i + 1 < basins->row[y + 1] && basins->run[i + 1].x == x;
      if (label != s->label[basins->run[i].basin])
        status = celd_patch_add (&s->patches, (CeldPatch) { y, x, x + 1, label });
    }
  return status;
}

static CeldStatus
add_patches (WindowSolver *s, const CeldWindowGraph *graph)
{
  const CeldWindow *window = &graph->window;
  size_t            n = (size_t) graph->columns * (size_t) graph->rows;
  bool             *changed = celd_alloc (n, sizeof *changed);
  CeldStatus        status = changed ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < n && status == CELD_OK; k++)
    changed[k] = is_changed (graph, k);
  for (int y = window->top; y <= window->bottom; y++)
    for (int column = 0; column < graph->columns && status == CELD_OK; column++)
      {
        int x = window->left + (column << graph->shift), end = x + (1 << graph->shift);

        if (changed[(size_t) ((y - window->top) >> graph->shift) * (size_t) graph->columns + (size_t) column])
          status = add_patch (s, graph, y, x, end <= window->right ? end : window->right + 1);
      }
  celd_free (changed);
  return status;
}

static int
block_shift (const CeldWindow *window)
{
  int64_t area = (int64_t) (window->right - window->left + 1) * (window->bottom - window->top + 1);
  int     shift = 2;

  if (area <= WINDOW_PIXELS)
    return 0;
  while (area >> 2 * shift > WINDOW_BLOCKS && shift < LARGEST_BLOCK)
    shift++;
  return shift;
}

/* Shrinks a window to the free pixels and a margin of one pixel. */
static CeldWindow
trim (const WindowSolver *s, uint32_t id, const CeldWindow *window)
{
  const CeldBasins *basins = s->task->basins;
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
solve_window (WindowSolver *s, uint32_t id, const CeldWindow *found, const uint32_t *basin)
{
  CeldWindowGraph graph = { .task = NULL }, finer = { .task = NULL };
  CeldWindow      window;
  bool            better = false;
  CeldStatus      status;

  for (size_t k = 0; k < found->n; k++)
    s->free[basin[found->first + k]] = id;
  window = trim (s, id, found);
  status = celd_window_graph_new (s->task, s->label, s->free, id, &window, block_shift (&window), &graph);
  if (status == CELD_OK && graph.n)
    status = cut (s, &graph, &better);
  if (status == CELD_OK && better && graph.shift)
    status = refine (s, &graph, &finer);
  if (status == CELD_OK)
    status = add_patches (s, finer.block ? &finer : &graph);
  celd_window_graph_clear (&finer);
  celd_window_graph_clear (&graph);
  return status;
}

/* ------------------------------------------------------------------ the whole */

static CeldStatus
solve_windows (WindowSolver *s, const CeldWindows *windows)
{
  size_t     n_labels = s->task->palette.n;
  CeldStatus status = CELD_NO_MEMORY;

  s->free   = celd_alloc0 (s->task->basins->n, sizeof *s->free);
  s->order  = celd_alloc (n_labels, sizeof *s->order);
  s->local  = celd_alloc (n_labels + 1, sizeof *s->local);
  s->global = celd_alloc (n_labels, sizeof *s->global);
  s->votes  = celd_alloc (n_labels + 1, sizeof *s->votes);
  if (s->free && s->order && s->local && s->global && s->votes)
    status = celd_task_label_order (s->task, s->order);
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
celd_windows_solve (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host, CeldPatches *patches)
{
  CeldWindows  windows = { 0 };
  WindowSolver s = { .task = task, .label = label, .host = host };
  size_t       before = patches->n;
  CeldStatus   status = celd_windows_find (task, label, host, &windows);

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
