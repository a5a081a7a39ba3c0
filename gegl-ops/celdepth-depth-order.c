/* celdepth:depth-order: which region is in front of which (the paper's appendix: topological sorting).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_RELATIONS
CELD_PROPERTY_ARROW_PATH
CELD_PROPERTY_ARROW_STYLE
CELD_PROPERTY_ON_CYCLE
CELD_PROPERTY_SUGGEST
CELD_PROPERTY_SAME_COLOUR
CELD_PROPERTY_BACKGROUND
CELD_PROPERTY_ENCODING
CELD_PROPERTY_INK

#else

#define GEGL_OP_NAME     celdepth_depth_order
#define GEGL_OP_C_SOURCE celdepth-depth-order.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Labels", "The regions as flat colours, made by Lazybrush Segment or painted", TRUE },
  { "aux", "Arrows", "Arrows from nearer to farther parts", FALSE },
  { "aux2", "Drawing", "The line drawing: points on its ink mean the region beside it; suggestions "
                      "come from it", FALSE },
  { "aux3", "Depth hint", "Depth from elsewhere, such as an estimator's, nearer is brighter: suggestions come from "
                          "it, too", FALSE },
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

  s.ink         = o->ink;
  s.arrow_style = o->arrow_style;
  s.on_cycle    = o->on_cycle;
  s.same_colour = o->same_colour;
  s.suggest     = o->suggest;
  s.background  = o->background;
  s.encoding    = o->encoding;
  s.near_level  = (float) o->near_level;
  s.far_level   = (float) o->far_level;
  celd_op_get_colour (o->background_colour, s.background_colour);
  return s;
}

/* The colours of the input as labels of op->palette. */
static gboolean
read_labels (CeldOp *op, const CeldSettings *s, const CeldPlane *ink, CeldLabels *labels)
{
  CeldPaint colours;

  return celd_op_read_paint (op, "input", &colours) &&
         celd_op_new_labels (op, labels) &&
         celd_op_try (op, celd_labels_read (&colours, labels, &op->palette)) &&
         celd_op_try (op, celd_background_mark (labels, ink, s, &op->palette)) &&
         (s->same_colour == CELD_SAME_COLOUR_ONE || celd_op_try (op, celd_separate (&op->quiet, labels, &op->palette)));
}

/* What the drawing says, or without one the regions' shapes; and the depth hint. */
static gboolean
find_suggestions (CeldOp *op, const CeldLabels *labels, const CeldPlane *ink, CeldRelations *suggested)
{
  CeldPlane hint;

  return celd_op_try (op, celd_suggest (labels, &op->palette, ink, &op->quiet, suggested)) &&
         (!celd_op_has (op, "aux3") ||
          (celd_op_read_plane (op, "aux3", &hint) &&
           celd_op_try (op, celd_suggest_from_depth (labels, &op->palette, ink, &hint, &op->quiet, suggested))));
}

/* With `suggest` that joins the relations. */
static gboolean
add_suggestions (CeldOp *op, const CeldSettings *s, const CeldLabels *labels, const CeldPlane *ink)
{
  CeldRelations suggested = { 0 };
  gboolean      good = s->suggest == CELD_SUGGEST_OFF ||
                       (find_suggestions (op, labels, ink, &suggested) &&
                        celd_op_try (op, celd_suggestions_join (labels, &op->palette, &op->relations, &suggested,
                                                                s, ink, &op->quiet, &op->relations)));

  celd_relations_clear (&suggested);
  return good;
}

static gboolean
write_levels (CeldOp *op, const CeldSettings *s, const CeldLabels *labels)
{
  CeldPlane levels;

  if (!celd_op_new_plane (op, &levels))
    return FALSE;
  for (size_t i = 0; i < (size_t) labels->width * (size_t) labels->height; i++)
    levels.data[i] = celd_order_value (&op->order, op->order.level[labels->data[i] - 1], s);
  return celd_op_write (op, levels.data);
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = settings (o);
  gboolean        drawn = celd_op_has (op, "aux2");
  CeldPlane       ink;
  CeldLabels      labels;

  return celd_op_try (op, celd_settings_check (&s)) &&
         (!drawn || celd_op_read_ink (op, "aux2", o->ink, &ink)) &&
         read_labels (op, &s, drawn ? &ink : NULL, &labels) &&
         celd_op_read_relations (op, o->relations, o->arrow_path, "aux", o->arrow_style) &&
         add_suggestions (op, &s, &labels, drawn ? &ink : NULL) &&
         celd_op_try (op, celd_order (&labels, &op->palette, &op->relations, drawn ? &ink : NULL, &s, &op->host,
                                      &op->order, &op->problems)) &&
         celd_op_tell (op, &op->problems, &op->palette, &op->relations, &op->order) &&
         write_levels (op, &s, &labels);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:depth-order",
    "title",           "Depth Order",
    "categories",      "artistic",
    "description",     "Gives each region a depth level, from arrows and relations that say which is in front of "
                       "which",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Depth Order...",
    NULL);
}

#endif
