/* Writes pictures of a pipeline to buffers, and cuts and writes layers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline-parts.h"

#include "buffers.h"
#include "problems.h"

#include <math.h>

/* ------------------------------------------------------------------ writing pictures */

static void
put (const CeldPipeline *p, GeglBuffer *buffer, const Babl *format, const void *pixels, gsize pixel_size)
{
  gegl_buffer_set (buffer, GEGL_RECTANGLE (0, 0, p->width, p->height), 0, format, pixels, p->width * (int) pixel_size);
}

static CeldStatus
write_plane (CeldPipeline *p, CeldStatus (*ask) (CeldSession *, const CeldHost *, CeldPlane *, CeldRect *),
             GeglBuffer *buffer)
{
  CeldPlane  plane;
  CeldStatus status = ask (p->session, NULL, &plane, NULL);

  if (status == CELD_OK)
    put (p, buffer, babl_format ("Y float"), plane.data, sizeof (float));
  return status;
}

static CeldStatus
write_paint (CeldPipeline *p, CeldStatus (*paint_on) (CeldPipeline *p, CeldPaint *paint), GeglBuffer *buffer)
{
  CeldPaint  paint = celd_pipeline_new_paint (p);
  CeldStatus status = paint.data ? paint_on (p, &paint) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    put (p, buffer, babl_format ("R'G'B'A u8"), paint.data, 4);
  g_free (paint.data);
  return status;
}

static CeldStatus
paint_regions (CeldPipeline *p, CeldPaint *paint)
{
  CeldLabels labels;
  CeldStatus status = celd_session_labels (p->session, NULL, &labels, NULL);

  return status == CELD_OK ? celd_labels_paint (&labels, celd_session_palette (p->session), paint) : status;
}

static CeldStatus
paint_suggestions (CeldPipeline *p, CeldPaint *paint)
{
  return celd_session_paint_suggestions (p->session, NULL, paint);
}

/* In the space of the buffer, so that its pixels are these numbers. */
static CeldStatus
write_normals (CeldPipeline *p, GeglBuffer *buffer)
{
  const Babl *format = gegl_buffer_get_format (buffer);
  gboolean    linear = babl_get_model_flags (babl_format_get_model (format)) & BABL_MODEL_FLAG_LINEAR;
  float      *stored = celd_pipeline_new_picture (p, 3, sizeof (float));
  CeldVectors normals;
  CeldStatus  status = stored ? celd_session_normals (p->session, NULL, &normals, NULL) : CELD_NO_MEMORY;

  if (status == CELD_OK)
    {
      celd_normals_store (&normals, FALSE, stored);
      put (p, buffer, babl_format_with_space (linear ? "RGB float" : "R'G'B' float", format), stored,
           3 * sizeof (float));
    }
  g_free (stored);
  return status;
}

static CeldStatus
write_art (CeldPipeline *p, const CeldColours *art, GeglBuffer *buffer)
{
  if (!art->data)
    return CELD_BAD_VALUE;
  put (p, buffer, babl_format ("RGBA float"), art->data, 4 * sizeof (float));
  return CELD_OK;
}

static CeldStatus
write_picture (CeldPipeline *p, CeldPicture picture, GeglBuffer *buffer)
{
  switch (picture)
    {
    case CELD_PICTURE_REGIONS:     return write_paint (p, paint_regions, buffer);
    case CELD_PICTURE_LEVELS:      return write_plane (p, celd_session_levels, buffer);
    case CELD_PICTURE_DEPTH:       return write_plane (p, celd_session_depth, buffer);
    case CELD_PICTURE_NORMALS:     return write_normals (p, buffer);
    case CELD_PICTURE_SHADING:     return write_plane (p, celd_session_shading, buffer);
    case CELD_PICTURE_LIT:         return write_art (p, &p->lit, buffer);
    case CELD_PICTURE_ENHANCED:    return write_art (p, &p->enhanced, buffer);
    case CELD_PICTURE_SUGGESTIONS: return write_paint (p, paint_suggestions, buffer);
    case CELD_N_PICTURES:          break;
    }
  return CELD_BAD_VALUE;
}

gboolean
celd_pipeline_write (CeldPipeline *p, CeldPicture picture, GeglBuffer *buffer, GError **error)
{
  return celd_pipeline_try (write_picture (p, picture, buffer), error);
}

