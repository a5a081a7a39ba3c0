/* A relief as a triangle mesh (section 5, Figure 1h).
 *
 * Vertices lie at corners of pixels, two or more where the surface is cut.  Each square of the quadtree
 * (mesh-surface.c) is a fan round its centre through all vertices on its boundary, its own and its neighbours',
 * so that the mesh has no T-junctions.  Squares are flat within half of the permitted error, and fans then within all
 * of it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/relief.h"

#include <math.h>

/* ------------------------------------------------------------------ vertices */

static void
use_point (CeldMeshBuilder *m, int x, int y, int direction)
{
  m->vertex[celd_mesh_point_at (m->points, x, y, direction)] = 1;
}

/* Marks the corners of a square, and its centre. */
static void
use_square (CeldMeshBuilder *m, int x, int y, int side)
{
  use_point (m, x, y, CELD_SOUTH_EAST);
  use_point (m, x + side, y, CELD_SOUTH_WEST);
  use_point (m, x + side, y + side, CELD_NORTH_WEST);
  use_point (m, x, y + side, CELD_NORTH_EAST);
  if (side > 1)
    use_point (m, x + side / 2, y + side / 2, CELD_SOUTH_EAST);
}

/* Calls `body` for each leaf of the quadtree. */
static CeldStatus
for_squares (CeldMeshBuilder *m, const CeldHost *host, CeldStatus (*body) (CeldMeshBuilder *m, int x, int y, int side))
{
  int        w = m->relief->width, h = m->relief->height;
  CeldStatus status = CELD_OK;

  for (int k = 0; k < CELD_QUADTREE_SIZES; k++)
    for (int y = 0; y < h >> k && status == CELD_OK; y++)
      {
        if (y % 32 == 0)
          status = celd_progress (host, (k + (double) y / h) / CELD_QUADTREE_SIZES);
        for (int x = 0; x < w >> k && status == CELD_OK; x++)
          if (celd_quadtree_is_leaf (m->quadtree, k, x, y) &&
              !(k == 0 && m->skipped && m->skipped[(size_t) y * (size_t) w + (size_t) x]))
            status = body (m, x << k, y << k, 1 << k);
      }
  return status;
}

static CeldStatus
mark_square (CeldMeshBuilder *m, int x, int y, int side)
{
  use_square (m, x, y, side);
  return CELD_OK;
}

CeldStatus
celd_mesh_mark_points (CeldMeshBuilder *m, const CeldHost *host, size_t *n)
{
  const CeldMeshPoints *c = m->points;
  size_t                points = ((size_t) c->width + 1) * ((size_t) c->height + 1);
  CeldStatus            status;

  memset (m->vertex, 0, c->n * sizeof *m->vertex);
  status = for_squares (m, host, mark_square);
  for (size_t i = 0; i < points; i++)
    for (uint32_t p = c->first[i]; p < c->first[i + 1] && c->cracked[i]; p++)
      m->vertex[p] = 1;
  *n = 0;
  for (size_t p = 0; p < c->n; p++)
    *n += m->vertex[p];
  return status;
}

void
celd_mesh_make_vertices (CeldMeshBuilder *m)
{
  const CeldMeshPoints *c = m->points;

  for (int y = 0; y <= c->height; y++)
    for (int x = 0; x <= c->width; x++)
      {
        size_t corner = celd_mesh_corner_at (c, x, y);

        for (uint32_t p = c->first[corner]; p < c->first[corner + 1]; p++)
          if (m->vertex[p])
            m->vertex[p] = celd_mesh_add_vertex (m, x, y, (double) c->z[p]) + 1;
      }
}

/* ------------------------------------------------------------------ triangles */

/* Two triangles for a pixel, split along the diagonal with less slope. */
static CeldStatus
fill_pixel (CeldMeshBuilder *m, int x, int y)
{
  const CeldMeshPoints *c = m->points;
  uint32_t              point[4] = { celd_mesh_point_at (c, x, y, CELD_SOUTH_EAST),
                                     celd_mesh_point_at (c, x, y + 1, CELD_NORTH_EAST),
                                     celd_mesh_point_at (c, x + 1, y + 1, CELD_NORTH_WEST),
                                     celd_mesh_point_at (c, x + 1, y, CELD_SOUTH_WEST) };
  uint32_t              v[4];
  bool                  falls = fabsf (c->z[point[0]] - c->z[point[2]]) <= fabsf (c->z[point[1]] - c->z[point[3]]);
  CeldStatus            status;

  for (int k = 0; k < 4; k++)
    v[k] = m->vertex[point[k]] - 1;
  status = falls ? celd_mesh_add_triangle (m, v[0], v[1], v[2]) : celd_mesh_add_triangle (m, v[0], v[1], v[3]);
  if (status == CELD_OK)
    status = falls ? celd_mesh_add_triangle (m, v[0], v[2], v[3]) : celd_mesh_add_triangle (m, v[1], v[2], v[3]);
  return status;
}

