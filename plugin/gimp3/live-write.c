/* Writes pictures into the group of results while the artist paints.
 *
 * Pixels are written straight into a layer, which makes no step of undo, so that Ctrl+Z takes back the artist's own
 * strokes; and only where they differ from what is there, since GIMP has to draw these again.
 *
 * What is there is read in a copy, for the reason that live-follow.c gives.  The picture is written into that copy, and
 * another process, live-send.c, brings it from there into the layer: GIMP ends it if the layer goes meanwhile.
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

/* Has the pixels of a rectangle brought from the copy into the layer.  What becomes of that does not matter: if the
 * layer goes, changes its size or is locked meanwhile, it is looked at again soon.  If GIMP has ended the process of
 * the sender, one has to be started each time. */
static void
send (const char *sender, GimpLayer *layer, GimpLayer *copy, const GeglRectangle *changed)
{
  GimpPDB        *pdb = gimp_get_pdb ();
  GimpProcedure  *procedure = gimp_pdb_lookup_procedure (
    pdb, gimp_pdb_procedure_exists (pdb, sender) ? sender : CELD_LIVE_SEND);
  GimpValueArray *values;

  if (!procedure)
    return;
  values = gimp_procedure_run (procedure, "layer", layer, "copy", copy, "x", changed->x, "y", changed->y,
                               "width", changed->width, "height", changed->height, NULL);
  gimp_value_array_unref (values);
}

/* Replaces the part of the buffer that lies on the image, which begins at (x,y) of the buffer, by that of the picture.
 * The rectangle outside which that changes nothing; it is empty if nothing is changed. */
static GeglRectangle
write_difference (GeglBuffer *buffer, GeglBuffer *picture, int x, int y)
{
  const GeglRectangle *image = gegl_buffer_get_extent (picture);
  const Babl          *format = gegl_buffer_get_format (buffer);
  int                  pixel = babl_format_get_bytes_per_pixel (format);
  GeglRectangle        rect, changed = { 0 };
  guint8              *old, *new;

  if (!gegl_rectangle_intersect (&rect, gegl_buffer_get_extent (buffer),
                                 GEGL_RECTANGLE (x, y, image->width, image->height)))
    return changed;
  old = read_rectangle (buffer, &rect, format);
  new = read_rectangle (picture, GEGL_RECTANGLE (rect.x - x, rect.y - y, rect.width, rect.height), format);
  if (old && new)
    changed = find_difference (old, new, rect.width, rect.height, (gsize) pixel);
  if (changed.width)
    {
      const guint8 *first = new + ((gsize) changed.y * (gsize) rect.width + (gsize) changed.x) * (gsize) pixel;

      changed.x += rect.x;
      changed.y += rect.y;
      gegl_buffer_set (buffer, &changed, 0, format, first, rect.width * pixel);
    }
  g_free (old);
  g_free (new);
  return changed;
}

/* The layer may have been moved or cropped; so its copy has its place.  A layer that has been locked since it was found
 * has a locked copy, and GIMP would end this process if it wrote into that. */
static void
update_layer (const CeldLiveTarget *target, GimpLayer *layer, GeglBuffer *picture)
{
  GimpLayer    *copy = target->own ? gimp_layer_new_from_drawable (GIMP_DRAWABLE (layer), target->own) : NULL;
  GeglBuffer   *buffer = NULL;
  GeglRectangle changed = { 0 };
  int           x = 0, y = 0;

  if (copy && !gimp_item_get_lock_content (GIMP_ITEM (copy)))
    buffer = gimp_drawable_get_buffer (GIMP_DRAWABLE (copy));
  if (buffer)
    {
      gimp_drawable_get_offsets (GIMP_DRAWABLE (copy), &x, &y);
      changed = write_difference (buffer, picture, -x, -y);
    }
  g_clear_object (&buffer); /* which sends what was written into it */
  if (changed.width)
    send (target->sender, layer, copy, &changed);
  if (copy)
    gimp_item_delete (GIMP_ITEM (copy));
}

void
celd_live_write (const CeldLiveTarget *target, CeldPicture picture, GeglBuffer *buffer, gboolean make)
{
  GimpLayer *layer = celd_results_find_unlocked (target->image, celd_pictures[picture].argument);

  if (layer)
    update_layer (target, layer, buffer);
  else if (make && !celd_results_find (target->image, celd_pictures[picture].argument))
    add_layer (target->image, picture, buffer);
}
