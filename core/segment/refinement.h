/* What the two files that settle borders share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SETTLE_H
#define CELD_SETTLE_H

#include "segment/canvas.h"

typedef struct
{
  const CeldCanvas *canvas;
  const CeldHost   *host;
  CeldLabels       *labels;
  int32_t          *depth;      /* of each pixel: its squared distance to paper */
  uint32_t         *changed;    /* pixels whose label was changed, any number of times */
  size_t            n_changed;
} CeldSettling;

/* settle-gaps.c: V between (x,y) and the pixel below, or to the right. */
int32_t celd_settling_cost (const CeldSettling *s, int x, int y, bool south);

/* Gives a pixel another label. */
CeldStatus celd_settling_set (CeldSettling *s, int x, int y, uint32_t label);

/* Borders across paper, solved on pixels in windows round them. */
CeldStatus celd_settle_gaps (CeldSettling *s);

#endif
