/* What borders cost between the parts of a window: links between its nodes, votes for what is fixed beside them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/windows.h"
#include "solve/partition.h"

CeldStatus
celd_cells_vote (CeldWindowCells *cells, uint32_t node, uint32_t label, int64_t cost)
{
  CeldVote *last = cells->n_votes ? &cells->vote[cells->n_votes - 1] : NULL;

  if (last && last->node == node && last->label == label)
    {
      last->cost += cost;
      return CELD_OK;
    }
  last = celd_grow (cells->vote, cells->n_votes + 1, sizeof *last);
  if (!last)
    return CELD_NO_MEMORY;
  cells->vote = last;
  last[cells->n_votes++] = (CeldVote) { node, label, cost };
  return CELD_OK;
}

/* ------------------------------------------------------------------ single borders */

/* The squared distance from (x,y) in ink to paper, as far as it matters to costs. */
static int32_t
depth_at (const CeldCanvas *canvas, int x, int y)
{
  const CeldPlane *ink = canvas->ink;
  const int32_t   *deep = canvas->basins->costs.deep;
  int32_t          least = CELD_DEEPEST;

  while (least > 1 && deep[least - 1] == deep[CELD_DEEPEST])
    least--;
  for (int r = 1; r * r < least; r++) /* what is nearer than r columns or rows has been looked at */
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

/* The label that pixels of this part have now. */
static uint32_t
present_label (const CeldWindowCells *cells, uint32_t part)
{
  return part & CELD_CELL_FIXED ? part & ~CELD_CELL_FIXED : cells->present[part];
}

/* V between (x,y) of part a and the pixel to the right, or below, of part b.  With blocks, ink is taken to be as deep
 * as can be where the present border runs, and shallow elsewhere: what seems to be an improvement then is one, and
 * nobody needs to know how deep ink is. */
static int32_t
edge_cost (const CeldWindowCells *cells, uint32_t a, uint32_t b, int x, int y, bool south)
{
  const CeldCanvas *canvas = cells->canvas;
  int               x2 = x + !south, y2 = y + south;
  float             here = CELD_AT (canvas->ink, x, y), there = CELD_AT (canvas->ink, x2, y2);
  bool              frame = south ? x == 0 || x + 1 == canvas->ink->width : y == 0 || y + 1 == canvas->ink->height;
  int32_t           depth = 0, other = 0;

  if (!celd_is_paper (here) && !celd_is_paper (there))
    {
      if (cells->shift)
        depth = other = present_label (cells, a) == present_label (cells, b) ? 0 : CELD_DEEPEST;
      else
        {
          depth = depth_at (canvas, x, y);
          other = depth_at (canvas, x2, y2);
        }
    }
  return celd_cost (&canvas->basins->costs, here, there, depth, other, frame);
}

/* The border between the parts a and b of two neighbouring pixels: a link, or a vote for what is fixed. */
static CeldStatus
add_edge (CeldWindowCells *cells, uint32_t a, uint32_t b, int x, int y, bool south)
{
  CeldLink *last = cells->n_links ? &cells->link[cells->n_links - 1] : NULL;
  int32_t   cost;

  if (a == b || (a & b & CELD_CELL_FIXED))
    return CELD_OK;
  cost = edge_cost (cells, a, b, x, y, south);
  if (a & CELD_CELL_FIXED)
    return celd_cells_vote (cells, b, a & ~CELD_CELL_FIXED, cost);
  if (b & CELD_CELL_FIXED)
    return celd_cells_vote (cells, a, b & ~CELD_CELL_FIXED, cost);
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
  last = celd_grow (cells->link, cells->n_links + 1, sizeof *last);
  if (!last)
    return CELD_NO_MEMORY;
  cells->link = last;
  last[cells->n_links++] = (CeldLink) { a, b, cost };
  return CELD_OK;
}

/* ------------------------------------------------------------------ all of them */

static uint32_t
block_at (const CeldWindowCells *cells, int column, int row)
{
  return cells->block[(size_t) row * (size_t) cells->columns + (size_t) column];
}

/* Are there no nodes in either block?  Blocks beyond the last ones are none. */
static bool
is_idle (const CeldWindowCells *cells, uint32_t block, int column, int row)
{
  uint32_t other = column < cells->columns && row < cells->rows ? block_at (cells, column, row) : CELD_CELL_FIXED;

  return (block & CELD_CELL_FIXED || block == CELD_CELL_ABOVE) && (other & CELD_CELL_FIXED || other == CELD_CELL_ABOVE);
}

/* The borders inside a block of several parts, which has w x h pixels, the first of them (left,top). */
static CeldStatus
link_inside (CeldWindowCells *cells, uint32_t block, int left, int top, int w, int h)
{
  size_t     first = (size_t) (block & ~CELD_CELL_MIXED) << 2 * cells->shift, down = (size_t) 1 << cells->shift;
  CeldStatus status = CELD_OK;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w && status == CELD_OK; x++)
      {
        const uint32_t *part = cells->detail + first + ((size_t) y << cells->shift) + (size_t) x;

        if (x + 1 < w && part[0] != part[1])
          status = add_edge (cells, part[0], part[1], left + x, top + y, false);
        if (status == CELD_OK && y + 1 < h && part[0] != part[down])
          status = add_edge (cells, part[0], part[down], left + x, top + y, true);
      }
  return status;
}

