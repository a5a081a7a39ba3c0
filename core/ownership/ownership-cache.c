/* Whose the ink is, kept between edits: only what an edit touches is claimed again, and the result is what it would be
 * from the beginning, bit by bit.
 *
 * That is so because claims come to the same in whichever order they are made (claims.c): a tile of the picture is
 * forgotten and claimed again by all that reach it, which changes nothing beside it.  Ink that nobody claims is given
 * away in connected pieces, each from what is beside it alone.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/tiles.h"
#include "ownership/contours.h"
#include "ownership/ownership.h"

#include <math.h>

/* ------------------------------------------------------------------ claims */

static bool
touches (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim)
{
  CeldTileSpan span[CELD_SPANS];
  int          n = celd_claim_tiles (ink, tiles, claim, span);

  for (int i = 0; i < n; i++)
    if (celd_tiles_any (tiles, span[i], CELD_TILE_CLAIM))
      return true;
  return false;
}

/* Claims again all that may reach a marked tile. */
static void
claim_again (const CeldClaims *c, const CeldOwnersInput *in, const bool *solid, const CeldTiles *tiles)
{
  const CeldInkEdges *edges = c->pens->edges;

  for (int y = 0; y < tiles->down; y++)
    for (int x = 0; x < tiles->across; x++)
      if (tiles->at[(size_t) y * (size_t) tiles->across + (size_t) x] & CELD_TILE_CLAIM)
        celd_claims_begin (c, in->labels, solid, celd_tile_rect (x, y, in->ink->width, in->ink->height));
  for (size_t k = 0; k < edges->n_loops; k++)
    for (size_t i = 0; i < edges->loop[k].n; i++)
      {
        CeldClaim claim[CELD_CLAIMS];
        size_t    n = celd_pen_claims (c->pens, &edges->loop[k], i, claim);

        for (size_t j = 0; j < n; j++)
          if (touches (c->ink, tiles, &claim[j]))
            celd_claim_make (c, &claim[j]);
      }
}

/* ------------------------------------------------------------------ ink that nobody claims */

typedef struct { const CeldClaims *claims; CeldTiles *tiles; CeldOwned *item; size_t n; } Rest;

/* Takes the pixel into the list if nobody has claimed it and it is not there yet. */
static CeldStatus
take (Rest *rest, int x, int y)
{
  uint32_t  *owner = &CELD_AT (rest->claims->owner, x, y);
  CeldOwned *item;

  if (CELD_AT (rest->claims->over, x, y) != INFINITY || *owner == CELD_WAITING)
    return CELD_OK;
  item = celd_grow (rest->item, rest->n + 1, sizeof *item);
  if (!item)
    return CELD_NO_MEMORY;
  rest->item = item;
  item[rest->n++].pixel = (int32_t) (y * rest->claims->ink->width + x);
  *owner = CELD_WAITING;
  *celd_tile_of (rest->tiles, x, y) |= CELD_TILE_SHARE;
  return CELD_OK;
}

/* All of every piece that lies in marked tiles, or next to them. */
static CeldStatus
find_pieces (Rest *rest)
{
  const CeldPlane *ink = rest->claims->ink;
  CeldStatus       status = CELD_OK;

  for (int ty = 0; ty < rest->tiles->down; ty++)
    for (int tx = 0; tx < rest->tiles->across; tx++)
      {
        CeldRect r = celd_tile_rect (tx, ty, ink->width, ink->height);

        if (!(*celd_tile_of (rest->tiles, r.x, r.y) & CELD_TILE_CLAIM))
          continue;
        for (int y = r.y > 0 ? r.y - 1 : 0; y <= r.y + r.height && y < ink->height && !status; y++)
          for (int x = r.x > 0 ? r.x - 1 : 0; x <= r.x + r.width && x < ink->width && !status; x++)
            status = take (rest, x, y);
      }
  for (size_t i = 0; i < rest->n && !status; i++)
    {
      int near[4][2], n = celd_pixel_neighbours (ink, rest->item[i].pixel, near);

      for (int k = 0; k < n && !status; k++)
        status = take (rest, near[k][0], near[k][1]);
    }
  return status;
}

static CeldStatus
settle_again (const CeldClaims *c, CeldTiles *tiles)
{
  Rest       rest = { c, tiles, NULL, 0 };
  CeldStatus status = find_pieces (&rest);

  for (size_t i = 0; i < rest.n; i++)
    CELD_AT (c->owner, rest.item[i].pixel % c->ink->width, rest.item[i].pixel / c->ink->width) = 0;
  if (!status)
    celd_claims_settle (c, rest.item, rest.n);
  celd_free (rest.item);
  return status;
}

