/* A window of the picture as a graph whose nodes are pieces of one kind in square blocks.
 *
 * A cut costs the same along any monotone staircase of pixels, so blocks of empty paper lose no more than it takes from
 * the block's corner to where the cut would begin; borders run for nothing in ink, so a piece of ink in a block can be
 * a node as well.  Apart are paper, faint ink and dark ink, paint and its labels, and labels that the basins have now.
 * What is fixed (other basins, hard paint, the window's rim) is no node: an edge to it is a vote for its label.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "window.h"

#include <string.h>

#define PAPER     0.75f           /* ink from here on is paper, which a border had better not cross */
#define DARK      (1 / 128.0)     /* of what paper costs: an edge of dark ink costs no more */
#define KINDS     UINT32_C (0x60000000)
#define KIND_INK  UINT32_C (0x20000000)
#define LABELS    UINT32_C (0x1fffffff)

typedef struct
{
  CeldCells       *cells;
  const uint32_t  *label, *free;
  uint32_t         id;
  const uint8_t   *fine;
  float            dark;        /* ink below this is dark */
  uint32_t        *state;       /* of the pixels of a row of blocks: label, kind, CELD_CELL_FIXED */
  uint32_t        *paint;       /* and the label of soft paint on them, 0 if there is none */
  bool            *painted;     /* by block of the row */
  uint32_t        *parent;      /* of the pixels of a block: another one of its piece, itself for the first */
} Builder;

void
celd_cells_clear (CeldCells *cells)
{
  celd_free (cells->block);
  celd_free (cells->detail);
  celd_free (cells->present);
  celd_free (cells->label);
  celd_free (cells->link);
  celd_free (cells->vote);
  *cells = (CeldCells) { .canvas = NULL };
}

static int
window_width (const CeldCells *cells)
{
  return cells->window.right - cells->window.left + 1;
}

/* ------------------------------------------------------------------ the pixels of a row */

static size_t
basin_run_at (const CeldBasins *basins, int y, int x)
{
  size_t low = basins->row[y], high = basins->row[y + 1];

  while (high - low > 1)
    {
      size_t middle = low + (high - low) / 2;

      if (basins->run[middle].x <= x)
        low = middle;
      else
        high = middle;
    }
  return low;
}

/* The rim of the window is as it is, but where the picture ends. */
static void
read_basins (const Builder *b, int y, uint32_t *state)
{
  const CeldWindow *w = &b->cells->window;
  const CeldBasins *basins = b->cells->canvas->basins;
  bool              rim = (y == w->top && y > 0) || (y == w->bottom && y + 1 < basins->height);
  size_t            i = basin_run_at (basins, y, w->left);

  for (int x = w->left, end; x <= w->right; x = end, i++)
    {
      uint32_t basin = basins->run[i].basin;
      uint32_t here = b->label[basin] | (rim || b->free[basin] != b->id ? CELD_CELL_FIXED : 0);

      end = i + 1 < basins->row[y + 1] ? basins->run[i + 1].x : basins->width;
      end = end <= w->right ? end : w->right + 1;
      for (int k = x; k < end; k++)
        state[k - w->left] = here;
    }
  if (w->left > 0)
    state[0] |= CELD_CELL_FIXED;
  if (w->right + 1 < basins->width)
    state[w->right - w->left] |= CELD_CELL_FIXED;
}

static void
read_ink (const Builder *b, int y, uint32_t *state)
{
  const float *ink = &CELD_AT (b->cells->canvas->ink, b->cells->window.left, y);
  int          n = window_width (b->cells);

  for (int i = 0; i < n; i++) /* what is fixed has no kind */
    state[i] += KIND_INK * ((uint32_t) (ink[i] < PAPER) + (uint32_t) (ink[i] < b->dark)) * (1 - (state[i] >> 31));
}

