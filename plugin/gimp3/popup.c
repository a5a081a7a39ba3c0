/* Pop-up: from the layers of an image to a group with depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"


static gboolean
make (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, CeldPipelineProgress progress,
      gpointer data, GError **error)
{
  guint wanted = celd_pictures_chosen (config);

  (void) image;
  if (wanted)
    return celd_pipeline_make (pipeline, wanted, progress, data, error);
  g_set_error_literal (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED,
                       _ ("Nothing is chosen that could be made. Tick at least one picture."));
  return FALSE;
}

static gboolean
write_layer (CeldPipeline *pipeline, int picture, gpointer data, GeglBuffer *buffer, GError **error)
{
  (void) data;
  return celd_pipeline_write (pipeline, (CeldPicture) picture, buffer, error);
}

static GimpLayer *
write_result (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, GError **error)
{
  CeldResultLayer layer[CELD_POPUP_PICTURES];
  CeldResults     results = { layer, G_N_ELEMENTS (layer), write_layer, NULL, FALSE };

  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    {
      CeldPicture            picture = celd_pictures_stacked[i];
      const CeldPictureInfo *info = &celd_pictures[picture];

      layer[i] = (CeldResultLayer) { info->argument, info->layer, info->alpha ? GIMP_RGBA_IMAGE : GIMP_RGB_IMAGE,
                                     (int) picture };
    }
  return (GimpLayer *) celd_results_write (image, pipeline, &results, celd_pictures_chosen (config), error);
}

static void
add_arguments (GimpProcedure *procedure)
{
  celd_settings_add_arguments (procedure, CELD_FOR_POPUP);
  celd_preset_add_argument (procedure);
  gimp_procedure_add_group_layer_return_value (procedure, "group", "Group", "The group with the results", FALSE,
                                               G_PARAM_READWRITE);
}

const CeldProcedure celd_popup_procedure = {
  .name          = "plug-in-celdepth-popup",
  .menu_label    = N_ ("_Pop-up..."),
  .blurb         = N_ ("Finds depth for a drawing, from scribbles over its parts and arrows from nearer to farther "
                       "parts"),
  .help          = N_ ("Reads the layers Drawing, Scribbles, Arrows, Contours, Corrections and Hidden, and puts the "
                       "results into a layer group, which is updated when it is there already. Layers that are not "
                       "given are found by their names."),
  .add_arguments = add_arguments,
  .run           = celd_run,
  .title         = N_ ("Pop-up"),
  .make          = make,
  .write         = write_result,
};
