/* The pixels of a window as the builder of its graph needs them: their labels, what is fixed, ink, and seeds.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "segment/windows.h"
#include "solve/maxflow.h"

#include <string.h>

#define PAPER 0.75f /* ink value from which on a pixel is white paper, which a boundary should not cross (chosen) */

/* Reads labels from basins.  The outermost pixels of the window are fixed, except at the frame. */
static void
read_basins (CeldWindowBuilder *b, int y, uint32_t *state)
{
  const CeldWindow *w = &b->graph->window;
  const CeldBasins *basins = b->graph->task->basins;
  bool              rim = (y == w->top && y > 0) || (y == w->bottom && y + 1 < basins->height);
  size_t            i = celd_basin_run_at (basins, y, w->left, &b->hint);

  for (int x = w->left, end; x <= w->right; x = end, i++)
    {
      uint32_t basin = basins->run[i].basin;
      uint32_t here = b->graph->basin_label[basin] | (rim || b->free[basin] != b->id ? CELD_PART_FIXED : 0);

      end = celd_basin_run_end (basins, i, y);
      end = end <= w->right ? end : w->right + 1;
      for (int k = x; k < end; k++)
        state[k - w->left] = here;
    }
  if (w->left > 0)
    state[0] |= CELD_PART_FIXED;
  if (w->right + 1 < basins->width)
    state[w->right - w->left] |= CELD_PART_FIXED;
}

/* Adds the kind of ink to states that are not fixed. */
static void
read_ink (const CeldWindowBuilder *b, int y, int x, int end, uint32_t *state)
{
  const float *ink = &CELD_AT (b->graph->task->ink, b->graph->window.left, y);

  for (int i = x; i < end; i++)
    state[i] += CELD_PART_KIND_INK * ((uint32_t) (ink[i] < PAPER) + (uint32_t) (ink[i] < b->dark)) *
                (1 - (state[i] >> 31));
}

/* A hard seed on pixel k of a row.  Pixels that are not free belong to other windows. */
static inline void
read_hard_seed (const CeldWindowBuilder *b, uint32_t label, int k, uint32_t *state)
{
  if (*state & CELD_PART_FIXED)
    return;
  if ((*state & CELD_PART_LABELS) != label)
    b->hard[k >> b->graph->shift] = true;
  *state = CELD_PART_FIXED | label;
}

static void
read_paint (const CeldWindowBuilder *b, int y, uint32_t *state, uint32_t *paint)
{
  const CeldSegmentTask *task = b->graph->task;
  const CeldWindow      *w = &b->graph->window;
  const CeldSeedRow     *row = &task->seeds.row[y];
  size_t                 low = 0, high = row->n;

  memset (paint, 0, (size_t) celd_window_width (b->graph) * sizeof *paint);
  while (low < high)
    {
      size_t middle = low + (high - low) / 2;

      if (row->run[middle].end <= w->left)
        low = middle + 1;
      else
        high = middle;
    }
  for (size_t i = low; i < row->n && row->run[i].x <= w->right; i++)
    {
      uint32_t l = row->run[i].label;
      bool     hard = celd_task_data_cost (task, l) == CELD_HARD;
      int      x = row->run[i].x > w->left ? row->run[i].x - w->left : 0;
      int      end = (row->run[i].end <= w->right ? row->run[i].end : w->right + 1) - w->left;

      for (int k = x; k < end; k++)
        if (hard)
          read_hard_seed (b, l, k, &state[k]);
        else
          paint[k] = l;
      for (int k = x >> b->graph->shift; k <= (end - 1) >> b->graph->shift && !hard; k++)
        b->painted[k] = true;
    }
}

/* Reads the labels found on the coarser graph as the present ones. */
static void
read_coarse (const CeldWindowBuilder *b, int y, int x, int end, uint32_t *state)
{
  const CeldWindowGraph *coarse = b->graph->coarse;

  for (int i = x; i < end; i++)
    {
      uint32_t part = celd_window_part_at (coarse, coarse->window.left + i, y);

      state[i] = (part & CELD_PART_FIXED) | celd_window_part_label (coarse, part);
    }
  read_ink (b, y, x, end, state);
}

void
celd_window_read (CeldWindowBuilder *b, int y, uint32_t *state, uint32_t *paint)
{
  read_basins (b, y, state);
  read_ink (b, y, 0, celd_window_width (b->graph), state);
  read_paint (b, y, state, paint);
}

void
celd_window_read_fine (CeldWindowBuilder *b, int y, const uint8_t *fine, uint32_t *state, uint32_t *paint)
{
  const CeldWindowGraph *graph = b->graph;
  int                    w = celd_window_width (graph);

  for (int k = 0; k < graph->columns; k++)
    if (fine[k])
      read_coarse (b, y, k << graph->shift, (k + 1) << graph->shift < w ? (k + 1) << graph->shift : w, state);
  read_paint (b, y, state, paint);
}
