/* The relief that turns to and fro: the scene of stereo views on the turntable of core.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-parts.h"

#include "buffers.h"

/* Where the parts of the work begin, as fractions of its time; chosen */
#define BEGIN_LAYERS 0.5
#define BEGIN_RELIEF 0.7
#define BEGIN_SCENE  0.9

void
celd_pipeline_drop_relief (CeldPipeline *p)
{
  celd_scene_free (p->relief);
  celd_layers_free (p->relief_layers);
  g_clear_pointer (&p->relief_depth.data, g_free);
  p->relief        = NULL;
  p->relief_layers = NULL;
}

static CeldStatus
cut_layers (CeldPipeline *p, CeldPipelineReport *r)
{
  CeldHost host = { celd_pipeline_report, celd_gegl_each, r };

  return celd_pipeline_cut_colours (p, &p->lit, CELD_STORE_FLOAT, &host, &p->relief_layers);
}

static CeldStatus
raise_parts (CeldPipeline *p, CeldPipelineReport *r)
{
  CeldHost   host = { celd_pipeline_report, celd_gegl_each, r };
  CeldRelief relief = { 0 };
  CeldStatus status = celd_session_relief (p->session, &host, &relief);

  p->relief_depth = celd_pipeline_new_plane (p);
  if (status == CELD_OK)
    status = p->relief_depth.data ? celd_turntable_depth (&relief, &p->relief_depth, &p->relief_height)
                                  : CELD_NO_MEMORY;
  celd_relief_clear (&relief);
  return status;
}

static CeldStatus
make_scene (CeldPipeline *p, CeldPipelineReport *r)
{
  CeldHost      host = { celd_pipeline_report, celd_gegl_each, r };
  CeldOwnership own;
  CeldStatus    status = celd_session_ownership (p->session, NULL, &own, NULL);

  return status == CELD_OK ? celd_scene_of_layers (p->relief_layers, &own, &p->relief_depth, &host, &p->relief)
                           : status;
}

gboolean
celd_pipeline_make_relief (CeldPipeline *p, CeldPipelineProgress progress, gpointer data, GError **error)
{
  CeldPipelineReport before = { progress, data, NULL, 0, BEGIN_LAYERS };
  CeldPipelineReport layers = { progress, data, N_ ("Cutting the layers"), BEGIN_LAYERS,
                                BEGIN_RELIEF - BEGIN_LAYERS };
  CeldPipelineReport relief = { progress, data, N_ ("Raising the parts"), BEGIN_RELIEF, BEGIN_SCENE - BEGIN_RELIEF };
  CeldPipelineReport scene = { progress, data, N_ ("Placing the layers"), BEGIN_SCENE, 1 - BEGIN_SCENE };

  celd_pipeline_drop_relief (p);
  return celd_pipeline_try (celd_pipeline_complete_layers (p, true), error) &&
         celd_pipeline_make (p, OF (DEPTH) | OF (LIT), celd_pipeline_report_steps, &before, error) &&
         celd_pipeline_try (cut_layers (p, &layers), error) &&
         celd_pipeline_try (celd_pipeline_complete_layers (p, false), error) &&
         celd_pipeline_try (raise_parts (p, &relief), error) &&
         celd_pipeline_try (make_scene (p, &scene), error);
}

/* ------------------------------------------------------------------ views */

/* As large as the image. */
static CeldStatus
draw_view (const CeldPipeline *p, CeldCamera camera, CeldPipelineReport *r, CeldColours *view)
{
  CeldHost     host = { celd_pipeline_report, celd_gegl_each, r };
  CeldSettings settings = p->settings;

  celd_turntable_settings (p->relief_height, p->width, &settings);
  return celd_scene_view (p->relief, camera, &settings, &host, view);
}

static void
put_scaled (CeldColours *view, GeglBuffer *buffer)
{
  const GeglRectangle *to = gegl_buffer_get_extent (buffer);
  const Babl          *format = gegl_buffer_get_format (buffer);
  GeglBuffer          *from = gegl_buffer_linear_new_from_data (view->data, babl_format ("RGBA float"),
                                                                GEGL_RECTANGLE (0, 0, view->width, view->height),
                                                                GEGL_AUTO_ROWSTRIDE, NULL, NULL);
  gpointer             pixels = g_malloc_n ((gsize) to->width * (gsize) to->height,
                                            (gsize) babl_format_get_bytes_per_pixel (format));

  gegl_buffer_get (from, GEGL_RECTANGLE (0, 0, to->width, to->height), (double) to->width / view->width, format,
                   pixels, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_CLAMP);
  gegl_buffer_set (buffer, to, 0, format, pixels, GEGL_AUTO_ROWSTRIDE);
  g_free (pixels);
  g_object_unref (from);
}

gboolean
celd_pipeline_write_turned (CeldPipeline *p, int frame, int frames, CeldPipelineProgress progress, gpointer data,
                            GeglBuffer *buffer, GError **error)
{
  CeldPipelineReport r = { progress, data, N_ ("Turning the relief"), 0, 1 };
  CeldCamera         camera = celd_turntable_sweep (frame, frames);
  CeldColours        view = celd_pipeline_new_colours (p);
  CeldStatus         status = !p->relief ? CELD_BAD_VALUE : !view.data ? CELD_NO_MEMORY
                                         : draw_view (p, camera, &r, &view);

  if (status == CELD_OK)
    put_scaled (&view, buffer);
  g_free (view.data);
  return celd_pipeline_try (status, error);
}
