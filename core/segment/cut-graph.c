/* The graph that a region is cut on.
 *
 * A node is the connected paper or ink of one basin in a square, so the two sides of a thin line or a narrow opening
 * are two nodes, however coarse the squares are.  Links are the exact sums of V_pq between their pixels.  With 4
 * neighbours a staircase costs what the straight line costs, so coarse squares lose little of a cut's value.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/vector.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "solve/partition.h"

#include <string.h>

#define NO_KIND         UINT32_MAX
#define FINE_SQUARE     4 /* pixels: in squares up to this size the distance of ink to paper is measured (chosen) */
#define MOST_TO_PAPER   4 /* pixels: ink farther from paper counts as this far (chosen) */
#define COARSE_TO_PAPER 4 /* squared pixels: what ink counts as in larger squares, so that cuts prefer the middle of
                           * lines (chosen) */

/* The first x in row y from which a square has pixels inside; `right` if there is none.  Single pixels are tested here,
 * larger squares by the visit. */
static int
skip_outside (const CeldCutGraph *graph, int x, int y, int right, int size)
{
  const uint8_t *mark = graph->cut->mark + celd_cut_index (graph->cut, x, y);
  const uint8_t *inside = size > 1 || x >= right ? mark : memchr (mark, CELD_INSIDE, (size_t) (right - x));

  return inside ? x + (int) (inside - mark) : right;
}

/* The squares of a tile. */
static CeldStatus
visit_tile (CeldCutGraph *graph, CeldSquareVisit visit, int left, int top, int right, int bottom, int size)
{
  CeldStatus status = CELD_OK;

  for (int y = top; y < bottom; y += size)
    for (int x = left; (x = skip_outside (graph, x, y, right, size)) < right && status == CELD_OK; x += size)
      status = visit (graph, x, y, x + size < right ? x + size : right, y + size < bottom ? y + size : bottom, size);
  return status;
}

CeldStatus
celd_cut_graph_visit_squares (CeldCutGraph *graph, CeldSquareVisit visit)
{
  const CeldCut *cut = graph->cut;
  CeldStatus     status = CELD_OK;

  for (int t = 0; t < graph->columns * graph->rows && status == CELD_OK; t++)
    {
      int left = cut->left + t % graph->columns * CELD_CUT_SQUARE, right = left + CELD_CUT_SQUARE;
      int top = cut->top + t / graph->columns * CELD_CUT_SQUARE, bottom = top + CELD_CUT_SQUARE;

      right  = right > cut->right ? cut->right + 1 : right;
      bottom = bottom > cut->bottom ? cut->bottom + 1 : bottom;
      if (graph->active[t])
        status = visit_tile (graph, visit, left, top, right, bottom, graph->size[t]);
    }
  return status;
}

uint32_t
celd_cut_graph_node_at (const CeldCutGraph *graph, int x, int y)
{
  const CeldCut *cut = graph->cut;
  int            column = (x - cut->left) / CELD_CUT_SQUARE, row = (y - cut->top) / CELD_CUT_SQUARE;
  int            within = graph->size[row * graph->columns + column] - 1; /* sizes are powers of two */
  size_t         corner = celd_cut_index (cut, x - ((x - cut->left) & within), y - ((y - cut->top) & within));

  if (cut->mark[corner] == CELD_INSIDE && graph->node[cut->node[corner]].whole)
    return cut->node[corner];
  return cut->node[celd_cut_index (cut, x, y)];
}

/* ------------------------------------------------------------------ nodes */

/* What a square contains: pixels inside, others; and ink, if all are inside. */
typedef struct { bool inside, outside, ink; } Contents;

static Contents
inspect (const CeldCutGraph *graph, int x, int y, int right, int bottom)
{
  unsigned inside = 0, outside = 0, ink = 0;

  for (int v = y; v < bottom; v++)
    {
      const uint8_t *mark = graph->cut->mark + celd_cut_index (graph->cut, x, v);
      uint8_t        marked = 0, unmarked = 0;

      for (int u = 0; u < right - x; u++)
        {
          marked   |= mark[u] == CELD_INSIDE;
          unmarked |= mark[u] != CELD_INSIDE;
        }
      inside  |= marked;
      outside |= unmarked;
    }
  for (int v = y; v < bottom && inside && !outside; v++)
    {
      const float *value = &CELD_AT (graph->cut->task->ink, x, v);

      for (int u = 0; u < right - x; u++)
        ink |= value[u] < 0.5f;
    }
  return (Contents) { inside, outside, ink };
}

