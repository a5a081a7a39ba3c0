/* A region, cut between two points of it: the smallest sum of the smoothness cost V_pq of LazyBrush [SDC09b] along the
 * boundary.
 *
 * The minimum cut is found on squares that are small near the ends and larger the farther away they are, and then again
 * and again in a band along the previous cut, on squares a quarter as large, down to pixels (H. Lombaert et al., "A
 * multilevel banded graph cuts method for fast image segmentation", ICCV 2005; theirs has squares of one size in each
 * pass).  The cost is one pass over the region's pixels to read the drawing, and otherwise the length of the cut.
 *
 * Of all minimum cuts the one nearest to the end with more clearance is taken: a limb reaches to where the body begins.
 * Seeds of the region add data costs for the end that keeps its label.
 *
 * Where a narrow opening separates the two ends, the basins already meet where the cut should be, and the region is cut
 * between whole basins.  Merged basins (basins.h), which have no narrow opening inside, stay whole.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "segment/task.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#include <math.h>
#include <string.h>

#define SQUARES_BETWEEN_ENDS 8                   /* squares between the ends; those as far away are as large (chosen) */
#define FINER                4                   /* ratio of the squares' sides in consecutive bands (chosen) */
#define GLUE                 ((int64_t) 1 << 44) /* for cutting a merged basin: above any cut, below HARD_TERMINAL */

/* ------------------------------------------------------------------ squares */

static CeldStatus
graph_new (const CeldCut *cut, CeldCutGraph *graph)
{
  CeldRect   box = { cut->left, cut->top, cut->right - cut->left + 1, cut->bottom - cut->top + 1 };
  size_t     n;
  CeldStatus status;

  *graph = (CeldCutGraph) {
    .cut     = cut,
    .columns = (box.width - 1) / CELD_CUT_SQUARE + 1,
    .rows    = (box.height - 1) / CELD_CUT_SQUARE + 1,
    .state   = celd_alloc (CELD_CUT_SQUARE * CELD_CUT_SQUARE, sizeof *graph->state),
  };
  n = (size_t) graph->columns * (size_t) graph->rows;
  graph->size = celd_alloc (n, 1);
  graph->active = celd_alloc (n, 1);
  status = celd_pixel_graph_new (cut->task, box, &graph->pixels);
  for (size_t p = 0; p < (size_t) box.width * (size_t) box.height && status == CELD_OK; p++)
    graph->pixels.part[p] = CELD_PART_FIXED;
  return graph->state && graph->size && graph->active ? status : CELD_NO_MEMORY;
}

/* The distance of the interval between a and b from the one of a tile that starts at x. */
static int
distance_to_tile (int a, int b, int x)
{
  int low = a < b ? a : b, high = a < b ? b : a;

  return x > high ? x - high : x + CELD_CUT_SQUARE < low ? low - x - CELD_CUT_SQUARE : 0;
}

static void
set_sizes (CeldCutGraph *graph)
{
  const CeldCut *cut = graph->cut;
  double         apart = celd_relation_end_distance (cut->end[0], cut->end[1]);

  for (int t = 0; t < graph->columns * graph->rows; t++)
    {
      int    x = distance_to_tile (cut->end[0].x, cut->end[1].x, cut->left + t % graph->columns * CELD_CUT_SQUARE);
      int    y = distance_to_tile (cut->end[0].y, cut->end[1].y, cut->top + t / graph->columns * CELD_CUT_SQUARE);
      double wanted = fmax (apart, x > y ? x : y) / SQUARES_BETWEEN_ENDS;
      int    size = 1;

      while (2 * size <= wanted && size < CELD_CUT_SQUARE)
        size *= 2;
      graph->size[t] = (uint8_t) size;
      graph->active[t] = true;
    }
}

/* ------------------------------------------------------------------ seeds and discs */

