/* celdepth:arap-deform: a drawing whose parts are moved by handles, in the order of depth (section 5 of the paper).
 *
 * The puppet of the drawing is kept between calls, so that a handle that is dragged only poses it anew.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "problems.h"
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_DEFORMED_ART]    = { "art", "Art" },
  [CELD_DEFORMED_LEVELS] = { "levels", "Levels" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldDeformResult, results),
  .help = "The deformed picture, or its depth levels"
};

static const CeldSettingInfo handles_row = {
  .name = "handles", .label = "Handles", .type = CELD_SETTING_TEXT, .offset = offsetof (CeldOwnValues, handles),
  .help = "Places of the picture: '120,80 -> 200,60' takes the first place to the second, '300,400' stays where it is, "
          "and '^1' after a handle moves what is near it forward by one level, '^-1' back. Write one handle per line, "
          "or separate them by ';'"
};

static const CeldProperty properties[] = {
  { .own = &result_row }, { .own = &handles_row },
  { .name = "ink" }, { .name = "arrow-style" }, { .name = "hold-gaps" }, { .name = "cell-size" },
  { .name = "more" },
  { .name = "relations", .rare = TRUE }, { .name = "arrow-path", .rare = TRUE }, { .name = "on-cycle", .rare = TRUE },
  { .name = "suggest", .rare = TRUE }, { .name = "ink-threshold", .rare = TRUE }, { .name = "hardness", .rare = TRUE },
  { .name = "close-gaps", .rare = TRUE }, { .name = "keep-necks", .rare = TRUE }, { .name = "flats", .rare = TRUE },
  { .name = "background", .rare = TRUE }, { .name = "background-colour", .rare = TRUE },
  { .name = "seeds", .rare = TRUE }, { .name = "same-colour", .rare = TRUE }, { .name = "method", .rare = TRUE },
  { .name = "expansion", .rare = TRUE }, { .name = "margin", .rare = TRUE },
  { .name = "encoding", .rare = TRUE, .when = "result {levels}" }, { .name = "near-level", .rare = TRUE },
  { .name = "far-level", .rare = TRUE },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Art", "The picture to deform", TRUE },
  { "aux", "Levels", "The expanded depth levels of the art, by which it is cut into parts. Without them its parts come "
                     "from scribbles and arrows", FALSE },
  { "aux2", "Handles", "Handles: an arrow from a place to where it is taken, a dot on a place that stays", FALSE },
  { "aux3", "Drawing", "The line drawing, to distinguish ink from paint in coloured art", FALSE },
  { "aux4", "Scribbles", "One stroke over each part, in a colour of its own", FALSE },
  { "aux5", "Arrows", "Arrows that point from nearer to farther parts", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gboolean art = celd_operation_own (operation)->result == CELD_DEFORMED_ART;

  gegl_operation_set_format (operation, "output", babl_format (art ? "RGBA float" : "Y float"));
}

static const char *
drawing_pad (CeldOp *op)
{
  return celd_op_has_input (op, "aux3") ? "aux3" : "input";
}

/* ------------------------------------------------------------------ the puppet */

/* Everything that the puppet is made of. */
typedef struct { CeldColours art; CeldDrawing drawing; CeldPlane levels; CeldPaint scribbles, arrows; } Parts;

static gboolean
read_layer (CeldOp *op, const char *pad, CeldPaint *paint)
{
  return !celd_op_has_input (op, pad) || celd_op_read_paint (op, pad, paint);
}

static gboolean
read_parts (CeldOp *op, Parts *parts)
{
  if (!celd_op_try (op, celd_settings_check (&op->settings)) || !celd_op_read_colours (op, "input", &parts->art) ||
      !celd_op_read_drawing (op, drawing_pad (op), &parts->drawing))
    return FALSE;
  if (celd_op_has_input (op, "aux"))
    return celd_op_read_plane (op, "aux", &parts->levels);
  return read_layer (op, "aux4", &parts->scribbles) && read_layer (op, "aux5", &parts->arrows);
}

static guint64
input_of (CeldOp *op, const Parts *parts)
{
  gsize   n = (gsize) op->picture.width * (gsize) op->picture.height;
  guint64 input = celd_op_settings_input (op);

  input = celd_op_add_input (input, parts->art.data, 4 * n * sizeof (float));
  input = celd_op_add_input (input, parts->drawing.luma.data, n * sizeof (float));
  input = celd_op_add_input (input, parts->drawing.alpha.data, n * sizeof (float));
  input = celd_op_add_input (input, parts->levels.data, n * sizeof (float));
  input = celd_op_add_input (input, parts->scribbles.data, 4 * n);
  input = celd_op_add_input (input, parts->arrows.data, 4 * n);
  input = celd_op_add_text (input, op->own.relations);
  return celd_op_add_text (input, op->own.arrow_path);
}

static gboolean
try_parts (CeldOp *op, CeldStatus status)
{
  return status == CELD_NOTHING_TO_GO_BY && !op->choosing
           ? celd_op_fail (op, _ ("The parts of the drawing are not known. Choose a layer for 'Levels' (pad aux), "
                                  "or for 'Scribbles' (aux4) or 'Arrows' (aux5)."))
           : celd_op_try (op, status);
}

