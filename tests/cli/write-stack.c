/* Writes a stack of layers with given names, for the test of unusual names: one pixel each, in the last corner of a
 * wide canvas.
 *
 *   write-stack OUT NAME...
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "celdepth-io.h"

#include <stdio.h>
#include <stdlib.h>

static bool
paint (void *host, size_t layer, float *rgba)
{
  (void) host;
  rgba[0] = rgba[3] = 1;
  rgba[1] = (float) (layer % 256) / 255;
  rgba[2] = 0;
  return true;
}

int
main (int argc, char **argv)
{
  enum { WIDTH = CELD_MAX_SIDE, HEIGHT = 2 };
  size_t       n = argc > 2 ? (size_t) argc - 2 : 0;
  CeldIoLayer *layer = calloc (n + 1, sizeof *layer);
  float       *merged = calloc (4 * (size_t) WIDTH * HEIGHT, sizeof *merged);
  CeldIoStack  stack = { WIDTH, HEIGHT, layer, n, merged, paint, NULL };
  CeldIoError  error;
  bool         good = argc > 1 && layer && merged;

  for (size_t i = 0; good && i < n; i++)
    layer[i] = (CeldIoLayer) { .name = argv[i + 2], .box = { WIDTH - 1, HEIGHT - 1, 1, 1 },
                               .joint = { CELD_NO_INDEX, 0, 0 } };
  good = good && celd_io_write_layers (argv[1], &stack, &error);
  if (!good && argc > 1)
    fprintf (stderr, "%s\n", error.text);
  free (layer);
  free (merged);
  return !good;
}
