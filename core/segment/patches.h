/* What differs from the labels of the basins: pixels of windows that were solved one by one, and of closed gaps.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PATCHES_H
#define CELD_PATCHES_H

#include "base/base.h"

typedef struct { int32_t y, x, end; uint32_t label; } CeldPatch;  /* pixels x .. end - 1 of row y have this label */
typedef struct { CeldPatch *item; size_t n; } CeldPatches;        /* no pixel twice in one record */

CeldStatus celd_patch_add (CeldPatches *patches, CeldPatch patch);
void       celd_patches_clear (CeldPatches *patches);             /* accepts a zeroed record */

#endif
