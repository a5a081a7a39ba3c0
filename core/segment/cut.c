/* A region, cut between two points of it: the smallest sum of V of LazyBrush [SDC09b] over the border.
 *
 * The cut is found on squares that are small beside the ends and larger the farther away they are, and then again and
 * again in a band along the last one, of squares a quarter as large, down to pixels (H. Lombaert et al., "A multilevel
 * banded graph cuts method for fast image segmentation", ICCV 2005; theirs has one size of squares in a pass).  What
 * this costs goes by the region's pixels once, for looking at the drawing, and else by the length of the cut.
 *
 * Of all smallest cuts it is the one nearest to the end that has more room: a limb reaches to where the body begins.
 * Seeds that the region has pull to the end that keeps its label.
 *
 * Where a narrow place parts the two ends, that is where the cut belongs, and the basins meet there already: the region is
 * cut between whole basins.  Blocks (basins.h) are what no narrow place parts: they stay whole.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/image.h"
#include "segment/basins.h"
#include "segment/canvas.h"
#include "segment/splits.h"
#include "solve/maxflow.h"
#include "solve/partition.h"

#include <math.h>
#include <string.h>

#define PER_REACH 8                     /* squares on the way between the ends; those as far away are as large */
#define FINER     4                     /* times, from one band to the next */
#define GLUE ((int64_t) 1 << 44) /* what parting a block costs more: than any cut, less than moving an end */

/* ------------------------------------------------------------------ squares */

static CeldStatus
mesh_new (const CeldCut *cut, CeldMesh *mesh)
{
  size_t n;

  *mesh = (CeldMesh) {
    .cut     = cut,
    .columns = (cut->right - cut->left) / CELD_CUT_SQUARE + 1,
    .rows    = (cut->bottom - cut->top) / CELD_CUT_SQUARE + 1,
    .kind    = celd_alloc (CELD_CUT_SQUARE * CELD_CUT_SQUARE, sizeof *mesh->kind),
    .stack   = celd_alloc (CELD_CUT_SQUARE * CELD_CUT_SQUARE, sizeof *mesh->stack),
    .recent  = celd_alloc0 (CELD_RECENT, sizeof *mesh->recent),
  };
  n = (size_t) mesh->columns * (size_t) mesh->rows;
  mesh->size = celd_alloc (n, 1);
  mesh->open = celd_alloc (n, 1);
  return mesh->kind && mesh->stack && mesh->recent && mesh->size && mesh->open ? CELD_OK : CELD_NO_MEMORY;
}

/* How far the interval from `a` to `b` is from one that starts at x and is a tile long. */
static int
distance_to_tile (int a, int b, int x)
{
  int low = a < b ? a : b, high = a < b ? b : a;

  return x > high ? x - high : x + CELD_CUT_SQUARE < low ? low - x - CELD_CUT_SQUARE : 0;
}

static void
set_sizes (CeldMesh *mesh)
{
  const CeldCut *cut = mesh->cut;
  double         apart = celd_ends_apart (cut->end[0], cut->end[1]);

  for (int t = 0; t < mesh->columns * mesh->rows; t++)
    {
      int    x = distance_to_tile (cut->end[0].x, cut->end[1].x, cut->left + t % mesh->columns * CELD_CUT_SQUARE);
      int    y = distance_to_tile (cut->end[0].y, cut->end[1].y, cut->top + t / mesh->columns * CELD_CUT_SQUARE);
      double wanted = fmax (apart, x > y ? x : y) / PER_REACH;
      int    size = 1;

      while (2 * size <= wanted && size < CELD_CUT_SQUARE)
        size *= 2;
      mesh->size[t] = (uint8_t) size;
      mesh->open[t] = true;
    }
}

/* ------------------------------------------------------------------ what pulls */

static bool
in_disc (const CeldDiscs *discs, int x, int y)
{
  int from, end;

  for (int k = 0; k < 2; k++)
    if (celd_disc_row (&discs->disc[k], y, &from, &end) && x >= from && x < end)
      return true;
  return false;
}

static void
pull_disc (CeldMesh *mesh, const CeldDisc *disc, int i)
{
  const CeldCut *cut = mesh->cut;
  int            r = (int) disc->radius, x, end;

  for (int y = disc->y - r < cut->top ? cut->top : disc->y - r; y <= disc->y + r && y <= cut->bottom; y++)
    if (celd_disc_row (disc, y, &x, &end))
      for (x = x < cut->left ? cut->left : x; x < end && x <= cut->right;)
        {
          bool         inside = cut->mark[celd_cut_pixel (cut, x, y)] == CELD_INSIDE;
          CeldCutNode *node = inside ? &mesh->node[celd_mesh_at (mesh, x, y)] : NULL;

          if (node)
            node->pulled[i] = true;
          x = node ? celd_mesh_next (node, x, end) : x + 1;
        }
}

static void
note_seeds (CeldMesh *mesh, uint32_t k, int x, int end, int y, int kept)
{
  (void) kept;
  celd_mesh_note_seeds (mesh, k, x, end, y);
}

static void
pull_seeds (CeldMesh *mesh, uint32_t k, int x, int end, int y, int kept)
{
  const CeldCut *cut = mesh->cut;
  CeldCutNode   *node = &mesh->node[k];
  int32_t        vote = celd_canvas_vote (cut->canvas, cut->label);

  if (node->pulled[1 - kept] && in_disc (&cut->discs[1 - kept], x, y) && in_disc (&cut->discs[1 - kept], end - 1, y))
    return;
  if (vote == CELD_HARD)
    node->pulled[kept] = true;
  else
    node->pull += (int64_t) (end - x) * (kept == 0 ? vote : -vote);
}