static void
read_paint (const Builder *b, int y, uint32_t *state, uint32_t *paint)
{
  const CeldCanvas  *canvas = b->cells->canvas;
  const CeldWindow  *w = &b->cells->window;
  const CeldSeedRow *row = &canvas->seeds.row[y];
  size_t             low = 0, high = row->n;

  memset (paint, 0, (size_t) window_width (b->cells) * sizeof *paint);
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
      bool     hard = celd_canvas_vote (canvas, l) == CELD_HARD;
      int      x = row->run[i].x > w->left ? row->run[i].x - w->left : 0;
      int      end = (row->run[i].end <= w->right ? row->run[i].end : w->right + 1) - w->left;

      for (int k = x; k < end; k++)
        if (hard)
          state[k] = CELD_CELL_FIXED | l;
        else
          paint[k] = l;
      for (int k = x / b->cells->size; k <= (end - 1) / b->cells->size && !hard; k++)
        b->painted[k] = true;
    }
}

/* ------------------------------------------------------------------ blocks */

static CeldStatus
add_node (Builder *b, uint32_t present, uint32_t *node)
{
  CeldCells *cells = b->cells;
  uint32_t  *grown = celd_grow (cells->present, cells->n + 1, sizeof *grown);

  if (!grown)
    return CELD_NO_MEMORY;
  cells->present = grown;
  *node = (uint32_t) cells->n++;
  grown[*node] = present & LABELS;
  return CELD_OK;
}

static CeldStatus
add_vote (CeldCells *cells, uint32_t node, uint32_t label, int64_t cost)
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

/* Are the w x h pixels of a block, the first of which is `i` of the row, all the same? */
static bool
is_uniform (const Builder *b, size_t i, int w, int h)
{
  size_t   stride = (size_t) window_width (b->cells);
  uint32_t first = b->state[i], different = 0;

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      different |= b->state[i + (size_t) y * stride + (size_t) x] ^ first;
  return !different;
}

static uint32_t
find_root (uint32_t *parent, uint32_t k)
{
  while (parent[k] != k)
    k = parent[k] = parent[parent[k]];
  return k;
}

static void
unite (uint32_t *parent, uint32_t a, uint32_t b)
{
  a = find_root (parent, a);
  b = find_root (parent, b);
  if (a < b)
    parent[b] = a;
  else
    parent[a] = b;
}

/* Joins pixels of a block that are of the same kind: ink in eight directions, so that a slanting line's rim is one. */
static void
join_pixels (const Builder *b, size_t first, int w, int h, bool fine)
{
  static const int step[4][2] = { { -1, 0 }, { 0, -1 }, { -1, -1 }, { 1, -1 } };
  size_t           stride = (size_t) window_width (b->cells);

  for (int y = 0; y < h; y++)
    for (int x = 0; x < w; x++)
      {
        size_t   p = first + (size_t) y * stride + (size_t) x;
        uint32_t k = (uint32_t) (y * b->cells->size + x), kind = b->state[p] & KINDS;
        int      ways = kind ? 4 : 2;

        b->parent[k] = k;
        if (b->state[p] & CELD_CELL_FIXED || (fine && kind != 2 * KIND_INK))
          continue;
        for (int d = 0; d < ways; d++)
          {
            int    i = x + step[d][0], j = y + step[d][1];
            size_t q = first + (size_t) j * stride + (size_t) i;

            if (i < 0 || i >= w || j < 0 || b->state[q] != b->state[p] || b->paint[q] != b->paint[p])
              continue;
            unite (b->parent, k, (uint32_t) (j * b->cells->size + i));
          }
      }
}

