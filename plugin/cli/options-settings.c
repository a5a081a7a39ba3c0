/* The options of a sub-command that are settings, made from the rows of the table of settings.  Numbers have a decimal
 * point in any locale.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"
#include <math.h>
#include <string.h>

/* One option. */
typedef struct
{
  const CeldSettingInfo *row;
  const char            *theme;
  char                  *values, *help;
  bool                   given;        /* by the command line */
} SettingOption;

static void
option_free (gpointer data)
{
  SettingOption *option = data;

  g_free (option->values);
  g_free (option->help);
  g_free (option);
}

/* ------------------------------------------------------------------ --help */

/* A number without an exponent, with up to seven digits after the point. */
static char *
number_text (double value)
{
  char   digits[G_ASCII_DTOSTR_BUF_SIZE + 400];
  size_t n = strlen (g_ascii_formatd (digits, sizeof digits, "%.7f", value));

  while (digits[n - 1] == '0')
    n--;
  n -= digits[n - 1] == '.';
  return g_strndup (digits, n);
}

/* The values of an option: words with | between, or a range. */
static char *
values_of (const CeldSettingInfo *row)
{
  GString *values = g_string_new (NULL);
  char    *least = number_text (row->least), *most = number_text (row->most);

  switch (row->type)
    {
    case CELD_SETTING_CHOICE:
      for (size_t i = 0; i < row->choices; i++)
        g_string_append_printf (values, "%s%s", i ? "|" : "", row->choice[i].nick);
      break;
    case CELD_SETTING_SWITCH:
      g_string_append (values, "yes|no");
      break;
    case CELD_SETTING_COLOUR:
      g_string_append (values, "#RRGGBB");
      break;
    default:
      g_string_append_printf (values, row->least < 0 ? "%s..%s" : "%s-%s", least, most);
    }
  g_free (least);
  g_free (most);
  return g_string_free (values, FALSE);
}

static char *
text_of (const CeldSettingInfo *row, double value)
{
  switch (row->type)
    {
    case CELD_SETTING_CHOICE: return g_strdup (row->choice[(int) value].nick);
    case CELD_SETTING_SWITCH: return g_strdup (value != 0 ? "yes" : "no");
    case CELD_SETTING_COLOUR: return g_strdup_printf ("#%06x", (guint) value);
    default:                  return number_text (value);
    }
}

/* The first sentence of the setting's help, with a small first letter as in other options, and the default. */
static char *
help_of (const CeldSettingInfo *row, const CeldSettings *settings)
{
  const char *help = row->help, *end = strstr (help, ". ");
  char       *usual = text_of (row, celd_setting_get (row, settings));
  char       *text = g_strndup (help, end ? (gsize) (end - help) : strlen (help));
  char       *whole;

  text[0] = g_ascii_tolower (text[0]);
  whole   = g_strdup_printf ("%s (default: %s)", text, usual);
  g_free (text);
  g_free (usual);
  return whole;
}

/* ------------------------------------------------------------------ values */

static bool
read_choice (const CeldSettingInfo *row, const char *text, double *value)
{
  for (size_t i = 0; i < row->choices; i++)
    if (!strcmp (row->choice[i].nick, text))
      {
        *value = (double) i;
        return true;
      }
  return false;
}

bool
cli_switch_read (const char *text, bool *on)
{
  bool yes = !strcmp (text, "yes") || !strcmp (text, "true"), no = !strcmp (text, "no") || !strcmp (text, "false");

  *on = yes || (*on && !no);
  return yes || no;
}

/* A switch without a value is on. */
static bool
read_switch (const char *text, double *value)
{
  bool on = true, good = !text || cli_switch_read (text, &on);

  *value = on;
  return good;
}

static bool
read_colour (const char *text, double *value)
{
  int n = 0;

  text  += text[0] == '#';
  *value = 0;
  while (g_ascii_isxdigit (text[n]) && n < 7)
    *value = *value * 16 + g_ascii_xdigit_value (text[n++]);
  return n == 6 && !text[n];
}

static bool
read_value (const CeldSettingInfo *row, const char *text, double *value)
{
  char *end;

  switch (row->type)
    {
    case CELD_SETTING_CHOICE: return read_choice (row, text, value);
    case CELD_SETTING_SWITCH: return read_switch (text, value);
    case CELD_SETTING_COLOUR: return read_colour (text, value);
    default:
      *value = g_ascii_strtod (text, &end);
      return end != text && !*end && (row->type != CELD_SETTING_INTEGER || *value == floor (*value));
    }
}

/* What a setting can be, in words. */
static char *
allowed (const CeldSettingInfo *row)
{
  GString *words = g_string_new (NULL);
  char    *least = number_text (row->least), *most = number_text (row->most);

  switch (row->type)
    {
    case CELD_SETTING_CHOICE:
      for (size_t i = 0; i < row->choices; i++)
        g_string_append_printf (words, "%s%s", !i ? "" : i + 1 < row->choices ? ", " : " or ", row->choice[i].nick);
      break;
    case CELD_SETTING_SWITCH:
      g_string_append (words, "yes, no, true or false");
      break;
    case CELD_SETTING_COLOUR:
      g_string_append (words, "a colour such as #ff8000");
      break;
    default:
      g_string_append_printf (words, "a %snumber between %s and %s", row->type == CELD_SETTING_INTEGER ? "whole " : "",
                              least, most);
    }
  g_free (least);
  g_free (most);
  return g_string_free (words, FALSE);
}

