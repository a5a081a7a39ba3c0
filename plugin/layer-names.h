/* What layers are called, and the colours that are offered for scribbles.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_LAYER_NAMES_H
#define CELD_LAYER_NAMES_H

#include <glib.h>

typedef enum
{
  CELD_LAYER_DRAWING, CELD_LAYER_SCRIBBLES, CELD_LAYER_ARROWS, CELD_LAYER_CONTOURS, CELD_LAYER_CORRECTIONS,
  CELD_LAYER_HIDDEN, CELD_N_LAYERS
} CeldLayerRole;

/* The role of a layer of this name, in English, German or Czech, in any case, with or without accents, spaces at the
 * ends, and the ending of a file; CELD_N_LAYERS: it is none. */
CeldLayerRole celd_layer_role_of_name (const char *name);

/* A name in lower case without accents, spaces at the ends, and the ending of a file; free with g_free. */
char *celd_layer_name_fold (const char *name);

/* The English name of a role: "Drawing". */
const char *celd_layer_role_name (CeldLayerRole role);

/* All names of a role in lower case and without accents, ended by NULL. */
const char *const *celd_layer_role_names (CeldLayerRole role);

/* A layer of an image: what it is called, and whether only its name can make it the drawing, as that of a group or of a
 * result. */
typedef struct { const char *name; gboolean needs_name; } CeldNamedLayer;

/* The layers by their names, as indices, -1 where there is none; the first one of a name counts.  Without a layer of
 * the drawing's name the only layer that has no other role, and needs no name, is the drawing. */
void celd_layer_roles_find (const CeldNamedLayer *layer, int n, int found[CELD_N_LAYERS]);

/* The last layer that has no role in `found`, and needs no name; -1: there is none.  *others, if not NULL, is how many
 * there are. */
int celd_layer_roles_last (const CeldNamedLayer *layer, int n, const int found[CELD_N_LAYERS], int *others);

#define CELD_N_LABEL_COLOURS 24

/* Colours that are far from each other, from white and from black: 0xRRGGBB, with names. */
typedef struct { guint32 rgb; const char *name; } CeldLabelColour;
extern const CeldLabelColour celd_label_colours[CELD_N_LABEL_COLOURS];

#endif
