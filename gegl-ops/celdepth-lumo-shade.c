/* celdepth:lumo-shade: normals that bulge between contours, and the light on them (section 5 of the paper, [Joh02]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldLumoResult, celd_lumo_result, CELD_LUMO_ART)
    description ("The art as the light falls on it, the light alone (linear), or the normals as 0.5 + 0.5 n "
                 "(numbers, not colours)")

CELD_PROPERTY_BULGE
CELD_PROPERTY_LIGHT
CELD_PROPERTY_DIRECTX
CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD

#else

#define GEGL_OP_NAME     celdepth_lumo_shade
#define GEGL_OP_C_SOURCE celdepth-lumo-shade.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Levels", "Expanded depth levels, from Depth Expand", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Colour art", "What the light falls on; without it the drawing", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  static const char *const formats[] = {
    [CELD_LUMO_ART] = "RGBA float", [CELD_LUMO_SHADING] = "Y float", [CELD_LUMO_NORMALS] = "RGB float",
  };

  gegl_operation_set_format (operation, "output", babl_format (formats[GEGL_PROPERTIES (operation)->result]));
}

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.ink             = o->ink;
  s.ink_threshold   = (float) o->ink_threshold;
  s.bulge           = (float) o->bulge;
  s.light_azimuth   = (float) o->light_azimuth;
  s.light_elevation = (float) o->light_elevation;
  s.ambient         = (float) o->ambient;
  return s;
}

static gboolean
write_result (CeldOp *op, const CeldSettings *s, const CeldVectors *normals)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldPlane       light;

  if (o->result == CELD_LUMO_NORMALS)
    return celd_op_write_normals (op, normals, o->directx);
  return celd_op_new_plane (op, &light) &&
         celd_op_try (op, celd_shade (normals, s, &light)) &&
         (o->result == CELD_LUMO_SHADING ? celd_op_write (op, light.data)
                                         : celd_op_write_lit (op, celd_op_has (op, "aux2") ? "aux2" : "aux", &light));
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = settings (o);
  CeldPlane       ink, levels;
  CeldVectors     normals;

  return celd_op_read_ink (op, "aux", o->ink, &ink) &&
         celd_op_read_plane (op, "input", &levels) &&
         celd_op_new_vectors (op, &normals) &&
         celd_op_try (op, celd_normals (&ink, &levels, &s, &op->run, &normals)) &&
         write_result (op, &s, &normals);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:lumo-shade",
    "title",           "Lumo Shade",
    "categories",      "artistic:light",
    "description",     "Shades a drawing as if its parts were round: the parts in front bend at their contours, "
                       "those behind do not",
    "reference",       CELD_REFERENCE " S. F. Johnston: Lumo: Illumination for Cel Animation. NPAR 2002.",
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Lumo Shade...",
    NULL);
}

#endif
