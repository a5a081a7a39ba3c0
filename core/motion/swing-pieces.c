/* The pieces of a lattice, as the search for their poses sees them: pixels of a coarse picture, and seams to others.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "motion/swing.h"

#include <stdlib.h>

static void
pixel_of_scale (const CeldMatchImages *i, const CeldLattice *lattice, int x, int y, int *px, int *py)
{
  *px = x * i->factor + i->factor / 2;
  *py = y * i->factor + i->factor / 2;
  *px = *px < lattice->width ? *px : lattice->width - 1;
  *py = *py < lattice->height ? *py : lattice->height - 1;
}

/* Lists the pixels of the scale by pieces. */
static void
list_marks (const CeldLattice *lattice, const CeldMatchImages *i, CeldPieces *s)
{

  for (int pass = 0; pass < 2; pass++)
    {
      size_t n = 0;

      for (size_t k = 0; k < lattice->n_pieces && pass; k++)
        {
          s->piece[k].mark = n;
          n += s->piece[k].n;
          s->piece[k].n = 0;
        }
      for (int y = 0; y < i->height; y++)
        for (int x = 0; x < i->width; x++)
          {
            int      px, py;
            uint32_t c;
            CeldPiece *piece;
            bool     ink = i->source[y * i->width + x] > CELD_ON_INK;

            pixel_of_scale (i, lattice, x, y, &px, &py);
            c = celd_lattice_cell (lattice, px, py);
            if (!c || !celd_match_own (i, lattice, c - 1, px, py))
              continue;
            piece = &s->piece[lattice->piece[c - 1]];
            piece->level = lattice->level[c - 1];
            if (pass)
              s->mark[piece->mark + piece->n] = (CeldPieceMark) { (float) px + 0.5f, (float) py + 0.5f, c - 1, ink };
            piece->n++;
            piece->ink += pass && ink;
          }
    }
}

/* Lists the seams of each piece to others. */
static void
list_bonds (const CeldLattice *lattice, CeldPieces *s)
{
  size_t             n = 0;

  for (size_t k = 0; k < 4 * lattice->n_cells; k++)
    s->piece_of[lattice->corner[k]] = lattice->piece[k / 4];
  for (int pass = 0; pass < 2; pass++)
    {
      for (size_t k = 0; k < lattice->n_pieces && pass; k++)
        {
          s->piece[k].bond = n;
          n += s->piece[k].n_bonds;
          s->piece[k].n_bonds = 0;
        }
      for (size_t b = 0; b < 2 * lattice->n_seams; b++)
        {
          uint32_t own = lattice->seam[b], other = lattice->seam[b ^ 1];
          CeldPiece *piece = &s->piece[s->piece_of[own]];

          if (s->piece_of[own] == s->piece_of[other])
            continue;
          if (pass)
            s->bond[piece->bond + piece->n_bonds] = (CeldPieceBond) { own, other, s->piece_of[other] };
          piece->n_bonds++;
        }
    }
}

static int
compare_bonds (const void *a, const void *b)
{
  const CeldPieceBond *p = a, *q = b;

  return p->piece != q->piece ? (p->piece < q->piece ? -1 : 1) : p->own != q->own ? (p->own < q->own ? -1 : 1)
       : (p->other > q->other) - (p->other < q->other);
}

/* Sorts the bonds of each piece by the other piece; and the pieces by their ink, insertion being good enough. */
static void
sort_pieces (const CeldLattice *lattice, CeldPieces *s)
{
  for (uint32_t k = 0; k < lattice->n_pieces; k++)
    {
      uint32_t at = k;

      if (s->piece[k].n_bonds)
        qsort (s->bond + s->piece[k].bond, s->piece[k].n_bonds, sizeof *s->bond, compare_bonds);
      for (; at && s->piece[s->order[at - 1]].ink < s->piece[k].ink; at--)
        s->order[at] = s->order[at - 1];
      s->order[at] = k;
    }
}

CeldStatus
celd_pieces_new (const CeldLattice *lattice, const CeldMatchImages *images, CeldPieces *pieces)
{
  *pieces = (CeldPieces) {
    .mark     = celd_alloc ((size_t) images->width * (size_t) images->height, sizeof *pieces->mark),
    .bond     = celd_alloc (2 * lattice->n_seams + 1, sizeof *pieces->bond),
    .piece    = celd_alloc0 (lattice->n_pieces, sizeof *pieces->piece),
    .order    = celd_alloc (lattice->n_pieces, sizeof *pieces->order),
    .piece_of = celd_alloc (lattice->n_vertices, sizeof *pieces->piece_of),
  };
  if (!pieces->mark || !pieces->bond || !pieces->piece || !pieces->order || !pieces->piece_of)
    {
      celd_pieces_clear (pieces);
      return CELD_NO_MEMORY;
    }
  list_marks (lattice, images, pieces);
  list_bonds (lattice, pieces);
  sort_pieces (lattice, pieces);
  return CELD_OK;
}

void
celd_pieces_clear (CeldPieces *pieces)
{
  celd_free (pieces->mark);
  celd_free (pieces->bond);
  celd_free (pieces->piece);
  celd_free (pieces->order);
  celd_free (pieces->piece_of);
  *pieces = (CeldPieces) { .mark = NULL };
}
