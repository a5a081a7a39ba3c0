/* celdepth:depth-smooth: levels become smooth depth that keeps its steps at contours (equation 3 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD
CELD_PROPERTY_HOLD_REST
CELD_PROPERTY_TOLERANCE

#else

#define GEGL_OP_NAME     celdepth_depth_smooth
#define GEGL_OP_C_SOURCE celdepth-depth-smooth.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Levels", "Depth levels, from Depth Expand or Depth Order", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Anchors", "Where it is painted the depth keeps its level, for example the scribbles; without it the "
                       "core of each region does", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format ("Y float"));
}

/* What is painted, by the same reading as of scribbles; *painted is NULL if nothing is. */
static gboolean
read_anchors (CeldOp *op, const CeldSettings *s, CeldMask *mask, const CeldMask **painted)
{
  CeldLabels seeds;

  *painted = NULL;
  if (!celd_op_read_scribbles (op, "aux2", s, &seeds) || !celd_op_new_mask (op, mask))
    return FALSE;
  for (size_t i = 0; i < (size_t) mask->width * (size_t) mask->height; i++)
    if ((mask->data[i] = seeds.data[i] != 0))
      *painted = mask;
  return TRUE;
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = celd_settings ();
  CeldPlane       ink, levels;
  CeldMask        mask;
  const CeldMask *anchors;
  CeldSolve       solve;

  s.ink           = o->ink;
  s.ink_threshold = (float) o->ink_threshold;
  s.hold_rest     = o->hold_rest;
  s.tolerance     = (float) o->tolerance;
  return celd_op_read_ink (op, "aux", o->ink, &ink) &&
         celd_op_read_plane (op, "input", &levels) &&
         read_anchors (op, &s, &mask, &anchors) &&
         celd_op_try (op, celd_smooth (&ink, &levels, anchors, &s, &op->host, &levels, &solve)) &&
         celd_op_tell_solve (op, &solve) &&
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
    "name",            "celdepth:depth-smooth",
    "title",           "Depth Smooth",
    "categories",      "artistic",
    "description",     "Makes smooth depth of depth levels: steps stay where there is ink, and vanish where the "
                       "drawing is open",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Depth Smooth...",
    NULL);
}

#endif
