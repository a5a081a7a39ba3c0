/* What expand.c (the whole picture) and expand-region.c (one region) share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_EXPAND_H
#define CELD_EXPAND_H

#include "private.h"

/* The picture while it is expanded; tight planes. */
typedef struct
{
  int       width, height;
  size_t    pixels;
  uint32_t *level;          /* 1 .. n from back to front; 0 for ink that nobody has taken yet */
  int32_t  *depth_in_ink;   /* squared distance to the nearest pixel that was not free at the beginning */
  uint32_t *rank;           /* level k stands for rank[k-1] */
  CeldRect *box;            /* of the pixels of level k at the beginning: box[k-1]; width 0 if there are none */
  size_t    n;
} CeldSheet;

/* Gives free ink to the foremost level that has not had its turn, k. */
CeldStatus celd_expand_region (CeldSheet *sheet, uint32_t k, const CeldRun *run);

#endif
