/* What expand.c (the whole picture), expansion-region.c (one region) and the steps from pictures of levels share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_EXPAND_H
#define CELD_EXPAND_H

#include "base/base.h"

/* The picture while it is expanded; tight planes. */
typedef struct
{
  int       width, height;
  size_t    pixels;
  uint32_t *level;          /* 1 .. n from back to front; 0 for ink that nobody has taken yet */
  int32_t  *distance_in_ink;   /* squared distance to the nearest pixel that was not free at the beginning */
  uint32_t *rank;           /* level k stands for rank[k-1] */
  CeldRect *box;            /* of the pixels of level k at the beginning: box[k-1]; width 0 if there are none */
  size_t    n;
} CeldExpansionState;

/* The distinct ranks of a picture in rising order; end with celd_free. */
CeldStatus celd_list_ranks (const CeldLabels *ranks, uint32_t **list, size_t *n);
int        celd_compare_ranks (const void *a, const void *b);

/* own-levels.c: whose each pixel is, by labels 1 .. n that stand for levels, or for regions of levels, from the
 * farthest on.  Of label k: its place in depth order[k - 1], from 0; its level as it came, and its region (0 without
 * regions). */
typedef struct
{
  CeldOwnership own;
  uint32_t     *order, *region;
  float        *level;
  size_t        n;
} CeldLevelOwnership;

/* See celd_expand_levels.  To be cleared whatever it returns. */
CeldStatus celd_level_ownership_new (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                                const CeldLabels *corrections, CeldExpansion method, const CeldHost *host,
                                CeldLevelOwnership *made);
void       celd_level_ownership_clear (CeldLevelOwnership *made);
/* layers.c: the art cut by that. */
CeldStatus celd_level_layers_cut (const CeldLevelOwnership *made, const CeldPlane *ink, const CeldColours *art, CeldStore store,
                                bool complete, const CeldHost *host, CeldLayers **layers);

/* Gives free ink to the foremost level that has not had its turn, k. */
CeldStatus celd_expand_region (CeldExpansionState *state, uint32_t k, const CeldHost *host);

#endif
