/* What depth enhancement (enhance.c) shares with the stack of shadows (shadows.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_SHADOWS_H
#define CELD_SHADOWS_H

#include "private.h"

/* Soft shadows that nearer levels cast on farther ones: of each pixel, the negative share of light that they take.
 * `deviation` in pixels, > 0. */
CeldStatus celd_shadows (const CeldPlane *levels, double deviation, const CeldSettings *settings, const CeldRun *run,
                         CeldPlane *change);

#endif
