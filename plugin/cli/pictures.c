/* Reads pictures, and makes new ones.  Colours are converted by babl from the embedded profile (sRGB if there is none), so that
 * they equal those of GEGL's loaders.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <babl/babl.h>
#include <string.h>

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

bool
cli_colours_new (int width, int height, CeldColours *colours)
{
  *colours = (CeldColours) { width, height, (size_t) width, g_try_new (float, 4 * (gsize) width * (gsize) height) };
  return colours->data || cli_check (CELD_NO_MEMORY);
}

/* ------------------------------------------------------------------ reading */

/* The space of the embedded profile; NULL (sRGB) if there is none, or none for this kind of pixels. */
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

/* Colours of a part, and their conversion to sRGB. */
typedef struct
{
  float      *rgba;        /* in the format of the file */
  float      *row;         /* a row in the format that the fish converts from */
  const Babl *fish;
  int         width, channels; /* 4, or 2 if the picture is grey */
} Colours;

static void
colours_clear (Colours *colours)
{
  g_free (colours->rgba);
  g_free (colours->row);
}

static bool
colours_read (CeldIoFile *file, size_t part, const char *wanted, Colours *colours)
{
  const CeldIoPart *about = celd_io_part (file, part);
  int               width = celd_io_width (file), height = celd_io_height (file);
  const char       *encoded = about->grey ? "Y'A float" : "R'G'B'A float";
  const char       *linear = about->grey ? "YA float" : "RGBA float";
  CeldIoError       error;

  *colours = (Colours) {
    .rgba     = g_try_new (float, 4 * (gsize) width * (gsize) height),
    .row      = g_new (float, 4 * (gsize) width),
    .width    = width,
    .channels = about->grey ? 2 : 4,
  };
  if (!colours->rgba)
    return cli_check (CELD_NO_MEMORY);
  if (!celd_io_read_colours (file, part, colours->rgba, &error))
    return cli_error ("%s", error.text);
  /* With floats, and without babl's cache of conversions; else babl tests tables of 350 MB for half a second
   * (measured). */
  g_setenv ("BABL_INHIBIT_CACHE", "1", FALSE);
  babl_init ();
  colours->fish = babl_fish (babl_format_with_space (about->linear ? linear : encoded, space_of (file, part)),
                             babl_format (wanted));
  return true;
}

/* Converts a row; grey pixels have a value and alpha only.  `to` may be the row itself. */
static void
colours_convert (const Colours *colours, int y, void *to)
{
  const float *from = colours->rgba + 4 * (size_t) y * (size_t) colours->width;

  for (int x = 0, n = 0; x < colours->width; x++)
    for (int k = 0; k < colours->channels; k++, n++)
      colours->row[n] = from[4 * x + (colours->channels == 2 && k ? 3 : k)];
  babl_process (colours->fish, colours->row, to, colours->width);
}

/* Rounds the colours of a picture to bytes; free its data with g_free. */
static bool
colours_paint (const Colours *colours, int height, CeldPaint *art)
{
  int    width = colours->width;
  float *row = g_new (float, 4 * (gsize) width);

  *art = (CeldPaint) { width, height, (size_t) width, g_try_new (uint8_t, 4 * (gsize) width * (gsize) height) };
  for (int y = 0; art->data && y < height; y++)
    {
      colours_convert (colours, y, row);
      for (int i = 0; i < 4 * width; i++)
        art->data[4 * (size_t) y * (size_t) width + (size_t) i] = (uint8_t) (255 * CLAMP (row[i], 0, 1) + 0.5f);
    }
  g_free (row);
  return cli_check (art->data ? CELD_OK : CELD_NO_MEMORY);
}

/* Whether a picture can be a drawing, unless it is said what its lines are.  Beside levels, flat parts can be sprites,
 * or the levels, which cli_check_not_exchanged says. */
static bool
check_drawing (const char *path, const CliOptions *options, const CeldPaint *art, const CeldDrawing *drawing)
{
  return options->settings.ink != CELD_INK_AUTO || options->settings.flats ||
         (((options->drawing && options->step != CLI_ORDER) ||
           cli_check_parts (path, art, options->quiet || options->drawing)) &&
          cli_check_drawing (path, drawing, options->quiet));
}

