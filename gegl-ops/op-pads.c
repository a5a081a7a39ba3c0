/* The pads of an operation, and checks of the pictures on them.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "op-parts.h"

#include <string.h>

static void
create_pad (GeglOperation *operation, const char *name, const char *label, const char *description, GParamFlags access,
            GeglPadType type)
{
  GParamFlags flags = (GParamFlags) ((guint) access | (guint) type);
  GParamSpec *pad = g_param_spec_object (name, label, description, GEGL_TYPE_BUFFER, flags);

  gegl_operation_create_pad (operation, pad);
  g_param_spec_sink (pad);
}

/* Creates the pads in the order in which GIMP shows them. */
void
celd_operation_attach (GeglOperation *operation)
{
  for (const CeldPad *pad = CELD_OPERATION_CLASS_OF (operation)->info->pads; pad->name; pad++)
    create_pad (operation, pad->name, _ (pad->label), _ (pad->description), G_PARAM_READWRITE,
                GEGL_PARAM_PAD_INPUT);
  create_pad (operation, "output", "Output", "The result", G_PARAM_READABLE, GEGL_PARAM_PAD_OUTPUT);
}

/* Whether no layer has been chosen for the pad yet: GIMP then connects a source without a buffer. */
static gboolean
is_empty_picker (CeldOp *op, const char *pad)
{
  GeglNode   *producer = gegl_node_get_producer (GEGL_OPERATION (op->operation)->node, pad, NULL);
  GeglBuffer *buffer = NULL;

  if (!producer || g_strcmp0 (gegl_node_get_operation (producer), "gegl:buffer-source"))
    return FALSE;
  gegl_node_get (producer, "buffer", &buffer, NULL);
  if (!buffer)
    return TRUE;
  g_object_unref (buffer);
  return FALSE;
}

guint
celd_op_pad_index (CeldOp *op, const char *name)
{
  const CeldPad *pad = CELD_OPERATION_CLASS_OF (op->operation)->info->pads;
  guint          i = 0;

  while (strcmp (pad[i].name, name))
    i++;
  g_assert (i < CELD_MAX_PADS);
  return i;
}

const char *
celd_op_pad_label (CeldOp *op, const char *name)
{
  return CELD_OPERATION_CLASS_OF (op->operation)->info->pads[celd_op_pad_index (op, name)].label;
}

gboolean
celd_op_has_input (CeldOp *op, const char *pad)
{
  return gegl_operation_context_get_object (op->context, pad) != NULL && !is_empty_picker (op, pad);
}

/* Tells the artist that a layer does not have the picture's rectangle: GIMP does not pass on the offsets of layers, so
 * that the drawing may be the layer that is smaller than the image. */
static void
report_size (CeldOp *op, const CeldPad *pad, const GeglRectangle *r)
{
  const char          *help = CELD_OPERATION_CLASS_OF (op->operation)->info->size_help;
  const GeglRectangle *p = &op->picture;
  char                 text[600];

  if (gegl_rectangle_equal (r, p) || gegl_rectangle_is_infinite_plane (r))
    return;
  g_snprintf (text, sizeof text,
              _ ("'%s' has %d x %d pixels at %d, %d, but the picture has %d x %d at %d, %d. Pixels outside the picture "
                 "are ignored, and missing pixels are empty. %s"),
              _ (pad->label), r->width, r->height, r->x, r->y, p->width, p->height, p->x, p->y,
              help ? _ (help) : _ ("If the result is shifted, give the layer the picture's size (in GIMP: Layer, Layer to "
                               "Image Size, for this layer and for the one that the filter is applied to)."));
  celd_op_add_line (op, text);
}

/* Whether a sample has a size that can be used. */
static gboolean
check_sample (CeldOp *op, const CeldPad *pad, const GeglRectangle *r)
{
  if (gegl_rectangle_is_infinite_plane (r) || r->width > CELD_MAX_SIDE || r->height > CELD_MAX_SIDE)
    return celd_op_fail (op, _ ("The picture for '%s' (pad %s) is too large. Scale it down or crop it."),
                         _ (pad->label), pad->name);
  return TRUE;
}

/* Whether the pad has a picture that can be used.  Layers may be smaller than the drawing, but must overlap it. */
static gboolean
check_pad (CeldOp *op, const CeldPad *pad)
{
  const GeglRectangle *p = &op->picture;
  const GeglRectangle *r = gegl_operation_source_get_bounding_box (GEGL_OPERATION (op->operation), pad->name);

  if (is_empty_picker (op, pad->name))
    {
      op->choosing = TRUE;
      return pad->required != TRUE;
    }
  if (!r)
    return pad->required != TRUE ||
           celd_op_fail (op, _ ("There is no picture for '%s' (pad %s). Choose a layer."), _ (pad->label), pad->name);
  if (!r->width || !r->height)
    return celd_op_fail (op, _ ("The picture for '%s' (pad %s) is empty. Choose another layer, or check that its "
                                "file can be read."),
                         _ (pad->label), pad->name);
  if (pad->required == CELD_PAD_SAMPLE)
    return check_sample (op, pad, r);
  if (!gegl_rectangle_intersect (NULL, r, p))
    return celd_op_fail (op, _ ("'%s' (%d x %d pixels at %d, %d) lies outside the picture (%d x %d at %d, %d). Move "
                                "it over the picture, or give it the picture's size."),
                         _ (pad->label), r->width, r->height, r->x, r->y, p->width, p->height, p->x, p->y);
  report_size (op, pad, r);
  return TRUE;
}

gboolean
celd_op_check_pads (CeldOp *op)
{
  const GeglRectangle *p = &op->picture;

  if (gegl_rectangle_is_infinite_plane (p))
    return celd_op_fail (op, _ ("The input is infinitely large. Crop it first."));
  if (p->width > CELD_MAX_SIDE || p->height > CELD_MAX_SIDE)
    return celd_op_fail (op, _ ("The picture has %d x %d pixels; the limit is %d pixels per side. Scale it down "
                                "first."),
                         p->width, p->height, CELD_MAX_SIDE);
  for (const CeldPad *pad = CELD_OPERATION_CLASS_OF (op->operation)->info->pads; pad->name; pad++)
    if (!check_pad (op, pad))
      return FALSE;
  return TRUE;
}
