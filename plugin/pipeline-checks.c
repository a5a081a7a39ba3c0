/* Layers that are something else than they were chosen for.  Each is refused, with a sentence that says what to do.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-parts.h"

#include "buffers.h"

static CeldStatus
read_paint (const CeldPipeline *p, const CeldPipelineInput *input, CeldLayerRole role, CeldPaint *paint)
{
  GeglRectangle rect = celd_pipeline_rectangle (&input->layer[role], p->width, p->height);

  *paint = celd_pipeline_new_paint (p);
  if (!paint->data)
    return CELD_NO_MEMORY;
  celd_buffer_read_paint (input->layer[role].buffer, &rect, paint);
  return CELD_OK;
}

/* In a drawing such values are paper. */
static gboolean
check_numbers (const CeldPipelineInput *input, guint layers, GError **error)
{
  for (int role = CELD_LAYER_SCRIBBLES; role < CELD_N_LAYERS; role++)
    if (layers & 1u << role && input->layer[role].buffer && !celd_buffer_has_numbers (input->layer[role].buffer))
      return celd_pipeline_fail (error, _ ("The layer with '%s' has values that are infinite or no number. Paint over "
                                           "them, or choose another layer."),
                                 _ (celd_layer_role_name ((CeldLayerRole) role)));
  return TRUE;
}

/* Compares the scribbles with the drawing if they may be one. */
static CeldStatus
find_mix_up (const CeldPipeline *p, const CeldPipelineInput *input, const CeldPaint *scribbles, CeldMixUp *mix_up)
{
  CeldPaint  drawing = { 0 };
  bool       drawn = false;
  CeldStatus status = celd_may_be_drawing (scribbles, &drawn);

  if (status == CELD_OK && drawn)
    status = read_paint (p, input, CELD_LAYER_DRAWING, &drawing);
  if (status == CELD_OK && drawn)
    status = celd_mix_up (&drawing, scribbles, mix_up);
  g_free (drawing.data);
  return status;
}

static gboolean
check_scribbles (const CeldPipeline *p, const CeldPipelineInput *input, GError **error)
{
  CeldPaint scribbles = { 0 };
  CeldMixUp mix_up = CELD_LAYERS_APART;
  gboolean  good = celd_pipeline_try (read_paint (p, input, CELD_LAYER_SCRIBBLES, &scribbles), error);

  if (good && !celd_are_scribbles (&scribbles))
    good = celd_pipeline_fail (error, _ ("The layer with the scribbles looks like a photograph: scribbles are "
                                         "strokes in flat colours on a blank layer. Choose another layer."));
  if (good && celd_looks_like_levels (&scribbles))
    good = celd_pipeline_fail (error, _ ("The layer with the scribbles looks like levels or depth: scribbles are strokes "
                                         "in clear colours, one over each part. Choose another layer."));
  if (good)
    good = celd_pipeline_try (find_mix_up (p, input, &scribbles, &mix_up), error);
  if (good && mix_up == CELD_LAYERS_SAME)
    good = celd_pipeline_fail (error, _ ("The layer chosen as scribbles is the same picture as the drawing: choose the "
                                         "layer with the strokes, or 'Scribbles are flat colours' if each part has a "
                                         "flat colour of its own."));
  if (good && mix_up == CELD_LAYERS_DRAWN)
    good = celd_pipeline_fail (error, _ ("The layer chosen as scribbles looks like a drawing: scribbles are "
                                         "strokes in clear colours. Choose another layer."));
  if (good && mix_up == CELD_LAYERS_EXCHANGED)
    good = celd_pipeline_fail (error, _ ("The layer chosen as the drawing looks like scribbles, and the one chosen "
                                         "as scribbles like a drawing. Exchange them, or scribble in clear colours."));
  g_free (scribbles.data);
  return good;
}

/* Whether the drawing has lines between its parts, which levels and depth have not. */
static gboolean
check_parts (const CeldPipeline *p, const CeldPipelineInput *input, GError **error)
{
  CeldPaint  drawing = { 0 };
  CeldStatus status = read_paint (p, input, CELD_LAYER_DRAWING, &drawing);
  bool       levels = status == CELD_OK && celd_looks_like_levels (&drawing);

  g_free (drawing.data);
  return celd_pipeline_try (status, error) &&
         (!levels ||
          celd_pipeline_fail (error, _ ("The layer with the drawing looks like levels or depth. Choose another layer; if "
                                        "it is a drawing, say with the setting 'Ink' what its lines are.")));
}

