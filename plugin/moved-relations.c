/* Moves places in relations (core/input/relations.c has the grammar).  All else stays as the artist has written it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "moved-relations.h"

#include <glib.h>
#include <math.h>
#include <string.h>

#define DECIMALS 1e4 /* places are rounded to this part of a pixel; chosen */

/* A number, which *text is moved behind. */
static gboolean
read_number (const char **text, double *number)
{
  char *end;

  if (!**text || !strchr ("-.0123456789", **text))
    return FALSE;
  *number = g_ascii_strtod (*text, &end);
  if (end == *text)
    return FALSE;
  *text = end;
  return TRUE;
}

static void
skip_blanks (const char **text)
{
  *text += strspn (*text, " \t");
}

/* A comma stands between the numbers of a place, and nowhere else; *text is moved behind it. */
static gboolean
read_place (const char **text, double *x, double *y)
{
  const char *at = *text;

  if (!read_number (&at, x))
    return FALSE;
  skip_blanks (&at);
  if (*at++ != ',')
    return FALSE;
  skip_blanks (&at);
  if (!read_number (&at, y))
    return FALSE;
  *text = at;
  return TRUE;
}

static void
append_number (GString *text, double number)
{
  char digits[G_ASCII_DTOSTR_BUF_SIZE];

  g_string_append (text, g_ascii_formatd (digits, sizeof digits, "%.12g", round (number * DECIMALS) / DECIMALS));
}

char *
celd_relations_moved (const char *text, double dx, double dy)
{
  GString *moved = g_string_new (NULL);
  double   x, y;

  while (*text)
    if (read_place (&text, &x, &y))
      {
        append_number (moved, x + dx);
        g_string_append_c (moved, ',');
        append_number (moved, y + dy);
      }
    else
      g_string_append_c (moved, *text++);
  return g_string_free (moved, FALSE);
}
