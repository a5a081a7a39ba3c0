/* The edges of a window's graph: links between its nodes, and data costs where a neighbour is fixed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/task.h"
#include "segment/windows.h"
#include "solve/partition.h"

CeldStatus
celd_window_graph_add_data_cost (CeldWindowGraph *graph, uint32_t node, uint32_t label, int64_t cost)
{
  CeldVote *last = graph->n_votes ? &graph->vote[graph->n_votes - 1] : NULL;

  if (last && last->node == node && last->label == label)
    {
      last->cost += cost;
      return CELD_OK;
    }
  return celd_append (graph->vote, graph->n_votes, graph->vote_capacity, (CeldVote) { node, label, cost });
}

/* ------------------------------------------------------------------ single edges */

/* The squared distance from (x,y) in ink to paper, as far as it matters to costs. */
static int32_t
squared_to_paper (const CeldSegmentTask *task, int x, int y)
{
  const CeldPlane *ink = task->ink;
  const int32_t   *discount = task->basins->costs.discount;
  int32_t          least = CELD_MOST_TO_PAPER;

  while (least > 1 && discount[least - 1] == discount[CELD_MOST_TO_PAPER])
    least--;
  for (int r = 1; r * r < least; r++) /* nearer columns and rows have been searched */
    for (int i = -r; i <= r; i++)
      {
        const int at[4][2] = { { x + i, y - r }, { x + i, y + r }, { x - r, y + i }, { x + r, y + i } };

        for (int k = 0; k < 4 && i * i + r * r < least; k++)
          if (at[k][0] >= 0 && at[k][0] < ink->width && at[k][1] >= 0 && at[k][1] < ink->height
              && celd_is_paper (CELD_AT (ink, at[k][0], at[k][1])))
            least = i * i + r * r;
      }
  return least;
}

/* The present label of the pixels of a part. */
static uint32_t
present_label (const CeldWindowGraph *graph, uint32_t part)
{
  return part & CELD_PART_FIXED ? part & ~CELD_PART_FIXED : graph->present[part];
}

/* V_pq between (x,y) of part a and the pixel below (south) or to the right, of part b.  In blocks ink counts as cheap
 * as possible along present boundaries and as dear as possible elsewhere: an improvement by these costs is one by the
 * true costs, and no distance to paper needs to be measured. */
static int32_t
edge_cost (const CeldWindowGraph *graph, uint32_t a, uint32_t b, int x, int y, bool south)
{
  const CeldSegmentTask *task = graph->task;
  int                    x2 = x + !south, y2 = y + south;
  float                  here = CELD_AT (task->ink, x, y), there = CELD_AT (task->ink, x2, y2);
  bool                   frame = south ? x == 0 || x + 1 == task->ink->width : y == 0 || y + 1 == task->ink->height;
  int32_t                to_paper = 0, other_to_paper = 0;

  if (!celd_is_paper (here) && !celd_is_paper (there))
    {
      if (graph->shift)
        to_paper = other_to_paper = present_label (graph, a) == present_label (graph, b) ? 0 : CELD_MOST_TO_PAPER;
      else
        {
          to_paper = squared_to_paper (task, x, y);
          other_to_paper = squared_to_paper (task, x2, y2);
        }
    }
  return celd_smoothness_cost (&task->basins->costs, here, there, to_paper, other_to_paper, frame);
}

/* Adds the edge between the parts a and b of two neighbouring pixels: to a link, or to a data cost if one of them is
 * fixed. */
static CeldStatus
add_edge (CeldWindowGraph *graph, uint32_t a, uint32_t b, int x, int y, bool south)
{
  CeldLink *last = graph->n_links ? &graph->link[graph->n_links - 1] : NULL;
  int32_t   cost;

  if (a == b || (a & b & CELD_PART_FIXED))
    return CELD_OK;
  cost = edge_cost (graph, a, b, x, y, south);
  if (a & CELD_PART_FIXED)
    return celd_window_graph_add_data_cost (graph, b, a & ~CELD_PART_FIXED, cost);
  if (b & CELD_PART_FIXED)
    return celd_window_graph_add_data_cost (graph, a, b & ~CELD_PART_FIXED, cost);
  if (a > b)
    {
      uint32_t swap = a;

      a = b;
      b = swap;
    }
  if (last && last->a == a && last->b == b)
    {
      last->cost += cost;
      return CELD_OK;
    }
  return celd_append (graph->link, graph->n_links, graph->link_capacity, (CeldLink) { a, b, cost });
}

