/* celdepth - depth for hand-drawn cartoons from scribbles and arrows.
 *
 * The method is D. Sykora et al., "Adding Depth to Cartoons Using Sparse Depth (In)equalities",
 * Eurographics 2010 ("the paper").  C11 and libm, no global state, no printing, no threads of its own.
 *
 * What to read first:
 *   celdepth/session.h   the whole route, kept between edits
 *   celdepth/steps.h     the steps, in the order of the route
 *   celdepth/records.h   what travels between them
 *   celdepth/settings.h  what can be chosen
 *   celdepth/values.h    answers, progress, pictures
 *
 * Values that every function keeps:
 *   pixels    x to the right, y down; pixel (x,y) covers [x,x+1) x [y,y+1); sizes 1 .. CELD_MAX_SIDE
 *   luma      Y' of sRGB in [0,1]: encoded values, not linear light
 *   ink       line art after contrast normalisation: 0 = ink, 1 = paper, antialiased between
 *   labels    1 .. n, index + 1 into a CeldPalette; 0 = none
 *   levels    0 = farthest, larger = nearer
 *   depth     in the unit of the levels that it was made from, larger = nearer
 *   normals   x right, y UP, z to the viewer, unit length
 *
 * Ownership: views are borrowed, never kept beyond the call; records (palette, relations, ...) own their items, start
 * as all zero and end with their _clear function, which accepts a zeroed record.  A function that does not return
 * CELD_OK leaves its results as they were, unless it says otherwise.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_H
#define CELDEPTH_H

#include "celdepth/session.h"
#include "celdepth/steps.h"

#endif
