/* What the files share that bring back the colours which loss has smeared: scribble-loss.c measures the strokes in
 * every block of the picture, scribble-unmix.c says which of them are one stroke, and of which colour each was.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SCRIBBLE_LOSS_H
#define CELD_SCRIBBLE_LOSS_H

#include "input/scribbles.h"

/* The connected part of a stroke within one block.  Colours are deficits: how far below paper each channel is. */
typedef struct
{
  double   core[3];     /* where it is strongest: right in luma, too weak in chroma */
  double   full[3];     /* what it would have without smear, by the sum over its block */
  double   colour[3];   /* of the two */
  double   luma;        /* of the core */
  double   cover;       /* painted pixels, those of edges in part */
  double   all;         /* the same, of the stroke that it is the first piece of */
  uint32_t block;
  uint32_t stroke;      /* union-find: a piece of its stroke */
} CeldLossPiece;

typedef struct { uint32_t a, b; float distance; } CeldLossContact;      /* pieces that touch, and how unlike they are */

typedef struct { double sum[3], expected[3]; } CeldLossBlock;           /* deficit: of its pixels, and of the strokes in it */

typedef struct
{
  CeldScribbleLayer *r;           /* label is lent: 1 + the piece of each pixel, 0 = paper; kind, too: how much it stands out */
  int      columns;     /* blocks a row */
  size_t   n_blocks;
  CeldLossBlock   *block;
  CeldLossPiece   *piece;
  size_t   n;
  CeldLossContact *contact;
  size_t   n_contacts;
  size_t   piece_capacity, contact_capacity;
} CeldLossStrokes;

/* Luma of a colour or a deficit. */
static inline double
celd_deficit_luma (const double *d)
{
  return 0.299 * d[0] + 0.587 * d[1] + 0.114 * d[2];
}

/* Fills in stroke and colour of the pieces, whose core, cover and block are known. */
CeldStatus celd_scribble_unmix (CeldLossStrokes *s, const CeldHost *host);

#endif
