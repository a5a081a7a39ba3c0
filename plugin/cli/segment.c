/* celdepth segment: finds the regions of a drawing.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

static int
run_segment (const CliOptions *options)
{
  return cli_run_route (options, "segment", false);
}

const CliCommand cli_segment_command = {
  .name     = "segment",
  .step     = CLI_SEGMENT,
  .input    = "DRAWING|LAYERED",
  .summary  = "Finds the regions of a drawing, one for each colour of the scribbles.",
  .examples = "  celdepth segment bee.png --scribbles strokes.png --labels flat.png\n"
              "  celdepth segment bee.png --scribbles strokes.png --closures closures.png\n"
              "  celdepth segment bee.png --scribbles strokes.png --contours closures.png --labels flat.png",
  .settings = CLI_SETTINGS_OF_LABELS,
  .output   = "labels",
  .run      = run_segment,
};
