/* The command line of many pages: which results it asks for, and what holds for each page.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "book.h"
#include "pages.h"

#include <string.h>

static bool
is_option (const char *word, const char *name)
{
  size_t n = strlen (name);

  return !strncmp (word, name, n) && (!word[n] || word[n] == '=');
}

bool
cli_pages_asked (const CliCommand *command, int argc, char **argv)
{
  bool asked = false;

  for (int i = 1; i < argc && strcmp (argv[i], "--"); i++)
    asked = asked || is_option (argv[i], "--output-dir");
  return asked && command->step == CLI_POPUP;
}

void
cli_book_add_result (CliBook *book, const char *option, const char *ending)
{
  g_array_append_val (book->results, ((CliResult) { g_strdup (option), g_strdup (ending + (ending[0] == '.')) }));
}

/* Takes a word such as --depth or --depth=png, which may not have a name after it; false with a message.  *taken says
 * whether it is one. */
static bool
take_result (CliBook *book, const CliCommand *command, const char *word, const char *next, bool *taken)
{
  const char *value = strchr (word, '='), *ending;
  char       *option = g_strndup (word + 2, value ? (size_t) (value - word) - 2 : strlen (word) - 2);
  bool        good = true;

  ending = cli_files_ending (command, option);
  *taken = ending != NULL;
  if (ending && value && (!value[1] || strchr (value, G_DIR_SEPARATOR) || strchr (value + 2, '.')))
    good = cli_error ("With --output-dir, results are named after their pages: give --%s, or its format, such as "
                      "--%s=%s.", option, option, ending);
  else if (ending && !value && next && !strcmp (next, "-"))
    good = cli_error ("With --output-dir, results are files named after their pages: give --%s without \"-\".", option);
  else if (ending && !value && next && next[0] != '-' && !g_file_test (next, G_FILE_TEST_EXISTS))
    good = cli_error ("There is no page \"%s\". With --output-dir, results are named after their pages: give --%s "
                      "without a name.", next, option);
  else if (ending)
    cli_book_add_result (book, option, value ? value + 1 : ending);
  g_free (option);
  return good;
}

bool
cli_book_sort_words (CliBook *book, const CliCommand *command, int argc, char **argv, GPtrArray *words)
{
  bool good = true, taken;

  for (int i = 1; i < argc && good; i++)
    {
      const char *next = i + 1 < argc ? argv[i + 1] : NULL;

      taken = false;
      if (!strcmp (argv[i], "--"))
        {
          while (i < argc)
            g_ptr_array_add (words, argv[i++]);
          break;
        }
      if (is_option (argv[i], "--output-dir") || is_option (argv[i], "--jobs"))
        {
          const char *value = strchr (argv[i], '=');

          if (is_option (argv[i], "--output-dir"))
            {
              g_free (book->folder);
              book->folder = g_strdup (value ? value + 1 : next ? next : ".");
            }
          g_ptr_array_add (words, argv[i]);
          if (!value && next)
            g_ptr_array_add (words, argv[++i]);
          continue;
        }
      if (g_str_has_prefix (argv[i], "--"))
        good = take_result (book, command, argv[i], next, &taken);
      if (!taken)
        {
          g_ptr_array_add (words, argv[i]);
          g_ptr_array_add (book->common, argv[i]);
        }
    }
  return good;
}

char *
cli_book_result_path (const CliBook *book, const char *page, const CliResult *result)
{
  char *name = g_strdup_printf ("%s-%s.%s", page, result->option, result->ending);
  char *path = g_build_filename (book->folder, name, NULL);

  g_free (name);
  return path;
}

void
cli_book_name_results (const CliBook *book, const char *page, GPtrArray *words)
{
  for (guint i = 0; i < book->results->len; i++)
    {
      const CliResult *result = &g_array_index (book->results, CliResult, i);
      char            *path = cli_book_result_path (book, page, result);

      g_ptr_array_add (words, g_strdup_printf ("--%s=%s", result->option, path));
      g_free (path);
    }
}

int
cli_book_parse (CliBook *book, const CliCommand *command, GPtrArray *words)
{
  GPtrArray *named = g_ptr_array_new_with_free_func (g_free);
  int        code;

  cli_book_name_results (book, "PAGE", named); /* as --help calls it, for messages */
  for (guint i = 0; i < named->len; i++)
    g_ptr_array_insert (words, 1, named->pdata[i]);
  g_ptr_array_add (words, NULL); /* as behind the words of main */
  code = cli_options_parse (command, (int) words->len - 1, (char **) words->pdata, &book->options);
  g_ptr_array_free (named, TRUE);
  return code;
}
