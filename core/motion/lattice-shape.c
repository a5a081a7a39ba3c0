/* The shape of a lattice: sweeps that make its cells as rigid as possible [SDC09a, section 3.3; WXXC08].
 *
 * Each cell's nearest rigid motion is known in closed form.  It is always fitted to the rest pose, so that nothing
 * drifts or shrinks.  A sweep carries information one cell further.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

/* Centres a cell, its rest pose being a square round 0, and finds its turn. */
static void
fit_cell (const CeldLattice *lattice, size_t cell, float centre[2], float turn[2])
{
  const uint32_t *corner = lattice->corner + 4 * cell;
  float           x[4], y[4], a, b, length;

  for (int k = 0; k < 4; k++)
    {
      x[k] = lattice->place[2 * (size_t) corner[k]];
      y[k] = lattice->place[2 * (size_t) corner[k] + 1];
    }
  centre[0] = (x[0] + x[1] + x[2] + x[3]) / 4;
  centre[1] = (y[0] + y[1] + y[2] + y[3]) / 4;
  a = x[1] + x[3] - x[0] - x[2] + y[2] + y[3] - y[0] - y[1];
  b = y[1] + y[3] - y[0] - y[2] - x[2] - x[3] + x[0] + x[1];
  length  = hypotf (a, b);
  turn[0] = length > 1e-6f ? a / length : 1;
  turn[1] = length > 1e-6f ? b / length : 0;
}

float
celd_cell_area (const CeldLattice *lattice, size_t cell)
{
  const uint32_t *corner = lattice->corner + 4 * cell;
  const float    *p[4];

  for (int k = 0; k < 4; k++)
    p[k] = lattice->place + 2 * (size_t) corner[k];
  return 0.5f * ((p[3][0] - p[0][0]) * (p[2][1] - p[1][1]) - (p[3][1] - p[0][1]) * (p[2][0] - p[1][0])) /
         (float) (lattice->side * lattice->side);
}

/* Adds the proposals of all cells: x, y and their number for each vertex. */
static void
propose (const CeldLattice *lattice, float *sum)
{
  float half = 0.5f * (float) lattice->side;

  for (size_t c = 0; c < lattice->n_cells; c++)
    {
      float centre[2], turn[2];

      fit_cell (lattice, c, centre, turn);
      for (int k = 0; k < 4; k++)
        {
          float *to = sum + 3 * (size_t) lattice->corner[4 * c + (size_t) k];
          float  x = k % 2 ? half : -half, y = k / 2 ? half : -half;

          to[0] += centre[0] + turn[0] * x - turn[1] * y;
          to[1] += centre[1] + turn[1] * x + turn[0] * y;
          to[2] += 1;
        }
    }
}

static void
add_seams (const CeldLattice *lattice, float weight, float *sum)
{
  for (size_t s = 0; s < lattice->n_seams; s++)
    for (int i = 0; i < 2; i++)
      {
        float       *to = sum + 3 * (size_t) lattice->seam[2 * s + (size_t) i];
        const float *other = lattice->place + 2 * (size_t) lattice->seam[2 * s + (size_t) !i];

        to[0] += weight * other[0];
        to[1] += weight * other[1];
        to[2] += weight;
      }
}

void
celd_lattice_relax (CeldLattice *lattice, int sweeps, const CeldPull *pull, float seams, float *sum)
{
  for (int i = 0; i < sweeps; i++)
    {
      memset (sum, 0, 3 * lattice->n_vertices * sizeof *sum);
      propose (lattice, sum);
      if (seams > 0)
        add_seams (lattice, seams, sum);
      for (size_t v = 0; v < lattice->n_vertices; v++)
        {
          CeldPull p = pull ? pull[v] : (CeldPull) { 0 };
          float    all = sum[3 * v + 2] + p.weight;

          lattice->place[2 * v]     = (sum[3 * v] + p.weight * p.x) / all;
          lattice->place[2 * v + 1] = (sum[3 * v + 1] + p.weight * p.y) / all;
        }
    }
}
