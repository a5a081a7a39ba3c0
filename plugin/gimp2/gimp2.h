/* The plug-in for GIMP 2.10: Pop-up alone.  What its files share.
 *
 *   main.c       the procedure: reads the layers, makes the pictures
 *   choices.c    what the artist or a script chose, and how it is remembered with an image
 *   layers.c     layers of an image, by their names
 *   results.c    the group with the results
 *   dialog.c     the dialog
 *
 * Layers, images and groups are identities of GIMP; -1: none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_GIMP2_H
#define CELD_GIMP2_H

#include <glib/gi18n.h>
#include <libgimp/gimp.h>

#include "front-end.h"
#include "layer-names.h"
#include "pipeline.h"

/* ------------------------------------------------------------------ choices.c */

typedef struct
{
  guint        wanted;    /* pictures, as bits */
  CeldSettings settings;
  char        *relations; /* owned; never NULL */
  gint32       layer[CELD_N_LAYERS];
} CeldChoices;

/* The defaults, with the layers of the image by their names. */
CeldChoices celd_choices (gint32 image);
void        celd_choices_clear (CeldChoices *choices);

/* Sets what the texts say: names of pictures, settings such as "bulge=0.5 light-azimuth=90", relations.  Empty texts
 * change nothing. */
gboolean celd_choices_read (const char *pictures, const char *settings, const char *relations, CeldChoices *choices,
                            GError **error);

/* Keep the choices with an image, as GIMP 3's plug-in does, and set those that were kept. */
void celd_choices_remember (gint32 image, const CeldChoices *choices);
void celd_choices_recall   (gint32 image, CeldChoices *choices);

/* ------------------------------------------------------------------ layers.c */

/* All layers, those in groups too, from the top to the bottom, without the group of results; an array of gint32. */
GArray *celd_layers_list (gint32 image);

/* The layers by their names, -1 where there is none: see celd_layer_roles_find. */
void celd_layers_find (gint32 image, gint32 found[CELD_N_LAYERS]);

/* Opens their buffers, with the places of the layers, as they are seen. */
void celd_layers_open  (gint32 image, const gint32 layer[CELD_N_LAYERS], CeldPipelineInput *input);
void celd_layers_close (CeldPipelineInput *input);

/* ------------------------------------------------------------------ results.c */

gboolean celd_results_is_group (gint32 item);

/* Whether a layer was made by the plug-in, here or in GIMP 3, as a result, or is a copy of one. */
gboolean celd_results_is_one (gint32 item);

/* Writes the wanted pictures into the layers of the group, which is made if there is none, in one step of undo.
 * Layers of other pictures are removed; those whose pixels are locked stay as they are.  -1 on failure. */
gint32 celd_results_write (gint32 image, CeldPipeline *pipeline, const CeldChoices *choices, GError **error);

/* ------------------------------------------------------------------ dialog.c */

/* FALSE: cancelled. */
gboolean celd_dialog_run (gint32 image, CeldChoices *choices);

#endif
