/* Parses the options of a sub-command: files (options-files.c), settings (options-settings.c), whole numbers
 * (options-counts.c).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <stdio.h>
#include <string.h>

/* Options without a value. */
typedef struct { gboolean quiet, progress, directx, watch, help; } CliFlags;

/* Whether a message is about an option that other programs write their one result by. */
static bool
is_about_output (const char *message)
{
  return g_str_has_suffix (message, " -o") || g_str_has_suffix (message, " --output") || strstr (message, " --output=");
}

/* Prints why the command line cannot be parsed, and which option was probably meant. */
static void
say_error (const CliCommand *command, const GError *error, const CliOptionList *list)
{
  const char  *unknown = strstr (error->message, "--"), *nearest = NULL;
  char        *name = unknown ? g_strndup (unknown + 2, strcspn (unknown + 2, "=")) : NULL;
  const char **names = g_new0 (const char *, list->entries->len + 1);
  bool         known = !g_error_matches (error, G_OPTION_ERROR, G_OPTION_ERROR_UNKNOWN_OPTION);

  for (guint i = 0; i < list->entries->len; i++)
    names[i] = g_array_index (list->entries, GOptionEntry, i).long_name;
  if (!known && name)
    nearest = cli_nearest_name (name, names);
  if (!known && is_about_output (error->message))
    cli_say ("%s: each result has an option of its own, such as --%s.", error->message, command->output);
  else if (nearest)
    cli_say ("%s. Did you mean --%s?", error->message, nearest);
  else
    cli_say ("%s", error->message);
  g_free (name);
  g_free (names);
}

/* ------------------------------------------------------------------ words */

/* The option of a word such as "--depth", "--depth=OUT" or "-n"; NULL: it is none. */
static const GOptionEntry *
find_option (const CliOptionList *list, const char *word)
{
  size_t n = word[0] == '-' && word[1] == '-' ? strcspn (word + 2, "=") : 0;

  for (guint i = 0; word[0] == '-' && i < list->entries->len; i++)
    {
      const GOptionEntry *entry = &g_array_index (list->entries, GOptionEntry, i);

      if (word[1] == '-' ? strlen (entry->long_name) == n && !strncmp (entry->long_name, word + 2, n)
                         : (word[1] && entry->short_name == word[1] && !word[2]))
        return entry;
    }
  return NULL;
}

/* Whether the word after that of an option must be its value. */
static bool
needs_value (const GOptionEntry *entry, const char *word)
{
  return entry->arg != G_OPTION_ARG_NONE && !(entry->flags & G_OPTION_FLAG_OPTIONAL_ARG) &&
         !(word[1] == '-' && strchr (word, '='));
}

/* Switches that are no settings may, since scripts of propagate add --quiet to any command. */
static bool
may_repeat (const GOptionEntry *entry)
{
  return entry->arg == G_OPTION_ARG_NONE || entry->arg == G_OPTION_ARG_STRING_ARRAY ||
         entry->arg == G_OPTION_ARG_FILENAME_ARRAY ||
         !strcmp (entry->long_name, "relations");
}

/* Is a word an option, and no value?  Negative numbers and "-" are values. */
static bool
is_option (const char *word)
{
  return word[0] == '-' && (word[1] == '-' || g_ascii_isalpha (word[1]));
}

/* Whether each option that needs a value has one, and none has two; if not, prints which one.  An option never takes
 * the next one for its value. */
static bool
check_values (const CliOptionList *list, int argc, char **argv)
{
  for (int i = 1; i < argc && strcmp (argv[i], "--") != 0; i++)
    {
      const GOptionEntry *entry = find_option (list, argv[i]);

      for (int k = 1; entry && !may_repeat (entry) && k < i; k++)
        if (find_option (list, argv[k]) == entry)
          return cli_error ("--%s is given twice.", entry->long_name);
      if (!entry || !needs_value (entry, argv[i]))
        continue;
      if (i + 1 == argc)
        return cli_error ("%s needs a value: %s %s.", argv[i], argv[i], entry->arg_description);
      if (is_option (argv[i + 1]))
        return cli_error ("%s needs a value (%s %s), but the option %s follows.", argv[i], argv[i],
                          entry->arg_description, argv[i + 1]);
      i++;
    }
  return true;
}

