/* celdepth:depth-order: the depth order of regions, by topological sorting (the paper's appendix).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldProperty properties[] = {
  { .name = "arrow-style" }, { .name = "suggest" }, { .name = "on-cycle" }, { .name = "same-colour" },
  { .name = "more" },
  { .name = "relations", .rare = TRUE }, { .name = "arrow-path", .rare = TRUE },
  { .name = "background", .rare = TRUE }, { .name = "background-colour", .rare = TRUE },
  { .name = "encoding", .rare = TRUE }, { .name = "near-level", .rare = TRUE }, { .name = "far-level", .rare = TRUE },
  { .name = "ink", .rare = TRUE },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Labels", "The regions as flat colours, from Lazybrush Segment or painted", TRUE },
  { "aux", "Arrows", "Arrows that point from nearer to farther parts", FALSE },
  { "aux2", "Drawing", "The line drawing. A point on its ink stands for the region beside it, and "
                      "suggestions come from it", FALSE },
  { "aux3", "Depth hint", "Depth from another source, such as an estimator, where nearer is brighter. Suggestions "
                          "come from it, too", FALSE },
  { NULL, NULL, NULL, FALSE }
};

/* Reads the colours of the input as labels of op->palette. */
static gboolean
read_labels (CeldOp *op, const CeldPlane *ink, CeldLabels *labels)
{
  const CeldSettings *s = &op->settings;
  CeldPaint           colours;

  return celd_op_read_paint (op, "input", &colours) &&
         celd_op_new_labels (op, labels) &&
         celd_op_try (op, celd_labels_read (&colours, labels, &op->palette)) &&
         celd_op_try (op, celd_background_mark (labels, ink, s, &op->palette)) &&
         (s->same_colour == CELD_SAME_COLOUR_ONE || celd_op_try (op, celd_separate (&op->quiet, labels, &op->palette)));
}

/* Makes the depth order, with suggestions if the settings ask for them: from the drawing, or without one from the
 * shapes of regions, and from the depth hint. */
static gboolean
make_order (CeldOp *op, const CeldLabels *labels, const CeldPlane *ink)
{
  const CeldSettings *s = &op->settings;
  gboolean            hinted = s->suggest != CELD_SUGGEST_OFF && celd_op_has_input (op, "aux3");
  CeldRelations       suggested = { 0 };
  CeldPlane           hint;
  gboolean            good = !hinted || celd_op_read_plane (op, "aux3", &hint);

  if (good && s->suggest != CELD_SUGGEST_OFF)
    good = celd_op_try (op, celd_suggest (labels, &op->palette, ink, hinted ? &hint : NULL, &op->quiet, &suggested));
  good = good && celd_op_try (op, celd_order_suggested (labels, &op->palette, &op->relations, &suggested, ink, s,
                                                        &op->host, &op->relations, &op->order, &op->problems));
  celd_relations_clear (&suggested);
  return good;
}

static gboolean
write_levels (CeldOp *op, const CeldLabels *labels)
{
  CeldPlane levels;

  if (!celd_op_new_plane (op, &levels))
    return FALSE;
  for (size_t i = 0; i < (size_t) labels->width * (size_t) labels->height; i++)
    levels.data[i] = celd_order_value (&op->order, op->order.level[labels->data[i] - 1], &op->settings);
  return celd_op_write (op, levels.data);
}

static gboolean
render (CeldOp *op)
{
  const CeldSettings *s = &op->settings;
  gboolean            drawn = celd_op_has_input (op, "aux2");
  CeldPlane           ink;
  CeldLabels          labels;

  return celd_op_try (op, celd_settings_check (s)) &&
         (!drawn || celd_op_read_ink (op, "aux2", &ink)) &&
         read_labels (op, drawn ? &ink : NULL, &labels) &&
         celd_op_read_relations (op, "aux") &&
         make_order (op, &labels, drawn ? &ink : NULL) &&
         celd_op_report (op, &op->problems, &op->palette, &op->relations, &op->order) &&
         write_levels (op, &labels);
}

const CeldOperationInfo celd_depth_order_operation = {
  .name        = "celdepth:depth-order",
  .title       = "Depth Order",
  .categories  = "artistic",
  .description = "Gives each region a depth level, by arrows and relations that tell which region is in front of "
                 "which",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .format      = "Y float",
  .render      = render,
};
