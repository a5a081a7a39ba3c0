/* Progress on stderr, cancelling by SIGINT, SIGTERM or SIGHUP, and the time of each stage.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define BAR_WIDTH      30     /* characters (chosen) */
#define BAR_LINE       78     /* characters of the whole line */
#define REDRAW_AFTER   100000 /* microseconds (chosen) */
#define ESTIMATE_AFTER 1      /* seconds of work before the rest is estimated (chosen) */

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

/* ------------------------------------------------------------------ the bar */

/* How long stages take, in relation to each other: rough seconds for a megapixel (estimated).  Others take
 * one second. */
static const struct { const char *stage; double seconds; } lengths[] = {
  { "reading", 0.1 }, { "ink", 0.05 }, { "labels", 0.6 }, { "order", 0.1 },
  { "levels", 0.2 }, { "depth", 0.3 }, { "normals", 0.3 }, { "light", 0.2 },
  { "shade", 0.5 }, { "shadows", 0.2 }, { "layers", 0.6 }, { "writing", 0.4 },
  { "scene", 0.1 }, { "left", 0.2 }, { "right", 0.2 }, { "views", 0.3 },
  { "mesh", 1 }, { "relief", 0.5 }, { "occlusion", 0.5 }, { "keys", 1 }, { "frames", 0.5 },
  { "lattice", 0.2 }, { "deformation", 0.3 }, { "registration", 0.4 }, { "propagation", 0.5 },
  { "compose", 0.3 }, { "picture", 0.1 }, { "drawing", 0.3 },
};

static GMutex bar_lock;
static bool   bar_shown;
static gint64 work_began; /* of the first input of a clip; microseconds, 0: not yet */

/* Whether an entry of a plan, such as "views*24", is a stage. */
static bool
is_stage (const char *entry, const char *stage)
{
  size_t n = strcspn (entry, "*");

  return strlen (stage) == n && !strncmp (entry, stage, n);
}

static double
length_of (const char *entry)
{
  const char *times = strchr (entry, '*');
  double      length = 1;

  for (size_t i = 0; i < G_N_ELEMENTS (lengths); i++)
    if (is_stage (entry, lengths[i].stage))
      length = lengths[i].seconds;
  return length * (times ? g_ascii_strtod (times + 1, NULL) : 1);
}

void
cli_bar_hide (void)
{
  if (bar_shown)
    fprintf (stderr, "\r%*s\r", BAR_LINE, "");
  bar_shown = false;
}

/* Writes how long something takes, such as "1 min 20 s". */
static void
write_duration (double seconds, char *text, size_t size)
{
  int s = (int) ceil (seconds);

  if (s < 60)
    g_snprintf (text, size, "%d s", s);
  else if (s < 3600)
    g_snprintf (text, size, "%d min %02d s", s / 60, s % 60);
  else
    g_snprintf (text, size, "%d h %02d min", s / 3600, s % 3600 / 60);
}

/* Draws the bar of the whole work, of which this fraction is done. */
static void
draw (const CliRun *run, double done, gint64 now)
{
  int    marks = (int) (done * BAR_WIDTH);
  double worked = (double) (now - work_began) / 1e6;
  char   left[40] = "", line[200];

  if (worked > ESTIMATE_AFTER && done > 0.02)
    write_duration (worked / done * (1 - done), left, sizeof left);
  g_snprintf (line, sizeof line, "%-12s [%.*s%*s] %3.0f %%%s%s", run->stage, marks, "##############################",
              BAR_WIDTH - marks, "", 100 * done, left[0] ? "  time left: " : "", left);
  fprintf (stderr, "\r%-*s", BAR_LINE, line);
  fflush (stderr);
  bar_shown = true;
}

/* `done` is the fraction of the stage. */
static bool
progress (void *host, double done)
{
  CliRun *run = host;
  gint64  now = g_get_monotonic_time ();

  g_mutex_lock (&bar_lock); /* threads of propagate count frames */
  if (run->visible && run->stage && now - MAX (run->drawn, work_began) > REDRAW_AFTER)
    {
      double before = run->before + run->length * CLAMP (done, 0, 1);
      double all = ((double) run->done_frames + before / run->planned) / run->frames;

      run->most  = CLAMP (all, run->most, 1); /* never back */
      run->drawn = now;
      draw (run, run->most, now);
    }
  g_mutex_unlock (&bar_lock);
  return !interrupted;
}

/* ------------------------------------------------------------------ the run */

/* Counts what comes before a stage.  Stages of the plan that were passed over were not needed; one that is not in the
 * rest of the plan takes none of the bar. */
static void
enter_stage (CliRun *run, const char *stage)
{
  double before = run->before + run->length;
  char **rest = run->next;

  run->before = before;
  run->length = 0;
  for (; *rest && !is_stage (*rest, stage); rest++)
    before += length_of (*rest);
  if (!*rest)
    return;
  run->before = before;
  run->length = length_of (*rest);
  run->next   = rest + 1;
}

static void
each (void *host, int n, void (*body) (void *data, int i), void *data)
{
  CliRun *run = host;

  cli_threads_each (run->threads, n, body, data);
}

bool
cli_progress_wanted (const CliOptions *options)
{
  return !options->quiet && (options->progress || isatty (STDERR_FILENO));
}

void
cli_run_begin (CliRun *run, const CliOptions *options, const char *stages)
{
  struct sigaction action = { .sa_handler = interrupt, .sa_flags = (int) SA_RESETHAND | SA_RESTART }, hangup;

  sigaction (SIGINT, &action, NULL);
  sigaction (SIGTERM, &action, NULL);
  if (!sigaction (SIGHUP, NULL, &hangup) && hangup.sa_handler != SIG_IGN) /* which nohup asks for */
    sigaction (SIGHUP, &action, NULL);
  *run = (CliRun) {
    .host    = { progress, each, run },
    .timings = g_array_new (FALSE, FALSE, sizeof (CliTiming)),
    .visible = cli_progress_wanted (options),
    .plan    = g_strsplit (stages, " ", 0),
    .threads = cli_threads_new (),
    .done_frames = options->done_frames,
    .frames  = MAX (options->frames_in_all, 1),
  };
  run->next = run->plan;
  for (char **stage = run->plan; *stage; stage++)
    run->planned += length_of (*stage);
  if (!run->done_frames)
    work_began = g_get_monotonic_time ();
}

void
cli_run_stage (CliRun *run, const char *stage)
{
  gint64 now = g_get_monotonic_time ();

  if (run->began && current (run))
    current (run)->seconds = (double) (now - run->began) / 1e6;
  run->began = stage ? now : 0;
  run->stage = stage;
  if (!stage)
    return;
  enter_stage (run, stage);
  g_array_append_val (run->timings, ((CliTiming) { stage, 0 }));
  progress (run, 0);
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
  cli_bar_hide ();
  g_strfreev (run->plan);
  g_array_free (run->timings, TRUE);
  cli_threads_free (run->threads);
}
