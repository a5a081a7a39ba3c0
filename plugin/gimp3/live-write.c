/* Writes pictures into the group of results while the artist paints.
 *
 * Pixels are written straight into a layer, which makes no step of undo, so that Ctrl+Z takes back the artist's own
 * strokes; and only where they differ from what is there, since GIMP has to draw these again.
 *
 * What is there is read in a copy, for the reason that live-follow.c gives.  Whole tiles are written, also where they
 * go beyond the layer, since GEGL would first read a tile that is written in part; a layer that grows meanwhile may get
 * them in a wrong place, until the next picture comes.  They are written by rows, so that a layer may shrink before the
 * rows that it loses are.  GIMP ends a plug-in that writes a tile which is not there any more, or may not be written: a
 * layer that shrinks, goes or is locked in the few milliseconds that these rows take still ends it.  Between any two
 * messages of a plug-in GIMP may do what the artist has asked for, and each tile is a message; it has no other way of
 * writing without a step of undo.
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

/* The whole tiles of libgimp that have a pixel of the rectangle, also where they go beyond the layer. */
static GeglRectangle
whole_tiles (const GeglRectangle *rect)
{
  GeglRectangle tiles;

  gegl_rectangle_align (&tiles, rect,
                        GEGL_RECTANGLE (0, 0, (int) gimp_tile_width (), (int) gimp_tile_height ()),
                        GEGL_RECTANGLE_ALIGNMENT_SUPERSET);
  return tiles;
}

/* Writes whole tiles of the layer, if it still has the size of what they were made from; whether it has.  The size is
 * asked for when the pixels are ready. */
static gboolean
send_row (GimpDrawable *drawable, GeglBuffer *pixels, const GeglRectangle *row)
{
  const Babl   *format = gegl_buffer_get_format (pixels);
  guint8       *new = read_rectangle (pixels, row, format);
  GeglBuffer   *there = new ? gimp_drawable_get_buffer (drawable) : NULL;
  GeglRectangle extent;
  gboolean      good = there && gegl_rectangle_equal (gegl_buffer_get_extent (there), gegl_buffer_get_extent (pixels));

  if (good)
    {
      gegl_rectangle_bounding_box (&extent, gegl_buffer_get_extent (there), row);
      gegl_buffer_set_extent (there, &extent);
      gegl_buffer_set (there, row, 0, format, new, GEGL_AUTO_ROWSTRIDE);
      gegl_buffer_flush (there); /* which sends them */
    }
  g_clear_object (&there);
  g_free (new);
  return good;
}

/* Writes the pixels of a rectangle of the layer, by rows of tiles, and has GIMP draw them.  If the layer is resized,
 * GIMP draws all of it. */
static void
send (GimpDrawable *drawable, GeglBuffer *pixels, const GeglRectangle *changed)
{
  GeglRectangle tiles = whole_tiles (changed), row = tiles;
  int           bottom = tiles.y + tiles.height, side = (int) gimp_tile_height ();

  while (row.y < bottom)
    {
      row.height = MIN (side, bottom - row.y);
      if (!send_row (drawable, pixels, &row))
        return;
      row.y += row.height;
    }
  gimp_drawable_update (drawable, changed->x, changed->y, changed->width, changed->height);
}

/* `pixels` are those of the layer, of which the picture replaces the part that lies on the image, which begins at (x,y)
 * of the layer. */
static void
write_difference (GimpDrawable *drawable, GeglBuffer *pixels, GeglBuffer *picture, int x, int y)
{
  const GeglRectangle *image = gegl_buffer_get_extent (picture);
  const Babl          *format = gegl_buffer_get_format (pixels);
  GeglRectangle        rect, changed = { 0 };
  guint8              *old, *new;

  if (!gegl_rectangle_intersect (&rect, gegl_buffer_get_extent (pixels),
                                 GEGL_RECTANGLE (x, y, image->width, image->height)))
    return;
  old = read_rectangle (pixels, &rect, format);
  new = read_rectangle (picture, GEGL_RECTANGLE (rect.x - x, rect.y - y, rect.width, rect.height), format);
  if (old && new)
    changed = find_difference (old, new, rect.width, rect.height, (gsize) babl_format_get_bytes_per_pixel (format));
  if (changed.width)
    {
      gegl_buffer_set (pixels, &rect, 0, format, new, GEGL_AUTO_ROWSTRIDE);
      changed.x += rect.x;
      changed.y += rect.y;
      send (drawable, pixels, &changed);
    }
  g_free (old);
  g_free (new);
}

/* The pixels of a layer as they are, in memory of their own; NULL: there are none. */
static GeglBuffer *
copy_layer (GimpLayer *layer, GimpImage *own)
{
  GimpLayer  *copy = own ? gimp_layer_new_from_drawable (GIMP_DRAWABLE (layer), own) : NULL;
  GeglBuffer *buffer = copy ? gimp_drawable_get_buffer (GIMP_DRAWABLE (copy)) : NULL;
  GeglBuffer *pixels = buffer ? gegl_buffer_dup (buffer) : NULL;

  g_clear_object (&buffer);
  if (copy)
    gimp_item_delete (GIMP_ITEM (copy));
  return pixels;
}

/* The layer may have been moved or cropped. */
static void
update_layer (GimpLayer *layer, GimpImage *own, GeglBuffer *picture)
{
  GimpDrawable *drawable = GIMP_DRAWABLE (layer);
  GeglBuffer   *pixels = copy_layer (layer, own);
  int           x = 0, y = 0;

  gimp_drawable_get_offsets (drawable, &x, &y);
  if (pixels)
    write_difference (drawable, pixels, picture, -x, -y);
  g_clear_object (&pixels);
}

void
celd_live_write (GimpImage *image, GimpImage *own, CeldPicture picture, GeglBuffer *buffer)
{
  GimpLayer *layer = celd_results_find_unlocked (image, celd_pictures[picture].argument);

  if (layer)
    update_layer (layer, own, buffer);
  else if (!celd_results_find (image, celd_pictures[picture].argument))
    add_layer (image, picture, buffer);
}
