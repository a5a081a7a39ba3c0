/* --watch: makes the results again whenever an input is saved, so that any painting program has a preview.
 *
 * Programs save by writing the file itself, or another one that is then renamed, so folders are watched, and a file
 * has changed when its inode, size or time has.  While it is being written it cannot be read, or only in part: a
 * change is waited out, and a failure is reported only if the file then stays as it is.  Folders on other machines say
 * nothing, so files are also looked at from time to time.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"
#include "watch.h"

#include <gio/gio.h>
#include <string.h>
#include <sys/stat.h>

#define LOOK_AFTER    500  /* milliseconds between looks at the files without any news (chosen) */
#define SETTLED_AFTER 150  /* milliseconds without a change until a file counts as saved (chosen) */
#define PATIENCE      2000 /* milliseconds until a file that cannot be read is reported (chosen) */

/* What changes when a file is saved; all 0: it does not exist. */
typedef struct { guint64 inode, size; gint64 seconds, nanoseconds; } Stamp;

typedef struct
{
  GPtrArray *files;          /* borrowed names */
  GPtrArray *monitors;       /* GFileMonitor of their folders */
  Stamp     *stamp;          /* of each file, before the last run */
} Watch;

/* ------------------------------------------------------------------ files */

/* Whether all files are as they were; if not, takes their new stamps. */
static bool
is_unchanged (Watch *watch)
{
  bool same = true;

  for (guint i = 0; i < watch->files->len; i++)
    {
      struct stat about;
      Stamp       stamp = { 0 };

      if (!stat (watch->files->pdata[i], &about))
        stamp = (Stamp) { about.st_ino, (guint64) about.st_size, about.st_mtim.tv_sec, about.st_mtim.tv_nsec };
      same = same && !memcmp (&stamp, &watch->stamp[i], sizeof stamp);
      watch->stamp[i] = stamp;
    }
  return same;
}

static void
watch_begin (Watch *watch, const CliOptions *options)
{
  watch->files    = g_ptr_array_new ();
  watch->monitors = g_ptr_array_new_with_free_func (g_object_unref);
  cli_files_inputs (options, watch->files);
  watch->stamp = g_new0 (Stamp, watch->files->len);
  for (guint i = 0; i < watch->files->len; i++)
    {
      char         *name = g_path_get_dirname (watch->files->pdata[i]);
      GFile        *folder = g_file_new_for_path (name);
      GFileMonitor *monitor = g_file_monitor_directory (folder, G_FILE_MONITOR_WATCH_MOVES, NULL, NULL);

      if (monitor)
        g_ptr_array_add (watch->monitors, monitor);
      g_object_unref (folder);
      g_free (name);
    }
}

static void
watch_end (Watch *watch)
{
  g_ptr_array_free (watch->monitors, TRUE);
  g_ptr_array_free (watch->files, TRUE);
  g_free (watch->stamp);
}

/* ------------------------------------------------------------------ waiting */

static gboolean
ring (gpointer data)
{
  *(bool *) data = true;
  return G_SOURCE_REMOVE;
}

/* Waits for news of a folder, or for some time. */
static void
sleep_for (guint milliseconds, bool news)
{
  bool  rung = false;
  guint timer = g_timeout_add (milliseconds, ring, &rung);

  do
    g_main_context_iteration (NULL, TRUE);
  while (!rung && !news && !cli_run_cancelled ());
  if (!rung)
    g_source_remove (timer);
}

/* Waits until a file changes, at most for some time (0: without end).  False if none did. */
static bool
wait_for_change (Watch *watch, gint64 milliseconds)
{
  gint64 end = g_get_monotonic_time () + 1000 * milliseconds;

  while (!cli_run_cancelled () && (!milliseconds || g_get_monotonic_time () < end))
    {
      if (!is_unchanged (watch))
        return true;
      sleep_for (LOOK_AFTER, true);
    }
  return false;
}

/* Waits until files have not changed for a moment. */
static void
wait_until_saved (Watch *watch)
{
  do
    sleep_for (SETTLED_AFTER, false);
  while (!cli_run_cancelled () && !is_unchanged (watch));
}

/* ------------------------------------------------------------------ the loop */

/* Runs once; false if it failed while files were being saved, so that it has to run again at once. */
static bool
run_once (Watch *watch, const CliOptions *options, int (*run) (void *data), void *data)
{
  gint64 began = g_get_monotonic_time ();
  int    code;

  cli_say_keep ();
  cli_files_hold ();
  code = cli_files_end (run (data));
  if (cli_run_cancelled () || (code == CLI_FAILED && wait_for_change (watch, PATIENCE)))
    {
      cli_say_kept (false);
      return cli_run_cancelled ();
    }
  cli_say_kept (true);
  if (!options->quiet && code == CLI_FAILED)
    cli_say ("Nothing was made. Waiting for \"%s\" to be saved; press Ctrl+C to stop.", options->input);
  else if (!options->quiet)
    cli_say ("Made in %.1f s. Waiting for \"%s\" to be saved; press Ctrl+C to stop.",
             (double) (g_get_monotonic_time () - began) / 1e6, options->input);
  return true;
}

int
cli_watch (const CliOptions *options, int (*run) (void *data), void *data)
{
  Watch watch;

  watch_begin (&watch, options);
  is_unchanged (&watch);
  while (!cli_run_cancelled ())
    {
      bool done = run_once (&watch, options, run, data);

      if (done)
        wait_for_change (&watch, 0);
      wait_until_saved (&watch);
    }
  watch_end (&watch);
  return CLI_DONE;
}
