/* celdepth:depth-expand: ink is given to the region that drew it (the task of section 3.3 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldExpandResult, celd_expand_result, CELD_EXPAND_LEVELS)
    description ("The levels; or the drawing cut up, one layer of it, in linear light; or the owner of each pixel, in "
                 "the colour of its region (without regions, its level as a grey), as opaque as it covers the pixel")

property_int (layer, "Layer", 0)
    description ("Which layer, 0 is the farthest; there is nothing in layers beyond the nearest. Each over the one "
                 "before, they are the drawing again")
    value_range (0, G_MAXINT)
    ui_range (0, 50)
    ui_meta ("visible", "result {layer}")

property_boolean (complete, "Complete", FALSE)
    description ("Layers have what nearer ones hide, too")
    ui_meta ("visible", "result {layer}")

property_enum (method, "Method", CeldExpansion, celd_expansion, CELD_EXPANSION_OUTLINES)
    description (CELD_EXPANSION_WORDS)

CELD_PROPERTY_INK

#else

#define GEGL_OP_NAME     celdepth_depth_expand
#define GEGL_OP_C_SOURCE celdepth-depth-expand.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>
#include <string.h>

static const CeldPad pads[] = {
  { "input", "Levels", "The depth levels of the regions, from Depth Order", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Regions", "Flat colours that part regions of one level; without, a level is one region", FALSE },
  { "aux3", "Corrections", "Strokes over ink, each in the colour of the region that gets that piece of line", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  bool levels = GEGL_PROPERTIES (operation)->result == CELD_EXPAND_LEVELS;

  gegl_operation_set_format (operation, "output", babl_format (levels ? "Y float" : "RGBA float"));
}

/* ------------------------------------------------------------------ what comes in */

typedef struct
{
  CeldPlane  ink, levels;
  CeldLabels regions, corrections; /* data NULL: not there */
} Inputs;

static const CeldLabels *
or_null (const CeldLabels *labels)
{
  return labels->data ? labels : NULL;
}

static gboolean
read_regions (CeldOp *op, CeldLabels *regions)
{
  CeldPaint flats;

  return !celd_op_has (op, "aux2") ||
         (celd_op_read_paint (op, "aux2", &flats) && celd_op_new_labels (op, regions) &&
          celd_op_try (op, celd_labels_read (&flats, regions, &op->palette)));
}

/* Is there paint, and none of it in the colour of a region? */
static gboolean
is_foreign (const CeldPaint *paint, const CeldLabels *corrections)
{
  gboolean painted = FALSE;

  for (gsize p = 0; p < (gsize) paint->width * (gsize) paint->height; p++)
    {
      if (corrections->data[p])
        return FALSE;
      painted = painted || paint->data[4 * p + 3] >= 128;
    }
  return painted;
}

static gboolean
read_corrections (CeldOp *op, const CeldLabels *regions, CeldLabels *corrections)
{
  CeldPaint paint;

  if (!celd_op_has (op, "aux3"))
    return TRUE;
  if (!regions->data)
    return celd_op_fail (op, "Corrections are in the colours of regions. Choose the layer for 'Regions' (pad aux2).");
  if (!celd_op_read_paint (op, "aux3", &paint) || !celd_op_new_labels (op, corrections) ||
      !celd_op_try (op, celd_corrections_read (&paint, &op->palette, corrections)))
    return FALSE;
  return !is_foreign (&paint, corrections) ||
         celd_op_fail (op, "No stroke of 'Corrections' (pad aux3) has the colour of a region. Pick the colours from "
                           "'Regions'.");
}

/* ------------------------------------------------------------------ a layer */

