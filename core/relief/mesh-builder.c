/* Construction of a mesh: vertices, triangles, the walls of a solid, and normals.
 *
 * A solid has walls at cuts, between the surfaces on both sides, walls along the frame, and a flat bottom.  Where
 * several points lie above each other at a corner, walls of different heights meet; each wall goes through all points
 * between its ends, so that every edge belongs to exactly two faces.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "relief/relief.h"

#include <math.h>

#define MAX_CHAIN 6 /* points of a chain: those of a corner, and one at the bottom */

/* ------------------------------------------------------------------ vertices and triangles */

uint32_t
celd_mesh_add_vertex (CeldMeshBuilder *m, double x, double y, double z)
{
  float *place = m->mesh.place + 3 * m->mesh.vertices, *art = m->mesh.art + 2 * m->mesh.vertices;

  place[0] = (float) (m->scale * (x - m->centre_x));
  place[1] = (float) (m->scale * (m->centre_y - y));
  place[2] = (float) (m->scale * z);
  art[0]   = (float) ((x + m->art_x) / m->art_width);
  art[1]   = (float) ((y + m->art_y) / m->art_height);
  return (uint32_t) m->mesh.vertices++;
}

CeldStatus
celd_mesh_add_triangle (CeldMeshBuilder *m, uint32_t a, uint32_t b, uint32_t c)
{
  uint32_t *corner;

  if (!celd_reserve (&m->mesh.corner, m->mesh.triangles + 1, &m->triangle_capacity, 3 * sizeof *corner))
    return CELD_NO_MEMORY;
  corner = m->mesh.corner + 3 * m->mesh.triangles++;
  corner[0] = a;
  corner[1] = b;
  corner[2] = c;
  return CELD_OK;
}

/* ------------------------------------------------------------------ walls */

/* Directions of the pixels inside and outside an edge, at its beginning and its end; edges go counter-clockwise
 * round a square, y down. */
typedef struct { int inside, end_inside, outside, end_outside; } WallEdge;

/* Vertices above each other, from one end of a wall to the other. */
typedef struct { uint32_t vertex[MAX_CHAIN]; float z[MAX_CHAIN]; int n; } Chain;

static const WallEdge edges[4] = {
  { CELD_SOUTH_EAST, CELD_NORTH_EAST, CELD_SOUTH_WEST, CELD_NORTH_WEST }, /* down */
  { CELD_NORTH_EAST, CELD_NORTH_WEST, CELD_SOUTH_EAST, CELD_SOUTH_WEST }, /* to the right */
  { CELD_NORTH_WEST, CELD_SOUTH_WEST, CELD_NORTH_EAST, CELD_SOUTH_EAST }, /* up */
  { CELD_SOUTH_WEST, CELD_SOUTH_EAST, CELD_NORTH_WEST, CELD_NORTH_EAST }, /* to the left */
};

enum { DOWN, RIGHT, UP, LEFT };

static int
direction_of (int x, int y, int end_x, int end_y)
{
  if (x == end_x)
    return end_y > y ? DOWN : UP;
  return end_x > x ? RIGHT : LEFT;
}

/* Is the edge at the frame, with the picture to its left? */
static bool
is_frame (const CeldMeshPoints *c, int x, int y, int direction)
{
  switch (direction)
    {
    case DOWN:  return x == 0;
    case RIGHT: return y == c->height;
    case UP:    return x == c->width;
    default:    return y == 0;
    }
}

/* Is the edge cut, seen from the left or upper pixel?  The other side is visited, too, but makes no wall. */
static bool
is_cut (const CeldRelief *r, int x, int y, int direction)
{
  size_t w = (size_t) r->width;

  if (direction == RIGHT)
    return r->cut[(size_t) (y - 1) * w + (size_t) x] & CELD_CUT_BELOW;
  return direction == UP && r->cut[(size_t) (y - 1) * w + (size_t) (x - 1)] & CELD_CUT_RIGHT;
}

/* ------------------------------------------------------------------ walls: points above each other */

static void
add_to_chain (Chain *chain, uint32_t vertex, float z)
{
  chain->vertex[chain->n] = vertex;
  chain->z[chain->n++]    = z;
}

/* Begins a chain with the surface's point at the corner (x,y), and adds the corner's other points towards `end_z` in
 * order of height. */
static void
begin_chain (const CeldMeshBuilder *m, int x, int y, int direction, float end_z, Chain *chain)
{
  const CeldMeshPoints *c = m->points;
  size_t                corner = celd_mesh_corner_at (c, x, y);
  uint32_t              point = celd_mesh_point_at (c, x, y, direction);
  bool                  falling = end_z < c->z[point];

  chain->n = 0;
  add_to_chain (chain, m->vertex[point] - 1, c->z[point]);
  for (;;)
    {
      uint32_t next = UINT32_MAX;

      for (uint32_t p = c->first[corner]; p < c->first[corner + 1]; p++)
        {
          float z = c->z[p], last = chain->z[chain->n - 1];

          if (falling ? z < last && z > end_z && (next == UINT32_MAX || z > c->z[next])
                      : z > last && z < end_z && (next == UINT32_MAX || z < c->z[next]))
            next = p;
        }
      if (next == UINT32_MAX)
        return;
      add_to_chain (chain, m->vertex[next] - 1, c->z[next]);
    }
}

