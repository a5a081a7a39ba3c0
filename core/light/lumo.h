/* What the files of Lumo normals [Joh02] share.
 *
 *   lumo-seams.c      strokes inside a part, and what painted hints say of both sides of a line
 *   lumo-outlines.c   which sides of which edges bend, and where to
 *   lumo-solve.c      the normals between them
 *   lumo-bevel.c      bent along outlines only
 *   normals.c         the step
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LUMO_H
#define CELD_LUMO_H

#include "depth/depth.h"

/* What a pixel next to an outline is held to; y up. */
typedef struct { size_t pixel; float x, y; } CeldHold;

/* A side of a line: what the artist painted there. */
typedef enum { CELD_UNPAINTED, CELD_UNDER, CELD_BOTH, CELD_OVER } CeldLumoSide;

/* The edge of a pixel to its right or lower neighbour along the middle of a stroke inside a part. */
typedef struct
{
  uint32_t pixel;
  bool     down, painted;       /* painted: a hint says so */
  float    x, y;                /* unit vector across, from the pixel to its neighbour; y down */
  float    strength[2];         /* how much the pixel and its neighbour bend there, 0 .. 1 */
} CeldSeam;

typedef struct
{
  const CeldPlane    *ink;
  const CeldPlane    *depth;    /* may be NULL */
  const CeldPaint    *hints;    /* may be NULL */
  const CeldSettings *settings;
  int                 width, height, stroke; /* stroke: width of the drawing's strokes */
  CeldEdges           edges;
  float              *level;    /* tight planes */
  float              *east, *south; /* weights; 0: cut */
  CeldSeam           *seam;
  size_t              n_seams;
  CeldParts           regions;  /* connected, of one level */
  uint8_t            *flat;     /* of each region: it has no outline of its own, and faces the viewer */
  CeldHold           *hold;     /* in any order */
  size_t              n_holds;
  float              *tilt;     /* n_x and n_y of each pixel, y up */
} CeldLumo;

static inline size_t
celd_lumo_pixel (const CeldLumo *lumo, int x, int y)
{
  return (size_t) y * (size_t) lumo->width + (size_t) x;
}

/* Have two pixels one level? */
static inline bool
celd_lumo_level (const CeldLumo *lumo, size_t p, size_t q)
{
  return lumo->level[p] >= lumo->level[q] && lumo->level[p] <= lumo->level[q];
}

/* Round this place, a few pixels away along (dx,dy), y down: what is painted beside the line. */
CeldLumoSide celd_lumo_side (const CeldLumo *lumo, double x, double y, double dx, double dy);

/* Finds the seams and cuts the weights along them. */
CeldStatus celd_lumo_seams (CeldLumo *lumo, const CeldHost *host);

/* Finds the regions and what holds them. */
CeldStatus celd_lumo_outlines (CeldLumo *lumo, const CeldHost *host);

CeldStatus celd_lumo_solve (CeldLumo *lumo, const CeldHost *host);

/* Takes the tilt away farther than the settings' bevel from a pixel's own outlines. */
CeldStatus celd_lumo_bevel (CeldLumo *lumo, const CeldHost *host);

#endif
