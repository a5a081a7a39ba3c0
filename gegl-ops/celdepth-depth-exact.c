/* celdepth:depth-exact: depth by the exact quadratic program (equations 1 and 2 of the paper), through a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_INK
CELD_PROPERTY_FLATS
CELD_PROPERTY_BACKGROUND
CELD_PROPERTY_SAME_COLOUR
CELD_PROPERTY_RELATIONS
CELD_PROPERTY_ARROW_PATH
CELD_PROPERTY_ARROW_STYLE
CELD_PROPERTY_ON_CYCLE
CELD_PROPERTY_ENCODING
CELD_PROPERTY_TOLERANCE

property_double (contrast, "Contrast", 1.0)
    description ("How large a step of the ink must be to part depths, as a factor of the mean of the drawing: "
                 "with less, pale lines part depths too; with more, depth leaks through them")
    value_range (0.01, 100.0)
    ui_range (0.1, 10.0)
    ui_gamma (3.0)
    ui_digits (2)

property_double (weight_floor, "Weight floor", 1e-6)
    description ("How strongly neighbours hold together at least, across the blackest line")
    value_range (1e-6, 1.0)
    ui_range (1e-6, 0.1)
    ui_gamma (5.0)
    ui_digits (6)

#else

#define GEGL_OP_NAME     celdepth_depth_exact
#define GEGL_OP_C_SOURCE celdepth-depth-exact.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Scribbles", "A stroke of another colour over each part; each stroke keeps one depth", FALSE },
  { "aux2", "Arrows", "Arrows from nearer to farther parts", FALSE },
  { "aux3", "Virtual contours", "Red: depth steps here; green: ink where it does not", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format ("Y float"));
}

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.ink          = o->ink;
  s.flats        = o->flats;
  s.background   = o->background;
  s.same_colour  = o->same_colour;
  s.arrow_style  = o->arrow_style;
  s.on_cycle     = o->on_cycle;
  s.encoding     = o->encoding;
  s.near_level   = (float) o->near_level;
  s.far_level    = (float) o->far_level;
  s.tolerance    = (float) o->tolerance;
  s.contrast     = (float) o->contrast;
  s.weight_floor = (float) o->weight_floor;
  celd_op_get_colour (o->background_colour, s.background_colour);
  return s;
}

static gboolean
render (CeldOp *op)
{
  GeglProperties  *o = GEGL_PROPERTIES (op->operation);
  CeldSettings     s = settings (o);
  CeldSession     *session;
  const CeldExact *exact;
  CeldPlane        depth;
  CeldOrder        cycles = { 0 };

  if (!celd_op_set_session (op, &s, o->relations, o->arrow_path) ||
      !celd_op_set_layer (op, "aux3", celd_session_set_contours))
    return FALSE;
  session = op->operation->session;
  if (!celd_op_try (op, celd_session_exact (session, &op->host, &depth, NULL)) ||
      !celd_op_write (op, depth.data))
    return FALSE;
  exact           = celd_session_exact_report (session);
  cycles.cycle    = exact->cycle;
  cycles.n_cycles = exact->n_cycles;
  return celd_op_tell (op, celd_session_problems (session), celd_session_exact_palette (session),
                       celd_session_relations (session), &cycles);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:depth-exact",
    "title",           "Depth Exact",
    "categories",      "artistic",
    "description",     "Depth for a line drawing as the smoothest one that keeps every relation exactly, and steps at "
                       "contours; a second or more for a megapixel, then quick for each new arrow",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Depth Exact...",
    NULL);
}

#endif
