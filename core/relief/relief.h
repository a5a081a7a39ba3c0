/* The inside of celd_relief.
 *
 *   surface.c      where the surface is cut and where it stays flat
 *   inflation.c    height above the outline
 *   order-shift.c  shifts of tiles that keep the depth order
 *   order.c        shifts of pixels
 *   relief.c       the step
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_RELIEF_H
#define CELD_RELIEF_H

#include "base/base.h"

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

CeldStatus celd_surface_new (const CeldPlane *ink, const CeldPlane *levels, float threshold, const CeldHost *host,
                             CeldSurface *surface);
void       celd_surface_clear (CeldSurface *surface);         /* accepts a partly built record */

/* Calls body for each cut between two pixels, given by their indices, the nearer one first; `right` if they are in
 * one row. */
typedef void (*CeldCutBody) (void *data, size_t near, size_t far, bool right);
void celd_surface_cuts (const CeldSurface *surface, CeldCutBody body, void *data);

/* ------------------------------------------------------------------ inflation.c */

/* Computes the height above the outline, in pixels, for bulge 1. */
CeldStatus celd_relief_inflate (const CeldSurface *surface, double tolerance, const CeldHost *host, float *height);
/* Computes the height by integrating normals, which include their bulge. */
CeldStatus celd_relief_integrate (const CeldSurface *surface, const CeldVectors *normals, double tolerance,
                                 const CeldHost *host, float *height);

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
  CeldReliefTilePair *link;           /* where the surface continues; a pair may occur several times */
  size_t              links, link_capacity;
} CeldReliefTiles;

CeldStatus celd_relief_tiles_new (const CeldSurface *surface, CeldReliefTiles *tiles);
void       celd_relief_tiles_clear (CeldReliefTiles *tiles);               /* accepts a partly built record */


/* Finds the smallest and smoothest shifts of the tiles that keep the order at the cuts, see order.c; `range` in
 * pixels. */
CeldStatus celd_relief_shift_tiles (const CeldReliefTiles *tiles, const CeldReliefTilePair *cut, size_t cuts,
                                    double range,
                             const CeldHost *host, double *shift);

/* ------------------------------------------------------------------ order.c */

/* Finds the smallest and smoothest shift of the surface z such that at each cut the nearer side is in front of the
 * other by `step` times the difference of depth, which is at least 0. */
CeldStatus celd_relief_keep_order (const CeldSurface *surface, const float *z, const float *depth, double step,
                            const CeldHost *host, float *shift);

#endif
