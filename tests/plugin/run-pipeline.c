/* Runs the pipeline of the plug-ins on an example, and writes each picture as numbers, four 32-bit floats a pixel in
 * linear light.
 *
 *   run-pipeline OUT NAME=FILE...     NAME is drawing, scribbles, arrows, ...; writes OUT/PICTURE.raw
 *
 * Also writes the views of both eyes, OUT/left.raw and OUT/right.raw, and files: OUT/saved.exr, OUT/saved.png,
 * and the models OUT/parts.glb, OUT/parts.stl and OUT/surface.obj.
 *
 * Scribbles and arrows are cropped to what is painted, and given with their offset, as layers of a host are.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "pipeline.h"

#include <stdio.h>
#include <string.h>

static const char *const roles[CELD_N_LAYERS] = { "drawing", "scribbles", "arrows", "contours", "corrections",
                                                  "hidden" };
static const char *const pictures[CELD_N_PICTURES] = { "regions", "levels", "depth", "normals", "shading", "lit",
                                                       "enhanced", "suggestions" };

static GeglBuffer *
load (const char *path)
{
  GeglBuffer *buffer = NULL;
  GeglNode   *graph = gegl_node_new ();
  GeglNode   *source = gegl_node_new_child (graph, "operation", "gegl:load", "path", path, NULL);
  GeglNode   *sink = gegl_node_new_child (graph, "operation", "gegl:buffer-sink", "buffer", &buffer, NULL);

  gegl_node_link (source, sink);
  gegl_node_process (sink);
  g_object_unref (graph);
  return buffer;
}

/* The part of a layer that is painted, in a buffer that begins at 0,0. */
static CeldPipelineLayer
crop (GeglBuffer *whole)
{
  const GeglRectangle *r = gegl_buffer_get_extent (whole);
  GeglRectangle        box = { r->width, r->height, 0, 0 };
  guint8              *pixels = g_malloc (4 * (gsize) r->width * (gsize) r->height);
  CeldPipelineLayer    layer;

  gegl_buffer_get (whole, r, 1, babl_format ("R'G'B'A u8"), pixels, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  for (int y = 0; y < r->height; y++)
    for (int x = 0; x < r->width; x++)
      if (pixels[4 * (y * r->width + x) + 3])
        gegl_rectangle_bounding_box (&box, &box, GEGL_RECTANGLE (x, y, 1, 1));
  layer = (CeldPipelineLayer) { gegl_buffer_new (GEGL_RECTANGLE (0, 0, box.width, box.height),
                                                 babl_format ("R'G'B'A u8")), box.x, box.y, 0 };
  gegl_buffer_copy (whole, &box, GEGL_ABYSS_NONE, layer.buffer, GEGL_RECTANGLE (0, 0, 0, 0));
  g_object_unref (whole);
  g_free (pixels);
  return layer;
}

static void
write_raw (const char *folder, const char *name, GeglBuffer *buffer)
{
  const GeglRectangle *r = gegl_buffer_get_extent (buffer);
  gsize                size = 4 * sizeof (float) * (gsize) r->width * (gsize) r->height;
  float               *pixels = g_malloc (size);
  char                *path = g_strdup_printf ("%s/%s.raw", folder, name);

  gegl_buffer_get (buffer, r, 1, babl_format ("RGBA float"), pixels, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  g_file_set_contents (path, (char *) pixels, (gssize) size, NULL);
  g_free (path);
  g_free (pixels);
}

static GeglBuffer *
new_picture (const CeldPipelineInput *input)
{
  return gegl_buffer_new (GEGL_RECTANGLE (0, 0, input->width, input->height), babl_format ("RGBA float"));
}

static gboolean
write_views (CeldPipeline *pipeline, const CeldPipelineInput *input, const char *folder, GError **error)
{
  gboolean good = celd_pipeline_view (pipeline, NULL, NULL, error);

  for (int i = 0; i < 2 && good; i++)
    {
      GeglBuffer *buffer = new_picture (input);

      good = celd_pipeline_write_views (pipeline, i ? CELD_STEREO_RIGHT : CELD_STEREO_LEFT, buffer, error);
      write_raw (folder, i ? "right" : "left", buffer);
      g_object_unref (buffer);
    }
  return good;
}

/* The surface needs another pipeline, since its settings say so. */
static gboolean
write_files (CeldPipeline *pipeline, CeldPipelineInput *input, const char *folder, GError **error)
{
  char         *path[5];
  CeldPipeline *other;
  gboolean      good;

  for (int i = 0; i < 5; i++)
    path[i] = g_strdup_printf ("%s/%s", folder, (const char *[]) { "saved.exr", "saved.png", "parts.glb", "parts.stl",
                                                                   "surface.obj" }[i]);
  input->settings.mesh_kind = CELD_MESH_HEIGHTFIELD;
  other = celd_pipeline_new (input, error);
  good  = celd_pipeline_save (pipeline, CELD_PICTURE_LEVELS, path[0], error) &&
          celd_pipeline_save (pipeline, CELD_PICTURE_DEPTH, path[1], error) &&
          celd_pipeline_save_model (pipeline, path[2], NULL, NULL, error) &&
          celd_pipeline_save_model (pipeline, path[3], NULL, NULL, error) &&
          other && celd_pipeline_save_model (other, path[4], NULL, NULL, error);
  celd_pipeline_free (other);
  for (int i = 0; i < 5; i++)
    g_free (path[i]);
  return good;
}

int
main (int argc, char **argv)
{
  CeldPipelineInput input = { .settings = celd_settings () };
  CeldPipeline     *pipeline;
  GError           *error = NULL;

  gegl_init (NULL, NULL);
  for (int i = 2; i < argc; i++)
    for (int role = 0; role < CELD_N_LAYERS; role++)
      if (g_str_has_prefix (argv[i], roles[role]) && argv[i][strlen (roles[role])] == '=')
        {
          GeglBuffer *buffer = load (argv[i] + strlen (roles[role]) + 1);

          input.layer[role] = role ? crop (buffer) : (CeldPipelineLayer) { buffer, 0, 0, 0 };
        }
  input.width  = gegl_buffer_get_width (input.layer[0].buffer);
  input.height = gegl_buffer_get_height (input.layer[0].buffer);
  pipeline     = celd_pipeline_new (&input, &error);
  if (!pipeline || !celd_pipeline_make (pipeline, (1u << CELD_N_PICTURES) - 1, NULL, NULL, &error))
    {
      fprintf (stderr, "%s\n", error->message);
      return 1;
    }
  for (int i = 0; i < CELD_N_PICTURES; i++)
    {
      GeglBuffer *buffer = new_picture (&input);

      if (!celd_pipeline_write (pipeline, (CeldPicture) i, buffer, &error))
        return 1;
      write_raw (argv[1], pictures[i], buffer);
      g_object_unref (buffer);
    }
  if (!write_views (pipeline, &input, argv[1], &error) || !write_files (pipeline, &input, argv[1], &error))
    {
      fprintf (stderr, "%s\n", error->message);
      return 1;
    }
  celd_pipeline_free (pipeline);
  for (int role = 0; role < CELD_N_LAYERS; role++)
    g_clear_object (&input.layer[role].buffer);
  gegl_exit ();
  return 0;
}
