/* celdepth:lumo-shade: normals that bulge between contours, and the light on them (section 5 of the paper, [Joh02]).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

property_enum (result, "Result", CeldLumoResult, celd_lumo_result, CELD_LUMO_ART)
    description ("The art as the light falls on it; the light alone (linear); the normals as 0.5 + 0.5 n (numbers, not "
                 "colours); a layer to multiply art by and one to put over that; or how much light parts leave to "
                 "those behind them (numbers)")

CELD_PROPERTY_BULGE
CELD_PROPERTY_SHAPE
CELD_PROPERTY_SHADING
CELD_PROPERTY_LIGHT
CELD_PROPERTY_POINT_LIGHT
CELD_PROPERTY_GLOSS
CELD_PROPERTY_OCCLUSION
CELD_PROPERTY_DIRECTX
CELD_PROPERTY_INK
CELD_PROPERTY_INK_THRESHOLD

#else

#define GEGL_OP_NAME     celdepth_lumo_shade
#define GEGL_OP_C_SOURCE celdepth-lumo-shade.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Levels", "Expanded depth levels, from Depth Expand", TRUE },
  { "aux", "Drawing", "The line drawing", TRUE },
  { "aux2", "Colour art", "What the light falls on; without it the drawing", FALSE },
  { "aux3", "Smooth depth", "Which side of a stroke inside a part is higher", FALSE },
  { "aux4", "Hints", "Paint beside lines: on a white side parts bend, on a black one they do not, at grey ones on both",
    FALSE },
  { "aux5", "Matcap", "The picture of a lit ball, for shading like it", CELD_PAD_SAMPLE },
  { NULL, NULL, NULL, FALSE }
};

/* The light alone is grey, unless a matcap gives it colours. */
static void
prepare (GeglOperation *operation)
{
  static const char *const formats[] = {
    [CELD_LUMO_ART] = "RGBA float", [CELD_LUMO_SHADING] = "Y float",   [CELD_LUMO_NORMALS] = "RGB float",
    [CELD_LUMO_TONE] = "RGBA float", [CELD_LUMO_RIM] = "RGBA float", [CELD_LUMO_OCCLUSION] = "Y float",
  };
  GeglProperties *o = GEGL_PROPERTIES (operation);
  gboolean        coloured = o->result == CELD_LUMO_SHADING && o->light_model == CELD_MODEL_MATCAP;

  gegl_operation_set_format (operation, "output", babl_format (coloured ? "RGBA float" : formats[o->result]));
}

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.ink             = o->ink;
  s.ink_threshold   = (float) o->ink_threshold;
  s.bulge           = (float) o->bulge;
  s.bevel           = (float) o->bevel;
  s.quilt           = (float) o->quilt;
  s.frame_outline   = o->frame_outline;
  s.light_model     = o->light_model;
  s.light           = o->light;
  s.light_azimuth   = (float) o->light_azimuth;
  s.light_elevation = (float) o->light_elevation;
  s.light_x         = (float) o->light_x;
  s.light_y         = (float) o->light_y;
  s.light_height    = (float) o->light_height;
  s.ambient         = (float) o->ambient;
  s.toon_steps      = o->toon_steps;
  s.specular        = (float) o->specular;
  s.shininess       = (float) o->shininess;
  s.rim_light       = (float) o->rim_light;
  s.rim_power       = (float) o->rim_power;
  s.shadow_size     = (float) o->shadow_size;
  s.shadow_strength = (float) o->shadow_strength;
  return s;
}

/* The light on art, or on white. */
static gboolean
write_lit (CeldOp *op, const CeldColours *tone, const CeldPlane *gloss)
{
  gboolean    art = GEGL_PROPERTIES (op->operation)->result == CELD_LUMO_ART;
  CeldColours colours;

  if (!(art ? celd_op_read_colours (op, celd_op_has (op, "aux2") ? "aux2" : "aux", &colours)
            : celd_op_new_colours (op, &colours)))
    return FALSE;
  for (gsize i = 0; !art && i < 4 * (gsize) colours.width * (gsize) colours.height; i++)
    colours.data[i] = 1;
  return celd_op_try (op, celd_light_colours (tone, gloss, &colours)) &&
         celd_op_write (op, colours.data);
}

