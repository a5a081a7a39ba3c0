/* What the two files that settle borders share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_REFINEMENT_H
#define CELD_REFINEMENT_H

#include "segment/task.h"

typedef struct
{
  const CeldSegmentTask *task;
  const CeldHost        *host;
  CeldLabels            *labels;
  int32_t               *to_paper; /* of each pixel: its squared distance to paper */
  uint32_t              *changed;  /* pixels whose label was changed, any number of times */
  size_t                 n_changed;
} CeldBoundaryRefinement;

/* settle-gaps.c: V between (x,y) and the pixel below, or to the right. */
int32_t celd_refinement_cost (const CeldBoundaryRefinement *s, int x, int y, bool south);

/* Gives a pixel another label. */
CeldStatus celd_refinement_set_label (CeldBoundaryRefinement *s, int x, int y, uint32_t label);

/* Borders across paper, solved on pixels in windows round them. */
CeldStatus celd_refine_gaps (CeldBoundaryRefinement *s);

#endif