/* ------------------------------------------------------------------ corrections */

static void
mark_given (const CeldGiven *given, int width, CeldTiles *tiles)
{
  for (size_t i = 0; i < given->n; i++)
    *celd_tile_of (tiles, given->item[i].pixel % width, given->item[i].pixel / width) |= CELD_TILE_SHARE;
}

static void
take_back (CeldOwnersKept *kept, CeldTiles *tiles)
{
  int width = kept->owner.width;

  mark_given (&kept->given, width, tiles);
  for (size_t i = kept->given.n; i-- > 0;)
    CELD_AT (&kept->owner, kept->given.item[i].pixel % width, kept->given.item[i].pixel / width) =
      kept->given.item[i].owner;
  celd_given_clear (&kept->given);
}

static CeldStatus
correct (const CeldOwnersInput *in, CeldOwnersKept *kept, CeldTiles *tiles)
{
  CeldStatus status = CELD_OK;

  if (in->corrections)
    status = celd_pens_correct (&kept->pens, in->ink, in->corrections, &kept->owner, &kept->given);
  mark_given (&kept->given, in->ink->width, tiles);
  return status;
}

/* ------------------------------------------------------------------ the record */

static CeldRect
cut_rect (CeldRect r, int width, int height)
{
  int right = r.x + r.width < width ? r.x + r.width : width, bottom = r.y + r.height < height ? r.y + r.height : height;

  r.x = r.x > 0 ? r.x : 0;
  r.y = r.y > 0 ? r.y : 0;
  return (CeldRect) { r.x, r.y, right - r.x, bottom - r.y };
}

/* Owners that have changed are seen in the next pixels, too. */
static CeldRect
renew_record (const CeldOwnersInput *in, const CeldOwnersKept *kept, bool sort, const CeldTiles *tiles,
              CeldOwnership *own)
{
  CeldRect changed = { 0 };
  int      w = in->ink->width, h = in->ink->height;

  for (int ty = 0; ty < tiles->down; ty++)
    for (int tx = 0; tx < tiles->across; tx++)
      {
        CeldRect r = celd_tile_rect (tx, ty, w, h), round = cut_rect ((CeldRect) { r.x - 1, r.y - 1, r.width + 2,
                                                                                   r.height + 2 }, w, h);

        if (*celd_tile_of (tiles, r.x, r.y))
          changed = celd_rect_union (changed, celd_share_again (in->ink, &kept->owner, in->level, round, own));
        else if (sort && *celd_tile_of (&kept->grey, r.x, r.y))
          changed = celd_rect_union (changed, celd_sort_again (&kept->owner, in->level, r, own));
      }
  return changed;
}

/* ------------------------------------------------------------------ from the beginning */

/* What is new about the labels takes the place of the old: pens, whose level is owned, and solid labels. */
static void
replace_pens (CeldOwnersKept *kept, CeldPens *pens, bool **solid)
{
  celd_pens_clear (&kept->pens);
  celd_free (kept->level);
  celd_free (kept->solid);
  kept->pens  = *pens;
  kept->level = (uint32_t *) pens->level;
  kept->solid = *solid;
  *pens  = (CeldPens) { 0 };
  *solid = NULL;
}

/* Pens and solid labels; to be cleared with the level whatever is returned. */
static CeldStatus
measure (const CeldOwnersInput *in, const CeldOwnersKept *kept, CeldRect new_labels, CeldPens *pens, bool **solid)
{
  uint32_t  *level = celd_alloc (in->n, sizeof *level);
  CeldStatus status;

  *solid = celd_alloc (in->n, sizeof **solid);
  status = level && *solid ? CELD_OK : CELD_NO_MEMORY;
  if (!status)
    memcpy (level, in->level, in->n * sizeof *level);
  if (!status)
    status = celd_pens_renew (&kept->pens, in->labels, new_labels, level, in->n, pens);
  if (!status && !new_labels.width && in->n == kept->pens.n)
    memcpy (*solid, kept->solid, in->n * sizeof **solid);
  else if (!status)
    status = celd_solid_find (pens, in->ink, in->labels, *solid);
  if (status)
    {
      celd_pens_clear (pens);
      celd_free (level);
    }
  return status;
}

