/* celdepth:virtual-contours: painted contours baked into a drawing (section 4 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldPurpose, celd_purpose, CELD_FOR_SEGMENTATION)
    description ("The drawing that the segmentation needs, or the one for depth: blue contours count in the "
                 "former alone")

CELD_PROPERTY_INK

#else

#define GEGL_OP_NAME     celdepth_virtual_contours
#define GEGL_OP_C_SOURCE celdepth-virtual-contours.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Contours", "Red: a border for regions and depth; blue: a border for regions, across which depth stays "
                       "smooth; "
                       "green: ink that is no border", TRUE },
  { NULL, NULL, NULL, FALSE }
};

static gboolean
has_alpha (GeglOperation *operation)
{
  const Babl *format = gegl_operation_get_source_format (operation, "input");

  return format && babl_format_has_alpha (format);
}

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format (has_alpha (operation) ? "Y'A float" : "Y' float"));
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldDrawing     drawing;
  CeldPaint       contours;

  return celd_op_read_drawing (op, "input", &drawing) &&
         celd_op_read_paint (op, "aux", &contours) &&
         celd_op_try (op, celd_contours_bake (&drawing, &contours, o->result, o->ink, &op->host, &drawing)) &&
         celd_op_write_drawing (op, &drawing);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:virtual-contours",
    "title",           "Virtual Contours",
    "categories",      "artistic",
    "description",     "Draws painted contours into a line drawing: borders that the artist left out, and ink "
                       "that is no border",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Virtual Contours...",
    NULL);
}

#endif
