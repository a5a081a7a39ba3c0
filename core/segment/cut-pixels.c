/* A region, cut between two points of it: the smallest sum of the smoothness cost V_pq of LazyBrush [SDC09b] along the
 * boundary.
 *
 * The minimum cut is found on squares that are small near the ends and larger the farther away they are, and then again
 * and again in a band along the previous cut, on squares a quarter as large, down to pixels (H. Lombaert et al., "A
 * multilevel banded graph cuts method for fast image segmentation", ICCV 2005; theirs has squares of one size in each
 * pass).  A node is the connected paper or ink of one basin in a square, so the two sides of a thin line or a narrow
 * opening are two nodes, however coarse the squares are.
 *
 * The cost is one pass over the region's pixels to read the drawing, and otherwise the length of the cut.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "segment/basins.h"
#include "segment/pixel-graph.h"
#include "segment/splits.h"
#include "segment/task.h"
#include "solve/maxflow.h"

#include <math.h>
#include <string.h>

#define SQUARES_BETWEEN_ENDS 8 /* squares between the ends; those as far away are as large (chosen) */
#define FINER                4 /* ratio of the squares' sides in consecutive bands (chosen) */
#define NO_CELLS             6 /* nodes may be as large as squares: 1 << 6 pixels a side */
#define FINE_SQUARE          4 /* pixels: in squares up to this size distances of ink to paper are measured (chosen) */
#define MOST_TO_PAPER        4 /* pixels: ink farther from paper counts as this far (chosen) */
#define COARSE_TO_PAPER      4 /* squared pixels: what ink counts as in larger squares: cuts prefer the middle of lines
                                * (chosen) */

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

typedef CeldStatus (*SquareVisit) (CeldCutGraph *graph, int x, int y, int right, int bottom, int size);

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
visit_tile (CeldCutGraph *graph, SquareVisit visit, int left, int top, int right, int bottom, int size)
{
  CeldStatus status = CELD_OK;

  for (int y = top; y < bottom; y += size)
    for (int x = left; (x = skip_outside (graph, x, y, right, size)) < right && status == CELD_OK; x += size)
      status = visit (graph, x, y, x + size < right ? x + size : right, y + size < bottom ? y + size : bottom, size);
  return status;
}

/* Calls `visit` for each square of the active tiles: its first pixel, its end in x and y (exclusive), and its size. */
static CeldStatus
visit_squares (CeldCutGraph *graph, SquareVisit visit)
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

/* Has a square pixels inside?  *paper: is it nothing but paper inside? */
static bool
inspect (const CeldCutGraph *graph, int x, int y, int right, int bottom, bool *paper)
{
  unsigned inside = 0, others = 0;

  for (int v = y; v < bottom; v++)
    {
      const uint8_t *mark = graph->cut->mark + celd_cut_index (graph->cut, x, v);
      const float   *ink = &CELD_AT (graph->cut->task->ink, x, v);

      for (int u = 0; u < right - x; u++)
        {
          inside |= mark[u] == CELD_INSIDE;
          others |= (mark[u] != CELD_INSIDE) | (ink[u] < 0.5f);
        }
    }
  *paper = !others;
  return inside;
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
          uint8_t  mark = graph->cut->mark[celd_cut_index (graph->cut, u, v)];
          uint32_t paper = celd_is_paper (CELD_AT (graph->cut->task->ink, u, v)) ? CELD_CUT_PAPER : 0;

          k += u == celd_basin_run_end (basins, k, v);
          *state++ = mark == CELD_INSIDE ? basins->run[k].basin | paper : CELD_STATE_FIXED | mark;
        }
    }
}

static CeldStatus
add_square (CeldCutGraph *graph, int x, int y, int right, int bottom, int size)
{
  bool paper;

  if (!inspect (graph, x, y, right, bottom, &paper))
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

/* Makes nodes of all pixels inside, square by square, and the links between them; pixels that have an end already add
 * capacities to their neighbours. */
static CeldStatus
build (CeldCutGraph *graph)
{
  CeldStatus status;

  celd_pixel_graph_empty (&graph->pixels);
  graph->pixels.to_paper = to_paper;
  status = visit_squares (graph, add_square);
  if (status == CELD_OK)
    status = celd_pixel_graph_connect (&graph->pixels);
  return status == CELD_OK ? celd_cut_graph_read_pixels (graph) : status;
}

/* ------------------------------------------------------------------ seeds and discs */

/* The x up to which row pixels from x on belong to this node for certain, at most `end`. */
static int
node_end (const CeldCutNode *node, int x, int end)
{
  int next = node->whole ? node->x + node->size : x + 1;

  return next < end ? next : end;
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
          x = node ? node_end (node, x, end) : x + 1;
        }
}

static void
add_seed_costs (CeldCutGraph *graph, uint32_t k, int x, int end, int y, int kept)
{
  const CeldCut       *cut = graph->cut;
  const CeldSeedDiscs *others = &cut->discs[1 - kept];
  CeldCutNode         *node = &graph->node[k];
  int32_t              vote = celd_task_data_cost (cut->task, cut->label);

  if (node->forced[1 - kept] && celd_seed_discs_contain (others, x, y) && celd_seed_discs_contain (others, end - 1, y))
    return;
  if (vote == CELD_HARD)
    node->forced[kept] = true;
  else
    node->terminal += (int64_t) (end - x) * (kept == 0 ? vote : -vote);
}

/* Goes over the pixels inside that are seeds of the region: notes where they are if `kept` is negative, else adds their
 * costs for that end. */
static void
visit_seeds (CeldCutGraph *graph, int kept)
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

            end = inside ? node_end (&graph->node[k], x, last) : x + 1;
            if (inside && kept < 0)
              celd_cut_graph_note_seeds (graph, k, x, end, y);
            else if (inside)
              add_seed_costs (graph, k, x, end, y, kept);
          }
      }
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

/* Activates a band along the cut where its squares are larger than pixels; false if they are not, anywhere.  In ink
 * between two basins the cut is in the middle of the line already. */
static bool
refine (CeldCutGraph *graph)
{
  bool any = false;

  memset (graph->active, 0, (size_t) graph->columns * (size_t) graph->rows);
  for (CeldCutNode *node = graph->node; node < graph->node + graph->n; node++) /* forced, but on the wrong side */
    node->cut = node->size > 1 && ((node->forced[0] && node->side == CELD_NEAR_SECOND) ||
                                   (node->forced[1] && node->side == CELD_NEAR_FIRST));
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
  status = build (&graph);
  if (status != CELD_OK)
    goto done;
  for (int i = 0; i < 2; i++)
    graph.at_end[i] = *celd_pixel_graph_part (&graph.pixels, cut->end[i].x, cut->end[i].y);
  visit_seeds (&graph, -1);
  status = celd_cut_graph_find_kept_end (&graph, kept);
  while (status == CELD_OK && *kept >= 0)
    {
      for (int k = 0; k < 4; k++)
        force_disc (&graph, &cut->discs[k / 2].disc[k % 2], k / 2);
      visit_seeds (&graph, *kept);
      status = celd_cut_graph_solve (&graph, *kept, host);
      if (status == CELD_OK)
        status = visit_squares (&graph, label_square);
      if (status != CELD_OK || !refine (&graph))
        break;
      status = build (&graph);
    }

done:
  celd_cut_graph_clear (&graph);
  return status;
}