static gboolean
make_puppet (CeldOp *op, const Parts *parts, CeldPuppet **puppet)
{
  CeldPlane ink;

  if (parts->levels.data)
    return celd_op_new_plane (op, &ink) &&
           celd_op_try (op, celd_ink (&parts->drawing, op->settings.ink, &op->quiet, &ink)) &&
           celd_op_try (op, celd_puppet_of_levels (&ink, &parts->levels, &parts->art, &op->settings, &op->host,
                                                   puppet));
  return celd_op_set_session (op, drawing_pad (op), "aux4", "aux5") &&
         try_parts (op, celd_session_puppet (op->operation->session, &parts->art, &op->host, puppet));
}

static void
free_puppet (gpointer puppet)
{
  celd_puppet_free (puppet);
}

/* The puppet of the last call, or a new one. */
static gboolean
get_puppet (CeldOp *op, Parts *parts, CeldPuppet **puppet)
{
  guint64 input;

  if (!read_parts (op, parts))
    return FALSE;
  input   = input_of (op, parts);
  *puppet = celd_op_kept (op, input);
  if (*puppet)
    return TRUE;
  if (!make_puppet (op, parts, puppet))
    return FALSE;
  celd_op_keep (op, input, *puppet, free_puppet);
  return TRUE;
}

/* ------------------------------------------------------------------ the pose */

static gboolean
read_handles (CeldOp *op, CeldHandles *handles)
{
  CeldTextError error = { 0 };
  CeldPaint     paint;
  const char   *text = op->own.handles ? op->own.handles : "";

  return celd_op_try_handles (op, celd_handles_parse (text, handles, &error), &error) &&
         (!celd_op_has_input (op, "aux2") ||
          (celd_op_read_paint (op, "aux2", &paint) &&
           celd_op_try (op, celd_handles_read (&paint, op->settings.arrow_style, &op->quiet, handles, &op->problems))));
}

static gboolean
try_handles (CeldOp *op, CeldStatus status)
{
  return status == CELD_BAD_VALUE
           ? celd_op_fail (op, _ ("A handle is too far away: its numbers must lie between -1000000 and 1000000."))
           : celd_op_try (op, status);
}

static gboolean
pose (CeldOp *op, CeldPuppet *puppet)
{
  CeldHandles    handles = { 0 };
  CeldPoseReport report = { 0 };
  char           text[1000];
  gboolean       good;

  good = read_handles (op, &handles) &&
         try_handles (op, celd_puppet_pose (puppet, handles.item, handles.n, &op->quiet, &report)) &&
         celd_op_report (op, &op->problems, NULL, NULL, NULL);
  celd_handles_clear (&handles);
  celd_pose_text (&report, celd_in_language, text, sizeof text);
  return good && (!text[0] || celd_op_report_text (op, text));
}

/* Levels of a puppet of levels are numbers of that picture, others have the encoding of the settings. */
static gboolean
write_levels (CeldOp *op, CeldPuppet *puppet, const CeldOrder *order)
{
  CeldColours art;
  CeldPlane   levels;

  if (!celd_op_new_colours (op, &art) || !celd_op_new_plane (op, &levels) ||
      !celd_op_try (op, celd_puppet_draw (puppet, &op->quiet, &art, &levels)))
    return FALSE;
  for (gsize p = 0; order && p < (gsize) levels.width * (gsize) levels.height; p++)
    levels.data[p] = celd_encode_level ((double) levels.data[p], order->levels, &op->settings);
  return celd_op_write (op, levels.data);
}

static gboolean
write_art (CeldOp *op, CeldPuppet *puppet)
{
  CeldColours art;

  return celd_op_new_colours (op, &art) &&
         celd_op_try (op, celd_puppet_draw (puppet, &op->quiet, &art, NULL)) &&
         celd_op_write (op, art.data);
}

static gboolean
render (CeldOp *op)
{
  Parts            parts = { 0 };
  CeldPuppet      *puppet = NULL;
  const CeldOrder *order = NULL;

  if (!get_puppet (op, &parts, &puppet))
    return FALSE;
  if (!parts.levels.data && (!celd_op_try (op, celd_session_order (op->operation->session, &op->quiet, &order)) ||
                             !celd_op_report_session (op, order)))
    return FALSE;
  return pose (op, puppet) &&
         (op->own.result == CELD_DEFORMED_LEVELS ? write_levels (op, puppet, order) : write_art (op, puppet));
}

const CeldOperationInfo celd_arap_deform_operation = {
  .name        = "celdepth:arap-deform",
  .title       = "Deform",
  .categories  = "map",
  .description = "Moves parts of a drawing by handles, in front of others or behind them. Takes a second or more per "
                 "megapixel, but responds quickly to each further handle",
  .reference   = CELD_REFERENCE " Y. Wang, K. Xu, Y. Xiong, Z.-Q. Cheng: 2D Shape Deformation Based on Rigid Square "
                 "Matching. Computer Animation and Virtual Worlds 19, 2008.",
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
