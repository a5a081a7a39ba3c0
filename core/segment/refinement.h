/* What the two files that refine boundaries share: the energy of a labelling at single pixels.
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
  int32_t               *to_paper; /* of each pixel: squared distance to paper */
  uint32_t              *changed;  /* indices of changed pixels, in any order and number */
  size_t                 n_changed;
  size_t                 changed_capacity;
} CeldBoundaryRefinement;

/* Sets the label of a pixel and notes the change. */
CeldStatus celd_refinement_set_label (CeldBoundaryRefinement *s, int x, int y, uint32_t label);

/* Solves boundaries across paper on pixels, in windows round them. */
CeldStatus celd_refine_gaps (CeldBoundaryRefinement *s);

#endif
