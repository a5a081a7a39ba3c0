/* Parses the options of a sub-command: files (options-files.c), settings (options-settings.c), whole numbers
 * (options-counts.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stdio.h>
#include <string.h>

/* Prints why the command line cannot be parsed, and which option was probably meant. */
static void
say_error (const GError *error, const GArray *entries)
{
  const char  *unknown = strstr (error->message, "--"), *nearest = NULL;
  char        *name = unknown ? g_strndup (unknown + 2, strcspn (unknown + 2, "=")) : NULL;
  const char **names = g_new0 (const char *, entries->len + 1);

  for (guint i = 0; i < entries->len; i++)
    names[i] = g_array_index (entries, GOptionEntry, i).long_name;
  if (g_error_matches (error, G_OPTION_ERROR, G_OPTION_ERROR_UNKNOWN_OPTION) && name)
    nearest = cli_nearest_name (name, names);
  if (nearest)
    cli_say ("%s. Did you mean --%s?", error->message, nearest);
  else
    cli_say ("%s", error->message);
  g_free (name);
  g_free (names);
}

/* Parses the command line with GOption. */
static bool
parse (const CliCommand *command, int *argc, char ***argv, CliOptions *options)
{
  GArray         *entries = g_array_new (TRUE, TRUE, sizeof (GOptionEntry));
  char           *names = g_strjoin (" ", command->input, command->second, NULL);
  GOptionContext *context = g_option_context_new (names);
  GOptionGroup   *group = g_option_group_new ("main", "", "", options, NULL);
  char           *description = g_strdup_printf ("Examples:\n%s\n", command->examples);
  char           *program = g_strdup_printf ("celdepth %s", command->name);
  gboolean        quiet = FALSE, directx = FALSE, watch = FALSE;
  GError         *error = NULL;
  bool            good;

  cli_files_append (command, options, entries);
  cli_settings_append (command, options, entries);
  cli_counts_append (command, entries);
  if (command->step == CLI_SHADE)
    g_array_append_val (entries, ((GOptionEntry) {
      "directx", 0, 0, G_OPTION_ARG_NONE, &directx, "green in normals points down, as in DirectX, instead of up",
      NULL }));
  if (command->step & GIVES_LABELS)
    g_array_append_val (entries, ((GOptionEntry) {
      "watch", 0, 0, G_OPTION_ARG_NONE, &watch, "make the results again whenever an input is saved, until Ctrl+C",
      NULL }));
  if (command->step == CLI_PROPAGATE)
    cli_clip_options_append (options, entries);
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
  options->watch   = watch;
  if (!good)
    say_error (error, entries);
  g_clear_error (&error);
  g_option_context_free (context);
  g_array_free (entries, TRUE);
  g_free (description);
  g_free (names);
  g_free (program);
  return good;
}

/* Takes over the words that are not options. */
static bool
check_input (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  bool many = command->step == CLI_PROPAGATE || options->output_dir;

  if (options->clip && argc != 1)
    return cli_error ("Give either %s or --clip.", command->input);
  if (options->clip && (options->drawing || options->scribbles || options->regions))
    return cli_error ("A clip has a drawing and regions for each frame: leave out --drawing, --scribbles and "
                      "--regions.");
  if (!options->clip && (argc < 2 || (argc < 3 && command->second)))
    return cli_error ("%s is missing.", argc < 2 ? command->input : command->second);
  if (!many && argc > (command->second ? 3 : 2))
    return cli_error ("There is more than one %s.", command->second ? command->second : command->input);
  options->input  = g_strdup (argv[1]);
  options->target = argc > 2 ? g_strdup (argv[2]) : NULL;
  options->inputs = g_strdupv (argv + 1);
  return true;
}

static bool
check (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  if (!check_input (command, argc, argv, options))
    return false;
  cli_counts_complete (options);
  if (options->relations && options->relations_file)
    return cli_error ("Give either --relations or --relations-file.");
  if (options->settings.background == CELD_BACKGROUND_COLOUR && !options->background_colour)
    return cli_error ("--background colour needs --background-colour.");
  if (celd_settings_check (&options->settings) != CELD_OK)
    return cli_error ("--near-level must be above --far-level.");
  return options->clip || ((!command->check || command->check (options)) && cli_files_check (command, options));
}

int
cli_options_parse (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  *options = (CliOptions) { .step = command->step, .settings = celd_settings () };
  if (command->begin)
    command->begin (options);
  cli_command_line_keep (argc, argv, options);
  if (parse (command, &argc, &argv, options) && check (command, argc, argv, options))
    return options->clip || cli_files_check_places (options) ? CLI_DONE : CLI_FAILED; /* of a clip, for each frame */
  fprintf (stderr, "'celdepth %s --help' shows its usage.\n", command->name);
  return CLI_USAGE;
}

void
cli_options_clear (CliOptions *options)
{
  cli_files_clear (options);
  cli_settings_clear (options);
  cli_clip_options_clear (options);
  g_free (options->input);
  g_free (options->target);
}
