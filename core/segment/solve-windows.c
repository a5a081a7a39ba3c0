/* The LazyBrush energy [SDC09b] minimised on pixels, in windows: round strokes that lie in basins of another label, and
 * round gaps that a boundary crosses.
 *
 * A window's pixels are contracted to a graph (window-graph.c) and cut like the basin graph (partition.c).  Where a
 * boundary then crosses paper, the blocks along it are divided into pixels, and the window is cut once more.  Small
 * windows, and those round gaps, are pixels from the start, and each of their cuts is exact.  A result is accepted only
 * if its energy is lower than that of the present labels, with hard seeds on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/task.h"

#define WINDOW_PIXELS 4096 /* largest window that is solved on pixels (chosen) */
#define WINDOW_BLOCKS 4096 /* blocks of larger windows, approximately (chosen) */
#define LARGEST_BLOCK 5    /* largest block: 1 << so many pixels a side (chosen) */

#define GAP_DISTANCE    3         /* pixels between boundaries across paper that share a window (chosen) */
#define GAP_MARGIN      6         /* pixels round a gap, besides a stroke width and half the gap (chosen) */
#define MOST_GAP_PIXELS (1 << 18) /* pixels of a window: larger ones are no gaps (chosen) */

typedef struct
{
  const CeldSegmentTask *task;
  const uint32_t        *label;  /* of each basin */
  uint32_t              *free;   /* of each basin: the last window, from 1, that it is free in */
  int64_t                paper;  /* cost of a pair of paper */
  CeldWindowCutter       cutter;
  CeldPatches            patches;
  size_t                 hint;   /* of celd_basin_run_at */
} WindowSolver;

/* ------------------------------------------------------------------ refinement along new boundaries */

/* Marks the nodes on both sides of new boundaries across paper; are there any? */
static bool
mark_crossed (const CeldPixelGraph *graph, const uint32_t *label, bool *crossed)
{
  int64_t paper = graph->task->basins->costs.by_ink[CELD_INK_STEPS];
  bool    any = false;

  for (size_t i = 0; i < graph->n_links; i++)
    {
      const CeldLink *link = &graph->link[i];

      if (label[link->a] == label[link->b] || link->cost < paper)
        continue;
      crossed[link->a] = crossed[link->b] = true;
      any = true;
    }
  return any;
}

/* Solves again with finer blocks along new boundaries.  *label are the labels of the nodes before and after. */
static CeldStatus
refine (WindowSolver *s, CeldPixelGraph *graph, uint32_t **label)
{
  bool      *crossed = celd_alloc0 (graph->n, sizeof *crossed), better;
  CeldStatus status = crossed ? CELD_OK : CELD_NO_MEMORY;

  if (status == CELD_OK && mark_crossed (graph, *label, crossed))
    {
      status = celd_window_graph_refine (graph, *label, crossed);
      celd_free (*label);
      *label = NULL;
      if (status == CELD_OK)
        status = celd_window_cut (&s->cutter, graph, s->paper, label, &better);
    }
  celd_free (crossed);
  return status;
}

/* ------------------------------------------------------------------ one window */

/* Adds patches for the pixels whose label is not that of their basin. */
static CeldStatus
add_patches (WindowSolver *s, const CeldPixelGraph *graph, const uint32_t *label)
{
  const CeldBasins *basins = s->task->basins;
  const uint32_t   *part = graph->part;
  int               left = graph->box.x, right = left + graph->box.width;
  CeldStatus        status = CELD_OK;

  for (int y = graph->box.y; y < graph->box.y + graph->box.height; y++)
    {
      size_t i = celd_basin_run_at (basins, y, left, &s->hint);

      for (int x = left; x < right && status == CELD_OK; i++)
        {
          uint32_t present = s->label[basins->run[i].basin];
          int      run_end = celd_basin_run_end (basins, i, y), end = run_end < right ? run_end : right;

          for (; x < end && status == CELD_OK; x++, part++)
            {
              uint32_t own = *part & CELD_PART_FIXED ? *part & ~CELD_PART_FIXED : label[*part];

              if (own != present)
                status = celd_patch_add (&s->patches, (CeldPatch) { y, x, x + 1, own });
            }
        }
    }
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
  CeldPresentLabels present = { .label = s->label, .free = s->free, .id = id };
  CeldPixelGraph    graph;
  CeldWindow        window;
  uint32_t         *label = NULL;
  int               shift;
  bool              better = false;
  CeldStatus        status;

  for (size_t k = 0; k < found->n; k++)
    s->free[basin[found->first + k]] = id;
  window = trim (s, id, found);
  shift  = block_shift (&window);
  status = celd_window_graph_new (s->task, &present, (CeldRect) { window.left, window.top,
                                                                  window.right - window.left + 1,
                                                                  window.bottom - window.top + 1 }, shift, &graph);
  if (status == CELD_OK && graph.n)
    status = celd_window_cut (&s->cutter, &graph, s->paper, &label, &better);
  if (status == CELD_OK && better && shift)
    status = refine (s, &graph, &label);
  if (status == CELD_OK)
    status = add_patches (s, &graph, label);
  celd_free (label);
  celd_pixel_graph_clear (&graph);
  return status;
}

/* ------------------------------------------------------------------ the whole */

static CeldStatus
solve_windows (WindowSolver *s, const CeldWindows *windows, const CeldHost *host)
{
  CeldStatus status = celd_window_cutter_new (s->task, host, &s->cutter);

  s->free = celd_alloc0 (s->task->basins->n, sizeof *s->free);
  if (!s->free)
    status = CELD_NO_MEMORY;
  for (size_t k = 0; k < windows->n && status == CELD_OK; k++)
    {
      status = solve_window (s, (uint32_t) k + 1, &windows->item[k], windows->basin);
      if (status == CELD_OK)
        status = celd_progress (host, (double) (k + 1) / (double) windows->n);
    }
  celd_free (s->free);
  celd_window_cutter_clear (&s->cutter);
  return status;
}

