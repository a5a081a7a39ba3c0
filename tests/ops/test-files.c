/* oiio-load and oiio-save: pictures are read as they were written, and errors are reported.
 *
 *   test-files EXAMPLES    the folder of the examples, for a PSD with layers
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "listen.h"
#include "page.h"

#include <glib/gstdio.h>
#include <signal.h>
#include <unistd.h>

static const char *examples;
static char       *folder;
static float       result[4 * PIXELS], depth[PIXELS];

static char *
file (const char *name)
{
  return g_build_filename (folder, name, NULL);
}

/* Saves a picture as the page's folder/name. */
static void
save (GeglBuffer *picture, const char *name, const char *property, ...)
{
  GeglNode *graph = gegl_node_new (), *node = add_operation (graph, "celdepth:oiio-save", (Pads) { { picture } });
  char     *path = file (name);
  va_list   properties;

  gegl_node_set (node, "path", path, NULL);
  va_start (properties, property);
  gegl_node_set_valist (node, property, properties);
  va_end (properties);
  gegl_node_process (node);
  g_free (path);
  g_object_unref (graph);
}

static void
load (const char *name, const char *content, const char *format, float *pixels)
{
  GeglNode *graph = gegl_node_new (), *node = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", NULL);
  char     *path = file (name);

  gegl_node_set (node, "path", path, "content", !strcmp (content, "depth"), NULL);
  get_output (node, format, pixels);
  g_free (path);
  g_object_unref (graph);
}

static void
depth_is_read_as_it_was_written (void)
{
  static const struct { const char *name; double error; } cases[] = {
    { "d.exr", 1e-6 }, { "d.tif", 0 }, { "d.png", 2e-4 },
  };
  GeglBuffer *picture;

  for (int i = 0; i < PIXELS; i++)
    depth[i] = 7 * (float) i / PIXELS;
  picture = page_buffer ("Y float", "Y float", depth);
  for (size_t i = 0; i < G_N_ELEMENTS (cases); i++)
    {
      be_quiet ();
      save (picture, cases[i].name, "content", 1, "near-level", 7.0, NULL);
      load (cases[i].name, "depth", "Y float", result);
      NEAR (difference (result, depth, PIXELS), 0, cases[i].error);
      CHECK (times_said == 0 && warnings == 0);
    }
  g_object_unref (picture);
}

/* A PNG of normals has the numbers of the operations. */
static void
normals_keep_their_numbers (void)
{
  static float normals[3 * PIXELS];
  GeglBuffer  *picture;

  for (int i = 0; i < 3 * PIXELS; i++)
    normals[i] = (float) (i % 97) / 96;
  picture = page_buffer ("RGB float", "RGB float", normals);
  save (picture, "n.png", "content", 2, NULL);
  load ("n.png", "colours", "R'G'B' float", result);
  NEAR (difference (result, normals, 3 * PIXELS), 0, 1e-4);
  g_object_unref (picture);
}

static void
labels_keep_their_colours (void)
{
  static float wanted[4 * PIXELS];

  gegl_buffer_get (scribbles, NULL, 1.0, babl_format ("R'G'B'A float"), wanted, GEGL_AUTO_ROWSTRIDE, GEGL_ABYSS_NONE);
  save (scribbles, "l.png", "content", 0, NULL);
  load ("l.png", "colours", "R'G'B'A float", result);
  NEAR (difference (result, wanted, 4 * PIXELS), 0, 1e-6);
  save (scribbles, "l.exr", "content", 0, NULL); /* linear light */
  load ("l.exr", "colours", "R'G'B'A float", result);
  NEAR (difference (result, wanted, 4 * PIXELS), 0, 1e-3);
}

