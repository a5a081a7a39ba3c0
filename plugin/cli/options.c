/* Parses the options of a sub-command: files (options-files.c), settings (options-settings.c), whole numbers
 * (options-counts.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stdio.h>
#include <string.h>

/* Parses the command line with GOption. */
static bool
parse (const CliCommand *command, int *argc, char ***argv, CliOptions *options)
{
  GArray         *entries = g_array_new (TRUE, TRUE, sizeof (GOptionEntry));
  GOptionContext *context = g_option_context_new (command->input);
  GOptionGroup   *group = g_option_group_new ("main", "", "", options, NULL);
  char           *description = g_strdup_printf ("Examples:\n%s\n", command->examples);
  char           *program = g_strdup_printf ("celdepth %s", command->name);
  gboolean        quiet = FALSE, directx = FALSE;
  GError         *error = NULL;
  bool            good;

  cli_files_append (command, options, entries);
  cli_settings_append (command, options, entries);
  cli_counts_append (command, entries);
  if (command->step == CLI_SHADE)
    g_array_append_val (entries, ((GOptionEntry) {
      "directx", 0, 0, G_OPTION_ARG_NONE, &directx, "green in normals points down, as in DirectX, instead of up",
      NULL }));
  g_array_append_val (entries, ((GOptionEntry) {
    "quiet", 'q', 0, G_OPTION_ARG_NONE, &quiet, "print errors only, no progress and no hints", NULL }));
  g_option_group_add_entries (group, (const GOptionEntry *) (void *) entries->data);
  g_option_context_set_main_group (context, group);
  g_option_context_set_summary (context, command->summary);
  g_option_context_set_description (context, description);
  g_set_prgname (program);
  good = g_option_context_parse (context, argc, argv, &error);
  options->quiet   = quiet;
  options->directx = directx;
  if (!good)
    cli_say ("%s", error->message);
  g_clear_error (&error);
  g_option_context_free (context);
  g_array_free (entries, TRUE);
  g_free (description);
  g_free (program);
  return good;
}

static bool
check (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  if (argc != 2)
    return cli_error (argc < 2 ? "%s is missing." : "There is more than one %s.", command->input);
  options->input = g_strdup (argv[1]);
  cli_counts_complete (options);
  if (options->relations && options->relations_file)
    return cli_error ("Give either --relations or --relations-file.");
  if (options->settings.background == CELD_BACKGROUND_COLOUR && !options->background_colour)
    return cli_error ("--background colour needs --background-colour.");
  if (celd_settings_check (&options->settings) != CELD_OK)
    return cli_error ("--near-level must be above --far-level.");
  return (!command->check || command->check (options)) && cli_files_check (command, options);
}

int
cli_options_parse (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  *options = (CliOptions) { .step = command->step, .settings = celd_settings () };
  if (command->begin)
    command->begin (options);
  if (parse (command, &argc, &argv, options) && check (command, argc, argv, options))
    return cli_files_check_places (options) ? CLI_DONE : CLI_FAILED;
  fprintf (stderr, "'celdepth %s --help' shows its usage.\n", command->name);
  return CLI_USAGE;
}

void
cli_options_clear (CliOptions *options)
{
  cli_files_clear (options);
  cli_settings_clear (options);
  g_free (options->input);
}
