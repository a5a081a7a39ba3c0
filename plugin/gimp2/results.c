/* The group with the results: its layers are found again by parasites, whatever the artist calls them and wherever the
 * group is moved, and get new pixels in place, so that opacity, mode, mask and visibility stay.  GIMP 3's plug-in marks
 * them in the same way.
 *
 * Locks are the artist's: pixels that are locked stay, and a layer whose place is locked keeps that and its size.  A
 * group locks the pixels of all that lies in it; its place cannot be locked.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp2.h"

#include <string.h>

#define GROUP_PARASITE   "celdepth-results"
#define PICTURE_PARASITE "celdepth-picture" /* with the name of a picture */

/* ------------------------------------------------------------------ parasites */

static void
mark (gint32 item, const char *name, const char *text)
{
  GimpParasite *parasite = gimp_parasite_new (name, GIMP_PARASITE_PERSISTENT | GIMP_PARASITE_UNDOABLE,
                                              (guint32) strlen (text) + 1, text);

  gimp_item_attach_parasite (item, parasite);
  gimp_parasite_free (parasite);
}

/* Whether an item is marked, with this text if that is not NULL. */
static gboolean
is_marked (gint32 item, const char *name, const char *text)
{
  GimpParasite *parasite = gimp_item_get_parasite (item, name);
  gint32        size = parasite ? (gint32) gimp_parasite_data_size (parasite) : 0;
  const char   *data = size ? gimp_parasite_data (parasite) : NULL;
  gboolean      marked = parasite && (!text || (data && !data[size - 1] && !strcmp (data, text)));

  if (parasite)
    gimp_parasite_free (parasite);
  return marked;
}

gboolean
celd_results_is_group (gint32 item)
{
  return gimp_item_is_group (item) && is_marked (item, GROUP_PARASITE, NULL);
}

gboolean
celd_results_is_one (gint32 item)
{
  return is_marked (item, PICTURE_PARASITE, NULL);
}

/* Whether the pixels of an item are locked, by itself or by a group that it lies in. */
static gboolean
is_locked (gint32 item)
{
  while (item >= 0 && !gimp_item_get_lock_content (item))
    item = gimp_item_get_parent (item);
  return item >= 0;
}

/* ------------------------------------------------------------------ finding */

/* The lowest group of results that is not locked, below a group or in the image; -1: there is none.  A copy of a group,
 * or of a layer in it, has its mark, too, and lies above: it is the artist's. */
static gint32
find_group (gint32 image, gint32 parent)
{
  int    n;
  gint  *items = parent < 0 ? gimp_image_get_layers (image, &n) : gimp_item_get_children (parent, &n);
  gint32 found = -1;

  for (int i = 0; i < n; i++)
    {
      gint32 here = -1;

      if (celd_results_is_group (items[i]))
        here = is_locked (items[i]) ? -1 : items[i];
      else if (gimp_item_is_group (items[i]))
        here = find_group (image, items[i]);
      found = here >= 0 ? here : found;
    }
  g_free (items);
  return found;
}

static gint32
get_group (gint32 image)
{
  gint32 group = find_group (image, -1);

  if (group >= 0)
    return group;
  group = gimp_layer_group_new (image);
  gimp_item_set_name (group, CELD_GROUP_NAME);
  mark (group, GROUP_PARASITE, "1");
  gimp_image_insert_layer (image, group, 0, 0);
  return group;
}

/* The lowest layer of a picture in the group; -1: there is none. */
static gint32
find_layer (gint32 group, CeldPicture picture)
{
  int    n;
  gint  *children = gimp_item_get_children (group, &n);
  gint32 found = -1;

  for (int i = 0; i < n; i++)
    if (is_marked (children[i], PICTURE_PARASITE, celd_pictures[picture].argument))
      found = children[i];
  g_free (children);
  return found;
}

/* ------------------------------------------------------------------ writing */

/* Before it belongs to the image nothing of a layer can be undone, and nothing has to be. */
static gboolean
add_layer (gint32 image, CeldPipeline *pipeline, gint32 group, CeldPicture picture, int position, gboolean visible,
           GError **error)
{
  const CeldPictureInfo *info = &celd_pictures[picture];
  gint32                 layer = gimp_layer_new (image, _ (info->layer), gimp_image_width (image),
                                                 gimp_image_height (image),
                                                 info->alpha ? GIMP_RGBA_IMAGE : GIMP_RGB_IMAGE, 100,
                                                 GIMP_LAYER_MODE_NORMAL);
  GeglBuffer            *buffer = gimp_drawable_get_buffer (layer);
  gboolean               good = celd_pipeline_write (pipeline, picture, buffer, error);

  g_object_unref (buffer); /* which sends the pixels */
  mark (layer, PICTURE_PARASITE, info->argument);
  gimp_item_set_visible (layer, visible);
  gimp_image_insert_layer (image, layer, group, position);
  return good;
}

