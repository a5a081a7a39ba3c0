/* Arguments: layers, pictures, and settings, which are made from the table of settings.  And how they are remembered
 * with an image, by all procedures together: as a parasite, a key file.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <string.h>

#define PARASITE "celdepth-popup"

#define ALL (CELD_FOR_POPUP | CELD_FOR_SPLIT | CELD_FOR_SUGGEST | CELD_FOR_STEREO | CELD_FOR_EXPORT | CELD_FOR_MESH | \
             CELD_FOR_LIVE)

/* Settings of core, and who offers them.  `choices` is the number of choices, if not all are offered, and `more` one of
 * the plug-in's own behind them; label and help replace those of core. */
typedef struct
{
  const char       *name;
  guint             offered;
  int               choices;
  const char       *label, *help;
  CeldSettingChoice more;
} Offered;

static const Offered offered[] = {
  { .name = "light-azimuth", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "light-elevation", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "ambient", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "light-model", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE, .choices = CELD_MODEL_MATCAP,
    .help = N_ ("How surfaces are lit: softly; more softly, so that light reaches around the parts; or in steps, as in "
                "cel animation") },
  { .name = "toon-steps", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "specular", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "rim-light", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "bulge", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "bevel", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "shadow-strength", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "shadow-size", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "shadow-offset", .offered = CELD_FOR_POPUP | CELD_FOR_LIVE },
  { .name = "complete", .offered = CELD_FOR_SPLIT },
  { .name = "stereo", .offered = CELD_FOR_STEREO | CELD_FOR_LIVE, .label = N_ ("_Arrangement"),
    .help = N_ ("How the two views are shown: mixed for red and cyan glasses; beside or above each other; by "
                "alternating rows or columns for a screen that separates them; one of them; or each in a layer of its "
                "own"),
    .more = { "two-layers", N_ ("Two layers, one for each eye") } },
  { .name = "disparity", .offered = CELD_FOR_STEREO | CELD_FOR_LIVE, .label = N_ ("_Eye distance"),
    .help = N_ ("How far the nearest and the farthest depth are displaced between the views, as a part of the width. "
                "More than 3.3 % (0.033) strains the eyes") },
  { .name = "convergence", .offered = CELD_FOR_STEREO | CELD_FOR_LIVE, .label = N_ ("Con_vergence") },
  { .name = "floating-window", .offered = CELD_FOR_STEREO | CELD_FOR_LIVE },
  { .name = "screen-width", .offered = CELD_FOR_STEREO | CELD_FOR_LIVE },
  { .name = "mesh-kind", .offered = CELD_FOR_MESH },
  { .name = "mesh-size", .offered = CELD_FOR_MESH, .label = N_ ("_Longer side") },
  { .name = "relief-bulge", .offered = CELD_FOR_MESH, .label = N_ ("_Roundness") },
  { .name = "relief-depth", .offered = CELD_FOR_MESH, .label = N_ ("_Depth") },
  { .name = "relief-from", .offered = CELD_FOR_MESH, .label = N_ ("One surface is round from"),
    .help = N_ ("Whether one surface bulges as if inflated, or follows the normals. Parts are always inflated") },
  { .name = "mesh-plate", .offered = CELD_FOR_MESH, .label = N_ ("Thickness of the plate") },
  { .name = "mesh-error", .offered = CELD_FOR_MESH, .label = N_ ("Deviation in pixels") },
  { .name = "most-vertices", .offered = CELD_FOR_MESH, .label = N_ ("Most vertices") },
  { .name = "ink", .offered = ALL },
  { .name = "ink-threshold", .offered = ALL },
  { .name = "arrow-style", .offered = ALL },
  { .name = "hardness", .offered = ALL },
  { .name = "close-gaps", .offered = ALL },
  { .name = "flats", .offered = ALL },
  { .name = "same-colour", .offered = ALL },
  { .name = "suggest", .offered = ALL & ~CELD_FOR_SUGGEST },
  { .name = "on-cycle", .offered = ALL & ~CELD_FOR_SUGGEST },
  { .name = "expansion", .offered = ALL & ~CELD_FOR_SUGGEST },
};

/* Arguments that procedures add themselves, and that are kept as settings are. */
static const char *const kept_arguments[] = { "relations", "new-image", "picture", "source" };

/* ------------------------------------------------------------------ arguments */