/* A block of several parts: a node for each piece, and the votes of the paint on it. */
static CeldStatus
split_block (Builder *b, size_t first, int w, int h, bool fine, uint32_t *block)
{
  CeldCells *cells = b->cells;
  size_t     stride = (size_t) window_width (cells), area = (size_t) cells->size * (size_t) cells->size;
  uint32_t  *detail = celd_grow (cells->detail, cells->n_details + 1, area * sizeof *detail);
  CeldStatus status = CELD_OK;

  if (!detail)
    return CELD_NO_MEMORY;
  cells->detail = detail;
  *block = CELD_CELL_MIXED | (uint32_t) cells->n_details;
  detail += cells->n_details++ * area;
  join_pixels (b, first, w, h, fine);
  for (int y = 0; y < h; y++)
    for (int x = 0; x < w && status == CELD_OK; x++)
      {
        size_t   p = first + (size_t) y * stride + (size_t) x;
        uint32_t k = (uint32_t) (y * cells->size + x);

        if (b->state[p] & CELD_CELL_FIXED)
          {
            detail[k] = CELD_CELL_FIXED | (b->state[p] & LABELS);
            continue;
          }
        if (b->parent[k] == k)
          status = add_node (b, b->state[p], &detail[k]);
        else
          detail[k] = detail[find_root (b->parent, k)];
        if (status == CELD_OK && b->paint[p])
          status = add_vote (cells, detail[k], b->paint[p], cells->canvas->soft_vote);
      }
  return status;
}

static CeldStatus
make_block (Builder *b, int column, int row, int h)
{
  CeldCells *cells = b->cells;
  int        left = column * cells->size, w = window_width (cells) - left;
  size_t     k = (size_t) row * (size_t) cells->columns + (size_t) column;
  uint32_t   state = b->state[left];
  bool       uniform, fine = b->fine && b->fine[k];

  w = w < cells->size ? w : cells->size;
  uniform = is_uniform (b, (size_t) left, w, h);
  if (uniform && state & CELD_CELL_FIXED)
    {
      cells->block[k] = CELD_CELL_FIXED | (state & LABELS);
      return CELD_OK;
    }
  if (!uniform || b->painted[column] || fine)
    return split_block (b, (size_t) left, w, h, fine, &cells->block[k]);
  return add_node (b, state, &cells->block[k]);
}

static CeldStatus
make_blocks (Builder *b)
{
  CeldCells *cells = b->cells;
  size_t     stride = (size_t) window_width (cells);
  CeldStatus status = CELD_OK;

  for (int row = 0; row < cells->rows && status == CELD_OK; row++)
    {
      int top = cells->window.top + row * cells->size, h = cells->window.bottom + 1 - top;

      h = h < cells->size ? h : cells->size;
      memset (b->painted, 0, (size_t) cells->columns * sizeof *b->painted);
      for (int y = 0; y < h; y++)
        {
          read_basins (b, top + y, b->state + (size_t) y * stride);
          read_ink (b, top + y, b->state + (size_t) y * stride);
          read_paint (b, top + y, b->state + (size_t) y * stride, b->paint + (size_t) y * stride);
        }
      for (int column = 0; column < cells->columns && status == CELD_OK; column++)
        status = make_block (b, column, row, h);
    }
  return status;
}

/* ------------------------------------------------------------------ what borders cost */

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

int32_t
celd_cells_cost (const CeldCanvas *canvas, int x, int y, bool south)
{
  int     x2 = x + !south, y2 = y + south;
  float   here = CELD_AT (canvas->ink, x, y), there = CELD_AT (canvas->ink, x2, y2);
  bool    deep = !celd_is_paper (here) && !celd_is_paper (there);
  bool    frame = south ? x == 0 || x + 1 == canvas->ink->width : y == 0 || y + 1 == canvas->ink->height;
  int32_t depth = deep ? depth_at (canvas, x, y) : 0, other = deep ? depth_at (canvas, x2, y2) : 0;

  return celd_cost (&canvas->basins->costs, here, there, depth, other, frame);
}

