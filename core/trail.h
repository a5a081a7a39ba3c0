/* A painted stroke followed from one of its ends: distances along it, and what stands at each distance.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TRAIL_H
#define CELD_TRAIL_H

#include "private.h"

typedef struct { double x, y; } CeldPoint;

/* All pixels nearer to the start than one distance: their number and the sums of their places. */
typedef struct { double count, x, y; } CeldFront;

/* A connected stroke.  Pixels are numbered in planes with a border of one pixel, so that each has eight neighbours. */
typedef struct
{
  size_t          row;      /* pixels in a row of such a plane */
  float          *distance; /* such a plane: from the start along the stroke, in pixels; infinite off the strokes */
  const uint32_t *pixel;    /* of the stroke, in reading order */
  size_t          n;
  CeldFront      *front;    /* front[i]: pixels with distance < i; room for 3 n / 2 + 4 */
  size_t          n_fronts;
} CeldTrail;

CeldPoint celd_trail_point (const CeldTrail *trail, uint32_t pixel); /* the centre of a pixel, in the picture */

/* Distances from the nearest of n starts, and fronts.  The answer is the farthest pixel. */
uint32_t celd_trail_follow (CeldTrail *trail, const uint32_t *start, size_t n);

double celd_trail_length (const CeldTrail *trail);

/* Between two distances: pixels per unit of length, that is the stroke's mean width; and the centre of the pixels. */
double    celd_trail_width (const CeldTrail *trail, double from, double to);
CeldPoint celd_trail_centre (const CeldTrail *trail, double from, double to);

#endif
