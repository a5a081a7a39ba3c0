/* Export depth: depth or levels as EXR, PNG of 16 bits or TIFF, of the group's layer, or made anew.
 *
 * The layer of an image with 8 bits has 256 steps.  So depth is made anew for it, too, and is exported wherever the
 * layer has nothing else: what the artist painted on the layer counts, and all else is as precise as in other images.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include "on-demand.h"

#define ENDINGS N_ (".exr, .png or .tif")

enum { SOURCE_LAYER, SOURCE_DRAWING };

static gboolean
can_write (const char *path)
{
  return celd_io_can_write (path);
}

static CeldPicture
picture_of (GimpProcedureConfig *config)
{
  return (CeldPicture) gimp_procedure_config_get_choice_id (config, "picture");
}

/* pipeline NULL: as the layer is. */
static gboolean
save_layer (CeldPipeline *pipeline, CeldPicture picture, GimpImage *image, GimpLayer *layer, const char *path,
            GError **error)
{
  CeldPipelineLayer from = { gimp_drawable_get_buffer (GIMP_DRAWABLE (layer)), 0, 0, 0 };
  gboolean          good;

  gimp_drawable_get_offsets (GIMP_DRAWABLE (layer), &from.x, &from.y);
  good = celd_pipeline_save_layer (pipeline, picture, &from, gimp_image_get_width (image),
                                   gimp_image_get_height (image), path, error);
  g_object_unref (from.buffer);
  return good;
}

/* The layer that is exported; NULL: there is none, or it is not wanted. */
static GimpLayer *
find_source (GimpImage *image, GimpProcedureConfig *config)
{
  if (gimp_procedure_config_get_choice_id (config, "source") == SOURCE_DRAWING)
    return NULL;
  return celd_results_find (image, celd_pictures[picture_of (config)].argument);
}

/* Whether there still is what depth can be made of. */
static gboolean
can_make (GimpImage *image, GimpProcedureConfig *config)
{
  CeldPathArrows paths = celd_paths_read (image);
  GimpLayer     *layer[CELD_N_LAYERS];
  gboolean       can;

  celd_layers_chosen (config, layer);
  can = celd_layers_check (layer, &paths, config, NULL);
  g_free (paths.data);
  return can;
}

static gboolean
prepare (GimpImage *image, GimpProcedureConfig *config, gboolean *done, GError **error)
{
  char      *path = celd_file_chosen (config, can_write, ENDINGS, error);
  GimpLayer *layer = path ? find_source (image, config) : NULL;
  gboolean   good;

  *done = layer && !(celd_image_has_few_bits (image) && can_make (image, config));
  good  = path && (!*done || save_layer (NULL, picture_of (config), image, layer, path, error));
  g_free (path);
  return good;
}

static gboolean
make (CeldPipeline *pipeline, GimpImage *image, GimpProcedureConfig *config, CeldPipelineProgress progress,
      gpointer data, GError **error)
{
  CeldPicture picture = picture_of (config);
  GimpLayer  *layer = find_source (image, config);
  char       *path = celd_file_chosen (config, can_write, ENDINGS, error);
  gboolean    good = path && celd_pipeline_make (pipeline, 1u << picture, progress, data, error);

  if (good && layer)
    good = save_layer (pipeline, picture, image, layer, path, error);
  else if (good)
    good = celd_pipeline_save (pipeline, picture, path, error);
  g_free (path);
  return good;
}

static void
add_arguments (GimpProcedure *procedure)
{
  GimpChoice *picture = gimp_choice_new (), *source = gimp_choice_new ();

  gimp_choice_add (picture, "depth", CELD_PICTURE_DEPTH, _ ("Smooth depth"), NULL);
  gimp_choice_add (picture, "levels", CELD_PICTURE_LEVELS, _ ("Levels: the depth of each part, in steps"), NULL);
  gimp_choice_add (source, "layer", SOURCE_LAYER, _ ("The layer of the results"), NULL);
  gimp_choice_add (source, "drawing", SOURCE_DRAWING, _ ("The drawing and its layers, anew"), NULL);
  gimp_procedure_add_choice_argument (procedure, "picture", _ ("_Picture"), _ ("What is exported"), picture, "depth",
                                      G_PARAM_READWRITE);
  gimp_procedure_add_choice_argument (procedure, "source", _ ("_From"),
                                      _ ("Where it comes from. What was painted on the layer counts. Without a layer "
                                         "in the group Cartoon Depth it is always made anew"), source, "layer",
                                      G_PARAM_READWRITE);
  celd_file_add_argument (procedure, _ ("The file to write. The ending of its name is its kind: .exr has floats, the "
                                        "distance Z and the depth, .png has 16 bits, nearer is lighter, .tif has "
                                        "floats"));
  celd_settings_add_arguments (procedure, CELD_FOR_EXPORT);
}

const CeldProcedure celd_export_procedure = {
  .name          = "plug-in-celdepth-export-depth",
  .menu_label    = N_ ("_Export depth..."),
  .blurb         = N_ ("Writes depth to a file with enough steps for compositing and 3D programs: EXR, or PNG of 16 "
                       "bits"),
  .help          = N_ ("Writes the layer Depth or Levels of the group with the results, or makes it from the drawing "
                       "and its layers, as Pop-up does. Of an image with 8 bits, too, it has more than 256 steps. The "
                       "numbers are linear, and nearer is larger; EXR files also have the distance, channel Z."),
  .add_arguments = add_arguments,
  .run           = celd_run,
  .title         = N_ ("Export depth"),
  .file_ending   = "-depth.exr",
  .prepare       = prepare,
  .make          = make,
};
