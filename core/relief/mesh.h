/* The inside of relief meshes.
 *
 *   mesh-points.c          points of the surface at the corners of pixels
 *   mesh-simplification.c  the quadtree of squares that are flat enough
 *   mesh-builder.c         vertices, triangles, walls and normals
 *   mesh.c                 celd_relief_mesh
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_RELIEF_MESH_H
#define CELD_RELIEF_MESH_H

#include "base/base.h"

/* ------------------------------------------------------------------ mesh-points.c */

/* The four pixels round a corner, clockwise. */
enum { CELD_NORTH_WEST, CELD_NORTH_EAST, CELD_SOUTH_EAST, CELD_SOUTH_WEST };

/* The points of a surface: at each corner of a pixel, one for each connected part of the surface that meets there. */
typedef struct
{
  int       width, height;      /* of the picture, which has one more corner each way */
  uint32_t *first;              /* the points of corner c are first[c] .. first[c + 1] - 1 */
  uint8_t  *part;              /* of each corner: the parts that its four pixels belong to, two bits each */
  uint8_t  *cracked;            /* is there a cut at the corner? */
  float    *z;                  /* of each point */
  size_t    n, capacity;
} CeldMeshPoints;

CeldStatus celd_mesh_points_new (const CeldRelief *relief, const CeldHost *host, CeldMeshPoints *points);
void       celd_mesh_points_clear (CeldMeshPoints *points);         /* accepts a partly built record */

static inline size_t
celd_mesh_corner_at (const CeldMeshPoints *points, int x, int y)
{
  return (size_t) y * ((size_t) points->width + 1) + (size_t) x;
}

/* The point at the corner (x,y) of the surface at the pixel in that direction. */
static inline uint32_t
celd_mesh_point_at (const CeldMeshPoints *points, int x, int y, int direction)
{
  size_t c = celd_mesh_corner_at (points, x, y);

  return points->first[c] + (uint32_t) (points->part[c] >> 2 * direction & 3);
}

/* ------------------------------------------------------------------ mesh-simplification.c */

#define CELD_QUADTREE_SIZES 10 /* squares of up to 512 pixels a side */

/* A quadtree: its leaves are the squares of 1, 2, 4, ... pixels that are not part of a larger one. */
typedef struct
{
  int      width, height;       /* of the picture */
  uint8_t *whole[CELD_QUADTREE_SIZES]; /* is each square of 2^k pixels merged? [0] is NULL, because single pixels
                                        * always are */
} CeldQuadtree;

/* Merges squares of which four triangles round the centre deviate by at most `error` pixels. */
CeldStatus celd_quadtree_new (const CeldMeshPoints *points, const CeldRelief *relief, double error,
                              const CeldHost *host,
                            CeldQuadtree *quadtree);
void       celd_quadtree_clear (CeldQuadtree *quadtree);            /* accepts a partly built record */
/* Is the square of 2^k pixels in column x and row y of such squares a leaf? */
bool       celd_quadtree_is_leaf (const CeldQuadtree *quadtree, int k, int x, int y);

/* ------------------------------------------------------------------ mesh-builder.c */

/* A mesh under construction. */
typedef struct
{
  const CeldRelief     *relief;
  const CeldMeshPoints *points;
  const CeldQuadtree   *quadtree;
  double                scale;  /* size of a pixel, in the mesh's unit */
  uint32_t             *vertex; /* of each point, from 1; 0: unused */
  bool                  solid;
  double                bottom; /* height of a solid's bottom, in pixels */
  uint32_t             *bottom_vertex;  /* of each corner at the frame: its vertex at the bottom, from 1; 0: none yet */
  uint32_t              bottom_centre; /* vertex in the middle of the bottom */
  CeldReliefMesh        mesh;
  size_t                triangle_capacity;
} CeldMeshBuilder;

CeldStatus celd_mesh_add_triangle (CeldMeshBuilder *builder, uint32_t a, uint32_t b, uint32_t c);
/* Adds a vertex at the corner (x,y) of the picture, in pixels, and returns it; the arrays have to be large enough. */
uint32_t   celd_mesh_add_vertex (CeldMeshBuilder *builder, double x, double y, double z);

/* Adds the wall below the edge of a square from corner (x,y) to (end_x,end_y), counter-clockwise round the square,
 * if the edge is cut; at the frame, with a triangle of the bottom. */
CeldStatus celd_mesh_add_wall (CeldMeshBuilder *builder, int x, int y, int end_x, int end_y);

/* Sets the normals of all vertices. */
void celd_mesh_normals (CeldReliefMesh *mesh);

#endif