static void
add_choice (GimpProcedure *procedure, const CeldSettingInfo *row, const Offered *o, const char *label, const char *help)
{
  GimpChoice *choice = gimp_choice_new ();

  for (int i = 0; i < (o->choices ? o->choices : (int) row->choices); i++)
    gimp_choice_add (choice, row->choice[i].nick, i, _ (row->choice[i].label), NULL);
  if (o->more.nick)
    gimp_choice_add (choice, o->more.nick, (int) row->choices, _ (o->more.label), NULL);
  gimp_procedure_add_choice_argument (procedure, row->name, label, help, choice, row->choice[(int) row->usual].nick,
                                      G_PARAM_READWRITE);
}

static void
add_setting (GimpProcedure *procedure, const Offered *o)
{
  const CeldSettingInfo *row = celd_setting_find (o->name);
  const char            *label = _ (o->label ? o->label : row->label), *help = _ (o->help ? o->help : row->help);

  switch (row->type)
    {
    case CELD_SETTING_NUMBER: /* sliders have the range that makes sense */
      gimp_procedure_add_double_argument (procedure, row->name, label, help, row->shown.least, row->shown.most,
                                          row->usual, G_PARAM_READWRITE);
      break;
    case CELD_SETTING_INTEGER:
      gimp_procedure_add_int_argument (procedure, row->name, label, help, (int) row->least, (int) row->most,
                                       (int) row->usual, G_PARAM_READWRITE);
      break;
    case CELD_SETTING_SWITCH:
      gimp_procedure_add_boolean_argument (procedure, row->name, label, help, row->usual != 0, G_PARAM_READWRITE);
      break;
    case CELD_SETTING_CHOICE:
      add_choice (procedure, row, o, label, help);
      break;
    case CELD_SETTING_COLOUR:
    case CELD_SETTING_TEXT:
      break; /* none is offered */
    }
}

gboolean
celd_has_argument (GimpProcedureConfig *config, const char *name)
{
  return g_object_class_find_property (G_OBJECT_GET_CLASS (config), name) != NULL;
}

void
celd_settings_add_arguments (GimpProcedure *procedure, guint whose)
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    gimp_procedure_add_layer_argument (procedure, celd_layer_arguments[role],
                                       _ (celd_layer_role_name ((CeldLayerRole) role)), _ (celd_layer_help[role]),
                                       TRUE, G_PARAM_READWRITE);
  for (int i = 0; whose & CELD_FOR_POPUP && i < CELD_POPUP_PICTURES; i++)
    gimp_procedure_add_boolean_argument (procedure, celd_pictures[i].argument, _ (celd_pictures[i].label),
                                         _ (celd_pictures[i].help), celd_pictures[i].usual, G_PARAM_READWRITE);
  for (gsize i = 0; i < G_N_ELEMENTS (offered); i++)
    if (offered[i].offered & whose)
      add_setting (procedure, &offered[i]);
  gimp_procedure_add_string_argument (procedure, "relations", _ ("Relations"),
                                      _ ("Relations as text, beside arrows: 120,80 > 300,95 or #ff0000 > #0000ff"), "",
                                      G_PARAM_READWRITE);
}

CeldSettings
celd_settings_chosen (GimpProcedureConfig *config)
{
  CeldSettings settings = celd_settings ();

  for (gsize i = 0; i < G_N_ELEMENTS (offered); i++)
    {
      const CeldSettingInfo *row = celd_setting_find (offered[i].name);
      double                 number = 0;
      int                    whole = 0;

      if (!celd_has_argument (config, row->name))
        continue;
      if (row->type == CELD_SETTING_NUMBER)
        g_object_get (config, row->name, &number, NULL);
      else if (row->type == CELD_SETTING_CHOICE)
        whole = gimp_procedure_config_get_choice_id (config, row->name);
      else
        g_object_get (config, row->name, &whole, NULL);
      if (!offered[i].more.nick || whole < (int) row->choices)
        celd_setting_set (row, row->type == CELD_SETTING_NUMBER ? number : whole, &settings);
    }
  return settings;
}

void
celd_settings_put (GimpProcedureConfig *config, const CeldSettings *settings)
{
  for (gsize i = 0; i < G_N_ELEMENTS (offered); i++)
    {
      const CeldSettingInfo *row = celd_setting_find (offered[i].name);
      double                 value = celd_setting_get (row, settings);

      if (!celd_preset_covers (row->name) || !celd_has_argument (config, row->name))
        continue;
      if (row->type == CELD_SETTING_NUMBER)
        g_object_set (config, row->name, value, NULL);
      else if (row->type == CELD_SETTING_CHOICE)
        g_object_set (config, row->name, row->choice[(int) value].nick, NULL);
      else
        g_object_set (config, row->name, (int) value, NULL);
    }
}

