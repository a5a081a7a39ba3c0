/* celdepth:oiio-load: reads a layer of a PSD, OpenRaster or Krita file, a part of an EXR, a page of a TIFF, or any
 * other picture that OpenImageIO reads.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "oiio.h"

#ifdef GEGL_PROPERTIES

property_string (path, "File", "")
    description ("The file to read: PSD, ORA, KRA, EXR, TIFF, PNG, ...")

property_string (layer, "Layer", "")
    description ("The name of the layer or part. If it is empty, the number below counts")

property_int (part, "Part", 0)
    description ("The number of the layer or part, from 0. Part 0 of a PSD, ORA or KRA is the merged picture")
    value_range (0, 10000)
    ui_range (0, 20)

property_enum (content, "Content", CeldLoadContent, celd_load_content, CELD_LOAD_COLOURS)
    description ("Whether to read colours, or the numbers of depth or levels as they were saved")

#else

#define GEGL_OP_SOURCE
#define GEGL_OP_NAME     celdepth_oiio_load
#define GEGL_OP_C_SOURCE celdepth-oiio-load.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

/* The open file that the properties name; kept in user_data until they name another one. */
typedef struct
{
  char       *path, *layer;
  int         number;
  CeldIoFile *file;   /* NULL: it cannot be read, or has no such part */
  size_t      part;
} Source;

static void
source_free (Source *source)
{
  if (!source)
    return;
  celd_io_close (source->file);
  g_free (source->path);
  g_free (source->layer);
  g_free (source);
}

/* The number of the part; CELD_NO_INDEX, with a message that lists all parts, if it does not exist. */
static size_t
find_part (const Source *source)
{
  size_t   n = celd_io_parts (source->file);
  size_t   part = *source->layer ? celd_io_find (source->file, source->layer) : (size_t) source->number;
  GString *names;

  if (part < n)
    return part;
  names = g_string_new (NULL);
  for (size_t i = 0; i < n; i++)
    g_string_append_printf (names, "%s%zu '%s'", i ? ", " : "", i, celd_io_part (source->file, i)->name);
  if (*source->layer)
    g_message ("Load Layer: %s has no layer '%s'. Its layers are: %s", source->path, source->layer, names->str);
  else
    g_message ("Load Layer: %s has no part %d. Its parts are: %s", source->path, source->number, names->str);
  g_string_free (names, TRUE);
  return CELD_NO_INDEX;
}

static Source *
source_new (GeglProperties *o)
{
  Source     *source = g_new0 (Source, 1);
  CeldIoError error;

  source->path   = g_strdup (o->path ? o->path : "");
  source->layer  = g_strdup (o->layer ? o->layer : "");
  source->number = o->part;
  if (!*source->path)
    return source;
  source->file = celd_io_open (source->path, &error);
  if (!source->file)
    g_message ("Load Layer: %s", error.text);
  else if ((source->part = find_part (source)) == CELD_NO_INDEX)
    {
      celd_io_close (source->file);
      source->file = NULL;
    }
  return source;
}

static Source *
get_source (GeglOperation *operation)
{
  GeglProperties *o = GEGL_PROPERTIES (operation);
  Source         *source = o->user_data;

  if (!source || g_strcmp0 (source->path, o->path) || g_strcmp0 (source->layer, o->layer) || source->number != o->part)
    {
      source_free (source);
      o->user_data = source = source_new (o);
    }
  return source;
}

/* The format of colours: in the space of the embedded profile if that is an RGB profile, and else sRGB. */
static const Babl *
colour_format (const Source *source)
{
  const char *error = NULL, *profile;
  size_t      size;
  const Babl *space = NULL;

  if (celd_io_part (source->file, source->part)->linear)
    return babl_format ("RGBA float");
  profile = celd_io_profile (source->file, source->part, &size);
  if (profile)
    space = babl_space_from_icc (profile, (int) size, BABL_ICC_INTENT_RELATIVE_COLORIMETRIC, &error);
  if (space && (error || babl_space_is_cmyk (space) || babl_space_is_gray (space)))
    space = NULL;
  return babl_format_with_space ("R'G'B'A float", space);
}

static void
prepare (GeglOperation *operation)
{
  Source *source = get_source (operation);
  bool    colours = source->file && GEGL_PROPERTIES (operation)->content == CELD_LOAD_COLOURS;

  gegl_operation_set_format (operation, "output", colours ? colour_format (source) : babl_format ("Y float"));
}

static GeglRectangle
get_bounding_box (GeglOperation *operation)
{
  Source *source = get_source (operation);

  if (!source->file)
    return (GeglRectangle) { 0, 0, 0, 0 };
  return (GeglRectangle) { 0, 0, celd_io_width (source->file), celd_io_height (source->file) };
}

static GeglRectangle
get_cached_region (GeglOperation *operation, const GeglRectangle *roi)
{
  return get_bounding_box (operation);
}

static gboolean
process (GeglOperation *operation, GeglBuffer *output, const GeglRectangle *roi, gint level)
{
  Source       *source = get_source (operation);
  bool          colours = GEGL_PROPERTIES (operation)->content == CELD_LOAD_COLOURS;
  GeglRectangle all = get_bounding_box (operation);
  float        *pixels = g_try_malloc_n ((gsize) all.width * (gsize) all.height, (colours ? 4 : 1) * sizeof (float));
  CeldIoError   error = { .text = "There is not enough memory." };
  bool          read;

  read = pixels && (colours ? celd_io_read_colours (source->file, source->part, pixels, &error)
                            : celd_io_read_values (source->file, source->part, pixels, &error));
  if (read)
    gegl_buffer_set (output, &all, 0, gegl_operation_get_format (operation, "output"), pixels, GEGL_AUTO_ROWSTRIDE);
  else
    g_message ("Load Layer: %s", error.text);
  g_free (pixels);
  return read;
}

static void
finalize (GObject *object)
{
  source_free (GEGL_PROPERTIES (object)->user_data);
  G_OBJECT_CLASS (gegl_op_parent_class)->finalize (object);
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  GeglOperationClass *operation_class = GEGL_OPERATION_CLASS (klass);

  G_OBJECT_CLASS (klass)->finalize    = finalize;
  klass->parent_class.process         = process;
  operation_class->prepare            = prepare;
  operation_class->get_bounding_box   = get_bounding_box;
  operation_class->get_cached_region  = get_cached_region;

  gegl_operation_class_set_keys (operation_class,
    "name",        "celdepth:oiio-load",
    "title",       "Load Layer",
    "categories",  "input",
    "description", "Reads a layer of a PSD, ORA or KRA, or a part of an EXR or TIFF, by name or number",
    NULL);
}

#endif
