/* celdepth:depth-enhance: what is near stands out against what is behind it (section 5 of the paper, [LCD06]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldEnhanceResult, celd_enhance_result, CELD_ENHANCED_ART)
    description ("The art with its shadows, the shadows alone as a black layer to put over it, or a grey picture of depth, "
                 "as it is read most easily")

CELD_PROPERTY_SHADOWS

#else

#define GEGL_OP_NAME     celdepth_depth_enhance
#define GEGL_OP_C_SOURCE celdepth-depth-enhance.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Art", "The picture that shadows fall on", TRUE },
  { "aux", "Levels", "Expanded depth levels, from Depth Expand, or smooth depth for sharpening", TRUE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gboolean view = GEGL_PROPERTIES (operation)->result == CELD_ENHANCED_VIEW;

  gegl_operation_set_format (operation, "output", babl_format (view ? "Y float" : "RGBA float"));
}

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.enhance         = o->enhance;
  s.shadow_size     = (float) o->shadow_size;
  s.shadow_strength = (float) o->shadow_strength;
  s.shadow_offset   = (float) o->shadow_offset;
  s.shadow_range    = (float) o->shadow_range;
  s.light_azimuth   = (float) o->light_azimuth;
  return s;
}

static gboolean
write_result (CeldOp *op, const CeldPlane *levels, const CeldPlane *change)
{
  CeldColours colours;
  CeldPlane   view;

  switch (GEGL_PROPERTIES (op->operation)->result)
    {
    case CELD_ENHANCED_ART:
      return celd_op_read_colours (op, "input", &colours) &&
             celd_op_try (op, celd_enhance_colours (change, &colours)) &&
             celd_op_write (op, colours.data);
    case CELD_ENHANCED_LAYER:
      return celd_op_new_colours (op, &colours) &&
             celd_op_try (op, celd_enhance_layer (change, &colours)) &&
             celd_op_write (op, colours.data);
    case CELD_ENHANCED_VIEW:
      return celd_op_new_plane (op, &view) &&
             celd_op_try (op, celd_enhance_view (levels, change, &view)) &&
             celd_op_write (op, view.data);
    }
  return FALSE;
}

static gboolean
render (CeldOp *op)
{
  CeldSettings s = settings (GEGL_PROPERTIES (op->operation));
  CeldPlane    levels, change;

  return celd_op_read_plane (op, "aux", &levels) &&
         celd_op_new_plane (op, &change) &&
         celd_op_try (op, celd_enhance (&levels, &s, &op->host, &change)) &&
         write_result (op, &levels, &change);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:depth-enhance",
    "title",           "Depth Enhance",
    "categories",      "artistic:light",
    "description",     "Sets the parts of a picture off against what is behind them, by soft shadows",
    "reference",       CELD_REFERENCE " T. Luft, C. Colditz, O. Deussen: Image Enhancement by Unsharp Masking the "
                       "Depth Buffer. SIGGRAPH 2006.",
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Depth Enhance...",
    NULL);
}

#endif
