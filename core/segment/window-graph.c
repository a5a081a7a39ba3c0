/* A window of the picture as a graph whose nodes are connected pixels of one kind in square blocks.
 *
 * A cut costs the same along any monotone staircase of pixels, so blocks of empty paper lose only the distance from a
 * block's corner to where the cut would begin; boundaries in ink cost next to nothing, so connected ink in a block can
 * be a node as well.  Kinds are paper, faint ink and dark ink; each label of seeds, and each present label of basins,
 * is also separate.  What is fixed (other basins, hard seeds, the window's outermost pixels) is no node: an edge to it
 * is a data cost.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/unions.h"
#include "base/vector.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "segment/windows.h"

#include <string.h>

#define DARK (1 / 128.0)        /* of the cost of paper: a pair of dark ink costs no more (chosen) */

void
celd_window_graph_clear (CeldWindowGraph *graph)
{
  celd_free (graph->block);
  celd_free (graph->hard);
  celd_free (graph->detail);
  celd_free (graph->present);
  celd_free (graph->label);
  celd_free (graph->link);
  celd_free (graph->vote);
  *graph = (CeldWindowGraph) { .task = NULL };
}

/* ------------------------------------------------------------------ blocks */

static CeldStatus
add_node (CeldWindowBuilder *b, uint32_t present, uint32_t *node)
{
  CeldWindowGraph *graph = b->graph;

  *node = (uint32_t) graph->n;
  return celd_append (graph->present, graph->n, graph->present_capacity, present & CELD_PART_LABELS);
}

/* Is pixel (i,j) of a block of the same node as its neighbour (x,y)?  `first`: the block's first pixel.  Nodes other
 * than dark ink end at squares of 1 << square pixels a side. */
static inline bool
is_alike (const CeldWindowBuilder *b, size_t first, int square, int x, int y, int i, int j)
{
  size_t   stride = (size_t) celd_window_width (b->graph);
  size_t   p = first + (size_t) y * stride + (size_t) x, q = first + (size_t) j * stride + (size_t) i;
  uint32_t state = b->state[p];

  return state == b->state[q] && b->paint[p] == b->paint[q]
         && ((state & CELD_PART_KINDS) == 2 * CELD_PART_KIND_INK
             || (x >> square == i >> square && y >> square == j >> square));
}

/* Joins pixels of a block that are of the same kind; ink in eight directions, so that the antialiased edge of a
 * slanting line is one node.  Pixels joined through the row above are not joined again. */
static void
join_pixels (const CeldWindowBuilder *b, size_t first, int w, int h, int square)
{
  size_t   stride = (size_t) celd_window_width (b->graph);
  uint32_t down = UINT32_C (1) << b->graph->shift;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        uint32_t state = b->state[first + (size_t) y * stride + (size_t) x];
        uint32_t k = ((uint32_t) y << b->graph->shift) + (uint32_t) x;
        bool     west = x > 0 && is_alike (b, first, square, x, y, x - 1, y);
        bool     north = y > 0 && is_alike (b, first, square, x, y, x, y - 1);
        bool     north_west = y > 0 && x > 0 && is_alike (b, first, square, x, y, x - 1, y - 1);

        b->parent[k] = west ? b->parent[k - 1] : k;
        if (state & CELD_PART_FIXED)
          continue;
        if (north && !(west && north_west))
          celd_join (b->parent, k, k - down);
        if (!(state & CELD_PART_KINDS) || north || y == 0)
          continue;
        if (north_west && !west)
          celd_join (b->parent, k, k - down - 1);
        if (x + 1 < w && is_alike (b, first, square, x, y, x + 1, y - 1))
          celd_join (b->parent, k, k - down + 1);
      }
}

