/* What earlier runs have left of a page: a small JSON file, .PAGE.state.json, with a fingerprint of all that the
 * results were made from, and their sizes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "book.h"
#include "fingerprint.h"
#include "json.h"

#include <glib/gstdio.h>
#include <string.h>
#include <sys/stat.h>

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

/* The size of a file in bytes; -1: there is none. */
static gint64
size_of (const char *path)
{
  GStatBuf about;

  return g_stat (path, &about) || !S_ISREG (about.st_mode) ? -1 : (gint64) about.st_size;
}

/* Appends the sizes of the files of all results, gint64. */
static void
take_sizes (const CliPage *page, GArray *sizes)
{
  const GArray *results = page->book->results;

  for (guint i = 0; i < results->len; i++)
    {
      const CliResult *result = &g_array_index (results, CliResult, i);
      char            *path = cli_book_result_path (page->book, page->name, result);
      bool             maps = !strcmp (result->option, "maps");

      for (int map = 0; map < (maps ? CLI_MAPS : 1); map++)
        {
          char  *name = maps ? cli_map_name (path, map) : g_strdup (path);
          gint64 size = size_of (name);

          g_array_append_val (sizes, size);
          g_free (name);
        }
      g_free (path);
    }
}

/* Whether all results are there, as long as they were: a full disk, or a crash of the machine, cuts files off. */
static bool
are_whole (const CliPage *page, JsonObject *state)
{
  JsonNode  *node = json_object_get_member (state, "sizes");
  JsonArray *known = node && JSON_NODE_HOLDS_ARRAY (node) ? json_node_get_array (node) : NULL;
  GArray    *sizes = g_array_new (FALSE, FALSE, sizeof (gint64));
  bool       whole;

  take_sizes (page, sizes);
  whole = known && json_array_get_length (known) == sizes->len;
  for (guint i = 0; i < sizes->len && whole; i++)
    {
      gint64 size = g_array_index (sizes, gint64, i);

      node  = json_array_get_element (known, i);
      whole = size >= 0 && JSON_NODE_HOLDS_VALUE (node) && json_node_get_int (node) == size;
    }
  g_array_free (sizes, TRUE);
  return whole;
}

bool
cli_page_is_made (const CliPage *page, bool *contradicted)
{
  char       *path = cli_page_state_path (page);
  JsonParser *parser = json_parser_new_immutable ();
  JsonNode   *root = cli_json_read (parser, path, true) ? json_parser_get_root (parser) : NULL;
  JsonObject *state = root && JSON_NODE_HOLDS_OBJECT (root) ? json_node_get_object (root) : NULL;
  bool        made = state && !g_strcmp0 (json_object_get_string_member_with_default (state, "fingerprint", NULL),
                                          page->fingerprint);

  *contradicted = made && json_object_get_boolean_member_with_default (state, "contradicted", FALSE);
  made = made && are_whole (page, state);
  g_object_unref (parser);
  g_free (path);
  return made;
}

bool
cli_page_write_state (const CliPage *page, bool contradicted)
{
  char        *path = cli_page_state_path (page);
  JsonBuilder *json = json_builder_new ();
  GArray      *sizes = g_array_new (FALSE, FALSE, sizeof (gint64));
  bool         good;

  take_sizes (page, sizes);
  json_builder_begin_object (json);
  json_builder_set_member_name (json, "fingerprint");
  json_builder_add_string_value (json, page->fingerprint);
  json_builder_set_member_name (json, "contradicted");
  json_builder_add_boolean_value (json, contradicted);
  json_builder_set_member_name (json, "sizes");
  json_builder_begin_array (json);
  for (guint i = 0; i < sizes->len; i++)
    json_builder_add_int_value (json, g_array_index (sizes, gint64, i));
  json_builder_end_array (json);
  json_builder_end_object (json);
  g_array_free (sizes, TRUE);
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
