/* The description of the operations for hosts: names, menus, pads, properties.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#include "celdepth.h"

#include <gegl-plugin.h>

#define POPUP_PROPERTIES \
  "result ink background background-colour arrow-style suggest bulge light-azimuth light-elevation ambient directx " \
  "more relations arrow-path same-colour flats hardness close-gaps keep-necks ink-threshold seeds on-cycle expansion " \
  "method encoding near-level far-level anchors hold-rest hold-gaps tolerance"

static const struct { const char *name; const char *pads; const char *properties; } operations[] = {
  { "celdepth:virtual-contours", "aux input", "result ink" },
  { "celdepth:lazybrush-segment", "aux2 aux input",
    "result ink close-gaps hardness flats background background-colour more ink-threshold keep-necks method seeds "
    "relations arrow-path arrow-style" },
  { "celdepth:depth-order", "aux3 aux2 aux input",
    "arrow-style suggest on-cycle same-colour more relations arrow-path background background-colour encoding "
    "near-level far-level ink" },
  { "celdepth:depth-expand", "aux3 aux2 aux input", "result layer complete expansion ink" },
  { "celdepth:depth-smooth", "aux3 aux2 aux input", "ink ink-threshold hold-rest hold-gaps tolerance" },
  { "celdepth:depth-exact", "aux3 aux2 aux input",
    "ink background background-colour arrow-style on-cycle more relations arrow-path same-colour flats encoding "
    "near-level far-level hold-gaps contrast weight-floor tolerance" },
  { "celdepth:lumo-shade", "aux6 aux5 aux4 aux3 aux2 aux input",
    "result light-model toon-steps light-azimuth light-elevation ambient specular rim-light bulge bevel "
    "shadow-size shadow-strength directx more light light-x light-y light-height shininess rim-power creases "
    "frame-outline light-background ink ink-threshold hold-gaps" },
  { "celdepth:depth-enhance", "aux input",
    "result enhance shadow-size shadow-strength shadow-offset light-azimuth shadow-range" },
  { "celdepth:relief", "aux3 aux2 aux input",
    "unit relief-from relief-bulge relief-depth ink ink-threshold hold-gaps tolerance" },
  { "celdepth:stereo", "aux3 aux2 aux input",
    "stereo disparity convergence floating-window screen-width expansion margin ink" },
  { "celdepth:arap-register", "aux2 aux input", "result cell-size stiffness expansion ink" },
  { "celdepth:depth-propagate", "aux4 aux3 aux2 aux input",
    "result flats ink arrow-style background background-colour more relations arrow-path on-cycle ink-threshold "
    "hardness close-gaps keep-necks method expansion encoding near-level far-level tolerance" },
  { "celdepth:arap-deform", "aux5 aux4 aux3 aux2 aux input",
    "result handles ink arrow-style hold-gaps cell-size more relations arrow-path on-cycle suggest ink-threshold "
    "hardness close-gaps keep-necks flats background background-colour seeds same-colour method expansion margin encoding "
    "near-level far-level" },
  { "celdepth:compose", "aux3 aux2 aux input", "result between x y scale turn flip ink" },
  { "celdepth:popup", "aux4 aux3 aux2 aux input", POPUP_PROPERTIES },
  { "celdepth:live-popup", "corrections hidden contours arrows scribbles drawing input", POPUP_PROPERTIES },
};

static bool
speaks (const char *operation, const char *key)
{
  const char *value = gegl_operation_get_key (operation, key);

  return value && *value;
}

static void
every_operation_is_described (void)
{
  for (size_t i = 0; i < G_N_ELEMENTS (operations); i++)
    {
      const char *name = operations[i].name;
      bool        listed = g_strcmp0 (name, "celdepth:live-popup") != 0; /* the plug-in makes it */

      CHECK (gegl_has_operation (name));
      CHECK (speaks (name, "title"));
      CHECK (speaks (name, "description"));
      CHECK (speaks (name, "categories"));
      CHECK (speaks (name, "reference"));
      CHECK (speaks (name, "gimp:menu-label") == listed);
      CHECK (!g_strcmp0 (gegl_operation_get_key (name, "gimp:menu-path"),
                         listed ? "<Image>/Filters/Cartoon Depth" : NULL));
      CHECK (!gegl_operation_get_key (name, "license")); /* would hide it from hosts that are not GPL */
    }
}