/* Divides a block into several parts: a node for each, and the data costs of its seeds. */
static CeldStatus
split_block (CeldWindowBuilder *b, size_t first, int w, int h, int square, uint32_t *block)
{
  CeldWindowGraph *graph = b->graph;
  size_t           stride = (size_t) celd_window_width (graph), area = (size_t) 1 << 2 * graph->shift;
  uint32_t        *detail;
  CeldStatus       status = CELD_OK;

  if (!celd_reserve (&graph->detail, graph->n_details + 1, &graph->detail_capacity, area * sizeof *detail))
    return CELD_NO_MEMORY;
  *block = CELD_PART_MIXED | (uint32_t) graph->n_details;
  detail = graph->detail + graph->n_details++ * area;
  memset (detail, 0xff, area * sizeof *detail); /* fixed where the block is clipped */
  join_pixels (b, first, w, h, square);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w && status == CELD_OK; x++)
      {
        size_t   p = first + (size_t) y * stride + (size_t) x;
        uint32_t k = (uint32_t) ((y << graph->shift) + x);

        if (b->state[p] & CELD_PART_FIXED)
          {
            detail[k] = CELD_PART_FIXED | (b->state[p] & CELD_PART_LABELS);
            continue;
          }
        if (b->parent[k] == k)
          status = add_node (b, b->state[p], &detail[k]);
        else
          detail[k] = detail[celd_root (b->parent, k)];
        if (status == CELD_OK && b->paint[p])
          status = celd_window_graph_add_data_cost (graph, detail[k], b->paint[p], graph->task->soft_cost);
      }
  return status;
}

/* The bits that the states of a block's pixels in the columns left .. end - 1 have in common; *uniform: are all states
 * equal? */
static uint32_t
common_state (const CeldWindowBuilder *b, int left, int end, bool *uniform)
{
  uint32_t different = 0, common = UINT32_MAX;

  for (int i = left; i < end; i++)
    {
      different |= b->change[i] | (b->state[i] ^ b->state[left]);
      common &= b->common[i];
    }
  *uniform = !different;
  return common;
}

static CeldStatus
make_block (CeldWindowBuilder *b, int column, int h, uint32_t *block)
{
  CeldWindowGraph *graph = b->graph;
  int              left = column << graph->shift, w = celd_window_width (graph) - left;
  bool             uniform;
  uint32_t         common;

  w = w < 1 << graph->shift ? w : 1 << graph->shift;
  common = common_state (b, left, left + w, &uniform);
  if (common & CELD_PART_FIXED && !b->hard[column])
    {
      *block = uniform ? CELD_PART_FIXED | (common & CELD_PART_LABELS) : CELD_PART_ABOVE;
      return CELD_OK;
    }
  if (uniform && !b->painted[column] && !(common & CELD_PART_FIXED))
    return add_node (b, common, block);
  return split_block (b, (size_t) left, w, h, graph->shift, block);
}

/* Fills in change[i] and common[i] of each column i. */
static void
compare_rows (const CeldWindowBuilder *b, int h)
{
  size_t stride = (size_t) celd_window_width (b->graph);

  memset (b->change, 0, stride * sizeof *b->change);
  memcpy (b->common, b->state, stride * sizeof *b->common);
  for (size_t y = 1; y < (size_t) h; y++)
    for (size_t i = 0; i < stride; i++)
      {
        b->change[i] |= b->state[i] ^ b->state[y * stride + i];
        b->common[i] &= b->state[y * stride + i];
      }
}

static CeldStatus
make_row (CeldWindowBuilder *b, int row, int top, int h)
{
  CeldWindowGraph *graph = b->graph;
  size_t           stride = (size_t) celd_window_width (graph);
  CeldStatus       status = CELD_OK;

  b->hard = graph->hard + (size_t) row * (size_t) graph->columns;
  memset (b->painted, 0, (size_t) graph->columns * sizeof *b->painted);
  for (int y = 0; y < h; y++)
    celd_window_read (b, top + y, b->state + (size_t) y * stride, b->paint + (size_t) y * stride);
  compare_rows (b, h);
  for (int column = 0; column < graph->columns && status == CELD_OK; column++)
    status = make_block (b, column, h, &graph->block[(size_t) row * (size_t) graph->columns + (size_t) column]);
  return status;
}

/* ------------------------------------------------------------------ finer blocks */

/* Divides a block: one that was a single node into 4 x 4, as it has no ink near; others into 8 x 8 and their ink. */
static CeldStatus
make_fine_row (CeldWindowBuilder *b, int row, int top, int h)
{
  CeldWindowGraph *graph = b->graph;
  int              w = celd_window_width (graph);
  const uint8_t   *fine = b->fine + (size_t) row * (size_t) graph->columns;
  uint32_t        *block = graph->block + (size_t) row * (size_t) graph->columns;
  const uint32_t  *coarse = graph->coarse->block + (size_t) row * (size_t) graph->columns;
  CeldStatus       status = CELD_OK;

  for (int k = 0; k < graph->columns; k++)
    block[k] = CELD_PART_ABOVE;
  if (!memchr (fine, 1, (size_t) graph->columns))
    return CELD_OK;
  b->hard = graph->hard + (size_t) row * (size_t) graph->columns;
  for (int y = 0; y < h; y++)
    celd_window_read_fine (b, top + y, fine, b->state + (size_t) y * (size_t) w, b->paint + (size_t) y * (size_t) w);
  for (int k = 0; k < graph->columns && status == CELD_OK; k++)
    if (fine[k])
      {
        int left = k << graph->shift, right = left + (1 << graph->shift) < w ? left + (1 << graph->shift) : w;
        int square = graph->shift - (coarse[k] & CELD_PART_MIXED ? 3 : 2);

        status = split_block (b, (size_t) left, right - left, h, square > 0 ? square : 0, &block[k]);
      }
  return status;
}

