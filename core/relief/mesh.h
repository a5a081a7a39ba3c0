/* What the files of the mesh share.
 *
 *   mesh-points.c   the corners of pixels, several where the surface is cut
 *   mesh-simplification.c    squares that are flat enough for a few triangles
 *   mesh-builder.c   vertices, triangles and walls are added; normals
 *   mesh.c           the step
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_RELIEF_MESH_H
#define CELD_RELIEF_MESH_H

#include "base/base.h"

/* ------------------------------------------------------------------ mesh-points.c */

/* The four pixels round a corner, clockwise. */
enum { CELD_NORTH_WEST, CELD_NORTH_EAST, CELD_SOUTH_EAST, CELD_SOUTH_WEST };

/* The points of a surface: at each corner of a pixel one for each piece of surface that meets there. */
typedef struct
{
  int       width, height;      /* of the picture; corners are one more */
  uint32_t *first;              /* the points of each corner are first[c] .. first[c + 1] - 1 */
  uint8_t  *part;              /* of each corner, which of them belong to the four pixels round it: two bits each */
  uint8_t  *cracked;            /* is there a cut at the corner? */
  float    *z;                  /* of each point */
  size_t    n;
} CeldMeshPoints;

CeldStatus celd_mesh_points_new (const CeldRelief *relief, const CeldHost *host, CeldMeshPoints *points);
void       celd_mesh_points_clear (CeldMeshPoints *points);         /* also what was made by half */

static inline size_t
celd_mesh_corner_at (const CeldMeshPoints *points, int x, int y)
{
  return (size_t) y * ((size_t) points->width + 1) + (size_t) x;
}

/* The point at the corner (x,y) that belongs to the pixel in that direction. */
static inline uint32_t
celd_mesh_point_at (const CeldMeshPoints *points, int x, int y, int direction)
{
  size_t c = celd_mesh_corner_at (points, x, y);

  return points->first[c] + (uint32_t) (points->part[c] >> 2 * direction & 3);
}

/* ------------------------------------------------------------------ mesh-simplification.c */

#define CELD_QUADTREE_SIZES 10 /* up to 512 pixels a side */

/* Squares of 1, 2, 4, ... pixels: those that are no part of a larger one are drawn. */
typedef struct
{
  int      width, height;       /* of the picture */
  uint8_t *whole[CELD_QUADTREE_SIZES]; /* of each square of 2^k pixels that lies in the picture; [0] is NULL: all are */
} CeldQuadtree;

/* Squares of which four triangles round the middle are at most `error` away. */
CeldStatus celd_quadtree_new (const CeldMeshPoints *points, const CeldRelief *relief, double error, const CeldHost *host,
                            CeldQuadtree *quadtree);
void       celd_quadtree_clear (CeldQuadtree *quadtree);            /* also what was made by half */
/* Is the square of 2^k pixels in column x and row y of such squares drawn? */
bool       celd_quadtree_is_leaf (const CeldQuadtree *quadtree, int k, int x, int y);

/* ------------------------------------------------------------------ mesh-builder.c */

/* A mesh in the making. */
typedef struct
{
  const CeldRelief  *relief;
  const CeldMeshPoints *points;
  const CeldQuadtree  *quadtree;
  double             scale;     /* of a pixel */
  uint32_t          *vertex;    /* of each point, from 1; 0: not used */
  bool               solid;
  double             bottom;    /* of a body: where that is, in pixels */
  uint32_t          *bottom_vertex;     /* of each corner at the frame its vertex in the bottom, from 1; 0: not made yet */
  uint32_t           bottom_centre;    /* of the bottom */
  CeldReliefMesh           mesh;
} CeldMeshBuilder;

CeldStatus celd_mesh_add_triangle (CeldMeshBuilder *builder, uint32_t a, uint32_t b, uint32_t c);
/* At the corner (x,y) of the picture; there is room for it. */
uint32_t   celd_mesh_add_vertex (CeldMeshBuilder *builder, double x, double y, double z);

/* The wall of a body below the edge of a square of the surface from corner (x,y) to (end_x,end_y), counter-clockwise
 * round the square: where the surface is cut, or at the frame, there with a piece of the bottom. */
CeldStatus celd_mesh_add_wall (CeldMeshBuilder *builder, int x, int y, int end_x, int end_y);

/* Sets the normals of all vertices. */
void celd_mesh_normals (CeldReliefMesh *mesh);

#endif
