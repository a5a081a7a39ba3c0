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

#define CHUNK     65536               /* bytes that are copied at a time */
#define MOST_KIND ((guint64) 2 << 30)   /* bytes of standard input, if it is of a known kind: a PSD has no more */
#define MOST_ELSE ((guint64) 256 << 20) /* bytes of other standard input, such as a device without end; chosen */

/* Copies all of a file to another one, if that is no more than `most` bytes; errno says why not. */
static bool
copy (FILE *from, guint64 most, FILE *to)
{
  char   *bytes = g_malloc (CHUNK);
  guint64 all = 0;
  size_t  n;
  bool    good = true;

  while (good && (n = fread (bytes, 1, CHUNK, from)) > 0)
    {
      good = (all += n) <= most && fwrite (bytes, 1, n, to) == n;
      if (all > most)
        errno = EFBIG;
    }
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
          streams->failed = true;
        }
    }
  cli_say_without (streams->folder);
  return streams->folder;
}

/* The ending of a file that starts so; other files need none. */
static const char *
ending_of (const char *start, size_t n)
{
  static const struct { const char *ending; size_t n; const char *bytes; } kinds[] = {
    { ".png", 4, "\x89PNG" }, { ".jpg", 2, "\xff\xd8" }, { ".tif", 4, "II*\0" }, { ".tif", 4, "MM\0*" },
    { ".exr", 4, "v/1\x01" }, { ".psd", 4, "8BPS" }, { ".npy", 6, "\x93NUMPY" }, { ".gif", 4, "GIF8" },
    { ".ora", 4, "PK\3\4" }, { ".webp", 4, "RIFF" }, { ".bmp", 2, "BM" },
  };

  for (size_t i = 0; i < G_N_ELEMENTS (kinds); i++)
    if (n >= kinds[i].n && !memcmp (start, kinds[i].bytes, kinds[i].n))
      return kinds[i].ending;
  return "";
}

/* Copies standard input to a file; `ending` gets that of its kind. */
static bool
keep_input (FILE *file, const char **ending)
{
  char   start[8] = { 0 };
  size_t n = fread (start, 1, sizeof start, stdin);

  *ending = ending_of (start, n);
  return fwrite (start, 1, n, file) == n && copy (stdin, **ending ? MOST_KIND : MOST_ELSE, file);
}

bool
cli_stream_input (CliStreams *streams, const char *what, char **name)
{
  const char *ending = "";
  char       *path, *with_ending;
  FILE       *file;
  bool        good;

  if (streams->reader)
    return cli_error ("%s and %s cannot both be read from standard input.", streams->reader, what);
  if (!make_folder (streams))
    return false;
  streams->reader = g_strdup (what);
  path = g_build_filename (streams->folder, "standard input", NULL);
  file = g_fopen (path, "wb");
  good = file && keep_input (file, &ending);
  if (!good)
    cli_say ("Cannot read standard input: %s.", errno == EFBIG ? "it is too large" : cli_file_reason (errno));
  good = file && !fclose (file) && good;
  with_ending = g_strconcat (path, ending, NULL);
  good = good && !g_rename (path, with_ending);
  streams->failed = !good;
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
  good = !streams->output || (file && copy (file, G_MAXUINT64, stdout));
  if (file)
    fclose (file);
  g_free (unfinished);
  return good || cli_error ("Cannot write standard output: %s.", cli_file_reason (errno));
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
