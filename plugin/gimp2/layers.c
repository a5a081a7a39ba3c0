/* Finds the layers of an image by their names, and opens their buffers.
 *
 * A group with the name of a layer is that layer, as it is seen; layers inside other groups count as all others do.
 * Results outside the group of results, such as copies, count by their names alone.
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

void
celd_layers_open (gint32 image, const gint32 layer[CELD_N_LAYERS], CeldPipelineInput *input)
{
  input->width  = gimp_image_width (image);
  input->height = gimp_image_height (image);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role] >= 0)
      {
        input->layer[role].id     = layer[role];
        input->layer[role].buffer = gimp_drawable_get_buffer (layer[role]);
        gimp_drawable_offsets (layer[role], &input->layer[role].x, &input->layer[role].y);
      }
}

void
celd_layers_close (CeldPipelineInput *input)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&input->layer[role].buffer);
}
