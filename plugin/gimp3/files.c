/* Files that are written: which one, and checks before anything takes time.
 *
 * A file is remembered with its image as long as that is open, and not in the image's own file, since folders are no
 * one else's business.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <glib/gstdio.h>
#include <string.h>

#include "on-demand.h"

/* ------------------------------------------------------------------ remembering */

/* Beside the image's own file, with its name; NULL if it has none yet. */
static GFile *
usual_file (GimpImage *image, const char *ending)
{
  GFile *own = gimp_image_get_file (image), *folder = own ? g_file_get_parent (own) : NULL, *file = NULL;
  char  *name = own ? g_file_get_basename (own) : NULL, *dot = name ? strrchr (name, '.') : NULL;

  if (dot && dot > name)
    *dot = 0;
  if (folder)
    {
      char *whole = g_strconcat (name, ending, NULL);

      file = g_file_get_child (folder, whole);
      g_free (whole);
    }
  g_clear_object (&folder);
  g_free (name);
  return file;
}

static GFile *
remembered_file (GimpImage *image, const char *name)
{
  GimpParasite *parasite = gimp_image_get_parasite (image, name);
  guint32       size = 0;
  const char   *uri = parasite ? gimp_parasite_get_data (parasite, &size) : NULL;
  GFile        *file = size && !uri[size - 1] ? g_file_new_for_uri (uri) : NULL;

  if (parasite)
    gimp_parasite_free (parasite);
  return file;
}

void
celd_file_recall (GimpImage *image, GimpProcedureConfig *config, const CeldProcedure *p)
{
  GFile *file = remembered_file (image, p->name);

  if (!file)
    file = usual_file (image, p->file_ending);
  g_object_set (config, "file", file, NULL);
  g_clear_object (&file);
}

void
celd_file_remember (GimpImage *image, GimpProcedureConfig *config, const CeldProcedure *p)
{
  GFile        *file = NULL;
  char         *uri;
  GimpParasite *parasite;

  g_object_get (config, "file", &file, NULL);
  uri      = g_file_get_uri (file);
  parasite = gimp_parasite_new (p->name, 0, (guint32) strlen (uri) + 1, uri);
  gimp_image_attach_parasite (image, parasite);
  gimp_parasite_free (parasite);
  g_free (uri);
  g_object_unref (file);
}

/* ------------------------------------------------------------------ checks */

static gboolean
refuse (GError **error, const char *format, const char *name)
{
  g_set_error (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED, format, name);
  return FALSE;
}

/* GIMP itself refuses folders. */
static gboolean
check_folder (const char *path, GError **error)
{
  char    *folder = g_path_get_dirname (path);
  gboolean good = g_file_test (folder, G_FILE_TEST_IS_DIR) ||
                  refuse (error, _ ("There is no folder \"%s\". Choose another one, or make it first."), folder);

  good = good && (!g_access (folder, W_OK) ||
                  refuse (error, _ ("Nothing can be written into the folder \"%s\". Choose another one."), folder));

  g_free (folder);
  return good;
}

char *
celd_file_chosen (GimpProcedureConfig *config, gboolean (*can_write) (const char *path), const char *endings,
                  GError **error)
{
  GFile      *file = NULL;
  char       *path;
  CeldIoError why;

  g_object_get (config, "file", &file, NULL);
  path = file ? g_file_get_path (file) : NULL;
  g_clear_object (&file);
  if (!path)
    refuse (error, _ ("No file is chosen, or it is not on this computer. Give the name of a file that ends in "
                      "%s."), _ (endings));
  else if (!celd_io_load (&why))
    refuse (error, "%s", why.text);
  else if (!can_write (path))
    g_set_error (error, CELD_PIPELINE_ERROR, CELD_PIPELINE_FAILED,
                 _ ("\"%s\" cannot be written: its name must end in %s."), path, _ (endings));
  else if (check_folder (path, error))
    return path;
  g_free (path);
  return NULL;
}
