/* The plug-in for GIMP 3: what its files share.
 *
 *   main.c       the plug-in, and the table of its procedures
 *   layers.c     layers of an image, by their names
 *   settings.c   arguments made from the table of settings, and settings remembered with an image
 *   presets.c    presets of settings
 *   filters.c    presets of filters
 *   paths.c      paths that are arrows
 *   files.c      files that are written
 *   results.c    the group with the results
 *   dialog.c     the dialog of all of them
 *   run.c        what the procedures with a dialog do
 *   popup.c      Pop-up
 *   split.c      Split into layers
 *   suggest.c    Suggest order
 *   stereo.c     Stereo
 *   group.c      Live group
 *   effect.c     its effect
 *   export.c     Export depth
 *   mesh.c       Relief mesh
 *   setup.c      Set up layers
 *   live*.c      Live; live.h lists them
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CELD_GIMP3_H
#define CELD_GIMP3_H

#include <glib/gi18n.h>
#include <libgimp/gimp.h>

#include "front-end.h"
#include "layer-names.h"
#include "pipeline.h"

/* ------------------------------------------------------------------ main.c */

typedef struct CeldProcedure CeldProcedure;
struct CeldProcedure
{
  const char      *name, *menu_label, *blurb, *help; /* translated when they are shown, as is the title */
  void           (*add_arguments) (GimpProcedure *procedure);
  GimpRunImageFunc run;            /* with the CeldProcedure as its data */

  /* for celd_run: the title of the dialog; what the name of the argument "file" ends in, after the image's, NULL if
   * there is none; whether the result goes elsewhere than into the image, NULL: it does if nothing is written;
   * checks of its own before anything takes time, which may do all of it, NULL: none; what takes time; and what changes
   * the image, in one step of undo, or makes another one, NULL on failure */
  const char      *title, *file_ending;
  gboolean       (*elsewhere) (GimpImage *image, GimpProcedureConfig *config);
  gboolean       (*prepare) (GimpImage *image, GimpProcedureConfig *config, gboolean *done, GError **error);
  gboolean       (*make)  (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config,
                           CeldPipelineProgress progress, gpointer data, GError **error);
  GimpLayer     *(*write) (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, GError **error);
};

extern const CeldProcedure celd_popup_procedure, celd_setup_procedure, celd_split_procedure, celd_suggest_procedure,
  celd_stereo_procedure, celd_export_procedure, celd_mesh_procedure, celd_live_procedure,
  celd_group_procedure;

/* ------------------------------------------------------------------ paths.c */

/* The arrows of all paths named Arrows: as SVG path data, to be freed; how many, and how many strokes are none. */
typedef struct { char *data; int n, left_out; } CeldPathArrows;
CeldPathArrows celd_paths_read (GimpImage *image);

/* The same, with places as from the pixel x, y. */
CeldPathArrows celd_paths_read_from (GimpImage *image, int x, int y);

/* What to say of n strokes that are no arrows; to be freed.  And says it, if there are any. */
char *celd_paths_left_out_text (int n);
void  celd_paths_say_left_out  (const CeldPathArrows *paths);

/* ------------------------------------------------------------------ run.c */

/* Shows the dialog unless a script runs it, reads the layers, makes and writes.  The second return value, if there is
 * one, is the layer that was written. */
GimpValueArray *celd_run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
                          GimpProcedureConfig *config, gpointer run_data);

/* Whether no selection floats, whether also this kind of image can be used, and whether there are the layers and arrows
 * that are needed; *error is a sentence for the artist. */
gboolean celd_floating_check (GimpImage *image, GError **error);
gboolean celd_image_check    (GimpImage *image, GError **error);
gboolean celd_layers_check   (GimpLayer *const layer[CELD_N_LAYERS], const CeldPathArrows *paths,
                              GimpProcedureConfig *config, GError **error);

/* ------------------------------------------------------------------ layers.c */

/* The name of an item, to be freed; "": the item is gone, as it may be at any moment while Live looks at an image. */
char *celd_item_name (gpointer item);

/* A layer of an image, and how many groups it lies in. */
typedef struct { GimpLayer *layer; int depth; } CeldListedLayer;

