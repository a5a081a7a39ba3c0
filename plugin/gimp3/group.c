/* Live group: depth as an effect on a layer group, which follows what is painted on the layers in it.
 *
 * GIMP goes on with the old pixels of a layer that was resized, and reads all layers from the upper left corner of the
 * group.  So every run gives the layers the rectangle of the group, and connects them with a new effect.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

/* With the name of the layer, if there is one. */
static gboolean
fail (GError **error, const char *format, GimpLayer *layer)
{
  char *name = layer ? gimp_item_get_name (GIMP_ITEM (layer)) : NULL;

  g_set_error (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, format, name);
  g_free (name);
  return FALSE;
}

/* ------------------------------------------------------------------ the group */

/* The topmost group with the effect; NULL: there is none. */
static GimpLayer *
find_live_group (GimpImage *image)
{
  GArray    *listed = celd_layers_list (image);
  GimpLayer *found = NULL;

  for (guint i = 0; i < listed->len && !found; i++)
    {
      GimpItem *item = GIMP_ITEM (g_array_index (listed, CeldListedLayer, i).layer);

      if (gimp_item_is_group (item) && celd_effect_is_on (item))
        found = GIMP_LAYER (item);
    }
  g_array_unref (listed);
  return found;
}

static gboolean
is_one_of (GimpLayer *const layer[CELD_N_LAYERS], GimpLayer *one)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role] == one)
      return TRUE;
  return FALSE;
}

/* Whether it is a group of the artist's that is not one of the layers itself. */
static gboolean
can_be_live (GimpItem *item, GimpLayer *const layer[CELD_N_LAYERS])
{
  char    *name = gimp_item_get_name (item);
  gboolean can = gimp_item_is_group (item) && !celd_results_is_group (item) &&
                 celd_layer_role_of_name (name) == CELD_N_LAYERS && !is_one_of (layer, GIMP_LAYER (item));

  g_free (name);
  return can;
}

/* The group with the effect around what is selected, the group that is selected, or any group with the effect; NULL:
 * there is none. */
static GimpLayer *
find_group (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS])
{
  GimpLayer **selected = gimp_image_get_selected_layers (image);
  GimpItem   *first = selected && selected[0] ? GIMP_ITEM (selected[0]) : NULL;

  g_free (selected);
  for (GimpItem *item = first; item; item = gimp_item_get_parent (item))
    if (gimp_item_is_group (item) && celd_effect_is_on (item))
      return GIMP_LAYER (item);
  return first && can_be_live (first, layer) ? GIMP_LAYER (first) : find_live_group (image);
}

static gboolean
lies_in (GimpLayer *layer, GimpLayer *group)
{
  GimpItem *parent = gimp_item_get_parent (GIMP_ITEM (layer));

  while (parent && parent != GIMP_ITEM (group))
    parent = gimp_item_get_parent (parent);
  return parent != NULL;
}

/* Layers that do not lie in the group, where GIMP does not follow them, give way to those of their names in it. */
static void
stay_inside (GimpLayer *group, GimpLayer *layer[CELD_N_LAYERS])
{
  GimpLayer *named[CELD_N_LAYERS];
  gboolean   missing[CELD_N_LAYERS];

  celd_layers_find_inside (group, named);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      missing[role] = layer[role] ? !lies_in (layer[role], group) : role == CELD_LAYER_DRAWING;
      if (missing[role])
        layer[role] = NULL;
    }
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (missing[role] && !is_one_of (layer, named[role]))
      layer[role] = named[role];
}

static gboolean
check (GimpLayer *group, GimpLayer *const layer[CELD_N_LAYERS], GError **error)
{
  if (!gegl_has_operation (CELD_EFFECT))
    return fail (error, _ ("GIMP does not find the operation celdepth:live-popup. Install celdepth's operations for "
                           "GEGL, of the same version as this plug-in, and start GIMP again."), NULL);
  if (group && gimp_layer_get_mode (group) == GIMP_LAYER_MODE_PASS_THROUGH)
    return fail (error, _ ("The group \"%s\" has the mode Pass through, in which GIMP does not follow strokes. Set the "
                           "mode of the group to Normal."), group);
  if (!layer[CELD_LAYER_DRAWING])
    return fail (error, group ? _ ("The group \"%s\" has no layer named \"Drawing\". Give the layer with the lines "
                                   "that name, or put several ones into a group of that name.")
                              : _ ("There is no layer named \"Drawing\", and there are several that could be it. Name "
                                   "it."), group);
  if (!layer[CELD_LAYER_SCRIBBLES])
    return fail (error, group ? _ ("The group \"%s\" has no layer named \"Scribbles\". Move one into it, or make it "
                                   "with Cartoon Depth > Set up layers.")
                              : _ ("There is no layer named \"Scribbles\". Make it with Cartoon Depth > Set up "
                                   "layers."), group);
  return TRUE;
}