/* GEGL lists the newest pad first, and GIMP's dialogs show the list from its end. */
static void
pads_are_those_of_the_documentation (void)
{
  for (size_t i = 0; i < G_N_ELEMENTS (operations); i++)
    {
      GeglNode *node = gegl_node_new (), *child = gegl_node_new_child (node, "operation", operations[i].name, NULL);
      gchar   **pads = gegl_node_list_input_pads (child), *list = pads ? g_strjoinv (" ", pads) : NULL;

      CHECK (!g_strcmp0 (list, operations[i].pads));
      CHECK (gegl_node_has_pad (child, "output"));
      g_free (list);
      g_strfreev (pads);
      g_object_unref (node);
    }
}

/* In the order of dialogs, each explained, none of a type that ends GIMP's list of arguments. */
static void
properties_are_complete (void)
{
  for (size_t i = 0; i < G_N_ELEMENTS (operations); i++)
    {
      guint        n;
      GParamSpec **specs = gegl_operation_list_properties (operations[i].name, &n);
      GString     *list = g_string_new (NULL);

      for (guint k = 0; k < n; k++)
        {
          const char *type = G_PARAM_SPEC_TYPE_NAME (specs[k]), *blurb = g_param_spec_get_blurb (specs[k]);

          g_string_append_printf (list, "%s%s", k ? " " : "", g_param_spec_get_name (specs[k]));
          CHECK (blurb && *blurb);
          CHECK (!strstr (type, "Path"));
        }
      CHECK (!strcmp (list->str, operations[i].properties));
      g_string_free (list, TRUE);
      g_free (specs);
    }
}

/* ------------------------------------------------------------------ what dialogs show */

static const char *
condition_of (GParamSpec *spec)
{
  const char *condition = gegl_param_spec_get_property_key (spec, "visible");

  return condition ? condition : "";
}

/* Whether "property {choice, choice}" is so, or "", while all have their defaults. */
static bool
holds_by_default (const char *operation, const char *condition)
{
  char **part = g_strsplit_set (condition, "{}", 3);
  bool   holds = !*condition;

  if (part[0] && part[1])
    {
      GParamSpec      *spec = gegl_operation_find_property (operation, g_strstrip (part[0]));
      const GEnumValue *usual = g_enum_get_value (G_PARAM_SPEC_ENUM (spec)->enum_class,
                                                  G_PARAM_SPEC_ENUM (spec)->default_value);
      char            **choice = g_strsplit (part[1], ", ", -1);

      holds = g_strv_contains ((const gchar *const *) choice, usual->value_nick);
      g_strfreev (choice);
    }
  g_strfreev (part);
  return holds;
}

/* Behind `more`, and nothing else is there; so that no dialog opens with more than ten. */
static void
rare_properties_are_folded (void)
{
  for (size_t i = 0; i < G_N_ELEMENTS (operations); i++)
    {
      guint        n;
      GParamSpec **specs = gegl_operation_list_properties (operations[i].name, &n);
      int          shown = 0;
      bool         folded = false;

      for (guint k = 0; k < n; k++)
        {
          const char *condition = condition_of (specs[k]);
          bool        rare = g_str_has_prefix (condition, "more");

          CHECK (rare == folded);
          CHECK (!rare || !condition[4] || g_str_has_prefix (condition, "more & "));
          shown += !rare && holds_by_default (operations[i].name, condition);
          folded = folded || !strcmp (g_param_spec_get_name (specs[k]), "more");
        }
      CHECK (shown <= 10);
      g_free (specs);
    }
}

static const GEnumClass *
choices (const char *operation, const char *property)
{
  GParamSpec *spec = gegl_operation_find_property (operation, property);

  return spec ? G_PARAM_SPEC_ENUM (spec)->enum_class : NULL;
}

