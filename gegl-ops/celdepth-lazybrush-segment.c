/* celdepth:lazybrush-segment: the regions of a drawing from scribbles (section 3.2 of the paper, [SDC09b]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_SEGMENT_LABELS]   = { "labels", "Labels: the regions as flat colours" },
  [CELD_SEGMENT_CLOSURES] = { "closures", "Closures: gaps in contours that were closed, in red" },
  [CELD_SEGMENT_PROBLEMS] = { "problems", "Problems: marks on the drawing" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldSegmentResult, results),
  .help = "The regions, a layer of the gaps that were closed, or the drawing with a mark where something needs "
          "attention"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .name = "ink" }, { .name = "close-gaps" }, { .name = "hardness" }, { .name = "flats" }, { .name = "background" },
  { .name = "background-colour" },
  { .name = "more" },
  { .name = "ink-threshold", .rare = TRUE }, { .name = "keep-necks", .rare = TRUE },
  { .name = "method", .rare = TRUE }, { .name = "seeds", .rare = TRUE }, { .name = "relations", .rare = TRUE },
  { .name = "arrow-path", .rare = TRUE }, { .name = "arrow-style", .rare = TRUE },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Scribbles", "One stroke over each part, in a colour of its own", FALSE },
  { "aux2", "Arrows", "Arrows that point from nearer to farther parts. Their ends are seeds for parts without a "
                      "stroke", FALSE },
  { NULL, NULL, NULL, FALSE }
};

/* Writes closures as a layer that can be used as virtual contours, after the artist has erased wrong ones. */
static gboolean
write_closures (CeldOp *op)
{
  CeldPaint paint;

  return celd_op_new_paint (op, &paint) &&
         celd_op_try (op, celd_session_paint_closures (op->operation->session, &op->host, &paint)) &&
         celd_op_write (op, paint.data);
}

static gboolean
write_problems (CeldOp *op)
{
  CeldLabels labels;

  return celd_op_try (op, celd_session_labels (op->operation->session, &op->host, &labels, NULL)) &&
         celd_op_write_problems (op, "input");
}

static gboolean
write_result (CeldOp *op)
{
  switch ((CeldSegmentResult) op->own.result)
    {
    case CELD_SEGMENT_LABELS:   return celd_op_write_labels (op);
    case CELD_SEGMENT_CLOSURES: return write_closures (op);
    case CELD_SEGMENT_PROBLEMS: return write_problems (op);
    }
  return FALSE;
}

static gboolean
render (CeldOp *op)
{
  return celd_op_set_session (op, "input", "aux", "aux2") &&
         write_result (op) &&
         celd_op_report_session (op, NULL);
}

const CeldOperationInfo celd_lazybrush_segment_operation = {
  .name        = "celdepth:lazybrush-segment",
  .title       = "Lazybrush Segment",
  .categories  = "artistic",
  .description = "Finds the parts of a line drawing from a few sloppy strokes, and fills each part with the colour of "
                 "its stroke",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .format      = "R'G'B'A u8",
  .render      = render,
};
