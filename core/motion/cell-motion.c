/* Motions of cells, and places that cells carry along.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/inbetween.h"

#define FLAT_CELL       0.2f /* of a cell, relative to its rest pose: smaller ones move rigidly; chosen */
#define MOST_DISTORTION 0.3f /* Frobenius distance of a cell's motion from a rigid one; chosen */
#define CARRIER_NEAR    0.1f /* cells: softens the distance to carriers; chosen */

/* ------------------------------------------------------------------ motion */

/* Limits how far a motion is off the rigid one. */
static void
limit_stretch (float *m)
{
  float a = m[0] + m[3], b = m[2] - m[1], length = hypotf (a, b), off = 0, rigid[4], part;

  a = length > 1e-6f ? a / length : 1;
  b = length > 1e-6f ? b / length : 0;
  memcpy (rigid, (float[4]) { a, -b, b, a }, sizeof rigid);
  for (int i = 0; i < 4; i++)
    off += (m[i] - rigid[i]) * (m[i] - rigid[i]);
  part = off > MOST_DISTORTION * MOST_DISTORTION ? MOST_DISTORTION / sqrtf (off) : 1;
  for (int i = 0; i < 4; i++)
    m[i] = rigid[i] + part * (m[i] - rigid[i]);
}

/* The sides of a cell by its places, x and y, and its centre. */
static void
measure_cell (const CeldLattice *lattice, size_t cell, const float *place, float centre[2], float side[2][2])
{
  const float *p[4];

  for (size_t k = 0; k < 4; k++)
    p[k] = place + 2 * (size_t) lattice->corner[4 * cell + k];
  for (int c = 0; c < 2; c++)
    {
      centre[c]  = (p[0][c] + p[1][c] + p[2][c] + p[3][c]) / 4;
      side[0][c] = (p[1][c] + p[3][c] - p[0][c] - p[2][c]) / 2;
      side[1][c] = (p[2][c] + p[3][c] - p[0][c] - p[1][c]) / 2;
    }
}

CeldAffine
celd_cell_motion (const CeldLattice *lattice, size_t cell, const float *from, const float *to)
{
  CeldAffine motion;
  float      a[2][2], b[2][2], area;

  measure_cell (lattice, cell, from, motion.from, a);
  measure_cell (lattice, cell, to, motion.to, b);
  area = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  if (area < FLAT_CELL * (float) (lattice->side * lattice->side))
    { /* the turn alone */
      float x = (a[0][0] + a[1][1]) * (b[0][0] + b[1][1]) + (a[0][1] - a[1][0]) * (b[0][1] - b[1][0]);
      float y = (a[0][0] + a[1][1]) * (b[0][1] - b[1][0]) - (a[0][1] - a[1][0]) * (b[0][0] + b[1][1]);

      float length = hypotf (x, y);

      x = length > 1e-6f ? x / length : 1;
      y = length > 1e-6f ? y / length : 0;
      memcpy (motion.matrix, (float[4]) { x, -y, y, x }, sizeof motion.matrix);
      return motion;
    }
  for (int c = 0; c < 2; c++)
    {
      motion.matrix[2 * c]     = (b[0][c] * a[1][1] - b[1][c] * a[0][1]) / area;
      motion.matrix[2 * c + 1] = (b[1][c] * a[0][0] - b[0][c] * a[1][0]) / area;
    }
  limit_stretch (motion.matrix);
  return motion;
}

/* ------------------------------------------------------------------ carrying */

CeldCarriers
celd_carriers_at (const CeldAffine *motion, size_t n, float side, float x, float y)
{
  CeldCarriers found = { { 0 }, { 0 } };
  float        distance[CELD_CARRIERS], all = 0, near = CARRIER_NEAR * side;
  size_t       kept = 0;

  for (size_t c = 0; c < n; c++)
    {
      float  dx = x - motion[c].from[0], dy = y - motion[c].from[1], d = dx * dx + dy * dy;
      size_t at = kept < CELD_CARRIERS ? kept++ : CELD_CARRIERS;

      for (; at && distance[at - 1] > d; at--)
        if (at < CELD_CARRIERS)
          {
            distance[at]   = distance[at - 1];
            found.cell[at] = found.cell[at - 1];
          }
      if (at == CELD_CARRIERS)
        continue;
      distance[at]   = d;
      found.cell[at] = (uint32_t) c;
    }
  for (size_t i = 0; i < kept; i++)
    {
      found.share[i] = 1 / ((distance[i] + near * near) * (distance[i] + near * near));
      all           += found.share[i];
    }
  for (size_t i = 0; i < kept; i++)
    found.share[i] /= all;
  return found;
}

void
celd_carry (const CeldCarriers *carriers, const CeldAffine *motion, float x, float y, float place[2])
{
  place[0] = place[1] = 0;
  for (int i = 0; i < CELD_CARRIERS && carriers->share[i] > 0; i++)
    {
      float at[2];

      celd_affine_map (&motion[carriers->cell[i]], x, y, at);
      place[0] += carriers->share[i] * at[0];
      place[1] += carriers->share[i] * at[1];
    }
}
