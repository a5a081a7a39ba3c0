/* Ink that has no paper of its owner beside it, and lies wholly within what another label owns, goes to that label.
 *
 * Such ink is the free end of a line, or a piece of one, that a claim from another side of the contour has reached.  In
 * depth it would be a crumb.  Ink between two labels stays: a part may show itself by its outline alone.
 *
 * Cost: a pass over the picture, and one over ink; 1 byte a pixel, and 4 a pixel of ink.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "ownership/ownership.h"

#include <math.h>

/* A connected piece of ink of one owner. */
typedef struct
{
  int32_t *pixel;
  size_t   n;
  bool     paper;   /* is paper of its owner beside it? */
  uint32_t around;  /* the label around it; 0: none so far */
  bool     several; /* more than one */
} Piece;

typedef struct
{
  const CeldPlane *excess; /* see CeldClaimMap */
  CeldLabels      *owner;
  uint8_t         *seen;   /* of each pixel */
  Piece            piece;
} EnclosedSearch;

static bool
is_settled (const EnclosedSearch *s, int x, int y)
{
  return CELD_AT (s->excess, x, y) == -INFINITY;
}

/* Adds a pixel to the piece, or notes what it has beside it. */
static void
look_at (EnclosedSearch *s, uint32_t owner, int x, int y)
{
  uint32_t here = CELD_AT (s->owner, x, y);
  size_t   p = (size_t) y * (size_t) s->owner->width + (size_t) x;

  if (here != owner)
    {
      s->piece.several = s->piece.several || (s->piece.around && s->piece.around != here);
      s->piece.around  = here;
    }
  else if (is_settled (s, x, y))
    s->piece.paper = true;
  else if (!s->seen[p])
    {
      s->seen[p] = 1;
      s->piece.pixel[s->piece.n++] = (int32_t) p;
    }
}

/* Collects the ink of one owner that is connected with a pixel; pixels have eight neighbours. */
static void
collect (EnclosedSearch *s, int x, int y)
{
  uint32_t owner = CELD_AT (s->owner, x, y);
  int      w = s->owner->width, h = s->owner->height;

  s->piece = (Piece) { .pixel = s->piece.pixel };
  look_at (s, owner, x, y);
  for (size_t i = 0; i < s->piece.n; i++)
    {
      int u = s->piece.pixel[i] % w, v = s->piece.pixel[i] / w;

      for (int ny = v > 0 ? v - 1 : 0; ny <= v + 1 && ny < h; ny++)
        for (int nx = u > 0 ? u - 1 : 0; nx <= u + 1 && nx < w; nx++)
          look_at (s, owner, nx, ny);
    }
}

/* Lists the pixels of enclosed pieces with their new owners. */
static CeldStatus
find_enclosed (EnclosedSearch *s, CeldReassigned *enclosed)
{
  CeldStatus status = CELD_OK;

  for (int y = 0; y < s->owner->height; y++)
    for (int x = 0; x < s->owner->width && status == CELD_OK; x++)
      if (!is_settled (s, x, y) && !s->seen[(size_t) y * (size_t) s->owner->width + (size_t) x])
        {
          collect (s, x, y);
          for (size_t i = 0; i < s->piece.n && status == CELD_OK && !s->piece.paper && !s->piece.several &&
                             s->piece.around; i++)
            status = celd_append (enclosed->item, enclosed->n, enclosed->capacity,
                                  (CeldPixelOwner) { s->piece.pixel[i], s->piece.around });
        }
  return status;
}

CeldStatus
celd_enclosed_ink_join (const CeldPlane *excess, CeldLabels *owner, CeldReassigned *reassigned)
{
  size_t         pixels = (size_t) owner->width * (size_t) owner->height, n_ink = 0, first = reassigned->n;
  EnclosedSearch s = { excess, owner, celd_alloc0 (pixels, 1), { 0 } };
  CeldStatus     status;

  for (int y = 0; y < owner->height; y++)
    for (int x = 0; x < owner->width; x++)
      n_ink += !is_settled (&s, x, y);
  s.piece.pixel = celd_alloc (n_ink + 1, sizeof *s.piece.pixel);
  status = s.seen && s.piece.pixel ? find_enclosed (&s, reassigned) : CELD_NO_MEMORY;
  if (status != CELD_OK)
    reassigned->n = first;
  for (size_t i = first; i < reassigned->n; i++) /* after all are found, so that their order has no influence */
    {
      CeldPixelOwner *item = &reassigned->item[i];
      uint32_t       *here = &CELD_AT (owner, item->pixel % owner->width, item->pixel / owner->width), former = *here;

      *here = item->owner;
      item->owner = former;
    }
  celd_free (s.seen);
  celd_free (s.piece.pixel);
  return status;
}
