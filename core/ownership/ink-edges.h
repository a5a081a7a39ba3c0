/* The edges of ink: where paper ends and ink begins, and what lies behind the ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_INK_EDGES_H
#define CELD_INK_EDGES_H

#include "base/base.h"

/* A place on an edge, as exact as the antialiasing. */
typedef struct
{
  float   x, y;
  float   nx, ny;               /* unit normal, into the ink */
  float   through;              /* to the other side of the ink along the normal; INFINITY if that is not found */
  float   step;                 /* to the next place of the loop */
  int32_t paper, across;        /* pixels of paper, y * width + x: here, and at the other side; -1 = off the picture */
  bool    corner;               /* the edge turns sharply here */
  bool    askew;                /* or so close by that the normal does not tell how thick the ink is */
} CeldEdgePoint;

/* A closed edge: points first .. first + n - 1, paper on the right hand of who follows it. */
typedef struct { size_t first, n; } CeldEdgeLoop;

typedef struct
{
  int            width, height, stroke; /* stroke: how thick lines are, see celd_stroke_width */
  CeldEdgePoint *point;
  size_t         n_points;
  CeldEdgeLoop  *loop;
  size_t         n_loops;
} CeldInkEdges;

CeldStatus celd_ink_edges_new (const CeldPlane *ink, const CeldHost *host, CeldInkEdges *edges);
void       celd_ink_edges_clear (CeldInkEdges *edges);  /* accepts a zeroed record */

/* Pixels between two places. */
float celd_edge_distance (const CeldEdgePoint *a, const CeldEdgePoint *b);

/* The pixel that a place lies in. */
static inline int
celd_round_down (float value)
{
  int down = (int) value;

  return down - ((float) down > value);
}

#endif
