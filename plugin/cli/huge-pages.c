/* Huge pages for the pictures of the command.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "huge-pages.h"

#include <glib.h>
#include <string.h>
#include <unistd.h>

#define SETTINGS "GLIBC_TUNABLES"
#define SETTING  "glibc.malloc.hugetlb"

void
cli_use_huge_pages (char **argv)
{
  const char *given = g_getenv (SETTINGS);
  char       *settings, *program;

  if (given && strstr (given, SETTING)) /* by the user, or by the start before */
    return;
  settings = given && given[0] ? g_strconcat (given, ":" SETTING "=1", NULL) : g_strdup (SETTING "=1");
  program  = g_file_read_link ("/proc/self/exe", NULL);
  /* Not what runs the command for the user, such as the dynamic linker. */
  if (program && g_str_has_suffix (program, "/celdepth") && g_setenv (SETTINGS, settings, TRUE))
    execv (program, argv);
  g_free (settings);
  g_free (program);
}
