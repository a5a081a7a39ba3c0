/* The minimum cut of a region's graph, which end of it is nearer to the seeds of the region, and the graph of whole
 * basins.
 *
 * Of all minimum cuts the one nearest to the end with more clearance is taken: a limb reaches to where the body begins.
 * Seeds of the region add data costs for the end that keeps its label: the one with the shorter path to them from node
 * to node, where ink counts as longer.
 *
 * Where a narrow opening separates the two ends, the basins already meet where the cut should be, and the region is cut
 * between whole basins.  Merged basins (basins.h), which have no narrow opening inside, stay whole.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "segment/basins.h"
#include "segment/splits.h"
#include "segment/task.h"
#include "solve/maxflow.h"

#include <math.h>

#define INK_STEP      8                   /* length of a step through ink, in steps on paper (chosen) */
#define HARD_TERMINAL ((int64_t) 1 << 48) /* of forced nodes: above any cut */
#define GLUE          ((int64_t) 1 << 44) /* for cutting a merged basin: above any cut, below HARD_TERMINAL */

void
celd_cut_graph_clear (CeldCutGraph *graph)
{
  celd_free (graph->size);
  celd_free (graph->active);
  celd_free (graph->state);
  celd_free (graph->node);
  celd_free (graph->uncertain);
  celd_pixel_graph_clear (&graph->pixels);
}

/* ------------------------------------------------------------------ nodes */

/* Does it take smaller squares to find where a cut runs between two nodes? */
static bool
is_uncertain (const CeldCutNode *a, const CeldCutNode *b)
{
  return a->whole || b->whole || (!a->ink && !b->ink) || a->basin == b->basin;
}

CeldStatus
celd_cut_graph_read_pixels (CeldCutGraph *graph)
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

/* ------------------------------------------------------------------ the end nearer to the seeds */

/* The links by node: those of node k are link[first[k]] .. link[first[k + 1] - 1]. */
typedef struct { size_t *first, *link; uint32_t *queue; double *length; bool *queued; } Paths;

static void
paths_clear (Paths *paths)
{
  celd_free (paths->first);
  celd_free (paths->link);
  celd_free (paths->queue);
  celd_free (paths->length);
  celd_free (paths->queued);
}

static CeldStatus
paths_new (const CeldCutGraph *graph, Paths *paths)
{
  *paths = (Paths) {
    celd_alloc0 (graph->n + 2, sizeof *paths->first), celd_alloc (2 * graph->pixels.n_links, sizeof *paths->link),
    celd_alloc (graph->n, sizeof *paths->queue), celd_alloc (graph->n, sizeof *paths->length),
    celd_alloc0 (graph->n, sizeof *paths->queued)
  };
  if (!paths->first || !paths->link || !paths->queue || !paths->length || !paths->queued)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < graph->pixels.n_links; i++)
    {
      paths->first[graph->pixels.link[i].a + 2]++;
      paths->first[graph->pixels.link[i].b + 2]++;
    }
  for (size_t k = 1; k < graph->n + 2; k++)
    paths->first[k] += paths->first[k - 1];
  for (size_t i = 0; i < graph->pixels.n_links; i++)
    {
      paths->link[paths->first[graph->pixels.link[i].a + 1]++] = i;
      paths->link[paths->first[graph->pixels.link[i].b + 1]++] = i;
    }
  return CELD_OK;
}

/* The node at the other end of a link. */
static uint32_t
other_of (const CeldCutGraph *graph, size_t link, uint32_t k)
{
  return graph->pixels.link[link].a == k ? graph->pixels.link[link].b : graph->pixels.link[link].a;
}

/* Marks the nodes that are not connected to the first end. */
static void
mark_unreachable (CeldCutGraph *graph, Paths *paths)
{
  size_t n = 0;

  for (size_t k = 0; k < graph->n; k++)
    graph->node[k].unreachable = true;
  paths->queue[n++] = graph->at_end[0];
  graph->node[graph->at_end[0]].unreachable = false;
  for (size_t i = 0; i < n; i++)
    for (size_t j = paths->first[paths->queue[i]]; j < paths->first[paths->queue[i] + 1]; j++)
      {
        uint32_t other = other_of (graph, paths->link[j], paths->queue[i]);

        if (graph->node[other].unreachable)
          paths->queue[n++] = other;
        graph->node[other].unreachable = false;
      }
}

