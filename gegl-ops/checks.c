/* Pictures that are something else than they were connected for: they are refused with one sentence, as the plug-ins
 * and the command do (plugin/pipeline-checks.c), and the input passes through.
 *
 * An effect runs at each dab, mostly on the same drawing: one that was good is only compared.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include "buffers.h"
#include "problems.h"
#include "translate.h"

/* Whether the drawing has lines between its parts, which levels and depth have not. */
static gboolean
check_parts (CeldOp *op, GeglBuffer *buffer)
{
  CeldPaint paint;

  if (!celd_op_new_paint (op, &paint))
    return FALSE;
  celd_buffer_read_paint (buffer, &op->picture, &paint);
  return !celd_looks_like_levels (&paint) ||
         celd_op_fail (op, _ ("The drawing looks like levels or depth. Choose another layer; if it is a drawing, say with "
                              "'Ink' what its lines are."));
}

/* The drawing as it is, not the lines of a coloured one. */
static gboolean
check_lines (CeldOp *op, GeglBuffer *buffer, gboolean *unsure)
{
  CeldDrawing     drawing = { 0 };
  CeldLineClarity clarity;

  if (!celd_op_new_plane (op, &drawing.luma) ||
      (celd_buffer_has_alpha (buffer) && !celd_op_new_plane (op, &drawing.alpha)))
    return FALSE;
  if (!celd_op_try (op, celd_buffer_read_drawing (buffer, &op->picture, CELD_INK_DARK, &op->quiet, &drawing)) ||
      !celd_op_try (op, celd_line_clarity (&drawing, &op->quiet, &clarity)))
    return FALSE;
  *unsure = clarity == CELD_LINES_UNSURE;
  return clarity != CELD_LINES_NONE ||
         celd_op_fail (op, _ ("The drawing looks like a photograph or a painting without lines. If it is a drawing, say "
                              "with 'Ink' what its lines are."));
}

/* A page is blank until the artist has drawn something. */
static gboolean
check_ink (CeldOp *op)
{
  CeldPlane ink;

  if (!celd_op_try (op, celd_session_ink (op->operation->session, &op->quiet, &ink, NULL)))
    return FALSE;
  if (celd_ink_has_lines (&ink))
    return TRUE;
  return !op->choosing &&
         celd_op_fail (op, _ ("The drawing has no lines: it is blank, or its lines are too faint. Choose another layer, "
                              "or another setting of 'Ink'."));
}

/* Checks a drawing, and whether the session has ink of it, unless it is the last good one of the pad. */
static gboolean
check (CeldOp *op, const char *pad, const CeldDrawing *drawing, gboolean in_session)
{
  gsize            size = (gsize) op->picture.width * (gsize) op->picture.height * sizeof (float);
  guint64          input = celd_op_settings_input (op);
  CeldGoodDrawing *good = &op->operation->good[!g_str_equal (pad, "input")];

  if (op->settings.flats)
    return TRUE;
  input = celd_op_add_input (input, drawing->luma.data, size);
  input = celd_op_add_input (input, drawing->alpha.data, size);
  if (input != good->input)
    {
      *good = (CeldGoodDrawing) { 0, FALSE };
      if ((op->settings.ink == CELD_INK_AUTO && (!check_parts (op, celd_op_buffer (op, pad)) ||
                                                 !check_lines (op, celd_op_buffer (op, pad), &good->unsure))) ||
          (in_session && !check_ink (op)))
        return FALSE;
      good->input = input;
    }
  return !good->unsure || celd_op_report_text (op, celd_unsure_lines_text ());
}

gboolean
celd_op_check_drawing (CeldOp *op, const char *pad, const CeldDrawing *drawing)
{
  return check (op, pad, drawing, TRUE);
}

gboolean
celd_op_check_lines (CeldOp *op, const char *pad, const CeldDrawing *drawing)
{
  return check (op, pad, drawing, FALSE);
}