gboolean
celd_pipeline_write_preview (CeldPipeline *p, CeldPipelineProgress progress, gpointer data, GeglBuffer *buffer,
                             GError **error)
{
  CeldPipelineReport r = { progress, data, N_ ("Previewing depth"), 0, 1 };
  CeldHost           host = { celd_pipeline_report, celd_gegl_each, &r };
  CeldPlane          quarter;
  CeldStatus         status = celd_session_depth_preview (p->session, &host, &quarter, NULL);

  if (status == CELD_OK)
    gegl_buffer_set (buffer, GEGL_RECTANGLE (0, 0, quarter.width, quarter.height), 0, babl_format ("Y float"),
                     quarter.data, (int) (quarter.stride * sizeof (float)));
  return celd_pipeline_try (status, error);
}

/* ------------------------------------------------------------------ precision */

#define SAME 1e-5f /* numbers that differ by conversion alone; 8 bits have steps of 3e-4 at least */

CeldStatus
celd_pipeline_ask_depth (CeldPipeline *p, CeldPicture picture, CeldPlane *numbers)
{
  return picture == CELD_PICTURE_LEVELS ? celd_session_levels (p->session, NULL, numbers, NULL)
                                        : celd_session_depth (p->session, NULL, numbers, NULL);
}

/* The numbers of a picture as a format keeps them. */
static CeldStatus
round_picture (CeldPipeline *p, CeldPicture picture, const Babl *format, CeldPlane *rounded)
{
  GeglRectangle image = { 0, 0, p->width, p->height };
  GeglBuffer   *buffer = gegl_buffer_new (&image, format);
  CeldStatus    status = write_picture (p, picture, buffer);

  gegl_buffer_get (buffer, &image, 1, babl_format ("Y float"), rounded->data, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  g_object_unref (buffer);
  return status;
}

/* In the part of the image that the layer covers. */
static gsize
refine_part (const CeldPlane *exact, const CeldPlane *rounded, const GeglRectangle *part, CeldPlane *numbers)
{
  gsize refined = 0;

  for (int y = part->y; y < part->y + part->height; y++)
    for (int x = part->x; x < part->x + part->width; x++)
      {
        float *number = &numbers->data[(gsize) y * numbers->stride + (gsize) x];

        if (fabsf (*number - rounded->data[(gsize) y * rounded->stride + (gsize) x]) > SAME)
          continue;
        *number = exact->data[(gsize) y * exact->stride + (gsize) x];
        refined++;
      }
  return refined;
}

CeldStatus
celd_pipeline_refine (CeldPipeline *p, CeldPicture picture, const CeldPipelineLayer *layer, CeldPlane *numbers,
                      gsize *refined)
{
  GeglRectangle part = *gegl_buffer_get_extent (layer->buffer);
  CeldPlane     exact, rounded = celd_pipeline_new_plane (p);
  CeldStatus    status = rounded.data ? celd_pipeline_ask_depth (p, picture, &exact) : CELD_NO_MEMORY;

  part.x += layer->x;
  part.y += layer->y;
  gegl_rectangle_intersect (&part, &part, GEGL_RECTANGLE (0, 0, p->width, p->height));
  if (status == CELD_OK)
    status = round_picture (p, picture, gegl_buffer_get_format (layer->buffer), &rounded);
  if (status == CELD_OK)
    *refined = refine_part (&exact, &rounded, &part, numbers);
  g_free (rounded.data);
  return status;
}

/* ------------------------------------------------------------------ layers */

#define BEFORE_CUTTING 0.8 /* of the time of cutting with all before it; chosen */

/* Cutting is limited to colours in [0,1]. */
CeldStatus
celd_pipeline_cut_colours (CeldPipeline *p, CeldColours *colours, CeldStore store, const CeldHost *host,
                           CeldLayers **layers)
{
  for (gsize i = 0; i < 4 * (gsize) p->width * (gsize) p->height; i++)
    colours->data[i] = CLAMP (colours->data[i], 0, 1);
  celd_layers_free (*layers);
  *layers = NULL;
  return celd_session_layers (p->session, colours, store, host, layers);
}

static CeldStatus
cut (CeldPipeline *p, CeldStore store, const CeldHost *host)
{
  CeldColours copy = { 0 };
  CeldStatus  status = celd_pipeline_copy_art (p, &copy);

  if (status == CELD_OK)
    status = celd_pipeline_cut_colours (p, &copy, store, host, &p->layers);
  g_free (copy.data);
  return status;
}

gboolean
celd_pipeline_cut (CeldPipeline *p, int bits, CeldPipelineProgress progress, gpointer data, GError **error)
{
  CeldPipelineReport before = { progress, data, NULL, 0, BEFORE_CUTTING };
  CeldPipelineReport r = { progress, data, N_ ("Cutting the layers"), BEFORE_CUTTING, 1 - BEFORE_CUTTING };
  CeldHost           host = { celd_pipeline_report, celd_gegl_each, &r };
  CeldStore          store = bits <= 8 ? CELD_STORE_8_BIT_SRGB : CELD_STORE_FLOAT;

  return celd_pipeline_make (p, OF (LEVELS), celd_pipeline_report_steps, &before, error) &&
         celd_pipeline_try (cut (p, store, &host), error);
}

gsize
celd_pipeline_n_layers (const CeldPipeline *p)
{
  return p->layers ? celd_layers_count (p->layers) : 0;
}

GeglRectangle
celd_pipeline_layer_box (const CeldPipeline *p, gsize layer)
{
  const CeldRect *box = &celd_layers_item (p->layers, layer)->box;

  return (GeglRectangle) { box->x, box->y, box->width, box->height };
}

char *
celd_pipeline_layer_name (const CeldPipeline *p, gsize layer)
{
  char name[40];

  celd_label_name (celd_session_palette (p->session), celd_layers_item (p->layers, layer)->label, name, sizeof name);
  return g_strdup (_ (name)); /* a colour has no translation */
}

gboolean
celd_pipeline_write_layer (CeldPipeline *p, gsize layer, GeglBuffer *buffer, GError **error)
{
  GeglRectangle box = celd_pipeline_layer_box (p, layer);
  float        *rgba = g_try_malloc_n ((gsize) box.width * (gsize) box.height, 4 * sizeof (float));

  if (!celd_pipeline_try (rgba ? CELD_OK : CELD_NO_MEMORY, error))
    return FALSE;
  celd_layers_paint (p->layers, layer, rgba);
  gegl_buffer_set (buffer, GEGL_RECTANGLE (0, 0, box.width, box.height), 0, babl_format ("RGBA float"), rgba,
                   GEGL_AUTO_ROWSTRIDE);
  g_free (rgba);
  return TRUE;
}

/* ------------------------------------------------------------------ problems */

char *
celd_pipeline_problems (CeldPipeline *p)
{
  GString *message = g_string_new (NULL);

  celd_problems_append (message, celd_session_problems (p->session), celd_session_palette (p->session),
                        celd_session_relations (p->session), p->order);
  if (p->unsure)
    g_string_append_printf (message, "%s%s", message->len ? "\n" : "", celd_unsure_lines_text ());
  if (p->note)
    g_string_append_printf (message, "%s%s", message->len ? "\n" : "", p->note);
  return g_string_free (message, message->len == 0);
}

static void
clear_problem (gpointer problem)
{
  g_free (((CeldPipelineProblem *) problem)->text);
}

GArray *
celd_pipeline_problem_list (CeldPipeline *p)
{
  GArray              *list = g_array_new (FALSE, FALSE, sizeof (CeldPipelineProblem));
  const CeldProblems  *problems = celd_session_problems (p->session);
  const CeldRelations *relations = celd_session_relations (p->session);

  g_array_set_clear_func (list, clear_problem);
  for (size_t i = 0; problems && i < problems->n; i++)
    {
      const CeldProblem  *problem = &problems->item[i];
      CeldPipelineProblem told = { NULL, problem->x, problem->y };

      told.text = celd_problem_line (problem, celd_session_palette (p->session), relations, p->order);
      g_array_append_val (list, told);
    }
  if (p->unsure)
    g_array_append_val (list, ((CeldPipelineProblem) { g_strdup (celd_unsure_lines_text ()), -1, -1 }));
  if (p->note)
    g_array_append_val (list, ((CeldPipelineProblem) { g_strdup (p->note), -1, -1 }));
  return list;
}
