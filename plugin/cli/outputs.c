/* What a run writes may not replace what it reads, nor another result; and it must be possible to write it there.
 *
 * Two names are the same file if they have one device and inode.  A file that is not there yet is known by its folder,
 * and by its name in it.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "outputs.h"
#include "propagate.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ------------------------------------------------------------------ the same file */

/* Terminals are known by name: one can be read and written. */
char *
cli_file_identity (const char *name)
{
  size_t      n = strlen (name);
  char       *path, *folder, *base, *identity;
  struct stat about;

  while (n > 1 && name[n - 1] == G_DIR_SEPARATOR)
    n--;
  path   = g_strndup (name, n);
  folder = g_path_get_dirname (path);
  base   = g_path_get_basename (path);
  if (!stat (path, &about) && (S_ISREG (about.st_mode) || S_ISDIR (about.st_mode)))
    identity = g_strdup_printf ("%ju %ju", (uintmax_t) about.st_dev, (uintmax_t) about.st_ino);
  else if (!stat (folder, &about))
    identity = g_strdup_printf ("%ju %ju %s", (uintmax_t) about.st_dev, (uintmax_t) about.st_ino, base);
  else
    identity = g_canonicalize_filename (path, NULL);
  g_free (base);
  g_free (folder);
  g_free (path);
  return identity;
}

bool
cli_same_file (const char *a, const char *b)
{
  char *one = cli_file_identity (a), *other = cli_file_identity (b);
  bool  same = !strcmp (one, other);

  g_free (one);
  g_free (other);
  return same;
}

/* ------------------------------------------------------------------ read and written files */

void
cli_touched_begin (CliTouched *touched)
{
  touched->read    = g_hash_table_new_full (g_str_hash, g_str_equal, g_free, NULL);
  touched->written = g_hash_table_new_full (g_str_hash, g_str_equal, g_free, NULL);
}

void
cli_touched_end (CliTouched *touched)
{
  g_hash_table_destroy (touched->read);
  g_hash_table_destroy (touched->written);
}

void
cli_touched_reads (CliTouched *touched, const char *option, const char *path)
{
  if (path)
    g_hash_table_insert (touched->read, cli_file_identity (path), (gpointer) (option ? option : ""));
}

bool
cli_touched_writes (CliTouched *touched, const char *option, const char *path)
{
  char       *identity = cli_file_identity (path);
  const char *other = g_hash_table_lookup (touched->read, identity);

  if (!other)
    other = g_hash_table_lookup (touched->written, identity);
  g_hash_table_insert (touched->written, identity, (gpointer) option);
  if (other && other[0])
    return cli_error ("--%s and --%s name the same file, \"%s\".", option, other, path);
  return !other || cli_error ("--%s would overwrite \"%s\".", option, path);
}

static void
reads_list (CliTouched *touched, const char *option, char *const *names)
{
  for (; names && *names; names++)
    cli_touched_reads (touched, option, *names);
}

void
cli_touched_reads_all (CliTouched *touched, const CliOptions *options)
{
  GArray *given = g_array_new (FALSE, FALSE, sizeof (CliFile));

  cli_files_given (options, given);
  for (guint i = 0; i < given->len; i++)
    {
      const CliFile *file = &g_array_index (given, CliFile, i);

      if (file->kind == INPUT)
        cli_touched_reads (touched, file->option, file->path);
    }
  reads_list (touched, "scribbles", options->key_scribbles);
  reads_list (touched, "arrows", options->key_arrows);
  reads_list (touched, NULL, options->inputs);
  cli_touched_reads (touched, NULL, options->input);
  cli_touched_reads (touched, NULL, options->target);
  g_array_free (given, TRUE);
}

/* ------------------------------------------------------------------ files whose names are made from others */

static bool
writes_and_frees (CliTouched *touched, const char *option, char *path)
{
  bool good = cli_touched_writes (touched, option, path);

  g_free (path);
  return good;
}

