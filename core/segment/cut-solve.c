/* The minimum cut of a region's graph, and which end of it is nearer to the seeds of the region: by the shortest path
 * from node to node, where ink counts as longer.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/splits.h"
#include "solve/maxflow.h"

#include <math.h>

#define INK_STEP      8                   /* length of a step through ink, in steps on paper (chosen) */
#define HARD_TERMINAL ((int64_t) 1 << 48) /* of forced nodes: above any cut */

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
