/* A region, cut between whole basins: where a narrow place parts the two ends, that is where the cut belongs, and the
 * basins meet there already.  Blocks (basins.h) are what no narrow place parts: they stay whole.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/cut.h"
#include "segment/seeds.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#define GLUE ((int64_t) 1 << 44) /* what parting a block costs more: than any cut, less than moving an end */

static CeldStatus
add_basins (CeldMesh *mesh)
{
  const CeldCut    *cut = mesh->cut;
  const CeldBasins *basins = cut->canvas->basins;

  mesh->node = celd_alloc (cut->n, sizeof *mesh->node);
  if (!mesh->node)
    return CELD_NO_MEMORY;
  for (size_t k = 0; k < cut->n; k++)
    {
      const CeldBasin *basin = &basins->basin[cut->basin[k]];

      mesh->node[mesh->n++] = (CeldCutNode) {
        .x = basin->x, .y = basin->y, .ink = basin->solid, .basin = cut->basin[k],
      };
    }
  for (int i = 0; i < 2; i++)
    mesh->at_end[i] = cut->at[celd_basin_at (basins, cut->end[i].x, cut->end[i].y)] - 1;
  return CELD_OK;
}

static CeldStatus
add_borders (CeldMesh *mesh)
{
  const CeldCut    *cut = mesh->cut;
  const CeldBasins *basins = cut->canvas->basins;
  size_t            n = 0;

  for (size_t i = 0; i < basins->n_borders; i++)
    n += cut->at[basins->border[i].a] && cut->at[basins->border[i].b];
  mesh->link  = celd_alloc (n, sizeof *mesh->link);
  mesh->loose = celd_alloc (n, sizeof *mesh->loose);
  if (!mesh->link || !mesh->loose)
    return CELD_NO_MEMORY;
  for (size_t i = 0; i < basins->n_borders; i++)
    {
      const CeldBorder *border = &basins->border[i];
      uint32_t          a = cut->at[border->a], b = cut->at[border->b];
      int64_t           glue = basins->block[border->a] == basins->block[border->b] ? GLUE : 0;

      if (!a || !b)
        continue;
      mesh->loose[mesh->n_links] = border->passes > 0;
      mesh->link[mesh->n_links++] = (CeldLink) { a - 1, b - 1, border->cost + glue };
    }
  return CELD_OK;
}

/* Counts the region's seeds in row y of its basins, both runs from left to right, and notes where they are. */
static void
count_seeds (CeldMesh *mesh, int y, size_t *seeds)
{
  const CeldCut     *cut = mesh->cut;
  const CeldBasins  *basins = cut->canvas->basins;
  const CeldSeedRow *row = &cut->canvas->seeds.row[y];

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
          celd_mesh_note_seeds (mesh, at - 1, x, end, y);
        }
    }
}

/* Seeds pull to the end that is kept, but for those in the block of the other. */
static void
pull (CeldMesh *mesh, const size_t *seeds, int kept)
{
  const uint32_t *block = mesh->cut->canvas->basins->block;
  uint32_t        new_block = block[mesh->node[mesh->at_end[1 - kept]].basin];
  int32_t         vote = celd_canvas_vote (mesh->cut->canvas, mesh->cut->label);

  for (size_t k = 0; k < mesh->n; k++)
    {
      CeldCutNode *node = &mesh->node[k];

      if (!seeds[k] || block[node->basin] == new_block)
        continue;
      node->pulled[kept] = vote == CELD_HARD;
      if (vote != CELD_HARD)
        node->pull = (int64_t) seeds[k] * (kept == 0 ? vote : -vote);
    }
  mesh->node[mesh->at_end[0]].pulled[0] = true;
  mesh->node[mesh->at_end[1]].pulled[1] = true;
}

CeldStatus
celd_cut_basins (const CeldCut *cut, const CeldHost *host, uint8_t *side, int *kept)
{
  CeldMesh   mesh = { .cut = cut };
  size_t    *seeds = celd_alloc0 (cut->n, sizeof *seeds);
  CeldStatus status = seeds ? add_basins (&mesh) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    status = add_borders (&mesh);
  for (int y = cut->top; y <= cut->bottom && status == CELD_OK; y++)
    count_seeds (&mesh, y, seeds);
  if (status == CELD_OK)
    status = celd_mesh_kept (&mesh, kept);
  if (status == CELD_OK && *kept >= 0)
    {
      pull (&mesh, seeds, *kept);
      status = celd_mesh_solve (&mesh, *kept, host);
    }
  for (size_t k = 0; k < mesh.n && status == CELD_OK; k++)
    side[k] = mesh.node[k].side;
  celd_free (seeds);
  celd_mesh_clear (&mesh);
  return status;
}
