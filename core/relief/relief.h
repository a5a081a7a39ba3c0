/* What the files of relief share.
 *
 *   relief-surface.c   where the surface is cut, which side ends there, what stays flat
 *   relief-round.c     how far it bulges
 *   relief-order.c     what is nearer stays in front,
 *   relief-tiles.c     by shifts of tiles,
 *   relief-shift.c     which are a convex problem
 *   relief.c           the step
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_RELIEF_H
#define CELD_RELIEF_H

#include "base/base.h"

/* ------------------------------------------------------------------ relief-surface.c */

/* A picture as a surface with cracks.  Tight planes. */
typedef struct
{
  int      width, height;
  float   *level;               /* of every pixel, finite */
  float   *east, *south;        /* to the right and to the lower neighbour: 1 where it goes on, 0 where it is cut */
  uint8_t *flat;                /* does the pixel's region end nowhere, so that it stays flat? */
} CeldSurface;

CeldStatus celd_surface_new (const CeldPlane *ink, const CeldPlane *levels, float threshold, const CeldHost *host,
                             CeldSurface *surface);
void       celd_surface_clear (CeldSurface *surface);         /* also what was made by half */

/* Calls body for each cut between two pixels, by their indices, the nearer one first; `right` if they lie side by
 * side. */
typedef void (*CeldCutBody) (void *data, size_t near, size_t far, bool right);
void celd_surface_cuts (const CeldSurface *surface, CeldCutBody body, void *data);

/* ------------------------------------------------------------------ relief-round.c */

/* Height above the outline, in pixels, for bulge 1; `b` and `diagonal` are cleared workspace. */
CeldStatus celd_relief_inflate (const CeldSurface *surface, double tolerance, const CeldHost *host, float *height);
/* The same from normals, which already have their bulge. */
CeldStatus celd_relief_integrate (const CeldSurface *surface, const CeldVectors *normals, double tolerance,
                                 const CeldHost *host, float *height);

/* ------------------------------------------------------------------ relief-tiles.c */

/* Two tiles, with how many edges of pixels between them; across a cut, a in front of b, by how much the shift of a has
 * to be larger than that of b, and how much more that will have to be. */
typedef struct { uint32_t a, b; float edges, minimum, increase; } CeldReliefTilePair;

typedef struct
{
  int           side;           /* of a block, in pixels */
  uint32_t     *tile;           /* of each pixel */
  uint32_t      n;
  float        *area;           /* of each tile, in pixels, */
  float        *flat;           /* and how many of them stay flat */
  float        *x, *y;          /* its middle */
  CeldReliefTilePair *link;           /* where the surface goes on; a pair may come several times */
  size_t        links;
} CeldReliefTiles;

CeldStatus celd_relief_tiles_new (const CeldSurface *surface, CeldReliefTiles *tiles);
void       celd_relief_tiles_clear (CeldReliefTiles *tiles);               /* also what was made by half */

/* ------------------------------------------------------------------ relief-shift.c */

/* Shifts of the tiles, the smallest and smoothest that keep the cuts, as relief-order.c has it. */
CeldStatus celd_relief_shift_tiles (const CeldReliefTiles *tiles, const CeldReliefTilePair *cut, size_t cuts, double range,
                             const CeldHost *host, double *shift);

/* ------------------------------------------------------------------ relief-order.c */

/* Moves and bends the surface z as little as possible, so that at each cut the nearer side lies at least as far before
 * the other as `step` says: step x the difference of depth, which is at least 0.  `shift` is what is added to z. */
CeldStatus celd_relief_keep_order (const CeldSurface *surface, const float *z, const float *depth, double step,
                            const CeldHost *host, float *shift);

#endif
