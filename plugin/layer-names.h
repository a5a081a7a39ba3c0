/* What layers are called, and the colours that are offered for scribbles.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAYER_NAMES_H
#define CELD_LAYER_NAMES_H

#include <glib.h>

#include "pipeline.h"

/* The role of a layer of this name, in English, German or Czech, in any case, with or without accents, spaces at the
 * ends, and the ending of a file; CELD_N_LAYERS: it is none. */
CeldLayerRole celd_layer_role_of_name (const char *name);

/* The English name of a role: "Drawing". */
const char *celd_layer_role_name (CeldLayerRole role);

#define CELD_N_LABEL_COLOURS 24

/* Colours that are far from each other, from white and from black: 0xRRGGBB, with names. */
typedef struct { guint32 rgb; const char *name; } CeldLabelColour;
extern const CeldLabelColour celd_label_colours[CELD_N_LABEL_COLOURS];

#endif
