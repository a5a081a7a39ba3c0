/* celdepth smooth: smooth depth from levels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

/* Reads painted pixels as anchors, which keep their level. */
static bool
read_anchors (const CliOptions *options, CliLayers *layers, CeldMask *anchors)
{
  CeldPaint   paint = { 0 };
  CeldLabels  seeds = { 0 };
  CeldPalette palette = { 0 };
  size_t      n = (size_t) layers->width * (size_t) layers->height;
  bool        good = cli_layer_read (options->scribbles, "scribbles", layers, &paint) &&
                     cli_check_scribbles (options->scribbles, &paint) &&
                     cli_labels_new (paint.width, paint.height, &seeds) &&
                     cli_check (celd_scribbles_read (&paint, &options->settings, NULL, &seeds, &palette));

  *anchors = (CeldMask) { layers->width, layers->height, (size_t) layers->width, good ? g_try_new (uint8_t, n) : NULL };
  for (size_t i = 0; anchors->data && i < n; i++)
    anchors->data[i] = seeds.data[i] != 0;
  g_free (paint.data);
  g_free (seeds.data);
  celd_palette_clear (&palette);
  return good && (anchors->data || cli_check (CELD_NO_MEMORY));
}

static int
run_smooth (const CliOptions *options)
{
  CliStep   step;
  CeldMask  anchors = { 0 };
  CeldSolve solve = { 0 };
  bool      good = cli_step_begin (options, &step) &&
                   (!options->scribbles || read_anchors (options, &step.layers, &anchors));

  if (good)
    {
      float nearest = cli_nearest_level (&step.levels);

      cli_run_stage (&step.run, "depth");
      good = cli_run_finish (&step.run, celd_smooth (&step.ink, cli_step_borders (&step), &step.levels,
                                                     anchors.data ? &anchors : NULL, &options->settings,
                                                     &step.run.host, &step.levels, &solve)) &&
             cli_write_depth (options->depth, &step.levels, nearest);
    }
  if (good && !solve.converged && !options->quiet)
    {
      CeldProblem problem = { .kind = CELD_PROBLEM_NOT_CONVERGED, .relation = CELD_NO_INDEX };

      cli_say_problems (NULL, &(CeldProblems) { .item = &problem, .n = 1 }, NULL, NULL);
    }
  g_free (anchors.data);
  return cli_step_end (&step, good);
}

const CliCommand cli_smooth_command = {
  .name     = "smooth",
  .step     = CLI_SMOOTH,
  .input    = "LEVELS",
  .summary  = "Turns levels into smooth depth, which changes abruptly at contours only.",
  .examples = "  celdepth smooth levels.npy --drawing bee.png --scribbles strokes.png --depth depth.exr",
  .settings = "ink ink-threshold hold-rest hold-gaps tolerance",
  .output   = "depth",
  .run      = run_smooth,
};
