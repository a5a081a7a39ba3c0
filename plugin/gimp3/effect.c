/* The effect of Live group, celdepth:live-popup.
 *
 * GIMP forgets its layers when a file is opened again.  So every run puts a new effect with the same settings in place
 * of the old one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#define OPACITY 0.6 /* of a new effect, so that lines and strokes shine through; chosen */

static gboolean
is_live (GimpDrawableFilter *effect)
{
  char    *operation = gimp_drawable_filter_get_operation_name (effect);
  gboolean live = !g_strcmp0 (operation, CELD_EFFECT);

  g_free (operation);
  return live;
}

gboolean
celd_effect_is_on (GimpItem *item)
{
  GimpDrawableFilter **effect = gimp_drawable_get_filters (GIMP_DRAWABLE (item));
  gboolean             found = FALSE;

  for (int i = 0; effect && effect[i]; i++)
    found = found || is_live (effect[i]);
  g_free (effect);
  return found;
}

static void
copy_settings (GimpDrawableFilter *from, GimpDrawableFilter *to)
{
  GObject     *old = G_OBJECT (gimp_drawable_filter_get_config (from));
  GObject     *new = G_OBJECT (gimp_drawable_filter_get_config (to));
  guint        n;
  GParamSpec **spec = g_object_class_list_properties (G_OBJECT_GET_CLASS (old), &n);

  for (guint i = 0; i < n; i++)
    {
      GValue value = G_VALUE_INIT;

      g_value_init (&value, spec[i]->value_type);
      g_object_get_property (old, spec[i]->name, &value);
      g_object_set_property (new, spec[i]->name, &value);
      g_value_unset (&value);
    }
  g_free (spec);
  gimp_drawable_filter_set_opacity (to, gimp_drawable_filter_get_opacity (from));
}

/* Removes effects of earlier runs, of which the new one gets the settings.  Whether they were visible. */
static gboolean
remove_old (GimpLayer *group, GimpDrawableFilter *effect)
{
  GimpDrawableFilter **old = gimp_drawable_get_filters (GIMP_DRAWABLE (group));
  gboolean             visible = TRUE, found = FALSE;

  for (int i = 0; old && old[i]; i++)
    if (is_live (old[i]))
      {
        if (!found)
          {
            copy_settings (old[i], effect);
            visible = gimp_drawable_filter_get_visible (old[i]);
          }
        gimp_drawable_filter_delete (old[i]);
        found = TRUE;
      }
  g_free (old);
  return visible;
}

gboolean
celd_effect_put (GimpLayer *group, GimpLayer *const layer[CELD_N_LAYERS])
{
  GimpDrawableFilter *effect = gimp_drawable_filter_new (GIMP_DRAWABLE (group), CELD_EFFECT, _ ("Live pop-up"));
  gboolean            visible;

  if (!effect)
    return FALSE;
  gimp_drawable_filter_set_opacity (effect, OPACITY);
  gimp_drawable_filter_set_blend_mode (effect, GIMP_LAYER_MODE_REPLACE);
  visible = remove_old (group, effect);
  for (int role = 0; role < CELD_N_LAYERS; role++) /* pads are named as arguments are */
    if (layer[role])
      gimp_drawable_filter_set_aux_input (effect, celd_layer_arguments[role], GIMP_DRAWABLE (layer[role]));
  gimp_drawable_filter_set_visible (effect, visible);
  gimp_drawable_append_filter (GIMP_DRAWABLE (group), effect);
  return TRUE;
}
