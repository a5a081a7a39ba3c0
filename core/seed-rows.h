/* Seeds as runs by row: what an artist has painted, small enough to go through whole after every stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEED_ROWS_H
#define CELD_SEED_ROWS_H

#include "private.h"

typedef struct { int x, end; uint32_t label; } CeldSeedRun;       /* pixels x .. end - 1; label > 0 */
typedef struct { CeldSeedRun *run; size_t n; } CeldSeedRow;       /* from left to right, apart or of other labels */
typedef struct { int width, height; CeldSeedRow *row; } CeldSeeds;

CeldStatus celd_seeds_new (int width, int height, CeldSeeds *seeds);      /* without a seed */
void       celd_seeds_clear (CeldSeeds *seeds);                           /* accepts a zeroed record */

CeldStatus celd_seeds_read (const CeldLabels *labels, CeldSeeds *seeds);  /* makes the record */
CeldStatus celd_seeds_copy (const CeldSeeds *from, CeldSeeds *seeds);     /* makes the record */
void       celd_seeds_write (const CeldSeeds *seeds, CeldLabels *labels); /* of the same size; 0 elsewhere */

/* The pixels x .. end - 1 of row y, cut to the picture, take a label; label 0 takes them back. */
CeldStatus celd_seeds_paint (CeldSeeds *seeds, int y, int x, int end, uint32_t label);

/* The label of a pixel, 0 without a seed. */
uint32_t celd_seeds_at (const CeldSeeds *seeds, int x, int y);

#endif
