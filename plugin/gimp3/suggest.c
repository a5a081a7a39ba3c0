/* Suggest order: a layer with arrows from parts that seem nearer to those behind them, in which the artist erases wrong
 * ones.  Without a layer of arrows it is that layer; else it lies above it, to be merged down.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#define NAME N_ ("Suggested arrows")
#define MARK "suggestions"

static gboolean
make (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, CeldPipelineProgress progress,
      gpointer data, GError **error)
{
  (void) image;
  (void) config;
  return celd_pipeline_make (pipeline, 1u << CELD_PICTURE_SUGGESTIONS, progress, data, error);
}

/* Removes suggestions of an earlier run. */
static void
remove_old (GimpImage *image)
{
  GArray *listed = celd_layers_list (image);

  for (guint i = 0; i < listed->len; i++)
    {
      GimpLayer *layer = g_array_index (listed, CeldListedLayer, i).layer;

      if (celd_item_is_marked (GIMP_ITEM (layer), CELD_PICTURE_MARK, MARK) && !celd_item_is_locked (layer))
        gimp_image_remove_layer (image, layer);
    }
  g_array_unref (listed);
}

static GimpLayer *
write_result (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, GError **error)
{
  GimpLayer  *chosen[CELD_N_LAYERS], *named[CELD_N_LAYERS], *layer, *below;
  GimpItem   *parent;
  GeglBuffer *buffer;
  gboolean    good;

  remove_old (image);
  celd_layers_chosen (config, chosen);
  celd_layers_find (image, named);
  below  = chosen[CELD_LAYER_ARROWS] ? chosen[CELD_LAYER_ARROWS] : named[CELD_LAYER_ARROWS];
  layer  = gimp_layer_new (image, _ (below ? NAME : celd_layer_role_name (CELD_LAYER_ARROWS)),
                           gimp_image_get_width (image), gimp_image_get_height (image), GIMP_RGBA_IMAGE, 100,
                           GIMP_LAYER_MODE_NORMAL);
  buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer));
  good   = celd_pipeline_write (pipeline, CELD_PICTURE_SUGGESTIONS, buffer, error);
  g_object_unref (buffer); /* which sends the pixels */
  if (below)
    celd_item_mark (layer, CELD_PICTURE_MARK, MARK);
  parent = below ? gimp_item_get_parent (GIMP_ITEM (below)) : NULL;
  gimp_image_insert_layer (image, layer, parent ? GIMP_LAYER (parent) : NULL,
                           below ? gimp_image_get_item_position (image, GIMP_ITEM (below)) : 0);
  return good ? layer : NULL;
}

static void
add_arguments (GimpProcedure *procedure)
{
  celd_settings_add_arguments (procedure, CELD_FOR_SUGGEST);
  gimp_procedure_add_layer_return_value (procedure, "layer", "Layer", "The layer with the arrows", FALSE,
                                         G_PARAM_READWRITE);
}

const CeldProcedure celd_suggest_procedure = {
  .name          = "plug-in-celdepth-suggest-order",
  .menu_label    = N_ ("Suggest _order..."),
  .blurb         = N_ ("Draws arrows from parts that seem nearer to those behind them, from the drawing alone"),
  .help          = N_ ("Makes a layer of arrows; orange ones are hardly more than a guess, green ones nearly certain. "
                       "Erase wrong arrows, and merge the layer down onto Arrows. Another run replaces the layer. "
                       "Without a layer Arrows the new layer is Arrows."),
  .add_arguments = add_arguments,
  .run           = celd_run,
  .title         = N_ ("Suggest order"),
  .make          = make,
  .write         = write_result,
};
