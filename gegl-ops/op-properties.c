/* The properties of an operation, made from the rows of the table of settings.
 *
 * What a host sets is kept as it is, so that the host reads back what it set; and it goes into the CeldSettings and the
 * CeldOwnValues of the operation.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"
#include "properties.h"

/* ------------------------------------------------------------------ rows */

static const CeldSettingInfo *
row_of (const CeldProperty *property)
{
  const CeldSettingInfo *row = property->own;

  if (!row)
    row = celd_setting_find (property->name);
  return row ? row : celd_shared_property (property->name);
}

/* Does the value belong to the settings of core?  Otherwise to the CeldOwnValues. */
static gboolean
is_setting (const CeldSettingInfo *row)
{
  return celd_setting_find (row->name) == row;
}

/* ------------------------------------------------------------------ specifications */

#define FLAGS ((GParamFlags) (G_PARAM_READWRITE | G_PARAM_CONSTRUCT | (guint) GEGL_PARAM_PAD_INPUT))

static GType
choice_type (const CeldSettingInfo *row)
{
  GType       type = g_type_from_name (row->choice_type);
  GEnumValue *values;

  if (type)
    return type;
  values = g_new0 (GEnumValue, row->choices + 1); /* for as long as the type */
  for (gsize i = 0; i < row->choices; i++)
    values[i] = (GEnumValue) { (int) i, row->choice[i].label, row->choice[i].nick };
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

/* A number for hosts that draw a slider, with what they know of its meaning. */
static GParamSpec *
property_spec (const CeldProperty *property, const CeldSettingInfo *row)
{
  gboolean    turned = !g_strcmp0 (row->unit, "degree");
  GParamSpec *spec = make_spec (row, property->as ? property->as : row->name,
                                property->label ? property->label : row->label,
                                property->help ? property->help : row->help);

  set_key (spec, "visible", property->when ? property->when : row->when);
  set_key (spec, "unit", row->unit);
  set_key (spec, turned ? "direction" : "axis", row->axis);
  set_key (spec, "multiline", row->type == CELD_SETTING_TEXT ? "true" : NULL);
  return spec;
}

void
celd_operation_install (CeldOperationClass *klass)
{
  const CeldProperty *list = klass->info->properties;

  while (list[klass->n].name || list[klass->n].own)
    klass->n++;
  klass->row = g_new (const CeldSettingInfo *, klass->n);
  for (guint i = 0; i < klass->n; i++)
    {
      klass->row[i] = row_of (&list[i]);
      g_object_class_install_property (G_OBJECT_CLASS (klass), i + 1, property_spec (&list[i], klass->row[i]));
    }
}

/* ------------------------------------------------------------------ values */

static double
number_of (const GValue *value, CeldSettingType type)
{
  GeglColor *colour;
  uint8_t    rgb[3] = { 0 };

  switch (type)
    {
    case CELD_SETTING_NUMBER:  return g_value_get_double (value);
    case CELD_SETTING_INTEGER: return g_value_get_int (value);
    case CELD_SETTING_SWITCH:  return g_value_get_boolean (value);
    case CELD_SETTING_CHOICE:  return g_value_get_enum (value);
    case CELD_SETTING_COLOUR:
      colour = g_value_get_object (value);
      if (colour)
        gegl_color_get_pixel (colour, babl_format ("R'G'B' u8"), rgb);
      return rgb[0] * 65536 + rgb[1] * 256 + rgb[2];
    case CELD_SETTING_TEXT:    break;
    }
  return 0;
}

void
celd_operation_set_property (GObject *object, guint id, const GValue *value, GParamSpec *pspec)
{
  CeldOperation         *self = (CeldOperation *) object;
  CeldOperationClass    *klass = CELD_OPERATION_CLASS_OF (object);
  const CeldSettingInfo *row = klass->row[id - 1];
  void                  *record = is_setting (row) ? (void *) &self->settings : (void *) &self->own;
  GValue                *kept;

  if (!self->value)
    self->value = g_new0 (GValue, klass->n);
  kept = &self->value[id - 1];
  if (!G_IS_VALUE (kept))
    g_value_init (kept, pspec->value_type);
  g_value_copy (value, kept);
  if (row->type == CELD_SETTING_TEXT)
    *(const char **) (void *) ((char *) record + row->offset) = g_value_get_string (kept);
  else
    celd_setting_set (row, number_of (kept, row->type), record);
}

void
celd_operation_get_property (GObject *object, guint id, GValue *value, GParamSpec *pspec)
{
  g_value_copy (&((CeldOperation *) object)->value[id - 1], value);
}

void
celd_operation_clear_values (CeldOperation *self)
{
  guint n = CELD_OPERATION_CLASS_OF (self)->n;

  for (guint i = 0; self->value && i < n; i++)
    if (G_IS_VALUE (&self->value[i]))
      g_value_unset (&self->value[i]);
  g_free (self->value);
}
