/* Reads a drawing and its layers, each from its own file, or all from the named layers of a PSD, ORA, KRA, EXR or TIFF
 * file.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <math.h>
#include <string.h>

#include "layer-names.h"

#define MOST_REGIONS 0xffffff /* as many as there are colours */
#define COLOUR_STEP  0x9e3779 /* odd, so that all multiples of it differ in 24 bits; near the golden ratio, far apart */

static const struct { CliRoles role; const char *name; } roles[] = {
  { CLI_DRAWING, "drawing" }, { CLI_SCRIBBLES, "scribbles" }, { CLI_ARROWS, "arrows" }, { CLI_CONTOURS, "contours" },
  { CLI_CORRECTIONS, "corrections" }, { CLI_HIDDEN, "hidden" },
};

/* ------------------------------------------------------------------ one file */

static CeldIoFile *
open_file (const char *path)
{
  CeldIoError error;
  CeldIoFile *file;

  if (cli_is_npy (path) && g_file_test (path, G_FILE_TEST_IS_REGULAR))
    {
      cli_say ("\"%s\" has numbers without colours, which can be levels, depth or regions only.", path);
      return NULL;
    }
  file = celd_io_open (path, &error);
  if (!file)
    cli_say ("%s", error.text);
  return file;
}

static bool
check_sides (int width, int height, const char *path, const CliLayers *layers)
{
  return (layers->width == width && layers->height == height) ||
         cli_error ("\"%s\" has %d x %d pixels, but %d x %d are needed; give all layers the size of the drawing.",
                    path, width, height, layers->width, layers->height);
}

static bool
check_size (const CeldIoFile *file, const char *path, CliLayers *layers)
{
  if (!layers->width)
    {
      layers->width = celd_io_width (file);
      layers->height = celd_io_height (file);
    }
  return check_sides (celd_io_width (file), celd_io_height (file), path, layers);
}

size_t
cli_find_part (const CeldIoFile *file, const char *name)
{
  size_t              part = celd_io_find (file, name);
  const CeldLayerRole role = celd_layer_role_of_name (name);

  for (size_t i = 0; part == CELD_NO_INDEX && role < CELD_N_LAYERS && i < celd_io_parts (file); i++)
    if (celd_layer_role_of_name (celd_io_part (file, i)->name) == role)
      part = i;
  return part;
}

/* Says which layers of a role are left out, if several have it. */
static void
say_left_out (const CeldIoFile *file, size_t part, const char *path, const char *role)
{
  GString *names = g_string_new (NULL);
  guint    n = 0;

  for (size_t i = 0; i < celd_io_parts (file); i++)
    if (celd_layer_role_of_name (celd_io_part (file, i)->name) == celd_layer_role_of_name (role))
      g_string_append_printf (names, "%s\"%s\"", n++ ? ", " : "", celd_io_part (file, i)->name);
  if (n > 1)
    cli_say ("\"%s\" has %u layers for %s: %s. Only the lowest \"%s\" is read: merge them, or give the others names of "
             "their own.", path, n, role, names->str, celd_io_part (file, part)->name);
  g_string_free (names, TRUE);
}

/* The part with the drawing: the one of that name, or the first if no part has the name of a layer; otherwise
 * CELD_NO_INDEX, with a message. */
static size_t
find_drawing (const CeldIoFile *file, const char *path)
{
  size_t   part = cli_find_part (file, "drawing");
  bool     layered = false;
  GString *names;

  for (size_t i = 0; i < G_N_ELEMENTS (roles); i++)
    layered = layered || cli_find_part (file, roles[i].name) != CELD_NO_INDEX;
  if (part != CELD_NO_INDEX || !layered)
    return part == CELD_NO_INDEX ? 0 : part;
  names = g_string_new (NULL);
  for (size_t i = 0; i < celd_io_parts (file); i++)
    if (celd_io_part (file, i)->name[0])
      g_string_append_printf (names, "%s\"%s\"", names->len ? ", " : "", celd_io_part (file, i)->name);
  cli_say ("\"%s\" has no layer named \"drawing\". Its layers are %s.", path, names->str);
  g_string_free (names, TRUE);
  return CELD_NO_INDEX;
}

/* Reads the numbers of regions that segment has written, and gives each a colour of its own. */
static bool
read_numbers (const char *path, CliLayers *layers, CeldPaint *paint)
{
  CeldPlane numbers = { 0 };
  bool      good = cli_npy_read (path, &numbers) && cli_check_numbers (path, &numbers);
  size_t    n = (size_t) numbers.width * (size_t) numbers.height;

  if (good && !layers->width)
    {
      layers->width  = numbers.width;
      layers->height = numbers.height;
    }
  good = good && check_sides (numbers.width, numbers.height, path, layers);
  if (good)
    {
      *paint = (CeldPaint) { numbers.width, numbers.height, numbers.stride, g_try_malloc0 (4 * n) };
      good   = cli_check (paint->data ? CELD_OK : CELD_NO_MEMORY);
    }
  for (size_t i = 0; i < n && good; i++)
    {
      float    number = numbers.data[i];
      uint32_t colour = (uint32_t) CLAMP (number, 0, MOST_REGIONS) * COLOUR_STEP;

      if (number != floorf (number) || number < 0 || number > MOST_REGIONS)
        good = cli_error ("\"%s\" has the value %g, but regions are whole numbers from 1, as segment writes them with "
                          "--labels.", path, (double) number);
      for (int k = 0; k < 3; k++)
        paint->data[4 * i + (size_t) k] = (uint8_t) (colour >> (8 * k));
      paint->data[4 * i + 3] = number > 0 ? 255 : 0;
    }
  g_free (numbers.data);
  return good;
}

