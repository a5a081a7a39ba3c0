/* The GParamSpec of a property (its name, range, default, label and help for hosts), made from its row.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#define FLAGS ((GParamFlags) (G_PARAM_READWRITE | G_PARAM_CONSTRUCT | (guint) GEGL_PARAM_PAD_INPUT))

static GType
choice_type (const CeldSettingInfo *row)
{
  GType       type = g_type_from_name (row->choice_type);
  GEnumValue *values;

  if (type)
    return type;
  values = g_new0 (GEnumValue, row->choices + 1); /* never freed, like the type */
  for (gsize i = 0; i < row->choices; i++)
    values[i] = (GEnumValue) { (int) i, _ (row->choice[i].label), row->choice[i].nick };
  return g_enum_register_static (row->choice_type, values);
}

static GParamSpec *
number_spec (const CeldSettingInfo *row, const char *name, const char *label, const char *help)
{
  double      gamma = row->shown.gamma > 0 ? row->shown.gamma : 1;
  GParamSpec *spec = gegl_param_spec_double (name, label, help, row->least, row->most, row->usual, row->shown.least,
                                             row->shown.most, gamma, FLAGS);

  gegl_param_spec_double_set_steps (GEGL_PARAM_SPEC_DOUBLE (spec), row->shown.step, row->shown.page);
  gegl_param_spec_double_set_digits (GEGL_PARAM_SPEC_DOUBLE (spec), row->shown.digits);
  return spec;
}

static GParamSpec *
integer_spec (const CeldSettingInfo *row, const char *name, const char *label, const char *help)
{
  GParamSpec *spec = gegl_param_spec_int (name, label, help, (int) row->least, (int) row->most, (int) row->usual,
                                          (int) row->shown.least, (int) row->shown.most, 1, FLAGS);

  gegl_param_spec_int_set_steps (GEGL_PARAM_SPEC_INT (spec), (int) row->shown.step, (int) row->shown.page);
  return spec;
}

static GParamSpec *
choice_spec (const CeldSettingInfo *row, const char *name, const char *label, const char *help)
{
  return gegl_param_spec_enum (name, label, help, choice_type (row), (int) row->usual, FLAGS);
}

static GParamSpec *
colour_spec (const CeldSettingInfo *row, const char *name, const char *label, const char *help)
{
  char colour[8];

  g_snprintf (colour, sizeof colour, "#%06x", (guint) row->usual);
  return gegl_param_spec_color_from_string (name, label, help, colour, FLAGS);
}

static GParamSpec *
make_spec (const CeldSettingInfo *row, const char *name, const char *label, const char *help)
{
  switch (row->type)
    {
    case CELD_SETTING_NUMBER:  return number_spec (row, name, label, help);
    case CELD_SETTING_INTEGER: return integer_spec (row, name, label, help);
    case CELD_SETTING_SWITCH:  return g_param_spec_boolean (name, label, help, row->usual != 0, FLAGS);
    case CELD_SETTING_CHOICE:  return choice_spec (row, name, label, help);
    case CELD_SETTING_COLOUR:  return colour_spec (row, name, label, help);
    case CELD_SETTING_TEXT:    return g_param_spec_string (name, label, help, "", FLAGS);
    }
  return NULL;
}

static void
set_key (GParamSpec *spec, const char *key, const char *value)
{
  if (value)
    gegl_param_spec_set_property_key (spec, key, value);
}

/* When dialogs show the property, in GIMP's language of conditions; free it.  NULL: always. */
static char *
condition (const CeldProperty *property, const CeldSettingInfo *row)
{
  const char *when = property->when ? property->when : row->when;

  if (!property->rare)
    return g_strdup (when);
  return when ? g_strdup_printf ("more & %s", when) : g_strdup ("more");
}

GParamSpec *
celd_operation_specify (const CeldProperty *property, const CeldSettingInfo *row)
{
  gboolean    angle = !g_strcmp0 (row->unit, "degree");
  char       *visible = condition (property, row);
  GParamSpec *spec = make_spec (row, row->name, _ (property->label ? property->label : row->label),
                                _ (property->help ? property->help : row->help));

  set_key (spec, "visible", visible);
  set_key (spec, "unit", row->unit);
  set_key (spec, angle ? "direction" : "axis", row->axis);
  /* GIMP 3.0 hides a text of several lines without its label. */
  set_key (spec, "multiline", row->type == CELD_SETTING_TEXT && !property->rare ? "true" : NULL);
  g_free (visible);
  return spec;
}
