/* Reads pads into pictures for core, and writes pictures to the output.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include "buffers.h"

#include <string.h>

static gsize
count (const CeldOp *op)
{
  return (gsize) op->picture.width * (gsize) op->picture.height;
}

/* ------------------------------------------------------------------ memory */

gboolean
celd_op_new_plane (CeldOp *op, CeldPlane *plane)
{
  int w = op->picture.width, h = op->picture.height;

  *plane = (CeldPlane) { w, h, (size_t) w, celd_op_alloc (op, count (op) * sizeof (float)) };
  return plane->data != NULL;
}

gboolean
celd_op_new_labels (CeldOp *op, CeldLabels *labels)
{
  int w = op->picture.width, h = op->picture.height;

  *labels = (CeldLabels) { w, h, (size_t) w, celd_op_alloc (op, count (op) * sizeof (uint32_t)) };
  return labels->data != NULL;
}

gboolean
celd_op_new_mask (CeldOp *op, CeldMask *mask)
{
  int w = op->picture.width, h = op->picture.height;

  *mask = (CeldMask) { w, h, (size_t) w, celd_op_alloc (op, count (op)) };
  return mask->data != NULL;
}

gboolean
celd_op_new_paint (CeldOp *op, CeldPaint *paint)
{
  int w = op->picture.width, h = op->picture.height;

  *paint = (CeldPaint) { w, h, (size_t) w, celd_op_alloc (op, 4 * count (op)) };
  return paint->data != NULL;
}

gboolean
celd_op_new_vectors (CeldOp *op, CeldVectors *vectors)
{
  int w = op->picture.width, h = op->picture.height;

  *vectors = (CeldVectors) { w, h, (size_t) w, celd_op_alloc (op, 3 * count (op) * sizeof (float)) };
  return vectors->data != NULL;
}

gboolean
celd_op_new_colours (CeldOp *op, CeldColours *colours)
{
  int w = op->picture.width, h = op->picture.height;

  *colours = (CeldColours) { w, h, (size_t) w, celd_op_alloc (op, 4 * count (op) * sizeof (float)) };
  return colours->data != NULL;
}

/* ------------------------------------------------------------------ reading */

GeglBuffer *
celd_op_buffer (CeldOp *op, const char *pad)
{
  return GEGL_BUFFER (gegl_operation_context_get_object (op->context, pad));
}

gboolean
celd_op_read_plane (CeldOp *op, const char *pad, CeldPlane *plane)
{
  if (!celd_op_check_grey (op, pad) || !celd_op_check_numbers (op, pad) || !celd_op_new_plane (op, plane))
    return FALSE;
  celd_buffer_read_plane (celd_op_buffer (op, pad), &op->picture, plane);
  return TRUE;
}

gboolean
celd_op_read_painted (CeldOp *op, const char *pad, CeldPaint *paint)
{
  if (!celd_op_new_paint (op, paint))
    return FALSE;
  celd_buffer_read_paint (celd_op_buffer (op, pad), &op->picture, paint);
  return TRUE;
}

gboolean
celd_op_read_paint (CeldOp *op, const char *pad, CeldPaint *paint)
{
  return celd_op_check_numbers (op, pad) && celd_op_read_painted (op, pad, paint);
}

gboolean
celd_op_read_colours (CeldOp *op, const char *pad, CeldColours *colours)
{
  if (!celd_op_new_colours (op, colours))
    return FALSE;
  celd_buffer_read_colours (celd_op_buffer (op, pad), &op->picture, colours);
  return TRUE;
}

gboolean
celd_op_read_drawing (CeldOp *op, const char *pad, CeldDrawing *drawing)
{
  GeglBuffer *buffer = celd_op_buffer (op, pad);

  *drawing = (CeldDrawing) { 0 };
  return celd_op_new_plane (op, &drawing->luma) &&
         (!celd_buffer_has_alpha (buffer) || celd_op_new_plane (op, &drawing->alpha)) &&
         celd_op_try (op, celd_buffer_read_drawing (buffer, &op->picture, op->settings.ink, &op->quiet, drawing));
}

