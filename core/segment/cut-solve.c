/* The smallest cut of the graph of a region; and which end of it is nearer to the seeds that the region has: ways lead
 * from node to node and avoid ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "segment/splits.h"
#include "solve/maxflow.h"

#include <math.h>

#define INK_STEP  8                     /* times as long as a step on paper */
#define HARD_PULL ((int64_t) 1 << 48)

/* The links by node: those of node k are link[first[k]] to link[first[k + 1] - 1]. */
typedef struct { size_t *first, *link; uint32_t *queue; double *way; bool *queued; } Ways;

static void
ways_clear (Ways *ways)
{
  celd_free (ways->first);
  celd_free (ways->link);
  celd_free (ways->queue);
  celd_free (ways->way);
  celd_free (ways->queued);
}

static CeldStatus
ways_new (const CeldMesh *mesh, Ways *ways)
{
  *ways = (Ways) {
    celd_alloc0 (mesh->n + 2, sizeof *ways->first), celd_alloc (2 * mesh->n_links, sizeof *ways->link),
    celd_alloc (mesh->n, sizeof *ways->queue), celd_alloc (mesh->n, sizeof *ways->way),
    celd_alloc0 (mesh->n, sizeof *ways->queued)
  };
  if (!ways->first || !ways->link || !ways->queue || !ways->way || !ways->queued)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < mesh->n_links; i++)
    {
      ways->first[mesh->link[i].a + 2]++;
      ways->first[mesh->link[i].b + 2]++;
    }
  for (size_t k = 1; k < mesh->n + 2; k++)
    ways->first[k] += ways->first[k - 1];
  for (size_t i = 0; i < mesh->n_links; i++)
    {
      ways->link[ways->first[mesh->link[i].a + 1]++] = i;
      ways->link[ways->first[mesh->link[i].b + 1]++] = i;
    }
  return CELD_OK;
}

/* The node at the other end of a link. */
static uint32_t
other_of (const CeldMesh *mesh, size_t link, uint32_t k)
{
  return mesh->link[link].a == k ? mesh->link[link].b : mesh->link[link].a;
}

/* What does not join the first end is lost. */
static void
lose_others (CeldMesh *mesh, Ways *ways)
{
  size_t n = 0;

  for (size_t k = 0; k < mesh->n; k++)
    mesh->node[k].lost = true;
  ways->queue[n++] = mesh->at_end[0];
  mesh->node[mesh->at_end[0]].lost = false;
  for (size_t i = 0; i < n; i++)
    for (size_t j = ways->first[ways->queue[i]]; j < ways->first[ways->queue[i] + 1]; j++)
      {
        uint32_t other = other_of (mesh, ways->link[j], ways->queue[i]);

        if (mesh->node[other].lost)
          ways->queue[n++] = other;
        mesh->node[other].lost = false;
      }
}

static double
step_between (const CeldMesh *mesh, size_t link)
{
  const CeldCutNode *a = &mesh->node[mesh->link[link].a], *b = &mesh->node[mesh->link[link].b];
  double             x = (a->seeded ? a->seed_x : a->x + a->size / 2) - (b->seeded ? b->seed_x : b->x + b->size / 2);
  double             y = (a->seeded ? a->seed_y : a->y + a->size / 2) - (b->seeded ? b->seed_y : b->y + b->size / 2);

  return hypot (x, y) * (a->ink || b->ink || !mesh->loose[link] ? INK_STEP : 1);
}

/* The shortest way from each node to a seed: nodes wait in a ring until no way gets shorter. */
static void
find_ways (const CeldMesh *mesh, Ways *ways)
{
  size_t n = 0;

  for (size_t k = 0; k < mesh->n; k++)
    {
      ways->way[k] = mesh->node[k].seeded && !mesh->node[k].lost ? 0 : INFINITY;
      ways->queued[k] = ways->way[k] == 0;
      if (ways->queued[k])
        ways->queue[n++] = (uint32_t) k;
    }
  for (size_t first = 0; n; n--, first = first + 1 < mesh->n ? first + 1 : 0)
    {
      uint32_t k = ways->queue[first];

      ways->queued[k] = false;
      for (size_t j = ways->first[k]; j < ways->first[k + 1]; j++)
        {
          uint32_t other = other_of (mesh, ways->link[j], k);
          double   way = ways->way[k] + step_between (mesh, ways->link[j]);

          if (way >= ways->way[other] - 1e-9)
            continue;
          ways->way[other] = way;
          if (!ways->queued[other])
            ways->queue[(first + n++) % mesh->n] = other;
          ways->queued[other] = true;
        }
    }
}

/* How far end i is from the region's seeds. */
static double
way_from (const CeldMesh *mesh, const Ways *ways, int i)
{
  CeldRelationEnd            end = mesh->cut->end[i];
  const CeldCutNode *node = &mesh->node[mesh->at_end[i]];

  return node->seeded ? hypot (end.x - node->seed_x, end.y - node->seed_y) : ways->way[mesh->at_end[i]];
}

void
celd_mesh_note_seeds (CeldMesh *mesh, uint32_t k, int x, int end, int y)
{
  CeldCutNode *node = &mesh->node[k];

  for (int i = 0; i < 2; i++)
    {
      CeldRelationEnd at = mesh->cut->end[i];
      int     near = at.x < x ? x : at.x >= end ? end - 1 : at.x;

      if (k == mesh->at_end[i] &&
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
celd_mesh_kept (CeldMesh *mesh, int *kept)
{
  Ways       ways;
  CeldStatus status = ways_new (mesh, &ways);

  if (status == CELD_OK)
    {
      lose_others (mesh, &ways);
      find_ways (mesh, &ways);
      *kept = mesh->node[mesh->at_end[1]].lost ? -1 : way_from (mesh, &ways, 0) < way_from (mesh, &ways, 1) ? 0 : 1;
    }
  ways_clear (&ways);
  return status;
}

/* ------------------------------------------------------------------ the smallest cut */

CeldStatus
celd_mesh_solve (CeldMesh *mesh, int kept, const CeldHost *host)
{
  const CeldCut *cut = mesh->cut;
  int            source = cut->discs[1 - kept].room > cut->discs[kept].room ? 1 - kept : kept;
  int64_t       *pull = celd_alloc (mesh->n, sizeof *pull);
  uint8_t       *side = celd_alloc (mesh->n, 1);
  CeldStatus     status = pull && side ? CELD_OK : CELD_NO_MEMORY;

  for (size_t k = 0; k < mesh->n && status == CELD_OK; k++)
    {
      const CeldCutNode *node = &mesh->node[k];

      pull[k] = node->lost ? 0 : node->pull + HARD_PULL * (node->pulled[0] - node->pulled[1]);
      pull[k] = source == 0 ? pull[k] : -pull[k];
    }
  if (status == CELD_OK)
    status = celd_flow (mesh->n, mesh->link, mesh->n_links, pull, host, side, NULL);
  for (size_t k = 0; k < mesh->n && status == CELD_OK; k++)
    mesh->node[k].side = mesh->node[k].lost                ? CELD_OUTSIDE
                       : (side[k] != 0) == (source == 0) ? CELD_NEAR_FIRST : CELD_NEAR_SECOND;
  celd_free (pull);
  celd_free (side);
  return status;
}

void
celd_mesh_clear (CeldMesh *mesh)
{
  celd_free (mesh->size);
  celd_free (mesh->open);
  celd_free (mesh->kind);
  celd_free (mesh->stack);
  celd_free (mesh->node);
  celd_free (mesh->link);
  celd_free (mesh->loose);
  celd_free (mesh->recent);
}
