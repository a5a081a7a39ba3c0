/* The graph of a window, and its cut: pixels of paper, faint ink and dark ink are nodes of their own; so is each label
 * of seeds, and each present label.
 *
 * Boundaries in ink cost next to nothing, so connected ink in a block can be a node.  What is fixed (other basins, hard
 * seeds, the window's outermost pixels) is no node.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/task.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#include <string.h>

#define PAPER       0.75f       /* ink value from which on a pixel is white paper, which a boundary should not cross
                                * (chosen) */
#define DARK        (1 / 128.0) /* of the cost of paper: a pair of dark ink costs no more (chosen) */
#define FINER_PAPER 2           /* a block of paper is divided into 4 x 4 cells (chosen) */
#define FINER_INK   3           /* others into 8 x 8, and their ink (chosen) */

/* ------------------------------------------------------------------ costs */

/* The present label of the pixels of a part. */
static uint32_t
present_label (const CeldPixelGraph *graph, uint32_t part)
{
  return part & CELD_PART_FIXED ? part & ~CELD_PART_FIXED : graph->node[part].value;
}

/* In blocks ink counts as cheap as possible along present boundaries and as dear as possible elsewhere: an improvement
 * by these costs is one by the true costs, and no distance to paper needs to be measured. */
static int32_t
bound_to_paper (const CeldPixelGraph *graph, uint32_t a, uint32_t b)
{
  return present_label (graph, a) == present_label (graph, b) ? 0 : CELD_MOST_TO_PAPER;
}

/* ------------------------------------------------------------------ states of pixels */

/* Of the pixels in a row of blocks, with their present labels as values; ink gets the flags of its kind. */
typedef struct
{
  const CeldPixelGraph    *graph;
  const CeldPresentLabels *present;
  bool                     blocks; /* can a node be more than a pixel? */
  float                    dark;   /* ink below this value is dark */
  size_t                   hint;   /* of celd_basin_run_at */
  uint64_t                *state;
} Reader;

/* The ink value from which on a pair costs more than dark ink may. */
static float
end_of_dark (const CeldSmoothnessCosts *costs)
{
  int i = 0;

  while (i < CELD_INK_STEPS && costs->by_ink[i] <= CELD_COST_UNIT * (1 + costs->paper_cost * DARK))
    i++;
  return (float) i / CELD_INK_STEPS;
}

/* The present labels of row y. */
static void
read_labels (Reader *r, int y, uint64_t *state)
{
  const CeldPresentLabels *present = r->present;
  const CeldBasins        *basins = r->graph->task->basins;
  int                      left = r->graph->box.x, end = left + r->graph->box.width;
  size_t                   i = present->picture ? 0 : celd_basin_run_at (basins, y, left, &r->hint);

  for (int x = left; x < end && present->picture; x++)
    state[x - left] = CELD_AT (present->picture, x, y);
  for (int x = left, run_end; x < end && !present->picture; i++)
    {
      uint32_t basin = basins->run[i].basin;
      uint64_t here = present->label[basin] | (present->free[basin] == present->id ? 0 : CELD_STATE_FIXED);

      run_end = celd_basin_run_end (basins, i, y);
      for (; x < run_end && x < end; x++)
        state[x - left] = here;
    }
}

/* Adds the kind of ink to states that are not fixed. */
static void
read_ink (const Reader *r, int y, int x, int end, uint64_t *state)
{
  const float *ink = &CELD_AT (r->graph->task->ink, 0, y);

  for (; x < end; x++, state++)
    if (!(*state & CELD_STATE_FIXED))
      *state |= (ink[x] < PAPER ? CELD_STATE_DIAGONAL : 0) | (ink[x] < r->dark ? CELD_STATE_WIDE : 0);
}

/* Adds the seeds in the pixels x .. end - 1 of row y to their states.  Pixels that are not free belong to other
 * windows. */
static void
read_seeds (const Reader *r, int y, int x, int end, uint64_t *state)
{
  const CeldSegmentTask *task = r->graph->task;
  const CeldSeedRow     *row = &task->seeds.row[y];
  size_t                 low = 0, high = row->n;

  while (low < high)
    {
      size_t middle = low + (high - low) / 2;

      if (row->run[middle].end <= x)
        low = middle + 1;
      else
        high = middle;
    }
  for (size_t i = low; i < row->n && row->run[i].x < end; i++)
    {
      uint64_t label = row->run[i].label;
      bool     hard = celd_task_data_cost (task, row->run[i].label) == CELD_HARD;

      for (int k = row->run[i].x > x ? row->run[i].x : x; k < end && k < row->run[i].end; k++)
        if (!(state[k - x] & CELD_STATE_FIXED))
          state[k - x] = hard ? CELD_STATE_FIXED | label : state[k - x] | label << CELD_STATE_SEED;
    }
}

