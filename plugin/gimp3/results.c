/* The group with the results: its layers are found again by parasites, whatever the artist calls them and wherever the
 * group is moved, and get new pixels in place, so that opacity, mode, mask and visibility stay.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <string.h>

#define GROUP_PARASITE "celdepth-results"
#define GROUP_NAME     "Cartoon Depth"

/* From the top of the group to the bottom.  Pictures that show numbers or light alone have no alpha. */
static const struct { CeldPicture picture; const char *name; GimpImageType type; } layers[CELD_POPUP_PICTURES] = {
  { CELD_PICTURE_ENHANCED, "Drawing with shadows", GIMP_RGBA_IMAGE },
  { CELD_PICTURE_LIT,      "Lit drawing",          GIMP_RGBA_IMAGE },
  { CELD_PICTURE_SHADING,  "Shading",              GIMP_RGB_IMAGE },
  { CELD_PICTURE_NORMALS,  "Normal map",           GIMP_RGB_IMAGE },
  { CELD_PICTURE_DEPTH,    "Depth",                GIMP_RGB_IMAGE },
  { CELD_PICTURE_LEVELS,   "Levels",               GIMP_RGB_IMAGE },
  { CELD_PICTURE_REGIONS,  "Regions",              GIMP_RGBA_IMAGE },
};

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

/* ------------------------------------------------------------------ finding */

/* The first group of results that is not locked, among these items and inside them. */
static GimpItem *
find_group (GimpItem **items)
{
  GimpItem *found = NULL;

  for (int i = 0; items && items[i] && !found; i++)
    if (celd_results_is_group (items[i]))
      found = gimp_item_get_lock_content (items[i]) ? NULL : items[i];
    else if (gimp_item_is_group (items[i]))
      {
        GimpItem **children = gimp_item_get_children (items[i]);

        found = find_group (children);
        g_free (children);
      }
  return found;
}

static GimpGroupLayer *
get_group (GimpImage *image)
{
  GimpLayer     **top = gimp_image_get_layers (image);
  GimpItem       *found = find_group ((GimpItem **) top);
  GimpGroupLayer *group;

  g_free (top);
  if (found)
    return GIMP_GROUP_LAYER (found);
  group = gimp_group_layer_new (image, GROUP_NAME);
  celd_item_mark (group, GROUP_PARASITE, "1");
  gimp_image_insert_layer (image, GIMP_LAYER (group), NULL, 0);
  return group;
}

/* The layer of a picture in the group; NULL: there is none. */
static GimpLayer *
find_layer (GimpGroupLayer *group, CeldPicture picture)
{
  GimpItem **children = gimp_item_get_children (GIMP_ITEM (group));
  GimpLayer *found = NULL;

  for (int i = 0; children && children[i] && !found; i++)
    if (celd_item_is_marked (children[i], CELD_PICTURE_MARK, celd_picture_arguments[picture]))
      found = GIMP_LAYER (children[i]);
  g_free (children);
  return found;
}

/* ------------------------------------------------------------------ writing */

/* Before it belongs to the image nothing of a layer can be undone, and nothing has to be. */
static gboolean
add_layer (GimpImage *image, CeldPipeline *pipeline, GimpGroupLayer *group, gsize i, int position, gboolean visible,
           GError **error)
{
  int         w = gimp_image_get_width (image), h = gimp_image_get_height (image);
  GimpLayer  *layer = gimp_layer_new (image, layers[i].name, w, h, layers[i].type, 100, GIMP_LAYER_MODE_NORMAL);
  GeglBuffer *buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (layer));
  gboolean    good = celd_pipeline_write (pipeline, layers[i].picture, buffer, error);

  g_object_unref (buffer); /* which sends the pixels */
  celd_item_mark (layer, CELD_PICTURE_MARK, celd_picture_arguments[layers[i].picture]);
  gimp_item_set_visible (GIMP_ITEM (layer), visible);
  gimp_image_insert_layer (image, layer, GIMP_LAYER (group), position);
  return good;
}

/* Through the shadow buffer, which can be undone.  The caller has cleared the selection. */
static gboolean
update_layer (CeldPipeline *pipeline, CeldPicture picture, GimpLayer *layer, GError **error)
{
  GimpDrawable *drawable = GIMP_DRAWABLE (layer);
  gboolean      lock = gimp_layer_get_lock_alpha (layer), good;
  GeglBuffer   *buffer;

  gimp_layer_resize_to_image_size (layer);
  gimp_layer_set_lock_alpha (layer, FALSE);
  buffer = gimp_drawable_get_shadow_buffer (drawable);
  good   = celd_pipeline_write (pipeline, picture, buffer, error);
  g_object_unref (buffer);
  gimp_drawable_merge_shadow (drawable, TRUE);
  gimp_drawable_update (drawable, 0, 0, gimp_drawable_get_width (drawable), gimp_drawable_get_height (drawable));
  gimp_layer_set_lock_alpha (layer, lock);
  return good;
}

static gboolean
write_all (GimpImage *image, CeldPipeline *pipeline, GimpGroupLayer *group, guint wanted, GError **error)
{
  GimpItem **children = gimp_item_get_children (GIMP_ITEM (group));
  gboolean   fresh = !children || !children[0], good = TRUE;
  int        position = 0;

  g_free (children);
  for (gsize i = 0; i < CELD_POPUP_PICTURES && good; i++)
    {
      GimpLayer *layer = find_layer (group, layers[i].picture);
      gboolean   locked = layer && gimp_item_get_lock_content (GIMP_ITEM (layer));

      if (!(wanted & 1u << layers[i].picture))
        {
          if (layer && !locked)
            gimp_image_remove_layer (image, layer);
          continue;
        }
      if (!layer)
        good = add_layer (image, pipeline, group, i, position++, fresh, error);
      else if (!locked)
        good = update_layer (pipeline, layers[i].picture, layer, error);
      if (layer)
        position = gimp_image_get_item_position (image, GIMP_ITEM (layer)) + 1;
      fresh = FALSE; /* of a new group the top layer alone is visible */
    }
  return good;
}

/* Calls write_all with nothing selected, and selects again what was: merging would be limited to the selection. */
static gboolean
write_unselected (GimpImage *image, CeldPipeline *pipeline, GimpGroupLayer *group, guint wanted, GError **error)
{
  GimpChannel *selection = gimp_selection_is_empty (image) ? NULL : gimp_selection_save (image);
  gboolean     good;

  if (selection)
    gimp_selection_none (image);
  good = write_all (image, pipeline, group, wanted, error);
  if (selection)
    {
      gimp_context_push ();
      gimp_context_set_feather (FALSE);
      gimp_image_select_item (image, GIMP_CHANNEL_OP_REPLACE, GIMP_ITEM (selection));
      gimp_context_pop ();
      gimp_image_remove_channel (image, selection);
    }
  return good;
}

GimpGroupLayer *
celd_results_write (GimpImage *image, CeldPipeline *pipeline, guint wanted, GError **error)
{
  GimpGroupLayer *group = get_group (image);

  return write_unselected (image, pipeline, group, wanted, error) ? group : NULL;
}