/* All layers from the top to the bottom, but the group of results and what is in it; CeldListedLayer. */
GArray *celd_layers_list (GimpImage *image);

/* The layers by their names, NULL where there is none.  Without a layer of the drawing's name the only layer that has
 * no other role is it. */
void celd_layers_find (GimpImage *image, GimpLayer *found[CELD_N_LAYERS]);

/* The same, of the layers in a group. */
void celd_layers_find_inside (GimpLayer *group, GimpLayer *found[CELD_N_LAYERS]);

/* The lowest layer that has no role in `found`; NULL: there is none. */
GimpLayer *celd_layers_lowest (GimpImage *image, GimpLayer *const found[CELD_N_LAYERS]);

/* An empty image of this size with the numbers and the profile of another one, without a display and steps of undo. */
GimpImage *celd_image_like (GimpImage *image, int width, int height);

/* Whether a layer has no mask and no effects that are seen.  Else its pixels and its place, as it is seen alone, in
 * memory of their own; `own`, an image like the layer's, is for copies.  buffer NULL: the layer is gone. */
gboolean          celd_layer_is_plain (GimpLayer *layer);
CeldPipelineLayer celd_layer_seen     (GimpLayer *layer, GimpImage *own);

/* Whether the image has 8 bits a channel. */
gboolean celd_image_has_few_bits (GimpImage *image);

/* Opens buffers, with the places of the layers, as they are seen.  FALSE and *error if a layer does not belong to the
 * image. */
gboolean celd_layers_open  (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS], CeldPipelineInput *input,
                            GError **error);
void     celd_layers_close (CeldPipelineInput *input);

/* ------------------------------------------------------------------ files.c */

/* Set the argument "file" to the one that was remembered, or one beside the image's own; and remember it. */
void celd_file_recall   (GimpImage *image, GimpProcedureConfig *config, const CeldProcedure *p);
void celd_file_remember (GimpImage *image, GimpProcedureConfig *config, const CeldProcedure *p);

/* The path of the file, to be freed; NULL if it cannot be written, for `can_write` or because there is no such folder.
 * What writes files is loaded then. */
char *celd_file_chosen (GimpProcedureConfig *config, gboolean (*can_write) (const char *path), const char *endings,
                        GError **error);

/* ------------------------------------------------------------------ settings.c */

/* The arguments of a procedure, with layers and relations. */
enum
{
  CELD_FOR_POPUP = 1, CELD_FOR_SPLIT = 2, CELD_FOR_SUGGEST = 4, CELD_FOR_STEREO = 8, CELD_FOR_EXPORT = 16,
  CELD_FOR_MESH = 32, CELD_FOR_LIVE = 64
};
void     celd_settings_add_arguments (GimpProcedure *procedure, guint whose);
void     celd_file_add_argument      (GimpProcedure *procedure, const char *help); /* "file" */
gboolean celd_has_argument (GimpProcedureConfig *config, const char *name);

/* What was chosen: the settings, and the pictures as bits. */
CeldSettings celd_settings_chosen (GimpProcedureConfig *config);
void         celd_settings_put    (GimpProcedureConfig *config, const CeldSettings *settings); /* those of presets */
guint        celd_pictures_chosen (GimpProcedureConfig *config);
void         celd_layers_chosen   (GimpProcedureConfig *config, GimpLayer *layer[CELD_N_LAYERS]); /* borrowed */

/* Keep the arguments with the image, in a step of undo if wanted, and set those that were kept.  Layers that are not
 * found by their names are kept, too; layers and relations are always set, whatever was kept. */
void celd_settings_remember (GimpImage *image, GimpProcedureConfig *config, gboolean undoable);
void celd_settings_recall   (GimpImage *image, GimpProcedureConfig *config);

/* The layers that were chosen, and in place of others those of their names; NULL where there is none. */
void celd_layers_kept (GimpImage *image, GimpLayer *layer[CELD_N_LAYERS]);

/* What is kept with an image, or what another parasite has, which is freed (NULL: nothing), as a key file: the names of
 * properties and their values are in this group of it. */
#define CELD_KEPT_GROUP "pop-up"
GKeyFile *celd_kept_with (GimpImage *image);
GKeyFile *celd_kept_read (GimpParasite *parasite);

