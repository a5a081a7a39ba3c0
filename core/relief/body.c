/* What makes a body of a surface: walls where it is cut, from one side to the other, walls along the frame, and a flat
 * bottom.
 *
 * At a corner of several points, walls of different heights meet.  Each goes through all points that lie between its
 * ends, so that every edge belongs to two faces.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/mesh.h"

#define MOST_POINTS 6 /* of a chain: all of a corner, and the bottom */

/* The edge of a square, counter-clockwise round it, y down: which way it goes, and at its ends, in which directions the
 * pixels inside and outside lie. */
typedef struct { int inside, end_inside, outside, end_outside; } Edge;

/* Vertices from the upper end of a wall to its lower end, or the other way. */
typedef struct { uint32_t vertex[MOST_POINTS]; float z[MOST_POINTS]; int n; } Chain;

static const Edge edges[4] = {
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
is_frame (const CeldCorners *c, int x, int y, int direction)
{
  switch (direction)
    {
    case DOWN:  return x == 0;
    case RIGHT: return y == c->height;
    case UP:    return x == c->width;
    default:    return y == 0;
    }
}

/* The pixels on both sides of a cut are visited both; here from the left or upper one. */
static bool
is_cut (const CeldRelief *r, int x, int y, int direction)
{
  size_t w = (size_t) r->width;

  if (direction == RIGHT)
    return r->cut[(size_t) (y - 1) * w + (size_t) x] & CELD_CUT_BELOW;
  return direction == UP && r->cut[(size_t) (y - 1) * w + (size_t) (x - 1)] & CELD_CUT_RIGHT;
}

/* ------------------------------------------------------------------ chains */

static void
add_link (Chain *chain, uint32_t vertex, float z)
{
  chain->vertex[chain->n] = vertex;
  chain->z[chain->n++]    = z;
}

/* The point of the surface at the corner (x,y) with all other points of it below or above it, up to `end_z`, in the
 * order of their way there. */
static void
begin_chain (const CeldMaking *m, int x, int y, int direction, float end_z, Chain *chain)
{
  const CeldCorners *c = m->corners;
  size_t             corner = celd_corner_at (c, x, y);
  uint32_t           point = celd_corner_point (c, x, y, direction);
  bool               falling = end_z < c->z[point];

  chain->n = 0;
  add_link (chain, m->vertex[point] - 1, c->z[point]);
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
      add_link (chain, m->vertex[next] - 1, c->z[next]);
    }
}

/* From the surface to the surface on the other side of a cut. */
static void
find_chain (const CeldMaking *m, int x, int y, int inside, int outside, Chain *chain)
{
  const CeldCorners *c = m->corners;
  uint32_t           from = celd_corner_point (c, x, y, inside), to = celd_corner_point (c, x, y, outside);

  begin_chain (m, x, y, inside, c->z[to], chain);
  if (from != to)
    add_link (chain, m->vertex[to] - 1, c->z[to]);
}

/* From the surface to the bottom. */
static void
find_chain_down (CeldMaking *m, int x, int y, int inside, Chain *chain)
{
  size_t corner = celd_corner_at (m->corners, x, y);

  begin_chain (m, x, y, inside, (float) m->bottom, chain);
  if (!m->under[corner])
    m->under[corner] = celd_mesh_vertex (m, x, y, m->bottom) + 1;
  add_link (chain, m->under[corner] - 1, (float) m->bottom);
}

/* ------------------------------------------------------------------ walls */

/* The wall between two chains, which both begin at the surface; seen from outside `start` is on the right. */
static CeldStatus
fill_wall (CeldMaking *m, const Chain *start, const Chain *end)
{
  int        i = 0, j = 0;
  CeldStatus status = CELD_OK;

  while ((i + 1 < start->n || j + 1 < end->n) && status == CELD_OK)
    if (i + 1 < start->n && (j + 1 == end->n || i <= j))
      {
        status = celd_mesh_triangle (m, end->vertex[j], start->vertex[i], start->vertex[i + 1]);
        i++;
      }
    else
      {
        status = celd_mesh_triangle (m, end->vertex[j], start->vertex[i], end->vertex[j + 1]);
        j++;
      }
  return status;
}

CeldStatus
celd_mesh_wall (CeldMaking *m, int x, int y, int end_x, int end_y)
{
  int        direction = direction_of (x, y, end_x, end_y);
  Edge       edge = edges[direction];
  Chain      start, end;
  CeldStatus status;

  if (is_frame (m->corners, x, y, direction))
    {
      find_chain_down (m, x, y, edge.inside, &start);
      find_chain_down (m, end_x, end_y, edge.end_inside, &end);
      status = fill_wall (m, &start, &end);
      return status ? status : celd_mesh_triangle (m, m->middle, end.vertex[end.n - 1], start.vertex[start.n - 1]);
    }
  if (!is_cut (m->relief, x, y, direction))
    return CELD_OK;
  find_chain (m, x, y, edge.inside, edge.outside, &start);
  find_chain (m, end_x, end_y, edge.end_inside, edge.end_outside, &end);
  return fill_wall (m, &start, &end);
}
