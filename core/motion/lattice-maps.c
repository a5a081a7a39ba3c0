/* Dense maps of a lattice: where each pixel goes, and the drawing as the lattice carries it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

CeldStatus
celd_lattice_displacement (const CeldLattice *lattice, CeldShifts *shifts)
{
  if (!shifts->data || shifts->width != lattice->width || shifts->height != lattice->height)
    return CELD_BAD_SIZE;
  for (int y = 0; y < shifts->height; y++)
    for (int x = 0; x < shifts->width; x++)
      {
        float    px = (float) x + 0.5f, py = (float) y + 0.5f, at[2] = { px, py };
        float   *to = shifts->data + 2 * ((size_t) y * shifts->stride + (size_t) x);
        uint32_t c = celd_lattice_cell (lattice, x, y);

        if (c)
          celd_cell_map (lattice, c - 1, px, py, at);
        to[0] = at[0] - px;
        to[1] = at[1] - py;
      }
  return CELD_OK;
}
