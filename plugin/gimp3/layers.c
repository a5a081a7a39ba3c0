/* Finds the layers of an image, by their names or as they were chosen, and opens their buffers.
 *
 * A group with the name of a layer is that layer, as it is seen; and so is a layer with a mask or with effects, but for
 * its visibility, opacity and mode, which say how it lies over others.  Layers inside other groups count as all others
 * do.  Results outside the group of results (suggested arrows, layers that were split, copies) count by their names
 * alone.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

char *
celd_item_name (gpointer item)
{
  char *name = gimp_item_get_name (GIMP_ITEM (item));

  return name ? name : g_strdup ("");
}

/* ------------------------------------------------------------------ listing */

static void list (GArray *listed, GimpLayer *layer, int depth);

static void
list_children (GArray *listed, GimpLayer *group, int depth)
{
  GimpItem **children = gimp_item_get_children (GIMP_ITEM (group));

  for (int i = 0; children && children[i]; i++)
    list (listed, GIMP_LAYER (children[i]), depth);
  g_free (children);
}

static void
list (GArray *listed, GimpLayer *layer, int depth)
{
  if (celd_results_is_group (GIMP_ITEM (layer)))
    return;
  g_array_append_val (listed, ((CeldListedLayer) { layer, depth }));
  if (gimp_item_is_group (GIMP_ITEM (layer)))
    list_children (listed, layer, depth + 1);
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

/* What the layers are called, as many as are listed; free_names frees it. */
static CeldNamedLayer *
get_names (const GArray *listed)
{
  CeldNamedLayer *named = g_new (CeldNamedLayer, listed->len + 1);

  for (guint i = 0; i < listed->len; i++)
    {
      GimpItem *item = GIMP_ITEM (g_array_index (listed, CeldListedLayer, i).layer);

      named[i] = (CeldNamedLayer) { celd_item_name (item), gimp_item_is_group (item) ||
                                                           celd_item_is_marked (item, CELD_PICTURE_MARK, NULL) };
    }
  return named;
}

static void
free_names (CeldNamedLayer *named, guint n)
{
  for (guint i = 0; i < n; i++)
    g_free ((char *) named[i].name);
  g_free (named);
}

static void
find (const GArray *listed, GimpLayer *found[CELD_N_LAYERS])
{
  CeldNamedLayer *named = get_names (listed);
  int             index[CELD_N_LAYERS];

  celd_layer_roles_find (named, (int) listed->len, index);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    found[role] = index[role] < 0 ? NULL : g_array_index (listed, CeldListedLayer, index[role]).layer;
  free_names (named, listed->len);
}

void
celd_layers_find (GimpImage *image, GimpLayer *found[CELD_N_LAYERS])
{
  GArray *listed = celd_layers_list (image);

  find (listed, found);
  g_array_unref (listed);
}

void
celd_layers_find_inside (GimpLayer *group, GimpLayer *found[CELD_N_LAYERS])
{
  GArray *listed = g_array_new (FALSE, FALSE, sizeof (CeldListedLayer));

  list_children (listed, group, 0);
  find (listed, found);
  g_array_unref (listed);
}

GimpLayer *
celd_layers_lowest (GimpImage *image, GimpLayer *const found[CELD_N_LAYERS])
{
  GArray         *listed = celd_layers_list (image);
  CeldNamedLayer *named = get_names (listed);
  int             index[CELD_N_LAYERS], last;
  GimpLayer      *lowest;

  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      index[role] = -1;
      for (guint i = 0; found[role] && i < listed->len; i++)
        if (g_array_index (listed, CeldListedLayer, i).layer == found[role])
          index[role] = (int) i;
    }
  last = celd_layer_roles_last (named, (int) listed->len, index, NULL);
  free_names (named, listed->len);
  lowest = last < 0 ? NULL : g_array_index (listed, CeldListedLayer, last).layer;
  g_array_unref (listed);
  return lowest;
}

/* ------------------------------------------------------------------ what is seen */

