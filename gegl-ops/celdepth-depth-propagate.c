/* celdepth:depth-propagate: the regions and levels of a drawing, carried to the next frame (section 3.4 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_PROPAGATED_LABELS]     = { "labels", "Labels: the regions as flat colours" },
  [CELD_PROPAGATED_SCRIBBLES]  = { "scribbles", "Scribbles: the colours of regions, off the lines" },
  [CELD_PROPAGATED_LEVELS]     = { "levels", "Levels, with contours given to their regions" },
  [CELD_PROPAGATED_DEPTH]      = { "depth", "Depth: smooth" },
  [CELD_PROPAGATED_CONFIDENCE] = { "confidence", "Confidence: how well moved parts and regions agree" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldPropagateResult, results),
  .help = "The regions of the drawing, in the colours that they have in the frame before; the same as scribbles, which "
          "you can correct; its levels or smooth depth; or how well the parts that were moved and the regions agree, "
          "from 0 to 1"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .name = "flats", .label = "Scribbles are regions",
    .help = "The layer of scribbles has the regions of the frame before as flat colours, such as the labels that this "
            "operation made for it" },
  { .name = "ink" }, { .name = "arrow-style" }, { .name = "background" }, { .name = "background-colour" },
  { .name = "more" },
  { .name = "relations", .rare = TRUE }, { .name = "arrow-path", .rare = TRUE }, { .name = "on-cycle", .rare = TRUE },
  { .name = "ink-threshold", .rare = TRUE }, { .name = "hardness", .rare = TRUE },
  { .name = "close-gaps", .rare = TRUE }, { .name = "keep-necks", .rare = TRUE }, { .name = "method", .rare = TRUE },
  { .name = "expansion", .rare = TRUE }, { .name = "encoding", .rare = TRUE, .when = "result {levels, depth}" },
  { .name = "near-level", .rare = TRUE }, { .name = "far-level", .rare = TRUE },
  { .name = "tolerance", .rare = TRUE, .when = "result {depth}" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Drawing", "The drawing to find regions for, such as the next frame", TRUE },
  { "aux", "Drawing before", "The drawing whose regions are known, such as the frame before", TRUE },
  { "aux2", "Scribbles", "One stroke over each part of the drawing before, in a colour of its own; or its regions as "
                         "flat colours", FALSE },
  { "aux3", "Levels", "The expanded depth levels of the drawing before. They take the place of arrows and relations, "
                      "and regions keep them", FALSE },
  { "aux4", "Arrows", "Arrows over the drawing before that point from nearer to farther parts", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gboolean coloured = celd_operation_own (operation)->result <= CELD_PROPAGATED_SCRIBBLES;

  gegl_operation_set_format (operation, "output", babl_format (coloured ? "R'G'B'A u8" : "Y float"));
}

/* ------------------------------------------------------------------ the frame before */

/* A drawing and what is known of it; value and level of label k are at k - 1. */
typedef struct { CeldPlane ink; CeldLabels labels; float *value; uint32_t *level; } Frame;

/* The regions, which have all pixels: as they are painted, or made from scribbles and arrows. */
static gboolean
make_labels (CeldOp *op, Frame *before)
{
  CeldPaint flats;

  if (op->settings.flats && celd_op_has_input (op, "aux2"))
    return celd_op_read_paint (op, "aux2", &flats) && celd_op_new_labels (op, &before->labels) &&
           celd_op_try (op, celd_labels_read (&flats, &before->labels, &op->palette)) &&
           celd_op_try (op, celd_background_mark (&before->labels, &before->ink, &op->settings, &op->palette));
  return celd_op_read_scribbles (op, "aux2", &before->labels) &&
         celd_op_try (op, celd_segment (&before->ink, &before->labels, &op->relations, &op->settings, &op->quiet,
                                        &before->labels, &op->palette, &op->problems));
}

