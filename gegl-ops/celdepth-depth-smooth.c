/* celdepth:depth-smooth: smooth depth from levels, with discontinuities at contours (equation 3 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldProperty properties[] = {
  { .name = "ink" }, { .name = "ink-threshold" }, { .name = "hold-rest" }, { .name = "hold-gaps" },
  { .name = "tolerance" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Levels", "Depth levels from Depth Expand or Depth Order", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Anchors", "Painted pixels, for example scribbles, keep their level. Without this layer the pixels "
                       "deep inside each region do", FALSE },
  { "aux3", "Drawing for segmentation", "The drawing with virtual contours for segmentation: depth stays smooth where "
                                        "only this one has ink", FALSE },
  { NULL, NULL, NULL, FALSE }
};

/* Marks painted pixels, read like scribbles; *painted is NULL if there are none. */
static gboolean
read_anchors (CeldOp *op, CeldMask *mask, const CeldMask **painted)
{
  CeldLabels seeds;

  *painted = NULL;
  if (!celd_op_read_scribbles (op, "aux2", &seeds) || !celd_op_new_mask (op, mask))
    return FALSE;
  for (size_t i = 0; i < (size_t) mask->width * (size_t) mask->height; i++)
    if ((mask->data[i] = seeds.data[i] != 0))
      *painted = mask;
  return TRUE;
}

static gboolean
render (CeldOp *op)
{
  CeldPlane       ink, borders = { 0 }, levels;
  CeldMask        mask;
  const CeldMask *anchors;
  CeldSolve       solve;

  return celd_op_read_ink (op, "aux", &ink) &&
         (!celd_op_has_input (op, "aux3") || celd_op_read_ink (op, "aux3", &borders)) &&
         celd_op_read_plane (op, "input", &levels) &&
         read_anchors (op, &mask, &anchors) &&
         celd_op_try (op, celd_smooth (&ink, borders.data ? &borders : NULL, &levels, anchors, &op->settings, &op->host,
                                       &levels, &solve)) &&
         celd_op_report_solve (op, &solve) &&
         celd_op_write (op, levels.data);
}

const CeldOperationInfo celd_depth_smooth_operation = {
  .name        = "celdepth:depth-smooth",
  .title       = "Depth Smooth",
  .categories  = "artistic",
  .description = "Turns depth levels into smooth depth, which changes abruptly at ink and across gaps in it, and "
                 "gradually where contours are open",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .format      = "Y float",
  .render      = render,
};
