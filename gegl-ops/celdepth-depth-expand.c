/* celdepth:depth-expand: ink is given to the region that drew it (section 3.3 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_INK

#else

#define GEGL_OP_NAME     celdepth_depth_expand
#define GEGL_OP_C_SOURCE celdepth-depth-expand.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Levels", "The depth levels of the regions, from Depth Order", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format ("Y float"));
}

static gboolean
render (CeldOp *op)
{
  CeldPlane ink, levels;

  return celd_op_read_ink (op, "aux", GEGL_PROPERTIES (op->operation)->ink, &ink) &&
         celd_op_read_plane (op, "input", &levels) &&
         celd_op_try (op, celd_expand_levels (&ink, &levels, &op->run, &levels)) &&
         celd_op_write (op, levels.data);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:depth-expand",
    "title",           "Depth Expand",
    "categories",      "artistic",
    "description",     "Gives each contour to the region in front, which drew it, so that levels change at the "
                       "outer edge of the ink",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Depth Expand...",
    NULL);
}

#endif
