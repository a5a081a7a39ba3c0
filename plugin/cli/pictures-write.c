/* Writes pictures in the format of the name's ending.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <string.h>

bool
cli_is_png (const char *path)
{
  size_t length = strlen (path);

  return length > 4 && !g_ascii_strcasecmp (path + length - 4, ".png");
}

bool
cli_is_motion (const char *path)
{
  CeldIoFramesKind kind = celd_io_frames_kind (path);

  return kind == CELD_IO_GIF || kind == CELD_IO_PNG_FRAMES;
}

bool
cli_can_write (const char *path)
{
  return cli_is_npy (path) || celd_io_can_write (path);
}

static bool
check_written (bool written, const CeldIoError *error)
{
  return written || cli_error ("%s", error->text);
}

bool
cli_write_depth (const char *path, const CeldPlane *depth, float nearest)
{
  CeldIoError error;

  if (cli_is_npy (path))
    return cli_npy_write (path, depth->width, depth->height, 0, depth->stride, depth->data);
  return check_written (celd_io_write_depth (path, depth, 0, nearest, &error), &error);
}

/* Writes numbers of labels to numpy files, and colours to others. */
bool
cli_write_labels (const char *path, const CeldLabels *labels, const CeldPalette *palette)
{
  size_t      n = (size_t) labels->width * (size_t) labels->height;
  CeldIoError error;
  CeldPaint   paint = { labels->width, labels->height, (size_t) labels->width, NULL };
  bool        good;

  if (cli_is_npy (path))
    {
      CeldPlane numbers;

      good = cli_plane_new (labels->width, labels->height, &numbers);
      for (size_t i = 0; good && i < n; i++)
        numbers.data[i] = (float) labels->data[i / numbers.stride * labels->stride + i % numbers.stride];
      good = good && cli_npy_write (path, numbers.width, numbers.height, 0, numbers.stride, numbers.data);
      g_free (numbers.data);
      return good;
    }
  paint.data = g_try_new (uint8_t, 4 * n);
  good = cli_check (paint.data ? celd_labels_paint (labels, palette, &paint) : CELD_NO_MEMORY) &&
         check_written (celd_io_write_paint (path, &paint, &error), &error);
  g_free (paint.data);
  return good;
}

/* Writes height x width x 4 numbers in [0,1] to numpy files, and 8-bit colours to others. */
bool
cli_write_layer (const char *path, const CeldPaint *layer)
{
  size_t      n = 4 * (size_t) layer->width * (size_t) layer->height;
  CeldIoError error;
  float      *values;
  bool        good;

  if (!cli_is_npy (path))
    return check_written (celd_io_write_paint (path, layer, &error), &error);
  values = g_try_new (float, n);
  for (size_t i = 0; values && i < n; i++)
    values[i] = (float) layer->data[i] / 255;
  good = cli_check (values ? CELD_OK : CELD_NO_MEMORY) &&
         cli_npy_write (path, layer->width, layer->height, 4, 4 * layer->stride, values);
  g_free (values);
  return good;
}

bool
cli_write_normals (const char *path, const CeldVectors *normals)
{
  CeldIoError error;

  if (cli_is_npy (path))
    return cli_npy_write (path, normals->width, normals->height, 3, 3 * normals->stride, normals->data);
  return check_written (celd_io_write_normals (path, normals, &error), &error);
}

bool
cli_write_shading (const char *path, const CeldPlane *shading)
{
  CeldIoError error;

  if (cli_is_npy (path))
    return cli_npy_write (path, shading->width, shading->height, 0, shading->stride, shading->data);
  return check_written (celd_io_write_light (path, shading, &error), &error);
}

bool
cli_write_colours (const char *path, const CeldColours *colours)
{
  CeldIoError error;

  if (cli_is_npy (path))
    return cli_npy_write (path, colours->width, colours->height, 4, 4 * colours->stride, colours->data);
  return check_written (celd_io_write_colours (path, colours, &error), &error);
}

bool
cli_write_shifts (const char *path, const CeldShifts *shifts)
{
  size_t        row = 2 * shifts->stride;
  CeldIoChannel channels[] = { { "X", shifts->data, 2, row }, { "Y", shifts->data + 1, 2, row } };
  CeldIoPicture picture = { NULL, shifts->width, shifts->height, CELD_IO_FLOAT, false, channels, 2 };
  CeldIoError   error;

  if (cli_is_npy (path))
    return cli_npy_write (path, shifts->width, shifts->height, 2, row, shifts->data);
  return check_written (celd_io_write (path, &picture, 1, NULL, 0, &error), &error);
}

bool
cli_write_heights (const char *path, const CeldPlane *heights)
{
  CeldIoError error;

  if (cli_is_npy (path))
    return cli_npy_write (path, heights->width, heights->height, 0, heights->stride, heights->data);
  return check_written (celd_io_write_heights (path, heights, &error), &error);
}

bool
cli_write_meshes (const char *path, const CeldIoMesh *mesh, size_t n, const CeldColours *art)
{
  CeldIoError error;

  return check_written (celd_io_write_meshes (path, mesh, n, art, &error), &error);
}

bool
cli_write_values (const char *path, const CeldPlane *values)
{
  bool          png = cli_is_png (path);
  CeldIoChannel channel = { "Y", values->data, 1, values->stride };
  CeldIoPicture picture = { NULL, values->width, values->height, png ? CELD_IO_16_BIT : CELD_IO_FLOAT, false, &channel,
                            1 };
  CeldIoError   error;

  if (cli_is_npy (path))
    return cli_npy_write (path, values->width, values->height, 0, values->stride, values->data);
  return check_written (celd_io_write (path, &picture, 1, NULL, 0, &error), &error);
}

bool
cli_write_map (const char *path, const CeldColours *map)
{
  size_t        row = 4 * map->stride;
  CeldIoChannel channels[] = { { "R", map->data, 4, row }, { "G", map->data + 1, 4, row },
                               { "B", map->data + 2, 4, row }, { "A", map->data + 3, 4, row } };
  CeldIoPicture picture = { NULL, map->width, map->height, CELD_IO_8_BIT, false, channels, 4 };
  CeldIoError   error;

  return check_written (celd_io_write (path, &picture, 1, NULL, 0, &error), &error);
}
