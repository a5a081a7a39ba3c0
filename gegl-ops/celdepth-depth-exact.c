/* celdepth:depth-exact: depth by the exact quadratic program (equations 1 and 2 of the paper), through a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldProperty properties[] = {
  { .name = "ink" }, { .name = "background" }, { .name = "background-colour" }, { .name = "arrow-style" },
  { .name = "on-cycle" },
  { .name = "more" },
  { .name = "relations", .rare = TRUE }, { .name = "arrow-path", .rare = TRUE },
  { .name = "same-colour", .rare = TRUE }, { .name = "flats", .rare = TRUE }, { .name = "encoding", .rare = TRUE },
  { .name = "near-level", .rare = TRUE }, { .name = "far-level", .rare = TRUE }, { .name = "hold-gaps", .rare = TRUE },
  { .name = "contrast", .rare = TRUE }, { .name = "weight-floor", .rare = TRUE },
  { .name = "tolerance", .rare = TRUE },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Scribbles", "One stroke over each part, in a colour of its own. All of a stroke gets one depth", FALSE },
  { "aux2", "Arrows", "Arrows that point from nearer to farther parts", FALSE },
  { "aux3", "Virtual contours", "Red: depth changes abruptly; green: ink across which depth stays smooth", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static gboolean
render (CeldOp *op)
{
  CeldSession     *session;
  const CeldExact *exact;
  CeldPlane        depth;
  CeldOrder        cycles = { 0 };

  if (!celd_op_set_session (op, "input", "aux", "aux2") ||
      !celd_op_set_layer (op, "aux3", celd_session_set_contours))
    return FALSE;
  session = op->operation->session;
  if (!celd_op_try (op, celd_session_exact (session, &op->host, &depth, NULL)) ||
      !celd_op_write (op, depth.data))
    return FALSE;
  exact           = celd_session_exact_report (session);
  cycles.cycle    = exact->cycle;
  cycles.n_cycles = exact->n_cycles;
  return celd_op_report (op, celd_session_problems (session), celd_session_exact_palette (session),
                       celd_session_relations (session), &cycles);
}

const CeldOperationInfo celd_depth_exact_operation = {
  .name        = "celdepth:depth-exact",
  .title       = "Depth Exact",
  .categories  = "artistic",
  .description = "Finds the smoothest depth for a line drawing that satisfies every relation exactly and changes at "
                 "contours. Takes a second or more per megapixel, but responds quickly to each further arrow",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .format      = "Y float",
  .render      = render,
};