/* The boundary of a square, counter-clockwise from its corner (x,y); `step` counts corners of pixels. */
static void
walk_outline (int x, int y, int side, int step, int *to_x, int *to_y, int *direction)
{
  static const int inside[4] = { CELD_SOUTH_EAST, CELD_NORTH_EAST, CELD_NORTH_WEST, CELD_SOUTH_WEST };
  int              leg = step / side % 4, along = step % side;

  *to_x      = leg == 0 ? x : leg == 1 ? x + along : leg == 2 ? x + side : x + side - along;
  *to_y      = leg == 0 ? y + along : leg == 1 ? y + side : leg == 2 ? y + side - along : y;
  *direction = inside[leg];
}

/* Adds a square as a fan round its centre, or a single pixel, with the walls of a solid. */
static CeldStatus
fill_square (CeldMeshBuilder *m, int x, int y, int side)
{
  const CeldMeshPoints *c = m->points;
  uint32_t              first = m->vertex[celd_mesh_point_at (c, x, y, CELD_SOUTH_EAST)], last = first, middle = 0;
  int                   last_x = x, last_y = y;
  CeldStatus            status = side > 1 ? CELD_OK : fill_pixel (m, x, y);

  if (side > 1)
    middle = m->vertex[celd_mesh_point_at (c, x + side / 2, y + side / 2, CELD_SOUTH_EAST)];
  for (int step = 1; step <= 4 * side && status == CELD_OK; step++)
    {
      int      to_x, to_y, direction;
      uint32_t next;

      walk_outline (x, y, side, step, &to_x, &to_y, &direction);
      next = m->vertex[celd_mesh_point_at (c, to_x, to_y, direction)];
      if (!next)
        continue;
      if (side > 1)
        status = celd_mesh_add_triangle (m, middle - 1, last - 1, next - 1);
      if (status == CELD_OK && m->solid)
        status = celd_mesh_add_wall (m, last_x, last_y, to_x, to_y);
      last   = next;
      last_x = to_x;
      last_y = to_y;
    }
  return status;
}

CeldStatus
celd_mesh_fill_squares (CeldMeshBuilder *m, const CeldHost *host)
{
  return for_squares (m, host, fill_square);
}

/* ------------------------------------------------------------------ */

/* A mesh with the squares that it is made of, and its number of vertices. */
typedef struct { CeldMeshBuilder *builder; CeldQuadtree *quadtree; size_t n; } SquareMesh;

/* Finds the squares for an error, and marks their vertices. */
static CeldStatus
find_squares (void *data, double error, const CeldHost *host, size_t *n)
{
  SquareMesh  *mesh = data;
  CeldHostPart part[2];
  CeldHost     merging = celd_host_part (&part[0], host, 0, 0.9), marking = celd_host_part (&part[1], host, 0.9, 1);
  CeldStatus   status;

  celd_quadtree_clear (mesh->quadtree);
  status = celd_quadtree_new (mesh->builder->points, mesh->builder->relief, error / 2, &merging, mesh->quadtree);
  if (status == CELD_OK)
    status = celd_mesh_mark_points (mesh->builder, &marking, &mesh->n);
  mesh->builder->mesh.error = error;
  *n = mesh->n;
  return status;
}

/* Allocates all vertices, including those of the bottom. */
static CeldStatus
mesh_new (CeldMeshBuilder *m, size_t n)
{
  if (m->solid)
    {
      n += 2 * ((size_t) m->relief->width + (size_t) m->relief->height) + 1;
      m->bottom_vertex = celd_alloc0 (((size_t) m->relief->width + 1) * ((size_t) m->relief->height + 1),
                                      sizeof *m->bottom_vertex);
      if (!m->bottom_vertex)
        return CELD_NO_MEMORY;
    }
  m->mesh.place  = celd_alloc (n, 3 * sizeof *m->mesh.place);
  m->mesh.normal = celd_alloc0 (n, 3 * sizeof *m->mesh.normal);
  m->mesh.art    = celd_alloc (n, 2 * sizeof *m->mesh.art);
  return m->mesh.place && m->mesh.normal && m->mesh.art ? CELD_OK : CELD_NO_MEMORY;
}