/* The chain from the surface to the surface on the other side of a cut. */
static void
find_chain (const CeldMeshBuilder *m, int x, int y, int inside, int outside, Chain *chain)
{
  const CeldMeshPoints *c = m->points;
  uint32_t              from = celd_mesh_point_at (c, x, y, inside), to = celd_mesh_point_at (c, x, y, outside);

  begin_chain (m, x, y, inside, c->z[to], chain);
  if (from != to)
    add_to_chain (chain, m->vertex[to] - 1, c->z[to]);
}

/* The chain from the surface to the bottom. */
static void
find_chain_down (CeldMeshBuilder *m, int x, int y, int inside, Chain *chain)
{
  size_t corner = celd_mesh_corner_at (m->points, x, y);

  begin_chain (m, x, y, inside, (float) m->bottom, chain);
  if (!m->bottom_vertex[corner])
    m->bottom_vertex[corner] = celd_mesh_add_vertex (m, x, y, m->bottom) + 1;
  add_to_chain (chain, m->bottom_vertex[corner] - 1, (float) m->bottom);
}

/* Fills the wall between two chains that both begin at the surface; seen from outside `start` is on the right. */
static CeldStatus
fill_wall (CeldMeshBuilder *m, const Chain *start, const Chain *end)
{
  int        i = 0, j = 0;
  CeldStatus status = CELD_OK;

  while ((i + 1 < start->n || j + 1 < end->n) && status == CELD_OK)
    if (i + 1 < start->n && (j + 1 == end->n || i <= j))
      {
        status = celd_mesh_add_triangle (m, end->vertex[j], start->vertex[i], start->vertex[i + 1]);
        i++;
      }
    else
      {
        status = celd_mesh_add_triangle (m, end->vertex[j], start->vertex[i], end->vertex[j + 1]);
        j++;
      }
  return status;
}

CeldStatus
celd_mesh_add_wall (CeldMeshBuilder *m, int x, int y, int end_x, int end_y)
{
  int        direction = direction_of (x, y, end_x, end_y);
  WallEdge   edge = edges[direction];
  Chain      start, end;
  CeldStatus status;

  if (is_frame (m->points, x, y, direction))
    {
      find_chain_down (m, x, y, edge.inside, &start);
      find_chain_down (m, end_x, end_y, edge.end_inside, &end);
      status = fill_wall (m, &start, &end);
      return status != CELD_OK ? status : celd_mesh_add_triangle (m, m->bottom_centre, end.vertex[end.n - 1],
                                                       start.vertex[start.n - 1]);
    }
  if (!is_cut (m->relief, x, y, direction))
    return CELD_OK;
  find_chain (m, x, y, edge.inside, edge.outside, &start);
  find_chain (m, end_x, end_y, edge.end_inside, edge.end_outside, &end);
  return fill_wall (m, &start, &end);
}

/* ------------------------------------------------------------------ normals */

static void
cross (const float *a, const float *b, const float *c, double normal[3])
{
  double u[3], v[3];

  for (int k = 0; k < 3; k++)
    {
      u[k] = (double) b[k] - (double) a[k];
      v[k] = (double) c[k] - (double) a[k];
    }
  for (int k = 0; k < 3; k++)
    normal[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
}

/* Averages the normals of the surface's triangles at each vertex, weighted by area.  Walls are excluded, because
 * they would make the surface look bent at every boundary; the bottom's normals point down. */
void
celd_mesh_normals (CeldReliefMesh *mesh)
{
  for (size_t i = 0; i < mesh->triangles; i++)
    {
      const uint32_t *v = mesh->corner + 3 * i;
      double          normal[3];

      cross (mesh->place + 3 * v[0], mesh->place + 3 * v[1], mesh->place + 3 * v[2], normal);
      for (int k = 0; k < 3 && normal[2] > 0; k++)
        for (int j = 0; j < 3; j++)
          mesh->normal[3 * v[k] + (uint32_t) j] += (float) normal[j];
    }
  for (size_t i = 0; i < mesh->vertices; i++)
    {
      float *n = mesh->normal + 3 * i;
      double x = (double) n[0], y = (double) n[1], z = (double) n[2], length = sqrt (x * x + y * y + z * z);

      if (!(length > 0))
        {
          z      = -1;
          length = 1;
        }
      n[0] = (float) (x / length);
      n[1] = (float) (y / length);
      n[2] = (float) (z / length);
    }
}
