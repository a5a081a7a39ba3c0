/* The plug-in for GIMP 3: what its files share.
 *
 *   main.c       the plug-in, and the table of its procedures
 *   layers.c     layers of an image, by their names
 *   settings.c   arguments made from the table of settings, and settings remembered with an image
 *   results.c    the group with the results
 *   dialog.c     the dialog of Pop-up
 *   popup.c      Pop-up
 *   setup.c      Set up layers
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_GIMP3_H
#define CELD_GIMP3_H

#include <libgimp/gimp.h>

#include "layer-names.h"
#include "pipeline.h"

/* ------------------------------------------------------------------ main.c */

typedef struct
{
  const char      *name, *menu_label, *blurb, *help;
  void           (*add_arguments) (GimpProcedure *procedure);
  GimpRunImageFunc run;
} CeldProcedure;

extern const CeldProcedure celd_popup_procedure, celd_setup_procedure;

/* ------------------------------------------------------------------ layers.c */

/* A layer of an image, and how many groups it lies in. */
typedef struct { GimpLayer *layer; int depth; } CeldListedLayer;

/* All layers from the top to the bottom, but the group of results and what is in it; CeldListedLayer. */
GArray *celd_layers_list (GimpImage *image);

/* The layers by their names, NULL where there is none.  Without a layer of the drawing's name the only layer that has
 * no other role is it. */
void celd_layers_find (GimpImage *image, GimpLayer *found[CELD_N_LAYERS]);

/* The lowest layer that has no role in `found`; NULL: there is none. */
GimpLayer *celd_layers_lowest (GimpImage *image, GimpLayer *const found[CELD_N_LAYERS]);

/* Opens buffers, with the places of the layers.  FALSE and *error if a layer does not belong to the image. */
gboolean celd_layers_open  (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS], CeldPipelineInput *input,
                            GError **error);
void     celd_layers_close (CeldPipelineInput *input);

/* ------------------------------------------------------------------ settings.c */

/* Names of arguments: of the layer with a role, and of the switch for a picture. */
extern const char *const celd_layer_arguments[CELD_N_LAYERS];
#define CELD_POPUP_PICTURES CELD_PICTURE_SUGGESTIONS /* those before it can be chosen */
extern const char *const celd_picture_arguments[CELD_POPUP_PICTURES];

/* The arguments of Pop-up. */
void celd_settings_add_arguments (GimpProcedure *procedure);

/* What was chosen: the settings, and the pictures as bits. */
CeldSettings celd_settings_chosen (GimpProcedureConfig *config);
guint        celd_pictures_chosen (GimpProcedureConfig *config);
void         celd_layers_chosen   (GimpProcedureConfig *config, GimpLayer *layer[CELD_N_LAYERS]); /* borrowed */

/* Keep the arguments with the image, and set those that were kept.  Layers that are not found by their names are kept,
 * too; layers are always set. */
void celd_settings_remember (GimpImage *image, GimpProcedureConfig *config);
void celd_settings_recall   (GimpImage *image, GimpProcedureConfig *config);

/* ------------------------------------------------------------------ results.c */

gboolean celd_results_is_group (GimpItem *item);

/* Writes the wanted pictures into the layers of the group, which is made if there is none.
 * Layers of other pictures are removed; those whose pixels are locked stay as they are.  The caller makes it one step of
 * undo.  NULL on failure. */
GimpGroupLayer *celd_results_write (GimpImage *image, CeldPipeline *pipeline, guint wanted, GError **error);

/* ------------------------------------------------------------------ dialog.c */

/* FALSE: cancelled. */
gboolean celd_popup_dialog (GimpProcedure *procedure, GimpProcedureConfig *config, GimpImage *image);

#endif
