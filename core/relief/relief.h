/* Heights and meshes: what the files of this theme share.
 *
 *   surface.c       where the surface is cut and where it stays flat
 *   order-shift.c   shifts of tiles that keep the depth order
 *   order.c         shifts of pixels
 *   relief.c        celd_relief: inflation, and the step
 *   mesh-surface.c  points of the surface at the corners of pixels, and the squares that are flat enough
 *   mesh-error.c    the least error for which there are not too many vertices
 *   mesh-builder.c  vertices, triangles, walls and normals
 *   mesh.c          celd_relief_mesh
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_RELIEF_H
#define CELD_RELIEF_H

#include "base/base.h"

/* Of inflation, relative to the largest square of a height: heights are roots, and small parts matter as much as large
 * ones; chosen. */
#define CELD_INFLATION_TOLERANCE 1e-5

/* ------------------------------------------------------------------ surface.c */

/* A picture as a surface with cuts; planes without padding. */
typedef struct
{
  int      width, height;
  float   *level;               /* of each pixel, finite */
  float   *east, *south;        /* edges to the right and to the lower neighbour: 1 where the surface continues, 0
                                 * where it is cut */
  uint8_t *flat;                /* does the pixel's region stay flat because it ends nowhere? */
} CeldSurface;

/* `borders` is as for celd_gaps_hold. */
CeldStatus celd_surface_new (const CeldPlane *ink, const CeldPlane *borders, const CeldPlane *levels,
                             const CeldSettings *settings, const CeldHost *host, CeldSurface *surface);
void       celd_surface_clear (CeldSurface *surface);         /* accepts a partly built record */

/* Calls body for each cut between two pixels, given by their indices, the nearer one first; `right` if they are in
 * one row. */
typedef void (*CeldCutBody) (void *data, size_t near, size_t far, bool right);
void celd_surface_cuts (const CeldSurface *surface, CeldCutBody body, void *data);

/* ------------------------------------------------------------------ order-shift.c */

/* Two tiles and the number of pixel edges between them.  At a cut, a is in front of b, the shift of a has to exceed
 * that of b by `minimum`, and `increase` will be added to that. */
typedef struct { uint32_t a, b; float edges, minimum, increase; } CeldReliefTilePair;

typedef struct
{
  int                 side;     /* of a block, in pixels */
  uint32_t           *tile;     /* of each pixel */
  uint32_t            n;
  float              *area;     /* of each tile, in pixels */
  float              *flat;     /* number of its flat pixels */
  float              *x, *y;    /* its centre */
  CeldReliefTilePair *link;     /* where the surface continues; a pair may occur several times */
  size_t              links, link_capacity;
} CeldReliefTiles;

CeldStatus celd_relief_tiles_new (const CeldSurface *surface, CeldReliefTiles *tiles);
void       celd_relief_tiles_clear (CeldReliefTiles *tiles);               /* accepts a partly built record */


/* Finds the smallest and smoothest shifts of the tiles that keep the order at the cuts, see order.c; `range` in
 * pixels. */
CeldStatus celd_relief_shift_tiles (const CeldReliefTiles *tiles, const CeldReliefTilePair *cut, size_t cuts,
                                    double range, const CeldHost *host, double *shift);

/* ------------------------------------------------------------------ order.c */

/* Finds the smallest and smoothest shift of the surface z such that at each cut the nearer side is in front of the
 * other by `step` times the difference of depth, which is at least 0. */
CeldStatus celd_relief_keep_order (const CeldSurface *surface, const float *z, const float *depth, double step,
                                   const CeldHost *host, float *shift);

/* ------------------------------------------------------------------ mesh-surface.c: points */

/* The four pixels round a corner, clockwise. */
enum { CELD_NORTH_WEST, CELD_NORTH_EAST, CELD_SOUTH_EAST, CELD_SOUTH_WEST };

