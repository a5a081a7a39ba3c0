/* A photograph, levels or regions in place of a drawing or of a layer of strokes, or arrows in place of scribbles:
 * refused, or warned about.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <glib/gi18n.h>
#include <string.h>

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

/* Regions of flat colours, which may be a drawing without outlines, are only warned about. */
bool
cli_check_parts (const char *path, const CeldPaint *art, bool quiet)
{
  CeldFlatParts parts = celd_flat_parts (art);

  if (parts == CELD_PARTS_LEVELS)
    return cli_error (_ ("\"%s\" looks like levels or depth: give the line drawing; if this is it, say what its lines "
                         "are, such as --ink dark."), path);
  if (parts == CELD_PARTS_COLOURED && !quiet)
    cli_say (_ ("\"%s\" has flat colours without lines between them, as regions are: give the line drawing if there is "
                "one."), path);
  return true;
}

bool
cli_check_scribbles (const char *path, const CeldPaint *scribbles)
{
  bool arrows = false;

  if (!celd_are_scribbles (scribbles))
    return cli_error (_ ("\"%s\" looks like a photograph: scribbles are strokes in flat colours on a blank layer."),
                      path);
  if (celd_looks_like_levels (scribbles))
    return cli_error (_ ("\"%s\" looks like levels or depth: scribbles are strokes in clear colours, one over each "
                         "part."), path);
  return cli_check (celd_are_arrows (scribbles, NULL, &arrows)) &&
         (!arrows || cli_error (_ ("\"%s\" looks like arrows: give it with --arrows, and as scribbles a stroke in a "
                                   "colour of its own over each part."), path));
}

bool
cli_check_strokes (const char *path, const char *role, const CeldPaint *paint)
{
  bool fills = !strcmp (role, "hidden") || !strcmp (role, "hints"); /* may be large, and grey */

  if (!celd_are_scribbles (paint))
    return cli_error (_ ("\"%s\" looks like a photograph: what is given with --%s are strokes on a blank layer."), path,
                      role);
  return fills || !celd_is_painted_over (paint) ||
         cli_error (_ ("\"%s\" is painted all over, as regions and levels are: what is given with --%s are strokes on "
                       "a blank layer."), path, role);
}
