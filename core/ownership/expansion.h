/* Depth expansion, and contour ownership of pictures that have levels but no labels.
 *
 *   expansion.c            expands all levels of a picture
 *   expansion-region.c     expands one level
 *   ownership-of-levels.c  ownership from levels
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_EXPAND_H
#define CELD_EXPAND_H

#include "base/base.h"

/* A picture during expansion; planes without padding. */
typedef struct
{
  int       width, height;
  size_t    pixels;
  uint32_t *level;          /* 1 .. n from back to front; 0 for ink that is still free */
  int32_t  *distance_in_ink;   /* squared distance to the nearest pixel that was not free at the beginning */
  uint32_t *rank;           /* the rank that level k stands for: rank[k-1] */
  CeldRect *box;            /* bounding box of level k at the beginning: box[k-1]; width 0 if it has no pixels */
  size_t    n;
} CeldExpansionState;

/* The distinct ranks of a picture in rising order; to be freed with celd_free. */
CeldStatus celd_list_ranks (const CeldLabels *ranks, uint32_t **list, size_t *n);
int        celd_compare_ranks (const void *a, const void *b);

/* ownership-of-levels.c: the ownership of a picture of levels, with labels 1 .. n for its levels, or for the regions
 * of its levels, the farthest first.  Label k has order[k - 1] as its place in depth, from 0, the original level
 * level[k - 1], and region[k - 1] (0 without regions). */
typedef struct
{
  CeldOwnership own;
  uint32_t     *order, *region;
  float        *level;
  size_t        n;
} CeldLevelOwnership;

/* See celd_expand_levels.  The record has to be cleared also after a failure. */
CeldStatus celd_level_ownership_new (const CeldPlane *ink, const CeldPlane *levels, const CeldLabels *regions,
                                const CeldLabels *corrections, CeldExpansion method, const CeldHost *host,
                                CeldLevelOwnership *made);
void       celd_level_ownership_clear (CeldLevelOwnership *made);
/* In layers/layers.c: cuts the art into layers by that. */
CeldStatus celd_level_layers_cut (const CeldLevelOwnership *made, const CeldPlane *ink, const CeldColours *art,
                                  CeldStore store,
                                bool complete, const CeldHost *host, CeldLayers **layers);

/* Expands level k into free ink; all nearer levels have to be expanded already. */
CeldStatus celd_expand_region (CeldExpansionState *state, uint32_t k, const CeldHost *host);

#endif
