/* The frames of a clip: files with numbers.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "sequence.h"

#include <string.h>

/* The place of the last digits in a file's name without folder and ending; false if there are none. */
static bool
find_digits (const char *path, size_t *first, size_t *n)
{
  const char *name = strrchr (path, G_DIR_SEPARATOR), *dot;
  size_t      end;

  name  = name ? name + 1 : path;
  dot   = strrchr (name, '.');
  end   = (size_t) ((dot && dot > name ? dot : name + strlen (name)) - path);
  while (end > (size_t) (name - path) && !g_ascii_isdigit (path[end - 1]))
    end--;
  *first = end;
  while (*first > (size_t) (name - path) && g_ascii_isdigit (path[*first - 1]))
    --*first;
  *n = end - *first;
  return *n > 0;
}

/* The last number in a file's name without its ending, such as 12 for walk2_012.png.  False if there is none. */
static bool
frame_number (const char *path, int *number)
{
  size_t first, n;
  gint64 value = 0;

  if (!find_digits (path, &first, &n))
    return false;
  for (size_t i = first; i < first + n && value <= G_MAXINT; i++)
    value = 10 * value + (path[i] - '0');
  *number = (int) value;
  return value <= G_MAXINT;
}

static bool
append (GPtrArray *paths, char *path)
{
  g_ptr_array_add (paths, path);
  return true;
}

static bool
is_picture (const char *name)
{
  static const char *const endings[] = { ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".psd", ".ora", ".kra",
                                         ".webp", ".tga", ".bmp" };
  char *small = g_ascii_strdown (name, -1);
  bool  found = false;

  for (size_t i = 0; i < G_N_ELEMENTS (endings) && !found; i++)
    found = g_str_has_suffix (small, endings[i]);
  g_free (small);
  return found;
}

/* Appends the pictures of a folder that have a number. */
static bool
append_folder (GPtrArray *paths, const char *folder)
{
  GDir       *open = g_dir_open (folder, 0, NULL);
  const char *name;
  size_t      first, n;

  if (!open)
    return cli_error ("Cannot read \"%s\": %s.", folder, cli_file_problem (folder));
  while ((name = g_dir_read_name (open)))
    if (name[0] != '.' && is_picture (name) && find_digits (name, &first, &n))
      append (paths, g_build_filename (folder, name, NULL));
  g_dir_close (open);
  return paths->len || cli_error ("\"%s\" has no picture whose name has a number, such as frame_001.png.", folder);
}

/* Appends the files that a pattern such as "walk_###.png" stands for, in which each # is a digit. */
static bool
append_pattern (GPtrArray *paths, const char *pattern)
{
  char       *folder = g_path_get_dirname (pattern), *wanted = g_path_get_basename (pattern);
  GDir       *open = g_dir_open (folder, 0, NULL);
  const char *name;
  guint       before = paths->len;

  while (open && (name = g_dir_read_name (open)))
    {
      size_t i = 0;

      while (wanted[i] && name[i] && (wanted[i] == '#' ? g_ascii_isdigit (name[i]) : wanted[i] == name[i]))
        i++;
      if (!wanted[i] && !name[i])
        append (paths, g_build_filename (folder, name, NULL));
    }
  if (open)
    g_dir_close (open);
  g_free (folder);
  g_free (wanted);
  return paths->len > before || cli_error ("No file is called \"%s\", with a digit for each #.", pattern);
}

static int
compare_frames (const void *a, const void *b)
{
  const CliFrame *one = a, *other = b;

  return one->number < other->number ? -1 : one->number > other->number;
}

/* Numbers and sorts the files. */
static bool
number_all (GPtrArray *paths, CliSequence *sequence)
{
  sequence->frame = g_new0 (CliFrame, paths->len);
  for (guint i = 0; i < paths->len; i++)
    {
      CliFrame *frame = &sequence->frame[sequence->n];

      frame->path = g_strdup (paths->pdata[i]);
      sequence->n++;
      if (!frame_number (frame->path, &frame->number))
        return cli_error ("\"%s\": the name of a frame must have a number, such as frame_001.png.", frame->path);
    }
  qsort (sequence->frame, sequence->n, sizeof *sequence->frame, compare_frames);
  for (size_t i = 1; i < sequence->n; i++)
    if (sequence->frame[i].number == sequence->frame[i - 1].number)
      return cli_error ("\"%s\" and \"%s\" have the same number: name the frames by a pattern such as "
                        "frame_###.png.", sequence->frame[i - 1].path, sequence->frame[i].path);
  return true;
}

bool
cli_sequence_find (char *const *names, size_t n, CliSequence *sequence)
{
  GPtrArray *paths = g_ptr_array_new_with_free_func (g_free);
  bool       good = true;

  *sequence = (CliSequence) { 0 };
  for (size_t i = 0; i < n && good; i++)
    good = g_file_test (names[i], G_FILE_TEST_IS_DIR) ? append_folder (paths, names[i])
           : strchr (names[i], '#') && !g_file_test (names[i], G_FILE_TEST_EXISTS) ? append_pattern (paths, names[i])
           : append (paths, g_strdup (names[i]));
  good = good && number_all (paths, sequence);
  g_ptr_array_free (paths, TRUE);
  return good;
}

void
cli_sequence_clear (CliSequence *sequence)
{
  for (size_t i = 0; i < sequence->n; i++)
    g_free (sequence->frame[i].path);
  g_free (sequence->frame);
  *sequence = (CliSequence) { 0 };
}

size_t
cli_sequence_index (const CliSequence *sequence, int number)
{
  for (size_t i = 0; i < sequence->n; i++)
    if (sequence->frame[i].number == number)
      return i;
  return SIZE_MAX;
}
