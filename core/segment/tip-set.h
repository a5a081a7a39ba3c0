/* Line ends that were found, by place: an end is found at several scales, and from both sides.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_TIP_SET_H
#define CELD_TIP_SET_H

#include "segment/bridges.h"

typedef struct
{
  CeldTip  *tip;                /* in the order in which they were added */
  size_t    n;
  uint32_t *before;             /* of each tip: the one before it in its cell */
  uint32_t *latest;             /* of each cell: the last tip added there */
  int       columns, rows;      /* of cells */
  size_t    tip_capacity, before_capacity;
} CeldTipSet;

/* Makes an empty set for a picture of that size in pixels; CELD_NO_MEMORY is the only failure. */
CeldStatus celd_tip_set_open (int width, int height, CeldTipSet *set);
void       celd_tip_set_close (CeldTipSet *set);    /* accepts a zeroed record */

/* Is there an end nearer than that distance?  The end on the other side of a narrow gap has the opposite direction, and
 * is not the same. */
bool celd_tip_set_has (const CeldTipSet *set, CeldTip end, double distance);

/* Adds an end; CELD_NO_MEMORY is the only failure. */
CeldStatus celd_tip_set_add (CeldTipSet *set, CeldTip end);

#endif