/* A group in place of the topmost of the layers, with all of them in their order. */
static GimpLayer *
make_group (GimpImage *image, GimpLayer *const layer[CELD_N_LAYERS])
{
  GArray    *listed = celd_layers_list (image);
  GimpLayer *group = GIMP_LAYER (gimp_group_layer_new (image, _ ("Live group")));
  int        position = 0;

  gimp_layer_set_mode (group, GIMP_LAYER_MODE_NORMAL);
  for (guint i = 0; i < listed->len; i++)
    {
      GimpItem *item = GIMP_ITEM (g_array_index (listed, CeldListedLayer, i).layer);
      GimpItem *parent = gimp_item_get_parent (item);

      if (!is_one_of (layer, GIMP_LAYER (item)))
        continue;
      if (!position)
        gimp_image_insert_layer (image, group, parent ? GIMP_LAYER (parent) : NULL,
                                 gimp_image_get_item_position (image, item));
      gimp_image_reorder_item (image, item, GIMP_ITEM (group), position++);
    }
  g_array_unref (listed);
  return group;
}

/* ------------------------------------------------------------------ the layers */

typedef struct { int x, y, width, height; } Box;

static Box
box_of (GimpLayer *layer)
{
  Box box = { .width = gimp_drawable_get_width (GIMP_DRAWABLE (layer)),
              .height = gimp_drawable_get_height (GIMP_DRAWABLE (layer)) };

  gimp_drawable_get_offsets (GIMP_DRAWABLE (layer), &box.x, &box.y);
  return box;
}

/* What is added is transparent.  The drawing is usually locked against strokes, which it stays. */
static void
resize (GimpLayer *layer, Box from, Box to)
{
  GimpItem *item = GIMP_ITEM (layer);
  gboolean  content = gimp_item_get_lock_content (item), position = gimp_item_get_lock_position (item);

  gimp_item_set_lock_content (item, FALSE);
  gimp_item_set_lock_position (item, FALSE);
  if (!gimp_drawable_has_alpha (GIMP_DRAWABLE (layer)))
    gimp_layer_add_alpha (layer);
  gimp_layer_resize (layer, to.width, to.height, from.x - to.x, from.y - to.y);
  gimp_item_set_lock_content (item, content);
  gimp_item_set_lock_position (item, position);
}

/* The topmost layer in a group, which becomes as large as that; or the layer itself, if it is none.  NULL: the group is
 * empty. */
static GimpLayer *
inside (GimpLayer *layer)
{
  while (layer && gimp_item_is_group (GIMP_ITEM (layer)))
    {
      GimpItem **children = gimp_item_get_children (GIMP_ITEM (layer));

      layer = children && children[0] ? GIMP_LAYER (children[0]) : NULL;
      g_free (children);
    }
  return layer;
}

/* Gives the layers the rectangle of the group. */
static void
fit (GimpLayer *group, GimpLayer *const layer[CELD_N_LAYERS])
{
  Box whole = box_of (group);

  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (layer[role])
      {
        Box        box = box_of (layer[role]);
        GimpLayer *one = inside (layer[role]);

        if (one && (box.x != whole.x || box.y != whole.y || box.width != whole.width || box.height != whole.height))
          resize (one, box_of (one), whole);
      }
}

/* ------------------------------------------------------------------ the procedure */

/* In one step of undo. */
static GimpLayer *
make_live (GimpImage *image, GError **error)
{
  GimpLayer   *layer[CELD_N_LAYERS], *group;
  GimpChannel *selection;
  gboolean     good;

  if (!celd_image_check (image, error))
    return NULL;
  celd_layers_kept (image, layer);
  group = find_group (image, layer);
  if (group)
    stay_inside (group, layer);
  if (!check (group, layer, error))
    return NULL;
  gimp_image_undo_group_start (image);
  selection = celd_selection_clear (image); /* the effect would be limited to it */
  if (!group)
    {
      group = make_group (image, layer);
      gimp_image_set_selected_layers (image, (const GimpLayer *[]) { layer[CELD_LAYER_SCRIBBLES], NULL });
    }
  fit (group, layer);
  good = celd_effect_put (group, layer) ||
         fail (error, _ ("GIMP cannot make the effect on the group \"%s\"."), group);
  celd_selection_restore (image, selection);
  gimp_image_undo_group_end (image);
  gimp_displays_flush ();
  return good ? group : NULL;
}

static GimpValueArray *
run (GimpProcedure *procedure, GimpRunMode run_mode, GimpImage *image, GimpDrawable **drawables,
     GimpProcedureConfig *config, gpointer run_data)
{
  GError         *error = NULL;
  GimpValueArray *values;
  GimpLayer      *group;

  (void) run_mode;
  (void) drawables;
  (void) config;
  (void) run_data;
  gegl_init (NULL, NULL);
  group  = make_live (image, &error);
  values = gimp_procedure_new_return_values (procedure, group ? GIMP_PDB_SUCCESS : GIMP_PDB_EXECUTION_ERROR, error);
  if (group)
    g_value_set_object (gimp_value_array_index (values, 1), group);
  return values;
}

static void
add_arguments (GimpProcedure *procedure)
{
  gimp_procedure_add_group_layer_return_value (procedure, "group", "Group", "The live group", FALSE,
                                               G_PARAM_READWRITE);
}

const CeldProcedure celd_group_procedure = {
  .name          = "plug-in-celdepth-live-group",
  .menu_label    = N_ ("Live _group"),
  .blurb         = N_ ("Shows depth over a layer group, and follows what is painted on the layers in it"),
  .help          = N_ ("Puts an effect on the group that is selected, or on a new one of the layers Drawing, "
                       "Scribbles, Arrows, Contours, Corrections and Hidden. Choose it again after the file was opened "
                       "or a layer was resized: the effect is connected with the layers again, and keeps the "
                       "settings that were changed in it."),
  .add_arguments = add_arguments,
  .run           = run,
};
