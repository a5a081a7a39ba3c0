/* Numpy files of 32-bit floats, for exact values.  Format version 1.0: a magic word, the length of the header, the
 * header as Python text, then the numbers row by row.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <stdio.h>
#include <string.h>

#define PREFIX      10  /* bytes of magic word, version, and length of the header */
#define HEADER_SIZE 128 /* bytes with the prefix; numpy needs a multiple of 64 */
#define MOST_SIZE   (PREFIX + 65536 + sizeof (float) * CELD_MAX_SIDE * CELD_MAX_SIDE) /* bytes of a file */
#define FLOATS      (G_BYTE_ORDER == G_LITTLE_ENDIAN ? "'<f4'" : "'>f4'")

bool
cli_is_npy (const char *path)
{
  size_t length = strlen (path);

  return length > 4 && !g_ascii_strcasecmp (path + length - 4, ".npy");
}

bool
cli_npy_write (const char *path, int width, int height, int depth, size_t row, const float *data)
{
  char    header[HEADER_SIZE] = "\x93NUMPY\x01", axes[64];
  size_t  pixel = sizeof (float) * (size_t) (depth ? depth : 1);
  char   *beside = cli_unfinished_name (path);
  FILE   *file = g_file_test (path, G_FILE_TEST_IS_DIR) ? NULL : fopen (beside, "wb");
  bool    good;

  snprintf (axes, sizeof axes, depth ? "%d, %d, %d" : "%d, %d", height, width, depth);
  header[8] = HEADER_SIZE - PREFIX;
  memset (header + PREFIX, ' ', HEADER_SIZE - PREFIX);
  header[PREFIX + snprintf (header + PREFIX, HEADER_SIZE - PREFIX,
                            "{'descr': %s, 'fortran_order': False, 'shape': (%s), }", FLOATS, axes)] = ' ';
  header[HEADER_SIZE - 1] = '\n';

  good = file && fwrite (header, HEADER_SIZE, 1, file) == 1;
  for (int y = 0; good && y < height; y++)
    good = fwrite (data + (size_t) y * row, pixel, (size_t) width, file) == (size_t) width;
  good = file && !fclose (file) && good && cli_file_complete (beside, path);
  if (!good)
    cli_say ("Cannot write \"%s\": %s.", path, g_strerror (errno));
  if (!good && file)
    g_unlink (beside);
  g_free (beside);
  return good;
}

/* Reads the two numbers in "...'shape': (12, 34)...". */
static bool
read_header (const char *header, int *height, int *width)
{
  const char *shape = strstr (header, "'shape': (");
  int         end = 0; /* set at the closing bracket, which does not follow if there are more axes */

  if (!shape || !strstr (header, FLOATS) || !strstr (header, "'fortran_order': False"))
    return false;
  return sscanf (shape, "'shape': (%d, %d)%n", height, width, &end) == 2 && end && *height >= 1 && *width >= 1 &&
         *height <= CELD_MAX_SIDE && *width <= CELD_MAX_SIDE;
}

bool
cli_npy_read (const char *path, CeldPlane *plane)
{
  gsize length, header_end;
  char *bytes = cli_file_read (path, MOST_SIZE, false, &length);
  int   height, width;
  bool  good = false;

  if (!bytes)
    return false;
  header_end = length > PREFIX ? PREFIX + (guchar) bytes[8] + 256 * (gsize) (guchar) bytes[9] : 0;
  if (!header_end || header_end >= length || memcmp (bytes, "\x93NUMPY\x01", 7) || bytes[header_end - 1] != '\n')
    cli_say ("Cannot read \"%s\": it is not a numpy file of version 1, or it is damaged.", path);
  else
    {
      bytes[header_end - 1] = 0;
      if (!read_header (bytes + PREFIX, &height, &width))
        cli_say ("Cannot read \"%s\": it is not an array of 32-bit floats with two axes of 1 to %d.", path,
                 CELD_MAX_SIDE);
      else if ((length - header_end) / sizeof (float) / (gsize) width < (gsize) height)
        cli_say ("Cannot read \"%s\": it is truncated.", path);
      else if (cli_plane_new (width, height, plane))
        {
          memcpy (plane->data, bytes + header_end, sizeof (float) * (gsize) width * (gsize) height);
          good = true;
        }
    }
  g_free (bytes);
  return good;
}