/* GIMP keeps the arguments of the last run in the image's own file, which this one must not be in; see files.c. */
void
celd_file_add_argument (GimpProcedure *procedure, const char *help)
{
  gimp_procedure_add_file_argument (procedure, "file", _ ("F_ile"), help, GIMP_FILE_CHOOSER_ACTION_SAVE, TRUE, NULL,
                                    G_PARAM_READWRITE | GIMP_PARAM_DONT_SERIALIZE);
}

guint
celd_pictures_chosen (GimpProcedureConfig *config)
{
  guint wanted = 0;

  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    {
      gboolean chosen;

      g_object_get (config, celd_pictures[i].argument, &chosen, NULL);
      wanted |= chosen ? 1u << i : 0;
    }
  return wanted;
}

/* Layers are kept by libgimp as long as the plug-in runs. */
void
celd_layers_chosen (GimpProcedureConfig *config, GimpLayer *layer[CELD_N_LAYERS])
{
  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      g_object_get (config, celd_layer_arguments[role], &layer[role], NULL);
      if (layer[role])
        g_object_unref (layer[role]);
    }
}

/* ------------------------------------------------------------------ remembering */

/* Whether this argument is kept as text: all but layers and what the class of procedures adds. */
static gboolean
is_kept (const GParamSpec *spec)
{
  for (gsize i = 0; i < G_N_ELEMENTS (offered); i++)
    if (!strcmp (spec->name, offered[i].name))
      return TRUE;
  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    if (!strcmp (spec->name, celd_pictures[i].argument))
      return TRUE;
  for (gsize i = 0; i < G_N_ELEMENTS (kept_arguments); i++)
    if (!strcmp (spec->name, kept_arguments[i]))
      return TRUE;
  return FALSE;
}

void
celd_kept_add (GKeyFile *file, GObject *config, const GParamSpec *spec)
{
  GValue value = G_VALUE_INIT;

  g_value_init (&value, spec->value_type);
  g_object_get_property (config, spec->name, &value);
  if (G_VALUE_HOLDS_DOUBLE (&value))
    g_key_file_set_double (file, CELD_KEPT_GROUP, spec->name, g_value_get_double (&value));
  else if (G_VALUE_HOLDS_INT (&value))
    g_key_file_set_integer (file, CELD_KEPT_GROUP, spec->name, g_value_get_int (&value));
  else if (G_VALUE_HOLDS_BOOLEAN (&value))
    g_key_file_set_boolean (file, CELD_KEPT_GROUP, spec->name, g_value_get_boolean (&value));
  else if (G_VALUE_HOLDS_STRING (&value)) /* NULL: an empty text, in place of what was kept before */
    g_key_file_set_string (file, CELD_KEPT_GROUP, spec->name,
                           g_value_get_string (&value) ? g_value_get_string (&value) : "");
  g_value_unset (&value);
}

/* What is missing or damaged stays as it is; values out of range are brought into it. */
void
celd_kept_set (GKeyFile *file, GObject *config, GParamSpec *spec)
{
  GValue  value = G_VALUE_INIT;
  GError *error = NULL;
  char   *text;

  if (!g_key_file_has_key (file, CELD_KEPT_GROUP, spec->name, NULL))
    return;
  g_value_init (&value, spec->value_type);
  if (G_VALUE_HOLDS_DOUBLE (&value))
    g_value_set_double (&value, g_key_file_get_double (file, CELD_KEPT_GROUP, spec->name, &error));
  else if (G_VALUE_HOLDS_INT (&value))
    g_value_set_int (&value, g_key_file_get_integer (file, CELD_KEPT_GROUP, spec->name, &error));
  else if (G_VALUE_HOLDS_BOOLEAN (&value))
    g_value_set_boolean (&value, g_key_file_get_boolean (file, CELD_KEPT_GROUP, spec->name, &error));
  else if (G_VALUE_HOLDS_STRING (&value))
    {
      text = g_key_file_get_string (file, CELD_KEPT_GROUP, spec->name, &error);
      g_value_take_string (&value, text);
    }
  if (!error)
    {
      g_param_value_validate (spec, &value);
      g_object_set_property (config, spec->name, &value);
    }
  g_clear_error (&error);
  g_value_unset (&value);
}

