/* celdepth:lumo-shade: normals inflated from contours, and light on them (section 5 of the paper, [Joh02]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

static const CeldSettingChoice results[] = {
  [CELD_LUMO_ART]       = { "art", "Shaded art" },
  [CELD_LUMO_SHADING]   = { "shading", "Shading" },
  [CELD_LUMO_NORMALS]   = { "normals", "Normals" },
  [CELD_LUMO_TONE]      = { "tone", "Tone: a layer to multiply the art by" },
  [CELD_LUMO_RIM]       = { "rim", "Rim: a layer of highlights and rims" },
  [CELD_LUMO_OCCLUSION] = { "occlusion", "Occlusion" },
};

static const CeldSettingInfo result_row = {
  .name = "result", .label = "Result", CELD_OWN_CHOICE (result, CeldLumoResult, results),
  .help = "The lit art; the light alone (linear); the normals as 0.5 + 0.5 n (numbers, not colours); a layer to "
          "multiply the art by; a layer of highlights to put over the product; or ambient occlusion, the fraction of "
          "light that nearer parts let through (numbers)"
};

static const CeldProperty properties[] = {
  { .own = &result_row },
  { .name = "light-model" }, { .name = "toon-steps" }, { .name = "light-azimuth" }, { .name = "light-elevation" },
  { .name = "ambient" }, { .name = "specular" }, { .name = "rim-light" }, { .name = "bulge" }, { .name = "bevel" },
  { .name = "shadow-size", .label = "Occlusion size", .when = "result {occlusion}",
    .help = "How far nearer parts block light from those behind them, as a fraction of the picture's diagonal" },
  { .name = "shadow-strength", .label = "Occlusion strength", .when = "result {occlusion}",
    .help = "The largest fraction of light that nearer parts block" },
  { .name = "directx" },
  { .name = "more" },
  { .name = "light", .rare = TRUE }, { .name = "light-x", .rare = TRUE }, { .name = "light-y", .rare = TRUE },
  { .name = "light-height", .rare = TRUE }, { .name = "shininess", .rare = TRUE },
  { .name = "rim-power", .rare = TRUE }, { .name = "creases", .rare = TRUE },
  { .name = "frame-outline", .rare = TRUE }, { .name = "light-background", .rare = TRUE },
  { .name = "ink", .rare = TRUE }, { .name = "ink-threshold", .rare = TRUE }, { .name = "hold-gaps", .rare = TRUE },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Levels", "Expanded depth levels from Depth Expand", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Colour art", "The picture to light; the drawing by default", FALSE },
  { "aux3", "Smooth depth", "Smooth depth from Depth Smooth, which tells the nearer side of strokes inside a "
                            "part", FALSE },
  { "aux4", "Hints", "Paint beside lines: parts bend on a white side, do not bend on a black side, and bend on both "
                     "sides at grey", FALSE },
  { "aux5", "Matcap", "The picture of a lit ball, from which parts take their shading", CELD_PAD_SAMPLE },
  { "aux6", "Drawing for segmentation", "The drawing with virtual contours for segmentation: shading goes on where "
                                        "only this one has ink", FALSE },
  { NULL, NULL, NULL, FALSE }
};

/* Shading is grey, but coloured with a matcap. */
static void
prepare (GeglOperation *operation)
{
  static const char *const formats[] = {
    [CELD_LUMO_ART] = "RGBA float", [CELD_LUMO_SHADING] = "Y float",   [CELD_LUMO_NORMALS] = "RGB float",
    [CELD_LUMO_TONE] = "RGBA float", [CELD_LUMO_RIM] = "RGBA float", [CELD_LUMO_OCCLUSION] = "Y float",
  };
  int                      result = celd_operation_own (operation)->result;
  gboolean                 coloured = result == CELD_LUMO_SHADING &&
                                      celd_operation_settings (operation)->light_model == CELD_MODEL_MATCAP;

  gegl_operation_set_format (operation, "output", babl_format (coloured ? "RGBA float" : formats[result]));
}

