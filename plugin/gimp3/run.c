/* What the procedures with a dialog do.
 *
 * All that takes time is done before the image is touched: cancelling ends the plug-in and leaves the image as it was.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#define LEAST_STEP 0.01 /* of the progress, each of which is a message to GIMP; chosen */

/* ------------------------------------------------------------------ progress */

typedef struct { double shown; const char *step; } Progress;

static gboolean
show_progress (gpointer data, double done, const char *step)
{
  Progress *p = data;

  if (step != p->step)
    gimp_progress_set_text (step);
  if (step != p->step || done >= p->shown + LEAST_STEP)
    gimp_progress_update (done);
  else
    return TRUE;
  p->step  = step;
  p->shown = done;
  return TRUE;
}

/* ------------------------------------------------------------------ checks */

static gboolean
fail (GError **error, const char *message)
{
  g_set_error_literal (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, message);
  return FALSE;
}

gboolean
celd_floating_check (GimpImage *image, GError **error)
{
  if (gimp_image_get_floating_sel (image))
    return fail (error, _ ("There is a floating selection. Anchor it first: Layer > Anchor Floating Layer or Mask."));
  return TRUE;
}

gboolean
celd_image_check (GimpImage *image, GError **error)
{
  if (gimp_image_get_base_type (image) != GIMP_RGB)
    return fail (error, _ ("This image has no colours, which scribbles and regions need. Turn it into an RGB image: "
                           "Image > Mode > RGB, or Cartoon Depth > Set up layers."));
  return celd_floating_check (image, error);
}

/* Layers that a script does not name are found by their names. */
static void
find_layers (GimpImage *image, GimpProcedureConfig *config)
{
  GimpLayer *named[CELD_N_LAYERS], *layer[CELD_N_LAYERS];

  celd_layers_chosen (config, layer);
  celd_layers_find (image, named);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      gboolean taken = FALSE;

      for (int other = 0; other < CELD_N_LAYERS; other++)
        taken = taken || (named[role] && layer[other] == named[role]);
      if (!layer[role] && (!taken || role == CELD_LAYER_DRAWING))
        layer[role] = named[role];
      g_object_set (config, celd_layer_arguments[role], layer[role], NULL);
    }
}

gboolean
celd_layers_check (GimpLayer *const layer[CELD_N_LAYERS], const CeldPathArrows *paths, GimpProcedureConfig *config,
                   GError **error)
{
  if (!layer[CELD_LAYER_DRAWING])
    return fail (error, _ ("There is no layer named \"Drawing\", and there are several that could be it. Name it, or "
                           "choose it in the dialog."));
  if (!celd_settings_chosen (config).flats && !layer[CELD_LAYER_SCRIBBLES] && !layer[CELD_LAYER_ARROWS] && !paths->n)
    return fail (error, _ ("There is no layer with scribbles or arrows. Choose one in the dialog, or make them with "
                           "Cartoon Depth > Set up layers, and scribble over each part in a colour of its own."));
  return TRUE;
}

/* ------------------------------------------------------------------ running */

static CeldPipeline *
open_pipeline (GimpImage *image, GimpProcedureConfig *config, GimpLayer *const layer[CELD_N_LAYERS],
               const CeldPathArrows *paths, GError **error)
{
  CeldPipelineInput input = { .settings = celd_settings_chosen (config), .arrow_path = paths->data };
  CeldPipeline     *pipeline = NULL;
  char             *relations = NULL;

  g_object_get (config, "relations", &relations, NULL);
  input.relations = relations;
  if (celd_layers_open (image, layer, &input, error))
    pipeline = celd_pipeline_new (&input, error);
  celd_layers_close (&input);
  g_free (relations);
  return pipeline;
}

/* Selects again the layers that were selected; one that was removed cannot be. */
static void
select_again (GimpImage *image, GimpLayer **selected)
{
  int n = 0;

  for (int i = 0; selected && selected[i]; i++)
    if (gimp_item_is_valid (GIMP_ITEM (selected[i])))
      selected[n++] = selected[i];
  if (n)
    {
      selected[n] = NULL;
      gimp_image_set_selected_layers (image, (const GimpLayer **) selected);
    }
}