/* Compares the scribbles with the drawing. */
static gboolean
find_mix_up (CeldOp *op, const char *drawing_pad, const CeldPaint *scribbles, CeldMixUp *mix_up)
{
  CeldPaint drawing;

  if (!celd_op_new_paint (op, &drawing))
    return FALSE;
  celd_buffer_read_paint (celd_op_buffer (op, drawing_pad), &op->picture, &drawing);
  return celd_op_try (op, celd_mix_up (&drawing, scribbles, mix_up));
}

gboolean
celd_op_check_scribbles (CeldOp *op, const char *drawing_pad, const CeldPaint *scribbles)
{
  CeldMixUp mix_up = CELD_LAYERS_APART;
  bool      drawn = false;

  if (op->settings.flats)
    return TRUE;
  if (!celd_are_scribbles (scribbles))
    return celd_op_fail (op, _ ("The scribbles look like a photograph: scribbles are strokes in flat colours on a "
                                "blank layer. Choose another layer."));
  if (celd_looks_like_levels (scribbles))
    return celd_op_fail (op, _ ("The scribbles look like levels or depth: scribbles are strokes in clear colours, one "
                                "over each part. Choose another layer."));
  if (!celd_op_try (op, celd_may_be_drawing (scribbles, &drawn)) ||
      (drawn && !find_mix_up (op, drawing_pad, scribbles, &mix_up)))
    return FALSE;
  if (mix_up == CELD_LAYERS_DRAWN)
    return celd_op_fail (op, _ ("The scribbles look like a drawing: scribbles are strokes in clear colours. Choose "
                                "another layer."));
  if (mix_up == CELD_LAYERS_SAME)
    return celd_op_fail (op, _ ("The scribbles are the same picture as the drawing: choose the layer with the strokes, "
                                "or 'Scribbles are flat colours' if each part has a flat colour of its own."));
  return mix_up != CELD_LAYERS_EXCHANGED ||
         celd_op_fail (op, _ ("The drawing looks like scribbles, and the scribbles look like a drawing. Exchange them, "
                              "or scribble in clear colours."));
}

/* Of the strokes, and of the drawing whose lines they should not have. */
static guint64
strokes_input (const CeldOperation *operation, const CeldPaint *strokes)
{
  guint64 input = 0;

  for (guint i = 0; i < G_N_ELEMENTS (operation->good); i++)
    input = celd_op_add_input (input, &operation->good[i].input, sizeof operation->good[i].input);
  return celd_op_add_input (input, strokes->data, 4 * (gsize) strokes->width * (gsize) strokes->height);
}

gboolean
celd_op_check_strokes (CeldOp *op, const char *pad, const CeldPaint *strokes, gboolean scribbles)
{
  guint64        input = strokes_input (op->operation, strokes);
  guint64       *good = &op->operation->good_strokes[celd_op_pad_index (op, pad)];
  CeldLayerLines lines;
  CeldPlane      ink;
  gboolean       have;

  if (op->settings.flats || input == *good)
    return TRUE;
  if (!celd_op_try (op, celd_session_ink (op->operation->session, &op->quiet, &ink, NULL)) ||
      !celd_op_try (op, celd_layer_lines (strokes, &ink, &lines)))
    return FALSE;
  have  = lines == CELD_LAYER_OF_LINES || (lines == CELD_LAYER_COLOURED && !scribbles);
  *good = have ? 0 : input;
  return !have || celd_op_fail (op, _ ("The picture for '%s' (pad %s) has the lines of the drawing. Choose a layer with "
                                       "the strokes alone."), _ (celd_op_pad_label (op, pad)), pad);
}

gboolean
celd_op_check_grey (CeldOp *op, const char *pad)
{
  return !celd_buffer_is_coloured (celd_op_buffer (op, pad)) ||
         celd_op_fail (op, _ ("The picture for '%s' (pad %s) is in colour: depth and levels are grey. Choose another "
                              "layer."), _ (celd_op_pad_label (op, pad)), pad);
}

gboolean
celd_op_check_numbers (CeldOp *op, const char *pad)
{
  return celd_buffer_has_numbers (celd_op_buffer (op, pad)) ||
         celd_op_fail (op, _ ("The picture for '%s' (pad %s) has values that are infinite or no number. Paint over them, "
                              "or choose another layer."), _ (celd_op_pad_label (op, pad)), pad);
}
