/* celdepth:depth-expand: ink is given to the region that drew it (section 3.3 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD

#else

#define GEGL_OP_NAME     celdepth_depth_expand
#define GEGL_OP_C_SOURCE celdepth-depth-expand.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

#include <string.h>

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

/* A number for each level that sorts as the level does, and back: the bits of a float as a sign and a size. */
static uint32_t
rank_of_level (float level)
{
  float    number = level == level ? level + 0.0f : 0.0f; /* no NaN, no -0 */
  uint32_t bits;

  memcpy (&bits, &number, sizeof bits);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

static float
level_of_rank (uint32_t rank)
{
  uint32_t bits = rank & 0x80000000u ? rank & 0x7fffffffu : ~rank;
  float    level;

  memcpy (&level, &bits, sizeof level);
  return level;
}

static gboolean
read_ranks (CeldOp *op, CeldPlane *levels, CeldLabels *ranks)
{
  if (!celd_op_read_plane (op, "input", levels) || !celd_op_new_labels (op, ranks))
    return FALSE;
  for (size_t i = 0; i < (size_t) levels->width * (size_t) levels->height; i++)
    ranks->data[i] = rank_of_level (levels->data[i]);
  return TRUE;
}

static gboolean
write_ranks (CeldOp *op, const CeldLabels *ranks, CeldPlane *levels)
{
  for (size_t i = 0; i < (size_t) ranks->width * (size_t) ranks->height; i++)
    levels->data[i] = level_of_rank (ranks->data[i]);
  return celd_op_write (op, levels->data);
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = celd_settings ();
  CeldPlane       ink, levels;
  CeldLabels      ranks;

  s.ink           = o->ink;
  s.ink_threshold = (float) o->ink_threshold;
  return celd_op_read_ink (op, "aux", o->ink, &ink) &&
         read_ranks (op, &levels, &ranks) &&
         celd_op_try (op, celd_expand (&ink, &ranks, &s, &op->run, &ranks)) &&
         write_ranks (op, &ranks, &levels);
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