/* ------------------------------------------------------------------ one level */

/* Tells the pixels of each square by the side of their nodes; of lost nodes they are outside from now on. */
static CeldStatus
tell_square (CeldMesh *mesh, int x, int y, int right, int bottom, int size)
{
  const CeldCut *cut = mesh->cut;
  size_t         corner = celd_cut_pixel (cut, x, y);
  bool           whole = cut->mark[corner] == CELD_INSIDE && mesh->node[cut->node[corner]].whole;

  (void) size;
  for (int v = y; v < bottom; v++)
    {
      uint8_t *mark = cut->mark + celd_cut_pixel (cut, 0, v);

      if (whole)
        memset (mark + x, mesh->node[cut->node[corner]].side, (size_t) (right - x));
      else
        for (int u = x; u < right; u++)
          mark[u] = mark[u] == CELD_INSIDE ? mesh->node[cut->node[celd_cut_pixel (cut, u, v)]].side : mark[u];
    }
  return CELD_OK;
}

/* Takes back what is told of a node's square and those around it. */
static void
open_around (CeldMesh *mesh, const CeldCutNode *node)
{
  const CeldCut *cut = mesh->cut;
  int            left = node->x - node->size, right = node->x + 2 * node->size;
  int            top = node->y - node->size, bottom = node->y + 2 * node->size;

  left   = left < cut->left ? cut->left : left;
  top    = top < cut->top ? cut->top : top;
  right  = right > cut->right ? cut->right + 1 : right;
  bottom = bottom > cut->bottom ? cut->bottom + 1 : bottom;
  for (int y = top; y < bottom; y++)
    for (int x = left; x < right; x++)
      if (cut->mark[celd_cut_pixel (cut, x, y)] != CELD_OUTSIDE)
        cut->mark[celd_cut_pixel (cut, x, y)] = CELD_INSIDE;
  for (int y = (top - cut->top) / CELD_CUT_SQUARE; y <= (bottom - 1 - cut->top) / CELD_CUT_SQUARE; y++)
    for (int x = (left - cut->left) / CELD_CUT_SQUARE; x <= (right - 1 - cut->left) / CELD_CUT_SQUARE; x++)
      mesh->open[y * mesh->columns + x] = true;
}

/* Was something pulled to the other side than where it is? */
static bool
is_torn (const CeldCutNode *node)
{
  return (node->pulled[0] && node->side == CELD_NEAR_SECOND) || (node->pulled[1] && node->side == CELD_NEAR_FIRST);
}

/* Opens a band along the cut where its squares are larger than pixels; false if they are not, anywhere.  In ink that
 * parts two basins the cut is in the middle of the line already. */
static bool
refine (CeldMesh *mesh)
{
  bool any = false;

  memset (mesh->open, 0, (size_t) mesh->columns * (size_t) mesh->rows);
  for (size_t k = 0; k < mesh->n; k++)
    mesh->node[k].cut = mesh->node[k].size > 1 && is_torn (&mesh->node[k]);
  for (size_t i = 0; i < mesh->n_links; i++)
    {
      CeldCutNode *a = &mesh->node[mesh->link[i].a], *b = &mesh->node[mesh->link[i].b];

      if (mesh->loose[i] && a->side != b->side && (a->size > 1 || b->size > 1))
        a->cut = b->cut = true;
    }
  for (size_t k = 0; k < mesh->n; k++)
    if (mesh->node[k].cut)
      {
        open_around (mesh, &mesh->node[k]);
        any = true;
      }
  for (int t = 0; t < mesh->columns * mesh->rows; t++)
    if (mesh->open[t])
      mesh->size[t] = (uint8_t) (mesh->size[t] > FINER ? mesh->size[t] / FINER : 1);
  return any;
}

/* ------------------------------------------------------------------ the cut on squares */

CeldStatus
celd_cut (CeldCut *cut, const CeldHost *host, int *kept)
{
  CeldMesh   mesh;
  CeldStatus status = mesh_new (cut, &mesh);

  if (status != CELD_OK)
    goto done;
  set_sizes (&mesh);
  status = celd_mesh_build (&mesh);
  if (status != CELD_OK)
    goto done;
  for (int i = 0; i < 2; i++)
    mesh.at_end[i] = celd_mesh_at (&mesh, cut->end[i].x, cut->end[i].y);
  celd_mesh_seeds (&mesh, note_seeds, 0);
  status = celd_mesh_kept (&mesh, kept);
  while (status == CELD_OK && *kept >= 0)
    {
      for (int k = 0; k < 4; k++)
        pull_disc (&mesh, &cut->discs[k / 2].disc[k % 2], k / 2);
      celd_mesh_seeds (&mesh, pull_seeds, *kept);
      status = celd_mesh_solve (&mesh, *kept, host);
      if (status == CELD_OK)
        status = celd_mesh_squares (&mesh, tell_square);
      if (status != CELD_OK || !refine (&mesh))
        break;
      status = celd_mesh_build (&mesh);
    }

done:
  celd_mesh_clear (&mesh);
  return status;
}

/* ------------------------------------------------------------------ between whole basins */

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
