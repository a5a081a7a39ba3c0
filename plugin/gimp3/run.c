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

static gboolean
check_image (GimpImage *image, GError **error)
{
  if (gimp_image_get_base_type (image) != GIMP_RGB)
    return fail (error, "This image has no colours, which scribbles and regions need. Turn it into an RGB image: "
                 "Image > Mode > RGB, or Cartoon Depth > Set up layers.");
  if (gimp_image_get_floating_sel (image))
    return fail (error, "There is a floating selection. Anchor it first: Layer > Anchor Floating Layer or Mask.");
  return TRUE;
}

/* Layers that a script does not name are found by their names. */
static gboolean
choose_layers (GimpImage *image, GimpProcedureConfig *config, gboolean by_name, GimpLayer *layer[CELD_N_LAYERS],
               GError **error)
{
  GimpLayer *named[CELD_N_LAYERS];

  celd_layers_chosen (config, layer);
  celd_layers_find (image, named);
  for (int role = 0; by_name && role < CELD_N_LAYERS; role++)
    {
      gboolean taken = FALSE;

      for (int other = 0; other < CELD_N_LAYERS; other++)
        taken = taken || (named[role] && layer[other] == named[role]);
      if (!layer[role] && (!taken || role == CELD_LAYER_DRAWING))
        layer[role] = named[role];
    }
  if (!layer[CELD_LAYER_DRAWING])
    return fail (error, "There is no layer named \"Drawing\", and there are several that could be it. Name it, or "
                 "choose it in the dialog.");
  if (!layer[CELD_LAYER_SCRIBBLES] && !layer[CELD_LAYER_ARROWS])
    return fail (error, "There is no layer with scribbles or arrows. Choose one in the dialog, or make them with "
                 "Cartoon Depth > Set up layers, and scribble over each part in a colour of its own.");
  return TRUE;
}

/* ------------------------------------------------------------------ running */

static CeldPipeline *
open_pipeline (GimpImage *image, GimpProcedureConfig *config, GimpLayer *const layer[CELD_N_LAYERS], GError **error)
{
  CeldPipelineInput input = { .settings = celd_settings_chosen (config) };
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
  celd_settings_remember (image, config);
  gimp_image_undo_group_end (image);
  gimp_displays_flush ();
  g_free (selected);
  return layer;
}

static GimpLayer *
read_and_make (const CeldProcedure *p, GimpImage *image, GimpProcedureConfig *config, gboolean by_name, GError **error)
{
  GimpLayer    *layer[CELD_N_LAYERS], *made = NULL;
  Progress      progress = { 0, NULL };
  CeldPipeline *pipeline;
  char         *problems;

  if (!choose_layers (image, config, by_name, layer, error))
    return NULL;
  gimp_progress_init ("Reading the layers");
  pipeline = open_pipeline (image, config, layer, error);
  if (pipeline && p->make (pipeline, image, config, show_progress, &progress, error))
    {
      problems = celd_pipeline_problems (pipeline);
      made     = write_in_one_step (p, pipeline, image, config, error);
      if (problems)
        g_message ("%s", problems);
      g_free (problems);
    }
  celd_pipeline_free (pipeline);
  gimp_progress_end ();
  return made;
}

GimpValueArray *
celd_run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
          GimpProcedureConfig *config, gpointer run_data)
{
  const CeldProcedure *p = run_data;
  gboolean             script = run_mode == GIMP_RUN_NONINTERACTIVE;
  GError              *error = NULL;
  GimpLayer           *layer;
  GimpValueArray      *values;

  (void) drawables;
  gegl_init (NULL, NULL);
  if (!check_image (image, &error))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CALLING_ERROR, error);
  if (!script)
    celd_settings_recall (image, config);
  if (run_mode == GIMP_RUN_INTERACTIVE && !celd_dialog_run (procedure, config, image, p->title))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CANCEL, NULL);
  layer = read_and_make (p, image, config, script, &error);
  if (!layer)
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_EXECUTION_ERROR, error);
  values = gimp_procedure_new_return_values (procedure, GIMP_PDB_SUCCESS, NULL);
  g_value_set_object (gimp_value_array_index (values, 1), layer);
  return values;
}
