/* Reads whole files, and says why one cannot be read.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <errno.h>
#include <stdio.h>
#include <sys/stat.h>

#define START 65536 /* bytes for a file whose size is not known, to begin with (chosen) */

/* The system calls it a directory, where pictures are called a folder, and a file that is not open a bad descriptor. */
const char *
cli_file_reason (int code)
{
  return code == EISDIR ? "it is a folder" : code == EBADF ? "it is closed" : g_strerror (code);
}

/* Reads all bytes, but no more than `most` and one that says that there are too many: a device may have no end.  NULL,
 * and errno, if that fails. */
static char *
read_bytes (FILE *file, gsize most, gsize *length)
{
  struct stat about;
  gsize       room = !fstat (fileno (file), &about) && S_ISREG (about.st_mode) ? (gsize) about.st_size + 2 : START;
  char       *bytes = g_try_malloc (MIN (room, most + 2));

  *length = 0;
  while (bytes)
    {
      gsize limit = MIN (room, most + 2) - 1; /* with room for a NUL */
      char *more;

      *length += fread (bytes + *length, 1, limit - *length, file);
      if (*length < limit || limit > most)
        break;
      room *= 2;
      more = g_try_realloc (bytes, MIN (room, most + 2));
      if (!more)
        g_free (bytes);
      bytes = more;
    }
  if (!bytes)
    errno = ENOMEM;
  else if (ferror (file))
    g_clear_pointer (&bytes, g_free);
  else
    bytes[*length] = 0;
  return bytes;
}

char *
cli_file_read (const char *path, gsize most, bool quiet, gsize *length)
{
  FILE *file = fopen (path, "rb");
  char *bytes = file ? read_bytes (file, most, length) : NULL;
  int   reason = errno;

  if (file)
    fclose (file);
  if (bytes && *length <= most)
    return bytes;
  if (!quiet && bytes)
    cli_say ("Cannot read \"%s\": it is larger than %" G_GSIZE_FORMAT " MiB.", path, most >> 20);
  else if (!quiet)
    cli_say ("Cannot read \"%s\": %s.", path, cli_file_reason (reason));
  g_free (bytes);
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
  return cli_file_reason (code);
}
