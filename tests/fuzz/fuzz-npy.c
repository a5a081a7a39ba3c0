/* The reader of numpy files: a plane of the size that it says, or one message.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"
#include "fuzz.h"

#include <unistd.h>

static int said;

void
cli_say (const char *format, ...)
{
  (void) format;
  said++;
}

bool
cli_plane_new (int width, int height, CeldPlane *plane)
{
  *plane = (CeldPlane) { width, height, (size_t) width, g_try_new (float, (gsize) width * (gsize) height) };
  return plane->data;
}

/* What writing calls, which is not tested here. */
char *
cli_unfinished_name (const char *path)
{
  return g_strdup (path);
}

bool
cli_file_complete (const char *unfinished, const char *path)
{
  (void) unfinished, (void) path;
  return false;
}

int
LLVMFuzzerTestOneInput (const uint8_t *data, size_t size)
{
  char      path[64];
  CeldPlane plane = { 0 };
  float     sum = 0;
  bool      read;

  snprintf (path, sizeof path, "/tmp/celdepth-fuzz-%d.npy", (int) getpid ());
  FUZZ_CHECK (g_file_set_contents (path, (const char *) data, (gssize) size, NULL));
  said = 0;
  read = cli_npy_read (path, &plane);
  FUZZ_CHECK (read ? said == 0 : said == 1);
  if (read)
    FUZZ_CHECK (plane.width >= 1 && plane.width <= CELD_MAX_SIDE && plane.height >= 1 && plane.height <= CELD_MAX_SIDE);
  for (size_t i = 0; read && i < (size_t) plane.width * (size_t) plane.height; i++)
    sum += plane.data[i];
  FUZZ_CHECK (sum == sum || sum != sum);
  g_free (plane.data);
  unlink (path);
  return 0;
}