gboolean
celd_op_read_ink (CeldOp *op, const char *pad, CeldPlane *ink)
{
  CeldDrawing drawing;

  return celd_op_read_drawing (op, pad, &drawing) &&
         celd_op_check_lines (op, pad, &drawing) &&
         celd_op_new_plane (op, ink) &&
         celd_op_try (op, celd_ink (&drawing, op->settings.ink, &op->quiet, ink));
}

gboolean
celd_op_read_ink_of_art (CeldOp *op, const char *pad, CeldPlane *ink)
{
  CeldDrawing drawing;

  return celd_op_read_drawing (op, pad, &drawing) &&
         celd_op_new_plane (op, ink) &&
         celd_op_try (op, celd_ink (&drawing, op->settings.ink, &op->quiet, ink));
}

gboolean
celd_op_read_sample (CeldOp *op, const char *pad, CeldColours *colours)
{
  const GeglRectangle *r = gegl_buffer_get_extent (celd_op_buffer (op, pad));

  *colours = (CeldColours) { r->width, r->height, (size_t) r->width,
                             celd_op_alloc (op, 4 * (gsize) r->width * (gsize) r->height * sizeof (float)) };
  if (colours->data)
    celd_buffer_read_colours (celd_op_buffer (op, pad), r, colours);
  return colours->data != NULL;
}

gboolean
celd_op_read_scribbles (CeldOp *op, const char *pad, CeldLabels *seeds)
{
  CeldPaint paint;

  if (!celd_op_new_labels (op, seeds))
    return FALSE;
  memset (seeds->data, 0, count (op) * sizeof (uint32_t));
  return !celd_op_has_input (op, pad) ||
         (celd_op_read_paint (op, pad, &paint) &&
          celd_op_try (op, celd_scribbles_read (&paint, &op->settings, &op->quiet, seeds, &op->palette)));
}

gboolean
celd_op_read_relations (CeldOp *op, const char *pad)
{
  const char    *text = op->own.relations ? op->own.relations : "";
  const char    *path = op->own.arrow_path ? op->own.arrow_path : "";
  CeldArrowStyle style = op->settings.arrow_style;
  CeldTextError  error = { 0 };
  CeldPaint      paint;

  return celd_op_try_text (op, celd_relations_parse (text, &op->relations, &error), &error) &&
         celd_op_try_path (op, celd_arrow_path_parse (path, &op->relations, &error), &error) &&
         (!celd_op_has_input (op, pad) ||
          (celd_op_read_paint (op, pad, &paint) &&
           celd_op_try (op, celd_arrows_read (&paint, style, &op->quiet, &op->relations, &op->problems))));
}

/* ------------------------------------------------------------------ writing */

gboolean
celd_op_write (CeldOp *op, const void *pixels)
{
  GeglBuffer *output = gegl_operation_context_get_target (op->context, "output");
  const Babl *format = gegl_operation_get_format (GEGL_OPERATION (op->operation), "output");

  gegl_buffer_set (output, &op->picture, 0, format, pixels, GEGL_AUTO_ROWSTRIDE);
  return TRUE;
}

gboolean
celd_op_write_drawing (CeldOp *op, const CeldDrawing *drawing)
{
  float *pairs;

  if (!drawing->alpha.data)
    return celd_op_write (op, drawing->luma.data);
  pairs = celd_op_alloc (op, 2 * count (op) * sizeof (float));
  if (!pairs)
    return FALSE;
  for (gsize i = 0; i < count (op); i++)
    {
      pairs[2 * i]     = drawing->luma.data[i];
      pairs[2 * i + 1] = drawing->alpha.data[i];
    }
  return celd_op_write (op, pairs);
}

gboolean
celd_op_write_paint (CeldOp *op, const CeldLabels *labels, const CeldPalette *palette)
{
  CeldPaint paint;

  return celd_op_new_paint (op, &paint) &&
         celd_op_try (op, celd_labels_paint (labels, palette, &paint)) &&
         celd_op_write (op, paint.data);
}

gboolean
celd_op_write_normals (CeldOp *op, const CeldVectors *normals)
{
  CeldVectors stored;

  if (!celd_op_new_vectors (op, &stored))
    return FALSE;
  celd_normals_store (normals, op->own.directx, stored.data);
  return celd_op_write (op, stored.data);
}