static CeldStatus
add_node (CeldCutGraph *graph, CeldCutNode node)
{
  return celd_append (graph->node, graph->n, graph->node_capacity, node);
}

/* Sets the kind of each pixel inside: pixels of one node are of one kind. */
static void
find_kinds (CeldCutGraph *graph, int x, int y, int right, int bottom)
{
  const CeldBasins *basins = graph->cut->task->basins;
  uint32_t         *kind = graph->kind;

  for (int v = y; v < bottom; v++)
    {
      size_t k = celd_basin_run (basins, x, v);

      for (int u = x; u < right; u++)
        {
          if (u == celd_basin_run_end (basins, k, v))
            k++;
          *kind++ = graph->cut->mark[celd_cut_index (graph->cut, u, v)] != CELD_INSIDE ? NO_KIND
                  : 2 * basins->run[k].basin + celd_is_paper (CELD_AT (graph->cut->task->ink, u, v));
        }
    }
}

/* Assigns pixel i of the square and all pixels of the same kind connected to it to the last node (flood fill). */
static void
flood (CeldCutGraph *graph, int x, int y, int width, int height, int i)
{
  uint32_t *kind = graph->kind, same = kind[i];
  int       n = 0;

#define TAKE(j) (kind[j] = NO_KIND, graph->stack[n++] = (uint16_t) (j))
  TAKE (i);
  while (n)
    {
      int j = graph->stack[--n], u = j % width, v = j / width;

      graph->cut->node[celd_cut_index (graph->cut, x + u, y + v)] = (uint32_t) graph->n - 1;
      if (u > 0 && kind[j - 1] == same)
        TAKE (j - 1);
      if (u + 1 < width && kind[j + 1] == same)
        TAKE (j + 1);
      if (v > 0 && kind[j - width] == same)
        TAKE (j - width);
      if (v + 1 < height && kind[j + width] == same)
        TAKE (j + width);
    }
#undef TAKE
}

static CeldStatus
number_square (CeldCutGraph *graph, int x, int y, int right, int bottom, int size)
{
  Contents    has = inspect (graph, x, y, right, bottom);
  CeldCutNode node = { .x = x, .y = y, .size = size, .whole = !has.outside && !has.ink, .ink = has.ink };
  CeldStatus  status = CELD_OK;

  if (!has.inside)
    return CELD_OK;
  if (node.whole || size == 1)
    {
      graph->cut->node[celd_cut_index (graph->cut, x, y)] = (uint32_t) graph->n;
      return add_node (graph, node);
    }
  find_kinds (graph, x, y, right, bottom);
  for (int i = 0; i < (right - x) * (bottom - y) && status == CELD_OK; i++)
    {
      if (graph->kind[i] == NO_KIND)
        continue;
      node.ink   = graph->kind[i] % 2 == 0;
      node.basin = graph->kind[i] / 2;
      status     = add_node (graph, node);
      if (status == CELD_OK)
        flood (graph, x, y, right - x, bottom - y, i);
    }
  return status;
}

/* ------------------------------------------------------------------ links */

/* The squared distance from ink at (x,y) to paper, up to MOST_TO_PAPER squared. */
static int32_t
squared_to_paper (const CeldPlane *ink, int x, int y)
{
  int32_t least = MOST_TO_PAPER * MOST_TO_PAPER;

  for (int v = -MOST_TO_PAPER + 1; v < MOST_TO_PAPER; v++)
    for (int u = -MOST_TO_PAPER + 1; u < MOST_TO_PAPER; u++)
      if (u * u + v * v < least && x + u >= 0 && y + v >= 0 && x + u < ink->width && y + v < ink->height &&
          celd_is_paper (CELD_AT (ink, x + u, y + v)))
        least = u * u + v * v;
  return least;
}

