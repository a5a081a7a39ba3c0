/* Standard input and output by the name "-".  Pictures are read and written by name, so that "-" stands for a file in a
 * folder of its own, which is read from standard input before the work, or copied to standard output after it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define CHUNK 65536 /* bytes that are copied at a time */

/* Copies all of a file to another one. */
static bool
copy (FILE *from, FILE *to)
{
  char  *bytes = g_malloc (CHUNK);
  size_t n;
  bool   good = true;

  while (good && (n = fread (bytes, 1, CHUNK, from)) > 0)
    good = fwrite (bytes, 1, n, to) == n;
  good = good && !ferror (from) && !fflush (to);
  g_free (bytes);
  return good;
}

static bool
make_folder (CliStreams *streams)
{
  if (!streams->folder)
    {
      char *name = g_build_filename (g_get_tmp_dir (), "celdepth-XXXXXX", NULL);

      streams->folder = g_mkdtemp (name);
      if (!streams->folder)
        {
          cli_say ("Cannot make a folder in \"%s\": %s.", g_get_tmp_dir (), g_strerror (errno));
          g_free (name);
        }
    }
  cli_say_without (streams->folder);
  return streams->folder;
}

/* The ending of a file with this content, by its first bytes; other files need none. */
static const char *
ending_of (const char *path)
{
  static const struct { const char *ending; size_t n; const char *bytes; } kinds[] = {
    { ".png", 4, "\x89PNG" }, { ".jpg", 2, "\xff\xd8" }, { ".tif", 4, "II*\0" }, { ".tif", 4, "MM\0*" },
    { ".exr", 4, "v/1\x01" }, { ".psd", 4, "8BPS" }, { ".npy", 6, "\x93NUMPY" }, { ".gif", 4, "GIF8" },
    { ".ora", 4, "PK\3\4" }, { ".webp", 4, "RIFF" }, { ".bmp", 2, "BM" },
  };
  char   start[8] = { 0 };
  FILE  *file = g_fopen (path, "rb");
  size_t n = file ? fread (start, 1, sizeof start, file) : 0;

  if (file)
    fclose (file);
  for (size_t i = 0; i < G_N_ELEMENTS (kinds); i++)
    if (n >= kinds[i].n && !memcmp (start, kinds[i].bytes, kinds[i].n))
      return kinds[i].ending;
  return "";
}

bool
cli_stream_input (CliStreams *streams, const char *what, char **name)
{
  char *path, *with_ending;
  FILE *file;
  bool  good;

  if (streams->reader)
    return cli_error ("%s and %s cannot both be read from standard input.", streams->reader, what);
  if (!make_folder (streams))
    return false;
  streams->reader = g_strdup (what);
  path = g_build_filename (streams->folder, "standard input", NULL);
  file = g_fopen (path, "wb");
  good = file && copy (stdin, file);
  good = file && !fclose (file) && good;
  if (!good)
    cli_say ("Cannot read standard input: %s.", g_strerror (errno));
  with_ending = g_strconcat (path, ending_of (path), NULL);
  good = good && !g_rename (path, with_ending);
  g_free (path);
  g_free (*name);
  *name = with_ending;
  return good;
}

bool
cli_stream_output (CliStreams *streams, const char *what, const char *ending, bool text, char **name)
{
  char *base;

  if (streams->writer)
    return cli_error ("%s and %s cannot both be written to standard output.", streams->writer, what);
  if (!text && isatty (STDOUT_FILENO))
    return cli_error ("Standard output is a terminal, which cannot show %s: redirect it to a file or another program.",
                      what);
  if (!make_folder (streams))
    return false;
  streams->writer = g_strdup (what);
  base = ending ? g_strdup_printf ("standard output.%s", ending) : g_strdup ("standard output");
  g_free (*name);
  *name = g_build_filename (streams->folder, base, NULL);
  streams->output = g_strdup (*name);
  g_free (base);
  return true;
}

bool
cli_streams_write (CliStreams *streams)
{
  char *unfinished = streams->output ? cli_unfinished_name (streams->output) : NULL;
  FILE *file = unfinished ? g_fopen (unfinished, "rb") : NULL;
  bool  good;

  if (!file && streams->output)
    file = g_fopen (streams->output, "rb");
  good = !streams->output || (file && copy (file, stdout));
  if (file)
    fclose (file);
  g_free (unfinished);
  return good || cli_error ("Cannot write standard output: %s.", g_strerror (errno));
}

void
cli_streams_clear (CliStreams *streams)
{
  GDir       *dir = streams->folder ? g_dir_open (streams->folder, 0, NULL) : NULL;
  const char *entry;

  while (dir && (entry = g_dir_read_name (dir)))
    {
      char *path = g_build_filename (streams->folder, entry, NULL);

      g_unlink (path);
      g_free (path);
    }
  if (dir)
    g_dir_close (dir);
  if (streams->folder)
    g_rmdir (streams->folder);
  cli_say_without (NULL);
  g_free (streams->folder);
  g_free (streams->reader);
  g_free (streams->writer);
  g_free (streams->output);
}