/* ------------------------------------------------------------------ the whole */

/* The ink value from which on a pair costs more than dark ink may. */
static float
end_of_dark (const CeldSmoothnessCosts *costs)
{
  int i = 0;

  while (i < CELD_INK_STEPS && costs->by_ink[i] <= CELD_COST_UNIT * (1 + costs->paper_cost * DARK))
    i++;
  return (float) i / CELD_INK_STEPS;
}

/* Builds b->graph, whose window is set; after a failure the caller clears it. */
static CeldStatus
build (CeldWindowBuilder *b)
{
  CeldWindowGraph  *graph = b->graph;
  const CeldWindow *window = &graph->window;
  int               size = 1 << graph->shift;
  size_t            w = (size_t) celd_window_width (graph);
  CeldStatus        status = CELD_NO_MEMORY;

  graph->columns = (window->right - window->left + size) >> graph->shift;
  graph->rows    = (window->bottom - window->top + size) >> graph->shift;
  graph->block   = celd_alloc ((size_t) graph->columns * (size_t) graph->rows, sizeof *graph->block);
  graph->hard    = celd_alloc0 ((size_t) graph->columns * (size_t) graph->rows, sizeof *graph->hard);
  b->dark        = end_of_dark (&graph->task->basins->costs);
  b->state       = celd_alloc (w << graph->shift, sizeof *b->state);
  b->paint       = celd_alloc (w << graph->shift, sizeof *b->paint);
  b->change      = celd_alloc (w, sizeof *b->change);
  b->common      = celd_alloc (w, sizeof *b->common);
  b->painted     = celd_alloc ((size_t) graph->columns, sizeof *b->painted);
  b->parent      = celd_alloc ((size_t) 1 << 2 * graph->shift, sizeof *b->parent);
  if (graph->block && graph->hard && b->state && b->paint && b->change && b->common && b->painted && b->parent)
    status = CELD_OK;
  for (int row = 0; row < graph->rows && status == CELD_OK; row++)
    {
      int top = window->top + row * size, h = window->bottom + 1 - top;

      status = (b->fine ? make_fine_row : make_row) (b, row, top, h < size ? h : size);
    }
  if (status == CELD_OK)
    status = celd_window_graph_connect (graph);
  if (status == CELD_OK)
    graph->label = celd_alloc (graph->n, sizeof *graph->label);
  celd_free (b->state);
  celd_free (b->paint);
  celd_free (b->change);
  celd_free (b->common);
  celd_free (b->painted);
  celd_free (b->parent);
  return status != CELD_OK || graph->label ? status : CELD_NO_MEMORY;
}

static CeldStatus
finish (CeldStatus status, CeldWindowGraph *made, CeldWindowGraph *graph)
{
  if (status == CELD_OK)
    *graph = *made;
  else
    celd_window_graph_clear (made);
  return status;
}

CeldStatus
celd_window_graph_new (const CeldSegmentTask *task, const uint32_t *label, const uint32_t *free, uint32_t id,
                       const CeldWindow *window, int shift, CeldWindowGraph *graph)
{
  CeldWindowGraph       made = { .task = task, .basin_label = label, .window = *window, .shift = shift };
  CeldWindowBuilder b = { .graph = &made, .free = free, .id = id };

  return finish (build (&b), &made, graph);
}

CeldStatus
celd_window_graph_refine (const CeldWindowGraph *coarse, const uint8_t *fine, CeldWindowGraph *graph)
{
  CeldWindowGraph   made = {
    .task = coarse->task, .coarse = coarse, .window = coarse->window, .shift = coarse->shift
  };
  CeldWindowBuilder b = { .graph = &made, .fine = fine };

  return finish (build (&b), &made, graph);
}
