/* A painted stroke followed from one of its ends: distances along it, and what stands at each distance.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TRAIL_H
#define CELD_TRAIL_H

#include "base/base.h"

typedef struct { double x, y; } CeldPoint;

/* All pixels nearer to the start than one distance: their number and the sums of their places. */
typedef struct { double count, x, y; } CeldFront;

/* A connected stroke.  Pixels are numbered in planes with a border of one pixel, so that each has eight neighbours. */
typedef struct
{
  int             width, height; /* of the picture */
  float          *distance;      /* such a plane: from the start along the stroke, in pixels; infinite off it */
  const uint32_t *pixel;         /* of the stroke, in reading order */
  size_t          n;
  CeldFront      *front;         /* front[i]: pixels with distance < i; room for 3 n / 2 + 4 */
  size_t          n_fronts;
  float          *kept;          /* room for n distances of an earlier start */
} CeldTrail;

int       celd_trail_x (const CeldTrail *trail, uint32_t pixel);     /* column in the picture */
int       celd_trail_y (const CeldTrail *trail, uint32_t pixel);     /* row in the picture */
CeldPoint celd_trail_point (const CeldTrail *trail, uint32_t pixel); /* the centre of a pixel, in the picture */
bool      celd_trail_painted (const CeldTrail *trail, CeldPoint p);  /* is the pixel or one beside it of a stroke? */

/* Distances from the nearest of n starts, and fronts.  The answer is the farthest pixel. */
uint32_t celd_trail_follow (CeldTrail *trail, const uint32_t *start, size_t n);

double celd_trail_length (const CeldTrail *trail);

/* Between two distances: pixels per unit of length, that is the stroke's mean width; and the centre of the pixels. */
double    celd_trail_width (const CeldTrail *trail, double from, double to);
CeldPoint celd_trail_centre (const CeldTrail *trail, double from, double to);

/* The tail and the tip of an arrow. */
typedef struct { CeldPoint tail, tip; } CeldEnds;

/* arrowhead.c: false if the stroke has no clear head; with `dot`, no clear dot, whose centre is the tip then. */
bool celd_arrowhead (CeldTrail *trail, bool dot, CeldEnds *ends);

#endif
