/* Contour ownership, kept between edits: only tiles that an edit affects are claimed again, and the result equals that
 * of a computation from scratch bit for bit.
 *
 * This works because the result of claims is independent of their order (claims.c): a tile is reset and claimed again
 * by all claims that touch it, without any effect on other tiles.  Unclaimed ink is assigned again by connected
 * components, each of which depends on the pixels beside it alone.  What was reassigned after that is reverted before
 * an edit, and found again from all owners.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "base/base.h"
#include "ownership/ownership.h"

#include <math.h>

/* ------------------------------------------------------------------ claims */

static bool
touches (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim)
{
  CeldTileSpan span[CELD_MAX_CLAIM_SPANS];
  int          n = celd_claim_tiles (ink, tiles, claim, span);

  for (int i = 0; i < n; i++)
    if (celd_tiles_any (tiles, span[i], CELD_TILE_CLAIM))
      return true;
  return false;
}

/* Resets the marked tiles and repeats all claims that touch one. */
static void
claim_again (const CeldClaimMap *c, const CeldOwnershipInput *in, const bool *solid, const CeldTiles *tiles)
{
  const CeldContourEdges *edges = c->pens->edges;

  for (int y = 0; y < tiles->down; y++)
    for (int x = 0; x < tiles->across; x++)
      if (tiles->at[(size_t) y * (size_t) tiles->across + (size_t) x] & CELD_TILE_CLAIM)
        celd_claims_reset (c, in->labels, solid, celd_tile_rect (x, y, in->ink->width, in->ink->height));
  for (size_t k = 0; k < edges->n_loops; k++)
    for (size_t i = 0; i < edges->loop[k].n; i++)
      {
        CeldClaim claim[CELD_MAX_CLAIMS];
        size_t    n = celd_claims_at_point (c->pens, &edges->loop[k], i, claim);

        for (size_t j = 0; j < n; j++)
          if (touches (c->ink, tiles, &claim[j]))
            celd_claim_apply (c, &claim[j]);
      }
}

/* ------------------------------------------------------------------ unclaimed ink */

typedef struct { const CeldClaimMap *claims; CeldTiles *tiles; CeldPixelOwner *item; size_t n, capacity; } Unclaimed;

/* Queues the pixel if it is unclaimed and not in the queue yet. */
static CeldStatus
add_unclaimed (Unclaimed *unclaimed, int x, int y)
{
  uint32_t       *owner = &CELD_AT (unclaimed->claims->owner, x, y);

  if (CELD_AT (unclaimed->claims->excess, x, y) != INFINITY || *owner == CELD_OWNER_PENDING)
    return CELD_OK;
  if (celd_append (unclaimed->item, unclaimed->n, unclaimed->capacity,
                   (CeldPixelOwner) { .pixel = (int32_t) (y * unclaimed->claims->ink->width + x) }) != CELD_OK)
    return CELD_NO_MEMORY;
  *owner = CELD_OWNER_PENDING;
  *celd_tile_of (unclaimed->tiles, x, y) |= CELD_TILE_COVERAGE;
  return CELD_OK;
}

/* Queues all connected components of unclaimed ink that have a pixel in a marked tile or next to one. */
static CeldStatus
find_unclaimed (Unclaimed *unclaimed)
{
  const CeldPlane *ink = unclaimed->claims->ink;
  CeldStatus       status = CELD_OK;

  for (int ty = 0; ty < unclaimed->tiles->down; ty++)
    for (int tx = 0; tx < unclaimed->tiles->across; tx++)
      {
        CeldRect r = celd_tile_rect (tx, ty, ink->width, ink->height);

        if (!(*celd_tile_of (unclaimed->tiles, r.x, r.y) & CELD_TILE_CLAIM))
          continue;
        for (int y = r.y > 0 ? r.y - 1 : 0; y <= r.y + r.height && y < ink->height && status == CELD_OK; y++)
          for (int x = r.x > 0 ? r.x - 1 : 0; x <= r.x + r.width && x < ink->width && status == CELD_OK; x++)
            status = add_unclaimed (unclaimed, x, y);
      }
  for (size_t i = 0; i < unclaimed->n && status == CELD_OK; i++)
    {
      int near[4][2], n = celd_pixel_neighbours (ink, unclaimed->item[i].pixel, near);

      for (int k = 0; k < n && status == CELD_OK; k++)
        status = add_unclaimed (unclaimed, near[k][0], near[k][1]);
    }
  return status;
}

static CeldStatus
spread_again (const CeldClaimMap *c, CeldTiles *tiles)
{
  Unclaimed  unclaimed = { c, tiles, NULL, 0, 0 };
  CeldStatus status = find_unclaimed (&unclaimed);

  for (size_t i = 0; i < unclaimed.n; i++)
    CELD_AT (c->owner, unclaimed.item[i].pixel % c->ink->width, unclaimed.item[i].pixel / c->ink->width) = 0;
  if (status == CELD_OK)
    celd_claims_spread (c, unclaimed.item, unclaimed.n);
  celd_free (unclaimed.item);
  return status;
}

/* ------------------------------------------------------------------ enclosed ink and corrections */

