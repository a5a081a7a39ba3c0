/* The command celdepth: chooses the sub-command.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "huge-pages.h"
#include "on-demand.h"
#include "pages.h"
#include "sequence.h"

#include <errno.h>
#include <fcntl.h>
#include <glib/gi18n.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const CliCommand *const commands[] = {
  &cli_popup_command,  &cli_segment_command, &cli_order_command,  &cli_expand_command,
  &cli_smooth_command, &cli_shade_command,   &cli_enhance_command, &cli_stereo_command,
  &cli_wiggle_command, &cli_relief_command,  &cli_exact_command,  &cli_layers_command,
  &cli_register_command, &cli_compose_command, &cli_propagate_command,
  &cli_deform_command,  &cli_inbetween_command,
};

static void
print_help (FILE *where)
{
  fputs ("Usage: celdepth COMMAND ...\n"
         "       celdepth help COMMAND\n\n"
         "Depth for hand-drawn cartoons from scribbles and arrows.\n\n"
         "Commands:\n", where);
  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    fprintf (where, "  %-9s %s\n", commands[i]->name, commands[i]->summary);
  fprintf (where, "\n'celdepth COMMAND --help' shows the options and examples of a command.\n"
                  "Exit codes: 0 success, 1 failure, 2 wrong usage, 3 success, but relations contradict each other.\n");
}

static const CliCommand *
find_command (const char *name)
{
  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    if (!strcmp (name, commands[i]->name))
      return commands[i];
  return NULL;
}

/* Answers a word that is no command. */
static int
refuse (const char *word)
{
  const char *names[G_N_ELEMENTS (commands) + 1] = { NULL }, *nearest;

  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    names[i] = commands[i]->name;
  nearest = word[0] ? cli_nearest_name (word, names) : NULL;
  if (nearest)
    cli_say ("There is no command '%s'. Did you mean '%s'?", word, nearest);
  else if (word[0])
    cli_say ("There is no command '%s'.", word);
  if (!nearest)
    print_help (stderr);
  return CLI_USAGE;
}

static const CeldIoKeeper keeper = { cli_file_complete, cli_file_owns };

/* What reads and writes files is loaded only now, because it takes long. */
static int
run_with_files (const CliCommand *command, const CliOptions *options)
{
  CeldIoError error;

  if (!celd_io_load (&error))
    {
      cli_say ("%s", error.text);
      return CLI_FAILED;
    }
  celd_io_fork_reader (); /* while there is one thread */
  celd_io_set_keeper (&keeper);
  return options->clip ? cli_clip_run (command, options) : command->run (options);
}

/* The same, with results that appear together: of the run, or else of each frame of a clip, or each time. */
static int
run_whole (const CliCommand *command, CliOptions *options)
{
  bool parts = options->clip || options->watch || command->step == CLI_PROPAGATE;
  int  code;

  if (!parts)
    cli_files_hold ();
  code = run_with_files (command, options);
  if ((code == CLI_DONE || code == CLI_CONTRADICTED) && !cli_streams_write (&options->streams))
    code = CLI_FAILED;
  return parts ? code : cli_files_end (code);
}

static int
run_command (const CliCommand *command, int argc, char **argv)
{
  CliOptions options;
  int        code;

  if (cli_pages_asked (command, argc, argv))
    return cli_pages_run (command, argc, argv);
  code = cli_options_parse (command, argc, argv, &options);
  setlocale (LC_MESSAGES, ""); /* What is wrong with options is said in English, as help is. */
  if (code == CLI_DONE && !options.help)
    code = run_whole (command, &options);
  cli_options_clear (&options);
  return code;
}

/* Answers "help", with what follows it. */
static int
help (int argc, char **argv)
{
  char *words[] = { argc > 2 ? argv[2] : NULL, "--help", NULL };

  if (argc > 3)
    {
      cli_say ("Give one command to help: celdepth help %s.", find_command (argv[2]) ? argv[2] : "popup");
      return CLI_USAGE;
    }
  if (argc > 2 && strcmp (argv[2], "--help") != 0 && strcmp (argv[2], "-h") != 0)
    return find_command (argv[2]) ? run_command (find_command (argv[2]), 2, words) : refuse (argv[2]);
  print_help (stdout);
  return CLI_DONE;
}

static int
run_words (int argc, char **argv)
{
  const char *word = argc > 1 ? argv[1] : "";

  if (!strcmp (word, "help"))
    return help (argc, argv);
  if (!strcmp (word, "--help") || !strcmp (word, "-h"))
    return help (1, argv);
  if (!strcmp (word, "--version"))
    {
      puts ("celdepth " CELDEPTH_VERSION);
      return CLI_DONE;
    }
  if (find_command (word))
    return run_command (find_command (word), argc - 1, argv + 1);
  return refuse (word);
}

/* Opens standard input, output and error where the caller has closed them, so that no other file gets their numbers.
 * None can be used: reading and writing fails. */
static void
open_standard_files (void)
{
  for (int number = 0; number < 3; number++)
    if (fcntl (number, F_GETFD) < 0 && open ("/dev/null", number ? O_RDONLY : O_WRONLY) != number)
      exit (CLI_FAILED);
}

int
main (int argc, char **argv)
{
  int code;

  open_standard_files ();
  cli_use_huge_pages (argv);
  /* The locale is for file names and messages only; numbers have a decimal point in any locale. */
  setlocale (LC_CTYPE, "");
  bindtextdomain ("celdepth", CELD_LOCALE_FOLDER);
  bind_textdomain_codeset ("celdepth", "UTF-8");
  textdomain ("celdepth");
  code = run_words (argc, argv);
  if (code == CLI_DONE && (fflush (stdout) || ferror (stdout)))
    {
      cli_say ("Cannot write standard output: %s.", cli_file_reason (errno));
      code = CLI_FAILED;
    }
  return code;
}