typedef struct { CliTouched *touched; const char *option; bool good; } MeshFiles;

static void
take_mesh_file (void *data, const char *name)
{
  MeshFiles *files = data;

  files->good = files->good && cli_touched_writes (files->touched, files->option, name);
}

static bool
writes_mesh (CliTouched *touched, const CliFile *file)
{
  MeshFiles files = { touched, file->option, true };

  celd_io_mesh_files (file->path, take_mesh_file, &files);
  return files.good;
}

/* In-betweens are numbered, if they are several. */
static bool
writes_numbered (CliTouched *touched, const CliFile *file, int frames)
{
  bool good = true;

  for (int frame = 1; frame <= frames && good; frame++)
    good = writes_and_frees (touched, file->option, cli_file_numbered (file->path, frame));
  return good;
}

static bool
writes_maps (CliTouched *touched, const CliFile *file)
{
  bool good = true;

  for (int map = 0; map < CLI_MAPS && good; map++)
    good = writes_and_frees (touched, file->option, cli_map_name (file->path, map));
  return good;
}

static bool
writes_file (CliTouched *touched, const CliOptions *options, const CliFile *file)
{
  if (file->kind == MAPS)
    return writes_maps (touched, file);
  if (file->kind == MESH)
    return writes_mesh (touched, file);
  if (file->kind == MOVING && !cli_is_motion (file->path) && (options->frames > 1 || strchr (file->path, '#')))
    return writes_numbered (touched, file, options->frames);
  return cli_touched_writes (touched, file->option, file->path) &&
         (file->path != options->review ||
          writes_and_frees (touched, file->option, cli_review_sheet_name (file->path)));
}

bool
cli_touched_writes_all (CliTouched *touched, const CliOptions *options)
{
  GArray *given = g_array_new (FALSE, FALSE, sizeof (CliFile));
  bool    good = true;

  cli_files_given (options, given);
  for (guint i = 0; i < given->len && good; i++)
    {
      const CliFile *file = &g_array_index (given, CliFile, i);

      good = file->kind < MAPS || writes_file (touched, options, file);
    }
  g_array_free (given, TRUE);
  return good;
}

bool
cli_outputs_check (const CliOptions *options)
{
  CliTouched touched;
  bool       good;

  cli_touched_begin (&touched);
  cli_touched_reads_all (&touched, options);
  good = cli_touched_writes_all (&touched, options);
  cli_touched_end (&touched);
  return good;
}

/* ------------------------------------------------------------------ places */

bool
cli_is_device (const char *path)
{
  return g_file_test (path, G_FILE_TEST_EXISTS) && !g_file_test (path, G_FILE_TEST_IS_REGULAR) &&
         !g_file_test (path, G_FILE_TEST_IS_DIR);
}

static bool
is_empty (const char *folder)
{
  GDir *open = g_dir_open (folder, 0, NULL);
  bool  empty = open && !g_dir_read_name (open);

  if (open)
    g_dir_close (open);
  return empty;
}

/* Whether a folder, by its whole name, is one that the run makes, or above it. */
static bool
will_be_made (const char *folder, const CliOptions *options)
{
  const char *const made[] = { options->output_dir, options->labels_dir, options->depth_dir };
  size_t            n = strlen (folder);
  bool              found = false;

  for (size_t i = 0; i < G_N_ELEMENTS (made) && !found; i++)
    {
      char *plain = made[i] ? g_canonicalize_filename (made[i], NULL) : NULL;

      found = plain && !strncmp (plain, folder, n) && (!plain[n] || plain[n] == G_DIR_SEPARATOR);
      g_free (plain);
    }
  return found;
}

