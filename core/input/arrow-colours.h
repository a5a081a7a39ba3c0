/* What the files share that tell strokes apart by their colours.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_ARROW_COLOURS_H
#define CELD_ARROW_COLOURS_H

#include "input/arrows.h"
#include "input/trail.h"

#define CELD_ALIKE     0.65 /* colours that differ less are one, */
#define CELD_UNLIKE    1.0  /* those that differ more are two; in between it is not clear */
#define CELD_NOISE     16   /* of a pixel, on paper: a codec's echoes; */
#define CELD_LESS_NOISE 5   /* of a mean */

/* ------------------------------------------------------------------ arrow-tints.c */

/* A colour, in layers without alpha its difference from the paper, and how opaque it is, 0 .. 255. */
typedef struct { float c[3], strength; } CeldTint;

CeldTint celd_tint_at (const CeldArrowLayer *layer, int x, int y);
CeldTint celd_tint_between (const CeldTint *a, const CeldTint *b, double t);
double   celd_tints_differ (const CeldArrowLayer *layer, const CeldTint *a, const CeldTint *b, double noise);
void     celd_tint_paint (const CeldArrowLayer *layer, const CeldTint *t, uint8_t rgba[4]);

/* ------------------------------------------------------------------ colour-insides.c */

/* A component, and its pieces of one colour each.  Painted pixels are numbered in reading order. */
typedef struct
{
  CeldCutting cutting;
  uint32_t   *number;   /* of each place of the cutting: 1 + its pixel; 0 = not painted */
  uint32_t   *place;    /* of each pixel: its place in the cutting */
  CeldTint   *tint;     /* the mean round each pixel */
  uint32_t   *piece;    /* of each pixel: from 1; 0 = of no clear colour */
  uint32_t   *like;     /* of each pixel in a piece: one well inside whose tint it has */
  size_t      n_pixels, n;
  double      width;    /* of its lines, roughly; */
  double     *widths;   /* of those of each piece */
} CeldPieces;

/* Fills in all but `widths`; n < 2 if there are no two insides.  What was made is to be cleared also after failure. */
CeldStatus celd_colour_insides_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldPieces *pieces);

/* The width of lines whose pixels have this mean of squared depths in the paint. */
double celd_lines_width (double squared);

CeldPoint celd_pieces_middle (const CeldPieces *pieces, size_t pixel); /* in the cutting */
CeldTint  celd_pieces_tint (const CeldPieces *pieces, const CeldArrowLayer *layer, size_t pixel); /* its own */

/* The pixel at an offset, counted from 1; 0 if none is painted there. */
uint32_t celd_pieces_near (const CeldPieces *pieces, size_t pixel, int dx, int dy);

/* ------------------------------------------------------------------ colour-pieces.c */

/* n < 2 if the component has one colour, or none that are clearly two. */
CeldStatus celd_colour_pieces_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldPieces *pieces);
void       celd_colour_pieces_clear (CeldPieces *pieces);

/* ------------------------------------------------------------------ colour-contacts.c */

#define CELD_MOST_CONTACTS 128 /* more are no arrows */
#define CELD_GATHERED      2   /* pixels of one contact are no farther apart */
#define CELD_SQUARE        (2 * CELD_GATHERED + 1)

/* Where a strand is next to other paint, and the arm that ends there. */
typedef struct
{
  CeldPoint at, back;       /* middles of the contact, and of the arm some way behind it: in the cutting */
  CeldPoint way;            /* of length 1, out of the arm */
  double    width, reach;   /* of the arm; of the contact along it, from its middle */
  bool      is_arm, passes; /* does an arm end here, or does the stroke go on both ways? */
  CeldTint  tint;
  uint32_t  piece;
  size_t    n, mate;        /* pixels; the contact that it faces, CELD_NO_INDEX if none */
} CeldContact;

typedef struct
{
  const CeldArrowLayer *layer;
  CeldPieces            pieces;
  uint32_t             *parent;     /* of pieces: union-find of strands */
  uint32_t             *contact_of; /* of each pixel: from 1; 0 = none */
  CeldContact          *contact;
  size_t                n_contacts;
  size_t                band[CELD_MOST_CONTACTS / 2]; /* the contacts, with their mates, between which bands lie */
  size_t                n_bands;
  uint64_t             *bands;      /* of each pixel: a bit for every band that it is in */
  bool                 *dropped;    /* strands that are only where others overlap */
} CeldJoints;

/* Fills in contacts, and joins the strands of those that face each other; *many is true if there are too many. */
CeldStatus celd_colour_contacts_find (CeldJoints *joints, bool *many);

/* ------------------------------------------------------------------ strand-colours.c */

/* Strokes that are told apart by colour.  Of each pixel its R'G'B'A, or what it would have if nothing crossed there. */
typedef struct
{
  CeldStrands strands;
  uint8_t    *rgba;
  bool       *is_cut;       /* may part of strand k be hidden? */
  CeldPoint  *touch;        /* pixels of strand k that others touch without crossing: from first_touch[k] on */
  size_t     *first_touch;
} CeldColourStrands;

/* strands.n = 0 if there is one stroke at most, or what there is cannot be told apart. */
CeldStatus celd_strand_colours_find (const CeldTrail *trail, const CeldArrowLayer *layer, CeldColourStrands *found);
void       celd_strand_colours_clear (CeldColourStrands *found);

#endif
