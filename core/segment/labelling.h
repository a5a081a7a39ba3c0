/* What a segmenter has painted: the labels of the basins, and patches over them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LABELLING_H
#define CELD_LABELLING_H

#include "segment/basins.h"

typedef struct { int32_t y, x, end; uint32_t label; } CeldPatch;  /* pixels x .. end - 1 of row y have this label */
typedef struct { CeldPatch *item; size_t n; } CeldPatches;        /* no pixel twice in one record */

CeldStatus celd_patch_add (CeldPatches *patches, CeldPatch patch);
void       celd_patches_clear (CeldPatches *patches);             /* accepts a zeroed record */

typedef struct
{
  uint32_t   *label;    /* of each basin; 0: not painted yet */
  CeldPatches patches;  /* in reading order */
  CeldRect    changed;  /* where the picture differs from the last one that was seen */
} CeldLabelling;

void celd_labelling_clear (CeldLabelling *labelling);               /* accepts a zeroed record */

/* Nothing is painted any more, for the basins of a new drawing; `changed` stays. */
CeldStatus celd_labelling_reset (CeldLabelling *labelling, const CeldBasins *basins);

/* After a failure in the middle of a picture: nobody knows what is painted where, and everything counts as changed. */
void celd_labelling_invalidate (CeldLabelling *labelling, const CeldBasins *basins);

/* A new picture in three steps, over the old one in `labels`.  Begin: the basins take their labels, old patches go;
 * `label` is the painting's from now on, and what was painted before is handed over in *old.  Add: patches, one over
 * the other.  End: tidies the patches and notes what differs from *old.  After a failure the picture is lost. */
void       celd_labelling_begin (CeldLabelling *labelling, const CeldBasins *basins, uint32_t *label,
                                 CeldLabels *labels,
                                 CeldLabelling *old);
CeldStatus celd_labelling_add   (CeldLabelling *labelling, const CeldPatches *patches, CeldLabels *labels);
CeldStatus celd_labelling_end   (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabelling *old,
                                 const CeldLabels *labels);

/* Copies a whole picture over the old one, and notes what differs; no basin counts as painted then. */
CeldStatus celd_labelling_replace (CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *from,
                                   CeldLabels *labels);

/* Area of each label, and a pixel of it as far from ink as can be; -1,-1 for labels without a pixel. */
CeldStatus celd_labelling_measure (const CeldLabelling *labelling, const CeldBasins *basins, const CeldLabels *labels,
                                   CeldPalette *palette);

#endif
