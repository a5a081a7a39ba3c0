/* celdepth:virtual-contours: draws painted contours into a drawing (section 4 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_FOR_SEGMENTATION] = { "segmentation", "For segmentation" },
  [CELD_FOR_DEPTH]        = { "depth", "For depth" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldPurpose, results),
  .help = "The drawing with contours for segmentation, or for depth: blue contours are in the former only"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .name = "ink" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Contours", "Red: a boundary of regions and depth; blue: a boundary of regions across which depth stays "
                       "smooth; green: ink that is not a boundary", TRUE },
  { NULL, NULL, NULL, FALSE }
};

static gboolean
has_alpha (GeglOperation *operation)
{
  const Babl *format = gegl_operation_get_source_format (operation, "input");

  return format && babl_format_has_alpha (format);
}

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format (has_alpha (operation) ? "Y'A float" : "Y' float"));
}

static gboolean
render (CeldOp *op)
{
  CeldPurpose purpose = (CeldPurpose) op->own.result;
  CeldDrawing drawing;
  CeldPaint   contours;

  return celd_op_read_drawing (op, "input", &drawing) &&
         celd_op_read_paint (op, "aux", &contours) &&
         celd_op_try (op, celd_contours_bake (&drawing, &contours, purpose, op->settings.ink, &op->host, &drawing)) &&
         celd_op_write_drawing (op, &drawing);
}

const CeldOperationInfo celd_virtual_contours_operation = {
  .name        = "celdepth:virtual-contours",
  .title       = "Virtual Contours",
  .categories  = "artistic",
  .description = "Adds painted contours to a line drawing: boundaries that the artist left out, and ink that is not a "
                 "boundary",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
