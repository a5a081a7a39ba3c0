/* celdepth popup: the whole method, from a drawing to depth and shading.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

static bool
check (CliOptions *options)
{
  if (options->watch && options->output_dir)
    return cli_error ("--watch shows one page: leave out --output-dir.");
  if (!cli_compositing_check (options) || !cli_maps_check (options))
    return false;
  return options->settings.light_model != CELD_MODEL_MATCAP ||
         cli_error ("--light-model matcap needs a picture of a ball: use celdepth shade with --matcap.");
}

static int
run_popup (const CliOptions *options)
{
  return cli_run_route (options, "popup", true);
}

const CliCommand cli_popup_command = {
  .name     = "popup",
  .step     = CLI_POPUP,
  .input    = "DRAWING|LAYERED",
  .summary  = "Makes regions, order, depth, light, layers, views and a model of a drawing, in one run.",
  .examples = "  celdepth popup bee.png --scribbles strokes.png --arrows arrows.png --depth depth.exr\n"
              "  celdepth popup bee.png --scribbles strokes.png --relations '#ff0000 > #0000ff' \\\n"
              "      --labels flat.png --levels levels.png --shading shading.png --report report.json\n"
              "  celdepth popup bee.png --scribbles strokes.png --arrows arrows.png --shaded lit.png \\\n"
              "      --enhanced popup.png --layers bee.ora --joined glasses.png --stereo dubois\n"
              "  celdepth popup page.psd --depth depth.png     (layers: drawing, scribbles, arrows, contours)\n"
              "  celdepth popup pages/*.psd --output-dir out --depth --shaded\n"
              "  celdepth popup page.ora --shaded lit.png --watch",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle suggest encoding near-level far-level expansion anchors hold-rest "
              "hold-gaps tolerance bulge bevel creases frame-outline light-model toon-steps light-background light "
              "light-azimuth light-elevation ambient light-x light-y light-height specular shininess rim-light "
              "rim-power enhance shadow-size shadow-strength shadow-offset shadow-range complete margin stereo "
              "disparity convergence path floating-window screen-width relief-bulge relief-from relief-depth mesh-kind "
              "mesh-size mesh-plate mesh-error most-vertices",
  .output   = "depth",
  .check    = check,
  .run      = run_popup,
};
