/* What it costs to let two neighbouring pixels have different labels: V_pq of LazyBrush [SDC09b] (section 3.2).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_COSTS_H
#define CELD_COSTS_H

#include "base/base.h"

#define CELD_COST_UNIT 16       /* of an edge inside ink: energies are integers */
#define CELD_INK_STEPS 1024     /* of the table by ink */
#define CELD_DEEPEST   1024     /* squared pixels: from here on ink costs no less */

typedef struct
{
  int     width, height;
  double  white;                         /* K: what an edge of paper costs more than one of ink */
  int32_t by_ink[CELD_INK_STEPS + 1];    /* from ink to paper */
  int32_t deep[CELD_DEEPEST + 1];        /* taken off by the squared distance to paper */
  int32_t margin;                        /* edges of paper along the frame stand for so many */
} CeldCosts;

/* `threshold` is settings->ink_threshold. */
void celd_costs_new (int width, int height, float threshold, CeldCosts *costs);

/* V between two neighbouring pixels: their ink, their squared distances to paper (0 or less for paper), and whether
 * both are outermost pixels on one side of the picture. */
int32_t celd_cost (const CeldCosts *costs, float ink, float other_ink, int32_t depth, int32_t other_depth,
                   bool along_frame);

#endif
