/* The plug-in for GIMP 3: what its files share.
 *
 *   main.c       the plug-in, and the table of its procedures
 *   layers.c     layers of an image, by their names
 *   settings.c   arguments made from the table of settings, and settings remembered with an image
 *   results.c    the group with the results
 *   dialog.c     the dialog of all of them
 *   run.c        what the procedures with a dialog do
 *   popup.c      Pop-up
 *   split.c      Split into layers
 *   suggest.c    Suggest order
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

typedef struct CeldProcedure CeldProcedure;
struct CeldProcedure
{
  const char      *name, *menu_label, *blurb, *help;
  void           (*add_arguments) (GimpProcedure *procedure);
  GimpRunImageFunc run;            /* with the CeldProcedure as its data */

  /* for celd_run: the title of the dialog; what takes time; and what changes the image, in one step of undo, NULL on
   * failure */
  const char      *title;
  gboolean       (*make)  (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config,
                           CeldPipelineProgress progress, gpointer data, GError **error);
  GimpLayer     *(*write) (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, GError **error);
};

extern const CeldProcedure celd_popup_procedure, celd_setup_procedure, celd_split_procedure, celd_suggest_procedure;

/* ------------------------------------------------------------------ run.c */

/* Shows the dialog unless a script runs it, reads the layers, makes and writes.  The second return value is the layer
 * that was written. */
GimpValueArray *celd_run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
                          GimpProcedureConfig *config, gpointer run_data);

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

/* Whether the image has 8 bits a channel. */
gboolean celd_image_has_few_bits (GimpImage *image);

/* Opens buffers, with the places of the layers.  FALSE and *error if a layer does not belong to the image. */
gboolean celd_layers_open  (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS], CeldPipelineInput *input,
                            GError **error);
void     celd_layers_close (CeldPipelineInput *input);

/* ------------------------------------------------------------------ settings.c */

/* Names of arguments: of the layer with a role, and of the switch for a picture. */
extern const char *const celd_layer_arguments[CELD_N_LAYERS];
#define CELD_POPUP_PICTURES CELD_PICTURE_SUGGESTIONS /* those before it can be chosen */
extern const char *const celd_picture_arguments[CELD_POPUP_PICTURES];

/* The arguments of a procedure, with layers and relations. */
enum { CELD_FOR_POPUP = 1, CELD_FOR_SPLIT = 2, CELD_FOR_SUGGEST = 4 };
void     celd_settings_add_arguments (GimpProcedure *procedure, guint whose);
gboolean celd_has_argument (GimpProcedureConfig *config, const char *name);

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

/* Marks an item, so that it is found again in its file, or says whether it is marked, with this text if that is not
 * NULL. */
#define CELD_PICTURE_MARK "celdepth-picture" /* with the name of a picture */
void     celd_item_mark      (gpointer item, const char *name, const char *text);
gboolean celd_item_is_marked (GimpItem *item, const char *name, const char *text);

/* Writes the wanted pictures into the layers of the group, which is made if there is none.
 * Layers of other pictures are removed; those whose pixels are locked stay as they are.  NULL on failure. */
GimpGroupLayer *celd_results_write (GimpImage *image, CeldPipeline *pipeline, guint wanted, GError **error);

/* ------------------------------------------------------------------ dialog.c */

/* Shows what the procedure has arguments for.  FALSE: cancelled. */
gboolean celd_dialog_run (GimpProcedure *procedure, GimpProcedureConfig *config, GimpImage *image, const char *title);

#endif