/* Below all points by the thickness of the plate. */
static double
find_bottom (const CeldMeshPoints *c, double thickness)
{
  double least = 0;

  for (size_t p = 0; p < c->n; p++)
    least = fmin (least, (double) c->z[p]);
  return least - thickness;
}

static CeldStatus
make_mesh (CeldMeshBuilder *m, const CeldSettings *settings, const CeldHost *host, CeldQuadtree *quadtree)
{
  SquareMesh   mesh = { m, quadtree, 0 };
  CeldHostPart part[2];
  CeldHost     choosing = celd_host_part (&part[0], host, 0, 0.7), filling = celd_host_part (&part[1], host, 0.7, 1);
  CeldStatus   status = celd_mesh_least_error (settings, &choosing, find_squares, &mesh);

  if (status == CELD_OK)
    status = mesh_new (m, mesh.n);
  if (status != CELD_OK)
    return status;
  celd_mesh_make_vertices (m);
  if (m->solid)
    {
      m->bottom = find_bottom (m->points, (double) settings->mesh_plate / m->scale);
      m->bottom_centre = celd_mesh_add_vertex (m, 0.5 * m->relief->width, 0.5 * m->relief->height, m->bottom);
    }
  status = celd_mesh_fill_squares (m, &filling);
  if (status == CELD_OK)
    celd_mesh_normals (&m->mesh);
  return status;
}

static bool
are_heights (const float *z, size_t n)
{
  for (size_t i = 0; i < n; i++)
    if (!(fabsf (z[i]) <= CELD_MOST_HEIGHT))
      return false;
  return true;
}

CeldStatus
celd_relief_mesh (const CeldRelief *relief, const CeldSettings *settings, const CeldHost *host, CeldReliefMesh *mesh)
{
  if (!relief->z || relief->width < 1 || relief->height < 1)
    return CELD_BAD_SIZE;
  if (celd_settings_check (settings) != CELD_OK ||
      !are_heights (relief->z, (size_t) relief->width * (size_t) relief->height) ||
      !are_heights (relief->outline, (size_t) relief->width * (size_t) relief->height))
    return CELD_BAD_VALUE;

  CeldMeshPoints  points = { .width = 0 };
  CeldQuadtree    quadtree = { .width = 0 };
  CeldHostPart    part[2];
  CeldHost        pointing = celd_host_part (&part[0], host, 0, 0.2), builder = celd_host_part (&part[1], host, 0.2, 1);
  CeldMeshBuilder m = { .relief = relief, .points = &points, .quadtree = &quadtree,
                        .solid = settings->mesh_kind == CELD_MESH_SOLID };
  CeldStatus      status = celd_mesh_points_new (relief, &pointing, &points);

  m.scale      = (double) settings->mesh_size / (relief->width > relief->height ? relief->width : relief->height);
  m.centre_x   = 0.5 * relief->width;
  m.centre_y   = 0.5 * relief->height;
  m.art_width  = relief->width;
  m.art_height = relief->height;
  if (status == CELD_OK)
    {
      m.vertex = celd_alloc (points.n, sizeof *m.vertex);
      status   = m.vertex ? make_mesh (&m, settings, &builder, &quadtree) : CELD_NO_MEMORY;
    }
  if (status == CELD_OK)
    {
      celd_relief_mesh_clear (mesh);
      *mesh = m.mesh;
    }
  else
    celd_relief_mesh_clear (&m.mesh);
  celd_mesh_points_clear (&points);
  celd_quadtree_clear (&quadtree);
  celd_free (m.vertex);
  celd_free (m.bottom_vertex);
  return status;
}

void
celd_relief_mesh_clear (CeldReliefMesh *mesh)
{
  celd_free (mesh->place);
  celd_free (mesh->normal);
  celd_free (mesh->art);
  celd_free (mesh->corner);
  *mesh = (CeldReliefMesh) { .vertices = 0 };
}