/* The drawing as it is, not the lines of a coloured one. */
static gboolean
check_clarity (CeldPipeline *p, const CeldPipelineInput *input, GError **error)
{
  const CeldPipelineLayer *layer = &input->layer[CELD_LAYER_DRAWING];
  GeglRectangle            rect = celd_pipeline_rectangle (layer, p->width, p->height);
  gboolean                 alpha = celd_buffer_has_alpha (layer->buffer);
  CeldHost                 host = { NULL, celd_gegl_each, NULL };
  CeldDrawing              drawing = { .luma = celd_pipeline_new_plane (p) };
  CeldLineClarity          clarity;
  CeldStatus               status = CELD_NO_MEMORY;

  if (alpha)
    drawing.alpha = celd_pipeline_new_plane (p);
  if (drawing.luma.data && (!alpha || drawing.alpha.data))
    status = celd_buffer_read_drawing (layer->buffer, &rect, CELD_INK_DARK, &host, &drawing);
  if (status == CELD_OK)
    status = celd_line_clarity (&drawing, &host, &clarity);
  g_free (drawing.luma.data);
  g_free (drawing.alpha.data);
  p->unsure = status == CELD_OK && clarity == CELD_LINES_UNSURE;
  return celd_pipeline_try (status, error) &&
         (clarity != CELD_LINES_NONE ||
          celd_pipeline_fail (error, _ ("The layer with the drawing looks like a photograph or a painting without "
                                        "lines. If it is a drawing, say with the setting 'Ink' what its lines are.")));
}

gboolean
celd_pipeline_check_layers (CeldPipeline *p, const CeldPipelineInput *input, guint layers, GError **error)
{
  gboolean scribbles = layers & 1u << CELD_LAYER_SCRIBBLES && input->layer[CELD_LAYER_SCRIBBLES].buffer;
  gboolean drawing = layers & 1u << CELD_LAYER_DRAWING && p->settings.ink == CELD_INK_AUTO;

  p->unsure = p->unsure && !(layers & 1u << CELD_LAYER_DRAWING) && !p->settings.flats;
  if (!check_numbers (input, layers, error))
    return FALSE;
  if (p->settings.flats)
    return TRUE;
  return (!scribbles || check_scribbles (p, input, error)) &&
         (!drawing || (check_parts (p, input, error) && check_clarity (p, input, error)));
}

static gboolean
check_strokes (const CeldPipeline *p, const CeldPipelineInput *input, CeldLayerRole role, const CeldPlane *ink,
               GError **error)
{
  CeldPaint      paint = { 0 };
  CeldLayerLines lines = CELD_LAYER_WITHOUT_LINES;
  CeldStatus     status = read_paint (p, input, role, &paint);

  if (status == CELD_OK)
    status = celd_layer_lines (&paint, ink, &lines);
  g_free (paint.data);
  return celd_pipeline_try (status, error) &&
         (lines == CELD_LAYER_WITHOUT_LINES || (lines == CELD_LAYER_COLOURED && role == CELD_LAYER_SCRIBBLES) ||
          celd_pipeline_fail (error, _ ("The layer with '%s' has the lines of the drawing. Choose a layer with the "
                                        "strokes alone."), _ (celd_layer_role_name (role))));
}

gboolean
celd_pipeline_check_lines (CeldPipeline *p, const CeldPipelineInput *input, guint layers, GError **error)
{
  CeldHost  host = { NULL, celd_gegl_each, NULL };
  CeldPlane ink;
  gboolean  good;

  if (p->settings.flats)
    return TRUE;
  good = celd_pipeline_try (celd_session_ink (p->session, &host, &ink, NULL), error) &&
         (celd_ink_has_lines (&ink) ||
          celd_pipeline_fail (error, _ ("The layer with the drawing has no lines: it is blank, or its lines are too "
                                        "faint. Choose another layer, or another setting of 'Ink'.")));
  for (int role = CELD_LAYER_SCRIBBLES; good && role < CELD_N_LAYERS; role++)
    if (layers & 1u << role && input->layer[role].buffer)
      good = check_strokes (p, input, (CeldLayerRole) role, &ink, error);
  return good;
}

gboolean
celd_pipeline_check_grey (const CeldPipelineLayer *layer, GError **error)
{
  if (celd_buffer_is_coloured (layer->buffer))
    return celd_pipeline_fail (error, _ ("The layer is in colour: depth is grey. Choose a layer with depth or levels."));
  return celd_buffer_has_numbers (layer->buffer) ||
         celd_pipeline_fail (error, _ ("The layer has values that are infinite or no number. Paint over them, or choose "
                                       "another layer."));
}