/* Reads row y.  The outermost pixels of the window are fixed, except at the frame. */
static void
read_row (Reader *r, int y, uint64_t *state)
{
  const CeldPlane *ink = r->graph->task->ink;
  CeldRect         box = r->graph->box;
  int              end = box.x + box.width, bottom = box.y + box.height;
  bool             edge = (y == box.y && y > 0) || (y + 1 == bottom && bottom < ink->height);

  read_labels (r, y, state);
  for (int k = 0; k < box.width && edge; k++)
    state[k] |= CELD_STATE_FIXED;
  if (box.x > 0)
    state[0] |= CELD_STATE_FIXED;
  if (end < ink->width)
    state[box.width - 1] |= CELD_STATE_FIXED;
  if (r->blocks)
    read_ink (r, y, box.x, end, state);
  read_seeds (r, y, box.x, end, state);
}

/* ------------------------------------------------------------------ the graph */

CeldStatus
celd_window_graph_new (const CeldSegmentTask *task, const CeldPresentLabels *present, CeldRect box, int shift,
                       CeldPixelGraph *graph)
{
  int        size = shift ? 1 << shift : CELD_LARGEST_SQUARE;
  size_t     w = (size_t) box.width;
  Reader     r = { .graph = graph, .present = present, .dark = end_of_dark (&task->basins->costs), .blocks = shift > 0,
                   .state = celd_alloc (w * (size_t) size, sizeof *r.state) };
  CeldStatus status = celd_pixel_graph_new (task, box, graph);

  if (!r.state)
    status = CELD_NO_MEMORY;
  graph->distance = present->to_paper;
  graph->to_paper = shift ? bound_to_paper : NULL;
  for (int top = box.y; top < box.y + box.height && status == CELD_OK; top += size)
    {
      for (int y = top; y < celd_pixel_graph_bottom (graph, top, size); y++)
        read_row (&r, y, r.state + (size_t) (y - top) * w);
      for (int x = 0; x < box.width && status == CELD_OK; x += size)
        status = celd_pixel_graph_add_square (graph, box.x + x, top, size, r.state + x, w, shift);
    }
  celd_free (r.state);
  return status == CELD_OK ? celd_pixel_graph_connect (graph) : status;
}

/* Divides a block into cells, or fixes it to its new labels. */
static CeldStatus
divide (Reader *r, CeldPixelGraph *graph, const CeldPixelNode *node, const uint32_t *label, bool finer)
{
  int shift = 0, left = node->x, right = celd_pixel_graph_right (graph, left, node->size);
  int bottom = celd_pixel_graph_bottom (graph, node->y, node->size), cell;

  for (int y = node->y; y < bottom; y++)
    {
      uint64_t *state = r->state + (size_t) (y - node->y) * (size_t) node->size;
      uint32_t *part = celd_pixel_graph_part (graph, left, y);

      for (int x = left; x < right; x++, part++)
        {
          bool     fixed = *part & CELD_PART_FIXED;
          uint32_t own = fixed ? *part & ~CELD_PART_FIXED : label[*part];

          state[x - left] = own | (fixed ? CELD_STATE_FIXED : 0);
          *part = CELD_PART_FIXED | own;
        }
      read_ink (r, y, left, right, state);
      read_seeds (r, y, left, right, state);
    }
  while (1 << shift < node->size)
    shift++;
  cell = shift - (node->whole ? FINER_PAPER : FINER_INK);
  return finer ? celd_pixel_graph_add_square (graph, left, node->y, node->size, r->state, (size_t) node->size,
                                              cell > 0 ? cell : 0) : CELD_OK;
}

CeldStatus
celd_window_graph_refine (CeldPixelGraph *graph, const uint32_t *label, const bool *crossed)
{
  CeldPixelNode *old = graph->node;
  size_t         n = graph->n;
  Reader         r = { .graph = graph, .blocks = true, .dark = end_of_dark (&graph->task->basins->costs),
                       .state = celd_alloc (CELD_LARGEST_SQUARE * CELD_LARGEST_SQUARE, sizeof *r.state) };
  CeldStatus     status = r.state ? CELD_OK : CELD_NO_MEMORY;

  celd_pixel_graph_empty (graph);
  graph->node = NULL;
  graph->node_capacity = 0;
  for (size_t k = 0, next; k < n && status == CELD_OK; k = next)
    {
      bool finer = false;

      for (next = k; next < n && old[next].x == old[k].x && old[next].y == old[k].y; next++)
        finer |= crossed[next];
      status = divide (&r, graph, &old[k], label, finer);
    }
  celd_free (old);
  celd_free (r.state);
  return status == CELD_OK ? celd_pixel_graph_connect (graph) : status;
}

