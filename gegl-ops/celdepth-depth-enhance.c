/* celdepth:depth-enhance: shadows that set near parts off from farther ones (section 5 of the paper, [LCD06]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_ENHANCED_ART]   = { "art", "Art" },
  [CELD_ENHANCED_LAYER] = { "layer", "Shadow layer only" },
  [CELD_ENHANCED_VIEW]  = { "view", "View of depth" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldEnhanceResult, results),
  .help = "The art with shadows, the shadows alone as a black layer to put over the art, or a grey picture that "
          "shows depth"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .name = "enhance" }, { .name = "shadow-size" }, { .name = "shadow-strength" }, { .name = "shadow-offset" },
  { .name = "light-azimuth", .when = "enhance {stack}" },
  { .name = "shadow-range" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Art", "The picture to enhance", TRUE },
  { "aux", "Levels", "Expanded depth levels from Depth Expand, or smooth depth for sharpening", TRUE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gboolean view = celd_operation_own (operation)->result == CELD_ENHANCED_VIEW;

  gegl_operation_set_format (operation, "output", babl_format (view ? "Y float" : "RGBA float"));
}

static gboolean
write_result (CeldOp *op, const CeldPlane *levels, const CeldPlane *change)
{
  CeldColours colours;
  CeldPlane   view;

  switch ((CeldEnhanceResult) op->own.result)
    {
    case CELD_ENHANCED_ART:
      return celd_op_read_colours (op, "input", &colours) &&
             celd_op_try (op, celd_enhance_colours (change, &colours)) &&
             celd_op_write (op, colours.data);
    case CELD_ENHANCED_LAYER:
      return celd_op_new_colours (op, &colours) &&
             celd_op_try (op, celd_enhance_layer (change, &colours)) &&
             celd_op_write (op, colours.data);
    case CELD_ENHANCED_VIEW:
      return celd_op_new_plane (op, &view) &&
             celd_op_try (op, celd_enhance_view (levels, change, &view)) &&
             celd_op_write (op, view.data);
    }
  return FALSE;
}

static gboolean
render (CeldOp *op)
{
  CeldPlane levels, change;

  return celd_op_read_plane (op, "aux", &levels) &&
         celd_op_new_plane (op, &change) &&
         celd_op_try (op, celd_enhance (&levels, &op->settings, &op->host, &change)) &&
         write_result (op, &levels, &change);
}

const CeldOperationInfo celd_depth_enhance_operation = {
  .name        = "celdepth:depth-enhance",
  .title       = "Depth Enhance",
  .categories  = "artistic:light",
  .description = "Makes the parts of a picture stand out from those behind them, with soft shadows",
  .reference   = CELD_REFERENCE " T. Luft, C. Colditz, O. Deussen: Image Enhancement by Unsharp Masking the "
                 "Depth Buffer. SIGGRAPH 2006.",
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
