/* celdepth:relief: rounded heights from levels, for bump maps and carving (section 5 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice units[] = {
  [CELD_RELIEF_RELATIVE] = { "relative", "From 0 to 1" },
  [CELD_RELIEF_PIXELS]   = { "pixels", "In pixels" },
};

static const CeldSettingInfo unit_row = {
  .name = "unit", .label = "Heights", CELD_OWN_CHOICE (unit, CeldReliefUnit, units),
  .help = "Heights from 0, the lowest, to 1, the highest; or heights in pixels, with depth 0 at height 0"
};

static const CeldProperty properties[] = {
  { .own = &unit_row },
  { .name = "relief-from" },
  { .name = "relief-bulge" }, { .name = "relief-depth" }, { .name = "ink" }, { .name = "ink-threshold" },
  { .name = "hold-gaps" }, { .name = "tolerance" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Levels", "Expanded depth levels from Depth Expand", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Smooth depth", "Smooth depth from Depth Smooth; by default it is computed from the levels", FALSE },
  { "aux3", "Drawing for segmentation", "The drawing with virtual contours for segmentation: the surface goes on where "
                                        "only this one has ink", FALSE },
  { NULL, NULL, NULL, FALSE }
};

/* Scales heights to 0, the lowest, to 1, the highest. */
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
  if (op->own.unit == CELD_RELIEF_RELATIVE)
    normalize (relief->z, (gsize) relief->width * (gsize) relief->height);
  return celd_op_write (op, relief->z);
}

static gboolean
render (CeldOp *op)
{
  CeldPlane  ink, levels, depth = { 0 }, borders = { 0 };
  CeldRelief relief = { 0 };
  gboolean   good;

  good = celd_op_read_ink (op, "aux", &ink) &&
         celd_op_read_plane (op, "input", &levels) &&
         (!celd_op_has_input (op, "aux2") || celd_op_read_plane (op, "aux2", &depth)) &&
         (!celd_op_has_input (op, "aux3") || celd_op_read_ink (op, "aux3", &borders)) &&
         celd_op_try (op, celd_relief (&ink, borders.data ? &borders : NULL, &levels, depth.data ? &depth : NULL,
                                       &op->settings, &op->host, &relief)) &&
         write_heights (op, &relief);
  celd_relief_clear (&relief);
  return good;
}

const CeldOperationInfo celd_relief_operation = {
  .name        = "celdepth:relief",
  .title       = "Relief",
  .categories  = "artistic:light",
  .description = "Turns the parts of a drawing into rounded heights, each in front of what is behind it",
  .reference   = CELD_REFERENCE,
  .pads        = pads,
  .properties  = properties,
  .format      = "Y float",
  .render      = render,
};