static int32_t
cost_between (const CeldCutGraph *graph, int x, int y, int u, int v, bool fine)
{
  const CeldPlane           *ink = graph->cut->task->ink;
  const CeldSmoothnessCosts *costs = &graph->cut->task->basins->costs;
  float                      a = CELD_AT (ink, x, y), b = CELD_AT (ink, u, v);
  bool                       along = x == u ? x == 0 || x == ink->width - 1 : y == 0 || y == ink->height - 1;

  if (a >= 1 && b >= 1 && !along)
    return costs->by_ink[CELD_INK_STEPS];
  if (celd_is_paper (a) || celd_is_paper (b))
    return celd_smoothness_cost (costs, a, b, 0, 0, along);
  return fine ? celd_smoothness_cost (costs, a, b, squared_to_paper (ink, x, y), squared_to_paper (ink, u, v), along)
              : celd_smoothness_cost (costs, a, b, COARSE_TO_PAPER, COARSE_TO_PAPER, along);
}

/* Does it take smaller squares to find where a cut runs between two nodes? */
static bool
is_uncertain (const CeldCutNode *a, const CeldCutNode *b)
{
  return a->whole || b->whole || (!a->ink && !b->ink) || a->basin == b->basin;
}

static CeldStatus
add_link (CeldCutGraph *graph, uint32_t a, uint32_t b, int32_t cost)
{
  uint32_t *recent = &graph->recent[(a * 31u + b) % CELD_RECENT_LINKS];

  if (*recent < graph->n_links && graph->link[*recent].a == a && graph->link[*recent].b == b)
    {
      graph->link[*recent].cost += cost;
      return CELD_OK;
    }
  if (!celd_reserve_one (graph->link, graph->n_links, graph->link_capacity) ||
      !celd_reserve_one (graph->uncertain, graph->n_links, graph->uncertain_capacity))
    return CELD_NO_MEMORY;
  graph->link[graph->n_links] = (CeldLink) { a, b, cost };
  graph->uncertain[graph->n_links] = is_uncertain (&graph->node[a], &graph->node[b]);
  *recent = (uint32_t) graph->n_links++;
  return CELD_OK;
}

/* Links the pixel (x,y) inside to its neighbour (u,v).  Pairs of two pixels inside occur twice, once from each. */
static CeldStatus
connect (CeldCutGraph *graph, int x, int y, int u, int v, bool fine)
{
  const CeldCut *cut = graph->cut;
  uint8_t        mark = cut->mark[celd_cut_index (cut, u, v)];
  uint32_t       k, other;

  if (mark == CELD_OUTSIDE || (mark == CELD_INSIDE && (u < x || v < y)))
    return CELD_OK;
  k     = celd_cut_graph_node_at (graph, x, y);
  other = mark == CELD_INSIDE ? celd_cut_graph_node_at (graph, u, v) : k;
  if (other != k)
    return add_link (graph, k, other, cost_between (graph, x, y, u, v, fine));
  if (mark == CELD_NEAR_FIRST)
    graph->node[k].terminal += cost_between (graph, x, y, u, v, fine);
  if (mark == CELD_NEAR_SECOND)
    graph->node[k].terminal -= cost_between (graph, x, y, u, v, fine);
  return CELD_OK;
}

/* Links the pixels x .. right - 1 of row y to the row above (step -1) or below (1). */
static CeldStatus
link_rows (CeldCutGraph *graph, int x, int right, int y, int step, bool fine)
{
  const CeldCut *cut = graph->cut;
  const size_t   p = celd_cut_index (cut, 0, y);
  CeldStatus     status = CELD_OK;

  if (y + step < 0 || y + step >= cut->task->ink->height)
    return CELD_OK;
  for (int u = x; u < right && status == CELD_OK; u++)
    if (cut->mark[p + (size_t) u] == CELD_INSIDE)
      status = connect (graph, u, y, u, y + step, fine);
  return status;
}

