/* celdepth:oiio-save: writes depth, normals, light or colours to a file, in the channels that other programs expect.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "oiio.h"

#ifdef GEGL_PROPERTIES

property_string (path, "File", "")
    description ("The file to write; its ending chooses the format: .exr, .png, .tif")

property_enum (content, "Content", CeldSaveContent, celd_save_content, CELD_SAVE_DEPTH)
    description ("The content of the picture: depth (in EXR Z and depth.V), normals (in EXR N.X, N.Y, N.Z), linear "
                 "light, or colours")

property_double (near_level, "Near level", 1.0)
    description ("The depth that is nearest in the file: 1, or with ranks the largest rank")
    ui_range (0.0, 20.0)
    ui_meta ("visible", "content {depth}")

property_double (far_level, "Far level", 0.0)
    description ("The depth that is farthest in the file")
    ui_range (0.0, 20.0)
    ui_meta ("visible", "content {depth}")

#else

#define GEGL_OP_SINK
#define GEGL_OP_NAME     celdepth_oiio_save
#define GEGL_OP_C_SOURCE celdepth-oiio-save.c
#define GEGL_OP_BUNDLE

#include <gegl-op.h>

/* ------------------------------------------------------------------ writers, by content; pixels are tight */

typedef bool (*Write) (GeglProperties *o, int width, int height, void *pixels, CeldIoError *error);

static bool
write_colours (GeglProperties *o, int width, int height, void *pixels, CeldIoError *error)
{
  CeldPaint paint = { width, height, (size_t) width, pixels };

  return celd_io_write_paint (o->path, &paint, error);
}

static bool
write_depth (GeglProperties *o, int width, int height, void *pixels, CeldIoError *error)
{
  CeldPlane depth = { width, height, (size_t) width, pixels };

  return celd_io_write_depth (o->path, &depth, (float) o->far_level, (float) o->near_level, error);
}

static bool
write_normals (GeglProperties *o, int width, int height, void *pixels, CeldIoError *error)
{
  CeldVectors normals = { width, height, (size_t) width, pixels };

  for (size_t i = 0; i < 3 * (size_t) width * (size_t) height; i++)
    normals.data[i] = 2 * normals.data[i] - 1; /* operations store them as 0.5 + 0.5 n */
  return celd_io_write_normals (o->path, &normals, error);
}

static bool
write_light (GeglProperties *o, int width, int height, void *pixels, CeldIoError *error)
{
  CeldPlane light = { width, height, (size_t) width, pixels };

  return celd_io_write_light (o->path, &light, error);
}

static const struct { const char *format; gsize bytes; Write write; } writers[] = {
  [CELD_SAVE_COLOURS] = { "R'G'B'A u8", 4,                 write_colours },
  [CELD_SAVE_DEPTH]   = { "Y float",    sizeof (float),     write_depth },
  [CELD_SAVE_NORMALS] = { "RGB float",  3 * sizeof (float), write_normals },
  [CELD_SAVE_LIGHT]   = { "Y float",    sizeof (float),     write_light },
};

/* ------------------------------------------------------------------ the operation */

static bool
save (GeglProperties *o, GeglBuffer *input, const GeglRectangle *roi, CeldIoError *error)
{
  void *pixels = g_try_malloc_n ((gsize) roi->width * (gsize) roi->height, writers[o->content].bytes);
  bool  written;

  if (!pixels)
    {
      g_strlcpy (error->text, "There is not enough memory.", sizeof error->text);
      return false;
    }
  gegl_buffer_get (input, roi, 1.0, babl_format (writers[o->content].format), pixels,
                   GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  written = writers[o->content].write (o, roi->width, roi->height, pixels, error);
  g_free (pixels);
  return written;
}

static bool
check (const GeglProperties *o, const GeglRectangle *roi, CeldIoError *error)
{
  if (!celd_io_load (error))
    return false;
  if (!o->path || !celd_io_can_write (o->path))
    g_snprintf (error->text, sizeof error->text, "'%s' cannot be written: its name must end in .exr, .png or .tif.",
                o->path ? o->path : "");
  else if (o->content == CELD_SAVE_DEPTH && !(o->near_level > o->far_level))
    g_strlcpy (error->text, "The near level must be larger than the far level.", sizeof error->text);
  else if (gegl_rectangle_is_infinite_plane (roi))
    g_strlcpy (error->text, "The input is infinitely large. Crop it first.", sizeof error->text);
  else
    return true;
  return false;
}

static gboolean
process (GeglOperation *operation, GeglBuffer *input, const GeglRectangle *roi, gint level)
{
  GeglProperties *o = GEGL_PROPERTIES (operation);
  CeldIoError     error;
  bool            written = check (o, roi, &error) && save (o, input, roi, &error);

  if (!written)
    g_message ("Save Depth: %s", error.text);
  return written;
}

static void
gegl_op_class_init (GeglOpClass *klass)
{
  klass->parent_class.process    = process;
  klass->parent_class.needs_full = TRUE;

  gegl_operation_class_set_keys (GEGL_OPERATION_CLASS (klass),
    "name",        "celdepth:oiio-save",
    "title",       "Save Depth",
    "categories",  "output",
    "description", "Writes depth, normals, light or colours as EXR with named channels, or as PNG or TIFF",
    NULL);
}

#endif
