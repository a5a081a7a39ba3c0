/* Contour ownership: which label each pixel belongs to, ink included.
 *
 *   ownership.c          computes it, with the coverage of antialiased pixels
 *   ownership-cache.c    updates it after an edit
 *   ownership-changes.c  finds the tiles that an edit affects
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OWNERSHIP_H
#define CELD_OWNERSHIP_H

#include "base/tiles.h"
#include "ownership/contour-pens.h"

/* ------------------------------------------------------------------ ownership.c */

/* Completes a record whose `owner` has the label that covers most of each pixel: finds the second label of
 * antialiased pixels and the coverage of the first, and makes the nearer label the owner. */
void celd_ownership_coverage (const CeldPlane *ink, const uint32_t *level, CeldOwnership *ownership);

/* Does so within a rectangle; `larger` has the label that covers most of each pixel.  Returns where the record
 * changes. */
CeldRect celd_ownership_coverage_update (const CeldPlane *ink, const CeldLabels *larger, const uint32_t *level,
                                         CeldRect rect,
                           CeldOwnership *ownership);

/* Updates a rectangle in which nothing but the levels has changed.  Returns where the record changes. */
CeldRect celd_ownership_reorder (const CeldLabels *larger, const uint32_t *level, CeldRect rect,
                                 CeldOwnership *ownership);

/* ------------------------------------------------------------------ ownership-cache.c: CELD_EXPANSION_OUTLINES */

/* The input and intermediate results of the last update.  Members that depend on the drawing alone are computed
 * once. */
typedef struct
{
  CeldContourEdges edges;
  CeldTiles        antialiased;        /* not 0 for tiles with antialiased pixels */
  CeldContourPens  pens;               /* includes level and n */
  uint32_t        *level;       /* owned; NULL: the cache is empty */
  bool            *solid;
  CeldLabels       owner;       /* label that covers most of each pixel, after corrections */
  CeldPlane        excess;        /* see CeldClaimMap */
  CeldReassigned   reassigned;            /* pixels of `owner` that corrections changed */
} CeldOwnershipCache;

/* What ownership is computed from. */
typedef struct
{
  const CeldPlane  *ink;
  const CeldLabels *labels, *corrections; /* corrections NULL: none */
  const uint32_t   *level;
  size_t            n;
} CeldOwnershipInput;

/* Compute the record from scratch, or update it after a change of levels, corrections, and of labels within
 * `new_labels`; the ink has to be the same.  *changed is the part of the record that changes.  After a failure the
 * record is unchanged and the cache is empty. */
CeldStatus celd_ownership_cache_make (const CeldOwnershipInput *input, const CeldHost *host, CeldOwnershipCache *kept,
                             CeldOwnership *ownership);
CeldStatus celd_ownership_cache_update (const CeldOwnershipInput *input, CeldRect new_labels, const CeldHost *host,
                              CeldOwnershipCache *kept, CeldOwnership *ownership, CeldRect *changed);
void       celd_ownership_cache_clear (CeldOwnershipCache *kept);    /* accepts a zeroed record */

/* ------------------------------------------------------------------ ownership-changes.c */

#define CELD_TILE_CLAIM    1 /* claims have to be repeated */
#define CELD_TILE_COVERAGE 2 /* owners may have changed */

/* Sets both bits of the tiles in which owners may change with the new pens and solid labels. */
CeldStatus celd_ownership_mark_changes (const CeldOwnershipCache *kept, const CeldOwnershipInput *input,
                                        CeldRect new_labels,
                                const CeldContourPens *pens, const bool *solid, CeldTiles *tiles);

/* Writes the tiles that a claim may touch, as spans; returns their number. */
#define CELD_MAX_CLAIM_SPANS 17
int celd_claim_tiles (const CeldPlane *ink, const CeldTiles *tiles, const CeldClaim *claim,
                      CeldTileSpan span[CELD_MAX_CLAIM_SPANS]);

#endif
