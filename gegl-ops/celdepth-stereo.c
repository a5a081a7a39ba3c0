/* celdepth:stereo: a picture with depth as seen by two eyes (section 5 of the paper).
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "problems.h"
#include "properties.h"

static const CeldProperty properties[] = {
  { .name = "stereo" }, { .name = "disparity" }, { .name = "convergence" }, { .name = "floating-window" },
  { .name = "screen-width" }, { .name = "expansion" }, { .name = "margin" }, { .name = "ink" },
  { 0 }
};

static const CeldPad pads[] = {
  { "input", "Art", "The picture to show", TRUE },
  { "aux", "Depth", "Smooth depth, where nearer is brighter", TRUE },
  { "aux2", "Levels", "Depth levels, by which the picture is cut into completed layers. Without them the parts that "
                      "come into view are filled from what is behind", FALSE },
  { "aux3", "Drawing", "The line drawing, to distinguish ink from paint in coloured art", FALSE },
  { NULL, NULL, NULL, FALSE }
};

/* ------------------------------------------------------------------ the size of both views */

static GeglRectangle
joined_size (GeglOperation *operation, GeglRectangle input)
{
  if (!gegl_rectangle_is_infinite_plane (&input))
    celd_stereo_size (celd_operation_settings (operation)->stereo, &input.width, &input.height);
  return input;
}

static GeglRectangle
get_bounding_box (GeglOperation *operation)
{
  return joined_size (operation, celd_operation_input (operation));
}

/* The whole output, whatever part of it the host asks for; of an infinite picture that part. */
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

static void
adjust (GeglOperationClass *klass)
{
  klass->get_bounding_box          = get_bounding_box;
  klass->get_cached_region         = get_cached_region;
  klass->get_invalidated_by_change = get_invalidated_by_change;
}

/* ------------------------------------------------------------------ views */

static gboolean
make_scene (CeldOp *op, const CeldColours *art, const CeldPlane *depth, CeldScene **scene)
{
  CeldPlane ink, levels;

  if (!(celd_op_has_input (op, "aux3") ? celd_op_read_ink (op, "aux3", &ink)
                                       : celd_op_read_ink_of_art (op, "input", &ink)))
    return FALSE;
  if (!celd_op_has_input (op, "aux2"))
    return celd_op_try (op, celd_scene_of_depth (art, &ink, depth, &op->settings, &op->host, scene));
  return celd_op_read_plane (op, "aux2", &levels) &&
         celd_op_try (op, celd_scene_of_levels (&ink, &levels, depth, art, &op->settings, &op->host,
                                                scene));
}

static gboolean
make_views (CeldOp *op, CeldPlane *depth, CeldColours view[2])
{
  const CeldSettings *s = &op->settings;
  CeldColours         art;
  CeldScene          *scene = NULL;
  gboolean            good = celd_op_read_colours (op, "input", &art) && celd_op_read_plane (op, "aux", depth) &&
                             make_scene (op, &art, depth, &scene);

  for (int i = 0; i < 2; i++)
    good = good && celd_op_new_colours (op, &view[i]) &&
           celd_op_try (op, celd_scene_view (scene, celd_camera_eye (2 * i - 1), s, &op->quiet, &view[i]));
  celd_scene_free (scene);
  return good && (!s->floating_window || celd_op_try (op, celd_stereo_window (depth, s, &view[0], &view[1])));
}

static gboolean
write_joined (CeldOp *op, const CeldColours view[2])
{
  GeglRectangle whole = joined_size (GEGL_OPERATION (op->operation), op->picture);
  gsize         n = (gsize) whole.width * (gsize) whole.height;
  CeldColours   joined = { whole.width, whole.height, (gsize) whole.width, celd_op_alloc (op, 4 * n * sizeof (float)) };
  GeglBuffer   *output;

  if (!joined.data || !celd_op_try (op, celd_stereo_join (&view[0], &view[1], op->settings.stereo, &joined)))
    return FALSE;
  output = gegl_operation_context_get_target (op->context, "output");
  gegl_buffer_set (output, &whole, 0, babl_format ("RGBA float"), joined.data, GEGL_AUTO_ROWSTRIDE);
  return TRUE;
}

static gboolean
report_comfort (CeldOp *op, const CeldPlane *depth)
{
  const CeldSettings *s = &op->settings;
  CeldComfort         comfort;
  char                text[800];

  if (!celd_op_try (op, celd_stereo_comfort (depth, s, &comfort)))
    return FALSE;
  celd_comfort_text (&comfort, s, celd_in_language, text, sizeof text);
  return !text[0] || celd_op_report_text (op, text);
}

static gboolean
render (CeldOp *op)
{
  CeldPlane   depth;
  CeldColours view[2];

  return make_views (op, &depth, view) &&
         write_joined (op, view) &&
         report_comfort (op, &depth);
}

const CeldOperationInfo celd_stereo_operation = {
  .name        = "celdepth:stereo",
  .title       = "Stereo",
  .categories  = "artistic",
  .description = "Turns a picture with depth into a stereo picture, with a view for each eye",
  .reference   = CELD_REFERENCE " E. Dubois: A Projection Method to Generate Anaglyph Stereo Images. "
                 "ICASSP 2001.",
  .pads        = pads,
  .properties  = properties,
  .format      = "RGBA float",
  .adjust      = adjust,
  .render      = render,
};