static gboolean
write_light (CeldOp *op, const CeldSettings *s, const CeldPlane *ink, const CeldVectors *normals)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  gboolean        by_matcap = o->light_model == CELD_MODEL_MATCAP;
  CeldColours     tone, layer, matcap = { 0 };
  CeldPlane       gloss;

  if (by_matcap && !celd_op_has (op, "aux5"))
    return celd_op_fail (op, "There is no picture for 'Matcap' (pad aux5). Choose the picture of a lit ball, or "
                             "another shading.");
  if ((by_matcap && !celd_op_read_sample (op, "aux5", &matcap)) || !celd_op_new_colours (op, &tone) ||
      !celd_op_new_plane (op, &gloss) ||
      !celd_op_try (op, celd_light (normals, ink, by_matcap ? &matcap : NULL, s, &op->quiet, &tone, &gloss)))
    return FALSE;
  if (o->result == CELD_LUMO_TONE)
    return celd_op_write (op, tone.data);
  if (o->result == CELD_LUMO_RIM)
    return celd_op_new_colours (op, &layer) &&
           celd_op_try (op, celd_light_layer (&gloss, &layer)) &&
           celd_op_write (op, layer.data);
  return write_lit (op, &tone, &gloss);
}

static gboolean
write_result (CeldOp *op, const CeldSettings *s, const CeldPlane *ink, const CeldVectors *normals)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldPlane       shading;

  if (o->result == CELD_LUMO_NORMALS)
    return celd_op_write_normals (op, normals, o->directx);
  if (o->result != CELD_LUMO_SHADING || o->light_model == CELD_MODEL_MATCAP)
    return write_light (op, s, ink, normals);
  return celd_op_new_plane (op, &shading) &&
         celd_op_try (op, celd_shade (normals, s, &shading)) &&
         celd_op_write (op, shading.data);
}

static gboolean
write_occlusion (CeldOp *op, const CeldSettings *s, const CeldPlane *levels)
{
  CeldPlane occlusion;

  return celd_op_new_plane (op, &occlusion) &&
         celd_op_try (op, celd_occlusion (levels, s, &op->host, &occlusion)) &&
         celd_op_write (op, occlusion.data);
}

static gboolean
render (CeldOp *op)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldSettings    s = settings (o);
  CeldPlane       ink, levels, depth = { 0 };
  CeldPaint       hints = { 0 };
  CeldVectors     normals;
  gboolean        deep = celd_op_has (op, "aux3"), hinted = celd_op_has (op, "aux4");

  if (!celd_op_read_plane (op, "input", &levels))
    return FALSE;
  if (o->result == CELD_LUMO_OCCLUSION)
    return write_occlusion (op, &s, &levels);
  return celd_op_read_ink (op, "aux", o->ink, &ink) &&
         (!deep || celd_op_read_plane (op, "aux3", &depth)) &&
         (!hinted || celd_op_read_paint (op, "aux4", &hints)) &&
         celd_op_new_vectors (op, &normals) &&
         celd_op_try (op, celd_normals_hinted (&ink, &levels, deep ? &depth : NULL, hinted ? &hints : NULL, &s,
                                               &op->host, &normals)) &&
         write_result (op, &s, &ink, &normals);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare   = prepare;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:lumo-shade",
    "title",           "Lumo Shade",
    "categories",      "artistic:light",
    "description",     "Shades a drawing as if its parts were round: the parts in front bend at their contours, "
                       "those behind do not",
    "reference",       CELD_REFERENCE " S. F. Johnston: Lumo: Illumination for Cel Animation. NPAR 2002.",
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Lumo Shade...",
    NULL);
}

#endif