/* The points of a surface: at each corner of a pixel, one for each connected part of the surface that meets there. */
typedef struct
{
  int       width, height;      /* of the picture, which has one more corner each way */
  uint32_t *first;              /* the points of corner c are first[c] .. first[c + 1] - 1 */
  uint8_t  *part;               /* of each corner: the parts that its four pixels belong to, two bits each */
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

/* ------------------------------------------------------------------ mesh-surface.c: mesh simplification */

#define CELD_QUADTREE_SIZES 10 /* squares of up to 512 pixels a side */

/* A quadtree: its leaves are the squares of 1, 2, 4, ... pixels that are not part of a larger one. */
typedef struct
{
  int      width, height;              /* of the picture */
  uint8_t *whole[CELD_QUADTREE_SIZES]; /* is each square of 2^k pixels merged? [0] is NULL, because single pixels
                                        * always are */
} CeldQuadtree;

/* Merges squares of which four triangles round the centre deviate by at most `error` pixels. */
CeldStatus celd_quadtree_new (const CeldMeshPoints *points, const CeldRelief *relief, double error,
                              const CeldHost *host, CeldQuadtree *quadtree);
void       celd_quadtree_clear (CeldQuadtree *quadtree);            /* accepts a partly built record */
/* Is the square of 2^k pixels in column x and row y of such squares a leaf? */
bool       celd_quadtree_is_leaf (const CeldQuadtree *quadtree, int k, int x, int y);

/* ------------------------------------------------------------------ mesh-error.c */

/* Makes a mesh, or several, by `attempt`, which counts the vertices: first with the error of the settings, then with
 * larger ones until there are not too many.  CELD_BAD_VALUE if there always are.  How many attempts there will be is not
 * known, so only the first one reports progress; all can be cancelled. */
CeldStatus celd_mesh_least_error (const CeldSettings *settings, const CeldHost *host,
                                  CeldStatus (*attempt) (void *data, double error, const CeldHost *host, size_t *n),
                                  void *data);

/* ------------------------------------------------------------------ mesh.c, mesh-builder.c */

/* A mesh under construction. */
typedef struct
{
  const CeldRelief     *relief;
  const CeldMeshPoints *points;
  const CeldQuadtree   *quadtree;
  const uint8_t        *skipped;       /* pixels without triangles; NULL: none */
  double                scale;         /* size of a pixel, in the mesh's unit */
  double                centre_x, centre_y;                   /* the mesh's origin, in pixels */
  double                art_x, art_y, art_width, art_height;  /* the place of corner (0,0) in the art, and its size */
  uint32_t             *vertex;        /* of each point, from 1; 0: unused */
  bool                  solid;
  double                bottom;        /* height of a solid's bottom, in pixels */
  uint32_t             *bottom_vertex; /* of each corner at the frame: its vertex at the bottom, from 1; 0: none yet */
  uint32_t              bottom_centre; /* vertex in the middle of the bottom */
  CeldReliefMesh        mesh;
  size_t                triangle_capacity;
} CeldMeshBuilder;

/* Marks the points that become vertices, and counts them. */
CeldStatus celd_mesh_mark_points (CeldMeshBuilder *builder, const CeldHost *host, size_t *n);
/* Adds a vertex for each marked point. */
void       celd_mesh_make_vertices (CeldMeshBuilder *builder);
/* Adds the triangles of all squares, with the walls of a solid. */
CeldStatus celd_mesh_fill_squares (CeldMeshBuilder *builder, const CeldHost *host);

CeldStatus celd_mesh_add_triangle (CeldMeshBuilder *builder, uint32_t a, uint32_t b, uint32_t c);
/* Adds a vertex at the corner (x,y) of the picture, in pixels, and returns it; the arrays have to be large enough. */
uint32_t   celd_mesh_add_vertex (CeldMeshBuilder *builder, double x, double y, double z);

/* Adds the wall below the edge of a square from corner (x,y) to (end_x,end_y), counter-clockwise round the square,
 * if the edge is cut; at the frame, with a triangle of the bottom. */
CeldStatus celd_mesh_add_wall (CeldMeshBuilder *builder, int x, int y, int end_x, int end_y);

/* Sets the normals of all vertices. */
void celd_mesh_normals (CeldReliefMesh *mesh);

#endif
