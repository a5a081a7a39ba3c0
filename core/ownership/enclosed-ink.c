/* Ink that has no paper of its owner beside it, and lies wholly within what another label owns, goes to that label.
 *
 * Such ink is the free end of a line, or a piece of one, that a claim from another side of the contour has reached.  In
 * depth it would be a crumb.  Ink between two labels stays: a part may show itself by its outline alone.
 *
 * Cost: O(pixels); 4 bytes a pixel.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "image/image.h"
#include "ownership/ownership.h"

#include <math.h>

/* What is beside a connected piece of ink of one owner: paper of the owner, or several labels; or so far only one. */
typedef struct { bool stays; uint32_t around; } InkPiece;

typedef struct
{
  const CeldPlane  *excess; /* see CeldClaimMap */
  const CeldLabels *owner;
  CeldLabels        piece;  /* of each pixel, from 1; 0: it was settled without claims */
  InkPiece         *list;
} InkPieces;

static CeldStatus
number_pieces (InkPieces *s)
{
  CeldComponent *list = NULL;
  size_t         n = 0;
  CeldStatus     status = celd_labels_new (s->owner->width, s->owner->height, &s->piece);

  for (int y = 0; y < s->piece.height && status == CELD_OK; y++)
    for (int x = 0; x < s->piece.width; x++)
      CELD_AT (&s->piece, x, y) = CELD_AT (s->excess, x, y) == -INFINITY ? 0 : CELD_AT (s->owner, x, y);
  if (status == CELD_OK)
    status = celd_components (&s->piece, 0, true, NULL, &s->piece, &list, &n);
  celd_free (list);
  if (status == CELD_OK && !(s->list = celd_alloc0 (n + 1, sizeof *s->list)))
    status = CELD_NO_MEMORY;
  return status;
}

/* Notes what the eight neighbours of a pixel say about its piece. */
static void
look_round (const InkPieces *s, int x, int y, InkPiece *piece)
{
  uint32_t own = CELD_AT (s->owner, x, y);

  for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < s->owner->height; v++)
    for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < s->owner->width; u++)
      {
        uint32_t there = CELD_AT (s->owner, u, v);

        if (there == own)
          piece->stays = piece->stays || !CELD_AT (&s->piece, u, v);
        else
          {
            piece->stays  = piece->stays || (piece->around && piece->around != there);
            piece->around = there;
          }
      }
}

static void
look_round_pieces (const InkPieces *s)
{
  for (int y = 0; y < s->owner->height; y++)
    for (int x = 0; x < s->owner->width; x++)
      {
        InkPiece *piece = &s->list[CELD_AT (&s->piece, x, y)];

        if (CELD_AT (&s->piece, x, y) && !piece->stays)
          look_round (s, x, y, piece);
      }
}

CeldStatus
celd_enclosed_ink_join (const CeldPlane *excess, CeldLabels *owner, CeldReassigned *reassigned)
{
  InkPieces  s = { .excess = excess, .owner = owner };
  CeldStatus status = number_pieces (&s);

  if (status == CELD_OK)
    look_round_pieces (&s);
  for (int y = 0; y < owner->height && status == CELD_OK; y++)
    for (int x = 0; x < owner->width && status == CELD_OK; x++)
      {
        const InkPiece *piece = &s.list[CELD_AT (&s.piece, x, y)];
        CeldPixelOwner  former = { (int32_t) (y * owner->width + x), CELD_AT (owner, x, y) };

        if (piece->stays || !piece->around)
          continue;
        status = celd_append (reassigned->item, reassigned->n, reassigned->capacity, former);
        if (status == CELD_OK)
          CELD_AT (owner, x, y) = piece->around;
      }
  celd_free (s.piece.data);
  celd_free (s.list);
  return status;
}
