/* Writes pictures into the group of results while the artist paints.
 *
 * Pixels are written straight into a layer, which makes no step of undo, so that Ctrl+Z takes back the artist's own
 * strokes; and only where they differ from what is there, since GIMP has to draw these again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "live.h"

#include <string.h>

/* ------------------------------------------------------------------ formats */

const Babl *
celd_live_write_format (GimpImage *image, CeldPicture picture)
{
  GimpLayer *layer = celd_results_find_unlocked (image, celd_pictures[picture].argument);

  return layer ? gimp_drawable_get_format (GIMP_DRAWABLE (layer)) : NULL;
}

const Babl *
celd_live_write_new_format (GimpImage *image, CeldPicture picture)
{
  return celd_results_find (image, celd_pictures[picture].argument) ? NULL : babl_format ("R'G'B'A float");
}

/* ------------------------------------------------------------------ new layers */

/* A CeldResults.write; the data is the buffer that is copied. */
static gboolean
copy_pixels (CeldPipeline *pipeline, int picture, gpointer data, GeglBuffer *buffer, GError **error)
{
  (void) pipeline;
  (void) picture;
  (void) error;
  gegl_buffer_copy (data, NULL, GEGL_ABYSS_NONE, buffer, NULL);
  return TRUE;
}

/* The artist goes on painting on the layers that were selected. */
static void
add_layer (GimpImage *image, CeldPicture picture, GeglBuffer *buffer)
{
  const CeldPictureInfo *info = &celd_pictures[picture];
  CeldResultLayer        layer = { info->argument, info->layer, info->alpha ? GIMP_RGBA_IMAGE : GIMP_RGB_IMAGE,
                                   (int) picture };
  CeldResults            results = { &layer, 1, copy_pixels, buffer, FALSE };
  GimpLayer            **selected = gimp_image_get_selected_layers (image);

  gimp_image_undo_group_start (image);
  celd_results_write (image, NULL, &results, 1u << picture, NULL);
  if (selected && selected[0])
    gimp_image_set_selected_layers (image, (const GimpLayer **) selected);
  gimp_image_undo_group_end (image);
  g_free (selected);
}

/* ------------------------------------------------------------------ layers that are there */

/* The smallest rectangle outside which two pictures without gaps between rows are the same. */
static GeglRectangle
find_difference (const guint8 *a, const guint8 *b, int width, int height, gsize pixel)
{
  gsize row = (gsize) width * pixel, left = row, right = 0;
  int   top = height, bottom = 0;

  for (int y = 0; y < height; y++, a += row, b += row)
    if (memcmp (a, b, row))
      {
        gsize first = 0, end = row;

        while (a[first] == b[first])
          first++;
        while (a[end - 1] == b[end - 1])
          end--;
        left   = MIN (left, first);
        right  = MAX (right, end);
        top    = MIN (top, y);
        bottom = y + 1;
      }
  if (!bottom)
    return (GeglRectangle) { 0, 0, 0, 0 };
  left  = left / pixel;
  right = (right + pixel - 1) / pixel;
  return (GeglRectangle) { (int) left, top, (int) (right - left), bottom - top };
}

/* Pixels of a rectangle, without gaps between rows, to be freed; NULL: there is no memory. */
static guint8 *
read_rectangle (GeglBuffer *buffer, const GeglRectangle *rect, const Babl *format)
{
  guint8 *pixels = g_try_malloc_n ((gsize) rect->width * (gsize) rect->height,
                                   (gsize) babl_format_get_bytes_per_pixel (format));

  if (pixels)
    gegl_buffer_get (buffer, rect, 1, format, pixels, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  return pixels;
}

/* `rect` is the part of the layer that lies on the image, which begins at (x,y) of the layer. */
static void
write_difference (GimpDrawable *drawable, GeglBuffer *there, GeglBuffer *picture, const GeglRectangle *rect, int x,
                  int y)
{
  GeglRectangle source = { rect->x - x, rect->y - y, rect->width, rect->height }, changed = { 0 };
  const Babl   *format = gegl_buffer_get_format (there);
  gsize         pixel = (gsize) babl_format_get_bytes_per_pixel (format);
  guint8       *old = read_rectangle (there, rect, format), *new = read_rectangle (picture, &source, format);

  if (old && new)
    changed = find_difference (old, new, rect->width, rect->height, pixel);
  if (changed.width)
    {
      gsize first = ((gsize) changed.y * (gsize) rect->width + (gsize) changed.x) * pixel;

      changed.x += rect->x;
      changed.y += rect->y;
      gegl_buffer_set (there, &changed, 0, format, new + first, rect->width * (int) pixel);
      gegl_buffer_flush (there); /* which sends the pixels */
      gimp_drawable_update (drawable, changed.x, changed.y, changed.width, changed.height);
    }
  g_free (old);
  g_free (new);
}

/* The layer may have been moved or cropped. */
static void
update_layer (GimpLayer *layer, GeglBuffer *picture)
{
  GimpDrawable        *drawable = GIMP_DRAWABLE (layer);
  GeglBuffer          *there = gimp_drawable_get_buffer (drawable);
  const GeglRectangle *image = gegl_buffer_get_extent (picture);
  GeglRectangle        rect;
  int                  x = 0, y = 0;

  gimp_drawable_get_offsets (drawable, &x, &y);
  if (there && gegl_rectangle_intersect (&rect, gegl_buffer_get_extent (there),
                                         GEGL_RECTANGLE (-x, -y, image->width, image->height)))
    write_difference (drawable, there, picture, &rect, -x, -y);
  g_clear_object (&there);
}

void
celd_live_write (GimpImage *image, CeldPicture picture, GeglBuffer *buffer)
{
  GimpLayer *layer = celd_results_find_unlocked (image, celd_pictures[picture].argument);

  if (layer)
    update_layer (layer, buffer);
  else if (!celd_results_find (image, celd_pictures[picture].argument))
    add_layer (image, picture, buffer);
}