/* The border between the parts a and b of two neighbouring pixels: a link, or a vote for what is fixed. */
static CeldStatus
add_edge (CeldCells *cells, uint32_t a, uint32_t b, int x, int y, bool south)
{
  CeldLink *last = cells->n_links ? &cells->link[cells->n_links - 1] : NULL;
  int32_t   cost;

  if (a == b || (a & b & CELD_CELL_FIXED))
    return CELD_OK;
  cost = celd_cells_cost (cells->canvas, x, y, south);
  if (a & CELD_CELL_FIXED)
    return add_vote (cells, b, a & ~CELD_CELL_FIXED, cost);
  if (b & CELD_CELL_FIXED)
    return add_vote (cells, a, b & ~CELD_CELL_FIXED, cost);
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

/* All borders of a block: inside it, to the right and below. */
static CeldStatus
link_block (CeldCells *cells, int column, int row)
{
  int        left = cells->window.left + column * cells->size, top = cells->window.top + row * cells->size;
  int        right = left + cells->size - 1, bottom = top + cells->size - 1;
  bool       mixed = (cells->block[(size_t) row * (size_t) cells->columns + (size_t) column]
                      & (CELD_CELL_MIXED | CELD_CELL_FIXED)) == CELD_CELL_MIXED;
  CeldStatus status = CELD_OK;

  right  = right < cells->window.right ? right : cells->window.right;
  bottom = bottom < cells->window.bottom ? bottom : cells->window.bottom;
  for (int y = top; y <= bottom; y++)
    for (int x = mixed ? left : right; x <= right && x < cells->window.right && status == CELD_OK; x++)
      status = add_edge (cells, celd_cell_at (cells, x, y), celd_cell_at (cells, x + 1, y), x, y, false);
  for (int y = mixed ? top : bottom; y <= bottom && y < cells->window.bottom; y++)
    for (int x = left; x <= right && status == CELD_OK; x++)
      status = add_edge (cells, celd_cell_at (cells, x, y), celd_cell_at (cells, x, y + 1), x, y, true);
  return status;
}

/* Sums up the links of the same two nodes: they are sorted by their lesser node, of which none has many. */
static CeldStatus
sum_links (CeldCells *cells)
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

static CeldStatus
make_links (CeldCells *cells)
{
  CeldStatus status = CELD_OK;

  for (int row = 0; row < cells->rows; row++)
    for (int column = 0; column < cells->columns && status == CELD_OK; column++)
      status = link_block (cells, column, row);
  return status == CELD_OK ? sum_links (cells) : status;
}

/* ------------------------------------------------------------------ the whole */

/* Ink from here on costs more to cross than dark ink does. */
static float
end_of_dark (const CeldCosts *costs)
{
  int i = 0;

  while (i < CELD_INK_STEPS && costs->by_ink[i] <= CELD_COST_UNIT * (1 + costs->white * DARK))
    i++;
  return (float) i / CELD_INK_STEPS;
}

CeldStatus
celd_cells_new (const CeldCanvas *canvas, const uint32_t *label, const uint32_t *free, uint32_t id,
                const CeldWindow *window, int size, const uint8_t *fine, CeldCells *cells)
{
  CeldCells  made = { .canvas = canvas, .window = *window, .size = size };
  Builder    b = { .cells = &made, .label = label, .free = free, .id = id, .fine = fine };
  size_t     area;
  CeldStatus status = CELD_NO_MEMORY;

  area         = (size_t) window_width (&made) * (size_t) size;
  made.columns = (window_width (&made) + size - 1) / size;
  made.rows    = (window->bottom - window->top + size) / size;
  made.block   = celd_alloc ((size_t) made.columns * (size_t) made.rows, sizeof *made.block);
  b.dark       = end_of_dark (&canvas->basins->costs);
  b.state      = celd_alloc (area, sizeof *b.state);
  b.paint      = celd_alloc (area, sizeof *b.paint);
  b.painted    = celd_alloc ((size_t) made.columns, sizeof *b.painted);
  b.parent     = celd_alloc ((size_t) size * (size_t) size, sizeof *b.parent);
  if (made.block && b.state && b.paint && b.painted && b.parent)
    status = make_blocks (&b);
  if (status == CELD_OK)
    status = make_links (&made);
  if (status == CELD_OK)
    {
      made.label = celd_alloc (made.n, sizeof *made.label);
      status = made.label ? CELD_OK : CELD_NO_MEMORY;
    }
  celd_free (b.state);
  celd_free (b.paint);
  celd_free (b.painted);
  celd_free (b.parent);
  if (status == CELD_OK)
    *cells = made;
  else
    celd_cells_clear (&made);
  return status;
}