/* How many pixels of two graphs differ by more than one step of 8 bits. */
static int
differing (GeglNode *a, GeglNode *b)
{
  GeglRectangle size = gegl_node_get_bounding_box (a), other = gegl_node_get_bounding_box (b);
  gsize         n = (gsize) size.width * (gsize) size.height * 4;
  uint8_t      *p = g_malloc (n), *q = g_malloc (n);
  int           different = 0;

  CHECK (gegl_rectangle_equal (&size, &other) && n > 0);
  gegl_node_blit (a, 1.0, &size, babl_format ("R'aG'aB'aA u8"), p, GEGL_AUTO_ROWSTRIDE, GEGL_BLIT_DEFAULT);
  gegl_node_blit (b, 1.0, &size, babl_format ("R'aG'aB'aA u8"), q, GEGL_AUTO_ROWSTRIDE, GEGL_BLIT_DEFAULT);
  for (gsize i = 0; i < n; i++)
    different += ABS (p[i] - q[i]) > 1;
  g_free (p);
  g_free (q);
  return different;
}

/* The PSD of the examples has the layers that lie beside it as PNG. */
static void
layers_are_found_by_name (void)
{
  static const char *const layers[] = { "drawing", "scribbles", "arrows" };
  char                    *psd = g_build_filename (examples, "monkey", "monkey.psd", NULL);

  for (size_t i = 0; i < G_N_ELEMENTS (layers); i++)
    {
      GeglNode *graph = gegl_node_new (), *layer, *alone;
      char     *name = g_strconcat (layers[i], ".png", NULL), *png = g_build_filename (examples, "monkey", name, NULL);

      layer = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", "path", psd, "layer", layers[i], NULL);
      alone = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", "path", png, NULL);
      CHECK (differing (layer, alone) == 0);
      g_free (name);
      g_free (png);
      g_object_unref (graph);
    }
  g_free (psd);
}

/* Krita has saved a page in its own format and as OpenRaster. */
static void
documents_of_painting_programs_have_layers (void)
{
  static const char *const layers[] = { "drawing", "scribbles" };
  char *saved = g_build_filename (examples, "..", "tests", "io", "layered", NULL);
  char *ora = g_build_filename (saved, "krita.ora", NULL), *kra = g_build_filename (saved, "krita.kra", NULL);

  for (size_t i = 0; i < G_N_ELEMENTS (layers); i++)
    {
      GeglNode *graph = gegl_node_new ();
      GeglNode *one = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", "path", ora, "layer", layers[i],
                                           NULL);
      GeglNode *other = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", "path", kra, "layer", layers[i],
                                             NULL);

      CHECK (gegl_node_get_bounding_box (one).width == 96);
      CHECK (differing (one, other) == 0);
      g_object_unref (graph);
    }
  g_free (ora);
  g_free (kra);
  g_free (saved);
}

static void
unreadable_files_give_a_message (void)
{
  GeglNode *graph = gegl_node_new (), *node = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", NULL);
  char     *psd = g_build_filename (examples, "monkey", "monkey.psd", NULL);

  be_quiet ();
  gegl_node_set (node, "path", "/no/such.psd", NULL);
  gegl_node_get_bounding_box (node);
  gegl_node_get_bounding_box (node);
  CHECK (times_said == 1 && SAYS ("/no/such.psd"));
  be_quiet ();
  gegl_node_set (node, "path", psd, "layer", "shadows", NULL);
  gegl_node_get_bounding_box (node);
  CHECK (times_said == 1 && SAYS ("shadows") && SAYS ("scribbles")); /* what it has instead */
  CHECK (warnings == 0);
  g_free (psd);
  g_object_unref (graph);
}

/* Ends the processes that read for this one: their environment has its folder. */
static int
kill_readers (void)
{
  GDir       *processes = g_dir_open ("/proc", 0, NULL);
  const char *name;
  int         killed = 0;

  while ((name = g_dir_read_name (processes)))
    {
      int   process = atoi (name);
      char *path = g_build_filename ("/proc", name, "environ", NULL), *all = NULL;
      gsize size = 0;
      bool  ours = false;

      if (process > 0 && process != getpid () && g_file_get_contents (path, &all, &size, NULL))
        for (const char *setting = all; setting < all + size; setting += strlen (setting) + 1)
          ours = ours || g_str_has_suffix (setting, folder);
      if (ours)
        killed += kill (process, SIGKILL) == 0;
      g_free (all);
      g_free (path);
    }
  g_dir_close (processes);
  return killed;
}

