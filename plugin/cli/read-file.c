/* Reads whole files, and says why one cannot be read.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <errno.h>
#include <stdio.h>

char *
cli_file_read (const char *path, gsize *length)
{
  char   *bytes = NULL;
  GError *error = NULL;

  if (g_file_get_contents (path, &bytes, length, &error))
    return bytes;
  cli_say ("Cannot read \"%s\": %s.", path, cli_file_problem (path));
  g_error_free (error);
  return NULL;
}

const char *
cli_file_problem (const char *path)
{
  FILE *file = fopen (path, "rb");
  char  byte;
  int   code = file && fread (&byte, 1, 1, file) == 0 && ferror (file) ? errno : file ? EIO : errno;

  if (file)
    fclose (file);
  return g_strerror (code);
}
