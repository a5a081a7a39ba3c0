/* The group with the results: its layers are found again by parasites, whatever the artist calls them and wherever the
 * group is moved, and get new pixels in place, so that opacity, mode, mask and visibility stay.
 *
 * Locks are the artist's: pixels that are locked stay, and a layer whose place is locked keeps that and its size.  A
 * group locks all that lies in it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <string.h>

#define GROUP_PARASITE "celdepth-results"

/* ------------------------------------------------------------------ parasites */

void
celd_item_mark (gpointer item, const char *name, const char *text)
{
  GimpParasite *parasite = gimp_parasite_new (name, GIMP_PARASITE_PERSISTENT | GIMP_PARASITE_UNDOABLE,
                                              (guint32) strlen (text) + 1, text);

  gimp_item_attach_parasite (GIMP_ITEM (item), parasite);
  gimp_parasite_free (parasite);
}

gboolean
celd_item_is_marked (GimpItem *item, const char *name, const char *text)
{
  GimpParasite *parasite = gimp_item_get_parasite (item, name);
  guint32       size = 0;
  const char   *data = parasite ? gimp_parasite_get_data (parasite, &size) : NULL;
  gboolean      marked = parasite && (!text || (size && !data[size - 1] && !strcmp (data, text)));

  if (parasite)
    gimp_parasite_free (parasite);
  return marked;
}

gboolean
celd_results_is_group (GimpItem *item)
{
  return gimp_item_is_group (item) && celd_item_is_marked (item, GROUP_PARASITE, NULL);
}

/* ------------------------------------------------------------------ locks */

/* Whether an item has one kind of lock, or a group that it lies in. */
static gboolean
has_lock (GimpItem *item, gboolean (*get_lock) (GimpItem *item))
{
  while (item && !get_lock (item))
    item = gimp_item_get_parent (item);
  return item != NULL;
}

gboolean
celd_item_is_locked (gpointer item)
{
  return has_lock (GIMP_ITEM (item), gimp_item_get_lock_content);
}

/* ------------------------------------------------------------------ finding */

/* The lowest group of results among these items and inside them, that is locked or that is not.  A copy of a group, or
 * of a layer in it, has its mark, too, and lies above: it is the artist's. */
static GimpItem *
find_group (GimpItem **items, gboolean locked)
{
  GimpItem *found = NULL;

  for (int i = 0; items && items[i]; i++)
    {
      GimpItem *here = NULL;

      if (celd_results_is_group (items[i]))
        here = celd_item_is_locked (items[i]) == locked ? items[i] : NULL;
      else if (gimp_item_is_group (items[i]))
        {
          GimpItem **children = gimp_item_get_children (items[i]);

          here = find_group (children, locked);
          g_free (children);
        }
      found = here ? here : found;
    }
  return found;
}

static GimpItem *
find_group_of_image (GimpImage *image, gboolean locked)
{
  GimpLayer **top = gimp_image_get_layers (image);
  GimpItem   *found = find_group ((GimpItem **) top, locked);

  g_free (top);
  return found;
}

static GimpGroupLayer *
get_group (GimpImage *image)
{
  GimpItem       *found = find_group_of_image (image, FALSE);
  GimpGroupLayer *group;

  if (found)
    return GIMP_GROUP_LAYER (found);
  group = gimp_group_layer_new (image, CELD_GROUP_NAME);
  celd_item_mark (group, GROUP_PARASITE, "1");
  gimp_image_insert_layer (image, GIMP_LAYER (group), NULL, 0);
  return group;
}

/* The lowest layer with this mark in the group; NULL: there is none. */
static GimpLayer *
find_layer (GimpItem *group, const char *mark)
{
  GimpItem **children = group ? gimp_item_get_children (group) : NULL;
  GimpLayer *found = NULL;

  for (int i = 0; children && children[i]; i++)
    if (celd_item_is_marked (children[i], CELD_PICTURE_MARK, mark))
      found = GIMP_LAYER (children[i]);
  g_free (children);
  return found;
}

GimpLayer *
celd_results_find (GimpImage *image, const char *mark)
{
  GimpLayer *layer = find_layer (find_group_of_image (image, FALSE), mark);

  return layer ? layer : find_layer (find_group_of_image (image, TRUE), mark);
}

GimpLayer *
celd_results_find_unlocked (GimpImage *image, const char *mark)
{
  GimpLayer *layer = find_layer (find_group_of_image (image, FALSE), mark);

  return layer && !celd_item_is_locked (layer) ? layer : NULL;
}

/* ------------------------------------------------------------------ writing */

typedef struct
{
  GimpImage         *image;
  CeldPipeline      *pipeline;
  GimpGroupLayer    *group;
  const CeldResults *results;
  guint              wanted;
} Writing;

static gboolean
write_pixels (const Writing *w, const CeldResultLayer *l, GeglBuffer *buffer, GError **error)
{
  return w->results->write (w->pipeline, l->picture, w->results->data, buffer, error);
}