static GimpLayer *
write_in_one_step (const CeldProcedure *p, CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config,
                   GError **error)
{
  GimpLayer **selected = gimp_image_get_selected_layers (image), *layer;

  gimp_image_undo_group_start (image);
  layer = p->write (pipeline, image, config, error);
  select_again (image, selected);
  celd_settings_remember (image, config, TRUE);
  gimp_image_undo_group_end (image);
  gimp_displays_flush ();
  g_free (selected);
  return layer;
}

/* *written is NULL if nothing is written into an image. */
static gboolean
write_result (const CeldProcedure *p, CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config,
              GimpLayer **written, GError **error)
{
  if (p->write && !(p->elsewhere && p->elsewhere (image, config)))
    *written = write_in_one_step (p, pipeline, image, config, error);
  else
    {
      *written = p->write ? p->write (pipeline, image, config, error) : NULL;
      celd_settings_remember (image, config, FALSE);
    }
  return *written || !p->write;
}

static void
show_problems (CeldPipeline *pipeline, const CeldPathArrows *paths)
{
  char *problems = celd_pipeline_problems (pipeline);

  if (problems)
    g_message ("%s", problems);
  celd_paths_say_left_out (paths);
  g_free (problems);
}

static gboolean
read_and_make (const CeldProcedure *p, GimpImage *image, GimpProcedureConfig *config, GimpLayer **written,
               GError **error)
{
  CeldPathArrows paths = celd_paths_read (image);
  GimpLayer     *layer[CELD_N_LAYERS];
  Progress       progress = { 0, NULL };
  CeldPipeline  *pipeline = NULL;
  gboolean       good;

  gimp_progress_init (_ ("Reading the layers"));
  celd_layers_chosen (config, layer);
  if (celd_layers_check (layer, &paths, config, error))
    pipeline = open_pipeline (image, config, layer, &paths, error);
  good = pipeline && p->make (pipeline, image, config, show_progress, &progress, error);
  if (good)
    {
      show_problems (pipeline, &paths);
      good = write_result (p, pipeline, image, config, written, error);
    }
  celd_pipeline_free (pipeline);
  gimp_progress_end ();
  g_free (paths.data);
  return good;
}

static gboolean
prepare_and_make (const CeldProcedure *p, GimpImage *image, GimpProcedureConfig *config, GimpLayer **written,
                  GError **error)
{
  gboolean done = FALSE;

  if (p->prepare && !p->prepare (image, config, &done, error))
    return FALSE;
  if (done)
    celd_settings_remember (image, config, FALSE);
  else if (!read_and_make (p, image, config, written, error))
    return FALSE;
  if (p->file_ending)
    celd_file_remember (image, config, p);
  return TRUE;
}

/* Sets what was kept with the image. */
static void
recall (const CeldProcedure *p, GimpImage *image, GimpProcedureConfig *config)
{
  celd_settings_recall (image, config);
  if (p->file_ending)
    celd_file_recall (image, config, p);
}

/* Fills in what a script left out. */
static void
read_arguments (GimpImage *image, GimpProcedureConfig *config)
{
  find_layers (image, config);
  if (celd_has_argument (config, "preset"))
    celd_preset_apply (config);
}

GimpValueArray *
celd_run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
          GimpProcedureConfig *config, gpointer run_data)
{
  const CeldProcedure *p = run_data;
  gboolean             script = run_mode == GIMP_RUN_NONINTERACTIVE;
  GError              *error = NULL;
  GimpLayer           *layer = NULL;
  GimpValueArray      *values;

  (void) drawables;
  gegl_init (NULL, NULL);
  if (!celd_image_check (image, &error))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CALLING_ERROR, error);
  if (script)
    read_arguments (image, config);
  else
    recall (p, image, config);
  if (run_mode == GIMP_RUN_INTERACTIVE && !celd_dialog_run (procedure, config, image, p))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CANCEL, NULL);
  if (!prepare_and_make (p, image, config, &layer, &error))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_EXECUTION_ERROR, error);
  if (!script && layer && gimp_item_get_image (GIMP_ITEM (layer)) != image)
    gimp_display_new (gimp_item_get_image (GIMP_ITEM (layer)));
  values = gimp_procedure_new_return_values (procedure, GIMP_PDB_SUCCESS, NULL);
  if (layer)
    g_value_set_object (gimp_value_array_index (values, 1), layer);
  return values;
}
