/* Mesh simplification: a quadtree, built from single pixels upwards.
 *
 * Four squares are merged if there is no cut inside and the four triangles between the corners and the centre of the
 * merged square deviate by at most the error at every corner of a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/mesh.h"

#include <math.h>

typedef struct { const CeldMeshPoints *points; const CeldRelief *relief; double error; } Surface;

/* Height of the surface at the corner (x,y), seen from inside the square that ends at (end_x,end_y). */
static double
height_at (const CeldMeshPoints *c, int x, int y, int end_x, int end_y)
{
  int direction = x < end_x ? (y < end_y ? CELD_SOUTH_EAST : CELD_NORTH_EAST)
                            : (y < end_y ? CELD_SOUTH_WEST : CELD_NORTH_WEST);

  return (double) c->z[celd_mesh_point_at (c, x, y, direction)];
}

/* Is the surface uncut along the lines that divide the square into four? */
static bool
goes_on (const CeldRelief *r, int x, int y, int side)
{
  int middle_x = x + side / 2 - 1, middle_y = y + side / 2 - 1; /* pixels just before the lines */

  for (int i = 0; i < side; i++)
    if (r->cut[(size_t) (y + i) * (size_t) r->width + (size_t) middle_x] & CELD_CUT_RIGHT ||
        r->cut[(size_t) middle_y * (size_t) r->width + (size_t) (x + i)] & CELD_CUT_BELOW)
      return false;
  return true;
}

/* Do the four triangles approximate the surface within the error? */
static bool
is_flat (const Surface *s, int x, int y, int side)
{
  int    end_x = x + side, end_y = y + side;
  double half = 0.5 * side, middle = height_at (s->points, x + side / 2, y + side / 2, end_x, end_y);
  double z[2][2] = { { height_at (s->points, x, y, end_x, end_y), height_at (s->points, end_x, y, end_x, end_y) },
                     { height_at (s->points, x, end_y, end_x, end_y),
                       height_at (s->points, end_x, end_y, end_x, end_y) } };

  for (int j = 0; j <= side; j++)
    for (int i = 0; i <= side; i++)
      {
        double u = i - half, v = j - half, out = fmax (fabs (u), fabs (v)) / half, along, a, b;

        if (fabs (v) >= fabs (u)) /* above or below the centre */
          a = z[v > 0][0], b = z[v > 0][1], along = u;
        else
          a = z[0][u > 0], b = z[1][u > 0], along = v;
        along = out > 0 ? 0.5 + 0.5 * along / (out * half) : 0;
        if (fabs ((1 - out) * middle + out * (a + along * (b - a))
                  - height_at (s->points, x + i, y + j, end_x, end_y)) > s->error)
          return false;
      }
  return true;
}

static bool
is_whole (const CeldQuadtree *b, int k, int x, int y)
{
  return k == 0 || b->whole[k][(size_t) y * (size_t) (b->width >> k) + (size_t) x];
}

/* Merges squares into those of 2^k pixels. */
static CeldStatus
join_squares (const Surface *s, int k, const CeldHost *host, CeldQuadtree *b)
{
  int w = b->width >> k, h = b->height >> k;

  b->whole[k] = celd_alloc ((size_t) w * (size_t) h, 1);
  if (!b->whole[k])
    return CELD_NO_MEMORY;
  for (int y = 0; y < h; y++)
    {
      if (celd_progress (host, (k - 1 + (double) y / h) / CELD_QUADTREE_SIZES) != CELD_OK)
        return CELD_CANCELLED;
      for (int x = 0; x < w; x++)
        b->whole[k][(size_t) y * (size_t) w + (size_t) x] =
          is_whole (b, k - 1, 2 * x, 2 * y) && is_whole (b, k - 1, 2 * x + 1, 2 * y) &&
          is_whole (b, k - 1, 2 * x, 2 * y + 1) && is_whole (b, k - 1, 2 * x + 1, 2 * y + 1) &&
          goes_on (s->relief, x << k, y << k, 1 << k) && is_flat (s, x << k, y << k, 1 << k);
    }
  return CELD_OK;
}

CeldStatus
celd_quadtree_new (const CeldMeshPoints *points, const CeldRelief *relief, double error, const CeldHost *host,
                 CeldQuadtree *quadtree)
{
  Surface    s = { points, relief, error };
  CeldStatus status = CELD_OK;

  *quadtree = (CeldQuadtree) { .width = relief->width, .height = relief->height };
  for (int k = 1; k < CELD_QUADTREE_SIZES && status == CELD_OK; k++)
    status = join_squares (&s, k, host, quadtree);
  return status;
}

bool
celd_quadtree_is_leaf (const CeldQuadtree *b, int k, int x, int y)
{
  if (!is_whole (b, k, x, y))
    return false;
  k++;
  x /= 2;
  y /= 2;
  return k == CELD_QUADTREE_SIZES || x >= b->width >> k || y >= b->height >> k || !is_whole (b, k, x, y);
}

void
celd_quadtree_clear (CeldQuadtree *quadtree)
{
  for (int k = 1; k < CELD_QUADTREE_SIZES; k++)
    celd_free (quadtree->whole[k]);
  *quadtree = (CeldQuadtree) { .width = 0 };
}