static double
step_between (const CeldCutGraph *graph, size_t link)
{
  const CeldCutNode *a = &graph->node[graph->pixels.link[link].a], *b = &graph->node[graph->pixels.link[link].b];
  double             x = (a->seeded ? a->seed_x : a->x + a->size / 2) - (b->seeded ? b->seed_x : b->x + b->size / 2);
  double             y = (a->seeded ? a->seed_y : a->y + a->size / 2) - (b->seeded ? b->seed_y : b->y + b->size / 2);

  return hypot (x, y) * (a->ink || b->ink || !graph->uncertain[link] ? INK_STEP : 1);
}

/* Finds the shortest path from each node to a seed: nodes wait in a ring buffer until no path gets shorter. */
static void
find_shortest_paths (const CeldCutGraph *graph, Paths *paths)
{
  size_t n = 0;

  for (size_t k = 0; k < graph->n; k++)
    {
      paths->length[k] = graph->node[k].seeded && !graph->node[k].unreachable ? 0 : INFINITY;
      paths->queued[k] = paths->length[k] == 0;
      if (paths->queued[k])
        paths->queue[n++] = (uint32_t) k;
    }
  for (size_t first = 0; n; n--, first = first + 1 < graph->n ? first + 1 : 0)
    {
      uint32_t k = paths->queue[first];

      paths->queued[k] = false;
      for (size_t j = paths->first[k]; j < paths->first[k + 1]; j++)
        {
          uint32_t other = other_of (graph, paths->link[j], k);
          double   length = paths->length[k] + step_between (graph, paths->link[j]);

          if (length >= paths->length[other] - 1e-9)
            continue;
          paths->length[other] = length;
          if (!paths->queued[other])
            paths->queue[(first + n++) % graph->n] = other;
          paths->queued[other] = true;
        }
    }
}

/* The length of the path from end i to the region's seeds. */
static double
path_from (const CeldCutGraph *graph, const Paths *paths, int i)
{
  CeldRelationEnd    end = graph->cut->end[i];
  const CeldCutNode *node = &graph->node[graph->at_end[i]];

  return node->seeded ? hypot (end.x - node->seed_x, end.y - node->seed_y) : paths->length[graph->at_end[i]];
}

void
celd_cut_graph_note_seeds (CeldCutGraph *graph, uint32_t k, int x, int end, int y)
{
  CeldCutNode *node = &graph->node[k];

  for (int i = 0; i < 2; i++)
    {
      CeldRelationEnd at = graph->cut->end[i];
      int             near = at.x < x ? x : at.x >= end ? end - 1 : at.x;

      if (k == graph->at_end[i] &&
          (!node->seeded || hypot (near - at.x, y - at.y) < hypot (node->seed_x - at.x, node->seed_y - at.y)))
        {
          node->seeded = true;
          node->seed_x = near;
          node->seed_y = y;
        }
    }
  if (!node->seeded)
    {
      node->seeded = true;
      node->seed_x = x;
      node->seed_y = y;
    }
}

CeldStatus
celd_cut_graph_find_kept_end (CeldCutGraph *graph, int *kept)
{
  Paths      paths;
  CeldStatus status = paths_new (graph, &paths);

  if (status == CELD_OK)
    {
      mark_unreachable (graph, &paths);
      find_shortest_paths (graph, &paths);
      *kept = graph->node[graph->at_end[1]].unreachable ? -1 :
      path_from (graph, &paths, 0) < path_from (graph, &paths, 1) ? 0 : 1;
    }
  paths_clear (&paths);
  return status;
}

/* ------------------------------------------------------------------ minimum cut */

CeldStatus
celd_cut_graph_solve (CeldCutGraph *graph, int kept, const CeldHost *host)
{
  const CeldCut *cut = graph->cut;
  int            source = cut->discs[1 - kept].clearance > cut->discs[kept].clearance ? 1 - kept : kept;
  int64_t       *terminal = celd_alloc (graph->n, sizeof *terminal);
  uint8_t       *side = celd_alloc (graph->n, 1);
  CeldStatus     status = terminal && side ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < graph->n && status == CELD_OK; k++)
    {
      const CeldCutNode *node = &graph->node[k];

      terminal[k] = node->unreachable ? 0 : node->terminal + HARD_TERMINAL * (node->forced[0] - node->forced[1]);
      terminal[k] = source == 0 ? terminal[k] : -terminal[k];
    }
  if (status == CELD_OK)
    status = celd_flow (graph->n, graph->pixels.link, graph->pixels.n_links, terminal, host, side, NULL);
  for (size_t k = 0; k < graph->n && status == CELD_OK; k++)
    graph->node[k].side = graph->node[k].unreachable                ? CELD_OUTSIDE
                       : (side[k] != 0) == (source == 0) ? CELD_NEAR_FIRST : CELD_NEAR_SECOND;
  celd_free (terminal);
  celd_free (side);
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