/* Before it belongs to the image nothing of a layer can be undone, and nothing has to be. */
static gboolean
add_layer (const Writing *w, const CeldResultLayer *l, int position, gboolean visible, GError **error)
{
  GimpLayer  *layer = gimp_layer_new (w->image, _ (l->name), gimp_image_get_width (w->image),
                                      gimp_image_get_height (w->image), l->type, 100, GIMP_LAYER_MODE_NORMAL);
  GeglBuffer *buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer));
  gboolean    good = write_pixels (w, l, buffer, error);

  g_object_unref (buffer); /* which sends the pixels */
  celd_item_mark (layer, CELD_PICTURE_MARK, l->mark);
  gimp_item_set_visible (GIMP_ITEM (layer), visible);
  gimp_image_insert_layer (w->image, layer, GIMP_LAYER (w->group), position);
  return good;
}

/* The part of a picture that lies on a layer, wherever that is, into a buffer of the layer's size. */
static gboolean
write_part (const Writing *w, const CeldResultLayer *l, GimpDrawable *drawable, GeglBuffer *buffer, GError **error)
{
  GeglBuffer   *whole = gegl_buffer_new (GEGL_RECTANGLE (0, 0, gimp_image_get_width (w->image),
                                                         gimp_image_get_height (w->image)),
                                         gegl_buffer_get_format (buffer));
  GeglRectangle part = *gegl_buffer_get_extent (buffer);
  gboolean      good = write_pixels (w, l, whole, error);

  gimp_drawable_get_offsets (drawable, &part.x, &part.y);
  gegl_buffer_copy (whole, &part, GEGL_ABYSS_NONE, buffer, gegl_buffer_get_extent (buffer));
  g_object_unref (whole);
  return good;
}

/* Through the shadow buffer, which can be undone.  The caller has cleared the selection. */
static gboolean
update_layer (const Writing *w, const CeldResultLayer *l, GimpLayer *layer, GError **error)
{
  GimpDrawable *drawable = GIMP_DRAWABLE (layer);
  gboolean      lock = gimp_layer_get_lock_alpha (layer), stays, good;
  GeglBuffer   *buffer;

  stays = has_lock (GIMP_ITEM (layer), gimp_item_get_lock_position);
  if (!stays)
    gimp_layer_resize_to_image_size (layer);
  gimp_layer_set_lock_alpha (layer, FALSE);
  buffer = gimp_drawable_get_shadow_buffer (drawable);
  good   = stays ? write_part (w, l, drawable, buffer, error) : write_pixels (w, l, buffer, error);
  g_object_unref (buffer);
  gimp_drawable_merge_shadow (drawable, TRUE);
  gimp_drawable_update (drawable, 0, 0, gimp_drawable_get_width (drawable), gimp_drawable_get_height (drawable));
  gimp_layer_set_lock_alpha (layer, lock);
  return good;
}

/* Of a new group, or always, the first new layer alone is visible. */
static gboolean
write_all (const Writing *w, GError **error)
{
  GimpItem **children = gimp_item_get_children (GIMP_ITEM (w->group));
  gboolean   show = w->results->show || !children || !children[0], good = TRUE;
  int        position = 0;

  g_free (children);
  for (gsize i = 0; i < w->results->n && good; i++)
    {
      const CeldResultLayer *l = &w->results->layer[i];
      GimpLayer             *layer = find_layer (GIMP_ITEM (w->group), l->mark);
      gboolean               locked = layer && celd_item_is_locked (layer);
      gboolean               make = (w->wanted & 1u << l->picture) != 0;

      if (!layer && make)
        good = add_layer (w, l, position++, show, error);
      else if (layer && make && !locked)
        good = update_layer (w, l, layer, error);
      if (layer && !make && !locked)
        gimp_image_remove_layer (w->image, layer);
      else if (layer)
        position = gimp_image_get_item_position (w->image, GIMP_ITEM (layer)) + 1;
      show = show && !make;
    }
  return good;
}

GimpChannel *
celd_selection_clear (GimpImage *image)
{
  GimpChannel *selection = gimp_selection_is_empty (image) ? NULL : gimp_selection_save (image);

  if (selection)
    gimp_selection_none (image);
  return selection;
}

void
celd_selection_restore (GimpImage *image, GimpChannel *selection)
{
  if (!selection)
    return;
  gimp_context_push ();
  gimp_context_set_feather (FALSE);
  gimp_image_select_item (image, GIMP_CHANNEL_OP_REPLACE, GIMP_ITEM (selection));
  gimp_context_pop ();
  gimp_image_remove_channel (image, selection);
}

GimpGroupLayer *
celd_results_write (GimpImage *image, CeldPipeline *pipeline, const CeldResults *results, guint wanted, GError **error)
{
  Writing      w = { image, pipeline, get_group (image), results, wanted };
  GimpChannel *selection = celd_selection_clear (image); /* merging would be limited to it */
  gboolean     good = write_all (&w, error);

  celd_selection_restore (image, selection);
  return good ? w.group : NULL;
}
