/* The properties of an operation, and their values.
 *
 * A value that a host sets is kept as a GValue, so that the host gets it back unchanged, and converted into a member of
 * the operation's CeldSettings or CeldOwnValues.
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

/* Whether the row is a setting of core, and not one over CeldOwnValues. */
static gboolean
is_setting (const CeldSettingInfo *row)
{
  return celd_setting_find (row->name) == row;
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
      g_object_class_install_property (G_OBJECT_CLASS (klass), i + 1, celd_operation_specify (&list[i], klass->row[i]));
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