static bool
in_disc (const CeldSeedDiscs *discs, int x, int y)
{
  int from, end;

  for (int k = 0; k < 2; k++)
    if (celd_seed_disc_row (&discs->disc[k], y, &from, &end) && x >= from && x < end)
      return true;
  return false;
}

static void
force_disc (CeldCutGraph *graph, const CeldSeedDisc *disc, int i)
{
  const CeldCut *cut = graph->cut;
  int            r = (int) disc->radius, x, end;

  for (int y = disc->y - r < cut->top ? cut->top : disc->y - r; y <= disc->y + r && y <= cut->bottom; y++)
    if (celd_seed_disc_row (disc, y, &x, &end))
      for (x = x < cut->left ? cut->left : x; x < end && x <= cut->right;)
        {
          uint32_t     k = *celd_pixel_graph_part (&graph->pixels, x, y);
          CeldCutNode *node = k & CELD_PART_FIXED ? NULL : &graph->node[k];

          if (node)
            node->forced[i] = true;
          x = node ? celd_cut_graph_node_end (node, x, end) : x + 1;
        }
}

static void
note_seeds (CeldCutGraph *graph, uint32_t k, int x, int end, int y, int kept)
{
  (void) kept;
  celd_cut_graph_note_seeds (graph, k, x, end, y);
}

static void
add_seed_costs (CeldCutGraph *graph, uint32_t k, int x, int end, int y, int kept)
{
  const CeldCut *cut = graph->cut;
  CeldCutNode   *node = &graph->node[k];
  int32_t        vote = celd_task_data_cost (cut->task, cut->label);

  if (node->forced[1 - kept] && in_disc (&cut->discs[1 - kept], x, y) && in_disc (&cut->discs[1 - kept], end - 1, y))
    return;
  if (vote == CELD_HARD)
    node->forced[kept] = true;
  else
    node->terminal += (int64_t) (end - x) * (kept == 0 ? vote : -vote);
}

/* ------------------------------------------------------------------ one pass */

/* Marks the pixels of a square by the side of their nodes; those of unreachable nodes become outside. */
static CeldStatus
label_square (CeldCutGraph *graph, int x, int y, int right, int bottom, int size)
{
  (void) size;
  for (int v = y; v < bottom; v++)
    {
      uint8_t  *mark = graph->cut->mark + celd_cut_index (graph->cut, x, v);
      uint32_t *part = celd_pixel_graph_part (&graph->pixels, x, v), *end = part + (right - x);

      for (; part < end; part++, mark++)
        if (!(*part & CELD_PART_FIXED))
          {
            *mark = graph->node[*part].side;
            *part = CELD_PART_FIXED | *mark;
          }
    }
  return CELD_OK;
}

/* Reopens a node's square and those around it. */
static void
reactivate_around (CeldCutGraph *graph, const CeldCutNode *node)
{
  const CeldCut *cut = graph->cut;
  int            left = node->x - node->size, right = node->x + 2 * node->size;
  int            top = node->y - node->size, bottom = node->y + 2 * node->size;

  left   = left < cut->left ? cut->left : left;
  top    = top < cut->top ? cut->top : top;
  right  = right > cut->right ? cut->right + 1 : right;
  bottom = bottom > cut->bottom ? cut->bottom + 1 : bottom;
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      if (cut->mark[celd_cut_index (cut, x, y)] != CELD_OUTSIDE)
        cut->mark[celd_cut_index (cut, x, y)] = CELD_INSIDE;
  for (int y = (top - cut->top) / CELD_CUT_SQUARE; y <= (bottom - 1 - cut->top) / CELD_CUT_SQUARE; y++)
    for (int x = (left - cut->left) / CELD_CUT_SQUARE; x <= (right - 1 - cut->left) / CELD_CUT_SQUARE; x++)
      graph->active[y * graph->columns + x] = true;
}

