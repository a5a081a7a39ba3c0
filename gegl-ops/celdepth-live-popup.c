/* celdepth:live-popup: celdepth:popup as an effect on a layer group of GIMP that follows what is painted on it.
 *
 * GIMP keeps an effect without merging it only if no pad is named aux, and renders it anew at each dab on a layer of
 * the group.  Pads have the layers themselves; the input is all layers of the group over each other, and is the drawing
 * if no other one is connected.  GIMP connects no pads of an effect that it reads from a file: the input passes through
 * until the plug-in connects the layers again.
 *
 * Nothing is said about strokes and arrows, since GIMP would open a dialog in the middle of a stroke; result=problems
 * shows them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "popup.h"

static const CeldPad pads[] = {
  { "input", "Group", "All layers over each other; the line drawing if there is no other one", TRUE },
  { "drawing", "Drawing", "The line drawing", FALSE },
  { "scribbles", "Scribbles", CELD_HELP_SCRIBBLES, FALSE },
  { "arrows", "Arrows", CELD_HELP_ARROWS, FALSE },
  { "contours", "Virtual contours", CELD_HELP_CONTOURS, FALSE },
  { "hidden", "Hidden", CELD_HELP_HIDDEN, FALSE },
  { "corrections", "Corrections", "Strokes over lines, in the colour of the part that a line belongs to", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static gboolean
render (CeldOp *op)
{
  CeldPopupPads by_role = { "drawing", "scribbles", "arrows", "contours", "hidden", "corrections" };

  /* While GIMP's dialog of the effect is open, it has no layers. */
  if (!celd_op_has_input (op, "scribbles"))
    return !op->choosing &&
           celd_op_fail (op, _ ("No layer with scribbles is connected. In GIMP, Cartoon Depth > Live group connects "
                                "the layers of the group, also after its file was opened again."));
  if (!celd_op_has_input (op, "drawing"))
    by_role.drawing = "input";
  op->choosing = TRUE;
  return celd_popup_render (op, &by_role);
}

const CeldOperationInfo celd_live_popup_operation = {
  .name        = "celdepth:live-popup",
  .title       = "Live pop-up",
  .categories  = "artistic",
  .description = "Pop-up as an effect on a layer group, which follows what is painted on its layers. In GIMP, Cartoon "
                 "Depth > Live group makes it",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = celd_popup_properties,
  .unlisted    = TRUE,
  .size_help   = N_ ("In GIMP, choose Cartoon Depth > Live group again, which gives all layers the size of the group."),
  .prepare     = celd_popup_prepare,
  .render      = render,
};
