/* A labelling: the labels of the basins, and patches that lie over them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LABELLING_H
#define CELD_LABELLING_H

#include "segment/basins.h"

typedef struct { int32_t y, x, end; uint32_t label; } CeldPatch;  /* pixels x .. end - 1 of row y have this label */
typedef struct { CeldPatch *item; size_t n, item_capacity; } CeldPatches;        /* no pixel twice in one record */

CeldStatus celd_patch_add (CeldPatches *patches, CeldPatch patch);
void       celd_patches_clear (CeldPatches *patches);             /* accepts a zeroed record */

typedef struct
{
  uint32_t   *label;    /* of each basin; 0: unknown, to be painted */
  CeldPatches patches;  /* in reading order */
  CeldRect    changed;  /* bounding box of all changes not reported so far */
} CeldLabelling;

void celd_labelling_clear (CeldLabelling *labelling);               /* accepts a zeroed record */

/* Prepares for the basins of a new drawing: nothing counts as painted.  `changed` is kept. */
CeldStatus celd_labelling_reset (CeldLabelling *labelling, const CeldBasins *basins);

/* Call it after a failure between begin and end: the picture's content is unknown then, and all of it counts as
 * changed. */
void celd_labelling_invalidate (CeldLabelling *labelling, const CeldBasins *basins);

/* A new labelling is painted over the old one, in `labels`, in three steps.  Begin: paints the basins and removes old
 * patches; takes ownership of `label`, and moves the old labelling to *old, which the caller clears.  Add: paints
 * patches, one over the other.  End: sorts the patches and adds to `changed` what differs from *old.  After a failure
 * call celd_labelling_invalidate. */
void       celd_labelling_begin (CeldLabelling *labelling, const CeldBasins *basins, uint32_t *label,
                                 CeldLabels *labels,
                                 CeldLabelling *old);
CeldStatus celd_labelling_add   (CeldLabelling *labelling, const CeldPatches *patches, CeldLabels *labels);
CeldStatus celd_labelling_end   (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabelling *old,
                                 const CeldLabels *labels);

/* Copies a whole picture over the old one, and adds what differs to `changed`; no basin counts as painted
 * afterwards. */
CeldStatus celd_labelling_replace (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *from,
                                   CeldLabels *labels);

/* Fills in the area of each label, and its pixel farthest from ink, as well as that is known from maxima; -1,-1 for
 * labels without a pixel. */
CeldStatus celd_labelling_measure (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels,
                                   CeldPalette *palette);

#endif
