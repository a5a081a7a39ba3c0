/* Pop-up: from the layers of an image to a group with depth, as one step of undo.
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

static GimpGroupLayer *
write_results (GimpImage *image, GimpProcedureConfig *config, CeldPipeline *pipeline, guint wanted, GError **error)
{
  GimpGroupLayer *group;

  gimp_image_undo_group_start (image);
  group = celd_results_write (image, pipeline, wanted, error);
  celd_settings_remember (image, config);
  gimp_image_undo_group_end (image);
  gimp_displays_flush ();
  return group;
}

static GimpGroupLayer *
pop_up (GimpImage *image, GimpProcedureConfig *config, gboolean by_name, GError **error)
{
  GimpLayer      *layer[CELD_N_LAYERS];
  guint           wanted = celd_pictures_chosen (config);
  Progress        progress = { 0, NULL };
  GimpGroupLayer *group = NULL;
  CeldPipeline   *pipeline;
  char           *problems;

  if (!choose_layers (image, config, by_name, layer, error))
    return NULL;
  if (!wanted)
    {
      fail (error, "Nothing is chosen that could be made. Tick at least one picture.");
      return NULL;
    }
  gimp_progress_init ("Reading the layers");
  pipeline = open_pipeline (image, config, layer, error);
  if (pipeline && celd_pipeline_make (pipeline, wanted, show_progress, &progress, error))
    {
      problems = celd_pipeline_problems (pipeline);
      group    = write_results (image, config, pipeline, wanted, error);
      if (problems)
        g_message ("%s", problems);
      g_free (problems);
    }
  celd_pipeline_free (pipeline);
  gimp_progress_end ();
  return group;
}

static GimpValueArray *
run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
     GimpProcedureConfig *config, gpointer run_data)
{
  gboolean        script = run_mode == GIMP_RUN_NONINTERACTIVE;
  GError         *error = NULL;
  GimpGroupLayer *group;
  GimpValueArray *values;

  (void) drawables;
  (void) run_data;
  gegl_init (NULL, NULL);
  if (!check_image (image, &error))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CALLING_ERROR, error);
  if (!script)
    celd_settings_recall (image, config);
  if (run_mode == GIMP_RUN_INTERACTIVE && !celd_popup_dialog (procedure, config, image))
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_CANCEL, NULL);
  group = pop_up (image, config, script, &error);
  if (!group)
    return gimp_procedure_new_return_values (procedure, GIMP_PDB_EXECUTION_ERROR, error);
  values = gimp_procedure_new_return_values (procedure, GIMP_PDB_SUCCESS, NULL);
  GIMP_VALUES_SET_GROUP_LAYER (values, 1, group);
  return values;
}

static void
add_arguments (GimpProcedure *procedure)
{
  celd_settings_add_arguments (procedure);
  gimp_procedure_add_group_layer_return_value (procedure, "group", "Group", "The group with the results", FALSE,
                                               G_PARAM_READWRITE);
}

const CeldProcedure celd_popup_procedure = {
  .name          = "plug-in-celdepth-popup",
  .menu_label    = "_Pop-up...",
  .blurb         = "Finds depth for a drawing, from scribbles over its parts and arrows from nearer to farther parts",
  .help          = "Reads the layers Drawing, Scribbles, Arrows, Contours, Corrections and Hidden, and puts the "
                   "results into a layer group, which is updated when it is there already. Layers that are not given "
                   "are found by their names.",
  .add_arguments = add_arguments,
  .run           = run,
};
