/* Where handles take the vertices of a puppet at first, and how far forward its cells.
 *
 * Each vertex moves by the rigid motion that suits the handles best, near ones most (moving least squares), where
 * distances are measured along the lattice and across ties.  That carries over any distance what sweeps of the lattice
 * carry one cell further each.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/puppet.h"

#include <float.h>

/* ------------------------------------------------------------------ distances */

/* Lowers the distance of each corner of a cell to what its other corners allow.  True if any changed. */
static bool
shorten_cell (const CeldLattice *lattice, size_t cell, float *distance)
{
  const uint32_t *corner = lattice->corner + 4 * cell;
  float           side = (float) lattice->side;
  bool            changed = false;

  for (int i = 0; i < 4; i++)
    for (int k = 0; k < 4; k++)
      {
        float by = distance[corner[i]] + (i == k ? 0 : (i ^ k) == 3 ? 1.41421356f * side : side);

        if (by < distance[corner[k]])
          {
            distance[corner[k]] = by;
            changed = true;
          }
      }
  return changed;
}

/* Measures distances from one handle: sweeps over all cells, there and back, until nothing changes. */
static void
measure (const CeldLattice *lattice, const CeldHeld *held, float *distance)
{
  for (size_t v = 0; v < lattice->n_vertices; v++)
    distance[v] = FLT_MAX;
  for (size_t k = 0; k < 4; k++)
    {
      uint32_t v = lattice->corner[4 * held->cell + k];

      distance[v] = hypotf (lattice->rest[2 * (size_t) v] - held->x, lattice->rest[2 * (size_t) v + 1] - held->y);
    }
  for (bool changed = true; changed;)
    {
      changed = false;
      for (size_t c = 0; c < lattice->n_cells; c++)
        changed |= shorten_cell (lattice, c, distance);
      for (size_t c = lattice->n_cells; c--;)
        changed |= shorten_cell (lattice, c, distance);
      for (size_t s = 0; s < 2 * lattice->n_seams; s++)
        {
          uint32_t from = lattice->seam[s], to = lattice->seam[s ^ 1];

          changed |= distance[from] < distance[to];
          distance[to] = fminf (distance[to], distance[from]);
        }
    }
}

/* The weight of handle i at a vertex; 0 if they are not connected. */
static double
weight_at (const CeldPuppetPose *p, size_t i, size_t v)
{
  double d = (double) p->distance[i * p->puppet->lattice.n_vertices + v] / p->puppet->lattice.side;

  return d < 1e9 ? 1 / ((d * d + 0.01) * (d * d + 0.01)) : 0;
}

/* ------------------------------------------------------------------ places */

/* Moves a vertex by the rigid motion that suits the handles best, near ones most. */
static void
guess_vertex (CeldPuppetPose *p, size_t v)
{
  CeldLattice *lattice = &p->puppet->lattice;
  const float *rest = lattice->rest + 2 * v;
  double       all = 0, from[2] = { 0, 0 }, to[2] = { 0, 0 }, a = 0, b = 0, length;

  for (size_t i = 0; i < p->n; i++)
    {
      const CeldHeld *h = &p->held[i];
      double      w = weight_at (p, i, v);

      all     += w;
      from[0] += w * h->x;
      from[1] += w * h->y;
      to[0]   += w * h->to_x;
      to[1]   += w * h->to_y;
    }
  if (all <= 0)
    return;
  for (int c = 0; c < 2; c++)
    {
      from[c] /= all;
      to[c]   /= all;
    }
  for (size_t i = 0; i < p->n; i++)
    {
      const CeldHeld *h = &p->held[i];
      double      w = weight_at (p, i, v), x = h->x - from[0], y = h->y - from[1];

      a += w * (x * (h->to_x - to[0]) + y * (h->to_y - to[1]));
      b += w * (x * (h->to_y - to[1]) - y * (h->to_x - to[0]));
    }
  length = hypot (a, b);
  a      = length > 1e-6 * all ? a / length : 1;
  b      = length > 1e-6 * all ? b / length : 0;
  lattice->place[2 * v]     = (float) (to[0] + a * (rest[0] - from[0]) - b * (rest[1] - from[1]));
  lattice->place[2 * v + 1] = (float) (to[1] + b * (rest[0] - from[0]) + a * (rest[1] - from[1]));
}

void
celd_pose_guess (CeldPuppetPose *p)
{
  CeldLattice *lattice = &p->puppet->lattice;

  for (size_t i = 0; i < p->n; i++)
    measure (lattice, &p->held[i], p->distance + i * lattice->n_vertices);
  memcpy (lattice->place, lattice->rest, 2 * lattice->n_vertices * sizeof *lattice->rest);
  for (size_t v = 0; v < lattice->n_vertices; v++)
    guess_vertex (p, v);
}

/* ------------------------------------------------------------------ depth */

void
celd_pose_move_forward (CeldPuppetPose *p)
{
  const CeldLattice *lattice = &p->puppet->lattice;

  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      double all = 0, depth = 0;

      for (size_t i = 0; i < p->n; i++)
        for (size_t k = 0; k < 4; k++)
          {
            double w = weight_at (p, i, lattice->corner[4 * c + k]);

            all   += w;
            depth += w * p->held[i].depth;
          }
      p->puppet->depth[c] = all > 0 ? (float) round (depth / all) : 0;
    }
}