/* The layers that were chosen although their names say something else: by tattoos, which stay the same in files. */
static void
keep_layers (GKeyFile *file, GimpImage *image, GimpProcedureConfig *config)
{
  GimpLayer *named[CELD_N_LAYERS], *chosen[CELD_N_LAYERS];

  celd_layers_find (image, named);
  celd_layers_chosen (config, chosen);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (chosen[role] != named[role])
      g_key_file_set_integer (file, CELD_KEPT_GROUP, celd_layer_arguments[role],
                              chosen[role] ? (int) gimp_item_get_tattoo (GIMP_ITEM (chosen[role])) : 0);
    else
      g_key_file_remove_key (file, CELD_KEPT_GROUP, celd_layer_arguments[role], NULL);
}

/* Those that were chosen, else those of the names. */
static void
get_layers (GKeyFile *file, GimpImage *image, GimpLayer *layer[CELD_N_LAYERS])
{
  celd_layers_find (image, layer);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    if (g_key_file_has_key (file, CELD_KEPT_GROUP, celd_layer_arguments[role], NULL))
      {
        int        tattoo = g_key_file_get_integer (file, CELD_KEPT_GROUP, celd_layer_arguments[role], NULL);
        GimpLayer *kept = tattoo > 0 ? gimp_image_get_layer_by_tattoo (image, (guint) tattoo) : NULL;

        if (kept || !tattoo) /* a layer that is gone gives way to the name */
          layer[role] = kept;
      }
}

static void
set_layers (GKeyFile *file, GimpImage *image, GimpProcedureConfig *config)
{
  GimpLayer *layer[CELD_N_LAYERS];

  get_layers (file, image, layer);
  if (!layer[CELD_LAYER_DRAWING])
    layer[CELD_LAYER_DRAWING] = celd_layers_lowest (image, layer);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_object_set (config, celd_layer_arguments[role], layer[role], NULL);
}

GKeyFile *
celd_kept_read (GimpParasite *parasite)
{
  GKeyFile   *file = g_key_file_new ();
  guint32     length = 0;
  const char *text = parasite ? gimp_parasite_get_data (parasite, &length) : NULL;

  if (length)
    g_key_file_load_from_data (file, text, length - 1, G_KEY_FILE_NONE, NULL);
  if (parasite)
    gimp_parasite_free (parasite);
  return file;
}

GKeyFile *
celd_kept_with (GimpImage *image)
{
  return celd_kept_read (gimp_image_get_parasite (image, PARASITE));
}

void
celd_layers_kept (GimpImage *image, GimpLayer *layer[CELD_N_LAYERS])
{
  GKeyFile *file = celd_kept_with (image);

  get_layers (file, image, layer);
  g_key_file_unref (file);
}

void
celd_settings_remember (GimpImage *image, GimpProcedureConfig *config, gboolean undoable)
{
  GKeyFile     *file = celd_kept_with (image);
  guint         n;
  GParamSpec  **specs = g_object_class_list_properties (G_OBJECT_GET_CLASS (config), &n);
  char         *text;
  gsize         length;
  GimpParasite *parasite;

  for (guint i = 0; i < n; i++)
    if (is_kept (specs[i]))
      celd_kept_add (file, G_OBJECT (config), specs[i]);
  keep_layers (file, image, config);
  text     = g_key_file_to_data (file, &length, NULL);
  parasite = gimp_parasite_new (PARASITE, GIMP_PARASITE_PERSISTENT | (undoable ? GIMP_PARASITE_UNDOABLE : 0u),
                                (guint32) length + 1, text);
  gimp_image_attach_parasite (image, parasite);
  gimp_parasite_free (parasite);
  g_free (text);
  g_free (specs);
  g_key_file_unref (file);
}

/* Relations are places and colours of one image, and GIMP has filled in those of the last run on any image. */
void
celd_settings_recall (GimpImage *image, GimpProcedureConfig *config)
{
  GKeyFile    *file = celd_kept_with (image);
  guint        n;
  GParamSpec **specs = g_object_class_list_properties (G_OBJECT_GET_CLASS (config), &n);

  g_object_set (config, "relations", "", NULL);
  for (guint i = 0; i < n; i++)
    if (is_kept (specs[i]))
      celd_kept_set (file, G_OBJECT (config), specs[i]);
  set_layers (file, image, config);
  g_free (specs);
  g_key_file_unref (file);
}
