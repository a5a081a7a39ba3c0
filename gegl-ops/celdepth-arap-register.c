/* celdepth:arap-register: where each part of a drawing is in another one (section 3.4 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_REGISTER_DISPLACEMENT] = { "displacement", "Displacement: how far each pixel moves" },
  [CELD_REGISTER_WARPED]       = { "warped", "Warped: the drawing, moved to the other one" },
  [CELD_REGISTER_CONFIDENCE]   = { "confidence", "Confidence: how well lines fit" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldRegisterResult, results),
  .help = "How many pixels each pixel moves to the right (red) and down (green); the drawing, moved to where the other "
          "one has it, on a transparent ground; or how well the lines around each pixel fit, from 0 to 1"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .name = "cell-size" }, { .name = "stiffness" }, { .name = "expansion" }, { .name = "ink" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Drawing", "The drawing whose parts move", TRUE },
  { "aux", "Target", "The drawing to register it to, such as the next frame", TRUE },
  { "aux2", "Levels", "Depth levels of the first drawing: parts of different levels move on their own", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  static const char *const formats[] = {
    [CELD_REGISTER_DISPLACEMENT] = "RGB float", [CELD_REGISTER_WARPED] = "RGBA float",
    [CELD_REGISTER_CONFIDENCE] = "Y float"
  };

  gegl_operation_set_format (operation, "output",
                             babl_format (formats[celd_operation_own (operation)->result]));
}

static gboolean
try_drawings (CeldOp *op, CeldStatus status)
{
  return status == CELD_NOTHING_TO_GO_BY
           ? celd_op_fail (op, _ ("There is nothing to register: 'Drawing' or 'Target' (pad aux) is blank."))
           : celd_op_try (op, status);
}

static gboolean
make_lattice (CeldOp *op, const CeldPlane *ink, CeldLattice **lattice)
{
  CeldPlane levels;

  if (!celd_op_has_input (op, "aux2"))
    return try_drawings (op, celd_lattice_new (ink, NULL, &op->settings, &op->quiet, lattice));
  return celd_op_read_plane (op, "aux2", &levels) &&
         try_drawings (op, celd_lattice_of_levels (ink, &levels, NULL, &op->settings, &op->quiet, lattice));
}

/* X and Y in two channels of three. */
static gboolean
write_displacement (CeldOp *op, const CeldLattice *lattice)
{
  CeldVectors out;
  CeldShifts  shifts = { op->picture.width, op->picture.height, (gsize) op->picture.width, NULL };
  gsize       n = (gsize) shifts.width * (gsize) shifts.height;

  shifts.data = celd_op_alloc (op, 2 * n * sizeof *shifts.data);
  if (!shifts.data || !celd_op_new_vectors (op, &out) ||
      !celd_op_try (op, celd_lattice_displacement (lattice, &shifts)))
    return FALSE;
  for (gsize i = 0; i < n; i++)
    {
      out.data[3 * i]     = shifts.data[2 * i];
      out.data[3 * i + 1] = shifts.data[2 * i + 1];
      out.data[3 * i + 2] = 0;
    }
  return celd_op_write (op, out.data);
}

static gboolean
write_warped (CeldOp *op, const CeldLattice *lattice)
{
  CeldColours art, warped;

  return celd_op_read_colours (op, "input", &art) && celd_op_new_colours (op, &warped) &&
         celd_op_try (op, celd_lattice_warp (lattice, &art, &warped)) &&
         celd_op_write (op, warped.data);
}

static gboolean
write_result (CeldOp *op, const CeldLattice *lattice, const CeldPlane *confidence)
{
  switch ((CeldRegisterResult) op->own.result)
    {
    case CELD_REGISTER_DISPLACEMENT:
      return write_displacement (op, lattice);
    case CELD_REGISTER_WARPED:
      return write_warped (op, lattice);
    default:
      return celd_op_write (op, confidence->data);
    }
}

static gboolean
render (CeldOp *op)
{
  CeldPlane    source, target, confidence;
  CeldLattice *lattice = NULL;
  gboolean     good;

  good = celd_op_read_ink (op, "input", &source) && celd_op_read_ink (op, "aux", &target) &&
         celd_op_new_plane (op, &confidence) && make_lattice (op, &source, &lattice) &&
         try_drawings (op, celd_register (&source, &target, &op->settings, &op->host, lattice, &confidence)) &&
         write_result (op, lattice, &confidence);
  celd_lattice_free (lattice);
  return good;
}

const CeldOperationInfo celd_arap_register_operation = {
  .name        = "celdepth:arap-register",
  .title       = "Register Drawings",
  .categories  = "map",
  .description = "Finds where each part of a drawing is in another one, such as the next frame of an animation",
  .reference   = CELD_REFERENCE " D. Sýkora, J. Dingliana, S. Collins: As-Rigid-As-Possible Image Registration for "
                 "Hand-drawn Cartoon Animations. NPAR 2009.",
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
