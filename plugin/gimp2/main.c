/* Pop-up for GIMP 2.10: from the layers of an image to a group with depth.
 *
 * All that takes time is done before the image is touched: cancelling ends the plug-in and leaves the image as it was.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp2.h"

#define PROCEDURE  "plug-in-celdepth-popup"
#define DOMAIN     "celdepth"               /* of translations */
#define LEAST_STEP 0.01 /* of the progress, each of which is a message to GIMP; chosen */

/* ------------------------------------------------------------------ progress */

typedef struct { double shown; const char *step; } Progress;

static gboolean
show_progress (gpointer data, double done, const char *step)
{
  Progress *p = data;

  if (step == p->step && done < p->shown + LEAST_STEP)
    return TRUE;
  if (step != p->step)
    gimp_progress_set_text (step);
  gimp_progress_update (done);
  *p = (Progress) { done, step };
  return TRUE;
}

/* ------------------------------------------------------------------ making */

static gboolean
fail (GError **error, const char *message)
{
  g_set_error_literal (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, message);
  return FALSE;
}

static gboolean
check (gint32 image, const CeldChoices *choices, GError **error)
{
  if (gimp_image_base_type (image) != GIMP_RGB)
    return fail (error, _ ("This image has no colours, which scribbles and regions need. Turn it into an RGB image: "
                           "Image > Mode > RGB."));
  if (gimp_image_get_floating_sel (image) >= 0)
    return fail (error, _ ("There is a floating selection. Anchor it first: Layer > Anchor Layer."));
  if (!choices->wanted)
    return fail (error, _ ("Nothing is chosen that could be made. Tick at least one picture."));
  if (choices->layer[CELD_LAYER_DRAWING] < 0)
    return fail (error, _ ("There is no layer named \"Drawing\", and there are several that could be it. Name it, or "
                           "choose it in the dialog."));
  if (!choices->settings.flats && choices->layer[CELD_LAYER_SCRIBBLES] < 0 && choices->layer[CELD_LAYER_ARROWS] < 0)
    return fail (error, _ ("There is no layer with scribbles or arrows. Choose one in the dialog, or make a layer "
                           "named \"Scribbles\", and scribble over each part in a colour of its own."));
  return TRUE;
}

static CeldPipeline *
open_pipeline (gint32 image, const CeldChoices *choices, GError **error)
{
  CeldPipelineInput input = { .settings = choices->settings, .relations = choices->relations };
  CeldPipeline     *pipeline;

  celd_layers_open (image, choices->layer, &input);
  pipeline = celd_pipeline_new (&input, error);
  celd_layers_close (&input);
  return pipeline;
}

/* The group with the results; -1 on failure. */
static gint32
make (gint32 image, const CeldChoices *choices, GError **error)
{
  Progress      progress = { 0, NULL };
  gint32        group = -1;
  CeldPipeline *pipeline;
  char         *problems;

  if (!check (image, choices, error))
    return -1;
  gimp_progress_init (_ ("Reading the layers"));
  pipeline = open_pipeline (image, choices, error);
  if (pipeline && celd_pipeline_make (pipeline, choices->wanted, show_progress, &progress, error))
    {
      problems = celd_pipeline_problems (pipeline);
      group    = celd_results_write (image, pipeline, choices, error);
      if (problems)
        g_message ("%s", problems);
      g_free (problems);
    }
  celd_pipeline_free (pipeline);
  gimp_progress_end ();
  return group;
}

/* ------------------------------------------------------------------ the procedure */

