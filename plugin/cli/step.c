/* Shared by sub-commands that make one step of levels: reading levels and making the ink of their drawing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

bool
cli_make_ink (CliLayers *layers, CeldPurpose purpose, const CliOptions *options, CliRun *run, CeldPlane *ink)
{
  CeldDrawing *drawing = &layers->drawing;
  CeldInkMode  mode = options->settings.ink;
  CeldStatus   status = CELD_OK;

  if (!cli_plane_new (drawing->luma.width, drawing->luma.height, ink))
    return false;
  cli_run_stage (run, "ink");
  if (layers->contours.data)
    status = celd_contours_bake (drawing, &layers->contours, purpose, mode, &run->host, drawing);
  if (status == CELD_OK)
    status = celd_ink (drawing, mode, &run->host, ink);
  return cli_run_finish (run, status);
}

float
cli_nearest_level (const CeldPlane *levels)
{
  float nearest = 1;

  for (size_t i = 0; i < (size_t) levels->width * (size_t) levels->height; i++)
    nearest = MAX (nearest, levels->data[i]);
  return nearest;
}

/* Lines of levels before expansion may have the level of none of their sides: expansion does not look at them. */
static bool
check_no_lines (const CliOptions *options, const CliStep *step)
{
  if (options->step != CLI_EXPAND)
    return cli_check_no_lines (options->input, &step->levels, options->drawing, &step->ink);
  return options->quiet || cli_warn_of_lines (options->input, &step->levels, options->drawing, &step->ink);
}

bool
cli_step_begin (const CliOptions *options, CliStep *step)
{
  bool good;

  *step = (CliStep) { 0 };
  cli_run_begin (&step->run, options, "reading ink levels depth relief mesh writing");
  if (!cli_read_levels (options->input, &step->levels) || !cli_check_levels (options->input, &step->levels))
    return false;
  step->layers.width  = step->levels.width;
  step->layers.height = step->levels.height;
  good = cli_layers_read (options->drawing, options, CLI_CONTOURS, &step->layers) &&
         cli_check_not_exchanged (options, &step->levels, &step->layers) &&
         cli_make_ink (&step->layers, CELD_FOR_DEPTH, options, &step->run, &step->ink) &&
         cli_check_lines (options->drawing, &step->ink) && check_no_lines (options, step) &&
         cli_check_steps (options->input, &step->levels, options, &step->layers, options->drawing, &step->ink) &&
         (!step->layers.contours.data ||
          cli_make_ink (&step->layers, CELD_FOR_SEGMENTATION, options, &step->run, &step->borders));
  if (good && !options->quiet)
    cli_warn_if_flat (options->input, &step->levels);
  return good;
}

const CeldPlane *
cli_step_borders (const CliStep *step)
{
  return step->borders.data ? &step->borders : NULL;
}

const CeldPaint *
cli_step_colours (const CliStep *step)
{
  return step->layers.colours.data ? &step->layers.colours : NULL;
}

bool
cli_regions_read (const char *path, CliLayers *layers, CeldLabels *regions, CeldPalette *palette)
{
  CeldPaint paint = { 0 };
  bool      good = cli_layer_read (path, "labels", layers, &paint) &&
                   cli_labels_new (paint.width, paint.height, regions) &&
                   cli_check (celd_labels_read (&paint, regions, palette)) &&
                   cli_check_regions (path, regions, palette);

  g_free (paint.data);
  return good;
}

bool
cli_step_regions (const CliOptions *options, CliStep *step, CeldLabels *regions, CeldPalette *palette)
{
  return cli_regions_read (options->regions, &step->layers, regions, palette) &&
         cli_check_regions_of (options->regions, regions, palette, options->drawing, &step->ink, options->quiet) &&
         cli_check_region_steps (options->regions, regions, options, &step->layers, options->drawing, &step->ink);
}

int
cli_step_end (CliStep *step, bool good)
{
  g_free (step->levels.data);
  g_free (step->ink.data);
  g_free (step->borders.data);
  cli_layers_clear (&step->layers);
  cli_run_end (&step->run);
  return good ? CLI_DONE : CLI_FAILED;
}
