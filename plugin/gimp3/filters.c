/* Looks as presets of filters: those of the operations that have their settings.
 *
 * GIMP knows presets of a filter only from a file in the user's own folder, which it writes when the user saves one or
 * has used the filter, and looks nowhere else (gimp_operation_config_get_file () of GIMP).  So the plug-in writes the
 * file when GIMP asks for its procedures, which it does once after an installation; a file that is there is the user's.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

static const char *const operations[] = { "celdepth:lumo-shade", "celdepth:depth-enhance" };

static gboolean
has_property (GParamSpec **specs, guint n, const char *name)
{
  for (guint i = 0; i < n; i++)
    if (!g_strcmp0 (specs[i]->name, name))
      return TRUE;
  return FALSE;
}

static void
add_value (GString *text, const CeldPresetValue *v)
{
  const CeldSettingInfo *row = celd_setting_find (v->setting);
  char                   number[G_ASCII_DTOSTR_BUF_SIZE];

  g_string_append_printf (text, "\n    (%s %s)", v->setting,
                          row->type == CELD_SETTING_CHOICE ? row->choice[(int) v->value].nick
                                                           : g_ascii_formatd (number, sizeof number, "%g", v->value));
}

/* The settings of a look that the operation has, if there are any.  The time says that it is a preset, and none of the
 * settings that were used last. */
static void
add_preset (GString *text, const char *type, const CeldPreset *preset, GParamSpec **specs, guint n)
{
  char *name = g_strescape (_ (preset->label), NULL);
  gsize begin = text->len, empty;

  g_string_append_printf (text, "\n(%s \"%s\"\n    (time 0)", type, name);
  empty = text->len;
  for (const CeldPresetValue *v = preset->value; v->setting; v++)
    if (has_property (specs, n, v->setting))
      add_value (text, v);
  if (text->len == empty)
    g_string_truncate (text, begin);
  else
    g_string_append (text, ")\n");
  g_free (name);
}

static void
write_presets (const char *operation)
{
  guint        n;
  GParamSpec **specs = gegl_operation_list_properties (operation, &n);
  char        *type = g_strdup_printf ("GimpGegl-%s-config", operation), *base, *path;
  GString     *text = g_string_new ("# settings\n");

  g_strdelimit (type, ":", '-');
  base = g_strconcat (type, ".settings", NULL);
  path = g_build_filename (gimp_directory (), "filters", base, NULL);
  for (int i = 0; i < CELD_N_PRESETS; i++)
    add_preset (text, type, &celd_presets[i], specs, n);
  g_string_append (text, "\n# end of settings\n");
  if (!g_file_test (path, G_FILE_TEST_EXISTS))
    g_file_set_contents (path, text->str, (gssize) text->len, NULL); /* without it there are no presets, and no harm */
  g_string_free (text, TRUE);
  g_free (path);
  g_free (base);
  g_free (type);
  g_free (specs);
}

void
celd_filters_write_presets (void)
{
  gegl_init (NULL, NULL);
  for (gsize i = 0; i < G_N_ELEMENTS (operations); i++)
    if (gegl_has_operation (operations[i]))
      write_presets (operations[i]);
}
