/* Models: what the files share that make one mesh of each part of a drawing, on its whole silhouette.
 *
 *   part-shape.c      coverage of a part, where it ends and where it goes on into another one
 *   part-inflation.c  how far a part bulges above its outline
 *   part-seat.c       the surface that a part's outline lies on
 *   parts.c           all parts, each in front of those that it hides
 *   part-outline.c    the outline as a polygon, and the triangles along it
 *   part-mesh.c       the mesh of a part, open or closed
 *   atlas.c           the pictures of all parts side by side, as one texture
 *   model.c           celd_model
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PARTS_H
#define CELD_PARTS_H

#include "depth/depth.h"
#include "layers/layers.h"
#include "relief/relief.h"

/* Directions to the neighbours of a pixel. */
enum { CELD_EAST, CELD_SOUTH, CELD_WEST, CELD_NORTH };

/* The surface that a part's outline lies on, in cells of side x side pixels; of heights in between them. */
typedef struct { int width, height, side; float *z; } CeldPartSeat;

/* The whole silhouette of a region.  The box has a margin of one pixel round it, also beyond the frame; pixel (x,y) of
 * its planes is at (box.x + x, box.y + y) of the picture. */
typedef struct
{
  bool         page;            /* covers the picture: a plane at height 0, without planes of its own */
  CeldRect     box;
  float       *coverage;        /* [0,1]; beyond the frame such that the outline runs along it */
  uint8_t     *open;            /* bits 1 << direction: the part ends there, but its surface goes on, at the frame or
                                 * into another part */
  float       *z;               /* of each pixel inside; first above the seat, then of the front */
  double       size;            /* the largest height above the seat, for bulge 1 */
  CeldPartSeat seat;
} CeldPart;

/* One part for each sheet, in their order. */
typedef struct
{
  CeldPart            *item;
  size_t               n;       /* made so far */
  int                  width, height;
  const CeldSheets    *sheets;
  const CeldOwnership *own;
  const CeldPlane     *ink;
  CeldPixelLinks       links;   /* between which pixels depth is not cut */
} CeldParts;

static inline size_t
celd_part_at (const CeldPart *part, int x, int y)
{
  return (size_t) y * (size_t) part->box.width + (size_t) x;
}

/* The pixel next to (x,y) in a direction. */
static inline void
celd_step (int direction, int *x, int *y)
{
  *x += direction == CELD_EAST ? 1 : direction == CELD_WEST ? -1 : 0;
  *y += direction == CELD_SOUTH ? 1 : direction == CELD_NORTH ? -1 : 0;
}

/* ------------------------------------------------------------------ part-shape.c */

/* The coverage of pixels that are inside. */
#define CELD_COVERED 0.5f

static inline bool
celd_part_has (const CeldPart *part, int x, int y)
{
  return part->coverage[celd_part_at (part, x, y)] > CELD_COVERED;
}

/* Reads coverage and open edges of part k. */
CeldStatus celd_part_shape (const CeldParts *parts, size_t k, float threshold);
/* The part that one sees most of in a pixel. */
static inline size_t
celd_part_seen (const CeldParts *parts, int x, int y)
{
  return parts->sheets->of_label[celd_larger_label (parts->own, x, y) - 1];
}
/* How far the outline is from the pixel inside towards the one outside, both given by index: (0,1). */
float celd_part_crossing (const CeldPart *part, size_t inside, size_t outside);

/* ------------------------------------------------------------------ part-inflation.c */

/* Makes z of part k the height above the outline, for bulge 1, and sets its size; `stroke` is the drawing's stroke
 * width. */
CeldStatus celd_part_inflate (const CeldParts *parts, size_t k, int stroke, double tolerance, const CeldHost *host);

/* ------------------------------------------------------------------ part-seat.c */

/* What is behind the picture's pixels so far: height, and the part, from 1; 0: the page. */
typedef struct { float *z; uint32_t *top; } CeldBehind;

#define CELD_PART_STEP 0.5 /* share of the difference of levels that separates parts which lie on each other; chosen */

/* Finds the seat of part k; `rise` is the height of a level in pixels. */
CeldStatus celd_part_sit (const CeldParts *parts, size_t k, const CeldBehind *behind, double rise,
                          const CeldHost *host);
float celd_part_seat_at (const CeldPart *part, double x, double y);

/* ------------------------------------------------------------------ parts.c */

/* `borders` is as for celd_gaps_hold. */
CeldStatus celd_parts_new (const CeldSheets *sheets, const CeldOwnership *own, const CeldPlane *ink,
                           const CeldPlane *borders, const CeldSettings *settings, const CeldHost *host,
                           CeldParts *parts);
void       celd_parts_clear (CeldParts *parts);               /* accepts a partly built record */

/* ------------------------------------------------------------------ part-outline.c */

/* The squares between four pixels that the outline passes, and its vertices on lines between two pixels. */
typedef struct
{
  const CeldPart  *part;
  CeldMeshBuilder *builder;
  uint32_t        *east, *south;   /* of each pixel, the vertex on the line to that neighbour, from 1; 0: none */
  uint32_t        *edge;           /* pairs of vertices along the outline, with the part on their left */
  size_t           edges, edge_capacity;
} CeldPartOutline;

CeldStatus celd_part_outline_new (const CeldPart *part, CeldMeshBuilder *builder, CeldPartOutline *outline);
void       celd_part_outline_clear (CeldPartOutline *outline);      /* accepts a partly built record */
/* The number of its vertices, before they are made. */
size_t     celd_part_crossings (const CeldPart *part);
/* Adds vertices and triangles. */
CeldStatus celd_part_outline_fill (CeldPartOutline *outline);

/* ------------------------------------------------------------------ part-mesh.c */

typedef struct { double x, y, width, height; } CeldAtlasPlace;  /* of the part's box, and the atlas's size */

CeldStatus celd_part_mesh (const CeldParts *parts, size_t k, const CeldAtlasPlace *place, double error, double bottom,
                           const CeldSettings *settings, const CeldHost *host, CeldReliefMesh *mesh);

/* ------------------------------------------------------------------ atlas.c */

#define CELD_ATLAS_MARGIN 4 /* pixels round each picture that have the colours of its outline; chosen */

/* Finds a place for each part's picture; x and y of each are where the corner (0,0) of its box lies. */
CeldStatus celd_atlas_pack (const CeldParts *parts, CeldAtlasPlace *place);
/* `layers` are those of the sheets. */
CeldStatus celd_atlas_paint (const CeldParts *parts, const CeldAtlasPlace *place, const CeldLayers *layers,
                             const CeldHost *host, CeldColours *atlas);

#endif
