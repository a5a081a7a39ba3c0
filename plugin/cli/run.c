/* Progress on stderr, cancelling by SIGINT or SIGTERM, and the time of each stage.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#define BAR_WIDTH    30     /* characters (chosen) */
#define REDRAW_AFTER 100000 /* microseconds (chosen) */

static volatile sig_atomic_t interrupted;

static void
interrupt (int signal_number)
{
  (void) signal_number;
  interrupted = 1;
}

bool
cli_run_cancelled (void)
{
  return interrupted;
}

static CliTiming *
current (CliRun *run)
{
  return run->timings->len ? &g_array_index (run->timings, CliTiming, run->timings->len - 1) : NULL;
}

static bool
progress (void *host, double done)
{
  CliRun *run = host;
  gint64  now = g_get_monotonic_time ();

  /* Stages shorter than REDRAW_AFTER show no bar. */
  if (run->visible && current (run) && now - MAX (run->drawn, run->began) > REDRAW_AFTER)
    {
      int marks = (int) (CLAMP (done, 0, 1) * BAR_WIDTH);

      fprintf (stderr, "\r%-8s [%.*s%*s] %3.0f %%", current (run)->stage, marks, "##############################",
               BAR_WIDTH - marks, "", 100 * done);
      fflush (stderr);
      run->drawn = now;
    }
  return !interrupted;
}

static void
each (void *host, int n, void (*body) (void *data, int i), void *data)
{
  CliRun *run = host;

  cli_threads_each (run->threads, n, body, data);
}

void
cli_run_begin (CliRun *run, bool quiet)
{
  struct sigaction action = { .sa_handler = interrupt, .sa_flags = (int) SA_RESETHAND | SA_RESTART };

  sigaction (SIGINT, &action, NULL);
  sigaction (SIGTERM, &action, NULL);
  *run = (CliRun) {
    .host     = { progress, each, run },
    .timings = g_array_new (FALSE, FALSE, sizeof (CliTiming)),
    .visible = !quiet && isatty (STDERR_FILENO),
    .threads = cli_threads_new (),
  };
}

void
cli_run_stage (CliRun *run, const char *stage)
{
  gint64 now = g_get_monotonic_time ();

  if (run->drawn)
    fprintf (stderr, "\r%*s\r", BAR_WIDTH + 18, "");
  if (run->began && current (run))
    current (run)->seconds = (double) (now - run->began) / 1e6;
  run->drawn = 0;
  run->began = stage ? now : 0;
  if (stage)
    g_array_append_val (run->timings, ((CliTiming) { stage, 0 }));
}

bool
cli_run_finish (CliRun *run, CeldStatus status)
{
  cli_run_stage (run, NULL);
  return cli_check (status == CELD_OK && interrupted ? CELD_CANCELLED : status);
}

void
cli_run_end (CliRun *run)
{
  cli_run_stage (run, NULL);
  g_array_free (run->timings, TRUE);
  cli_threads_free (run->threads);
}
