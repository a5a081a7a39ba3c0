/* celdepth expand: depth expansion, which gives contours to the regions that they outline.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static int
run_expand (const CliOptions *options)
{
  CliStep     step;
  CeldLabels  regions = { 0 };
  CeldPalette palette = { 0 };
  bool        good = cli_step_begin (options, &step) &&
                     (!options->regions || cli_step_regions (options, &step, &regions, &palette));

  if (good)
    {
      cli_run_stage (&step.run, "levels");
      good = cli_run_finish (&step.run, celd_expand_levels (&step.ink, cli_step_colours (&step), &step.levels,
                                                            regions.data ? &regions : NULL, NULL,
                                                            options->settings.expansion, &step.run.host,
                                                            &step.levels)) &&
             cli_write_depth (options->levels, &step.levels, cli_nearest_level (&step.levels));
    }
  g_free (regions.data);
  celd_palette_clear (&palette);
  return cli_step_end (&step, good);
}

const CliCommand cli_expand_command = {
  .name     = "expand",
  .step     = CLI_EXPAND,
  .input    = "LEVELS",
  .summary  = "Gives each contour to the region that it outlines.",
  .examples = "  celdepth expand flat-levels.npy --drawing bee.png --regions flat.png --levels levels.npy",
  .settings = "ink expansion",
  .output   = "levels",
  .run      = run_expand,
};
