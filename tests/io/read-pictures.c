/* Reads all parts of the files that it is given, for tests.
 *
 *   read-pictures < NAMES      reads a name from each line; prints "good W H PARTS" or the error on a line
 *   read-pictures FILE FOLDER  writes part N to FOLDER/N, as floats R,G,B,A of the whole canvas; prints the name of
 *                              each part, or the error
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth-io.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Larger canvases are not read: their memory would be the caller's, not the reader's. */
#define MOST_PIXELS ((size_t) 1 << 24)

static bool
read_parts (CeldIoFile *file, CeldIoError *error)
{
  size_t pixels = (size_t) celd_io_width (file) * (size_t) celd_io_height (file);
  float *rgba;
  bool   good = true;

  if (pixels > MOST_PIXELS)
    return true;
  rgba = malloc (4 * sizeof (float) * pixels);
  for (size_t i = 0; good && i < celd_io_parts (file); i++)
    good = celd_io_read_colours (file, i, rgba, error) && celd_io_read_values (file, i, rgba, error);
  free (rgba);
  return good;
}

static bool
write_part (CeldIoFile *file, size_t part, const char *folder, CeldIoError *error)
{
  size_t pixels = (size_t) celd_io_width (file) * (size_t) celd_io_height (file);
  float *rgba = malloc (4 * sizeof (float) * pixels);
  bool   good = celd_io_read_colours (file, part, rgba, error);
  char   name[1024];
  FILE  *out;

  snprintf (name, sizeof name, "%s/%zu", folder, part);
  out  = good ? fopen (name, "wb") : NULL;
  good = out && fwrite (rgba, 4 * sizeof (float), pixels, out) == pixels;
  if (out)
    fclose (out);
  free (rgba);
  return good;
}

static int
write_parts (const char *path, const char *folder)
{
  CeldIoError error = { .text = "" };
  CeldIoFile *file = celd_io_open (path, &error);

  if (!file)
    puts (error.text);
  for (size_t i = 0; file && i < celd_io_parts (file); i++)
    puts (write_part (file, i, folder, &error) ? celd_io_part (file, i)->name : error.text);
  celd_io_close (file);
  return 0;
}

int
main (int argc, char **argv)
{
  char name[1024];

  celd_io_fork_reader ();
  if (argc == 3)
    return write_parts (argv[1], argv[2]);
  while (fgets (name, sizeof name, stdin))
    {
      CeldIoError error = { .text = "" };
      CeldIoFile *file;

      name[strcspn (name, "\n")] = 0;
      file = celd_io_open (name, &error);
      if (file && read_parts (file, &error))
        printf ("good %d %d %zu\n", celd_io_width (file), celd_io_height (file), celd_io_parts (file));
      else
        printf ("%s\n", error.text);
      celd_io_close (file);
      fflush (stdout);
    }
  return 0;
}