/* Is a forced node on the wrong side? */
static bool
is_misplaced (const CeldCutNode *node)
{
  return (node->forced[0] && node->side == CELD_NEAR_SECOND) || (node->forced[1] && node->side == CELD_NEAR_FIRST);
}

/* Activates a band along the cut where its squares are larger than pixels; false if they are not, anywhere.  In ink
 * between two basins the cut is in the middle of the line already. */
static bool
refine (CeldCutGraph *graph)
{
  bool any = false;

  memset (graph->active, 0, (size_t) graph->columns * (size_t) graph->rows);
  for (size_t k = 0; k < graph->n; k++)
    graph->node[k].cut = graph->node[k].size > 1 && is_misplaced (&graph->node[k]);
  for (size_t i = 0; i < graph->pixels.n_links; i++)
    {
      CeldCutNode *a = &graph->node[graph->pixels.link[i].a], *b = &graph->node[graph->pixels.link[i].b];

      if (graph->uncertain[i] && a->side != b->side && (a->size > 1 || b->size > 1))
        a->cut = b->cut = true;
    }
  for (size_t k = 0; k < graph->n; k++)
    if (graph->node[k].cut)
      {
        reactivate_around (graph, &graph->node[k]);
        any = true;
      }
  for (int t = 0; t < graph->columns * graph->rows; t++)
    if (graph->active[t])
      graph->size[t] = (uint8_t) (graph->size[t] > FINER ? graph->size[t] / FINER : 1);
  return any;
}

/* ------------------------------------------------------------------ the cut on squares */

CeldStatus
celd_cut_pixels (CeldCut *cut, const CeldHost *host, int *kept)
{
  CeldCutGraph graph;
  CeldStatus   status = graph_new (cut, &graph);

  if (status != CELD_OK)
    goto done;
  set_sizes (&graph);
  status = celd_cut_graph_build (&graph);
  if (status != CELD_OK)
    goto done;
  for (int i = 0; i < 2; i++)
    graph.at_end[i] = *celd_pixel_graph_part (&graph.pixels, cut->end[i].x, cut->end[i].y);
  celd_cut_graph_visit_seeds (&graph, note_seeds, 0);
  status = celd_cut_graph_find_kept_end (&graph, kept);
  while (status == CELD_OK && *kept >= 0)
    {
      for (int k = 0; k < 4; k++)
        force_disc (&graph, &cut->discs[k / 2].disc[k % 2], k / 2);
      celd_cut_graph_visit_seeds (&graph, add_seed_costs, *kept);
      status = celd_cut_graph_solve (&graph, *kept, host);
      if (status == CELD_OK)
        status = celd_cut_graph_visit_squares (&graph, label_square);
      if (status != CELD_OK || !refine (&graph))
        break;
      status = celd_cut_graph_build (&graph);
    }

done:
  celd_cut_graph_clear (&graph);
  return status;
}

/* ------------------------------------------------------------------ between whole basins */

static CeldStatus
add_basins (CeldCutGraph *graph)
{
  const CeldCut    *cut = graph->cut;
  const CeldBasins *basins = cut->task->basins;

  graph->node = celd_alloc (cut->n, sizeof *graph->node);
  if (!graph->node)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < cut->n; k++)
    {
      const CeldBasin *basin = &basins->basin[cut->basin[k]];

      graph->node[graph->n++] = (CeldCutNode) {
        .x = basin->x, .y = basin->y, .ink = basin->solid, .basin = cut->basin[k],
      };
    }
  for (int i = 0; i < 2; i++)
    graph->at_end[i] = cut->at[celd_basin_at (basins, cut->end[i].x, cut->end[i].y)] - 1;
  return CELD_OK;
}

