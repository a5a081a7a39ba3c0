/* The views of both eyes, of completed layers that move by their depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-parts.h"

#include "buffers.h"
#include "problems.h"

/* Where the parts of the work begin, as fractions of its time; chosen */
#define BEGIN_LAYERS 0.5
#define BEGIN_SCENE  0.75
#define BEGIN_VIEWS  0.85

/* Layers are completed, since others leave holes in views; what is made later goes by the settings again. */
CeldStatus
celd_pipeline_complete_layers (CeldPipeline *p, bool complete)
{
  CeldSettings settings = p->settings;

  settings.complete = complete || settings.complete;
  return celd_session_set_settings (p->session, &settings);
}

static CeldStatus
make_scene (CeldPipeline *p, const CeldHost *host, CeldScene **scene)
{
  CeldOwnership own;
  CeldPlane     depth;
  CeldStatus    status = celd_session_ownership (p->session, NULL, &own, NULL);

  if (status == CELD_OK)
    status = celd_session_depth (p->session, NULL, &depth, NULL);
  return status == CELD_OK ? celd_scene_of_layers (p->layers, &own, &depth, host, scene) : status;
}

static CeldStatus
draw_views (CeldPipeline *p, const CeldScene *scene, CeldPipelineReport *r)
{
  CeldHost   host = { celd_pipeline_report, celd_gegl_each, r };
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      r->name = i ? N_ ("Drawing the right view") : N_ ("Drawing the left view");
      r->part = (1 - BEGIN_VIEWS) / 2;
      r->from = BEGIN_VIEWS + i * r->part;
      g_free (p->view[i].data);
      p->view[i] = celd_pipeline_new_colours (p);
      status = p->view[i].data ? celd_scene_view (scene, celd_camera_eye (2 * i - 1), &p->settings, &host, &p->view[i])
                               : CELD_NO_MEMORY;
    }
  return status;
}

/* The floating window, and a note on what strains the eyes. */
static CeldStatus
finish_views (CeldPipeline *p)
{
  CeldPlane   depth;
  CeldComfort comfort;
  char        text[1200];
  CeldStatus  status = celd_session_depth (p->session, NULL, &depth, NULL);

  if (status == CELD_OK && p->settings.floating_window)
    status = celd_stereo_window (&depth, &p->settings, &p->view[0], &p->view[1]);
  if (status == CELD_OK)
    status = celd_stereo_comfort (&depth, &p->settings, &comfort);
  if (status != CELD_OK)
    return status;
  celd_comfort_text (&comfort, &p->settings, celd_in_language, text, sizeof text);
  g_free (p->note);
  p->note = text[0] ? g_strdup (text) : NULL;
  return CELD_OK;
}

static CeldStatus
make_views (CeldPipeline *p, CeldPipelineReport *r)
{
  CeldHost   host = { celd_pipeline_report, celd_gegl_each, r };
  CeldScene *scene = NULL;
  CeldStatus status = make_scene (p, &host, &scene);

  if (status == CELD_OK)
    status = draw_views (p, scene, r);
  if (status == CELD_OK)
    status = finish_views (p);
  celd_scene_free (scene);
  return status;
}

gboolean
celd_pipeline_view (CeldPipeline *p, CeldPipelineProgress progress, gpointer data, GError **error)
{
  CeldPipelineReport before = { progress, data, NULL, 0, BEGIN_LAYERS };
  CeldPipelineReport layers = { progress, data, NULL, BEGIN_LAYERS, BEGIN_SCENE - BEGIN_LAYERS };
  CeldPipelineReport r = { progress, data, N_ ("Placing the layers"), BEGIN_SCENE, BEGIN_VIEWS - BEGIN_SCENE };

  return celd_pipeline_try (celd_pipeline_complete_layers (p, true), error) &&
         celd_pipeline_make (p, OF (DEPTH), celd_pipeline_report_steps, &before, error) &&
         celd_pipeline_cut (p, 32, celd_pipeline_report_steps, &layers, error) &&
         celd_pipeline_try (celd_pipeline_complete_layers (p, false), error) &&
         celd_pipeline_try (make_views (p, &r), error);
}

gboolean
celd_pipeline_write_views (CeldPipeline *p, CeldStereo arrangement, GeglBuffer *buffer, GError **error)
{
  int         width = p->width, height = p->height;
  CeldColours joined;
  CeldStatus  status;

  celd_stereo_size (arrangement, &width, &height);
  joined = (CeldColours) { width, height, (size_t) width,
                           g_try_malloc_n ((gsize) width * (gsize) height, 4 * sizeof (float)) };
  status = !p->view[1].data ? CELD_BAD_VALUE : !joined.data ? CELD_NO_MEMORY
                            : celd_stereo_join (&p->view[0], &p->view[1], arrangement, &joined);
  if (status == CELD_OK)
    gegl_buffer_set (buffer, GEGL_RECTANGLE (0, 0, width, height), 0, babl_format ("RGBA float"), joined.data,
                     GEGL_AUTO_ROWSTRIDE);
  g_free (joined.data);
  return celd_pipeline_try (status, error);
}
