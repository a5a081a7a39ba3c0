/* Pictures in and out.  Colours go through babl, so that they are what GEGL's loaders make of the same file: the
 * embedded profile first, sRGB where there is none.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <babl/babl.h>

bool
cli_plane_new (int width, int height, CeldPlane *plane)
{
  *plane = (CeldPlane) { width, height, (size_t) width, g_try_new (float, (gsize) width * (gsize) height) };
  return plane->data || cli_check (CELD_NO_MEMORY);
}

bool
cli_labels_new (int width, int height, CeldLabels *labels)
{
  *labels = (CeldLabels) { width, height, (size_t) width, g_try_new0 (uint32_t, (gsize) width * (gsize) height) };
  return labels->data || cli_check (CELD_NO_MEMORY);
}

/* ------------------------------------------------------------------ reading */

/* The space of the embedded profile; NULL (sRGB) if there is none that fits the pixels. */
static const Babl *
space_of (const CeldIoFile *file, size_t part)
{
  size_t      size;
  const char *profile = celd_io_profile (file, part, &size), *error = NULL;
  const Babl *space = NULL;

  if (profile && size <= G_MAXINT)
    space = babl_space_from_icc (profile, (int) size, BABL_ICC_INTENT_RELATIVE_COLORIMETRIC, &error);
  if (space && (babl_space_is_cmyk (space) || (babl_space_is_gray (space) && !celd_io_part (file, part)->grey)))
    space = NULL;
  return space;
}

/* The colours of a part as the file has them, and the way from there to a format of sRGB. */
static float *
read_colours (CeldIoFile *file, size_t part, const char *wanted, const Babl **fish)
{
  const CeldIoPart *about = celd_io_part (file, part);
  const char       *stored = about->grey ? (about->linear ? "YA float" : "Y'A float") :
                                           (about->linear ? "RGBA float" : "R'G'B'A float");
  float            *rgba = g_try_new (float, 4 * (gsize) celd_io_width (file) * (gsize) celd_io_height (file));
  CeldIoError       error;

  if (!rgba)
    {
      cli_check (CELD_NO_MEMORY);
      return NULL;
    }
  if (!celd_io_read_colours (file, part, rgba, &error))
    {
      cli_say ("%s", error.text);
      g_free (rgba);
      return NULL;
    }
  /* Reading its cache, babl tries out tables of 350 MB, which costs half a second; we need one conversion. */
  g_setenv ("BABL_INHIBIT_CACHE", "1", FALSE);
  babl_init ();
  *fish = babl_fish (babl_format_with_space (stored, space_of (file, part)), babl_format (wanted));
  return rgba;
}

/* One row through the fish; grey rows are packed to two floats a pixel first, in place. */
static void
convert_row (const Babl *fish, bool grey, float *row, int width, void *to)
{
  for (int x = 0; grey && x < width; x++)
    {
      row[2 * x]     = row[4 * x];
      row[2 * x + 1] = row[4 * x + 3];
    }
  babl_process (fish, row, to, width);
}

bool
cli_read_drawing (CeldIoFile *file, size_t part, CeldDrawing *drawing)
{
  int         width = celd_io_width (file), height = celd_io_height (file);
  bool        grey = celd_io_part (file, part)->grey;
  const Babl *fish;
  float      *rgba = read_colours (file, part, "Y'A float", &fish), *converted = NULL;
  bool        good = rgba && cli_plane_new (width, height, &drawing->luma) &&
                     (!celd_io_part (file, part)->alpha || cli_plane_new (width, height, &drawing->alpha));

  if (good)
    converted = g_new (float, 2 * (gsize) width);
  for (int y = 0; good && y < height; y++)
    {
      size_t row = (size_t) y * (size_t) width;

      convert_row (fish, grey, rgba + 4 * row, width, converted);
      for (int x = 0; x < width; x++)
        drawing->luma.data[row + (size_t) x] = converted[2 * x];
      for (int x = 0; drawing->alpha.data && x < width; x++)
        drawing->alpha.data[row + (size_t) x] = converted[2 * x + 1];
    }
  g_free (converted);
  g_free (rgba);
  return good;
}

bool
cli_read_paint (CeldIoFile *file, size_t part, CeldPaint *paint)
{
  int         width = celd_io_width (file), height = celd_io_height (file);
  bool        grey = celd_io_part (file, part)->grey;
  const Babl *fish;
  float      *rgba = read_colours (file, part, "R'G'B'A u8", &fish);

  if (!rgba)
    return false;
  *paint = (CeldPaint) { width, height, (size_t) width, g_try_new (uint8_t, 4 * (gsize) width * (gsize) height) };
  for (int y = 0; paint->data && y < height; y++)
    {
      size_t row = 4 * (size_t) y * (size_t) width;

      convert_row (fish, grey, rgba + row, width, paint->data + row);
    }
  g_free (rgba);
  return paint->data || cli_check (CELD_NO_MEMORY);
}

bool
cli_read_levels (const char *path, CeldPlane *levels)
{
  CeldIoError error;
  CeldIoFile *file;
  bool        good;

  if (cli_is_npy (path))
    return cli_npy_read (path, levels);
  file = celd_io_open (path, &error);
  if (!file)
    return cli_error ("%s", error.text);
  good = cli_plane_new (celd_io_width (file), celd_io_height (file), levels);
  if (good && !celd_io_read_values (file, 0, levels->data, &error))
    good = cli_error ("%s", error.text);
  celd_io_close (file);
  return good;
}

/* ------------------------------------------------------------------ writing, by the ending of the name */

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

/* Numbers into numpy files, colours elsewhere. */
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
