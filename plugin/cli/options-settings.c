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
  bool                   alone;   /* it takes no value, and switches the setting on */
  char                  *name, *values, *help;
} SettingOption;

static void
option_free (gpointer data)
{
  SettingOption *option = data;

  g_free (option->name);
  g_free (option->values);
  g_free (option->help);
  g_free (option);
}

/* ------------------------------------------------------------------ --help */

/* The values of an option: words with | between, or a range. */
static char *
values_of (const CeldSettingInfo *row)
{
  GString *values = g_string_new (NULL);
  char     least[G_ASCII_DTOSTR_BUF_SIZE], most[G_ASCII_DTOSTR_BUF_SIZE];

  switch (row->type)
    {
    case CELD_SETTING_CHOICE:
      for (size_t i = 0; i < row->choices; i++)
        g_string_append_printf (values, "%s%s", i ? "|" : "", row->choice[i].nick);
      break;
    case CELD_SETTING_SWITCH:
      g_string_append (values, "no|yes");
      break;
    case CELD_SETTING_COLOUR:
      g_string_append (values, "#RRGGBB");
      break;
    default:
      g_ascii_formatd (least, sizeof least, "%.10g", row->least);
      g_ascii_formatd (most, sizeof most, "%.10g", row->most);
      g_string_append_printf (values, row->least < 0 ? "%s..%s" : "%s-%s", least, most);
    }
  return g_string_free (values, FALSE);
}

static char *
text_of (const CeldSettingInfo *row, double value)
{
  char number[G_ASCII_DTOSTR_BUF_SIZE];

  switch (row->type)
    {
    case CELD_SETTING_CHOICE: return g_strdup (row->choice[(int) value].nick);
    case CELD_SETTING_SWITCH: return g_strdup (value != 0 ? "yes" : "no");
    case CELD_SETTING_COLOUR: return g_strdup_printf ("#%06x", (guint) value);
    default:                  return g_strdup (g_ascii_formatd (number, sizeof number, "%.6g", value));
    }
}

/* The first sentence of the setting's help, with a small first letter as in other options, and the default. */
static char *
help_of (const SettingOption *option, const CeldSettings *settings)
{
  const char *help = option->row->help, *end = strstr (help, ". ");
  char       *usual = text_of (option->row, celd_setting_get (option->row, settings));
  char       *text = g_strndup (help, end ? (gsize) (end - help) : strlen (help));
  char       *whole;

  text[0] = g_ascii_tolower (text[0]);
  whole   = option->alone ? g_strdup (text) : g_strdup_printf ("%s (default: %s)", text, usual);
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

static bool
read_switch (const char *text, double *value)
{
  *value = !strcmp (text, "yes");
  return *value != 0 || !strcmp (text, "no");
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

/* Sets a setting from the command line; an error if the value is not within its range. */
static gboolean
take_setting (const char *name, const char *text, gpointer data, GError **error)
{
  CliOptions          *options = data;
  const SettingOption *option = NULL;
  double               value = 1;

  for (guint i = 0; !option; i++)
    {
      option = g_ptr_array_index (options->offered, i);
      option = strcmp (option->name, name + 2) ? NULL : option;
    }
  if (option->alone || (read_value (option->row, text, &value) && celd_setting_allows (option->row, value)))
    {
      celd_setting_set (option->row, value, &options->settings);
      if (option->row->type == CELD_SETTING_COLOUR)
        {
          options->background_colour   = true;
          options->settings.background = CELD_BACKGROUND_COLOUR;
        }
      return TRUE;
    }
  g_set_error (error, G_OPTION_ERROR, G_OPTION_ERROR_BAD_VALUE, "%s cannot be '%s': the value must be %s.", name, text,
               option->values);
  return FALSE;
}

/* ------------------------------------------------------------------ the options */

static SettingOption *
option_new (const char *word, const CeldSettings *settings)
{
  SettingOption *option = g_new0 (SettingOption, 1);
  const char    *equals = strchr (word, '=');

  option->alone  = word[0] == '+';
  word          += option->alone;
  option->name   = equals ? g_strndup (word, (gsize) (equals - word)) : g_strdup (word);
  option->row    = celd_setting_find (equals ? equals + 1 : word);
  option->values = option->alone ? NULL : values_of (option->row);
  option->help   = help_of (option, settings);
  return option;
}

void
cli_settings_append (const CliCommand *command, CliOptions *options, GArray *entries)
{
  char **words = g_strsplit (command->settings, " ", 0);

  options->offered = g_ptr_array_new_with_free_func (option_free);
  for (size_t i = 0; words[i]; i++)
    {
      SettingOption *option = option_new (words[i], &options->settings);

      g_ptr_array_add (options->offered, option);
      g_array_append_val (entries, ((GOptionEntry) {
        option->name, 0, option->alone ? G_OPTION_FLAG_NO_ARG : 0, G_OPTION_ARG_CALLBACK, (gpointer) take_setting,
        option->help, option->values }));
    }
  g_strfreev (words);
}

void
cli_settings_clear (CliOptions *options)
{
  if (options->offered)
    g_ptr_array_unref (options->offered);
}