static GimpPDBStatusType
run_popup (const GimpParam *param, int n, gint32 *group, GError **error)
{
  GimpRunMode       mode = (GimpRunMode) param[0].data.d_int32;
  gint32            image = param[1].data.d_image;
  CeldChoices       choices = celd_choices (image);
  GimpPDBStatusType status = GIMP_PDB_SUCCESS;

  if (mode != GIMP_RUN_NONINTERACTIVE)
    celd_choices_recall (image, &choices);
  else if (n < 6 || !celd_choices_read (param[3].data.d_string, param[4].data.d_string, param[5].data.d_string,
                                        &choices, error))
    status = GIMP_PDB_CALLING_ERROR;
  if (mode == GIMP_RUN_INTERACTIVE && !celd_dialog_run (image, &choices))
    status = GIMP_PDB_CANCEL;
  if (status == GIMP_PDB_SUCCESS)
    {
      *group = make (image, &choices, error);
      status = *group < 0 ? GIMP_PDB_EXECUTION_ERROR : GIMP_PDB_SUCCESS;
    }
  celd_choices_clear (&choices);
  return status;
}

static void
run (const gchar *name, gint n, const GimpParam *param, gint *n_values, GimpParam **values)
{
  static GimpParam value[2];
  GError          *error = NULL;
  gint32           group = -1;

  (void) name;
  bindtextdomain (DOMAIN, CELD_LOCALE_FOLDER);
  bind_textdomain_codeset (DOMAIN, "UTF-8");
  textdomain (DOMAIN);
  gegl_init (NULL, NULL);
  value[0].type          = GIMP_PDB_STATUS;
  value[0].data.d_status = run_popup (param, n, &group, &error);
  value[1].type          = error ? GIMP_PDB_STRING : GIMP_PDB_LAYER;
  if (error)
    value[1].data.d_string = g_strdup (error->message);
  else
    value[1].data.d_layer = group;
  *n_values = error || value[0].data.d_status == GIMP_PDB_SUCCESS ? 2 : 1;
  *values   = value;
  g_clear_error (&error);
}

static void
query (void)
{
  static const GimpParamDef arguments[] = {
    { GIMP_PDB_INT32,    "run-mode",  "The run mode { RUN-INTERACTIVE (0), RUN-NONINTERACTIVE (1) }" },
    { GIMP_PDB_IMAGE,    "image",     "The image, with layers named Drawing, Scribbles, Arrows, Contours" },
    { GIMP_PDB_DRAWABLE, "drawable",  "Any layer; it does not matter which" },
    { GIMP_PDB_STRING,   "pictures",  "What to make, such as \"lit,depth\": regions, levels, depth, normals, shading, "
                                      "lit, enhanced; \"\": regions, depth and lit" },
    { GIMP_PDB_STRING,   "settings",  "Settings such as \"light-azimuth=90 bulge=0.5\"; \"\": the defaults" },
    { GIMP_PDB_STRING,   "relations", "Relations beside arrows: \"120,80 > 300,95\" or \"#ff0000 > #0000ff\"" },
  };
  static const GimpParamDef results[] = { { GIMP_PDB_LAYER, "group", "The group with the results" } };

  gimp_plugin_domain_register (DOMAIN, CELD_LOCALE_FOLDER); /* in which GIMP finds the texts below */
  gimp_install_procedure (PROCEDURE,
                          N_ ("Finds depth for a drawing, from scribbles over its parts and arrows from nearer to "
                              "farther parts"),
                          N_ ("Reads the layers Drawing, Scribbles, Arrows, Contours, Corrections and Hidden, and puts "
                              "the results into a layer group, which is updated when it is there already."),
                          "The authors of celdepth", "LGPL-3.0-or-later", "2026", N_ ("_Pop-up..."), "*", GIMP_PLUGIN,
                          G_N_ELEMENTS (arguments), G_N_ELEMENTS (results), arguments, results);
  gimp_plugin_menu_register (PROCEDURE, "<Image>/Cartoon Depth");
  gimp_plugin_icon_register (PROCEDURE, GIMP_ICON_TYPE_IMAGE_FILE, (const guint8 *) CELD_ICON_FILE);
}

const GimpPlugInInfo PLUG_IN_INFO = { NULL, NULL, query, run };

MAIN ()
