/* celdepth:lazybrush-segment: scribbles over a drawing become its regions (section 3.2 of the paper, [SDC09b]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD
CELD_PROPERTY_METHOD
CELD_PROPERTY_HARDNESS
CELD_PROPERTY_FLATS
CELD_PROPERTY_BACKGROUND
CELD_PROPERTY_SEEDS
CELD_PROPERTY_RELATIONS
CELD_PROPERTY_ARROW_STYLE

#else

#define GEGL_OP_NAME     celdepth_lazybrush_segment
#define GEGL_OP_C_SOURCE celdepth-lazybrush-segment.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Drawing", "The line drawing", TRUE },
  { "aux", "Scribbles", "A stroke of another colour over each part", FALSE },
  { "aux2", "Arrows", "Arrows from nearer to farther parts; their ends make regions where no scribble is", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format ("R'G'B'A u8"));
}

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.ink           = o->ink;
  s.ink_threshold = (float) o->ink_threshold;
  s.method        = o->method;
  s.hardness      = (float) o->hardness;
  s.flats         = o->flats;
  s.background    = o->background;
  s.seeds         = o->seeds;
  celd_op_get_colour (o->background_colour, s.background_colour);
  return s;
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = settings (o);
  CeldPlane       ink;
  CeldLabels      labels;

  return celd_op_read_ink (op, "input", o->ink, &ink) &&
         celd_op_read_scribbles (op, "aux", &s, &labels) &&
         celd_op_read_relations (op, o->relations, "aux2", o->arrow_style) &&
         celd_op_try (op, celd_segment (&ink, &labels, &op->relations, &s, &op->run,
                                        &labels, &op->palette, &op->problems)) &&
         celd_op_tell (op, &op->problems, &op->palette, &op->relations, NULL) &&
         celd_op_write_paint (op, &labels, &op->palette);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:lazybrush-segment",
    "title",           "Lazybrush Segment",
    "categories",      "artistic",
    "description",     "Finds the parts of a line drawing from a few sloppy strokes; each part gets the colour of "
                       "its stroke",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Lazybrush Segment...",
    NULL);
}

#endif