/* ------------------------------------------------------------------ all edges */

static uint32_t
block_at (const CeldWindowGraph *graph, int column, int row)
{
  return graph->block[(size_t) row * (size_t) graph->columns + (size_t) column];
}

/* Have both blocks no nodes?  Blocks outside have none. */
static bool
is_idle (const CeldWindowGraph *graph, uint32_t block, int column, int row)
{
  uint32_t other_to_paper = column < graph->columns && row < graph->rows ? block_at (graph, column, row) :
  CELD_PART_FIXED;

  return (block & CELD_PART_FIXED || block == CELD_PART_ABOVE) &&
  (other_to_paper & CELD_PART_FIXED || other_to_paper == CELD_PART_ABOVE);
}

/* Adds the edges inside a block of several parts, which has w x h pixels from (left,top) on. */
static CeldStatus
link_inside (CeldWindowGraph *graph, uint32_t block, int left, int top, int w, int h)
{
  size_t     first = (size_t) (block & ~CELD_PART_MIXED) << 2 * graph->shift, down = (size_t) 1 << graph->shift;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w && status == CELD_OK; x++)
      {
        const uint32_t *part = graph->detail + first + ((size_t) y << graph->shift) + (size_t) x;

        if (x + 1 < w && part[0] != part[1])
          status = add_edge (graph, part[0], part[1], left + x, top + y, false);
        if (status == CELD_OK && y + 1 < h && part[0] != part[down])
          status = add_edge (graph, part[0], part[down], left + x, top + y, true);
      }
  return status;
}

/* Adds all edges of a block: inside it, to the right and below. */
static CeldStatus
link_block (CeldWindowGraph *graph, int column, int row)
{
  int        left = graph->window.left + (column << graph->shift), top = graph->window.top + (row << graph->shift);
  int        right = left + (1 << graph->shift) - 1, bottom = top + (1 << graph->shift) - 1;
  uint32_t   block = block_at (graph, column, row);
  CeldStatus status = CELD_OK;

  right  = right < graph->window.right ? right : graph->window.right;
  bottom = bottom < graph->window.bottom ? bottom : graph->window.bottom;
  if (!(block & CELD_PART_FIXED) && block & CELD_PART_MIXED)
    status = link_inside (graph, block, left, top, right - left + 1, bottom - top + 1);
  if (right < graph->window.right && !is_idle (graph, block, column + 1, row))
    for (int y = top; y <= bottom && status == CELD_OK; y++)
      status = add_edge (graph, celd_window_part_at (graph, right, y), celd_window_part_at (graph, right + 1, y), right,
                         y, false);
  if (bottom < graph->window.bottom && !is_idle (graph, block, column, row + 1))
    for (int x = left; x <= right && status == CELD_OK; x++)
      status = add_edge (graph, celd_window_part_at (graph, x, bottom), celd_window_part_at (graph, x, bottom + 1), x,
                         bottom, true);
  return status;
}

/* Sums up the links of the same two nodes, sorted by the lesser node; no node has many. */
static CeldStatus
sum_links (CeldWindowGraph *graph)
{
  size_t   *first = celd_alloc0 (graph->n + 1, sizeof *first);
  CeldLink *sorted = celd_alloc (graph->n_links, sizeof *sorted);
  size_t    begin = 0, n = 0;

  if (!first || !sorted)
    {
      celd_free (first);
      celd_free (sorted);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < graph->n_links; i++)
    first[graph->link[i].a + 1]++;
  for (size_t k = 1; k <= graph->n; k++)
    first[k] += first[k - 1];
  for (size_t i = 0; i < graph->n_links; i++)
    sorted[first[graph->link[i].a]++] = graph->link[i];
  for (size_t i = 0; i < graph->n_links; i++)
    {
      size_t j;

      if (i && sorted[i].a != sorted[i - 1].a)
        begin = n;
      for (j = begin; j < n && graph->link[j].b != sorted[i].b; j++)
        ;
      if (j == n)
        graph->link[n++] = sorted[i];
      else
        graph->link[j].cost += sorted[i].cost;
    }
  graph->n_links = n;
  celd_free (first);
  celd_free (sorted);
  return CELD_OK;
}

CeldStatus
celd_window_graph_connect (CeldWindowGraph *graph)
{
  CeldStatus status = CELD_OK;

  for (int row = 0; row < graph->rows; row++)
    for (int column = 0; column < graph->columns && status == CELD_OK; column++)
      status = link_block (graph, column, row);
  return status == CELD_OK ? sum_links (graph) : status;
}