static void
choices_have_the_documented_nicks (void)
{
  static const struct { const char *operation, *property, *nicks; } cases[] = {
    { "celdepth:depth-expand", "result", "levels layer matte" },
    { "celdepth:popup", "result", "labels order levels depth normals shading problems suggestions" },
    { "celdepth:lazybrush-segment", "result", "labels closures problems" },
    { "celdepth:lumo-shade", "result", "art shading normals tone rim occlusion" },
    { "celdepth:lumo-shade", "light-model", "lambert half-lambert toon matcap" },
    { "celdepth:lumo-shade", "light", "direction point" },
    { "celdepth:depth-enhance", "result", "art layer view" },
    { "celdepth:depth-enhance", "enhance", "stack darken contrast" },
    { "celdepth:arap-register", "result", "displacement warped confidence" },
    { "celdepth:depth-propagate", "result", "labels scribbles levels depth confidence" },
    { "celdepth:arap-deform", "result", "art levels" },
    { "celdepth:compose", "result", "art levels" },
    { "celdepth:relief", "unit", "relative pixels" },
    { "celdepth:relief", "relief-from", "inflation normals" },
    { "celdepth:popup", "ink", "auto dark light alpha lines" },
    { "celdepth:popup", "method", "basins exact walker" },
    { "celdepth:popup", "background", "auto none colour" },
    { "celdepth:popup", "seeds", "auto scribbles" },
    { "celdepth:popup", "same-colour", "one separate" },
    { "celdepth:popup", "arrow-style", "head dot fade taper" },
    { "celdepth:popup", "on-cycle", "report drop-weakest split" },
    { "celdepth:popup", "suggest", "off fill-gaps all" },
    { "celdepth:popup", "encoding", "normalized rank fixed" },
    { "celdepth:popup", "anchors", "scribbles arrows both core" },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (cases); i++)
    {
      const GEnumClass *klass = choices (cases[i].operation, cases[i].property);
      GString          *list = g_string_new (NULL);

      for (guint k = 0; klass && k < klass->n_values; k++)
        g_string_append_printf (list, "%s%s", k ? " " : "", klass->values[k].value_nick);
      CHECK (!strcmp (list->str, cases[i].nicks));
      g_string_free (list, TRUE);
    }
}

static double
number_of (const GValue *value)
{
  return G_VALUE_HOLDS_DOUBLE (value)    ? g_value_get_double (value)
         : G_VALUE_HOLDS_INT (value)     ? g_value_get_int (value)
         : G_VALUE_HOLDS_BOOLEAN (value) ? g_value_get_boolean (value)
                                         : g_value_get_enum (value);
}

/* An operation that is not told otherwise does what core does. */
static void
defaults_are_those_of_core (void)
{
  CeldSettings s = celd_settings ();
  int          compared = 0;

  for (size_t i = 0; i < G_N_ELEMENTS (operations); i++)
    {
      guint        n;
      GParamSpec **specs = gegl_operation_list_properties (operations[i].name, &n);
      GeglNode    *graph = gegl_node_new ();
      GeglNode    *node = gegl_node_new_child (graph, "operation", operations[i].name, NULL);

      for (guint k = 0; k < n; k++)
        {
          const char            *name = g_param_spec_get_name (specs[k]);
          const CeldSettingInfo *row = celd_setting_find (name);
          GValue                 value = G_VALUE_INIT;

          if (!row || row->type == CELD_SETTING_COLOUR)
            continue;
          g_value_init (&value, specs[k]->value_type);
          gegl_node_get_property (node, name, &value);
          NEAR (number_of (&value), celd_setting_get (row, &s), 1e-6);
          g_value_unset (&value);
          compared++;
        }
      g_free (specs);
      g_object_unref (graph);
    }
  CHECK (compared > 60);
}

/* Exactly: settings of core are floats, but hosts save what they read back. */
static void
values_are_read_as_they_were_set (void)
{
  GeglNode  *graph = gegl_node_new (), *node;
  GeglColor *red = gegl_color_new ("#ff0000"), *colour = NULL;
  gdouble    hardness = 0, r = 0, g = 1, b = 1, a = 0;
  gint       ink = -1;
  gboolean   flats = FALSE;
  gchar     *relations = NULL;

  node = gegl_node_new_child (graph, "operation", "celdepth:popup", "hardness", 0.123456789, "ink", 2, "flats", TRUE,
                              "relations", "1,1 > 2,2", "background-colour", red, NULL);
  gegl_node_get (node, "hardness", &hardness, "ink", &ink, "flats", &flats, "relations", &relations,
                 "background-colour", &colour, NULL);
  CHECK (hardness == 0.123456789 && ink == 2 && flats && !g_strcmp0 (relations, "1,1 > 2,2"));
  if (colour)
    gegl_color_get_rgba (colour, &r, &g, &b, &a);
  CHECK (r == 1 && g == 0 && b == 0 && a == 1);
  g_clear_object (&colour);
  g_object_unref (red);
  g_free (relations);
  g_object_unref (graph);
}

int
main (int argc, char **argv)
{
  gegl_init (&argc, &argv);
  RUN (every_operation_is_described);
  RUN (pads_are_those_of_the_documentation);
  RUN (properties_are_complete);
  RUN (rare_properties_are_folded);
  RUN (choices_have_the_documented_nicks);
  RUN (defaults_are_those_of_core);
  RUN (values_are_read_as_they_were_set);
  gegl_exit ();
  return DONE;
}