/* ------------------------------------------------------------------ the cut */

CeldStatus
celd_window_cutter_new (const CeldSegmentTask *task, const CeldHost *host, CeldWindowCutter *cutter)
{
  size_t n_labels = task->palette.n;

  *cutter = (CeldWindowCutter) {
    .task   = task, .host = host,
    .order  = celd_alloc (n_labels, sizeof *cutter->order),
    .local  = celd_alloc (n_labels + 1, sizeof *cutter->local),
    .global = celd_alloc (n_labels, sizeof *cutter->global),
    .votes  = celd_alloc (n_labels + 1, sizeof *cutter->votes),
  };
  if (!cutter->order || !cutter->local || !cutter->global || !cutter->votes)
    return CELD_NO_MEMORY;
  return celd_task_label_order (task, cutter->order);
}

void
celd_window_cutter_clear (CeldWindowCutter *cutter)
{
  celd_free (cutter->order);
  celd_free (cutter->local);
  celd_free (cutter->global);
  celd_free (cutter->votes);
  *cutter = (CeldWindowCutter) { .task = NULL };
}

/* Numbers the labels that can occur in a graph from 1, in their order; returns how many there are.  A label that no
 * node has now needs data costs of at least `least` together. */
static size_t
number_labels (CeldWindowCutter *cutter, const CeldPixelGraph *graph, int64_t least)
{
  size_t n_labels = cutter->task->palette.n, n = 0;

  memset (cutter->votes, 0, (n_labels + 1) * sizeof *cutter->votes);
  for (size_t i = 0; i < graph->n_votes; i++)
    cutter->votes[graph->vote[i].label] += graph->vote[i].cost;
  for (size_t k = 0; k < graph->n; k++)
    cutter->votes[graph->node[k].value] = least;
  for (size_t i = 0; i < n_labels; i++)
    {
      uint32_t label = cutter->order[i];

      cutter->local[label] = 0;
      if (cutter->votes[label] < least)
        continue;
      cutter->global[n]    = label;
      cutter->local[label] = (uint32_t) ++n;
    }
  return n;
}

/* Replaces the labels of data costs by their local numbers; those of other labels are constant and are dropped. */
static void
number_votes (const CeldWindowCutter *cutter, CeldPixelGraph *graph)
{
  size_t n = 0;

  for (size_t i = 0; i < graph->n_votes; i++)
    {
      CeldVote vote = graph->vote[i];

      vote.label = cutter->local[vote.label];
      if (vote.label)
        graph->vote[n++] = vote;
    }
  graph->n_votes = n;
}

CeldStatus
celd_window_cut (CeldWindowCutter *cutter, CeldPixelGraph *graph, int64_t least, uint32_t **label, bool *better)
{
  size_t        n_labels = number_labels (cutter, graph, least);
  uint32_t     *order = celd_alloc (n_labels, sizeof *order), *present = celd_alloc (graph->n, sizeof *present);
  uint32_t     *result = celd_alloc (graph->n, sizeof *result);
  CeldHostPart  part;
  CeldHost      host = celd_host_part (&part, cutter->host, 0, 0);
  CeldPartition problem;
  int64_t       energy;
  CeldStatus    status = CELD_NO_MEMORY;

  if (!order || !present || !result)
    goto done;
  for (size_t k = 0; k < n_labels; k++)
    order[k] = (uint32_t) k + 1;
  for (size_t k = 0; k < graph->n; k++)
    present[k] = cutter->local[graph->node[k].value];
  number_votes (cutter, graph);
  problem = (CeldPartition) {
    graph->n, graph->link, graph->n_links, graph->vote, graph->n_votes, NULL, order, n_labels
  };
  status = celd_partition (&problem, &host, result, &energy, NULL);
  if (status != CELD_OK)
    goto done;
  *better = energy < celd_partition_energy (&problem, present);
  for (size_t k = 0; k < graph->n; k++)
    result[k] = *better ? cutter->global[result[k] - 1] : graph->node[k].value;
  *label = result;
  result = NULL;

done:
  celd_free (order);
  celd_free (present);
  celd_free (result);
  return status;
}
