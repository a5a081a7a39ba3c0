/* celdepth - depth for hand-drawn cartoons from scribbles and arrows.
 *
 * The method is D. Sykora et al., "Adding Depth to Cartoons Using Sparse Depth (In)equalities",
 * Eurographics 2010 ("the paper").  C11 and libm, no global state, no printing, no threads of its own.
 *
 * In tiers; for most programs the first is enough:
 *   celdepth/session.h   a session: from a drawing and its layers to every result, kept between edits
 *   celdepth/steps.h     the single steps for one drawing, in their order
 *   celdepth/motion.h    drawings that move, and several together
 *   celdepth/settings.h  all settings
 *   celdepth/records.h   the records that steps exchange: palettes, relations, orders, reports, layers
 *   celdepth/values.h    status, progress, threads, pictures
 *
 * Conventions of all functions:
 *   pixels    x to the right, y down; pixel (x,y) covers [x,x+1) x [y,y+1); sizes 1 .. CELD_MAX_SIDE
 *   luma      Y' of sRGB in [0,1]: encoded values, not linear light
 *   ink       line art after contrast normalisation: 0 = ink, 1 = paper, antialiased between
 *   labels    1 .. n, index + 1 into a CeldPalette; 0 = none
 *   levels    0 = farthest, larger = nearer
 *   depth     in the unit of the levels that it was made from, larger = nearer
 *   normals   x right, y UP, z to the viewer, unit length
 *
 * Ownership: pictures are views that the caller owns; a function never keeps one beyond the call, unless it says so.
 * Pictures that a function takes together must have the same size, else it returns CELD_BAD_SIZE.  Records (palette,
 * relations, ...) own their items: the caller starts with a zeroed record and frees it with its _clear function, which
 * accepts a zeroed record, too.
 *
 * Errors: a function that does not return CELD_OK leaves its results as they were, unless it says otherwise.  Settings
 * outside their range give CELD_BAD_VALUE.  Any function may return CELD_NO_MEMORY, and one with a host CELD_CANCELLED.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELDEPTH_H
#define CELDEPTH_H

#include "celdepth/motion.h"
#include "celdepth/session.h"
#include "celdepth/steps.h"

#endif
