/* What hosts read of the operations: names, menus, pads, properties.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "check.h"

#include "celdepth.h"

#include <gegl-plugin.h>

static const struct { const char *name; const char *pads; const char *properties; } operations[] = {
  { "celdepth:virtual-contours", "aux input", "result ink" },
  { "celdepth:lazybrush-segment", "aux2 aux input",
    "result ink ink-threshold method close-gaps keep-necks hardness flats background background-colour seeds relations "
    "arrow-path arrow-style" },
  { "celdepth:depth-order", "aux3 aux2 aux input",
    "relations arrow-path arrow-style on-cycle suggest same-colour background background-colour encoding near-level "
    "far-level ink" },
  { "celdepth:depth-expand", "aux3 aux2 aux input", "result layer complete method ink" },
  { "celdepth:depth-smooth", "aux2 aux input", "ink ink-threshold hold-rest tolerance" },
  { "celdepth:depth-exact", "aux3 aux2 aux input",
    "ink flats background background-colour same-colour relations arrow-path arrow-style on-cycle encoding near-level "
    "far-level "
    "tolerance contrast weight-floor" },
  { "celdepth:lumo-shade", "aux5 aux4 aux3 aux2 aux input",
    "result bulge bevel quilt frame-outline light-model toon-steps light light-azimuth light-elevation ambient "
    "light-x light-y light-height specular shininess rim-light rim-power shadow-size shadow-strength directx "
    "ink ink-threshold" },
  { "celdepth:depth-enhance", "aux input",
    "result enhance shadow-size shadow-strength shadow-offset light-azimuth shadow-range" },
  { "celdepth:relief", "aux2 aux input", "unit from bulge relief-depth ink ink-threshold tolerance" },
  { "celdepth:stereo", "aux3 aux2 aux input",
    "stereo disparity convergence floating-window screen-width expansion ink" },
  { "celdepth:popup", "aux3 aux2 aux input",
    "result ink ink-threshold method close-gaps keep-necks hardness flats background background-colour seeds "
    "same-colour relations arrow-path arrow-style on-cycle suggest encoding near-level far-level expansion anchors "
    "hold-rest tolerance bulge light-azimuth light-elevation ambient directx" },
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

      CHECK (gegl_has_operation (name));
      CHECK (speaks (name, "title"));
      CHECK (speaks (name, "description"));
      CHECK (speaks (name, "categories"));
      CHECK (speaks (name, "reference"));
      CHECK (speaks (name, "gimp:menu-label"));
      CHECK (!g_strcmp0 (gegl_operation_get_key (name, "gimp:menu-path"), "<Image>/Filters/Cartoon Depth"));
      CHECK (!gegl_operation_get_key (name, "license")); /* would hide it from hosts that are not GPL */
    }
}

/* GEGL lists the newest pad first, and GIMP's dialogs show the list from its end. */
static void
pads_are_those_of_the_contract (void)
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

static const GEnumClass *
choices (const char *operation, const char *property)
{
  GParamSpec *spec = gegl_operation_find_property (operation, property);

  return spec ? G_PARAM_SPEC_ENUM (spec)->enum_class : NULL;
}

static void
choices_have_the_nicks_of_the_contract (void)
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
    { "celdepth:relief", "unit", "relative pixels" },
    { "celdepth:relief", "from", "inflation normals" },
    { "celdepth:popup", "ink", "auto dark light alpha" },
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

/* An operation that is not told otherwise does what core does. */
static void
defaults_are_those_of_core (void)
{
  CeldSettings s = celd_settings ();
  GeglNode    *graph = gegl_node_new (), *node = gegl_node_new_child (graph, "operation", "celdepth:popup", NULL);
  gint         ink = -1, method = -1, background = -1, seeds = -1, same = -1, style = -1, encoding = -1, anchors = -1;
  gboolean     gaps = -1, necks = -1, flats = -1;
  gdouble      threshold = -1, hardness = -1, tolerance = -1, bulge = -1, azimuth = -1, elevation = -1, ambient = -1;

  gegl_node_get (node, "ink", &ink, "method", &method, "background", &background, "seeds", &seeds, "same-colour", &same,
                 "arrow-style", &style, "encoding", &encoding, "anchors", &anchors, "close-gaps", &gaps, "keep-necks",
                 &necks, "flats", &flats, "ink-threshold", &threshold, "hardness", &hardness, "tolerance", &tolerance,
                 "bulge", &bulge, "light-azimuth", &azimuth, "light-elevation", &elevation, "ambient", &ambient, NULL);
  CHECK (ink == (gint) s.ink && method == (gint) s.method && background == (gint) s.background);
  CHECK (seeds == (gint) s.seeds && same == (gint) s.same_colour && style == (gint) s.arrow_style);
  CHECK (encoding == (gint) s.encoding && anchors == (gint) s.anchors);
  CHECK (gaps == s.close_gaps && necks == s.keep_necks && flats == s.flats);
  NEAR (threshold, s.ink_threshold, 1e-7);
  NEAR (hardness, s.hardness, 1e-7);
  NEAR (tolerance, s.tolerance, 1e-7);
  NEAR (bulge, s.bulge, 1e-7);
  NEAR (azimuth, s.light_azimuth, 1e-7);
  NEAR (elevation, s.light_elevation, 1e-7);
  NEAR (ambient, s.ambient, 1e-7);
  g_object_unref (graph);
}

static void
defaults_of_light_are_those_of_core (void)
{
  static const struct { const char *name; size_t offset; } numbers[] = {
#define MEMBER(name, member) { name, offsetof (CeldSettings, member) }
    MEMBER ("bulge", bulge), MEMBER ("bevel", bevel), MEMBER ("quilt", quilt), MEMBER ("light-x", light_x),
    MEMBER ("light-y", light_y), MEMBER ("light-height", light_height), MEMBER ("specular", specular),
    MEMBER ("shininess", shininess), MEMBER ("rim-light", rim_light), MEMBER ("rim-power", rim_power),
    MEMBER ("shadow-size", shadow_size), MEMBER ("shadow-strength", shadow_strength),
  };
  CeldSettings s = celd_settings ();
  GeglNode    *graph = gegl_node_new ();
  GeglNode    *node = gegl_node_new_child (graph, "operation", "celdepth:lumo-shade", NULL);
  gint         model = -1, light = -1, steps = -1;
  gboolean     frame = -1;

  gegl_node_get (node, "light-model", &model, "light", &light, "toon-steps", &steps, "frame-outline", &frame, NULL);
  CHECK (model == (gint) s.light_model && light == (gint) s.light && steps == s.toon_steps && frame == s.frame_outline);
  for (size_t i = 0; i < G_N_ELEMENTS (numbers); i++)
    {
      gdouble value = -1;

      gegl_node_get (node, numbers[i].name, &value, NULL);
      NEAR (value, *(const float *) (const void *) ((const char *) &s + numbers[i].offset), 1e-6);
    }
  g_object_unref (graph);
}

int
main (int argc, char **argv)
{
  gegl_init (&argc, &argv);
  RUN (every_operation_is_described);
  RUN (pads_are_those_of_the_contract);
  RUN (properties_are_complete);
  RUN (choices_have_the_nicks_of_the_contract);
  RUN (defaults_are_those_of_core);
  RUN (defaults_of_light_are_those_of_core);
  gegl_exit ();
  return DONE;
}