GimpImage *
celd_image_like (GimpImage *image, int width, int height)
{
  GimpColorProfile *profile = gimp_image_get_color_profile (image);
  GimpImage        *made = gimp_image_new_with_precision (width, height, GIMP_RGB, gimp_image_get_precision (image));

  gimp_image_undo_disable (made);
  if (profile)
    gimp_image_set_color_profile (made, profile);
  g_clear_object (&profile);
  return made;
}

gboolean
celd_layer_is_plain (GimpLayer *layer)
{
  GimpDrawableFilter **effect = gimp_drawable_get_filters (GIMP_DRAWABLE (layer));
  gboolean             plain = !gimp_layer_get_mask (layer) || !gimp_layer_get_apply_mask (layer);

  for (int i = 0; effect && effect[i]; i++)
    plain = plain && !gimp_drawable_filter_get_visible (effect[i]);
  g_free (effect);
  return plain;
}

/* The pixels of a group are those of its layers with their masks and effects. */
CeldPipelineLayer
celd_layer_seen (GimpLayer *layer, GimpImage *own)
{
  CeldPipelineLayer seen = { NULL, 0, 0, gimp_item_get_id (GIMP_ITEM (layer)) };
  GimpLayer        *copy = gimp_layer_new_from_drawable (GIMP_DRAWABLE (layer), own), *group;
  GeglBuffer       *buffer;

  if (!copy)
    return seen;
  group = GIMP_LAYER (gimp_group_layer_new (own, NULL));
  gimp_image_insert_layer (own, group, NULL, 0);
  gimp_item_set_visible (GIMP_ITEM (copy), TRUE);
  gimp_layer_set_opacity (copy, 100);
  gimp_layer_set_mode (copy, GIMP_LAYER_MODE_NORMAL);
  gimp_image_insert_layer (own, copy, group, 0);
  if (gimp_layer_get_show_mask (copy))
    gimp_layer_set_show_mask (copy, FALSE);
  gimp_drawable_get_offsets (GIMP_DRAWABLE (group), &seen.x, &seen.y);
  buffer      = gimp_drawable_get_buffer (GIMP_DRAWABLE (group));
  seen.buffer = gegl_buffer_dup (buffer);
  g_object_unref (buffer);
  gimp_image_remove_layer (own, group);
  return seen;
}

/* ------------------------------------------------------------------ opening */

gboolean
celd_image_has_few_bits (GimpImage *image)
{
  GimpPrecision precision = gimp_image_get_precision (image);

  return precision == GIMP_PRECISION_U8_LINEAR || precision == GIMP_PRECISION_U8_NON_LINEAR ||
         precision == GIMP_PRECISION_U8_PERCEPTUAL;
}

static CeldPipelineLayer
open_layer (GimpImage *image, GimpLayer *layer)
{
  CeldPipelineLayer opened = { NULL, 0, 0, gimp_item_get_id (GIMP_ITEM (layer)) };
  GimpImage        *own;

  if (celd_layer_is_plain (layer))
    {
      opened.buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer));
      gimp_drawable_get_offsets (GIMP_DRAWABLE (layer), &opened.x, &opened.y);
      return opened;
    }
  own    = celd_image_like (image, 1, 1);
  opened = celd_layer_seen (layer, own);
  gimp_image_delete (own);
  return opened;
}

gboolean
celd_layers_open (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS], CeldPipelineInput *input, GError **error)
{
  input->width  = gimp_image_get_width (image);
  input->height = gimp_image_get_height (image);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role] && gimp_item_get_image (GIMP_ITEM (layer[role])) != image)
      {
        char *name = celd_item_name (layer[role]);

        g_set_error (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED,
                     _ ("The layer \"%s\" belongs to another image. Choose a layer of this image."), name);
        g_free (name);
        return FALSE;
      }
    else if (layer[role])
      input->layer[role] = open_layer (image, layer[role]);
  return TRUE;
}

void
celd_layers_close (CeldPipelineInput *input)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&input->layer[role].buffer);
}
