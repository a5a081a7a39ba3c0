/* celdepth enhance: shadows from levels, on art, as a layer, or on a view of depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

/* Whether the levels have not the lines of the art, as shaded art has them. */
static bool
check_lines_of_art (const CliOptions *options, const CeldPlane *levels, const CeldColours *art)
{
  CeldPlane brightness;
  bool      good = cli_plane_new (art->width, art->height, &brightness);

  for (size_t i = 0; good && i < (size_t) art->width * (size_t) art->height; i++)
    {
      const float *p = &art->data[4 * i];

      brightness.data[i] = 1 - p[3] * (1 - (p[0] + p[1] + p[2]) / 3);
    }
  good = good && cli_check_no_lines (options->input, levels, options->colours, &brightness);
  g_free (brightness.data);
  return good;
}

static bool
read_art (const CliOptions *options, const CeldPlane *levels, CeldColours *art)
{
  if (!options->colours)
    return cli_check_not_drawn (options->input, levels);
  if (!cli_read_colours (options->colours, art))
    return false;
  if (art->width != levels->width || art->height != levels->height)
    return cli_error ("\"%s\" has %d x %d pixels, but \"%s\" has %d x %d; give both the same size.", options->colours,
                      art->width, art->height, options->input, levels->width, levels->height);
  return cli_check_not_art (options->input, options->colours) && check_lines_of_art (options, levels, art);
}

bool
cli_shadows_write (const CliOptions *options, const CeldPlane *levels, const CeldPlane *change, CeldColours *art)
{
  CeldColours layer = { 0 };
  CeldPlane   view = { 0 };
  bool        good = true;

  if (options->enhanced)
    good = cli_check (celd_enhance_colours (change, art)) && cli_write_colours (options->enhanced, art);
  if (good && options->shadow)
    good = cli_colours_new (change->width, change->height, &layer) && cli_check (celd_enhance_layer (change, &layer)) &&
           cli_write_colours (options->shadow, &layer);
  if (good && options->view)
    good = cli_plane_new (change->width, change->height, &view) &&
           cli_check (celd_enhance_view (levels, change, &view)) && cli_write_shading (options->view, &view);
  g_free (layer.data);
  g_free (view.data);
  return good;
}

static int
run_enhance (const CliOptions *options)
{
  CeldPlane   levels = { 0 }, change = { 0 };
  CeldColours art = { 0 };
  CliRun      run;
  bool        good;

  cli_run_begin (&run, options, "reading shadows writing");
  good = cli_read_levels (options->input, &levels) && cli_check_depth (options->input, &levels) && read_art (options, &levels, &art) &&
         cli_plane_new (levels.width, levels.height, &change);
  if (good)
    {
      CeldStatus status;

      if (!options->quiet)
        cli_warn_if_flat (options->input, &levels);
      cli_run_stage (&run, "shadows");
      status = celd_enhance (&levels, &options->settings, &run.host, &change);
      good = cli_run_finish (&run, status) && cli_shadows_write (options, &levels, &change, &art);
    }
  g_free (levels.data);
  g_free (change.data);
  g_free (art.data);
  cli_run_end (&run);
  return good ? CLI_DONE : CLI_FAILED;
}

static bool
check (CliOptions *options)
{
  return !options->enhanced || options->colours || cli_error ("--enhanced needs --colours.");
}

const CliCommand cli_enhance_command = {
  .name     = "enhance",
  .step     = CLI_ENHANCE,
  .input    = "LEVELS",
  .summary  = "Makes the parts of a picture stand out from those behind them, with soft shadows.",
  .examples = "  celdepth enhance levels.npy --colours bee.png --enhanced popup.png\n"
              "  celdepth enhance levels.npy --shadow shadow.png --shadow-offset 0.01 --light-azimuth 45\n"
              "  celdepth enhance levels.npy --view view.png",
  .settings = "enhance shadow-size shadow-strength shadow-offset light-azimuth shadow-range",
  .output   = "enhanced",
  .check    = check,
  .run      = run_enhance,
};