/* The part of a picture that lies on a layer, wherever that is, into a buffer of the layer's size. */
static gboolean
write_part (gint32 image, CeldPipeline *pipeline, CeldPicture picture, gint32 layer, GeglBuffer *buffer, GError **error)
{
  GeglBuffer   *whole = gegl_buffer_new (GEGL_RECTANGLE (0, 0, gimp_image_width (image), gimp_image_height (image)),
                                         gegl_buffer_get_format (buffer));
  GeglRectangle part = *gegl_buffer_get_extent (buffer);
  gboolean      good = celd_pipeline_write (pipeline, picture, whole, error);

  gimp_drawable_offsets (layer, &part.x, &part.y);
  gegl_buffer_copy (whole, &part, GEGL_ABYSS_NONE, buffer, gegl_buffer_get_extent (buffer));
  g_object_unref (whole);
  return good;
}

/* Through the shadow buffer, which can be undone.  The caller has cleared the selection. */
static gboolean
update_layer (gint32 image, CeldPipeline *pipeline, CeldPicture picture, gint32 layer, GError **error)
{
  gboolean    lock = gimp_layer_get_lock_alpha (layer), stays = gimp_item_get_lock_position (layer), good;
  GeglBuffer *buffer;

  if (!stays)
    gimp_layer_resize_to_image_size (layer);
  gimp_layer_set_lock_alpha (layer, FALSE);
  buffer = gimp_drawable_get_shadow_buffer (layer);
  good   = stays ? write_part (image, pipeline, picture, layer, buffer, error)
                 : celd_pipeline_write (pipeline, picture, buffer, error);
  g_object_unref (buffer);
  gimp_drawable_merge_shadow (layer, TRUE);
  gimp_drawable_update (layer, 0, 0, gimp_drawable_width (layer), gimp_drawable_height (layer));
  gimp_layer_set_lock_alpha (layer, lock);
  return good;
}

static gboolean
write_all (gint32 image, CeldPipeline *pipeline, gint32 group, guint wanted, GError **error)
{
  int      n, position = 0;
  gboolean fresh, good = TRUE;

  g_free (gimp_item_get_children (group, &n));
  fresh = !n;
  for (gsize i = 0; i < CELD_POPUP_PICTURES && good; i++)
    {
      CeldPicture picture = celd_pictures_stacked[i];
      gint32      layer = find_layer (group, picture);
      gboolean    locked = layer >= 0 && is_locked (layer), make = (wanted & 1u << picture) != 0;

      if (layer < 0 && make)
        good = add_layer (image, pipeline, group, picture, position++, fresh, error);
      else if (layer >= 0 && make && !locked)
        good = update_layer (image, pipeline, picture, layer, error);
      if (layer >= 0 && !make && !locked)
        gimp_image_remove_layer (image, layer);
      else if (layer >= 0)
        position = gimp_image_get_item_position (image, layer) + 1;
      fresh = fresh && !make; /* of a new group the top layer alone is visible */
    }
  return good;
}

/* Calls write_all with nothing selected, and selects again what was: merging would be limited to the selection. */
static gboolean
write_unselected (gint32 image, CeldPipeline *pipeline, gint32 group, guint wanted, GError **error)
{
  gint32   selection = gimp_selection_is_empty (image) ? -1 : gimp_selection_save (image);
  gboolean good;

  if (selection >= 0)
    gimp_selection_none (image);
  good = write_all (image, pipeline, group, wanted, error);
  if (selection >= 0)
    {
      gimp_context_push ();
      gimp_context_set_feather (FALSE);
      gimp_image_select_item (image, GIMP_CHANNEL_OP_REPLACE, selection);
      gimp_context_pop ();
      gimp_image_remove_channel (image, selection);
    }
  return good;
}

gint32
celd_results_write (gint32 image, CeldPipeline *pipeline, const CeldChoices *choices, GError **error)
{
  gint32   active = gimp_image_get_active_layer (image), group;
  gboolean good;

  gimp_image_undo_group_start (image);
  group = get_group (image);
  good  = write_unselected (image, pipeline, group, choices->wanted, error);
  if (gimp_item_is_valid (active))
    gimp_image_set_active_layer (image, active);
  celd_choices_remember (image, choices);
  gimp_image_undo_group_end (image);
  gimp_displays_flush ();
  return good ? group : -1;
}
