/* What contours.c and contour-ends.c share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_CONTOURS_H
#define CELD_CONTOURS_H

#include "image/image.h"

typedef enum { NOTHING, HARD, SOFT, ERASE } Kind;

typedef struct
{
  int            width, height;
  size_t         pixels;
  CeldPlane      ink;           /* of the drawing, by celd_ink */
  CeldPlane      value;         /* of the drawing, by celd_ink_values */
  CeldPlane      paper;         /* its level */
  float          dark;          /* the value that ink of this drawing has */
  CeldMask       kind, cover;   /* Kind of each pixel, and opacity of its stroke */
  CeldMask       wall;          /* 1 = becomes ink */
  CeldLabels     mark, part;    /* what celd_components takes and gives: the connected strokes */
  CeldComponent *list;          /* of part */
  size_t         n;
  float         *breadth;       /* of each stroke, in pixels */
} Bake;

/* A wall of 2 x 2 pixels, those of them that lie in the picture. */
static inline void
celd_contour_stamp (CeldMask *wall, int x, int y, uint8_t value)
{
  for (int v = y > 0 ? y : 0; v <= y + 1 && v < wall->height; v++)
    for (int u = x > 0 ? x : 0; u <= x + 1 && u < wall->width; u++)
      CELD_AT (wall, u, v) |= value;
}

/* Joins the open ends of the walls in `part` to the nearest ink, other wall or frame, a few pixels away. */
CeldStatus celd_contour_join (Bake *b, const CeldHost *host);

#endif
