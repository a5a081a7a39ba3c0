/* celdepth:lazybrush-segment: scribbles over a drawing become its regions (section 3.2 of the paper, [SDC09b]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldSegmentResult, celd_segment_result, CELD_SEGMENT_LABELS)
    description ("The regions, or what the artist may want to see of how they came about")

CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD
CELD_PROPERTY_METHOD
CELD_PROPERTY_HARDNESS
CELD_PROPERTY_FLATS
CELD_PROPERTY_BACKGROUND
CELD_PROPERTY_SEEDS
CELD_PROPERTY_RELATIONS
CELD_PROPERTY_ARROW_PATH
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
  s.close_gaps    = o->close_gaps;
  s.keep_necks    = o->keep_necks;
  s.hardness      = (float) o->hardness;
  s.flats         = o->flats;
  s.background    = o->background;
  s.seeds         = o->seeds;
  s.arrow_style   = o->arrow_style;
  celd_op_get_colour (o->background_colour, s.background_colour);
  return s;
}

/* A layer for the artist: over the drawing it shows what was closed, and it can be given back as virtual contours. */
static gboolean
write_closures (CeldOp *op)
{
  CeldPaint paint;

  return celd_op_new_paint (op, &paint) &&
         celd_op_try (op, celd_session_paint_closures (op->operation->session, &op->host, &paint)) &&
         celd_op_write (op, paint.data);
}

static gboolean
write_problems (CeldOp *op)
{
  CeldLabels labels;

  return celd_op_try (op, celd_session_labels (op->operation->session, &op->host, &labels, NULL)) &&
         celd_op_write_problems (op);
}

static gboolean
write_result (CeldOp *op)
{
  switch (GEGL_PROPERTIES (op->operation)->result)
    {
    case CELD_SEGMENT_LABELS:   return celd_op_write_labels (op);
    case CELD_SEGMENT_CLOSURES: return write_closures (op);
    case CELD_SEGMENT_PROBLEMS: return write_problems (op);
    }
  return FALSE;
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = settings (o);

  return celd_op_set_session (op, &s, o->relations, o->arrow_path) &&
         write_result (op) &&
         celd_op_tell_session (op, NULL);
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
