/* celdepth:stereo: a picture with depth as two eyes see it (section 5 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "properties.h"

#ifdef GEGL_PROPERTIES

CELD_PROPERTY_DISPARITY

CELD_PROPERTY_EXPANSION

CELD_PROPERTY_INK

#else

#define GEGL_OP_NAME     celdepth_stereo
#define GEGL_OP_C_SOURCE celdepth-stereo.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

static const CeldPad pads[] = {
  { "input", "Art", "The picture that is to be seen", TRUE },
  { "aux", "Depth", "Smooth depth, near is bright", TRUE },
  { "aux2", "Levels", "Depth levels: the picture is cut into completed layers by them; without, what comes into sight "
                      "is filled from what is farther", FALSE },
  { "aux3", "Drawing", "The line drawing, where the art is coloured: it tells ink from paint", FALSE },
  { NULL, NULL, NULL, FALSE }
};

static void
prepare (GeglOperation *operation)
{
  gegl_operation_set_format (operation, "output", babl_format ("RGBA float"));
}

/* ------------------------------------------------------------------ the size of both views */

static GeglRectangle
joined_size (GeglOperation *operation, GeglRectangle input)
{
  if (!gegl_rectangle_is_infinite_plane (&input))
    celd_stereo_size (GEGL_PROPERTIES (operation)->stereo, &input.width, &input.height);
  return input;
}

static GeglRectangle
get_bounding_box (GeglOperation *operation)
{
  const GeglRectangle *input = gegl_operation_source_get_bounding_box (operation, "input");

  return joined_size (operation, input ? *input : (GeglRectangle) { 0, 0, 0, 0 });
}

/* All of it, whatever the host asks for; of an endless picture no more than that. */
static GeglRectangle
get_cached_region (GeglOperation *operation, const GeglRectangle *roi)
{
  GeglRectangle whole = get_bounding_box (operation);

  return gegl_rectangle_is_infinite_plane (&whole) ? *roi : whole;
}

static GeglRectangle
get_invalidated_by_change (GeglOperation *operation, const gchar *pad, const GeglRectangle *changed)
{
  return get_cached_region (operation, changed);
}

/* ------------------------------------------------------------------ views */

static CeldSettings
settings (GeglProperties *o)
{
  CeldSettings s = celd_settings ();

  s.stereo          = o->stereo;
  s.disparity       = (float) o->disparity;
  s.convergence     = (float) o->convergence;
  s.floating_window = o->floating_window;
  s.screen_width    = (float) o->screen_width;
  return s;
}

static gboolean
make_scene (CeldOp *op, const CeldSettings *s, const CeldColours *art, const CeldPlane *depth, CeldScene **scene)
{
  GeglProperties *o = GEGL_PROPERTIES (op->operation);
  CeldPlane       ink, levels;

  if (!celd_op_read_ink (op, celd_op_has (op, "aux3") ? "aux3" : "input", o->ink, &ink))
    return FALSE;
  if (!celd_op_has (op, "aux2"))
    return celd_op_try (op, celd_scene_of_depth (art, &ink, depth, s, &op->host, scene));
  return celd_op_read_plane (op, "aux2", &levels) &&
         celd_op_try (op, celd_scene_of_levels (&ink, &levels, depth, art, o->expansion, &op->host, scene));
}

static gboolean
make_views (CeldOp *op, const CeldSettings *s, CeldPlane *depth, CeldColours view[2])
{
  CeldColours art;
  CeldScene  *scene = NULL;
  gboolean    good = celd_op_read_colours (op, "input", &art) && celd_op_read_plane (op, "aux", depth) &&
                     make_scene (op, s, &art, depth, &scene);

  for (int i = 0; i < 2; i++)
    good = good && celd_op_new_colours (op, &view[i]) &&
           celd_op_try (op, celd_scene_view (scene, celd_camera_eye (2 * i - 1), s, &op->quiet, &view[i]));
  celd_scene_free (scene);
  return good && (!s->floating_window || celd_op_try (op, celd_stereo_window (depth, s, &view[0], &view[1])));
}

static gboolean
write_joined (CeldOp *op, const CeldSettings *s, const CeldColours view[2])
{
  GeglRectangle whole = joined_size (GEGL_OPERATION (op->operation), op->picture);
  gsize         n = (gsize) whole.width * (gsize) whole.height;
  CeldColours   joined = { whole.width, whole.height, (gsize) whole.width, celd_op_alloc (op, 4 * n * sizeof (float)) };
  GeglBuffer   *output;

  if (!joined.data || !celd_op_try (op, celd_stereo_join (&view[0], &view[1], s->stereo, &joined)))
    return FALSE;
  output = gegl_operation_context_get_target (op->context, "output");
  gegl_buffer_set (output, &whole, 0, babl_format ("RGBA float"), joined.data, GEGL_AUTO_ROWSTRIDE);
  return TRUE;
}

static gboolean
tell_comfort (CeldOp *op, const CeldSettings *s, const CeldPlane *depth)
{
  CeldComfort comfort;
  char        text[800];

  if (!celd_op_try (op, celd_stereo_comfort (depth, s, &comfort)))
    return FALSE;
  celd_comfort_text (&comfort, s, text, sizeof text);
  return !text[0] || celd_op_remark (op, text);
}

static gboolean
render (CeldOp *op)
{
  CeldSettings s = settings (GEGL_PROPERTIES (op->operation));
  CeldPlane    depth;
  CeldColours  view[2];

  return make_views (op, &s, &depth, view) &&
         write_joined (op, &s, view) &&
         tell_comfort (op, &s, &depth);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  klass->parent_class.pads   = pads;
  klass->parent_class.render = render;
  operation_class->prepare                   = prepare;
  operation_class->get_bounding_box          = get_bounding_box;
  operation_class->get_cached_region         = get_cached_region;
  operation_class->get_invalidated_by_change = get_invalidated_by_change;

  gegl_operation_class_set_keys (operation_class,
    "name",            "celdepth:stereo",
    "title",           "Stereo",
    "categories",      "artistic",
    "description",     "Shows a picture with depth to two eyes, each from its own side",
    "reference",       CELD_REFERENCE " E. Dubois: A Projection Method to Generate Anaglyph Stereo Images. "
                       "ICASSP 2001.",
    "gimp:menu-path",  CELD_MENU,
    "gimp:menu-label", "Stereo...",
    NULL);
}

#endif