/* Adds the value of a property to a file, if it can be kept; and sets a property, if the file has a good value. */
void celd_kept_add (GKeyFile *file, GObject *object, const GParamSpec *spec);
void celd_kept_set (GKeyFile *file, GObject *object, GParamSpec *spec);

/* ------------------------------------------------------------------ presets.c */

/* The argument "preset"; what it says for a script; and the choice of a dialog, which sets the other arguments, and
 * shows whether they still are those of a preset. */
void celd_preset_add_argument (GimpProcedure *procedure);
void celd_preset_apply        (GimpProcedureConfig *config);
void celd_preset_follow       (GimpProcedureConfig *config);

/* ------------------------------------------------------------------ filters.c */

/* Gives the filters that have settings of presets these presets, if the artist has none of his own. */
void celd_filters_write_presets (void);

/* ------------------------------------------------------------------ results.c */

gboolean celd_results_is_group (GimpItem *item);

/* Whether the pixels of an item are locked, by itself or by a group that it lies in. */
gboolean celd_item_is_locked (gpointer item);

/* Marks an item, so that it is found again in its file, or says whether it is marked, with this text if that is not
 * NULL. */
#define CELD_PICTURE_MARK "celdepth-picture" /* of a result, with the name of a picture */
void     celd_item_mark      (gpointer item, const char *name, const char *text);
gboolean celd_item_is_marked (GimpItem *item, const char *name, const char *text);

/* A layer of the group: its mark, its name when it is new, and a number below 32 of what is on it. */
typedef struct { const char *mark, *name; GimpImageType type; int picture; } CeldResultLayer;

/* All layers of a procedure, from the top to the bottom; what writes one of them; and whether the first new one is
 * visible, even in a group that was there before. */
typedef struct
{
  const CeldResultLayer *layer;
  gsize                  n;
  gboolean             (*write) (CeldPipeline *pipeline, int picture, gpointer data, GeglBuffer *buffer,
                                 GError **error);
  gpointer               data;
  gboolean               show;
} CeldResults;

/* Writes the wanted pictures, as bits, into layers of the group, which is made if there is none.
 * Other ones of these layers are removed; those whose pixels are locked stay as they are.  NULL on failure. */
GimpGroupLayer *celd_results_write (GimpImage *image, CeldPipeline *pipeline, const CeldResults *results, guint wanted,
                                    GError **error);

/* Selects nothing, and again what was selected before, which is NULL if there was no selection. */
GimpChannel *celd_selection_clear   (GimpImage *image);
void         celd_selection_restore (GimpImage *image, GimpChannel *selection);

/* The layer with this mark in a group of results; NULL: there is none. */
GimpLayer *celd_results_find (GimpImage *image, const char *mark);

/* The same if its pixels may be written: they are not locked. */
GimpLayer *celd_results_find_unlocked (GimpImage *image, const char *mark);

/* ------------------------------------------------------------------ live.c, live-send.c */

/* Procedures that are parts of Live: its window; and what brings pixels into a layer, in a process that is started for
 * it, or in this one, for which it gets a name of its own. */
#define CELD_LIVE_WINDOW "plug-in-celdepth-live-window"
#define CELD_LIVE_SEND   "plug-in-celdepth-live-send"

GimpProcedure *celd_live_window_create    (GimpPlugIn *plug_in);
GimpProcedure *celd_live_send_create      (GimpPlugIn *plug_in);
GimpProcedure *celd_live_send_create_here (GimpPlugIn *plug_in);

/* ------------------------------------------------------------------ effect.c */

#define CELD_EFFECT "celdepth:live-popup"

/* Whether an item has the effect of Live group. */
gboolean celd_effect_is_on (GimpItem *item);

/* Puts the effect on a group, with these layers, in place of an earlier one, of which it gets the settings.  FALSE:
 * GIMP cannot make it. */
gboolean celd_effect_put (GimpLayer *group, GimpLayer *const layer[CELD_N_LAYERS]);

/* ------------------------------------------------------------------ dialog.c */

/* Shows what the procedure has arguments for.  FALSE: cancelled. */
gboolean celd_dialog_run (GimpProcedure *procedure, GimpProcedureConfig *config, GimpImage *image,
                          const CeldProcedure *p);

#endif