/* GOption knows switches that take a value or none, but gives them the next word, which may be a page.  Those that are
 * no settings are therefore looked at before: one that is on stays without a value, one that is off is removed.  False
 * with a message. */
static bool
take_switches (const CliOptionList *list, int *argc, char **argv)
{
  int n = 1, i = 1;

  for (; i < *argc && strcmp (argv[i], "--") != 0; i++)
    {
      const GOptionEntry *entry = find_option (list, argv[i]);
      char               *value = strchr (argv[i], '=');
      bool                on = true;

      if (entry && entry->arg == G_OPTION_ARG_NONE && value)
        {
          if (!cli_switch_read (value + 1, &on))
            return cli_error ("--%s must be yes, no, true or false, not '%s'.", entry->long_name, value + 1);
          *value = 0;
        }
      argv[n] = argv[i];
      if (entry && entry->arg == G_OPTION_ARG_NONE && !value && i + 1 < *argc && cli_switch_read (argv[i + 1], &on))
        i++;
      n += on;
    }
  while (i < *argc)
    argv[n++] = argv[i++];
  argv[n] = NULL;
  *argc   = n;
  return true;
}

/* ------------------------------------------------------------------ the command line */

/* Removes the first "--", after which words are no options, however they begin: GOption leaves it before such words. */
static void
drop_end_of_options (int *argc, char **argv)
{
  int i = 1;

  while (i < *argc && strcmp (argv[i], "--") != 0)
    i++;
  if (i == *argc)
    return;
  memmove (argv + i, argv + i + 1, (size_t) (*argc - i) * sizeof *argv); /* with the NULL at the end */
  (*argc)--;
}

/* Parses the command line with GOption. */
static bool
parse_words (const CliCommand *command, CliOptionList *list, int *argc, char ***argv, CliOptions *options)
{
  GOptionContext *context = g_option_context_new (NULL);
  GOptionGroup   *group = g_option_group_new ("main", "", "", options, NULL);
  GError         *error = NULL;
  bool            good;

  g_option_group_add_entries (group, (const GOptionEntry *) (void *) list->entries->data);
  g_option_context_set_main_group (context, group);
  g_option_context_set_help_enabled (context, FALSE);
  good = g_option_context_parse (context, argc, argv, &error);
  if (good)
    drop_end_of_options (argc, *argv);
  else
    say_error (command, error, list);
  g_clear_error (&error);
  g_option_context_free (context);
  return good;
}