static void
mark_reassigned (const CeldReassigned *reassigned, int width, CeldTiles *tiles)
{
  for (size_t i = 0; i < reassigned->n; i++)
    *celd_tile_of (tiles, reassigned->item[i].pixel % width, reassigned->item[i].pixel / width) |= CELD_TILE_COVERAGE;
}

static void
revert_reassigned (CeldOwnershipCache *kept, CeldTiles *tiles)
{
  int width = kept->owner.width;

  mark_reassigned (&kept->reassigned, width, tiles);
  for (size_t i = kept->reassigned.n; i-- > 0;)
    CELD_AT (&kept->owner, kept->reassigned.item[i].pixel % width, kept->reassigned.item[i].pixel / width) =
      kept->reassigned.item[i].owner;
  celd_reassigned_clear (&kept->reassigned);
}

static CeldStatus
reassign (const CeldOwnershipInput *in, CeldOwnershipCache *kept)
{
  CeldStatus status = celd_enclosed_ink_join (&kept->excess, &kept->owner, &kept->reassigned);

  if (status == CELD_OK)
    status = celd_line_pieces_give (&kept->pens, &kept->excess, &kept->owner, &kept->reassigned);
  if (status == CELD_OK && in->corrections)
    status = celd_corrections_apply (&kept->pens, in->ink, in->corrections, &kept->owner, &kept->reassigned);
  return status;
}

/* ------------------------------------------------------------------ the record */

static CeldRect
clip_rect (CeldRect r, int width, int height)
{
  int right = r.x + r.width < width ? r.x + r.width : width, bottom = r.y + r.height < height ? r.y + r.height : height;

  r.x = r.x > 0 ? r.x : 0;
  r.y = r.y > 0 ? r.y : 0;
  return (CeldRect) { r.x, r.y, right - r.x, bottom - r.y };
}

/* Fills in the marked tiles, or the order in the others that have antialiased pixels.  A changed owner affects the
 * neighbouring pixels, too. */
static CeldRect
update_tiles (const CeldOwnershipInput *in, const CeldOwnershipCache *kept, bool marked, const CeldTiles *tiles,
              CeldOwnership *own)
{
  CeldRect changed = { 0 };
  int      w = in->ink->width, h = in->ink->height;

  for (int ty = 0; ty < tiles->down; ty++)
    for (int tx = 0; tx < tiles->across; tx++)
      {
        CeldRect r = celd_tile_rect (tx, ty, w, h);
        CeldRect round = clip_rect ((CeldRect) { r.x - 1, r.y - 1, r.width + 2, r.height + 2 }, w, h);
        uint8_t  mark = *celd_tile_of (tiles, r.x, r.y);

        if (marked ? mark : !mark && *celd_tile_of (&kept->antialiased, r.x, r.y))
          changed = celd_rect_union (changed, celd_ownership_coverage (in->ink, &kept->owner, in->level,
                                                                       marked ? round : r, !marked, own));
      }
  return changed;
}

/* Updates the marked tiles, and if levels have changed (sort) the others.  These come last: until then their pixels
 * beside marked tiles may have labels that do not exist any more. */
static CeldRect
update_record (const CeldOwnershipInput *in, const CeldOwnershipCache *kept, bool sort, const CeldTiles *tiles,
               CeldOwnership *own)
{
  CeldRect changed = update_tiles (in, kept, true, tiles, own);

  return sort ? celd_rect_union (changed, update_tiles (in, kept, false, tiles, own)) : changed;
}

/* ------------------------------------------------------------------ from scratch */

/* Moves new pens, whose level is owned, and solid labels into the cache. */
static void
replace_pens (CeldOwnershipCache *kept, CeldContourPens *pens, bool **solid)
{
  celd_contour_pens_clear (&kept->pens);
  celd_free (kept->level);
  celd_free (kept->solid);
  kept->pens  = *pens;
  kept->level = (uint32_t *) pens->level;
  kept->solid = *solid;
  *pens  = (CeldContourPens) { 0 };
  *solid = NULL;
}

/* Computes pens and solid labels; after a failure both are cleared. */
static CeldStatus
measure_pens (const CeldOwnershipInput *in, const CeldOwnershipCache *kept, CeldRect new_labels, CeldContourPens *pens,
              bool **solid)
{
  uint32_t  *level = celd_alloc (in->n, sizeof *level);
  CeldStatus status;

  *solid = celd_alloc (in->n, sizeof **solid);
  status = level && *solid ? CELD_OK : CELD_NO_MEMORY;
  if (status == CELD_OK)
    memcpy (level, in->level, in->n * sizeof *level);
  if (status == CELD_OK)
    status = celd_contour_pens_update (&kept->pens, in->labels, new_labels, level, in->n, pens);
  if (status == CELD_OK && !new_labels.width && in->n == kept->pens.n)
    memcpy (*solid, kept->solid, in->n * sizeof **solid);
  else if (status == CELD_OK)
    status = celd_solid_labels_find (pens, in->ink, in->labels, *solid);
  if (status != CELD_OK)
    {
      celd_contour_pens_clear (pens);
      celd_free (level);
    }
  return status;
}