/* Tells that the first of several pictures is read, none of which has the name of a layer. */
static void
say_frames (const CeldIoFile *file, const char *path)
{
  if (celd_io_part (file, 0)->frame)
    cli_say ("\"%s\" has several frames or pages, of which only the first is read: save the one that you mean as a "
             "picture of its own.", path);
}

/* Reads the part that is named after the role, or else the first one. */
static bool
read_layer (const char *path, const char *role, bool quiet, CliLayers *layers, CeldPaint *paint)
{
  CeldIoFile *file = open_file (path);
  size_t      part = file ? cli_find_part (file, role) : 0;
  bool        good = file && check_size (file, path, layers) &&
                     cli_read_paint (file, part == CELD_NO_INDEX ? 0 : part, path, paint);

  if (good && !quiet && part == CELD_NO_INDEX)
    say_frames (file, path);
  celd_io_close (file);
  return good;
}

bool
cli_layer_read (const char *path, const char *role, CliLayers *layers, CeldPaint *paint)
{
  if (cli_is_npy (path) && !strcmp (role, "labels"))
    return read_numbers (path, layers, paint);
  return read_layer (path, role, true, layers, paint);
}

bool
cli_hint_read (const char *path, const CliLayers *layers, CeldPlane *depth)
{
  return cli_read_levels (path, depth) && check_sides (depth->width, depth->height, path, layers);
}

bool
cli_art_read (const CliOptions *options, const char *input, const char *path, bool linear, CliLayers *layers,
              CeldColours *art)
{
  CeldIoFile *file = open_file (path ? path : input);
  size_t      part = !file ? 0 : path ? cli_find_part (file, "colours") : find_drawing (file, input);
  bool        good = file && check_size (file, path ? path : input, layers) &&
                     cli_read_part (file, part == CELD_NO_INDEX ? 0 : part, linear, art);

  celd_io_close (file);
  return good && (!path || options->quiet || cli_warn_of_art (path, art, linear));
}

/* ------------------------------------------------------------------ all layers */

static CeldPaint *
paint_of (CliLayers *layers, CliRoles role)
{
  return role == CLI_SCRIBBLES ? &layers->scribbles : role == CLI_ARROWS ? &layers->arrows
       : role == CLI_CONTOURS ? &layers->contours
       : role == CLI_CORRECTIONS ? &layers->corrections : &layers->hidden;
}

static const char *
path_of (const CliOptions *options, CliRoles role)
{
  return role == CLI_SCRIBBLES ? options->scribbles : role == CLI_ARROWS ? options->arrows
       : role == CLI_CONTOURS ? options->contours
       : role == CLI_CORRECTIONS ? options->corrections : options->hidden;
}

/* Reads the drawing, and from the same file the layers for which no option names another file.  With --flats a coloured
 * drawing can be its own scribbles. */
static bool
read_input (const char *path, const CliOptions *options, CliRoles wanted, CliLayers *layers)
{
  CeldIoFile *file = open_file (path);
  size_t      drawing = file ? find_drawing (file, path) : CELD_NO_INDEX;
  bool        good = drawing != CELD_NO_INDEX && cli_check_layer_names (file, path, options, wanted) &&
                     check_size (file, path, layers) &&
                     cli_read_drawing (file, drawing, path, options, &layers->drawing, &layers->colours);

  if (good && !options->quiet)
    say_left_out (file, drawing, path, "drawing");
  if (good && !options->quiet && cli_find_part (file, "drawing") == CELD_NO_INDEX)
    say_frames (file, path);
  for (size_t i = 1; good && i < G_N_ELEMENTS (roles); i++)
    if (wanted & roles[i].role && !path_of (options, roles[i].role))
      {
        size_t part = cli_find_part (file, roles[i].name);

        if (part != CELD_NO_INDEX && !options->quiet)
          say_left_out (file, part, path, roles[i].name);
        if (part == CELD_NO_INDEX && roles[i].role == CLI_SCRIBBLES && options->settings.flats)
          part = drawing;
        good = part == CELD_NO_INDEX || cli_read_paint (file, part, path, paint_of (layers, roles[i].role));
      }
  celd_io_close (file);
  return good;
}

bool
cli_layers_read (const char *input, const CliOptions *options, CliRoles wanted, CliLayers *layers)
{
  bool good = cli_check_different_files (options) && (!input || read_input (input, options, wanted, layers));

  for (size_t i = 1; good && i < G_N_ELEMENTS (roles); i++)
    if (wanted & roles[i].role && path_of (options, roles[i].role))
      good = read_layer (path_of (options, roles[i].role), roles[i].name, options->quiet, layers,
                         paint_of (layers, roles[i].role));
  for (size_t i = 1; good && i < G_N_ELEMENTS (roles); i++)
    if (roles[i].role != CLI_SCRIBBLES && paint_of (layers, roles[i].role)->data)
      good = cli_check_strokes (path_of (options, roles[i].role) ? path_of (options, roles[i].role) : input,
                                roles[i].name, paint_of (layers, roles[i].role));
  if (good && layers->contours.data && layers->drawing.luma.data)
    good = cli_check_contours (options->contours ? options->contours : input, options, layers);
  return good;
}

void
cli_layers_clear (CliLayers *layers)
{
  g_free (layers->drawing.luma.data);
  g_free (layers->drawing.alpha.data);
  g_free (layers->colours.data);
  g_free (layers->scribbles.data);
  g_free (layers->arrows.data);
  g_free (layers->contours.data);
  g_free (layers->corrections.data);
  g_free (layers->hidden.data);
  *layers = (CliLayers) { 0 };
}
