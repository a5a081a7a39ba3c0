/* Relations as text, and text files.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------------ relations */

static void
append_number (GString *text, const char *before, double value)
{
  char number[G_ASCII_DTOSTR_BUF_SIZE];

  g_string_append (text, before);
  g_string_append (text, g_ascii_formatd (number, sizeof number, "%.6g", value));
}

static void
append_term (GString *text, const CeldTerm *term, const char *const *names)
{
  if (names)
    g_string_append_printf (text, "%s:", names[term->fragment]);
  if (term->whole)
    g_string_append_c (text, '*');
  else if (term->by_colour)
    g_string_append_printf (text, "#%02x%02x%02x", term->colour[0], term->colour[1], term->colour[2]);
  else
    {
      append_number (text, "", term->x);
      append_number (text, ",", term->y);
    }
}

char *
cli_relation_text (const CeldRelation *relation, const char *const *names)
{
  GString *text = g_string_new (NULL);

  append_term (text, &relation->nearer, names);
  g_string_append (text, relation->equal ? " = " : " > ");
  append_term (text, &relation->farther, names);
  if (relation->weight < 1 || relation->weight > 1)
    append_number (text, " @", relation->weight);
  if (relation->gap < 1 || relation->gap > 1)
    append_number (text, " +", relation->gap);
  if (relation->crack)
    g_string_append (text, " !crack");
  if (relation->anchor)
    g_string_append (text, " !anchor");
  return g_string_free (text, FALSE);
}

/* ------------------------------------------------------------------ texts that are given */

char *
cli_text_or_file (const char *given, const char *path)
{
  char *text;
  gsize length = 0;

  if (!path)
    return g_strdup (given ? given : "");
  text = cli_file_read (path, CLI_MOST_TEXT, false, &length);
  if (text && strlen (text) < length)
    {
      cli_say ("Cannot read \"%s\": it is not a text file.", path);
      g_clear_pointer (&text, g_free);
    }
  return text;
}

char *
cli_relations_text (const CliOptions *options)
{
  char *file = cli_text_or_file (NULL, options->relations_file), *all;

  if (!file || !options->relations)
    return file;
  all = g_strconcat (options->relations, "\n", file, NULL);
  g_free (file);
  return all;
}

const char *
cli_relations_place (const CliOptions *options, int *line)
{
  int before = options->relations ? 1 : 0; /* lines above those of the file */

  for (const char *c = options->relations; c && *c; c++)
    before += *c == '\n';
  if (!options->relations_file || *line <= before)
    return options->step == CLI_COMPOSE ? "\"relations\"" : "--relations";
  *line -= before;
  return options->relations_file;
}

bool
cli_check_text (CeldStatus status, const char *name, const CeldTextError *error)
{
  if (status != CELD_BAD_RELATION)
    return cli_check (status);
  return cli_error ("%s, line %d, column %d: expected %s, but found %s.", name, error->line, error->column,
                    error->expected, error->found);
}

bool
cli_check_relations (CeldStatus status, const CliOptions *options, const CeldTextError *error)
{
  CeldTextError place = *error;
  const char   *name = "";

  if (status == CELD_BAD_RELATION)
    name = cli_relations_place (options, &place.line);
  return cli_check_text (status, name, &place);
}

/* A pipe can be read once only, by the run itself, which also refuses what is no text. */
static char *
text_of_file (const char *path)
{
  gsize length;
  char *text = path && !cli_is_device (path) ? cli_file_read (path, CLI_MOST_TEXT, true, &length) : NULL;

  if (text && strlen (text) < length)
    text[0] = 0;
  return text ? text : g_strdup ("");
}

static bool
check_relations (const CliOptions *options)
{
  char         *file = text_of_file (options->relations_file);
  char         *text = options->relations ? g_strconcat (options->relations, "\n", file, NULL) : g_strdup (file);
  CeldRelations relations = { 0 };
  CeldTextError error;
  bool          good = cli_check_relations (celd_relations_parse (text, &relations, &error), options, &error) &&
                       cli_check_text (celd_arrow_path_parse (options->arrow_path ? options->arrow_path : "",
                                                              &relations, &error), "--arrow-path", &error);

  celd_relations_clear (&relations);
  g_free (text);
  g_free (file);
  return good;
}

static bool
check_handles (const char *text, const char *name)
{
  CeldHandles   handles = { 0 };
  CeldTextError error;
  bool          good = cli_check_text (celd_handles_parse (text, &handles, &error), name, &error);

  celd_handles_clear (&handles);
  return good;
}

bool
cli_texts_check (const CliOptions *options)
{
  char *handles = text_of_file (options->handles_file);
  bool  good = check_relations (options) && (!options->handles || check_handles (options->handles, "--handles")) &&
               (!options->handles_file || check_handles (handles, options->handles_file));

  g_free (handles);
  return good;
}

/* ------------------------------------------------------------------ files */

/* Writes to a device, which cannot be replaced by a finished file. */
static bool
write_device (const char *path, const char *text)
{
  FILE *device = fopen (path, "w");
  bool  good = device && fputs (text, device) >= 0;

  good = device && !fclose (device) && good;
  return good || cli_error ("Cannot write \"%s\": %s.", path, g_strerror (errno));
}

bool
cli_write_text (const char *path, const char *text)
{
  char *unfinished;
  FILE *file;
  bool  good;

  if (cli_is_device (path))
    return write_device (path, text);
  unfinished = cli_unfinished_name (path);
  file = fopen (unfinished, "w");
  good = file && fputs (text, file) >= 0;
  good = file && !fclose (file) && good && cli_file_complete (unfinished, path);
  if (!good)
    cli_say ("Cannot write \"%s\": %s.", path, g_strerror (errno));
  if (!good && file)
    g_unlink (unfinished);
  g_free (unfinished);
  return good;
}

bool
cli_write_relations (const char *path, const CeldRelations *relations)
{
  GString *all = g_string_new (NULL);
  bool     good;

  for (size_t i = 0; i < relations->n; i++)
    {
      char *text = cli_relation_text (&relations->item[i], NULL);

      g_string_append_printf (all, "%s\n", text);
      g_free (text);
    }
  good = cli_write_text (path, all->str);
  g_string_free (all, TRUE);
  return good;
}
