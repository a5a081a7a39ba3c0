/* For operations that keep a session, and with it results such as the basins of the drawing, between calls.
 *
 * The session is a member of the operation, made at the first call, protected by its lock, and freed with it.  Every
 * call sets all input again; the session finds out what has changed.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include "buffers.h"

static CeldSession *
get_session (CeldOp *op)
{
  if (!op->operation->session)
    op->operation->session = celd_session_new ();
  if (!op->operation->session)
    celd_op_try (op, CELD_NO_MEMORY);
  return op->operation->session;
}

gboolean
celd_op_set_layer (CeldOp *op, const char *pad, CeldStatus (*set) (CeldSession *session, const CeldPaint *layer))
{
  CeldPaint paint;

  if (!celd_op_has_input (op, pad))
    return celd_op_try (op, set (op->operation->session, NULL));
  return celd_op_read_paint (op, pad, &paint) && celd_op_check_strokes (op, pad, &paint, FALSE) &&
         celd_op_try (op, set (op->operation->session, &paint));
}

static gboolean
set_scribbles (CeldOp *op, const char *drawing_pad, const char *pad)
{
  CeldPaint scribbles;

  if (!celd_op_has_input (op, pad))
    return celd_op_try (op, celd_session_set_scribbles (op->operation->session, NULL));
  return celd_op_read_paint (op, pad, &scribbles) && celd_op_check_scribbles (op, drawing_pad, &scribbles) &&
         celd_op_check_strokes (op, pad, &scribbles, TRUE) &&
         celd_op_try (op, celd_session_set_scribbles (op->operation->session, &scribbles));
}

gboolean
celd_op_set_session (CeldOp *op, const char *drawing_pad, const char *scribbles_pad, const char *arrows_pad)
{
  CeldSession  *session = get_session (op);
  CeldTextError error = { 0 };
  CeldDrawing   drawing;

  if (op->settings.flats && !celd_op_has_input (op, scribbles_pad))
    scribbles_pad = drawing_pad; /* a coloured drawing has its regions itself */
  return session &&
         celd_op_try (op, celd_session_set_settings (session, &op->settings)) &&
         celd_op_read_drawing (op, drawing_pad, &drawing) &&
         celd_op_try (op, celd_session_set_drawing (session, &drawing)) &&
         celd_op_check_drawing (op, drawing_pad, &drawing) &&
         set_scribbles (op, drawing_pad, scribbles_pad) &&
         celd_op_set_layer (op, arrows_pad, celd_session_set_arrows) &&
         celd_op_try_text (op, celd_session_set_relations (session, op->own.relations, &error), &error) &&
         celd_op_try_path (op, celd_session_set_arrow_path (session, op->own.arrow_path, &error), &error);
}

gboolean
celd_op_report_session (CeldOp *op, const CeldOrder *order)
{
  CeldSession *session = op->operation->session;

  return celd_op_report (op, celd_session_problems (session), celd_session_palette (session),
                       celd_session_relations (session), order);
}

gboolean
celd_op_write_labels (CeldOp *op)
{
  CeldSession *session = op->operation->session;
  CeldLabels   labels;

  return celd_op_try (op, celd_session_labels (session, &op->host, &labels, NULL)) &&
         celd_op_write_paint (op, &labels, celd_session_palette (session));
}

gboolean
celd_op_write_problems (CeldOp *op, const char *drawing_pad)
{
  const CeldProblems *problems = celd_session_problems (op->operation->session);
  CeldPaint           paint;

  if (!celd_op_try (op, problems ? CELD_OK : CELD_NO_MEMORY) || !celd_op_new_paint (op, &paint))
    return FALSE;
  celd_buffer_read_paint (celd_op_buffer (op, drawing_pad), &op->picture, &paint);
  celd_problems_paint (problems, &paint);
  return celd_op_write (op, paint.data);
}
