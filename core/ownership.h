/* The steps to whose each pixel is: see ownership.c.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_OWNERSHIP_H
#define CELD_OWNERSHIP_H

#include "private.h"

/* ownership-edges.c: in: in `owner` the label whose the larger part of each pixel is.  Out: the record, with the two
 * labels of each pixel at the edge of ink and how much of it is whose. */
void celd_share_edges (const CeldPlane *ink, const uint32_t *level, CeldOwnership *ownership);

#endif
