/* The edges of a level of the Laplacian solver, as a list.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef LEVEL_EDGES_H
#define LEVEL_EDGES_H

#include "solve/laplace-private.h"
#include "check.h"

typedef struct { size_t from, to; double weight; } LevelEdge; /* places */

/* Every edge once; ends with weight 0.  Free the list. */
static inline LevelEdge *
level_edges (const CeldGridLevel *level)
{
  size_t     most = 4 * level->plane + (level->n_extra ? level->start[level->n_extra] : 0) + 1, n = 0;
  LevelEdge *edge = calloc (most, sizeof *edge);

#define EDGE(a, b, w) \
  if ((w) > 0) \
    edge[n++] = (LevelEdge) { (a), (b), (double) (w) }
  for (int y = 0; y < level->height; y++)
    for (int x = y % 2; x < level->width; x += 2)
      {
        size_t at = celd_grid_place (level, x, y), black = level->plane + at;

        EDGE (at, black, level->near[at]);
        EDGE (at, y % 2 ? black + 1 : black - 1, level->far[at]);
        EDGE (at, black - level->stride, level->north[at]);
        EDGE (at, black + level->stride, level->south[at]);
      }
  for (size_t k = 0; k < level->n_extra; k++)
    for (uint32_t e = level->start[k]; e < level->start[k + 1]; e++)
      if (level->neighbour[e] < 2 * level->plane + k)
        EDGE (2 * level->plane + k, level->neighbour[e], level->weight[e]);
#undef EDGE
  return edge;
}

/* Weights from 1e-3 to 1 on a grid of pixels, held weakly. */
static inline CeldWeightedGraph
random_graph (int width, int height, uint32_t seed)
{
  size_t            n = (size_t) width * (size_t) height;
  CeldWeightedGraph g = { .width = width, .height = height, .east = calloc (n, sizeof (float)),
                  .south = calloc (n, sizeof (float)), .diagonal = calloc (n, sizeof (float)) };

  for (int i = 0; i < width * height; i++)
    {
      g.east[i]  = i % width == width - 1 ? 0 : check_random (&seed, 4) ? 1 : 1e-3f;
      g.south[i] = i / width == height - 1 ? 0 : check_random (&seed, 4) ? 1 : 1e-3f;
      g.diagonal[i]  = 1e-3f;
    }
  return g;
}

#endif
