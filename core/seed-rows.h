/* Seeds as runs by row: what an artist has painted, small enough to go through whole after every stroke.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEED_ROWS_H
#define CELD_SEED_ROWS_H

#include "private.h"

typedef struct { int x, end; uint32_t label; } CeldSeedRun;       /* pixels x .. end - 1; label > 0 */
typedef struct { CeldSeedRun *run; size_t n; } CeldSeedRow;       /* from left to right, apart or of other labels */
typedef struct { int width, height; CeldSeedRow *row; } CeldSeedRows;

CeldStatus celd_seed_rows_new (int width, int height, CeldSeedRows *seeds);      /* without a seed */
void       celd_seed_rows_clear (CeldSeedRows *seeds);                           /* accepts a zeroed record */

CeldStatus celd_seed_rows_read (const CeldLabels *labels, CeldSeedRows *seeds);  /* makes the record */
CeldStatus celd_seed_rows_copy (const CeldSeedRows *from, CeldSeedRows *seeds);     /* makes the record */
void       celd_seed_rows_write (const CeldSeedRows *seeds, CeldLabels *labels); /* of the same size; 0 elsewhere */

/* The pixels x .. end - 1 of row y, cut to the picture, take a label; label 0 takes them back. */
CeldStatus celd_seed_rows_paint (CeldSeedRows *seeds, int y, int x, int end, uint32_t label);

/* The label of a pixel, 0 without a seed. */
uint32_t celd_seed_rows_at (const CeldSeedRows *seeds, int x, int y);

#endif
