/* celdepth:popup: the whole route of the paper as one operation, through a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldPopupResult, celd_popup_result, CELD_POPUP_DEPTH)
    description ("How far to go; nearer is lighter in order, levels and depth, which are linear")

CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD
CELD_PROPERTY_METHOD
CELD_PROPERTY_HARDNESS
CELD_PROPERTY_FLATS
CELD_PROPERTY_BACKGROUND
CELD_PROPERTY_SEEDS
CELD_PROPERTY_SAME_COLOUR
CELD_PROPERTY_RELATIONS
CELD_PROPERTY_ARROW_PATH
CELD_PROPERTY_ARROW_STYLE
CELD_PROPERTY_ON_CYCLE
CELD_PROPERTY_SUGGEST
CELD_PROPERTY_ENCODING
CELD_PROPERTY_EXPANSION

property_enum (anchors, "Anchors", CeldAnchors, celd_anchors, CELD_ANCHORS_SCRIBBLES)
    description ("Which pixels keep their level in smooth depth")
    ui_meta ("visible", "result {depth}")

CELD_PROPERTY_HOLD_REST
CELD_PROPERTY_TOLERANCE
CELD_PROPERTY_BULGE
CELD_PROPERTY_LIGHT
CELD_PROPERTY_DIRECTX

#else

#define GEGL_OP_NAME     celdepth_popup
#define GEGL_OP_C_SOURCE celdepth-popup.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Scribbles", "A stroke of another colour over each part", FALSE },
  { "aux2", "Arrows", "Arrows from nearer to farther parts", FALSE },
  { "aux3", "Virtual contours", "Red: a border for regions and depth; blue: a border for regions, across which "
                                "depth stays "
                                "smooth; green: ink that is no border", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  static const char *const formats[] = {
    [CELD_POPUP_LABELS] = "R'G'B'A u8", [CELD_POPUP_ORDER]   = "Y float",   [CELD_POPUP_LEVELS]  = "Y float",
    [CELD_POPUP_DEPTH]  = "Y float",    [CELD_POPUP_NORMALS] = "RGB float", [CELD_POPUP_SHADING] = "Y float",
    [CELD_POPUP_PROBLEMS] = "R'G'B'A u8", [CELD_POPUP_SUGGESTIONS] = "R'G'B'A u8",
  };

  gegl_operation_set_format (operation, "output", babl_format (formats[GEGL_PROPERTIES (operation)->result]));
}

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.ink             = o->ink;
  s.ink_threshold   = (float) o->ink_threshold;
  s.method          = o->method;
  s.close_gaps      = o->close_gaps;
  s.keep_necks      = o->keep_necks;
  s.hardness        = (float) o->hardness;
  s.flats           = o->flats;
  s.background      = o->background;
  s.seeds           = o->seeds;
  s.same_colour     = o->same_colour;
  s.arrow_style     = o->arrow_style;
  s.on_cycle        = o->on_cycle;
  s.suggest         = o->suggest;
  s.encoding        = o->encoding;
  s.expansion       = o->expansion;
  s.near_level      = (float) o->near_level;
  s.far_level       = (float) o->far_level;
  s.anchors         = o->anchors;
  s.hold_rest       = o->hold_rest;
  s.tolerance       = (float) o->tolerance;
  s.bulge           = (float) o->bulge;
  s.light_azimuth   = (float) o->light_azimuth;
  s.light_elevation = (float) o->light_elevation;
  s.ambient         = (float) o->ambient;
  celd_op_get_colour (o->background_colour, s.background_colour);
  return s;
}

static gboolean
write_plane (CeldOp *op, CeldStatus (*ask) (CeldSession *, const CeldHost *, CeldPlane *, CeldRect *))
{
  CeldPlane plane;

  return celd_op_try (op, ask (op->operation->session, &op->host, &plane, NULL)) &&
         celd_op_write (op, plane.data);
}

static gboolean
write_normals (CeldOp *op)
{
  CeldVectors normals;

  return celd_op_try (op, celd_session_normals (op->operation->session, &op->host, &normals, NULL)) &&
         celd_op_write_normals (op, &normals, GEGL_PROPERTIES (op->operation)->directx);
}

/* Those of the order too, where contradictions are found. */
static gboolean
write_problems (CeldOp *op)
{
  const CeldOrder *order;

  return celd_op_try (op, celd_session_order (op->operation->session, &op->host, &order)) &&
         celd_op_write_problems (op);
}

static gboolean
write_suggestions (CeldOp *op)
{
  CeldPaint paint;

  return celd_op_new_paint (op, &paint) &&
         celd_op_try (op, celd_session_paint_suggestions (op->operation->session, &op->host, &paint)) &&
         celd_op_write (op, paint.data);
}

static gboolean
write_result (CeldOp *op)
{
  switch (GEGL_PROPERTIES (op->operation)->result)
    {
    case CELD_POPUP_LABELS:   return celd_op_write_labels (op);
    case CELD_POPUP_ORDER:    return write_plane (op, celd_session_flat);
    case CELD_POPUP_LEVELS:   return write_plane (op, celd_session_levels);
    case CELD_POPUP_DEPTH:    return write_plane (op, celd_session_depth);
    case CELD_POPUP_NORMALS:  return write_normals (op);
    case CELD_POPUP_SHADING:  return write_plane (op, celd_session_shading);
    case CELD_POPUP_PROBLEMS: return write_problems (op);
    case CELD_POPUP_SUGGESTIONS: return write_suggestions (op);
    }
  return FALSE;
}

static gboolean
render (CeldOp *op)
{
  GeglProperties  *o = GEGL_PROPERTIES (op->operation);
  CeldSettings     s = settings (o);
  const CeldOrder *order = NULL;

  if (!celd_op_set_session (op, &s, o->relations, o->arrow_path) ||
      !celd_op_set_layer (op, "aux3", celd_session_set_contours) ||
      !write_result (op))
    return FALSE;
  /* In other cases the order has been made already. */
  if (o->result != CELD_POPUP_LABELS && o->result != CELD_POPUP_SUGGESTIONS &&
      !celd_op_try (op, celd_session_order (op->operation->session, NULL, &order)))
    return FALSE;
  return celd_op_tell_session (op, order);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:popup",
    "title",           "Pop-up",
    "categories",      "artistic",
    "description",     "Depth for a line drawing from scribbles over its parts and arrows from nearer to farther "
                       "ones, in one step",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Pop-up...",
    NULL);
}

#endif
