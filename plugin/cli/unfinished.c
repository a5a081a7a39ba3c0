/* Files that are being written.  They have another name until they are complete, or until all results of a page are; a
 * run that is killed leaves them behind.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "outputs.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <unistd.h>

#define ENDING ".new-" /* and the process; the files that celdepth-io.h writes have it too */

char *
cli_unfinished_name (const char *path)
{
  return g_strdup_printf ("%s" ENDING "%d", path, (int) getpid ());
}

void
cli_remove_unfinished (const char *path)
{
  char       *folder = g_path_get_dirname (path), *name = g_path_get_basename (path);
  char       *prefix = g_strconcat (name, ENDING, NULL);
  GDir       *dir = g_dir_open (folder, 0, NULL);
  const char *entry;

  while (dir && (entry = g_dir_read_name (dir)))
    if (g_str_has_prefix (entry, prefix))
      {
        char *unfinished = g_build_filename (folder, entry, NULL);

        g_unlink (unfinished);
        g_free (unfinished);
      }
  if (dir)
    g_dir_close (dir);
  g_free (prefix);
  g_free (name);
  g_free (folder);
}

/* ------------------------------------------------------------------ completing */

typedef struct { char *unfinished, *path; } Held;

static GArray     *held;  /* in the order in which they were written; NULL: files are completed at once */
static GHashTable *owned; /* the folders of this run, by identity, with the names in them */

static GPtrArray *
names_in (const char *folder)
{
  GPtrArray  *names = g_ptr_array_new_with_free_func (g_free);
  GDir       *dir = g_dir_open (folder, 0, NULL);
  const char *entry;

  while (dir && (entry = g_dir_read_name (dir)))
    g_ptr_array_add (names, g_strdup (entry));
  if (dir)
    g_dir_close (dir);
  return names;
}

static const GPtrArray *
names_owned (const char *folder)
{
  char            *identity = cli_file_identity (folder);
  const GPtrArray *names = owned ? g_hash_table_lookup (owned, identity) : NULL;

  g_free (identity);
  return names;
}

bool
cli_file_owns (const char *folder)
{
  return names_owned (folder) != NULL;
}

/* Removes a file, or a folder with the files of these names in it and no others. */
static void
remove_all (const char *path, const GPtrArray *names)
{
  for (guint i = 0; i < names->len; i++)
    {
      char *file = g_build_filename (path, names->pdata[i], NULL);

      g_unlink (file);
      g_free (file);
    }
  g_remove (path);
}

/* Moves new files into a folder that this run has written, and removes those before that are not among them. */
static bool
renew_folder (const char *unfinished, const char *path, const GPtrArray *names, const GPtrArray *before)
{
  bool good = true;

  for (guint i = 0; i < names->len && good; i++)
    {
      char *from = g_build_filename (unfinished, names->pdata[i], NULL);
      char *to = g_build_filename (path, names->pdata[i], NULL);

      good = !g_rename (from, to);
      g_free (from);
      g_free (to);
    }
  for (guint i = 0; i < before->len && good; i++)
    if (!g_ptr_array_find_with_equal_func ((GPtrArray *) names, before->pdata[i], g_str_equal, NULL))
      {
        char *old = g_build_filename (path, before->pdata[i], NULL);

        g_unlink (old);
        g_free (old);
      }
  return good && !g_rmdir (unfinished);
}

static bool
complete_folder (const char *unfinished, const char *path)
{
  GPtrArray       *names = names_in (unfinished);
  const GPtrArray *before = names_owned (path);
  bool             good = before ? renew_folder (unfinished, path, names, before) : !g_rename (unfinished, path);

  if (!owned)
    owned = g_hash_table_new_full (g_str_hash, g_str_equal, g_free, (GDestroyNotify) g_ptr_array_unref);
  if (good)
    g_hash_table_insert (owned, cli_file_identity (path), names);
  else
    g_ptr_array_unref (names);
  return good;
}

static bool
complete (const char *unfinished, const char *path)
{
  return g_file_test (unfinished, G_FILE_TEST_IS_DIR) ? complete_folder (unfinished, path)
                                                      : !g_rename (unfinished, path);
}

bool
cli_file_complete (const char *unfinished, const char *path)
{
  if (!held)
    return complete (unfinished, path);
  g_array_append_val (held, ((Held) { g_strdup (unfinished), g_strdup (path) }));
  return true;
}

void
cli_files_hold (void)
{
  held = g_array_new (FALSE, FALSE, sizeof (Held));
}

int
cli_files_end (int code)
{
  bool good = code == CLI_DONE || code == CLI_CONTRADICTED;

  for (guint i = 0; i < held->len; i++)
    {
      Held *file = &g_array_index (held, Held, i);

      if (good && !complete (file->unfinished, file->path))
        {
          good = cli_error ("Cannot write \"%s\": %s.", file->path, g_strerror (errno));
          code = CLI_FAILED;
        }
      if (!good)
        {
          GPtrArray *names = names_in (file->unfinished);

          remove_all (file->unfinished, names);
          g_ptr_array_unref (names);
        }
      g_free (file->unfinished);
      g_free (file->path);
    }
  g_clear_pointer (&held, g_array_unref);
  return code;
}