/* Checks the drawing, and replaces it by its lines if it is a coloured one; *painted gets its colours then. */
static bool
take_coloured_lines (const char *path, const Colours *colours, const CliOptions *options, CeldDrawing *drawing,
                     CeldPaint *painted)
{
  CeldPaint art;
  bool      good = colours_paint (colours, drawing->luma.height, &art) &&
                   check_drawing (path, options, &art, drawing) &&
                   cli_check (celd_coloured_lines (&art, options->settings.ink, NULL, drawing));

  if (good && celd_paint_is_coloured (&art))
    *painted = art;
  else
    g_free (art.data);
  return good;
}

bool
cli_read_drawing (CeldIoFile *file, size_t part, const char *path, const CliOptions *options, CeldDrawing *drawing,
                  CeldPaint *painted)
{
  int     width = celd_io_width (file), height = celd_io_height (file);
  bool    alpha = celd_io_part (file, part)->alpha;
  float  *row = g_new (float, 4 * (gsize) width);
  Colours colours;
  bool    good = colours_read (file, part, "R'G'B'A float", &colours) &&
                 cli_plane_new (width, height, &drawing->luma) &&
                 (!alpha || cli_plane_new (width, height, &drawing->alpha));

  for (int y = 0; good && y < height; y++)
    {
      size_t start = (size_t) y * (size_t) width;

      colours_convert (&colours, y, row);
      celd_luma (row, (size_t) width, drawing->luma.data + start, alpha ? drawing->alpha.data + start : NULL);
    }
  good = good && take_coloured_lines (path, &colours, options, drawing, painted);
  g_free (row);
  colours_clear (&colours);
  return good;
}

bool
cli_read_paint (CeldIoFile *file, size_t part, const char *path, CeldPaint *paint)
{
  int     width = celd_io_width (file), height = celd_io_height (file);
  Colours colours;
  bool    good = colours_read (file, part, "R'G'B'A u8", &colours) &&
                 cli_check_colours (path, width, height, colours.rgba);

  if (good)
    {
      *paint = (CeldPaint) { width, height, (size_t) width, g_try_new (uint8_t, 4 * (gsize) width * (gsize) height) };
      good = cli_check (paint->data ? CELD_OK : CELD_NO_MEMORY);
    }
  for (int y = 0; good && y < height; y++)
    colours_convert (&colours, y, paint->data + 4 * (size_t) y * (size_t) width);
  colours_clear (&colours);
  return good;
}

bool
cli_read_part (CeldIoFile *file, size_t part, bool linear, CeldColours *to)
{
  Colours colours = { 0 };
  bool    good = colours_read (file, part, linear ? "RGBA float" : "R'G'B'A float", &colours);

  if (good)
    *to = (CeldColours) { colours.width, celd_io_height (file), (size_t) colours.width, colours.rgba };
  for (int y = 0; good && y < to->height; y++)
    colours_convert (&colours, y, to->data + 4 * (size_t) y * to->stride);
  if (good)
    colours.rgba = NULL;
  colours_clear (&colours);
  return good;
}

bool
cli_read_colours (const char *path, CeldColours *colours)
{
  CeldIoError error;
  CeldIoFile *file = celd_io_open (path, &error);
  bool        good = file ? cli_read_part (file, 0, true, colours) : cli_error ("%s", error.text);

  celd_io_close (file);
  return good;
}

bool
cli_read_levels (const char *path, CeldPlane *levels)
{
  CeldIoError error;
  CeldIoFile *file;
  bool        good;

  if (cli_is_npy (path))
    return cli_npy_read (path, levels) && cli_check_numbers (path, levels);
  if (!cli_check_grey (path))
    return false;
  file = celd_io_open (path, &error);
  if (!file)
    return cli_error ("%s", error.text);
  good = cli_plane_new (celd_io_width (file), celd_io_height (file), levels);
  if (good && !celd_io_read_values (file, 0, levels->data, &error))
    good = cli_error ("%s", error.text);
  celd_io_close (file);
  return good && cli_check_numbers (path, levels);
}

void
cli_encode (const float *linear, int n, float *encoded)
{
  babl_process (babl_fish (babl_format ("RGBA float"), babl_format ("R'G'B'A float")), linear, encoded, n);
}

void
cli_convert_light (bool from_linear, bool to_linear, int width, int height, float *rgba)
{
  const Babl *linear = babl_format ("RGBA float"), *encoded = babl_format ("R'G'B'A float");
  const Babl *fish = babl_fish (from_linear ? linear : encoded, to_linear ? linear : encoded);

  for (int y = 0; y < height && from_linear != to_linear; y++)
    {
      float *row = rgba + 4 * (size_t) y * (size_t) width;

      babl_process (fish, row, row, width);
    }
}
