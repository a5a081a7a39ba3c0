/* celdepth:popup: the whole method of the paper as one operation, with a session.  celdepth:live-popup is the same with
 * other pads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "popup.h"
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_POPUP_LABELS]      = { "labels", "Labels: the regions as flat colours" },
  [CELD_POPUP_ORDER]       = { "order", "Order: the level of each region" },
  [CELD_POPUP_LEVELS]      = { "levels", "Levels, with contours given to their regions" },
  [CELD_POPUP_DEPTH]       = { "depth", "Depth: smooth" },
  [CELD_POPUP_NORMALS]     = { "normals", "Normals" },
  [CELD_POPUP_SHADING]     = { "shading", "Shading" },
  [CELD_POPUP_PROBLEMS]    = { "problems", "Problems: marks on the drawing" },
  [CELD_POPUP_SUGGESTIONS] = { "suggestions", "Suggestions: arrows from parts that seem nearer" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldPopupResult, results), .usual = CELD_POPUP_DEPTH,
  .help = "The step of the method whose result is shown. In order, levels and depth nearer parts are lighter, in "
          "linear numbers"
};

const CeldProperty celd_popup_properties[] = {
  { .own = &result_row },
  { .name = "ink" }, { .name = "background" }, { .name = "background-colour" }, { .name = "arrow-style" },
  { .name = "suggest" },
  { .name = "bulge", .when = "result {normals, shading}" }, { .name = "light-azimuth", .when = "result {shading}" },
  { .name = "light-elevation", .when = "result {shading}" }, { .name = "ambient", .when = "result {shading}" },
  { .name = "directx" },
  { .name = "more" },
  { .name = "relations", .rare = TRUE }, { .name = "arrow-path", .rare = TRUE },
  { .name = "same-colour", .rare = TRUE }, { .name = "flats", .rare = TRUE }, { .name = "hardness", .rare = TRUE },
  { .name = "close-gaps", .rare = TRUE }, { .name = "keep-necks", .rare = TRUE },
  { .name = "ink-threshold", .rare = TRUE }, { .name = "seeds", .rare = TRUE }, { .name = "on-cycle", .rare = TRUE },
  { .name = "expansion", .rare = TRUE }, { .name = "method", .rare = TRUE },
  { .name = "encoding", .rare = TRUE, .when = "result {order, levels, depth}" },
  { .name = "near-level", .rare = TRUE }, { .name = "far-level", .rare = TRUE },
  { .name = "anchors", .rare = TRUE, .when = "result {depth}" },
  { .name = "hold-rest", .rare = TRUE, .when = "result {depth}" },
  { .name = "hold-gaps", .rare = TRUE, .when = "result {depth}" },
  { .name = "tolerance", .rare = TRUE, .when = "result {depth}" },
  { 0 }
};

void
celd_popup_prepare (GeglOperation *operation)
{
  static const char *const formats[] = {
    [CELD_POPUP_LABELS] = "R'G'B'A u8", [CELD_POPUP_ORDER]   = "Y float",   [CELD_POPUP_LEVELS]  = "Y float",
    [CELD_POPUP_DEPTH]  = "Y float",    [CELD_POPUP_NORMALS] = "RGB float", [CELD_POPUP_SHADING] = "Y float",
    [CELD_POPUP_PROBLEMS] = "R'G'B'A u8", [CELD_POPUP_SUGGESTIONS] = "R'G'B'A u8",
  };

  gegl_operation_set_format (operation, "output", babl_format (formats[celd_operation_own (operation)->result]));
}

static gboolean
write_plane (CeldOp *op, CeldStatus (*ask) (CeldSession *, const CeldHost *, CeldPlane *, CeldRect *))
{
  CeldPlane plane;

  return celd_op_try (op, ask (op->operation->session, &op->host, &plane, NULL)) &&
         celd_op_write (op, plane.data);
}

static gboolean
write_normals (CeldOp *op)
{
  CeldVectors normals;

  return celd_op_try (op, celd_session_normals (op->operation->session, &op->host, &normals, NULL)) &&
         celd_op_write_normals (op, &normals);
}

/* Problems up to the sheets, which need the order, so that the picture does not depend on what was asked for before. */
static gboolean
write_problems (CeldOp *op, const char *drawing)
{
  const CeldSheets *sheets;

  return celd_op_try (op, celd_session_sheets (op->operation->session, &op->host, &sheets)) &&
         celd_op_write_problems (op, drawing);
}