/* Collects the options of a command, and parses them. */
static bool
parse (const CliCommand *command, int *argc, char ***argv, CliOptions *options)
{
  CliFlags      flags = { 0 };
  CliOptionList list = { g_array_new (TRUE, TRUE, sizeof (GOptionEntry)), g_ptr_array_new () };
  bool          good;

  if (command->step == CLI_PROPAGATE)
    cli_clip_options_append (options, &list);
  cli_files_append (command, options, &list);
  cli_counts_append (command, &list);
  if (command->step & (CLI_POPUP | CLI_SHADE))
    cli_list_add (&list, "Output", (GOptionEntry) {
      "directx", 0, 0, G_OPTION_ARG_NONE, &flags.directx,
      "green in normals points down, as in DirectX, instead of up", NULL });
  cli_settings_append (command, options, &list);
  if (command->step & GIVES_LABELS)
    cli_list_add (&list, "Other", (GOptionEntry) {
      "watch", 0, 0, G_OPTION_ARG_NONE, &flags.watch,
      "make the results again whenever an input is saved, until Ctrl+C", NULL });
  cli_list_add (&list, "Other", (GOptionEntry) {
    "quiet", 'q', 0, G_OPTION_ARG_NONE, &flags.quiet, "print errors only, no progress and no warnings", NULL });
  cli_list_add (&list, "Other", (GOptionEntry) {
    "progress", 0, 0, G_OPTION_ARG_NONE, &flags.progress,
    "show progress also where standard error is no terminal, for programs that run celdepth", NULL });
  cli_list_add (&list, "Other", (GOptionEntry) {
    "help", 'h', 0, G_OPTION_ARG_NONE, &flags.help, "print this text", NULL });
  good = check_values (&list, *argc, *argv) && take_switches (&list, argc, *argv) &&
         parse_words (command, &list, argc, argv, options);
  if (good && flags.help)
    cli_help_print (command, &list);
  options->help     = flags.help;
  options->quiet    = flags.quiet;
  options->progress = flags.progress;
  options->directx  = flags.directx;
  options->watch    = flags.watch;
  g_array_free (list.entries, TRUE);
  g_ptr_array_free (list.sections, TRUE);
  return good;
}

/* What is said of a command's input, by the first word that --help has for it. */
static const struct { const char *input, *missing, *number; } inputs[] = {
  { "DRAWING", "The drawing is missing", "one drawing" }, { "LEVELS", "The levels are missing", "one file of levels" },
  { "LABELS", "The regions are missing", "one picture of regions" }, { "SCENE", "The scene is missing", "one scene" },
  { "FRAMES", "The frames are missing", NULL }, { "FIRST", "The first drawing is missing", NULL },
  { "SECOND", "The second drawing is missing", "two drawings" },
  { "TARGET", "The second drawing is missing", "two drawings" },
};

static size_t
input_of (const char *name)
{
  size_t i = 0;

  while (i + 1 < G_N_ELEMENTS (inputs) && !g_str_has_prefix (name, inputs[i].input))
    i++;
  return i;
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
    return cli_error ("%s.", inputs[input_of (argc < 2 ? command->input : command->second)].missing);
  if (!many && argc > (command->second ? 3 : 2))
    return cli_error ("\"%s\" is one too many: give %s%s.", argv[command->second ? 3 : 2],
                      inputs[input_of (command->second ? command->second : command->input)].number,
                      command->step == CLI_POPUP ? ", or --output-dir for many pages" : "");
  options->input  = g_strdup (argv[1]);
  options->target = argc > 2 ? g_strdup (argv[2]) : NULL;
  options->inputs = g_strdupv (argv + 1);
  return cli_files_stream (command, options);
}

static bool
check (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  if (!check_input (command, argc, argv, options) || !cli_effects_check (options))
    return false;
  cli_counts_complete (options);
  cli_settings_complete (options);
  if (!cli_setting_effects_check (options))
    return false;
  if (options->settings.background == CELD_BACKGROUND_COLOUR && !options->background_colour)
    return cli_error ("--background colour needs --background-colour.");
  if (celd_settings_check (&options->settings) != CELD_OK)
    return cli_error ("--near-level must be above --far-level.");
  return options->clip || ((!command->check || command->check (options)) && cli_files_check (command, options) &&
                           cli_texts_check (options));
}

int
cli_options_parse (const CliCommand *command, int argc, char **argv, CliOptions *options)
{
  *options = (CliOptions) { .step = command->step, .settings = celd_settings () };
  if (command->begin)
    command->begin (options);
  cli_command_line_keep (argc, argv, options);
  if (parse (command, &argc, &argv, options) && (options->help || check (command, argc, argv, options)))
    {
      bool later = options->help || options->clip; /* those of a clip are checked for each frame */

      return later || cli_outputs_check_places (options) ? CLI_DONE : CLI_FAILED;
    }
  if (options->streams.failed)
    return CLI_FAILED;
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
  cli_streams_clear (&options->streams);
}