/* All borders of a block: inside it, to the right and below. */
static CeldStatus
link_block (CeldWindowCells *cells, int column, int row)
{
  int        left = cells->window.left + (column << cells->shift), top = cells->window.top + (row << cells->shift);
  int        right = left + (1 << cells->shift) - 1, bottom = top + (1 << cells->shift) - 1;
  uint32_t   block = block_at (cells, column, row);
  CeldStatus status = CELD_OK;

  right  = right < cells->window.right ? right : cells->window.right;
  bottom = bottom < cells->window.bottom ? bottom : cells->window.bottom;
  if (!(block & CELD_CELL_FIXED) && block & CELD_CELL_MIXED)
    status = link_inside (cells, block, left, top, right - left + 1, bottom - top + 1);
  if (right < cells->window.right && !is_idle (cells, block, column + 1, row))
    for (int y = top; y <= bottom && status == CELD_OK; y++)
      status = add_edge (cells, celd_cell_at (cells, right, y), celd_cell_at (cells, right + 1, y), right, y, false);
  if (bottom < cells->window.bottom && !is_idle (cells, block, column, row + 1))
    for (int x = left; x <= right && status == CELD_OK; x++)
      status = add_edge (cells, celd_cell_at (cells, x, bottom), celd_cell_at (cells, x, bottom + 1), x, bottom, true);
  return status;
}

/* Sums up the links of the same two nodes: they are sorted by their lesser node, of which none has many. */
static CeldStatus
sum_links (CeldWindowCells *cells)
{
  size_t   *first = celd_alloc0 (cells->n + 1, sizeof *first);
  CeldLink *sorted = celd_alloc (cells->n_links, sizeof *sorted);
  size_t    begin = 0, n = 0;

  if (!first || !sorted)
    {
      celd_free (first);
      celd_free (sorted);
      return CELD_NO_MEMORY;
    }
  for (size_t i = 0; i < cells->n_links; i++)
    first[cells->link[i].a + 1]++;
  for (size_t k = 1; k <= cells->n; k++)
    first[k] += first[k - 1];
  for (size_t i = 0; i < cells->n_links; i++)
    sorted[first[cells->link[i].a]++] = cells->link[i];
  for (size_t i = 0; i < cells->n_links; i++)
    {
      size_t j;

      if (i && sorted[i].a != sorted[i - 1].a)
        begin = n;
      for (j = begin; j < n && cells->link[j].b != sorted[i].b; j++)
        ;
      if (j == n)
        cells->link[n++] = sorted[i];
      else
        cells->link[j].cost += sorted[i].cost;
    }
  cells->n_links = n;
  celd_free (first);
  celd_free (sorted);
  return CELD_OK;
}

CeldStatus
celd_cells_link (CeldWindowCells *cells)
{
  CeldStatus status = CELD_OK;

  for (int row = 0; row < cells->rows; row++)
    for (int column = 0; column < cells->columns && status == CELD_OK; column++)
      status = link_block (cells, column, row);
  return status == CELD_OK ? sum_links (cells) : status;
}

