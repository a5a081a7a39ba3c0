/* celdepth wiggle: an animation of a camera that moves in front of the drawing, which shows its depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

static CeldCamera
camera (const CliScene *s, int frame)
{
  return celd_camera_on_path (s->settings->path, frame, s->frames);
}

bool
cli_wiggle_write (const CliOptions *options, CliScene *s)
{
  s->frames = options->frames;
  return cli_scene_write (options->wiggle, s, camera, options->frames, options);
}

static int
run_wiggle (const CliOptions *options)
{
  CliScene s;
  CliRun   run;
  int      code = CLI_FAILED;
  char    *stages = g_strdup_printf ("reading labels order depth layers scene views*%d", options->frames);

  cli_run_begin (&run, options, stages);
  if (cli_scene_new (options, &run, &s))
    {
      if (cli_wiggle_write (options, &s))
        code = cli_scene_finish (options, "wiggle", &s);
    }
  cli_scene_clear (&s);
  cli_run_end (&run);
  g_free (stages);
  return code;
}

static void
begin (CliOptions *options)
{
  options->settings.disparity = CLI_WIGGLE_DISPARITY;
}

const CliCommand cli_wiggle_command = {
  .name     = "wiggle",
  .step     = CLI_WIGGLE,
  .input    = "DRAWING|LAYERED",
  .summary  = "Makes an animation of a camera that moves in front of a drawing and shows its depth.",
  .examples = "  celdepth wiggle bee.png --scribbles strokes.png --arrows arrows.png --output bee.gif\n"
              "  celdepth wiggle page.psd --path circle --frames 48 --output frames      (a folder of PNG files)",
  .settings = CLI_SETTINGS_OF_LABELS CLI_SETTINGS_OF_SCENES " path disparity convergence",
  .output   = "output",
  .begin    = begin,
  .run      = run_wiggle,
};
