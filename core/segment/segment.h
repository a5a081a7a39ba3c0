/* A drawing segmented again and again, as strokes are added and changed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SEGMENT_H
#define CELD_SEGMENT_H

#include "image/image.h"

/* ------------------------------------------------------------------ segmenter.c: one drawing, kept between strokes */

typedef struct CeldSegmenter CeldSegmenter;

CeldSegmenter *celd_segmenter_new (void);                       /* NULL: no memory */
void           celd_segmenter_free (CeldSegmenter *segmenter);  /* accepts NULL */

/* The drawing: line art that the caller keeps as it is until the next call of this function.  `changed`: where it
 * differs from the last one of the same size; NULL: everywhere.  Of the settings ink_threshold and close_gaps matter:
 * these must be the same when solving. */
CeldStatus celd_segmenter_set_ink (CeldSegmenter *segmenter, const CeldPlane *ink, const CeldRect *changed,
                                   const CeldSettings *settings, const CeldHost *host);

/* Labels for these seeds.  `palette`: in, that of the seeds; out, with the regions that arrows made and the background
 * behind them.  `labels` is tight, the caller's, and as this function left it after the last call for this drawing
 * (anything the first time); *changed is where it differs from that.  Problems are appended.  The result does not
 * depend on earlier calls. */
CeldStatus celd_segmenter_solve (CeldSegmenter *segmenter, const CeldSeedRows *seeds, const CeldRelations *relations,
                                 const CeldSettings *settings, const CeldHost *host, CeldPalette *palette,
                                 CeldProblems *problems, CeldLabels *labels, CeldRect *changed);

/* How many of the last solve's relations, from the first on, it takes for its answer: those behind changed nothing. */
size_t celd_segmenter_effective_relations (const CeldSegmenter *segmenter);

/* Would this relation, behind those, change nothing either?  `settings` and `labels` are those of the last solve.
 * False also where that cannot be told without solving. */
bool celd_segmenter_is_redundant (const CeldSegmenter *segmenter, const CeldRelation *relation,
                                  const CeldSettings *settings,
                                  const CeldLabels *labels);

/* The gaps that the last solve closed; borrowed. */
const CeldClosures *celd_segmenter_closures (const CeldSegmenter *segmenter);

#endif
