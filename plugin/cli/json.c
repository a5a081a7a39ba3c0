/* Reading and writing JSON.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "json.h"

#include "cli.h"

#include <stdio.h>

#define MOST_DEEP 100 /* arrays and objects in each other (chosen): the parser calls itself for each */

/* Whether brackets are not nested too deep.  *line is where that was found, or what is no JSON outside of texts: a
 * comment or a text in single quotes, which the parser would let pass. */
static bool
is_shallow (const char *text, gsize length, guint *line, bool *deep)
{
  int  depth = 0;
  bool quoted = false;

  *line = 1;
  for (gsize i = 0; i < length; i++)
    {
      *line += text[i] == '\n';
      if (text[i] == '"')
        quoted = !quoted;
      else if (quoted)
        i += text[i] == '\\';
      else if (text[i] == '[' || text[i] == '{')
        depth++;
      else if (text[i] == ']' || text[i] == '}')
        depth--;
      *deep = depth > MOST_DEEP;
      if (*deep || (!quoted && (text[i] == '/' || text[i] == '\'')))
        return false;
    }
  return true;
}

bool
cli_json_read (JsonParser *parser, const char *path, bool quiet)
{
  gsize   length = 0;
  char   *text = cli_file_read (path, CLI_MOST_TEXT, quiet, &length);
  GError *error = NULL;
  bool    deep = false, good = false, plain = text && g_utf8_validate (text, (gssize) length, NULL);
  guint   line = 1;

  if (plain && is_shallow (text, length, &line, &deep))
    good = json_parser_load_from_data (parser, text, (gssize) length, &error);
  if (error)
    sscanf (error->message, "<data>:%u:", &line); /* the parser forgets where it was */
  if (text && !plain && !quiet)
    cli_say ("Cannot read \"%s\": it is not a text file.", path);
  else if (text && deep && !quiet)
    cli_say ("Cannot read \"%s\": line %u has more than %d arrays and objects in each other.", path, line, MOST_DEEP);
  else if (text && !good && !quiet)
    cli_say ("Cannot read \"%s\": line %u is no JSON.", path, line);
  g_clear_error (&error);
  g_free (text);
  return good;
}

bool
cli_write_json (const char *path, JsonBuilder *json)
{
  JsonNode *root = json_builder_get_root (json);
  char     *data = json_to_string (root, TRUE), *text = g_strconcat (data, "\n", NULL);
  bool      good = cli_write_text (path, text);

  g_free (text);
  g_free (data);
  json_node_unref (root);
  g_object_unref (json);
  return good;
}