/* After a crash of the reading process there is one message, and the next file can be read. */
static void
a_crash_of_the_reader_gives_a_message (void)
{
  GeglNode     *graph = gegl_node_new (), *node = gegl_node_new_child (graph, "operation", "celdepth:oiio-load", NULL);
  char         *psd = g_build_filename (examples, "monkey", "monkey.psd", NULL);
  GeglRectangle box;

  be_quiet ();
  gegl_node_set (node, "path", psd, NULL);
  box = gegl_node_get_bounding_box (node);
  CHECK (box.width > 0 && times_said == 0);
  CHECK (kill_readers () >= 1);
  gegl_node_process (node);
  CHECK (times_said == 1 && SAYS ("monkey.psd") && SAYS ("crashed") && warnings == 0);
  be_quiet ();
  gegl_node_set (node, "part", 1, NULL);
  box = gegl_node_get_bounding_box (node);
  gegl_node_process (node);
  CHECK (box.width > 0 && times_said == 0 && warnings == 0);
  g_free (psd);
  g_object_unref (graph);
}

static void
unwritable_files_give_a_message (void)
{
  be_quiet ();
  save (drawing, "d.jpeg2000", NULL);
  CHECK (times_said == 1 && SAYS ("d.jpeg2000") && SAYS (".exr"));
  be_quiet ();
  save (drawing, "no/folder/d.png", NULL);
  CHECK (times_said == 1 && SAYS ("no/folder"));
  be_quiet ();
  save (drawing, "d.exr", "near-level", 0.0, NULL);
  CHECK (times_said == 1 && SAYS ("near level"));
  CHECK (warnings == 0);
}

static void
remove_folder (void)
{
  GDir       *directory = g_dir_open (folder, 0, NULL);
  const char *name;

  while ((name = g_dir_read_name (directory)))
    {
      char *path = file (name);

      g_unlink (path);
      g_free (path);
    }
  g_dir_close (directory);
  g_rmdir (folder);
  g_free (folder);
}

/* ------------------------------------------------------------------ the start of hosts */

static gboolean
is_loaded (const char *library)
{
  char    *maps = NULL;
  gboolean loaded = g_file_get_contents ("/proc/self/maps", &maps, NULL, NULL) && strstr (maps, library);

  g_free (maps);
  return loaded;
}

/* Every host pays at its start for what modules load.  In this program nothing was read or written before. */
static void
hosts_start_without_libraries_for_files (void)
{
  CHECK (gegl_has_operation ("celdepth:oiio-save"));
  CHECK (is_loaded ("celdepth-oiio"));
  CHECK (!is_loaded ("libOpenImageIO"));
  save (drawing, "first.exr", NULL);
  CHECK (is_loaded ("libOpenImageIO"));
}

int
main (int argc, char **argv)
{
  int failed;

  gegl_init (&argc, &argv);
  examples = argc > 1 ? argv[1] : "examples";
  folder = g_dir_make_tmp ("celdepth-XXXXXX", NULL);
  g_setenv ("CELDEPTH_TEST_FOLDER", folder, TRUE);
  make_page ();
  start_to_listen ();
  RUN (hosts_start_without_libraries_for_files);
  RUN (depth_is_read_as_it_was_written);
  RUN (normals_keep_their_numbers);
  RUN (labels_keep_their_colours);
  RUN (layers_are_found_by_name);
  RUN (documents_of_painting_programs_have_layers);
  RUN (unreadable_files_give_a_message);
  RUN (a_crash_of_the_reader_gives_a_message);
  RUN (unwritable_files_give_a_message);
  failed = DONE;
  stop_to_listen ();
  remove_folder ();
  drop_page ();
  gegl_exit ();
  return failed;
}
