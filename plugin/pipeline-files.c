/* Depth and models in files.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-parts.h"

#include "buffers.h"
#include "celdepth-io.h"
#include "part-names.h"

static gboolean
fail_to_write (const char *path, const CeldIoError *why, GError **error)
{
  return celd_pipeline_fail (error, _ ("Cannot write \"%s\": %s"), path, _ (why->text + why->reason));
}

/* ------------------------------------------------------------------ depth */

static gboolean
save_depth (const CeldPlane *depth, const char *path, GError **error)
{
  CeldIoError why;

  return celd_io_write_depth (path, depth, 0, 1, &why) || fail_to_write (path, &why, error);
}

gboolean
celd_pipeline_save (CeldPipeline *p, CeldPicture picture, const char *path, GError **error)
{
  CeldPlane plane;

  return celd_pipeline_try (celd_pipeline_ask_depth (p, picture, &plane), error) && save_depth (&plane, path, error);
}

/* Says so if most of the layer is something else than the picture, as when the settings were others. */
static gboolean
refine (CeldPipeline *p, CeldPicture picture, const CeldPipelineLayer *layer, CeldPlane *plane, GError **error)
{
  const GeglRectangle *extent = gegl_buffer_get_extent (layer->buffer);
  gsize                refined = 0, all = (gsize) extent->width * (gsize) extent->height;

  if (!celd_pipeline_try (celd_pipeline_refine (p, picture, layer, plane, &refined), error))
    return FALSE;
  g_free (p->note);
  p->note = 2 * refined < all
              ? g_strdup (_ ("Most of the layer is not what the drawing and its layers make now. It was exported as it "
                             "is, with at most 256 steps. For more let it be made anew from the drawing."))
              : NULL;
  return TRUE;
}

gboolean
celd_pipeline_save_layer (CeldPipeline *p, CeldPicture picture, const CeldPipelineLayer *layer, int width, int height,
                          const char *path, GError **error)
{
  CeldPlane     plane = { width, height, (size_t) width,
                          g_try_malloc_n ((gsize) width * (gsize) height, sizeof (float)) };
  GeglRectangle image = celd_pipeline_rectangle (layer, width, height);
  gboolean      good = celd_pipeline_try (plane.data ? CELD_OK : CELD_NO_MEMORY, error);

  good = good && celd_pipeline_check_grey (layer, error);
  if (good)
    {
      gegl_buffer_get (layer->buffer, &image, 1, babl_format ("Y float"), plane.data, GEGL_AUTO_ROWSTRIDE,
                       GEGL_ABYSS_NONE);
      good = (!p || refine (p, picture, layer, &plane, error)) && save_depth (&plane, path, error);
    }
  g_free (plane.data);
  return good;
}

/* ------------------------------------------------------------------ models */

#define BEGIN_MESH 0.6 /* of the time of all; chosen */

/* The art as files have it: encoded. */
static gboolean
encode_art (CeldPipeline *p, CeldColours *art, GError **error)
{
  if (!celd_pipeline_try (celd_pipeline_copy_art (p, art), error))
    return FALSE;
  babl_process (babl_fish (babl_format ("RGBA float"), babl_format ("R'G'B'A float")), art->data, art->data,
                (glong) p->width * p->height);
  return TRUE;
}

/* CELD_BAD_VALUE with valid settings: the outlines alone have too many vertices. */
static gboolean
check_mesh (CeldPipeline *p, CeldStatus status, double deviation, GError **error)
{
  if (status == CELD_BAD_VALUE)
    return celd_pipeline_fail (error, _ ("The outlines alone have more than %.0f vertices. Allow more vertices."),
                               (double) p->settings.most_vertices);
  if (!celd_pipeline_try (status, error))
    return FALSE;
  g_free (p->note);
  p->note = deviation > 1.01 * (double) p->settings.mesh_error
              ? g_strdup_printf (_ ("With %.0f vertices at most, the mesh deviates by up to %.1f pixels from the "
                                    "shape. Allow more vertices if that shows."),
                                 (double) p->settings.most_vertices, deviation)
              : NULL;
  return TRUE;
}

static gboolean
save_meshes (const char *path, const CeldIoMesh *mesh, gsize n, const CeldColours *art, GError **error)
{
  CeldIoError why;

  return celd_io_write_meshes (path, mesh, n, art, &why) || fail_to_write (path, &why, error);
}

static gboolean
save_surface (CeldPipeline *p, const char *path, const CeldColours *art, const CeldHost *host, GError **error)
{
  CeldSettings   settings = p->settings;
  CeldRelief     relief = { 0 };
  CeldReliefMesh mesh = { 0 };
  CeldStatus     status = celd_session_relief (p->session, host, &relief);
  gboolean       good;

  settings.mesh_kind = celd_io_mesh_kind (path) == CELD_IO_STL ? CELD_MESH_SOLID : CELD_MESH_SURFACE;
  if (status == CELD_OK)
    status = celd_relief_mesh (&relief, &settings, &(CeldHost) { NULL, host->each, host->data }, &mesh);
  good = check_mesh (p, status, mesh.error, error) &&
         save_meshes (path, &(CeldIoMesh) { "relief", &mesh }, 1, art, error);
  celd_relief_mesh_clear (&mesh);
  celd_relief_clear (&relief);
  return good;
}

static gboolean
write_parts (CeldPipeline *p, const char *path, const CeldModel *model, GError **error)
{
  CeldIoMesh *mesh = g_new (CeldIoMesh, model->n);
  char      **name = g_new0 (char *, model->n + 1);
  gboolean    good;

  for (gsize i = 0; i < model->n; i++)
    {
      name[i] = celd_part_name (celd_session_palette (p->session), model->part[i].label);
      mesh[i] = (CeldIoMesh) { name[i], &model->part[i].mesh };
    }
  good = save_meshes (path, mesh, model->n, &model->atlas, error);
  g_strfreev (name);
  g_free (mesh);
  return good;
}

static gboolean
save_parts (CeldPipeline *p, const char *path, const CeldColours *art, const CeldHost *host, GError **error)
{
  CeldSettings settings = p->settings;
  CeldModel    model = { 0 };
  CeldStatus   status;
  gboolean     good;

  if (settings.mesh_kind == CELD_MESH_AUTO)
    settings.mesh_kind = celd_io_mesh_kind (path) == CELD_IO_STL ? CELD_MESH_SOLID : CELD_MESH_SURFACE;
  status = celd_session_set_settings (p->session, &settings);
  if (status == CELD_OK)
    status = celd_session_model (p->session, art, host, &model);
  good = check_mesh (p, status, model.error, error) && write_parts (p, path, &model, error);
  celd_model_clear (&model);
  return good;
}

gboolean
celd_pipeline_save_model (CeldPipeline *p, const char *path, CeldPipelineProgress progress, gpointer data,
                          GError **error)
{
  CeldPipelineReport before = { progress, data, NULL, 0, BEGIN_MESH };
  CeldPipelineReport r = { progress, data, N_ ("Making the mesh"), BEGIN_MESH, 1 - BEGIN_MESH };
  CeldHost           host = { celd_pipeline_report, celd_gegl_each, &r };
  gboolean           whole = p->settings.mesh_kind == CELD_MESH_HEIGHTFIELD;
  CeldColours        art = { 0 };
  gboolean           good;

  good = celd_pipeline_make (p, whole ? OF (DEPTH) : OF (LEVELS), celd_pipeline_report_steps, &before, error) &&
         encode_art (p, &art, error) &&
         (whole ? save_surface : save_parts) (p, path, &art, &host, error);
  g_free (art.data);
  return good;
}