/* Levels from a picture of them, or from arrows and relations. */
static gboolean
make_levels (CeldOp *op, Frame *before)
{
  const CeldSettings *s = &op->settings;
  gsize               n = op->palette.n;
  CeldPlane           levels;

  before->value = celd_op_alloc (op, n * sizeof *before->value);
  before->level = celd_op_alloc (op, n * sizeof *before->level);
  if (!before->value || !before->level)
    return FALSE;
  if (celd_op_has_input (op, "aux3"))
    return celd_op_read_plane (op, "aux3", &levels) &&
           celd_op_try (op, celd_label_levels (&before->labels, n, &levels, before->value, before->level));
  if (!celd_op_try (op, celd_order (&before->labels, &op->palette, &op->relations, &before->ink, s, &op->quiet,
                                    &op->order, &op->problems)))
    return FALSE;
  for (gsize k = 0; k < n; k++)
    {
      before->level[k] = op->order.level[k];
      before->value[k] = celd_order_value (&op->order, before->level[k], s);
    }
  return TRUE;
}

static gboolean
read_before (CeldOp *op, Frame *before)
{
  return celd_op_try (op, celd_settings_check (&op->settings)) &&
         celd_op_read_ink (op, "aux", &before->ink) &&
         celd_op_read_relations (op, "aux4") &&
         make_labels (op, before) &&
         make_levels (op, before);
}

/* ------------------------------------------------------------------ the drawing */

static uint32_t
background_of (const CeldPalette *palette)
{
  for (gsize k = 0; k < palette->n; k++)
    if (palette->item[k].background)
      return (uint32_t) k + 1;
  return 0;
}

/* Finds the regions of the drawing from the seeds that propagation gives. */
static gboolean
segment (CeldOp *op, const CeldPlane *ink, const CeldLabels *seeds, CeldLabels *labels)
{
  CeldSettings settings = op->settings;

  settings.background  = CELD_BACKGROUND_NONE; /* it has a label already */
  settings.same_colour = CELD_SAME_COLOUR_ONE;
  settings.flats       = false;
  return celd_op_new_labels (op, labels) &&
         celd_op_try (op, celd_segment (ink, seeds, NULL, &settings, &op->quiet, labels, &op->palette, NULL));
}

static gboolean
write_levels (CeldOp *op, const Frame *before, const CeldPlane *ink, const CeldLabels *labels)
{
  const CeldSettings *s = &op->settings;
  CeldPlane           levels;

  if (!celd_op_new_plane (op, &levels))
    return FALSE;
  for (gsize i = 0; i < (gsize) labels->width * (gsize) labels->height; i++)
    levels.data[i] = before->value[labels->data[i] - 1];
  return celd_op_try (op, celd_expand_levels (ink, NULL, &levels, labels, NULL, s->expansion, &op->quiet, &levels)) &&
         (op->own.result == CELD_PROPAGATED_LEVELS ||
          celd_op_try (op, celd_smooth (ink, NULL, &levels, NULL, s, &op->quiet, &levels, NULL))) &&
         celd_op_write (op, levels.data);
}

static gboolean
write_result (CeldOp *op, const Frame *before, const CeldPlane *ink, const CeldLabels *seeds,
              const CeldPlane *certainty)
{
  CeldLabels labels;

  switch ((CeldPropagateResult) op->own.result)
    {
    case CELD_PROPAGATED_SCRIBBLES:
      return celd_op_write_paint (op, seeds, &op->palette);
    case CELD_PROPAGATED_CONFIDENCE:
      return celd_op_write (op, certainty->data);
    case CELD_PROPAGATED_LABELS:
      return segment (op, ink, seeds, &labels) && celd_op_write_paint (op, &labels, &op->palette);
    case CELD_PROPAGATED_LEVELS:
    case CELD_PROPAGATED_DEPTH:
      return segment (op, ink, seeds, &labels) && write_levels (op, before, ink, &labels);
    }
  return FALSE;
}

static gboolean
render (CeldOp *op)
{
  Frame      before;
  CeldPlane  ink, certainty;
  CeldLabels seeds;

  return read_before (op, &before) &&
         celd_op_report (op, &op->problems, &op->palette, &op->relations, &op->order) &&
         celd_op_read_ink (op, "input", &ink) &&
         celd_op_new_labels (op, &seeds) && celd_op_new_plane (op, &certainty) &&
         celd_op_try (op, celd_propagate (&before.ink, &before.labels, before.level, background_of (&op->palette), &ink,
                                          &op->host, &seeds, &certainty)) &&
         write_result (op, &before, &ink, &seeds, &certainty);
}

const CeldOperationInfo celd_depth_propagate_operation = {
  .name        = "celdepth:depth-propagate",
  .title       = "Depth Propagate",
  .categories  = "artistic",
  .description = "Finds the regions and depth levels of the next frame of an animation from those of the frame before",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
