/* The outline of a part as a polygon, by marching squares over the coverage of pixels at one half, and the triangles
 * along it.  Its vertices lie between the centres of two pixels, so that no step of it is longer than 1.5 pixels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "relief/parts.h"

#include <math.h>

#define MOST_CORNERS 8 /* of the polygons in a square */

/* The corners of a square, counter-clockwise as the viewer sees it. */
static const int corner_x[4] = { 0, 0, 1, 1 }, corner_y[4] = { 0, 1, 1, 0 };

CeldStatus
celd_part_outline_new (const CeldPart *part, CeldMeshBuilder *builder, CeldPartOutline *outline)
{
  size_t n = (size_t) part->box.width * (size_t) part->box.height;

  *outline       = (CeldPartOutline) { .part = part, .builder = builder };
  outline->east  = celd_alloc0 (n, sizeof *outline->east);
  outline->south = celd_alloc0 (n, sizeof *outline->south);
  return outline->east && outline->south ? CELD_OK : CELD_NO_MEMORY;
}

void
celd_part_outline_clear (CeldPartOutline *outline)
{
  celd_free (outline->east);
  celd_free (outline->south);
  celd_free (outline->edge);
}

size_t
celd_part_crossings (const CeldPart *part)
{
  size_t n = 0;

  for (int y = 0; y < part->box.height; y++)
    for (int x = 0; x < part->box.width; x++)
      {
        bool inside = celd_part_has (part, x, y);

        n += x + 1 < part->box.width && inside != celd_part_has (part, x + 1, y);
        n += y + 1 < part->box.height && inside != celd_part_has (part, x, y + 1);
      }
  return n;
}

/* ------------------------------------------------------------------ vertices */

/* The height of the outline between a pixel inside and its neighbour in a direction: that of the seat, unless the part
 * is pushed behind another one, or goes on there. */
static double
height_between (const CeldPart *part, int x, int y, int direction, double way)
{
  size_t i = celd_part_at (part, x, y);
  int    to_x = x, to_y = y;

  if (part->open[i] & 1 << direction)
    return (double) part->z[i];
  celd_step (direction, &to_x, &to_y);
  return fmin ((double) part->z[i], (double) celd_part_seat_at (part, x + way * (to_x - x), y + way * (to_y - y)));
}

/* The vertex between the pixel (x,y) and its neighbour to the east or south; makes it if it is new. */
static uint32_t
crossing_at (CeldPartOutline *o, int x, int y, int direction)
{
  const CeldPart *part = o->part;
  int             to_x = x, to_y = y;
  uint32_t       *vertex = &(direction == CELD_EAST ? o->east : o->south)[celd_part_at (part, x, y)];
  bool            inside = celd_part_has (part, x, y);
  double          way, z;

  if (*vertex)
    return *vertex - 1;
  celd_step (direction, &to_x, &to_y);
  if (inside)
    {
      way = (double) celd_part_crossing (part, celd_part_at (part, x, y), celd_part_at (part, to_x, to_y));
      z   = height_between (part, x, y, direction, way);
    }
  else
    {
      way = 1 - (double) celd_part_crossing (part, celd_part_at (part, to_x, to_y), celd_part_at (part, x, y));
      z   = height_between (part, to_x, to_y, direction + 2, 1 - way); /* the opposite direction */
    }
  *vertex = celd_mesh_add_vertex (o->builder, x + way * (to_x - x), y + way * (to_y - y), z) + 1;
  return *vertex - 1;
}

/* The vertex between corners k and k + 1 of a square. */
static uint32_t
crossing_of_side (CeldPartOutline *o, int x, int y, int k)
{
  switch (k)
    {
    case 0:  return crossing_at (o, x, y, CELD_SOUTH);
    case 1:  return crossing_at (o, x, y + 1, CELD_EAST);
    case 2:  return crossing_at (o, x + 1, y, CELD_SOUTH);
    default: return crossing_at (o, x, y, CELD_EAST);
    }
}

static uint32_t
corner_of_square (const CeldPartOutline *o, int x, int y, int k)
{
  return o->builder->vertex[celd_part_at (o->part, x + corner_x[k], y + corner_y[k])] - 1;
}

/* ------------------------------------------------------------------ triangles */

static CeldStatus
add_edge (CeldPartOutline *o, uint32_t from, uint32_t to)
{
  CeldStatus status = celd_append (o->edge, o->edges, o->edge_capacity, from);

  if (status == CELD_OK)
    status = celd_append (o->edge, o->edges, o->edge_capacity, to);
  return status;
}

/* A corner by itself. */
static CeldStatus
fill_corner (CeldPartOutline *o, int x, int y, int k)
{
  uint32_t   after = crossing_of_side (o, x, y, k), before = crossing_of_side (o, x, y, (k + 3) % 4);
  CeldStatus status = celd_mesh_add_triangle (o->builder, corner_of_square (o, x, y, k), after, before);

  return status != CELD_OK ? status : add_edge (o, after, before);
}

/* All corners inside as one polygon. */
static CeldStatus
fill_polygon (CeldPartOutline *o, int x, int y, const bool inside[4])
{
  uint32_t   vertex[MOST_CORNERS];
  int        n = 0;
  CeldStatus status = CELD_OK;

  for (int k = 0; k < 4; k++)
    {
      if (inside[k])
        vertex[n++] = corner_of_square (o, x, y, k);
      if (inside[k] != inside[(k + 1) % 4])
        vertex[n++] = crossing_of_side (o, x, y, k);
    }
  for (int i = 2; i < n && status == CELD_OK; i++)
    status = celd_mesh_add_triangle (o->builder, vertex[0], vertex[i - 1], vertex[i]);
  for (int k = 0; k < 4 && status == CELD_OK; k++)
    if (inside[k] && !inside[(k + 1) % 4])
      {
        int back = k + 1; /* the side on which the outline, which leaves on side k, comes back */

        while (!inside[(back + 1) % 4])
          back++;
        status = add_edge (o, crossing_of_side (o, x, y, k), crossing_of_side (o, x, y, back % 4));
      }
  return status;
}

static CeldStatus
fill_square (CeldPartOutline *o, int x, int y)
{
  const CeldPart *part = o->part;
  bool            inside[4];
  int             n = 0;
  float           mean = 0;
  CeldStatus      status = CELD_OK;

  for (int k = 0; k < 4; k++)
    {
      inside[k] = celd_part_has (part, x + corner_x[k], y + corner_y[k]);
      n += inside[k];
      mean += 0.25f * part->coverage[celd_part_at (part, x + corner_x[k], y + corner_y[k])];
    }
  if (n == 0 || n == 4)
    return CELD_OK;
  if (n != 2 || inside[0] != inside[2] || mean > CELD_COVERED)
    return fill_polygon (o, x, y, inside);
  for (int k = 0; k < 4 && status == CELD_OK; k++)
    if (inside[k])
      status = fill_corner (o, x, y, k);
  return status;
}

CeldStatus
celd_part_outline_fill (CeldPartOutline *o)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y + 1 < o->part->box.height; y++)
    for (int x = 0; x + 1 < o->part->box.width && status == CELD_OK; x++)
      status = fill_square (o, x, y);
  o->edges /= 2;
  return status;
}