/* Whether a file can be written there, with a message if not.  Only a report may go to a device. */
static bool
check_place (const char *name, CliFileKind kind, const CliOptions *options)
{
  char *plain = g_canonicalize_filename (name, NULL), *folder = g_path_get_dirname (plain); /* without a last slash */
  bool  device = cli_is_device (name), good = true;

  if (g_file_test (name, G_FILE_TEST_IS_DIR) &&
      (((kind == STACK || kind == COMPOSED) && celd_io_stack_kind (name) == CELD_IO_FOLDER) ||
       ((kind == FRAMES || kind == MOVING || kind == DEFORMED) && celd_io_frames_kind (name) == CELD_IO_PNG_FRAMES)))
    good = is_empty (name) || cli_error ("Cannot write \"%s\": it is a folder that is not empty.", name);
  else if (g_file_test (name, G_FILE_TEST_IS_DIR))
    good = cli_error ("Cannot write \"%s\": it is a folder.", name);
  else if (device && kind != REPORT)
    good = cli_error ("Cannot write \"%s\": it is not an ordinary file.", name);
  else if (!device && !will_be_made (folder, options) && g_access (folder, W_OK))
    good = cli_error ("Cannot write \"%s\" in its folder: %s.", name, g_strerror (errno));
  g_free (folder);
  g_free (plain);
  return good;
}

static bool
check_maps (const char *path, const CliOptions *options)
{
  bool good = true;

  for (int map = 0; good && map < CLI_MAPS; map++)
    {
      char *name = cli_map_name (path, map);

      good = check_place (name, OUTPUT, options);
      g_free (name);
    }
  return good;
}

/* The path, or the nearest folder above it, that is there; *missing is how many below it are not.  Free with g_free. */
static char *
existing_place (const char *path, int *missing)
{
  char *place = g_canonicalize_filename (path, NULL);

  for (*missing = 0; !g_file_test (place, G_FILE_TEST_EXISTS); ++*missing)
    {
      char *above = g_path_get_dirname (place);

      g_free (place);
      place = above;
    }
  return place;
}

/* Whether files can be written in a folder that is there, or that can be made; with a message if not. */
static bool
check_folder (const char *path)
{
  int   missing;
  char *place = existing_place (path ? path : ".", &missing);
  bool  good = true;

  if (path && !g_file_test (place, G_FILE_TEST_IS_DIR))
    good = missing ? cli_error ("Cannot make the folder \"%s\": %s.", path, g_strerror (ENOTDIR))
                   : cli_error ("Cannot make the folder \"%s\": it is a file. Give another name.", path);
  else if (path && g_access (place, W_OK))
    good = missing ? cli_error ("Cannot make the folder \"%s\": %s.", path, g_strerror (errno))
                   : cli_error ("Cannot write in the folder \"%s\": %s.", path, g_strerror (errno));
  g_free (place);
  return good;
}

bool
cli_outputs_make_folder (const char *path, int *made)
{
  if (path)
    g_free (existing_place (path, made));
  return !path || !g_mkdir_with_parents (path, 0777) ||
         cli_error ("Cannot make the folder \"%s\": %s.", path, g_strerror (errno));
}

void
cli_outputs_unmake_folder (const char *path, int made)
{
  char *place = g_canonicalize_filename (path, NULL);

  for (int i = 0; i < made && !g_rmdir (place); i++)
    {
      char *above = g_path_get_dirname (place);

      g_free (place);
      place = above;
    }
  g_free (place);
}

bool
cli_outputs_check_places (const CliOptions *options)
{
  GArray *given = g_array_new (FALSE, FALSE, sizeof (CliFile));
  bool    good = check_folder (options->output_dir) && check_folder (options->labels_dir) &&
                 check_folder (options->depth_dir);

  cli_files_given (options, given);
  for (guint i = 0; good && i < given->len; i++)
    {
      const CliFile *file = &g_array_index (given, CliFile, i);

      good = file->kind == MAPS ? check_maps (file->path, options)
                                : file->kind < OUTPUT || check_place (file->path, file->kind, options);
    }
  g_array_free (given, TRUE);
  return good;
}
