/* Writes frames of sRGB codes, R, G, B for each pixel, from standard input:
 *
 *   write-frames OUT WIDTH HEIGHT FRAMES PER_SECOND
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth-io.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static float
linear (int code)
{
  double value = code / 255.0;

  return (float) (value <= 0.04045 ? value / 12.92 : pow ((value + 0.055) / 1.055, 2.4));
}

static bool
paint (void *host, size_t frame, float *rgba)
{
  const CeldIoFrames *frames = host;

  (void) frame;
  for (size_t i = 0; i < 4 * (size_t) frames->width * (size_t) frames->height; i++)
    rgba[i] = i % 4 < 3 ? linear (getchar ()) : 1;
  return !feof (stdin);
}

int
main (int argc, char **argv)
{
  CeldIoFrames frames = { .paint = paint, .host = &frames };
  CeldIoError  error;

  if (argc != 6)
    return 2;
  frames.width      = atoi (argv[2]);
  frames.height     = atoi (argv[3]);
  frames.frames     = (size_t) atoi (argv[4]);
  frames.per_second = atof (argv[5]);
  if (celd_io_write_frames (argv[1], &frames, &error))
    return 0;
  fprintf (stderr, "%s\n", error.text);
  return 1;
}
