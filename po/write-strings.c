/* Writes strings.c: the texts of tables that hosts show, for xgettext, which does not find them in the tables.
 *
 *   write-strings FILE           writes it
 *   write-strings --check FILE   fails if it is not what the tables say
 *
 * Core knows nothing of languages; operations and plug-ins translate its texts when they show them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op.h"
#include "properties.h"

#include <stdlib.h>
#include <string.h>

/* The text of the file, and what is in it already: a text is written once, where it is first met. */
typedef struct { GString *text; GHashTable *written; } Strings;

static void
add (Strings *strings, const char *where, const char *what, const char *text)
{
  char *escaped;

  if (!text || !*text || !g_hash_table_add (strings->written, (gpointer) text))
    return;
  escaped = g_strescape (text, NULL);
  g_string_append_printf (strings->text, "/* %s, %s */\nN_(\"%s\")\n", where, what, escaped);
  g_free (escaped);
}

static void
add_row (Strings *strings, const char *where, const CeldSettingInfo *row)
{
  add (strings, where, "label", row->label);
  for (gsize i = 0; i < row->choices; i++)
    add (strings, where, "choice", row->choice[i].label);
  add (strings, where, "help", row->help);
}

static void
add_operation (Strings *strings, const CeldOperationInfo *info)
{
  add (strings, info->name, "title", info->title);
  add (strings, info->name, "description", info->description);
  for (const CeldPad *pad = info->pads; pad->name; pad++)
    {
      add (strings, info->name, "layer", pad->label);
      add (strings, info->name, "help of a layer", pad->description);
    }
  for (const CeldProperty *property = info->properties; property->name || property->own; property++)
    {
      const CeldSettingInfo *row = property->own ? property->own : celd_shared_property (property->name);

      add (strings, info->name, "label", property->label);
      add (strings, info->name, "help", property->help);
      if (row)
        add_row (strings, info->name, row);
    }
}

int
main (int argc, char **argv)
{
  Strings                strings = { g_string_new ("/* Made by write-strings.c from tables of settings and operations. */\n"),
                                     g_hash_table_new (g_str_hash, g_str_equal) };
  size_t                 n;
  const CeldSettingInfo *row = celd_setting_infos (&n);
  gboolean               check = argc == 3 && !strcmp (argv[1], "--check"), good;
  char                  *there = NULL;

  if (argc != 2 && !check)
    return EXIT_FAILURE;
  for (size_t i = 0; i < n; i++)
    add_row (&strings, row[i].name, &row[i]);
  for (const CeldOperationInfo *const *info = celd_operations; *info; info++)
    add_operation (&strings, *info);
  if (check)
    good = g_file_get_contents (argv[2], &there, NULL, NULL) && !strcmp (there, strings.text->str);
  else
    good = g_file_set_contents (argv[1], strings.text->str, -1, NULL);
  if (check && !good)
    g_printerr ("%s is not what the tables say: see po/README.md.\n", argv[2]);
  g_free (there);
  g_string_free (strings.text, TRUE);
  g_hash_table_unref (strings.written);
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