/* Writes lit art, or light on white. */
static gboolean
write_lit (CeldOp *op, const CeldColours *tone, const CeldPlane *gloss)
{
  gboolean    art = op->own.result == CELD_LUMO_ART;
  CeldColours colours;

  if (!(art ? celd_op_read_colours (op, celd_op_has_input (op, "aux2") ? "aux2" : "aux", &colours)
            : celd_op_new_colours (op, &colours)))
    return FALSE;
  for (gsize i = 0; !art && i < 4 * (gsize) colours.width * (gsize) colours.height; i++)
    colours.data[i] = 1;
  return celd_op_try (op, celd_light_colours (tone, gloss, &colours)) &&
         celd_op_write (op, colours.data);
}

static gboolean
write_light (CeldOp *op, const CeldPlane *ink, const CeldPlane *levels, const CeldVectors *normals)
{
  const CeldSettings *s = &op->settings;
  gboolean            by_matcap = s->light_model == CELD_MODEL_MATCAP;
  CeldColours         tone, layer, matcap = { 0 };
  CeldPlane           gloss;

  if (by_matcap && !celd_op_has_input (op, "aux5"))
    return celd_op_fail (op, _ ("There is no picture for 'Matcap' (pad aux5). Choose the picture of a lit ball, or "
                                "another light model."));
  if ((by_matcap && !celd_op_read_sample (op, "aux5", &matcap)) || !celd_op_new_colours (op, &tone) ||
      !celd_op_new_plane (op, &gloss) ||
      !celd_op_try (op, celd_light (normals, ink, levels, by_matcap ? &matcap : NULL, s, &op->quiet, &tone, &gloss)))
    return FALSE;
  if (op->own.result == CELD_LUMO_TONE)
    return celd_op_write (op, tone.data);
  if (op->own.result == CELD_LUMO_RIM)
    return celd_op_new_colours (op, &layer) &&
           celd_op_try (op, celd_light_layer (&gloss, &layer)) &&
           celd_op_write (op, layer.data);
  return write_lit (op, &tone, &gloss);
}

static gboolean
write_result (CeldOp *op, const CeldPlane *ink, const CeldPlane *levels, const CeldVectors *normals)
{
  CeldPlane shading;

  if (op->own.result == CELD_LUMO_NORMALS)
    return celd_op_write_normals (op, normals);
  if (op->own.result != CELD_LUMO_SHADING || op->settings.light_model == CELD_MODEL_MATCAP)
    return write_light (op, ink, levels, normals);
  return celd_op_new_plane (op, &shading) &&
         celd_op_try (op, celd_shade (normals, &op->settings, &shading)) &&
         celd_op_write (op, shading.data);
}

static gboolean
write_occlusion (CeldOp *op, const CeldPlane *levels)
{
  CeldPlane occlusion;

  return celd_op_new_plane (op, &occlusion) &&
         celd_op_try (op, celd_occlusion (levels, &op->settings, &op->host, &occlusion)) &&
         celd_op_write (op, occlusion.data);
}

static gboolean
render (CeldOp *op)
{
  CeldPlane   ink, levels, depth = { 0 }, borders = { 0 };
  CeldPaint   hints = { 0 };
  CeldVectors normals;
  gboolean    deep = celd_op_has_input (op, "aux3"), hinted = celd_op_has_input (op, "aux4");

  if (!celd_op_read_plane (op, "input", &levels))
    return FALSE;
  if (op->own.result == CELD_LUMO_OCCLUSION)
    return write_occlusion (op, &levels);
  return celd_op_read_ink (op, "aux", &ink) &&
         (!deep || celd_op_read_plane (op, "aux3", &depth)) &&
         (!hinted || celd_op_read_paint (op, "aux4", &hints)) &&
         (!celd_op_has_input (op, "aux6") || celd_op_read_ink (op, "aux6", &borders)) &&
         celd_op_new_vectors (op, &normals) &&
         celd_op_try (op, celd_normals_hinted (&ink, borders.data ? &borders : NULL, &levels, deep ? &depth : NULL,
                                               hinted ? &hints : NULL, &op->settings, &op->host, &normals)) &&
         write_result (op, &ink, &levels, &normals);
}

const CeldOperationInfo celd_lumo_shade_operation = {
  .name        = "celdepth:lumo-shade",
  .title       = "Lumo Shade",
  .categories  = "artistic:light",
  .description = "Shades a drawing as if its parts were round, also where nearer ones hide some of them",
  .reference   = CELD_REFERENCE " S. F. Johnston: Lumo: Illumination for Cel Animation. NPAR 2002.",
  .pads        = pads,
  .properties  = properties,
  .prepare     = prepare,
  .render      = render,
};