/* Where pixels have shares. */
static CeldStatus
find_grey (const CeldPlane *ink, CeldTiles *grey)
{
  CeldStatus status = celd_tiles_new (ink->width, ink->height, grey);

  for (int y = 0; y < ink->height && !status; y++)
    for (int x = 0; x < ink->width; x++)
      if (CELD_AT (ink, x, y) > 0 && CELD_AT (ink, x, y) < 1)
        *celd_tile_of (grey, x, y) = 1;
  return status;
}

CeldStatus
celd_owners_make (const CeldOwnersInput *input, const CeldHost *host, CeldOwnersKept *kept, CeldOwnership *ownership)
{
  int        w = input->ink->width, h = input->ink->height;
  CeldHostPart   part[2];
  CeldHost   first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldPens   pens = { 0 };
  bool      *solid = NULL;
  CeldStatus status;

  celd_owners_clear (kept);
  kept->pens.edges = &kept->edges;
  status = find_grey (input->ink, &kept->grey);
  if (!status)
    status = celd_ink_edges_new (input->ink, &first, &kept->edges);
  if (!status)
    status = measure (input, kept, (CeldRect) { 0, 0, w, h }, &pens, &solid);
  if (!status)
    replace_pens (kept, &pens, &solid);
  if (!status)
    status = celd_labels_new (w, h, &kept->owner);
  if (!status)
    status = celd_plane_new (w, h, &kept->over);
  if (!status)
    status = celd_pens_claim (&kept->pens, input->ink, input->labels, kept->solid, &second, &kept->owner, &kept->over);
  if (!status && input->corrections)
    status = celd_pens_correct (&kept->pens, input->ink, input->corrections, &kept->owner, &kept->given);
  if (!status)
    {
      memcpy (ownership->owner.data, kept->owner.data, (size_t) w * (size_t) h * sizeof (uint32_t));
      celd_share_edges (input->ink, input->level, ownership);
    }
  celd_free (solid);
  if (status)
    celd_owners_clear (kept);
  return status;
}

/* ------------------------------------------------------------------ from where it was */

/* Owners for new labels or levels; corrections are taken back. */
static CeldStatus
renew_owners (const CeldOwnersInput *in, CeldRect new_labels, const CeldHost *host, CeldOwnersKept *kept,
              CeldTiles *tiles)
{
  CeldPens   pens = { 0 };
  CeldClaims claims = { &kept->pens, in->ink, &kept->owner, &kept->over };
  bool      *solid = NULL;
  CeldStatus status = measure (in, kept, new_labels, &pens, &solid);

  if (!status)
    status = celd_owners_compare (kept, in, new_labels, &pens, solid, tiles);
  if (!status)
    status = celd_progress (host, 0.5);
  if (!status)
    {
      replace_pens (kept, &pens, &solid);
      claim_again (&claims, in, kept->solid, tiles);
      status = settle_again (&claims, tiles);
    }
  celd_free ((uint32_t *) pens.level);
  celd_pens_clear (&pens);
  celd_free (solid);
  return status;
}

CeldStatus
celd_owners_renew (const CeldOwnersInput *input, CeldRect new_labels, const CeldHost *host, CeldOwnersKept *kept,
                   CeldOwnership *ownership, CeldRect *changed)
{
  bool       same = kept->pens.n == input->n && !memcmp (kept->level, input->level, input->n * sizeof *input->level);
  CeldTiles  tiles = { 0 };
  CeldStatus status = celd_tiles_new (input->ink->width, input->ink->height, &tiles);

  if (!status)
    take_back (kept, &tiles);
  if (!status && (!same || new_labels.width))
    status = renew_owners (input, new_labels, host, kept, &tiles);
  if (!status)
    status = correct (input, kept, &tiles);
  if (!status)
    status = celd_progress (host, 1);
  if (!status)
    *changed = renew_record (input, kept, !same, &tiles, ownership);
  else
    celd_owners_clear (kept);
  celd_free (tiles.at);
  return status;
}

void
celd_owners_clear (CeldOwnersKept *kept)
{
  celd_pens_clear (&kept->pens);
  celd_ink_edges_clear (&kept->edges);
  celd_given_clear (&kept->given);
  celd_free (kept->level);
  celd_free (kept->solid);
  celd_free (kept->owner.data);
  celd_free (kept->over.data);
  celd_free (kept->grey.at);
  *kept = (CeldOwnersKept) { 0 };
}
