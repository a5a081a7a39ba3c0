/* The inside of swing.c: pieces of a lattice, their pixels, and what they are torn off.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SWING_H
#define CELD_SWING_H

#include "motion/motion.h"

/* A pixel of a scale: its place in the drawing. */
typedef struct { float x, y; uint32_t cell; bool ink; } CeldPieceMark;

/* A vertex of a piece, and one of another piece that it was torn off. */
typedef struct { uint32_t own, other, piece; } CeldPieceBond;

/* Marks and bonds of a piece are n from the first on; `ink` of the marks are ink. */
typedef struct { size_t mark, n, ink, bond, n_bonds; uint32_t level; } CeldPiece;

typedef struct
{
  CeldPieceMark *mark;       /* by pieces */
  CeldPieceBond *bond;       /* by pieces; of a piece by the other piece */
  CeldPiece     *piece;
  uint32_t      *order;      /* of pieces, those with most ink first */
  uint32_t      *piece_of;   /* of each vertex */
} CeldPieces;

CeldStatus celd_pieces_new   (const CeldLattice *lattice, const CeldMatchImages *images, CeldPieces *pieces);
void       celd_pieces_clear (CeldPieces *pieces);            /* accepts a zeroed record */

#endif
