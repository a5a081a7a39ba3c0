/* Which end of a cut is nearer to the seeds that the region has: ways lead from node to node and avoid ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cut.h"

#include <math.h>

#define INK_STEP 8 /* times as long as a step on paper */

/* The links by node: those of node k are other[first[k]] to other[first[k + 1] - 1]. */
typedef struct { size_t *first; uint32_t *other, *queue; double *way; bool *queued; } Ways;

static void
ways_clear (Ways *ways)
{
  celd_free (ways->first);
  celd_free (ways->other);
  celd_free (ways->queue);
  celd_free (ways->way);
  celd_free (ways->queued);
}

static CeldStatus
ways_new (const CeldMesh *mesh, Ways *ways)
{
  *ways = (Ways) {
    celd_alloc0 (mesh->n + 2, sizeof *ways->first), celd_alloc (2 * mesh->n_links, sizeof *ways->other),
    celd_alloc (mesh->n, sizeof *ways->queue), celd_alloc (mesh->n, sizeof *ways->way),
    celd_alloc0 (mesh->n, sizeof *ways->queued)
  };
  if (!ways->first || !ways->other || !ways->queue || !ways->way || !ways->queued)
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
      ways->other[ways->first[mesh->link[i].a + 1]++] = mesh->link[i].b;
      ways->other[ways->first[mesh->link[i].b + 1]++] = mesh->link[i].a;
    }
  return CELD_OK;
}

/* What does not join the first end is lost. */
static void
lose_others (CeldMesh *mesh, Ways *ways)
{
  size_t n = 0;

  for (size_t k = 0; k < mesh->n; k++)
    mesh->node[k].lost = true;
  ways->queue[n] = mesh->cut->node[celd_cut_pixel (mesh->cut, mesh->cut->end[0].x, mesh->cut->end[0].y)];
  mesh->node[ways->queue[n++]].lost = false;
  for (size_t i = 0; i < n; i++)
    for (size_t j = ways->first[ways->queue[i]]; j < ways->first[ways->queue[i] + 1]; j++)
      if (mesh->node[ways->other[j]].lost)
        {
          mesh->node[ways->other[j]].lost = false;
          ways->queue[n++] = ways->other[j];
        }
}

static void
note_seed (CeldMesh *mesh, CeldCutNode *node, int x, int y, int kept)
{
  (void) mesh, (void) kept;
  if (node->seeded)
    return;
  node->seeded = true;
  node->seed_x = x;
  node->seed_y = y;
}

static double
step_between (const CeldCutNode *a, const CeldCutNode *b)
{
  double x = (a->seeded ? a->seed_x : a->x + a->size / 2) - (b->seeded ? b->seed_x : b->x + b->size / 2);
  double y = (a->seeded ? a->seed_y : a->y + a->size / 2) - (b->seeded ? b->seed_y : b->y + b->size / 2);

  return hypot (x, y) * (a->ink || b->ink ? INK_STEP : 1);
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
          uint32_t other = ways->other[j];
          double   way = ways->way[k] + step_between (&mesh->node[k], &mesh->node[other]);

          if (way >= ways->way[other] - 1e-9)
            continue;
          ways->way[other] = way;
          if (!ways->queued[other])
            ways->queue[(first + n++) % mesh->n] = other;
          ways->queued[other] = true;
        }
    }
}

/* How far an end is from the region's seeds. */
static double
way_from (const CeldMesh *mesh, const Ways *ways, CeldEnd end)
{
  uint32_t           k = mesh->cut->node[celd_cut_pixel (mesh->cut, end.x, end.y)];
  const CeldCutNode *node = &mesh->node[k];

  if (celd_seed_rows_at (&mesh->cut->canvas->seeds, end.x, end.y) == mesh->cut->label)
    return 0;
  return node->seeded ? fmax (0.5, hypot (end.x - node->seed_x, end.y - node->seed_y)) : ways->way[k];
}

CeldStatus
celd_mesh_kept (CeldMesh *mesh, int *kept)
{
  const CeldCut *cut = mesh->cut;
  Ways           ways;
  CeldStatus     status = ways_new (mesh, &ways);

  if (status == CELD_OK)
    {
      lose_others (mesh, &ways);
      celd_mesh_seeds (mesh, note_seed, 0);
      find_ways (mesh, &ways);
      *kept = mesh->node[cut->node[celd_cut_pixel (cut, cut->end[1].x, cut->end[1].y)]].lost ? -1
            : way_from (mesh, &ways, cut->end[0]) < way_from (mesh, &ways, cut->end[1]) ? 0 : 1;
    }
  ways_clear (&ways);
  return status;
}
