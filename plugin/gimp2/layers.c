/* Finds the layers of an image by their names, and opens their buffers.
 *
 * A group with the name of a layer is that layer, as it is seen; and so is a layer with a mask, but for its visibility,
 * opacity and mode, which say how it lies over others.  Layers inside other groups count as all others do.  Results
 * outside the group of results, such as copies, count by their names alone.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp2.h"

/* Appends the layers below a group, or of the image, from the top to the bottom, without the group of results. */
static void
list (GArray *listed, gint32 image, gint32 group)
{
  int   n;
  gint *layers = group < 0 ? gimp_image_get_layers (image, &n) : gimp_item_get_children (group, &n);

  for (int i = 0; i < n; i++)
    if (!celd_results_is_group (layers[i]))
      {
        g_array_append_val (listed, layers[i]);
        if (gimp_item_is_group (layers[i]))
          list (listed, image, layers[i]);
      }
  g_free (layers);
}

GArray *
celd_layers_list (gint32 image)
{
  GArray *listed = g_array_new (FALSE, FALSE, sizeof (gint32));

  list (listed, image, -1);
  return listed;
}

void
celd_layers_find (gint32 image, gint32 found[CELD_N_LAYERS])
{
  GArray         *listed = celd_layers_list (image);
  CeldNamedLayer *named;
  int             index[CELD_N_LAYERS];

  named = g_new (CeldNamedLayer, listed->len + 1);
  for (guint i = 0; i < listed->len; i++)
    {
      gint32 layer = g_array_index (listed, gint32, i);

      named[i] = (CeldNamedLayer) { gimp_item_get_name (layer), gimp_item_is_group (layer) ||
                                                                celd_results_is_one (layer) };
    }
  celd_layer_roles_find (named, (int) listed->len, index);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    found[role] = index[role] < 0 ? -1 : g_array_index (listed, gint32, index[role]);
  for (guint i = 0; i < listed->len; i++)
    g_free ((char *) named[i].name);
  g_free (named);
  g_array_unref (listed);
}

/* An image like another one, without a display and steps of undo, for copies. */
static gint32
image_like (gint32 image)
{
  GimpColorProfile *profile = gimp_image_get_color_profile (image);
  gint32            made = gimp_image_new_with_precision (1, 1, GIMP_RGB, gimp_image_get_precision (image));

  gimp_image_undo_disable (made);
  if (profile)
    gimp_image_set_color_profile (made, profile);
  g_clear_object (&profile);
  return made;
}

/* The pixels of a layer with its mask, in memory of their own: of a copy alone in a group, which has masks applied. */
static GeglBuffer *
masked_pixels (gint32 image, gint32 layer)
{
  gint32      own = image_like (image), group = gimp_layer_group_new (own);
  gint32      copy = gimp_layer_new_from_drawable (layer, own);
  GeglBuffer *buffer, *pixels;

  gimp_image_insert_layer (own, group, 0, 0);
  gimp_item_set_visible (copy, TRUE);
  gimp_layer_set_opacity (copy, 100);
  gimp_layer_set_mode (copy, GIMP_LAYER_MODE_NORMAL);
  gimp_image_insert_layer (own, copy, group, 0);
  if (gimp_layer_get_show_mask (copy))
    gimp_layer_set_show_mask (copy, FALSE);
  buffer = gimp_drawable_get_buffer (group);
  pixels = gegl_buffer_dup (buffer);
  g_object_unref (buffer);
  gimp_image_delete (own);
  return pixels;
}

void
celd_layers_open (gint32 image, const gint32 layer[CELD_N_LAYERS], CeldPipelineInput *input)
{
  input->width  = gimp_image_width (image);
  input->height = gimp_image_height (image);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role] >= 0)
      {
        CeldPipelineLayer *to = &input->layer[role];
        gboolean           masked = gimp_layer_get_mask (layer[role]) >= 0 && gimp_layer_get_apply_mask (layer[role]);

        to->id     = layer[role];
        to->buffer = masked ? masked_pixels (image, layer[role]) : gimp_drawable_get_buffer (layer[role]);
        gimp_drawable_offsets (layer[role], &to->x, &to->y);
      }
}

void
celd_layers_close (CeldPipelineInput *input)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&input->layer[role].buffer);
}