/* Links the pixels y .. bottom - 1 of column x to the column to the left (step -1) or right (1). */
static CeldStatus
link_columns (CeldCutGraph *graph, int y, int bottom, int x, int step, bool fine)
{
  const CeldCut *cut = graph->cut;
  CeldStatus     status = CELD_OK;

  if (x + step < 0 || x + step >= cut->task->ink->width)
    return CELD_OK;
  for (int v = y; v < bottom && status == CELD_OK; v++)
    if (cut->mark[celd_cut_index (cut, x, v)] == CELD_INSIDE)
      status = connect (graph, x, v, x + step, v, fine);
  return status;
}

/* Links two different neighbours in a square, the first one in reading order first. */
static CeldStatus
link_pair (CeldCutGraph *graph, int x, int y, int u, int v, bool fine)
{
  return graph->cut->mark[celd_cut_index (graph->cut, x, y)] == CELD_INSIDE ? connect (graph, x, y, u, v, fine)
       : graph->cut->mark[celd_cut_index (graph->cut, u, v)] == CELD_INSIDE ? connect (graph, u, v, x, y, fine) :
  CELD_OK;
}

static CeldStatus
link_within (CeldCutGraph *graph, int x, int y, int right, int bottom, bool fine)
{
  size_t     w = (size_t) graph->cut->task->ink->width;
  CeldStatus status = CELD_OK;

  for (int v = y; v < bottom; v++)
    {
      const uint8_t  *mark = graph->cut->mark + celd_cut_index (graph->cut, x, v);
      const uint32_t *node = graph->cut->node + celd_cut_index (graph->cut, x, v);

      for (int u = x; u < right && status == CELD_OK; u++, mark++, node++)
        {
          bool inside = *mark == CELD_INSIDE;

          if (u + 1 < right && (mark[0] != mark[1] || (inside && node[0] != node[1])))
            status = link_pair (graph, u, v, u + 1, v, fine);
          if (v + 1 < bottom && (mark[0] != mark[w] || (inside && node[0] != node[w])) && status == CELD_OK)
            status = link_pair (graph, u, v, u, v + 1, fine);
        }
    }
  return status;
}

static CeldStatus
link_square (CeldCutGraph *graph, int x, int y, int right, int bottom, int size)
{
  size_t     p = celd_cut_index (graph->cut, x, y);
  bool       fine = size <= FINE_SQUARE;
  CeldStatus status = CELD_OK;

  if (graph->cut->mark[p] != CELD_INSIDE || !graph->node[graph->cut->node[p]].whole)
    status = link_within (graph, x, y, right, bottom, fine);
  if (status == CELD_OK)
    status = link_rows (graph, x, right, y, -1, fine);
  if (status == CELD_OK)
    status = link_rows (graph, x, right, bottom - 1, 1, fine);
  if (status == CELD_OK)
    status = link_columns (graph, y, bottom, x, -1, fine);
  if (status == CELD_OK)
    status = link_columns (graph, y, bottom, right - 1, 1, fine);
  return status;
}

CeldStatus
celd_cut_graph_build (CeldCutGraph *graph)
{
  CeldStatus status;

  graph->n = graph->n_links = 0;
  status = celd_cut_graph_visit_squares (graph, number_square);
  return status == CELD_OK ? celd_cut_graph_visit_squares (graph, link_square) : status;
}

/* ------------------------------------------------------------------ seeds */

void
celd_cut_graph_visit_seeds (CeldCutGraph *graph, CeldSeedVisit visit, int kept)
{
  const CeldCut *cut = graph->cut;

  for (int y = cut->top; y <= cut->bottom; y++)
    for (size_t i = 0; i < cut->task->seeds.row[y].n; i++)
      {
        const CeldSeedRun *run = &cut->task->seeds.row[y].run[i];
        int                last = run->end <= cut->right ? run->end : cut->right + 1;

        if (run->label != cut->label)
          continue;
        for (int x = run->x < cut->left ? cut->left : run->x, end; x < last; x = end)
          {
            bool     inside = cut->mark[celd_cut_index (cut, x, y)] == CELD_INSIDE;
            uint32_t k = inside ? celd_cut_graph_node_at (graph, x, y) : 0;

            end = inside ? celd_cut_graph_node_end (&graph->node[k], x, last) : x + 1;
            if (inside)
              visit (graph, k, x, end, y, kept);
          }
      }
}
