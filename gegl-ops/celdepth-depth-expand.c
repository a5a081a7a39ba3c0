/* celdepth:depth-expand: depth expansion, which gives ink to the regions whose outlines it is (section 3.3).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#include <string.h>

static const CeldSettingChoice results[] = {
  [CELD_EXPAND_LEVELS] = { "levels", "Levels, with contours given to their regions" },
  [CELD_EXPAND_LAYER]  = { "layer", "Layer: one layer of the drawing" },
  [CELD_EXPAND_MATTE]  = { "matte", "Matte: the region of each pixel, and its coverage" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldExpandResult, results),
  .help = "The levels; one layer of the drawing (in linear light); or the region that owns each pixel, in its colour "
          "(without a layer of regions as a grey level) and with its coverage of the pixel as opacity"
};

static const CeldSettingInfo layer_row = {
  .name = "layer", .label = "Layer", .type = CELD_SETTING_INTEGER, .offset = offsetof (CeldOwnValues, layer),
  .least = 0, .most = G_MAXINT, .shown = { 0, 50, 1, 5, .digits = 0 }, .when = "result {layer}",
  .help = "The number of the layer: 0 is the farthest. Layers after the nearest are empty. Together, in this order, "
          "the layers are the drawing again"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .own = &layer_row },
  { .name = "complete", .when = "result {layer}" },
  { .name = "expansion" },
  { .name = "ink" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Levels", "The depth levels of the regions from Depth Order", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Regions", "Flat colours that distinguish regions of the same level. Without this layer each level is one "
                       "region", FALSE },
  { "aux3", "Corrections", "Strokes over ink, each of which gives the piece of line below it to the region of its "
                           "colour", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gboolean levels = celd_operation_own (operation)->result == CELD_EXPAND_LEVELS;

  gegl_operation_set_format (operation, "output", babl_format (levels ? "Y float" : "RGBA float"));
}

/* ------------------------------------------------------------------ input */

typedef struct
{
  CeldPlane  ink, levels;
  CeldPaint  colours;              /* that the drawing was painted in */
  CeldLabels regions, corrections; /* data NULL: not there */
} Inputs;

static const CeldLabels *
labels_or_null (const CeldLabels *labels)
{
  return labels->data ? labels : NULL;
}

static gboolean
read_regions (CeldOp *op, CeldLabels *regions)
{
  CeldPaint flats;

  return !celd_op_has_input (op, "aux2") ||
         (celd_op_read_paint (op, "aux2", &flats) && celd_op_new_labels (op, regions) &&
          celd_op_try (op, celd_labels_read (&flats, regions, &op->palette)));
}

/* Whether there is paint, but none in the colour of a region. */
static gboolean
has_only_unknown_colours (const CeldPaint *paint, const CeldLabels *corrections)
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

  if (!celd_op_has_input (op, "aux3"))
    return TRUE;
  if (!regions->data)
    return celd_op_fail (op, _ ("Corrections have the colours of regions. Choose a layer for 'Regions' (pad aux2)."));
  if (!celd_op_read_paint (op, "aux3", &paint) || !celd_op_new_labels (op, corrections) ||
      !celd_op_try (op, celd_corrections_read (&paint, &op->palette, corrections)))
    return FALSE;
  return !has_only_unknown_colours (&paint, corrections) ||
         celd_op_fail (op, _ ("No stroke of 'Corrections' (pad aux3) has the colour of a region. Pick the colours "
                              "from 'Regions'."));
}

/* ------------------------------------------------------------------ a layer */

/* Writes a layer on a transparent picture. */
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
  const CeldSettings *s = &op->settings;
  const CeldLabels   *regions = labels_or_null (&in->regions), *corrections = labels_or_null (&in->corrections);
  CeldColours         art;
  CeldLayers         *layers = NULL;
  gboolean            good;

  good = celd_op_read_colours (op, "aux", &art) &&
         celd_op_try (op, celd_layers_of_levels (&in->ink, &in->colours, &in->levels, regions, corrections, &art,
                                                 CELD_STORE_FLOAT, s, &op->host, &layers)) &&
         write_layer (op, layers, (size_t) op->own.layer);
  celd_layers_free (layers);
  return good;
}

/* ------------------------------------------------------------------ matte */

/* The colours of the owners in linear light.  A background without scribble is transparent. */
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
  CeldLabels *owner = in->regions.data ? &in->regions : NULL;
  CeldPlane   coverage;
  CeldColours matte;

  if (!celd_op_new_plane (op, &coverage) || !celd_op_new_colours (op, &matte) ||
      !celd_op_try (op, celd_matte_of_levels (&in->ink, &in->colours, &in->levels, owner,
                                              labels_or_null (&in->corrections), op->settings.expansion, &op->host,
                                              &in->levels, owner, &coverage)) ||
      !colour_owners (op, owner, &in->levels, &matte))
    return FALSE;
  for (gsize p = 0; p < (gsize) coverage.width * (gsize) coverage.height; p++)
    matte.data[4 * p + 3] *= coverage.data[p];
  return celd_op_write (op, matte.data);
}

/* ------------------------------------------------------------------ levels */

static gboolean
render_levels (CeldOp *op, Inputs *in)
{
  return celd_op_try (op, celd_expand_levels (&in->ink, &in->colours, &in->levels, labels_or_null (&in->regions),
                                              labels_or_null (&in->corrections), op->settings.expansion, &op->host,
                                              &in->levels)) &&
         celd_op_write (op, in->levels.data);
}

static gboolean
render (CeldOp *op)
{
  Inputs in = { 0 };

  if (!celd_op_read_ink (op, "aux", &in.ink) || !celd_op_read_painted (op, "aux", &in.colours) ||
      !celd_op_read_plane (op, "input", &in.levels) || !read_regions (op, &in.regions) ||
      !read_corrections (op, &in.regions, &in.corrections))
    return FALSE;
  switch ((CeldExpandResult) op->own.result)
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

const CeldOperationInfo celd_depth_expand_operation = {
  .name        = "celdepth:depth-expand",
  .title       = "Depth Expand",
  .categories  = "artistic",
  .description = "Gives each contour to the part that it outlines, so that depth levels change at the outer edge of "
                 "the ink",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
