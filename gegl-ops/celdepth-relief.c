/* celdepth:relief: the parts of a drawing as rounded heights, for bump maps and carving (section 5 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (unit, "Heights", CeldReliefUnit, celd_relief_unit, CELD_RELIEF_RELATIVE)
    description ("From the lowest, 0, to the highest, 1, or in pixels, with depth 0 at 0")

property_enum (from, "Round from", CeldReliefFrom, celd_relief_from, CELD_RELIEF_INFLATION)
    description ("Parts bulge as if inflated, or as their normals say")

CELD_PROPERTY_BULGE

property_double (relief_depth, "Depth", 0.1)
    description ("How far the nearest level stands before the farthest, as a share of the picture's diagonal")
    value_range (0.0, 1.0)
    ui_range (0.0, 0.5)
    ui_steps (0.01, 0.05)
    ui_digits (3)

CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD
CELD_PROPERTY_TOLERANCE

#else

#define GEGL_OP_NAME     celdepth_relief
#define GEGL_OP_C_SOURCE celdepth-relief.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Levels", "Expanded depth levels, from Depth Expand", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Smooth depth", "From Depth Smooth; without it, it is made of the levels", FALSE },
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

  s.ink           = o->ink;
  s.ink_threshold = (float) o->ink_threshold;
  s.tolerance     = (float) o->tolerance;
  s.bulge         = (float) o->bulge;
  s.relief_from   = o->from;
  s.relief_depth  = (float) o->relief_depth;
  return s;
}

/* The lowest becomes 0, the highest 1. */
static void
normalize (float *height, gsize n)
{
  float low = height[0], high = height[0];

  for (gsize i = 1; i < n; i++)
    {
      low  = MIN (low, height[i]);
      high = MAX (high, height[i]);
    }
  for (gsize i = 0; i < n; i++)
    height[i] = high > low ? (height[i] - low) / (high - low) : 0;
}

static gboolean
write_heights (CeldOp *op, const CeldRelief *relief)
{
  if (GEGL_PROPERTIES (op->operation)->unit == CELD_RELIEF_RELATIVE)
    normalize (relief->z, (gsize) relief->width * (gsize) relief->height);
  return celd_op_write (op, relief->z);
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = settings (o);
  CeldPlane       ink, levels, depth = { 0 };
  CeldRelief      relief = { 0 };
  gboolean        good;

  good = celd_op_read_ink (op, "aux", o->ink, &ink) &&
         celd_op_read_plane (op, "input", &levels) &&
         (!celd_op_has (op, "aux2") || celd_op_read_plane (op, "aux2", &depth)) &&
         celd_op_try (op, celd_relief (&ink, &levels, depth.data ? &depth : NULL, &s, &op->host, &relief)) &&
         write_heights (op, &relief);
  celd_relief_clear (&relief);
  return good;
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:relief",
    "title",           "Relief",
    "categories",      "artistic:light",
    "description",     "Rounds the parts of a drawing to heights, each before what is behind it",
    "reference",       CELD_REFERENCE,
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Relief...",
    NULL);
}

#endif
