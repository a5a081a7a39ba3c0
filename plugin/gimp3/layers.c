/* Finds the layers of an image, by their names or as they were chosen, and opens their buffers.
 *
 * A group with the name of a layer is that layer, as it is seen; layers inside other groups count as all others do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

/* ------------------------------------------------------------------ listing */

static CeldLayerRole
role_of (GimpLayer *layer)
{
  char         *name = gimp_item_get_name (GIMP_ITEM (layer));
  CeldLayerRole role = celd_layer_role_of_name (name);

  g_free (name);
  return role;
}

static void
list (GArray *listed, GimpLayer *layer, int depth)
{
  GimpItem **children;

  if (celd_results_is_group (GIMP_ITEM (layer)))
    return;
  g_array_append_val (listed, ((CeldListedLayer) { layer, depth }));
  if (!gimp_item_is_group (GIMP_ITEM (layer)))
    return;
  children = gimp_item_get_children (GIMP_ITEM (layer));
  for (int i = 0; children && children[i]; i++)
    list (listed, GIMP_LAYER (children[i]), depth + 1);
  g_free (children);
}

GArray *
celd_layers_list (GimpImage *image)
{
  GArray     *listed = g_array_new (FALSE, FALSE, sizeof (CeldListedLayer));
  GimpLayer **layers = gimp_image_get_layers (image);

  for (int i = 0; layers && layers[i]; i++)
    list (listed, layers[i], 0);
  g_free (layers);
  return listed;
}

/* ------------------------------------------------------------------ finding */

/* Of the layers that have no role in `found` and are no groups, the lowest; *n is their number. */
static GimpLayer *
find_others (GArray *listed, GimpLayer *const found[CELD_N_LAYERS], int *n)
{
  GimpLayer *lowest = NULL;

  *n = 0;
  for (guint i = 0; i < listed->len; i++)
    {
      GimpLayer *layer = g_array_index (listed, CeldListedLayer, i).layer;
      gboolean   other = !gimp_item_is_group (GIMP_ITEM (layer));

      for (int role = 0; role < CELD_N_LAYERS; role++)
        other = other && layer != found[role];
      if (other)
        {
          lowest = layer;
          ++*n;
        }
    }
  return lowest;
}

void
celd_layers_find (GimpImage *image, GimpLayer *found[CELD_N_LAYERS])
{
  GArray    *listed = celd_layers_list (image);
  GimpLayer *lowest;
  int        others;

  for (int role = 0; role < CELD_N_LAYERS; role++)
    found[role] = NULL;
  for (guint i = 0; i < listed->len; i++)
    {
      GimpLayer    *layer = g_array_index (listed, CeldListedLayer, i).layer;
      CeldLayerRole role = role_of (layer);

      if (role < CELD_N_LAYERS && !found[role])
        found[role] = layer;
    }
  lowest = find_others (listed, found, &others);
  if (!found[CELD_LAYER_DRAWING] && others == 1)
    found[CELD_LAYER_DRAWING] = lowest;
  g_array_unref (listed);
}

GimpLayer *
celd_layers_lowest (GimpImage *image, GimpLayer *const found[CELD_N_LAYERS])
{
  GArray    *listed = celd_layers_list (image);
  int        others;
  GimpLayer *lowest = find_others (listed, found, &others);

  g_array_unref (listed);
  return lowest;
}

/* ------------------------------------------------------------------ opening */

gboolean
celd_image_has_few_bits (GimpImage *image)
{
  GimpPrecision precision = gimp_image_get_precision (image);

  return precision == GIMP_PRECISION_U8_LINEAR || precision == GIMP_PRECISION_U8_NON_LINEAR ||
         precision == GIMP_PRECISION_U8_PERCEPTUAL;
}

gboolean
celd_layers_open (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS], CeldPipelineInput *input, GError **error)
{
  input->width  = gimp_image_get_width (image);
  input->height = gimp_image_get_height (image);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role])
      {
        CeldPipelineLayer *to = &input->layer[role];

        if (gimp_item_get_image (GIMP_ITEM (layer[role])) != image)
          {
            char *name = gimp_item_get_name (GIMP_ITEM (layer[role]));

            g_set_error (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED,
                         "The layer \"%s\" belongs to another image. Choose a layer of this image.", name);
            g_free (name);
            return FALSE;
          }
        for (int other = 0; other < role && !to->buffer; other++)
          if (layer[other] == layer[role]) /* one buffer, so that the pipeline notices */
            to->buffer = g_object_ref (input->layer[other].buffer);
        if (!to->buffer)
          to->buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer[role]));
        gimp_drawable_get_offsets (GIMP_DRAWABLE (layer[role]), &to->x, &to->y);
      }
  return TRUE;
}

void
celd_layers_close (CeldPipelineInput *input)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&input->layer[role].buffer);
}
