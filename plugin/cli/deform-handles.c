/* The handles of deform: as text, in a text file, painted.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static bool
read_text (const char *given, const char *path, CeldHandles *handles)
{
  char         *text = cli_text_or_file (given, path);
  CeldTextError error;
  bool          good = text && cli_check_text (celd_handles_parse (text, handles, &error), path ? path : "--handles",
                                               &error);

  g_free (text);
  return good;
}

static bool
read_painted (const CliOptions *options, CliLayers *layers, CliRun *run, CeldHandles *handles)
{
  CeldArrowStyle style = options->settings.arrow_style;
  CeldPaint      paint = { 0 };
  CeldProblems   problems = { 0 };
  bool           good = cli_layer_read (options->handles_layer, "handles", layers, &paint) &&
                        cli_check_strokes (options->handles_layer, "handles-layer", &paint) &&
                        cli_run_finish (run, celd_handles_read (&paint, style, &run->host, handles, &problems));

  if (good && !handles->n)
    good = cli_error ("\"%s\" has no handle that can be read: paint dots as pins, and arrows to where something goes.",
                      options->handles_layer);
  if (good && !options->quiet)
    cli_say_problems (NULL, &problems, NULL, NULL);
  celd_problems_clear (&problems);
  g_free (paint.data);
  return good;
}

bool
cli_handles_read (const CliOptions *options, CliLayers *layers, CliRun *run, CeldHandles *handles)
{
  return read_text (options->handles, NULL, handles) &&
         (!options->handles_file || read_text (NULL, options->handles_file, handles)) &&
         (!options->handles_layer || read_painted (options, layers, run, handles));
}
