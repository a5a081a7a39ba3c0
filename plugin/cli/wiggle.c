/* celdepth wiggle: the camera moves before the drawing, so that its depth is seen at a glance.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static CeldCamera
camera (const CliScene *s, int frame)
{
  return celd_camera_on_path (s->settings->path, frame, s->frames);
}

int
cli_wiggle (const CliOptions *options)
{
  CliScene s;
  CliRun   run;
  int      code = CLI_FAILED;

  cli_run_begin (&run, options->quiet);
  if (cli_scene_new (options, &run, &s))
    {
      s.frames = options->frames;
      if (cli_scene_write (options->wiggle, &s, camera, options->frames, options))
        code = cli_scene_tell (options, "wiggle", &s);
    }
  cli_scene_clear (&s);
  cli_run_end (&run);
  return code;
}
