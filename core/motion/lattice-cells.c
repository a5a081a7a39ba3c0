/* What is known of the cells of a lattice: rest pose, label and level, and which of them hang together.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/motion.h"

/* Finds rest pose, label and level of each cell; the label of more than half of its pixels, if there is one. */
CeldStatus
celd_lattice_describe (const CeldLabels *labels, const CeldMovingParts *parts, CeldLattice *lattice)
{
  uint32_t *votes = celd_alloc0 (lattice->n_cells, sizeof *votes);

  if (!votes)
    return CELD_NO_MEMORY;
  for (int y = 0; y < lattice->height; y++)
    for (int x = 0; x < lattice->width; x++)
      {
        uint32_t number = celd_lattice_cell (lattice, x, y), label = CELD_AT (labels, x, y);
        size_t   c = number - 1;

        if (!number)
          continue;
        for (size_t k = 0; k < 4 && !votes[c]; k++)
          {
            float *rest = lattice->rest + 2 * (size_t) lattice->corner[4 * c + k];

            rest[0] = (float) ((x / lattice->side + (int) (k % 2)) * lattice->side);
            rest[1] = (float) ((y / lattice->side + (int) (k / 2)) * lattice->side);
          }
        if (!votes[c])
          lattice->label[c] = label;
        votes[c] += lattice->label[c] == label ? 1 : UINT32_MAX;
      }
  for (size_t c = 0; c < lattice->n_cells; c++)
    lattice->level[c] = parts && parts->level ? parts->level[lattice->label[c] - 1] : 0;
  celd_free (votes);
  return CELD_OK;
}

CeldStatus
celd_lattice_pieces (CeldLattice *lattice)
{
  uint32_t *set = celd_alloc (lattice->n_vertices, sizeof *set);

  if (!set)
    return CELD_NO_MEMORY;
  celd_roots (set, lattice->n_vertices);
  for (size_t i = 0; i < 4 * lattice->n_cells; i++)
    celd_join (set, lattice->corner[i], lattice->corner[i & ~(size_t) 3]);
  for (size_t c = 0; c < lattice->n_cells; c++)
    lattice->piece[c] = UINT32_MAX;
  for (uint32_t v = 0; v < lattice->n_vertices; v++)
    set[v] = celd_root (set, v);
  /* A root is the smallest of its set, so it is numbered before the others are. */
  for (uint32_t v = 0; v < lattice->n_vertices; v++)
    set[v] = set[v] == v ? (uint32_t) lattice->n_pieces++ : set[set[v]];
  for (size_t c = 0; c < lattice->n_cells; c++)
    lattice->piece[c] = set[lattice->corner[4 * c]];
  celd_free (set);
  return CELD_OK;
}
