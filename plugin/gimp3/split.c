/* Split into layers: cuts the drawing into a layer for each region, in a new group.
 *
 * A run makes a group of its own, since layers of an earlier one may have been painted on.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#define MARK "part"

static gboolean
make (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, CeldPipelineProgress progress,
      gpointer data, GError **error)
{
  (void) config;
  return celd_pipeline_cut (pipeline, celd_image_has_few_bits (image) ? 8 : 32, progress, data, error);
}

/* On top of the group; a region that has no pixel makes no layer. */
static gboolean
add_layer (CeldPipeline *pipeline, GimpImage *image, GimpLayer *group, gsize i, GError **error)
{
  GeglRectangle box = celd_pipeline_layer_box (pipeline, i);
  char         *name = celd_pipeline_layer_name (pipeline, i);
  gboolean      good = TRUE;

  if (box.width)
    {
      GimpLayer  *layer = gimp_layer_new (image, name, box.width, box.height, GIMP_RGBA_IMAGE, 100,
                                          GIMP_LAYER_MODE_NORMAL);
      GeglBuffer *buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer));

      good = celd_pipeline_write_layer (pipeline, i, buffer, error);
      g_object_unref (buffer); /* which sends the pixels */
      gimp_layer_set_offsets (layer, box.x, box.y);
      celd_item_mark (layer, CELD_PICTURE_MARK, MARK);
      gimp_image_insert_layer (image, layer, group, 0);
    }
  g_free (name);
  return good;
}

static GimpLayer *
write_result (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, GError **error)
{
  GimpLayer *group = GIMP_LAYER (gimp_group_layer_new (image, _ ("Layers")));
  gboolean   good = TRUE;

  (void) config;
  gimp_image_insert_layer (image, group, NULL, 0);
  for (gsize i = 0; i < celd_pipeline_n_layers (pipeline) && good; i++)
    good = add_layer (pipeline, image, group, i, error);
  return good ? group : NULL;
}

static void
add_arguments (GimpProcedure *procedure)
{
  celd_settings_add_arguments (procedure, CELD_FOR_SPLIT);
  gimp_procedure_add_group_layer_return_value (procedure, "group", "Group", "The group with the layers", FALSE,
                                               G_PARAM_READWRITE);
}

const CeldProcedure celd_split_procedure = {
  .name          = "plug-in-celdepth-split-into-layers",
  .menu_label    = N_ ("Spl_it into layers..."),
  .blurb         = N_ ("Cuts a drawing into a layer for each part, in the order of depth"),
  .help          = N_ ("Makes a group with one layer for each part, with its own lines; over each other they are the "
                       "drawing. If they are completed they have also what nearer parts hide. Layers are found as by "
                       "Pop-up."),
  .add_arguments = add_arguments,
  .run           = celd_run,
  .title         = N_ ("Split into layers"),
  .make          = make,
  .write         = write_result,
};