/* The layer on a transparent picture. */
static gboolean
write_layer (CeldOp *op, const CeldLayers *layers, size_t number)
{
  CeldColours canvas, part = { 0 };

  if (!celd_op_new_colours (op, &canvas))
    return FALSE;
  memset (canvas.data, 0, 4 * sizeof (float) * (gsize) canvas.width * (gsize) canvas.height);
  if (number < celd_layers_count (layers))
    {
      const CeldRect *box = &celd_layers_item (layers, number)->box;

      part.data = celd_op_alloc (op, 4 * sizeof (float) * ((gsize) box->width * (gsize) box->height + 1));
      if (!part.data)
        return FALSE;
      celd_layers_paint (layers, number, part.data);
      for (int y = 0; y < box->height; y++)
        memcpy (canvas.data + 4 * ((gsize) (y + box->y) * canvas.stride + (gsize) box->x),
                part.data + 4 * (gsize) y * (gsize) box->width, 4 * sizeof (float) * (gsize) box->width);
    }
  return celd_op_write (op, canvas.data);
}

static gboolean
render_layer (CeldOp *op, const Inputs *in)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldColours     art;
  CeldLayers     *layers = NULL;
  gboolean        good = celd_op_read_colours (op, "aux", &art) &&
                         celd_op_try (op, celd_layers_of_levels (&in->ink, &in->levels, or_null (&in->regions),
                                                                 or_null (&in->corrections), &art, o->method,
                                                                 CELD_STORE_FLOAT, o->complete, &op->host, &layers)) &&
                         write_layer (op, layers, (size_t) o->layer);

  celd_layers_free (layers);
  return good;
}

/* ------------------------------------------------------------------ owner and alpha */

/* The owners' colours in linear light.  A background that no stroke made has none: there is nothing of it. */
static gboolean
colour_owners (CeldOp *op, const CeldLabels *owner, const CeldPlane *level, CeldColours *matte)
{
  long      n = (long) level->width * level->height;
  CeldPaint paint;

  if (owner)
    {
      if (!celd_op_new_paint (op, &paint) || !celd_op_try (op, celd_labels_paint (owner, &op->palette, &paint)))
        return FALSE;
      babl_process (babl_fish (babl_format ("R'G'B'A u8"), babl_format ("RGBA float")), paint.data, matte->data, n);
    }
  else
    babl_process (babl_fish (babl_format ("Y float"), babl_format ("RGBA float")), level->data, matte->data, n);
  return TRUE;
}

static gboolean
render_matte (CeldOp *op, Inputs *in)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldLabels     *owner = in->regions.data ? &in->regions : NULL;
  CeldPlane       share;
  CeldColours     matte;

  if (!celd_op_new_plane (op, &share) || !celd_op_new_colours (op, &matte) ||
      !celd_op_try (op, celd_matte_of_levels (&in->ink, &in->levels, owner, or_null (&in->corrections), o->method,
                                              &op->host, &in->levels, owner, &share)) ||
      !colour_owners (op, owner, &in->levels, &matte))
    return FALSE;
  for (gsize p = 0; p < (gsize) share.width * (gsize) share.height; p++)
    matte.data[4 * p + 3] *= share.data[p];
  return celd_op_write (op, matte.data);
}

/* ------------------------------------------------------------------ levels */

static gboolean
render_levels (CeldOp *op, Inputs *in)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);

  return celd_op_try (op, celd_expand_levels (&in->ink, &in->levels, or_null (&in->regions),
                                              or_null (&in->corrections), o->method, &op->host, &in->levels)) &&
         celd_op_write (op, in->levels.data);
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  Inputs          in = { 0 };

  if (!celd_op_read_ink (op, "aux", o->ink, &in.ink) || !celd_op_read_plane (op, "input", &in.levels) ||
      !read_regions (op, &in.regions) || !read_corrections (op, &in.regions, &in.corrections))
    return FALSE;
  switch (o->result)
    {
    case CELD_EXPAND_LAYER:
      return render_layer (op, &in);
    case CELD_EXPAND_MATTE:
      return render_matte (op, &in);
    case CELD_EXPAND_LEVELS:
      break;
    }
  return render_levels (op, &in);
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
