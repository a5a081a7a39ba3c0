/* The effect of Live group, celdepth:live-popup.
 *
 * GIMP forgets its layers when a file is opened again.  So every run puts a new effect with the same settings in place
 * of the old one.
 *
 * The effect is given what Pop-up reads beside the layers: settings and relations that are kept with the image, and
 * paths that are arrows.  What was given is kept with the group.  A property that differs from that when the effect is
 * replaced was set by the artist, and stays as it is.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <math.h>
#include <string.h>

#include "moved-relations.h"

#define GIVEN_MARK "celdepth-given"
#define OPACITY 0.6    /* of a new effect, so that lines and strokes shine through; chosen */
#define PRECISION 1e-6 /* numbers in GIMP's files have 24 bits; chosen */

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

/* ------------------------------------------------------------------ an effect that is replaced */

/* The effect of an earlier run, of which the new one gets the settings; NULL: there is none. */
static GimpDrawableFilter *
find_old (GimpLayer *group)
{
  GimpDrawableFilter **effect = gimp_drawable_get_filters (GIMP_DRAWABLE (group)), *found = NULL;

  for (int i = 0; effect && effect[i] && !found; i++)
    if (is_live (effect[i]))
      found = effect[i];
  g_free (effect);
  return found;
}

static void
remove_old (GimpLayer *group)
{
  GimpDrawableFilter **effect = gimp_drawable_get_filters (GIMP_DRAWABLE (group));

  for (int i = 0; effect && effect[i]; i++)
    if (is_live (effect[i]))
      gimp_drawable_filter_delete (effect[i]);
  g_free (effect);
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
  gimp_drawable_filter_set_visible (to, gimp_drawable_filter_get_visible (from));
}

/* ------------------------------------------------------------------ what an effect is given */

/* What is kept with the image, and the arrows of its paths, with places as from the corner of the group. */
static GKeyFile *
read_kept (GimpLayer *group)
{
  GimpImage     *image = gimp_item_get_image (GIMP_ITEM (group));
  GKeyFile      *kept = celd_kept_with (image);
  char          *relations = g_key_file_get_string (kept, CELD_KEPT_GROUP, "relations", NULL);
  CeldPathArrows paths;
  int            x, y;

  gimp_drawable_get_offsets (GIMP_DRAWABLE (group), &x, &y);
  if (relations && (x || y))
    {
      char *moved = celd_relations_moved (relations, -x, -y);

      g_key_file_set_string (kept, CELD_KEPT_GROUP, "relations", moved);
      g_free (moved);
    }
  paths = celd_paths_read_from (image, x, y);
  celd_paths_say_left_out (&paths);
  g_key_file_set_string (kept, CELD_KEPT_GROUP, "arrow-path", paths.data);
  g_free (paths.data);
  g_free (relations);
  return kept;
}

static GKeyFile *
properties_of (GObject *config)
{
  GKeyFile    *file = g_key_file_new ();
  guint        n;
  GParamSpec **spec = g_object_class_list_properties (G_OBJECT_GET_CLASS (config), &n);

  for (guint i = 0; i < n; i++)
    celd_kept_add (file, config, spec[i]);
  g_free (spec);
  return file;
}

/* An empty text may also be missing. */
static gboolean
is_same (GKeyFile *one, GKeyFile *two, const GParamSpec *spec)
{
  double   a = g_key_file_get_double (one, CELD_KEPT_GROUP, spec->name, NULL);
  double   b = g_key_file_get_double (two, CELD_KEPT_GROUP, spec->name, NULL);
  char    *first = g_key_file_get_value (one, CELD_KEPT_GROUP, spec->name, NULL);
  char    *second = g_key_file_get_value (two, CELD_KEPT_GROUP, spec->name, NULL);
  gboolean same = G_IS_PARAM_SPEC_DOUBLE (spec) ? fabs (a - b) <= PRECISION * fabs (a)
                                                : !strcmp (first ? first : "", second ? second : "");

  g_free (first);
  g_free (second);
  return same;
}

/* Sets what is kept, but for properties that are not as they were given before; what is set becomes a part of that. */
static void
give (GObject *config, GKeyFile *kept, GKeyFile *given)
{
  GKeyFile    *now = properties_of (config);
  guint        n;
  GParamSpec **spec = g_object_class_list_properties (G_OBJECT_GET_CLASS (config), &n);

  for (guint i = 0; i < n; i++)
    if (is_same (given, now, spec[i]))
      {
        celd_kept_set (kept, config, spec[i]);
        celd_kept_add (given, config, spec[i]);
      }
  g_free (spec);
  g_key_file_unref (now);
}

/* The settings of a new effect, which are those of the old one first, if there is one. */
static void
set_up (GimpLayer *group, GimpDrawableFilter *effect, GimpDrawableFilter *old)
{
  GObject      *config = G_OBJECT (gimp_drawable_filter_get_config (effect));
  GimpParasite *mark = old ? gimp_item_get_parasite (GIMP_ITEM (group), GIVEN_MARK) : NULL;
  GKeyFile     *given = mark ? celd_kept_read (mark) : properties_of (config); /* the defaults */
  GKeyFile     *kept = read_kept (group);
  char         *text;

  if (old)
    copy_settings (old, effect);
  give (config, kept, given);
  text = g_key_file_to_data (given, NULL, NULL);
  celd_item_mark (group, GIVEN_MARK, text);
  g_free (text);
  g_key_file_unref (given);
  g_key_file_unref (kept);
}

/* ------------------------------------------------------------------ putting it on a group */

gboolean
celd_effect_put (GimpLayer *group, GimpLayer *const layer[CELD_N_LAYERS])
{
  GimpDrawableFilter *effect = gimp_drawable_filter_new (GIMP_DRAWABLE (group), CELD_EFFECT, _ ("Live pop-up"));

  if (!effect)
    return FALSE;
  gimp_drawable_filter_set_opacity (effect, OPACITY);
  gimp_drawable_filter_set_blend_mode (effect, GIMP_LAYER_MODE_REPLACE);
  set_up (group, effect, find_old (group));
  remove_old (group);
  for (int role = 0; role < CELD_N_LAYERS; role++) /* pads are named as arguments are */
    if (layer[role])
      gimp_drawable_filter_set_aux_input (effect, celd_layer_arguments[role], GIMP_DRAWABLE (layer[role]));
  gimp_drawable_append_filter (GIMP_DRAWABLE (group), effect);
  return TRUE;
}
