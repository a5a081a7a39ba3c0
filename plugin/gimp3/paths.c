/* Paths of an image that are arrows: each stroke of a path named Arrows, from its first point to its last one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "gimp3.h"

#include <math.h>
#include <string.h>

/* The numbers of one point of a Bezier stroke: the handle before it, itself, the handle after it. */
#define POINT 6

/* GIMP calls a second path of the same name "Arrows #1". */
static gboolean
is_for_arrows (GimpPath *path)
{
  char    *name = celd_item_name (path), *number = strstr (name, " #");
  gboolean arrows;

  if (number && number[2] && strspn (number + 2, "0123456789") == strlen (number + 2))
    *number = 0;
  arrows = celd_layer_role_of_name (name) == CELD_LAYER_ARROWS;
  g_free (name);
  return arrows;
}

static void
append_number (GString *data, double number)
{
  char text[G_ASCII_DTOSTR_BUF_SIZE];

  g_string_append_printf (data, " %s", g_ascii_formatd (text, sizeof text, "%.4f", number));
}

/* Handles do not matter, since only the ends of arrows do.  FALSE if the stroke has no two ends. */
static gboolean
append_arrow (GString *data, const double *points, gsize n, gboolean closed, int x, int y)
{
  const double *from = points + 2, *to = points + n - 4;

  if (closed || n < 2 * POINT || (fabs (from[0] - to[0]) < 1 && fabs (from[1] - to[1]) < 1))
    return FALSE;
  g_string_append (data, data->len ? " M" : "M");
  append_number (data, from[0] - x);
  append_number (data, from[1] - y);
  g_string_append (data, " L");
  append_number (data, to[0] - x);
  append_number (data, to[1] - y);
  return TRUE;
}

static void
append_path (GimpPath *path, GString *data, CeldPathArrows *arrows, int x, int y)
{
  gsize n_strokes = 0;
  int  *strokes = gimp_path_get_strokes (path, &n_strokes);

  for (gsize i = 0; i < n_strokes; i++)
    {
      gsize    n = 0;
      double  *points = NULL;
      gboolean closed = FALSE;

      gimp_path_stroke_get_points (path, strokes[i], &n, &points, &closed);
      if (append_arrow (data, points, n, closed, x, y))
        arrows->n++;
      else
        arrows->left_out++;
      g_free (points);
    }
  g_free (strokes);
}

CeldPathArrows
celd_paths_read_from (GimpImage *image, int x, int y)
{
  CeldPathArrows arrows = { NULL, 0, 0 };
  GString       *data = g_string_new (NULL);
  GimpPath     **paths = gimp_image_get_paths (image);

  for (int i = 0; paths && paths[i]; i++)
    if (is_for_arrows (paths[i]))
      append_path (paths[i], data, &arrows, x, y);
  g_free (paths);
  arrows.data = g_string_free (data, FALSE);
  return arrows;
}

CeldPathArrows
celd_paths_read (GimpImage *image)
{
  return celd_paths_read_from (image, 0, 0);
}

char *
celd_paths_left_out_text (int n)
{
  return g_strdup_printf (_ ("Strokes of the path Arrows that are no arrows were left out: %d. They are closed, or "
                             "have one point. An arrow goes from its first point, on the nearer part, to its last one."), n);
}

void
celd_paths_say_left_out (const CeldPathArrows *paths)
{
  char *text = paths->left_out ? celd_paths_left_out_text (paths->left_out) : NULL;

  if (text)
    g_message ("%s", text);
  g_free (text);
}
