/* --help of a sub-command: its options by theme, in at most 100 columns.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stdio.h>
#include <string.h>

#define WIDTH  100 /* columns of a line at most (chosen) */
#define INDENT 28  /* columns before the text of an option (chosen) */

#define HARD_SPACE "\1" /* stands for a space where no line is broken */

void
cli_list_add (CliOptionList *list, const char *section, GOptionEntry entry)
{
  g_array_append_val (list->entries, entry);
  g_ptr_array_add (list->sections, (gpointer) section);
}

/* Prints words from a column on, and breaks lines, but not between "(default:" and the first word of it. */
static void
print_words (const char *text, int column, int indent)
{
  char **start = g_strsplit (text, "(default: ", 0);
  char  *unbroken = g_strjoinv ("(default:" HARD_SPACE, start), **words = g_strsplit (unbroken, " ", 0);
  bool   first = true;

  g_strfreev (start);
  g_free (unbroken);
  for (int i = 0; words[i]; i++)
    {
      int length = (int) g_utf8_strlen (words[i], -1);

      if (!first && column + 1 + length > WIDTH)
        {
          printf ("\n%*s", indent, "");
          column = indent;
          first  = true;
        }
      printf ("%s%s", first ? "" : " ", g_strdelimit (words[i], HARD_SPACE, ' '));
      column += length + !first;
      first   = false;
    }
  putchar ('\n');
  g_strfreev (words);
}

/* Prints "  -n, --name=VALUES", and returns the column behind it.  A long list of values goes on in the next line,
 * after a "|" at the end. */
static int
print_name (const GOptionEntry *entry)
{
  char  *start = entry->short_name ? g_strdup_printf ("  -%c, --%s", entry->short_name, entry->long_name)
                                   : g_strdup_printf ("  --%s", entry->long_name);
  char **values = g_strsplit (entry->arg_description ? entry->arg_description : "", "|", 0);
  int    column = printf ("%s", start), indent = column + 1;

  for (int i = 0; values[i]; i++)
    {
      if (i && column + (int) strlen (values[i]) + 2 > WIDTH)
        {
          printf ("|\n%*s%s", indent, "", values[i]);
          column = indent + (int) strlen (values[i]);
        }
      else
        column += printf ("%s%s", i ? "|" : "=", values[i]);
    }
  g_strfreev (values);
  g_free (start);
  return column;
}

static void
print_option (const GOptionEntry *entry)
{
  int column = print_name (entry);

  if (column + 2 <= INDENT)
    printf ("%*s", INDENT - column, "");
  else
    printf ("\n%*s", INDENT, "");
  print_words (entry->description, INDENT, INDENT);
}

/* Prints all options of a section; they need not stand together. */
static void
print_section (const CliOptionList *list, const char *section)
{
  printf ("\n%s:\n", section);
  for (guint i = 0; i < list->entries->len; i++)
    if (!strcmp (g_ptr_array_index (list->sections, i), section))
      print_option (&g_array_index (list->entries, GOptionEntry, i));
}

static bool
is_first_of_section (const CliOptionList *list, guint entry)
{
  for (guint i = 0; i < entry; i++)
    if (!strcmp (g_ptr_array_index (list->sections, i), g_ptr_array_index (list->sections, entry)))
      return false;
  return true;
}

void
cli_help_print (const CliCommand *command, const CliOptionList *list)
{
  printf ("Usage: celdepth %s [OPTION...] %s%s%s\n\n", command->name, command->input, command->second ? " " : "",
          command->second ? command->second : "");
  print_words (command->summary, 0, 0);
  for (guint i = 0; i < list->entries->len; i++)
    if (is_first_of_section (list, i))
      print_section (list, g_ptr_array_index (list->sections, i));
  printf ("\nExamples:\n%s\n", command->examples);
}
