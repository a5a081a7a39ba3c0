/* Stereo: views for both eyes in one layer, for glasses or a screen, or in two layers; in the group of results, or in a
 * new image, which arrangements that are larger than the image always need.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#define TWO_LAYERS (CELD_STEREO_DUBOIS + 1) /* the choice behind those of core */

enum { JOINED, LEFT, RIGHT };

static const CeldResultLayer layers[] = {
  { "stereo",       N_ ("Stereo"),     GIMP_RGBA_IMAGE, JOINED },
  { "stereo-left",  N_ ("Left view"),  GIMP_RGBA_IMAGE, LEFT },
  { "stereo-right", N_ ("Right view"), GIMP_RGBA_IMAGE, RIGHT },
};

/* ------------------------------------------------------------------ the arrangement */

static guint
wanted_layers (GimpProcedureConfig *config)
{
  return gimp_procedure_config_get_choice_id (config, "stereo") == TWO_LAYERS ? 1u << LEFT | 1u << RIGHT : 1u << JOINED;
}

/* What a layer has of the views. */
static CeldStereo
arrangement_of (GimpProcedureConfig *config, int layer)
{
  return layer == LEFT ? CELD_STEREO_LEFT : layer == RIGHT ? CELD_STEREO_RIGHT
         : (CeldStereo) gimp_procedure_config_get_choice_id (config, "stereo");
}

static void
joined_size (GimpImage *image, GimpProcedureConfig *config, int *width, int *height)
{
  *width  = gimp_image_get_width (image);
  *height = gimp_image_get_height (image);
  if (wanted_layers (config) == 1u << JOINED)
    celd_stereo_size (arrangement_of (config, JOINED), width, height);
}

static gboolean
is_elsewhere (GimpImage *image, GimpProcedureConfig *config)
{
  gboolean wanted;
  int      width, height;

  g_object_get (config, "new-image", &wanted, NULL);
  joined_size (image, config, &width, &height);
  return wanted || width != gimp_image_get_width (image) || height != gimp_image_get_height (image);
}

/* ------------------------------------------------------------------ writing */

static gboolean
write_layer (CeldPipeline *pipeline, int layer, gpointer config, GeglBuffer *buffer, GError **error)
{
  return celd_pipeline_write_views (pipeline, arrangement_of (config, layer), buffer, error);
}

static GimpImage *
new_image (GimpImage *like, GimpProcedureConfig *config)
{
  int        width, height;
  double     x, y;
  GimpImage *image;

  joined_size (like, config, &width, &height);
  image = celd_image_like (like, width, height);
  if (gimp_image_get_resolution (like, &x, &y))
    gimp_image_set_resolution (image, x, y);
  return image;
}

/* Returns the first layer. */
static GimpLayer *
write_image (CeldPipeline *pipeline, GimpImage *like, GimpProcedureConfig *config, GError **error)
{
  GimpImage *image = new_image (like, config);
  GimpLayer *first = NULL;
  gboolean   good = TRUE;
  int        position = 0;

  for (gsize i = 0; i < G_N_ELEMENTS (layers) && good; i++)
    if (wanted_layers (config) & 1u << layers[i].picture)
      {
        GimpLayer  *layer = gimp_layer_new (image, _ (layers[i].name), gimp_image_get_width (image),
                                            gimp_image_get_height (image), layers[i].type, 100, GIMP_LAYER_MODE_NORMAL);
        GeglBuffer *buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer));

        good = write_layer (pipeline, layers[i].picture, config, buffer, error);
        g_object_unref (buffer); /* which sends the pixels */
        gimp_image_insert_layer (image, layer, NULL, position++);
        first = first ? first : layer;
      }
  gimp_image_undo_enable (image);
  if (good)
    return first;
  gimp_image_delete (image);
  return NULL;
}

static GimpLayer *
write_result (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, GError **error)
{
  CeldResults results = { layers, G_N_ELEMENTS (layers), write_layer, config, TRUE };
  guint       wanted = wanted_layers (config);

  if (is_elsewhere (image, config))
    return write_image (pipeline, image, config, error);
  if (!celd_results_write (image, pipeline, &results, wanted, error))
    return NULL;
  return celd_results_find (image, layers[wanted == 1u << JOINED ? JOINED : LEFT].mark);
}

/* ------------------------------------------------------------------ the procedure */

static gboolean
make (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, CeldPipelineProgress progress,
      gpointer data, GError **error)
{
  (void) image;
  (void) config;
  return celd_pipeline_view (pipeline, progress, data, error);
}

static void
add_arguments (GimpProcedure *procedure)
{
  celd_settings_add_arguments (procedure, CELD_FOR_STEREO);
  gimp_procedure_add_boolean_argument (procedure, "new-image", _ ("In a _new image"),
                                       _ ("Makes a new image. Otherwise the views are layers of the group Cartoon "
                                          "Depth, if they have its size: whole views beside or above each other do "
                                          "not"),
                                       FALSE, G_PARAM_READWRITE);
  gimp_procedure_add_layer_return_value (procedure, "layer", "Layer", "The layer with both views, or with the left one",
                                         FALSE, G_PARAM_READWRITE);
}

const CeldProcedure celd_stereo_procedure = {
  .name          = "plug-in-celdepth-stereo",
  .menu_label    = N_ ("S_tereo..."),
  .blurb         = N_ ("Turns the drawing into a stereo picture: for red and cyan glasses, side by side, or in two "
                       "layers"),
  .help          = N_ ("The parts are cut out, completed where nearer ones hide them, and moved for each eye by their "
                       "depth. The result is in the group Cartoon Depth, where another run updates it, or in a new "
                       "image. Layers are found as by Pop-up."),
  .add_arguments = add_arguments,
  .run           = celd_run,
  .title         = N_ ("Stereo"),
  .elsewhere     = is_elsewhere,
  .make          = make,
  .write         = write_result,
};
