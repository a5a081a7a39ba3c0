/* Files that are being written.  They have another name until they are complete; a run that is killed leaves them
 * behind.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

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