/* What was probably meant, as a sentence with a space before it; "" if that is not known.  Free with g_free. */
static char *
hint (const CeldSettingInfo *row, const char *text)
{
  const char **names = g_new0 (const char *, row->choices + 1), *nearest = NULL;
  char        *point = g_strdelimit (g_strdup (text), ",", '.'), *said;
  double       value;
  bool         comma = strcmp (point, text) && row->type != CELD_SETTING_CHOICE && read_value (row, point, &value);

  for (size_t i = 0; i < row->choices; i++)
    names[i] = row->choice[i].nick;
  if (row->type == CELD_SETTING_CHOICE)
    nearest = cli_nearest_name (text, names);
  said = nearest ? g_strdup_printf (" Did you mean %s?", nearest)
         : comma ? g_strdup_printf (" Numbers have a decimal point: %s.", point) : g_strdup ("");
  g_free (point);
  g_free (names);
  return said;
}

static void
refuse (const CeldSettingInfo *row, const char *name, const char *text, GError **error)
{
  char *words = allowed (row), *meant = hint (row, text);

  g_set_error (error, G_OPTION_ERROR, G_OPTION_ERROR_BAD_VALUE, "%s must be %s, not '%s'.%s", name, words, text, meant);
  g_free (meant);
  g_free (words);
}

static void
mark_given (const CeldSettingInfo *row, CliOptions *options)
{
  for (guint i = 0; i < options->offered->len; i++)
    {
      SettingOption *option = options->offered->pdata[i];

      option->given |= option->row == row;
    }
}

/* Sets a setting from the command line; an error if the value is not within its range. */
static gboolean
take_setting (const char *name, const char *text, gpointer data, GError **error)
{
  CliOptions            *options = data;
  const CeldSettingInfo *row = celd_setting_find (name + 2);
  double                 value = 1;

  if (read_value (row, text, &value) && celd_setting_allows (row, value))
    {
      celd_setting_set (row, value, &options->settings);
      mark_given (row, options);
      if (row->type == CELD_SETTING_COLOUR)
        {
          options->background_colour   = true;
          options->settings.background = CELD_BACKGROUND_COLOUR;
        }
      return TRUE;
    }
  refuse (row, name, text, error);
  return FALSE;
}

/* ------------------------------------------------------------------ presets */

static gboolean
take_preset (const char *name, const char *text, gpointer data, GError **error)
{
  CliOptions *options = data;
  GString    *names;

  options->preset = celd_preset_find (text);
  if (options->preset)
    return TRUE;
  names = g_string_new (NULL);
  for (int i = 0; i < CELD_N_PRESETS; i++)
    g_string_append_printf (names, "%s%s", !i ? "" : i + 1 < CELD_N_PRESETS ? ", " : " or ", celd_presets[i].name);
  g_set_error (error, G_OPTION_ERROR, G_OPTION_ERROR_BAD_VALUE, "%s must be %s, not '%s'.", name, names->str, text);
  g_string_free (names, TRUE);
  return FALSE;
}

static void
append_preset (CliOptions *options, CliOptionList *list)
{
  GString *names = g_string_new (celd_presets[0].name);

  for (int i = 1; i < CELD_N_PRESETS; i++)
    g_string_append_printf (names, "|%s", celd_presets[i].name);
  options->preset_names = g_string_free (names, FALSE);
  cli_list_add (list, "Light", (GOptionEntry) {
    "preset", 0, 0, G_OPTION_ARG_CALLBACK, (gpointer) take_preset,
    "settings of light and shadows that go together; those that are given as well count more (default: everyday)",
    options->preset_names });
}

/* ------------------------------------------------------------------ the options */

static SettingOption *
option_new (const char *word, const CeldSettings *settings)
{
  SettingOption         *option = g_new0 (SettingOption, 1);
  const CeldSettingInfo *row = celd_setting_find (word);

  option->row    = row;
  option->values = values_of (row);
  option->help   = help_of (row, settings);
  while (!row->theme)
    row--; /* the first of a theme names it */
  option->theme = row->theme;
  return option;
}

void
cli_settings_append (const CliCommand *command, CliOptions *options, CliOptionList *list)
{
  char **words = g_strsplit (command->settings, " ", 0);

  options->offered = g_ptr_array_new_with_free_func (option_free);
  for (size_t i = 0; words[i]; i++)
    {
      SettingOption *option = option_new (words[i], &options->settings);

      g_ptr_array_add (options->offered, option);
      cli_list_add (list, option->theme, (GOptionEntry) {
        option->row->name, 0, option->row->type == CELD_SETTING_SWITCH ? G_OPTION_FLAG_OPTIONAL_ARG : 0,
        G_OPTION_ARG_CALLBACK, (gpointer) take_setting, option->help, option->values });
    }
  g_strfreev (words);
  if (command->step == CLI_POPUP)
    append_preset (options, list);
}

void
cli_settings_complete (CliOptions *options)
{
  CeldSettings preset = celd_settings ();

  if (!options->preset)
    return;
  celd_preset_choose (options->preset, &preset);
  for (guint i = 0; i < options->offered->len; i++)
    {
      const SettingOption *option = options->offered->pdata[i];

      if (!option->given && celd_preset_covers (option->row->name))
        celd_setting_set (option->row, celd_setting_get (option->row, &preset), &options->settings);
    }
}

bool
cli_setting_given (const CliOptions *options, const char *name)
{
  for (guint i = 0; i < options->offered->len; i++)
    {
      const SettingOption *option = options->offered->pdata[i];

      if (!strcmp (option->row->name, name))
        return option->given;
    }
  return false;
}

void
cli_settings_clear (CliOptions *options)
{
  g_free (options->preset_names);
  if (options->offered)
    g_ptr_array_unref (options->offered);
}