static CeldStatus
add_boundaries (CeldCutGraph *graph)
{
  const CeldCut    *cut = graph->cut;
  const CeldBasins *basins = cut->task->basins;
  size_t            n = 0;

  for (size_t i = 0; i < basins->n_boundaries; i++)
    n += cut->at[basins->boundary[i].a] && cut->at[basins->boundary[i].b];
  graph->pixels.link = celd_alloc (n, sizeof *graph->pixels.link);
  graph->uncertain = celd_alloc (n, sizeof *graph->uncertain);
  if (!graph->pixels.link || !graph->uncertain)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < basins->n_boundaries; i++)
    {
      const CeldBasinBoundary *boundary = &basins->boundary[i];
      uint32_t                 a = cut->at[boundary->a], b = cut->at[boundary->b];
      int64_t                  glue = basins->merged[boundary->a] == basins->merged[boundary->b] ? GLUE : 0;

      if (!a || !b)
        continue;
      graph->uncertain[graph->pixels.n_links] = boundary->opening > 0;
      graph->pixels.link[graph->pixels.n_links++] = (CeldLink) { a - 1, b - 1, boundary->cost + glue };
    }
  return CELD_OK;
}

/* Counts the region's seeds in row y of its basins, and notes where they are; seeds and basins are runs from left to
 * right. */
static void
count_seeds (CeldCutGraph *graph, int y, size_t *seeds)
{
  const CeldCut     *cut = graph->cut;
  const CeldBasins  *basins = cut->task->basins;
  const CeldSeedRow *row = &cut->task->seeds.row[y];

  for (size_t i = 0; i < row->n; i++)
    {
      size_t k = row->run[i].label == cut->label ? celd_basin_run (basins, row->run[i].x, y) : 0;

      for (int x = row->run[i].x, end; row->run[i].label == cut->label && x < row->run[i].end; x = end, k++)
        {
          uint32_t at = cut->at[basins->run[k].basin];

          end = celd_basin_run_end (basins, k, y);
          end = end < row->run[i].end ? end : row->run[i].end;
          if (!at)
            continue;
          seeds[at - 1] += (size_t) (end - x);
          celd_cut_graph_note_seeds (graph, at - 1, x, end, y);
        }
    }
}

/* Adds the data costs of seeds for the end that is kept, except for those in the other end's merged basin. */
static void
add_basin_seed_costs (CeldCutGraph *graph, const size_t *seeds, int kept)
{
  const uint32_t *merged = graph->cut->task->basins->merged;
  uint32_t        new_merged = merged[graph->node[graph->at_end[1 - kept]].basin];
  int32_t         vote = celd_task_data_cost (graph->cut->task, graph->cut->label);

  for (size_t k = 0; k < graph->n; k++)
    {
      CeldCutNode *node = &graph->node[k];

      if (!seeds[k] || merged[node->basin] == new_merged)
        continue;
      node->forced[kept] = vote == CELD_HARD;
      if (vote != CELD_HARD)
        node->terminal = (int64_t) seeds[k] * (kept == 0 ? vote : -vote);
    }
  graph->node[graph->at_end[0]].forced[0] = true;
  graph->node[graph->at_end[1]].forced[1] = true;
}

CeldStatus
celd_cut_basins (const CeldCut *cut, const CeldHost *host, uint8_t *side, int *kept)
{
  CeldCutGraph graph = { .cut = cut };
  size_t      *seeds = celd_alloc0 (cut->n, sizeof *seeds);
  CeldStatus   status = seeds ? add_basins (&graph) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = add_boundaries (&graph);
  for (int y = cut->top; y <= cut->bottom && status == CELD_OK; y++)
    count_seeds (&graph, y, seeds);
  if (status == CELD_OK)
    status = celd_cut_graph_find_kept_end (&graph, kept);
  if (status == CELD_OK && *kept >= 0)
    {
      add_basin_seed_costs (&graph, seeds, *kept);
      status = celd_cut_graph_solve (&graph, *kept, host);
    }
  for (size_t k = 0; k < graph.n && status == CELD_OK; k++)
    side[k] = graph.node[k].side;
  celd_free (seeds);
  celd_cut_graph_clear (&graph);
  return status;
}
