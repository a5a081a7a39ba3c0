/* A photograph in place of a drawing or of a layer of strokes, or arrows in place of scribbles: refused, or warned
 * about.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <glib/gi18n.h>

/* Blank pages are refused elsewhere, with another reason. */
bool
cli_check_drawing (const char *path, const CeldDrawing *drawing, bool quiet)
{
  CeldLineClarity clarity;

  if (!cli_check (celd_line_clarity (drawing, NULL, &clarity)))
    return false;
  if (clarity == CELD_LINES_NONE)
    return cli_error (_ ("\"%s\" looks like a photograph or a painting without lines; if it is a drawing, say what its "
                         "lines are, such as --ink dark."), path);
  if (clarity == CELD_LINES_UNSURE && !quiet)
    cli_say (_ ("\"%s\" hardly has clear lines: if it is a photograph, draw its outlines, and give these as the "
                "drawing."), path);
  return true;
}

bool
cli_check_scribbles (const char *path, const CeldPaint *scribbles)
{
  bool arrows = false;

  if (!celd_are_scribbles (scribbles))
    return cli_error (_ ("\"%s\" looks like a photograph: scribbles are strokes in flat colours on a blank layer."),
                      path);
  return cli_check (celd_are_arrows (scribbles, NULL, &arrows)) &&
         (!arrows || cli_error (_ ("\"%s\" looks like arrows: give it with --arrows, and as scribbles a stroke in a "
                                   "colour of its own over each part."), path));
}

bool
cli_check_strokes (const char *path, const char *role, const CeldPaint *paint)
{
  return celd_are_scribbles (paint) ||
         cli_error (_ ("\"%s\" looks like a photograph: what is given with --%s are strokes on a blank layer."),
                    path, role);
}