static gboolean
write_suggestions (CeldOp *op)
{
  CeldPaint paint;

  return celd_op_new_paint (op, &paint) &&
         celd_op_try (op, celd_session_paint_suggestions (op->operation->session, &op->host, &paint)) &&
         celd_op_write (op, paint.data);
}

static gboolean
write_result (CeldOp *op, const char *drawing)
{
  switch ((CeldPopupResult) op->own.result)
    {
    case CELD_POPUP_LABELS:   return celd_op_write_labels (op);
    case CELD_POPUP_ORDER:    return write_plane (op, celd_session_unexpanded_levels);
    case CELD_POPUP_LEVELS:   return write_plane (op, celd_session_levels);
    case CELD_POPUP_DEPTH:    return write_plane (op, celd_session_depth);
    case CELD_POPUP_NORMALS:  return write_normals (op);
    case CELD_POPUP_SHADING:  return write_plane (op, celd_session_shading);
    case CELD_POPUP_PROBLEMS: return write_problems (op, drawing);
    case CELD_POPUP_SUGGESTIONS: return write_suggestions (op);
    }
  return FALSE;
}

static gboolean
set_colours (CeldOp *op, const char *drawing)
{
  CeldPaint painted;

  return celd_op_read_painted (op, drawing, &painted) &&
         celd_op_try (op, celd_session_set_colours (op->operation->session, &painted));
}

gboolean
celd_popup_render (CeldOp *op, const CeldPopupPads *pads)
{
  return celd_op_set_session (op, pads->drawing, pads->scribbles, pads->arrows) &&
         set_colours (op, pads->drawing) &&
         celd_op_set_layer (op, pads->contours, celd_session_set_contours) &&
         celd_op_set_layer (op, pads->hidden, celd_session_set_hidden) &&
         (!pads->corrections || celd_op_set_layer (op, pads->corrections, celd_session_set_corrections)) &&
         write_result (op, pads->drawing);
}

/* All results but two have made the order already. */
static gboolean
report (CeldOp *op)
{
  int              result = op->own.result;
  const CeldOrder *order = NULL;

  if (result != CELD_POPUP_LABELS && result != CELD_POPUP_SUGGESTIONS &&
      !celd_op_try (op, celd_session_order (op->operation->session, NULL, &order)))
    return FALSE;
  return celd_op_report_session (op, order);
}

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Scribbles", CELD_HELP_SCRIBBLES, FALSE },
  { "aux2", "Arrows", CELD_HELP_ARROWS, FALSE },
  { "aux3", "Virtual contours", CELD_HELP_CONTOURS, FALSE },
  { "aux4", "Hidden", CELD_HELP_HIDDEN, FALSE },
  { NULL, NULL, NULL, FALSE }
};

static gboolean
render (CeldOp *op)
{
  static const CeldPopupPads by_role = { "input", "aux", "aux2", "aux3", "aux4", NULL };

  return celd_popup_render (op, &by_role) && report (op);
}

const CeldOperationInfo celd_popup_operation = {
  .name        = "celdepth:popup",
  .title       = "Pop-up",
  .categories  = "artistic",
  .description = "Finds depth for a line drawing in one step, from scribbles over its parts and arrows from nearer to "
                 "farther parts",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = celd_popup_properties,
  .prepare     = celd_popup_prepare,
  .render      = render,
};
