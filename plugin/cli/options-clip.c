/* The options of propagate that may be repeated, and the command line for scripts.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <string.h>

void
cli_clip_options_append (CliOptions *options, CliOptionList *list)
{
  const GOptionEntry entry[] = {
    { "key", 0, 0, G_OPTION_ARG_STRING_ARRAY, &options->keys,
      "the number of a frame that has scribbles; may be repeated", "NUMBER" },
    { "scribbles", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options->key_scribbles,
      "the scribbles of a key, one for each --key, in their order", "PICTURE" },
    { "arrows", 0, 0, G_OPTION_ARG_FILENAME_ARRAY, &options->key_arrows,
      "the arrows of a key, in the order of --key; later keys may have none", "PICTURE" },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (entry); i++)
    cli_list_add (list, "Input", entry[i]);
}

void
cli_command_line_keep (int argc, char **argv, CliOptions *options)
{
  GPtrArray *words = g_ptr_array_new ();
  char      *program = g_file_read_link ("/proc/self/exe", NULL);

  g_ptr_array_add (words, program ? program : g_strdup ("celdepth"));
  g_ptr_array_add (words, g_strdup ("propagate"));
  for (int i = 1; i < argc; i++)
    if (!strcmp (argv[i], "--emit-slurm"))
      i++;
    else if (!g_str_has_prefix (argv[i], "--emit-slurm="))
      g_ptr_array_add (words, g_strdup (argv[i]));
  g_ptr_array_add (words, NULL);
  options->command_line = (char **) g_ptr_array_free (words, FALSE);
}

void
cli_clip_options_clear (CliOptions *options)
{
  g_strfreev (options->inputs);
  g_strfreev (options->keys);
  g_strfreev (options->key_scribbles);
  g_strfreev (options->key_arrows);
  g_strfreev (options->command_line);
}
