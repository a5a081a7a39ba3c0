/* The command celdepth: chooses the sub-command.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sequence.h"

#include <locale.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdio.h>
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
  fputs ("Usage: celdepth COMMAND ...\n\n"
         "Depth for hand-drawn cartoons from scribbles and arrows.\n\n"
         "Commands:\n", where);
  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    fprintf (where, "  %-9s %s\n", commands[i]->name, commands[i]->summary);
  fprintf (where, "\n'celdepth COMMAND --help' shows the options and examples of a command.\n"
                  "Exit codes: 0 success, 1 failure, 2 wrong usage, 3 success, but relations contradict each other.\n");
}

static int
run_command (const CliCommand *command, int argc, char **argv)
{
  CliOptions options;
  int        code = cli_options_parse (command, argc, argv, &options);

  if (code == CLI_DONE)
    code = options.clip ? cli_clip_run (command, &options) : command->run (&options);
  cli_options_clear (&options);
  return code;
}

int
main (int argc, char **argv)
{
  const char *word = argc > 1 ? argv[1] : "";

#ifdef __GLIBC__
  /* Returns pictures to the system when they are freed.  Otherwise glibc raises this threshold and keeps large blocks:
   * up to 50 bytes per pixel more (measured). */
  mallopt (M_MMAP_THRESHOLD, 1 << 20);
#endif
  /* The locale is for file names only; numbers have a decimal point in any locale. */
  setlocale (LC_CTYPE, "");
  if (!strcmp (word, "--help") || !strcmp (word, "-h") || !strcmp (word, "help"))
    {
      print_help (stdout);
      return CLI_DONE;
    }
  if (!strcmp (word, "--version"))
    {
      puts ("celdepth " CELDEPTH_VERSION);
      return CLI_DONE;
    }
  for (size_t i = 0; i < G_N_ELEMENTS (commands); i++)
    if (!strcmp (word, commands[i]->name))
      {
        celd_io_fork_reader (); /* while there is one thread */
        return run_command (commands[i], argc - 1, argv + 1);
      }
  if (word[0])
    cli_say ("There is no command '%s'.", word);
  print_help (stderr);
  return CLI_USAGE;
}
