/* Whose each pixel is.
 *
 *   ownership.c         from the beginning
 *   ownership.c   antialiased edges
 *   ownership-cache.c    kept between edits
 *   ownership-changes.c   where an edit touches it
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OWNERSHIP_H
#define CELD_OWNERSHIP_H

#include "base/tiles.h"
#include "ownership/contours.h"

/* ------------------------------------------------------------------ ownership.c */

/* In: in `owner` the label whose the larger part of each pixel is.  Out: the record, with the two labels of each pixel
 * at the edge of ink and how much of it is whose. */
void celd_ownership_coverage (const CeldPlane *ink, const uint32_t *level, CeldOwnership *ownership);

/* The same for the pixels of a rectangle, with the larger parts elsewhere.  Returns where the record changes. */
CeldRect celd_ownership_coverage_update (const CeldPlane *ink, const CeldLabels *larger, const uint32_t *level, CeldRect rect,
                           CeldOwnership *ownership);

/* For a rectangle where nothing but the levels is new. */
CeldRect celd_ownership_reorder (const CeldLabels *larger, const uint32_t *level, CeldRect rect, CeldOwnership *ownership);

/* ------------------------------------------------------------------ ownership-cache.c: CELD_EXPANSION_OUTLINES */

/* What owners were made from.  What depends on the drawing alone is made once. */
typedef struct
{
  CeldContourEdges edges;
  CeldTiles    antialiased;            /* not 0 where the ink has shares of pixels */
  CeldContourPens     pens;            /* with level and n */
  uint32_t    *level;           /* owned; NULL: nothing is kept */
  bool        *solid;
  CeldLabels   owner;           /* of the larger part of each pixel */
  CeldPlane    excess;            /* of it, see CeldClaimMap */
  CeldReassigned    reassigned;           /* what corrections have changed in owner */
} CeldOwnershipCache;

/* What owners are made from. */
typedef struct
{
  const CeldPlane  *ink;
  const CeldLabels *labels, *corrections; /* corrections NULL: none */
  const uint32_t   *level;
  size_t            n;
} CeldOwnershipInput;

/* Fills in the record, from the beginning or from where it was; the ink is the same, labels differ within a rectangle
 * only.  *changed is where the record does.  After a failure the record is as it was, and nothing is kept. */
CeldStatus celd_ownership_cache_make (const CeldOwnershipInput *input, const CeldHost *host, CeldOwnershipCache *kept,
                             CeldOwnership *ownership);
CeldStatus celd_ownership_cache_update (const CeldOwnershipInput *input, CeldRect new_labels, const CeldHost *host,
                              CeldOwnershipCache *kept, CeldOwnership *ownership, CeldRect *changed);
void       celd_ownership_cache_clear (CeldOwnershipCache *kept);    /* accepts a zeroed record */

/* ------------------------------------------------------------------ ownership-changes.c */

#define CELD_TILE_CLAIM 1 /* ink is to be claimed anew */
#define CELD_TILE_COVERAGE 2 /* owners may be other ones */

/* Marks tiles where owners may come out differently with new pens and solid labels, both bits. */
CeldStatus celd_ownership_mark_changes (const CeldOwnershipCache *kept, const CeldOwnershipInput *input, CeldRect new_labels,
                                const CeldContourPens *pens, const bool *solid, CeldTiles *tiles);

/* The tiles that a claim may touch; how many spans. */
#define CELD_MAX_CLAIM_SPANS 17
int celd_claim_tiles (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim,
                      CeldTileSpan span[CELD_MAX_CLAIM_SPANS]);

#endif