/* Finds the tiles with antialiased pixels. */
static CeldStatus
find_antialiased (const CeldPlane *ink, CeldTiles *antialiased)
{
  CeldStatus status = celd_tiles_new (ink->width, ink->height, antialiased);

  for (int y = 0; y < ink->height && status == CELD_OK; y++)
    for (int x = 0; x < ink->width; x++)
      if (CELD_AT (ink, x, y) > 0 && CELD_AT (ink, x, y) < 1)
        *celd_tile_of (antialiased, x, y) = 1;
  return status;
}

CeldStatus
celd_ownership_cache_make (const CeldOwnershipInput *input, const CeldHost *host, CeldOwnershipCache *kept,
                           CeldOwnership *ownership)
{
  int             w = input->ink->width, h = input->ink->height;
  CeldHostPart    part[2];
  CeldHost        first = celd_host_part (&part[0], host, 0, 0.5), second = celd_host_part (&part[1], host, 0.5, 1);
  CeldContourPens pens = { 0 };
  bool           *solid = NULL;
  CeldStatus      status;

  celd_ownership_cache_clear (kept);
  kept->pens.edges = &kept->edges;
  status = find_antialiased (input->ink, &kept->antialiased);
  if (status == CELD_OK)
    status = celd_contour_edges_new (input->ink, &first, &kept->edges);
  if (status == CELD_OK && input->colours)
    status = celd_line_shades_read (input->colours, input->ink, &kept->edges);
  if (status == CELD_OK)
    status = measure_pens (input, kept, (CeldRect) { 0, 0, w, h }, &pens, &solid);
  if (status == CELD_OK)
    replace_pens (kept, &pens, &solid);
  if (status == CELD_OK)
    status = celd_labels_new (w, h, &kept->owner);
  if (status == CELD_OK)
    status = celd_plane_new (w, h, &kept->excess);
  if (status == CELD_OK)
    status = celd_claims_assign (&kept->pens, input->ink, input->labels, kept->solid, &second, &kept->owner,
                                 &kept->excess);
  if (status == CELD_OK)
    status = reassign (input, kept);
  if (status == CELD_OK)
    celd_ownership_coverage (input->ink, &kept->owner, input->level, (CeldRect) { 0, 0, w, h }, false, ownership);
  celd_free (solid);
  if (status != CELD_OK)
    celd_ownership_cache_clear (kept);
  return status;
}

/* ------------------------------------------------------------------ updates */

/* Updates owners after a change of labels or levels; what is reassigned has to be reverted before. */
static CeldStatus
update_owners (const CeldOwnershipInput *in, CeldRect new_labels, const CeldHost *host, CeldOwnershipCache *kept,
               CeldTiles *tiles)
{
  CeldContourPens pens = { 0 };
  CeldClaimMap    claims = { &kept->pens, in->ink, &kept->owner, &kept->excess };
  bool           *solid = NULL;
  CeldStatus      status = measure_pens (in, kept, new_labels, &pens, &solid);

  if (status == CELD_OK)
    status = celd_ownership_mark_changes (kept, in, new_labels, &pens, solid, tiles);
  if (status == CELD_OK)
    status = celd_progress (host, 0.5);
  if (status == CELD_OK)
    {
      replace_pens (kept, &pens, &solid);
      claim_again (&claims, in, kept->solid, tiles);
      status = spread_again (&claims, tiles);
    }
  celd_free ((uint32_t *) pens.level);
  celd_contour_pens_clear (&pens);
  celd_free (solid);
  return status;
}

CeldStatus
celd_ownership_cache_update (const CeldOwnershipInput *input, CeldRect new_labels, const CeldHost *host,
                             CeldOwnershipCache *kept, CeldOwnership *ownership, CeldRect *changed)
{
  bool       same = kept->pens.n == input->n && !memcmp (kept->level, input->level, input->n * sizeof *input->level);
  CeldTiles  tiles = { 0 };
  CeldStatus status = celd_tiles_new (input->ink->width, input->ink->height, &tiles);

  if (status == CELD_OK)
    revert_reassigned (kept, &tiles);
  if (status == CELD_OK && (!same || new_labels.width))
    status = update_owners (input, new_labels, host, kept, &tiles);
  if (status == CELD_OK)
    status = reassign (input, kept);
  if (status == CELD_OK)
    status = celd_progress (host, 1);
  if (status == CELD_OK)
    mark_reassigned (&kept->reassigned, kept->owner.width, &tiles);
  if (status == CELD_OK)
    *changed = update_record (input, kept, !same, &tiles, ownership);
  else
    celd_ownership_cache_clear (kept);
  celd_free (tiles.at);
  return status;
}

void
celd_ownership_cache_clear (CeldOwnershipCache *kept)
{
  celd_contour_pens_clear (&kept->pens);
  celd_contour_edges_clear (&kept->edges);
  celd_reassigned_clear (&kept->reassigned);
  celd_free (kept->level);
  celd_free (kept->solid);
  celd_free (kept->owner.data);
  celd_free (kept->excess.data);
  celd_free (kept->antialiased.at);
  *kept = (CeldOwnershipCache) { 0 };
}