CeldStatus
celd_windows_solve (const CeldSegmentTask *task, const uint32_t *label, const CeldHost *host, CeldPatches *patches)
{
  CeldWindows  windows = { 0 };
  WindowSolver s = { .task = task, .label = label, .paper = task->basins->costs.by_ink[CELD_INK_STEPS] };
  size_t       before = patches->n;
  CeldStatus   status = celd_windows_find (task, label, host, &windows);

  if (status == CELD_OK && windows.n)
    status = solve_windows (&s, &windows, host);
  for (size_t i = 0; i < s.patches.n && status == CELD_OK; i++)
    status = celd_patch_add (patches, s.patches.item[i]);
  if (status != CELD_OK)
    patches->n = before;
  celd_patches_clear (&s.patches);
  celd_windows_clear (&windows);
  return status;
}

/* ------------------------------------------------------------------ boundaries across gaps */

typedef struct
{
  const CeldSegmentTask *task;
  const int32_t         *to_paper;
  CeldLabels            *labels;
  CeldPatches           *patches;
  CeldWindowCutter       cutter;
} GapSolver;

typedef struct { int left, top, right, bottom; } GapBox; /* inclusive */
typedef struct { GapBox *item; size_t n, item_capacity; } GapBoxes;

static int
least (int a, int b)
{
  return a < b ? a : b;
}

static int
most (int a, int b)
{
  return a > b ? a : b;
}

/* Adds a pixel to a box nearby, or to a new one. */
static CeldStatus
add_gap (int x, int y, GapBoxes *boxes)
{
  for (size_t i = 0; i < boxes->n; i++)
    {
      GapBox *b = &boxes->item[i];

      if (x < b->left - GAP_DISTANCE || x > b->right + GAP_DISTANCE || y < b->top - GAP_DISTANCE || y > b->bottom +
          GAP_DISTANCE)
        continue;
      *b = (GapBox) { least (b->left, x), least (b->top, y), most (b->right, x), most (b->bottom, y) };
      return CELD_OK;
    }
  return celd_append (boxes->item, boxes->n, boxes->item_capacity, (GapBox) { x, y, x, y });
}

/* Is the edge a boundary across paper? */
static bool
is_gap (const GapSolver *s, int x, int y, bool south)
{
  int x2 = x + !south, y2 = y + south;

  return x2 < s->labels->width && y2 < s->labels->height && CELD_AT (s->labels, x, y) != CELD_AT (s->labels, x2, y2) &&
         celd_is_paper (CELD_AT (s->task->ink, x, y)) && celd_is_paper (CELD_AT (s->task->ink, x2, y2));
}

static CeldStatus
find_gaps (const GapSolver *s, GapBoxes *boxes)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < s->labels->height && status == CELD_OK; y++)
    for (int x = 0; x < s->labels->width && status == CELD_OK; x++)
      if (is_gap (s, x, y, false) || is_gap (s, x, y, true))
        status = add_gap (x, y, boxes);
  return status;
}

/* The window of a gap, with the pixels around it that stay as they are. */
static CeldRect
widen (const GapSolver *s, GapBox b)
{
  int margin = GAP_MARGIN + s->task->basins->stroke + most (b.right - b.left, b.bottom - b.top) / 2 + 1;
  int left = most (b.left - margin, 0), top = most (b.top - margin, 0);

  return (CeldRect) { left, top, least (b.right + margin, s->labels->width - 1) - left + 1,
                      least (b.bottom + margin, s->labels->height - 1) - top + 1 };
}

static CeldStatus
solve_gap (GapSolver *s, CeldRect box)
{
  CeldPresentLabels present = { .picture = s->labels, .to_paper = s->to_paper };
  CeldPixelGraph    graph;
  uint32_t         *label = NULL, *part;
  bool              better = false;
  CeldStatus        status = celd_window_graph_new (s->task, &present, box, 0, &graph);

  if (status == CELD_OK && graph.n)
    status = celd_window_cut (&s->cutter, &graph, 1, &label, &better);
  part = graph.part;
  for (int y = box.y; y < box.y + box.height && better; y++)
    for (int x = box.x; x < box.x + box.width && status == CELD_OK; x++, part++)
      if (!(*part & CELD_PART_FIXED) && label[*part] != graph.node[*part].value)
        {
          CELD_AT (s->labels, x, y) = label[*part];
          status = celd_patch_add (s->patches, (CeldPatch) { y, x, x + 1, label[*part] });
        }
  celd_free (label);
  celd_pixel_graph_clear (&graph);
  return status;
}

CeldStatus
celd_gaps_solve (const CeldSegmentTask *task, const int32_t *to_paper, const CeldHost *host, CeldLabels *labels,
                 CeldPatches *patches)
{
  GapSolver  s = { .task = task, .to_paper = to_paper, .labels = labels, .patches = patches };
  GapBoxes   boxes = { 0 };
  CeldStatus status = celd_window_cutter_new (task, host, &s.cutter);

  if (status == CELD_OK)
    status = find_gaps (&s, &boxes);
  for (size_t i = 0; i < boxes.n && status == CELD_OK; i++)
    {
      CeldRect box = widen (&s, boxes.item[i]);

      if ((int64_t) box.width * box.height <= MOST_GAP_PIXELS)
        status = solve_gap (&s, box);
    }
  celd_free (boxes.item);
  celd_window_cutter_clear (&s.cutter);
  return status;
}
