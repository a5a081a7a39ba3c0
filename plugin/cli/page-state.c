/* What earlier runs have left of a page: a small JSON file, .PAGE.state.json, with a fingerprint of all that the
 * results were made from.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "book.h"
#include "fingerprint.h"
#include "json.h"

#include <string.h>

char *
cli_page_state_path (const CliPage *page)
{
  char *name = g_strdup_printf (".%s.state.json", page->name);
  char *path = g_build_filename (page->book->folder, name, NULL);

  g_free (name);
  return path;
}

bool
cli_page_take_fingerprint (CliPage *page)
{
  const CliBook *book = page->book;
  GChecksum  *sum = cli_fingerprint_new (&book->options.settings);

  for (guint i = 0; i < book->common->len; i++)
    if (strcmp (book->common->pdata[i], "--quiet") && strcmp (book->common->pdata[i], "-q"))
      g_checksum_update (sum, book->common->pdata[i], (gssize) strlen (book->common->pdata[i]) + 1);
  for (guint i = 0; i < book->results->len; i++)
    {
      const CliResult *result = &g_array_index (book->results, CliResult, i);

      g_checksum_update (sum, (const guchar *) result->option, -1);
      g_checksum_update (sum, (const guchar *) result->ending, (gssize) strlen (result->ending) + 1);
    }
  page->fingerprint = cli_fingerprint_end (sum, cli_fingerprint_add_file (sum, book->options.relations_file) &&
                                                cli_fingerprint_add_file (sum, page->path));
  return page->fingerprint != NULL;
}

/* Whether a result is there, or all its files if there are several. */
static bool
is_there (const char *path, bool maps)
{
  bool there = maps || g_file_test (path, G_FILE_TEST_IS_REGULAR);

  for (int map = 0; maps && map < CLI_MAPS && there; map++)
    {
      char *name = cli_map_name (path, map);

      there = g_file_test (name, G_FILE_TEST_IS_REGULAR);
      g_free (name);
    }
  return there;
}

bool
cli_page_is_made (const CliPage *page, bool *contradicted)
{
  const CliBook *book = page->book;
  char       *path = cli_page_state_path (page);
  JsonParser *parser = json_parser_new_immutable ();
  JsonNode   *root = cli_json_read (parser, path, true) ? json_parser_get_root (parser) : NULL;
  JsonObject *state = root && JSON_NODE_HOLDS_OBJECT (root) ? json_node_get_object (root) : NULL;
  bool        made = state && !g_strcmp0 (json_object_get_string_member_with_default (state, "fingerprint", NULL),
                                          page->fingerprint);

  *contradicted = made && json_object_get_boolean_member_with_default (state, "contradicted", FALSE);
  for (guint i = 0; i < book->results->len && made; i++)
    {
      const CliResult *result = &g_array_index (book->results, CliResult, i);
      char            *result_path = cli_book_result_path (book, page->name, result);

      made = is_there (result_path, !strcmp (result->option, "maps"));
      g_free (result_path);
    }
  g_object_unref (parser);
  g_free (path);
  return made;
}

bool
cli_page_write_state (const CliPage *page, bool contradicted)
{
  char        *path = cli_page_state_path (page);
  JsonBuilder *json = json_builder_new ();
  bool         good;

  json_builder_begin_object (json);
  json_builder_set_member_name (json, "fingerprint");
  json_builder_add_string_value (json, page->fingerprint);
  json_builder_set_member_name (json, "contradicted");
  json_builder_add_boolean_value (json, contradicted);
  json_builder_end_object (json);
  good = cli_write_json (path, json);
  g_free (path);
  return good;
}

void
cli_page_remove_unfinished (const CliPage *page)
{
  const CliBook *book = page->book;
  char       *state = cli_page_state_path (page);

  cli_remove_unfinished (state);
  for (guint i = 0; i < book->results->len; i++)
    {
      char *path = cli_book_result_path (book, page->name, &g_array_index (book->results, CliResult, i));

      cli_remove_unfinished (path);
      g_free (path);
    }
  g_free (state);
}
