/* Pictures of core from GeglBuffers, with conversions of pixel formats; and GEGL's threads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "buffers.h"

#include <math.h>

/* ------------------------------------------------------------------ reading */

gboolean
celd_buffer_has_alpha (GeglBuffer *buffer)
{
  return babl_format_has_alpha (gegl_buffer_get_format (buffer));
}

static void
get (GeglBuffer *buffer, const GeglRectangle *rect, const char *format, GeglAbyssPolicy outside, void *pixels)
{
  gegl_buffer_get (buffer, rect, 1.0, babl_format (format), pixels, GEGL_AUTO_ROWSTRIDE, outside);
}

static GeglAbyssPolicy
paper (GeglBuffer *buffer)
{
  return celd_buffer_has_alpha (buffer) ? GEGL_ABYSS_NONE : GEGL_ABYSS_WHITE;
}

void
celd_buffer_read_plane (GeglBuffer *buffer, const GeglRectangle *rect, CeldPlane *plane)
{
  get (buffer, rect, "Y float", GEGL_ABYSS_NONE, plane->data);
}

void
celd_buffer_read_paint (GeglBuffer *buffer, const GeglRectangle *rect, CeldPaint *paint)
{
  get (buffer, rect, "R'G'B'A u8", paper (buffer), paint->data);
}

void
celd_buffer_read_colours (GeglBuffer *buffer, const GeglRectangle *rect, CeldColours *colours)
{
  get (buffer, rect, "RGBA float", paper (buffer), colours->data);
}

/* ------------------------------------------------------------------ drawings */

/* Replaces the drawing by its lines if it is a coloured one. */
static CeldStatus
take_coloured_lines (GeglBuffer *buffer, const GeglRectangle *rect, CeldInkMode ink, const CeldHost *host,
                     CeldDrawing *drawing)
{
  gsize      n = (gsize) rect->width * (gsize) rect->height;
  CeldPaint  art = { rect->width, rect->height, (size_t) rect->width, g_try_malloc (4 * n) };
  CeldStatus status = CELD_NO_MEMORY;

  if (art.data)
    {
      celd_buffer_read_paint (buffer, rect, &art);
      status = celd_coloured_lines (&art, ink, host, drawing);
    }
  g_free (art.data);
  return status;
}

CeldStatus
celd_buffer_read_drawing (GeglBuffer *buffer, const GeglRectangle *rect, CeldInkMode ink, const CeldHost *host,
                          CeldDrawing *drawing)
{
  GeglRectangle row = { rect->x, rect->y, rect->width, 1 };
  gsize         start = 0, w = (gsize) row.width;
  float        *rgba = g_try_new (float, 4 * w), *alpha = drawing->alpha.data;

  if (!rgba)
    return CELD_NO_MEMORY;
  for (int y = 0; y < rect->height; y++, row.y++, start += w)
    {
      get (buffer, &row, "R'G'B'A float", paper (buffer), rgba);
      celd_luma (rgba, w, drawing->luma.data + start, alpha ? alpha + start : NULL);
    }
  g_free (rgba);
  return take_coloured_lines (buffer, rect, ink, host, drawing);
}

gboolean
celd_buffer_is_coloured (GeglBuffer *buffer)
{
  const GeglRectangle *extent = gegl_buffer_get_extent (buffer);
  CeldPaint            paint = { extent->width, extent->height, (size_t) extent->width, NULL };
  gboolean             coloured = FALSE;

  if (babl_format_get_n_components (gegl_buffer_get_format (buffer)) <= 2) /* grey, and alpha */
    return FALSE;
  paint.data = g_try_new (guint8, 4 * paint.stride * (gsize) paint.height);
  if (paint.data)
    {
      get (buffer, extent, "R'G'B'A u8", GEGL_ABYSS_NONE, paint.data);
      coloured = celd_paint_is_coloured (&paint);
    }
  g_free (paint.data);
  return coloured;
}

static gboolean
is_float (const Babl *format)
{
  const Babl *type = babl_format_get_type (format, 0);

  return type == babl_type ("float") || type == babl_type ("half") || type == babl_type ("double");
}

gboolean
celd_buffer_has_numbers (GeglBuffer *buffer)
{
  const GeglRectangle *extent = gegl_buffer_get_extent (buffer);
  GeglRectangle        row = { extent->x, extent->y, extent->width, 1 };
  gboolean             finite = TRUE;
  float               *rgba;

  if (!is_float (gegl_buffer_get_format (buffer)))
    return TRUE;
  rgba = g_try_new (float, 4 * (gsize) row.width);
  for (; rgba && finite && row.y < extent->y + extent->height; row.y++)
    {
      get (buffer, &row, "RGBA float", GEGL_ABYSS_NONE, rgba);
      for (const float *p = rgba; p < rgba + 4 * (gsize) row.width; p += 4)
        finite = finite && isfinite (p[3]) && (p[3] <= 0 || (isfinite (p[0]) && isfinite (p[1]) && isfinite (p[2])));
    }
  g_free (rgba);
  return finite;
}

/* ------------------------------------------------------------------ normals */

void
celd_normals_store (const CeldVectors *normals, gboolean directx, float *stored)
{
  float up = directx ? -0.5f : 0.5f;

  for (int y = 0; y < normals->height; y++)
    for (int x = 0; x < normals->width; x++, stored += 3)
      {
        const float *n = normals->data + 3 * ((gsize) y * normals->stride + (gsize) x);

        stored[0] = 0.5f + 0.5f * n[0];
        stored[1] = 0.5f + up * n[1];
        stored[2] = 0.5f + 0.5f * n[2];
      }
}

/* ------------------------------------------------------------------ threads */

typedef struct { void (*body) (void *data, int i); void *data; } Work;

static void
call_range (gsize first, gsize n, gpointer user_data)
{
  const Work *work = user_data;

  for (gsize i = first; i < first + n; i++)
    work->body (work->data, (int) i);
}

void
celd_gegl_each (void *host, int n, void (*body) (void *data, int i), void *data)
{
  Work work = { body, data };

  gegl_parallel_distribute_range ((gsize) n, 1.0, call_range, &work);
}
