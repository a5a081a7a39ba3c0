/* Writes the tables of plug-ins as a module of Python.
 *
 *   write-tables > tables.py
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include <glib/gi18n.h>
#include <locale.h>
#include <stdio.h>

#include "front-end.h"
#include "layer-names.h"

static void
write_string (const char *text)
{
  putchar ('"');
  for (; text && *text; text++)
    printf (*text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
  putchar ('"');
}

static void
write_text (const char *text)
{
  write_string (text);
  printf (", ");
}

static void
write_layers (void)
{
  printf ("LAYERS = [\n");
  for (int role = 0; role < CELD_N_LAYERS; role++)
    {
      printf ("    Layer(");
      write_text (celd_layer_arguments[role]);
      write_text (celd_layer_role_name ((CeldLayerRole) role));
      write_text (celd_layer_help[role]);
      printf ("[");
      for (const char *const *name = celd_layer_role_names ((CeldLayerRole) role); *name; name++)
        write_text (*name);
      printf ("]),\n");
    }
  printf ("]\n");
}

static void
write_pictures (void)
{
  printf ("PICTURES = [\n");
  for (int i = 0; i < CELD_POPUP_PICTURES; i++)
    {
      const CeldPictureInfo *picture = &celd_pictures[celd_pictures_stacked[i]];

      printf ("    Picture(");
      write_text (picture->argument);
      write_text (picture->option);
      write_text (picture->label);
      write_text (picture->help);
      write_text (picture->layer);
      printf ("%s),\n", picture->usual ? "True" : "False");
    }
  printf ("]\n");
}

/* A value, as the command takes it; float has seven digits. */
static void
write_value (const CeldSettingInfo *row, double value)
{
  if (row->type == CELD_SETTING_SWITCH)
    write_text (value != 0 ? "yes" : "no");
  else if (row->type == CELD_SETTING_CHOICE)
    write_text (row->choice[(int) value].nick);
  else
    printf ("%.7g, ", value);
}

static void
write_setting (const CeldMainSetting *setting)
{
  const CeldSettingInfo *row = celd_setting_find (setting->name);
  CeldShownNumber        shown = celd_shown_number (row);

  printf ("    Setting(");
  write_text (row->name);
  write_text (setting->heading);
  write_text (row->label);
  write_text (row->help);
  write_value (row, row->usual);
  printf ("%.10g, %.10g, %.10g, %.10g, %d, ", row->shown.least, row->shown.most, row->shown.step, shown.factor, shown.digits);
  write_text (shown.unit);
  printf ("[");
  for (size_t i = 0; i < (setting->choices ? (size_t) setting->choices : row->choices); i++)
    {
      printf ("(");
      write_text (row->choice[i].nick);
      write_text (row->choice[i].label);
      printf ("), ");
    }
  if (row->type == CELD_SETTING_SWITCH)
    {
      printf ("(\"yes\", ");
      write_string (N_ ("Yes"));
      printf ("), (\"no\", ");
      write_string (N_ ("No"));
      printf (")");
    }
  printf ("]),\n");
}

/* The value of a setting, as the command takes it. */
static void
write_preset (const CeldPreset *preset)
{
  CeldSettings settings = celd_settings ();

  printf ("    Preset(");
  write_text (preset->name);
  write_text (preset->label);
  write_text (preset->help);
  write_text (preset->picture);
  printf ("{");
  celd_preset_choose (preset, &settings);
  for (int i = 0; i < CELD_N_MAIN_SETTINGS; i++)
    if (celd_preset_covers (celd_main_settings[i].name))
      {
        const CeldSettingInfo *row = celd_setting_find (celd_main_settings[i].name);

        write_string (row->name);
        printf (": ");
        write_value (row, celd_setting_get (row, &settings));
      }
  printf ("}),\n");
}

int
main (void)
{
  setlocale (LC_NUMERIC, "C");
  printf ("\"\"\"What is offered: made by write-tables from the tables of plugin/ and core/.\"\"\"\n"
          "from .kinds import Layer, Picture, Preset, Setting\n\n");
  write_layers ();
  write_pictures ();
  printf ("SETTINGS = [\n");
  for (int i = 0; i < CELD_N_MAIN_SETTINGS; i++)
    write_setting (&celd_main_settings[i]);
  printf ("]\nPRESETS = [\n");
  for (int i = 0; i < CELD_N_PRESETS; i++)
    write_preset (&celd_presets[i]);
  printf ("]\nOWN_LABEL = ");
  write_string (celd_own_settings_label);
  printf ("\nGROUP_NAME = ");
  write_string (CELD_GROUP_NAME);
  printf ("\n");
  return ferror (stdout) ? 1 : 0;
}
