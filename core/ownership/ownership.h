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
void celd_share_edges (const CeldPlane *ink, const uint32_t *level, CeldOwnership *ownership);

/* The same for the pixels of a rectangle, with the larger parts elsewhere.  Returns where the record changes. */
CeldRect celd_share_again (const CeldPlane *ink, const CeldLabels *larger, const uint32_t *level, CeldRect rect,
                           CeldOwnership *ownership);

/* For a rectangle where nothing but the levels is new. */
CeldRect celd_sort_again (const CeldLabels *larger, const uint32_t *level, CeldRect rect, CeldOwnership *ownership);

/* ------------------------------------------------------------------ ownership-cache.c: CELD_EXPANSION_OUTLINES */

/* What owners were made from.  What depends on the drawing alone is made once. */
typedef struct
{
  CeldInkEdges edges;
  CeldTiles    grey;            /* not 0 where the ink has shares of pixels */
  CeldPens     pens;            /* with level and n */
  uint32_t    *level;           /* owned; NULL: nothing is kept */
  bool        *solid;
  CeldLabels   owner;           /* of the larger part of each pixel */
  CeldPlane    over;            /* of it, see CeldClaims */
  CeldGiven    given;           /* what corrections have changed in owner */
} CeldOwnersKept;

/* What owners are made from. */
typedef struct
{
  const CeldPlane  *ink;
  const CeldLabels *labels, *corrections; /* corrections NULL: none */
  const uint32_t   *level;
  size_t            n;
} CeldOwnersInput;

/* Fills in the record, from the beginning or from where it was; the ink is the same, labels differ within a rectangle
 * only.  *changed is where the record does.  After a failure the record is as it was, and nothing is kept. */
CeldStatus celd_owners_make (const CeldOwnersInput *input, const CeldHost *host, CeldOwnersKept *kept,
                             CeldOwnership *ownership);
CeldStatus celd_owners_renew (const CeldOwnersInput *input, CeldRect new_labels, const CeldHost *host,
                              CeldOwnersKept *kept, CeldOwnership *ownership, CeldRect *changed);
void       celd_owners_clear (CeldOwnersKept *kept);    /* accepts a zeroed record */

/* ------------------------------------------------------------------ ownership-changes.c */

#define CELD_TILE_CLAIM 1 /* ink is to be claimed anew */
#define CELD_TILE_SHARE 2 /* owners may be other ones */

/* Marks tiles where owners may come out differently with new pens and solid labels, both bits. */
CeldStatus celd_owners_compare (const CeldOwnersKept *kept, const CeldOwnersInput *input, CeldRect new_labels,
                                const CeldPens *pens, const bool *solid, CeldTiles *tiles);

/* The tiles that a claim may touch; how many spans. */
#define CELD_SPANS 17
int celd_claim_tiles (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim,
                      CeldTileSpan span[CELD_SPANS]);

#endif
