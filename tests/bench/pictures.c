/* What the programs read: text, and pictures in the format PAM, a head of lines of text, then bytes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "bench.h"
#include "base/base.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void
give_up (const char *path)
{
  fprintf (stderr, "%s: cannot be read\n", path);
  exit (1);
}

/* The pixels; malloc'ed. */
static uint8_t *
read_pam (const char *path, int depth, int *width, int *height)
{
  FILE    *file = fopen (path, "rb");
  char     line[80], word[20];
  int      value, found = 0;
  uint8_t *pixel = NULL;

  *width = *height = 0;
  while (file && fgets (line, sizeof line, file) && strcmp (line, "ENDHDR\n"))
    if (sscanf (line, "%19s %d", word, &value) == 2)
      {
        if (!strcmp (word, "WIDTH"))
          *width = value;
        if (!strcmp (word, "HEIGHT"))
          *height = value;
        if (!strcmp (word, "DEPTH"))
          found = value;
      }
  if (file && found == depth && *width > 0 && *height > 0 && *width <= CELD_MAX_SIDE && *height <= CELD_MAX_SIDE)
    {
      size_t size = (size_t) *width * (size_t) *height * (size_t) depth;

      pixel = malloc (size);
      if (!pixel || fread (pixel, 1, size, file) != size)
        give_up (path);
    }
  else
    give_up (path);
  fclose (file);
  return pixel;
}

CeldPlane
read_grey (const char *path)
{
  int       width, height;
  uint8_t  *pixel = read_pam (path, 1, &width, &height);
  CeldPlane plane;

  if (celd_plane_new (width, height, &plane) != CELD_OK)
    give_up (path);
  for (size_t p = 0; p < (size_t) width * (size_t) height; p++)
    plane.data[p] = (float) pixel[p] / 255;
  free (pixel);
  return plane;
}

CeldPaint
read_colours (const char *path, int width, int height)
{
  int       w, h;
  uint8_t  *pixel = read_pam (path, 4, &w, &h);
  CeldPaint paint = { width, height, (size_t) width, malloc (4 * (size_t) width * (size_t) height) };

  if (!paint.data)
    give_up (path);
  for (int y = 0; y < height; y++)
    for (int x = 0; x < width; x++)
      {
        size_t from = (size_t) ((2 * y + 1) * (int64_t) h / (2 * height)) * (size_t) w +
                      (size_t) ((2 * x + 1) * (int64_t) w / (2 * width));

        memcpy (CELD_RGBA (&paint, x, y), pixel + 4 * from, 4);
      }
  free (pixel);
  return paint;
}

char *
read_text (const char *path)
{
  FILE *file = fopen (path, "rb");
  char *text = calloc (1, 1 << 20);

  if (!file || !text || fread (text, 1, (1 << 20) - 1, file) == 0)
    give_up (path);
  fclose (file);
  return text;
}
