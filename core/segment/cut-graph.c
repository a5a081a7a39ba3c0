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
#include "segment/pixel-graph.h"
#include "segment/splits.h"

#include <string.h>

#define NO_CELLS        6 /* nodes may be as large as squares: 1 << 6 pixels a side */
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

/* Sets the states of a square's pixels: pixels of one node are of one basin, and all paper or all ink. */
static void
find_states (CeldCutGraph *graph, int x, int y, int right, int bottom)
{
  const CeldBasins *basins = graph->cut->task->basins;
  uint64_t         *state = graph->state;

  for (int v = y; v < bottom; v++)
    {
      size_t k = celd_basin_run (basins, x, v);

      for (int u = x; u < right; u++)
        {
          uint8_t mark = graph->cut->mark[celd_cut_index (graph->cut, u, v)];

          if (u == celd_basin_run_end (basins, k, v))
            k++;
          *state++ = mark != CELD_INSIDE ? CELD_STATE_FIXED | mark
                   : basins->run[k].basin | (celd_is_paper (CELD_AT (graph->cut->task->ink, u, v)) ? CELD_CUT_PAPER : 0);
        }
    }
}

static CeldStatus
add_square (CeldCutGraph *graph, int x, int y, int right, int bottom, int size)
{
  Contents has = inspect (graph, x, y, right, bottom);
  bool     paper = !has.outside && !has.ink;

  if (!has.inside)
    return CELD_OK;
  if (paper || size == 1)
    return celd_pixel_graph_add_whole (&graph->pixels, x, y, size, paper ? CELD_CUT_PAPER : 0);
  find_states (graph, x, y, right, bottom);
  return celd_pixel_graph_add_square (&graph->pixels, x, y, size, graph->state, (size_t) (right - x), NO_CELLS);
}

/* ------------------------------------------------------------------ links */

/* In small squares the distance of ink to paper is measured. */
static int32_t
to_paper (const CeldPixelGraph *pixels, uint32_t a, uint32_t b)
{
  const CeldPixelNode *node = &pixels->node[a & CELD_PART_FIXED ? b : a];

  return node->size <= FINE_SQUARE ? -MOST_TO_PAPER * MOST_TO_PAPER : COARSE_TO_PAPER;
}

/* Does it take smaller squares to find where a cut runs between two nodes? */
static bool
is_uncertain (const CeldCutNode *a, const CeldCutNode *b)
{
  return a->whole || b->whole || (!a->ink && !b->ink) || a->basin == b->basin;
}

/* Makes the nodes of the cut from those of the pixels. */
static CeldStatus
read_pixels (CeldCutGraph *graph)
{
  const CeldPixelGraph *pixels = &graph->pixels;

  if (!celd_reserve (&graph->node, pixels->n, &graph->node_capacity, sizeof *graph->node) ||
      !celd_reserve (&graph->uncertain, pixels->n_links, &graph->uncertain_capacity, sizeof *graph->uncertain))
    return CELD_NO_MEMORY;
  graph->n = pixels->n;
  for (size_t k = 0; k < graph->n; k++)
    {
      const CeldPixelNode *node = &pixels->node[k];
      bool                 paper = node->value & CELD_CUT_PAPER;

      graph->node[k] = (CeldCutNode) { .x = node->x, .y = node->y, .size = node->size, .whole = paper && node->whole,
                                       .ink = !paper, .basin = node->value & ~CELD_CUT_PAPER };
    }
  for (size_t i = 0; i < pixels->n_links; i++)
    graph->uncertain[i] = is_uncertain (&graph->node[pixels->link[i].a], &graph->node[pixels->link[i].b]);
  for (size_t i = 0; i < pixels->n_votes; i++)
    graph->node[pixels->vote[i].node].terminal += pixels->vote[i].label == CELD_NEAR_FIRST ? pixels->vote[i].cost
                                                                                           : -pixels->vote[i].cost;
  return CELD_OK;
}

CeldStatus
celd_cut_graph_build (CeldCutGraph *graph)
{
  CeldStatus status;

  celd_pixel_graph_empty (&graph->pixels);
  graph->pixels.to_paper = to_paper;
  status = celd_cut_graph_visit_squares (graph, add_square);
  if (status == CELD_OK)
    status = celd_pixel_graph_connect (&graph->pixels);
  return status == CELD_OK ? read_pixels (graph) : status;
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
            uint32_t k = *celd_pixel_graph_part (&graph->pixels, x, y);
            bool     inside = !(k & CELD_PART_FIXED);

            end = inside ? celd_cut_graph_node_end (&graph->node[k], x, last) : x + 1;
            if (inside)
              visit (graph, k, x, end, y, kept);
          }
      }
}
