/* Fingerprints of what a result is made from, by which runs know that they need not make it again.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "fingerprint.h"

#include <errno.h>
#include <stdio.h>

#define CHUNK 65536 /* bytes that are read together */

GChecksum *
cli_fingerprint_new (const CeldSettings *settings)
{
  GChecksum             *sum = g_checksum_new (G_CHECKSUM_SHA256);
  size_t                 n;
  const CeldSettingInfo *info = celd_setting_infos (&n);

  g_checksum_update (sum, (const guchar *) CELDEPTH_VERSION, -1);
  for (size_t i = 0; i < n; i++)
    {
      char text[G_ASCII_DTOSTR_BUF_SIZE];

      g_ascii_dtostr (text, sizeof text, celd_setting_get (&info[i], settings));
      g_checksum_update (sum, (const guchar *) text, -1);
      g_checksum_update (sum, (const guchar *) ";", 1);
    }
  return sum;
}

bool
cli_fingerprint_add_file (GChecksum *sum, const char *path)
{
  FILE  *file;
  guchar bytes[CHUNK];
  size_t n;
  bool   good;

  if (!path)
    return true;
  if (cli_is_device (path)) /* which may have no end, and cannot be read twice */
    return cli_error ("Cannot read \"%s\": it is not an ordinary file.", path);
  file = fopen (path, "rb");
  while (file && (n = fread (bytes, 1, sizeof bytes, file)) > 0)
    g_checksum_update (sum, bytes, (gssize) n);
  good = (file && !ferror (file)) || cli_error ("Cannot read \"%s\": %s.", path, g_strerror (errno));
  if (file)
    fclose (file);
  return good;
}

char *
cli_fingerprint_end (GChecksum *sum, bool good)
{
  char *text = good ? g_strdup (g_checksum_get_string (sum)) : NULL;

  g_checksum_free (sum);
  return text;
}
