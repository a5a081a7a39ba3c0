/* Holes that grain leaves in ink, as chalk and soft pencils do in broad strokes.
 *
 * Such a hole is small and grey throughout.  Paper is bright somewhere, like the strong edges in the hysteresis of
 * Canny (1986), or long, like a gap out of focus between two lines.  Holes would end lines, and show edges where no
 * region has one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "image/ink-steps.h"

#include <string.h>

#define BRIGHT   0.85f /* values of ink from here on are paper without doubt; chosen */
#define MAX_SIDE 32    /* pixels, width and height of a hole: two of the widest grains that are looked for, together */

/* What is known of a grey pixel: nothing yet, that it is in the piece at hand, or that it was in no hole. */
enum { UNVISITED, IN_PIECE, NO_HOLE };

typedef struct { int x, y; } Pixel;

/* A connected piece of grey paper, as far as it has the size of a hole; whether it is none. */
typedef struct { Pixel pixel[MAX_SIDE * MAX_SIDE]; int n, left, right, bottom; bool paper; } GreyPiece;

/* Looks at a pixel that is in the piece or touches it.  Pieces are found at their first pixel in reading order, so the
 * top is that one's. */
static void
visit (const CeldPlane *ink, int x, int y, CeldMask *known, GreyPiece *piece)
{
  if (x < 0 || y < 0 || x >= ink->width || y >= ink->height || !celd_is_paper (CELD_AT (ink, x, y)) ||
      CELD_AT (known, x, y) == IN_PIECE)
    return;
  if (!(CELD_AT (ink, x, y) < BRIGHT) || CELD_AT (known, x, y) == NO_HOLE || y >= piece->bottom ||
      x <= piece->right - MAX_SIDE || x >= piece->left + MAX_SIDE)
    {
      piece->paper = true;
      return;
    }
  CELD_AT (known, x, y) = IN_PIECE;
  piece->pixel[piece->n++] = (Pixel) { x, y };
  piece->left  = x < piece->left ? x : piece->left;
  piece->right = x > piece->right ? x : piece->right;
}

/* Fills the piece of grey paper whose first pixel is (x,y) if it is a hole. */
static void
fill_piece (int x, int y, CeldPlane *ink, CeldMask *known)
{
  GreyPiece piece;

  piece.n      = 0;
  piece.left   = piece.right = x;
  piece.bottom = y + MAX_SIDE;
  piece.paper  = false;
  visit (ink, x, y, known, &piece);
  for (int i = 0; i < piece.n; i++)
    for (int k = 0; k < 9; k++)
      visit (ink, piece.pixel[i].x + k % 3 - 1, piece.pixel[i].y + k / 3 - 1, known, &piece);
  for (int i = 0; i < piece.n; i++)
    {
      CELD_AT (known, piece.pixel[i].x, piece.pixel[i].y) = NO_HOLE;
      if (!piece.paper)
        CELD_AT (ink, piece.pixel[i].x, piece.pixel[i].y) = 0;
    }
}

void
celd_ink_fill_grain (CeldPlane *ink, CeldMask *known)
{
  memset (known->data, UNVISITED, known->stride * (size_t) known->height);
  for (int y = 0; y < ink->height; y++)
    for (int x = 0; x < ink->width; x++)
      if (celd_is_paper (CELD_AT (ink, x, y)) && CELD_AT (ink, x, y) < BRIGHT && CELD_AT (known, x, y) == UNVISITED)
        fill_piece (x, y, ink, known);
}
