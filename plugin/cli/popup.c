/* celdepth popup: the whole method, from a drawing to depth and shading.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

static int
run_popup (const CliOptions *options)
{
  return cli_run_route (options, "popup", true);
}

const CliCommand cli_popup_command = {
  .name     = "popup",
  .step     = CLI_POPUP,
  .input    = "DRAWING|LAYERED",
  .summary  = "Makes regions, order, depth, normals and shading of a drawing, in one run.",
  .examples = "  celdepth popup bee.png --scribbles strokes.png --arrows arrows.png --depth depth.exr\n"
              "  celdepth popup bee.png --scribbles strokes.png --relations '#ff0000 > #0000ff' \\\n"
              "      --labels flat.png --levels levels.png --shading shading.png --report report.json\n"
              "  celdepth popup page.psd --depth depth.png     (layers: drawing, scribbles, arrows, contours)",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle suggest encoding near-level far-level expansion anchors hold-rest "
              "tolerance bulge light-azimuth light-elevation ambient",
  .output   = "depth",
  .run      = run_popup,
};
