/* Names of parts in models.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_PART_NAMES_H
#define CELD_PART_NAMES_H

#include "celdepth.h"

/* "e0a030-3" for label 3 of this colour, "background" without one; to be freed with g_free. */
char *celd_part_name (const CeldPalette *palette, uint32_t label);

#endif
