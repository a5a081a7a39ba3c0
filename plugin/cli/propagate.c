/* celdepth propagate: carries the labels of key frames to all frames of a clip.
 *
 * Each frame belongs to the key that is nearest in the clip, the earlier one of two.  From a key one chain goes to
 * later frames and one to earlier ones; chains do not depend on each other, so they run at the same time, or as jobs of
 * a farm.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"
#include "propagate.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>

/* The frames of a key on one side: from + step, from + 2 step, ... up to `last`; of step 0 the key alone. */
typedef struct { size_t key, last; int step; } Chain;

typedef struct
{
  CliMotion *motion;
  CliRun    *run;
  Chain     *chain;
  size_t     n_chains;
  CeldHost   host;          /* of a frame: threads, and cancelling */
  int        done, failed;  /* frames; whether a chain has failed */
} Work;

/* ------------------------------------------------------------------ keys */

static int
compare_keys (const void *a, const void *b)
{
  const CliKey *one = a, *other = b;

  return one->frame < other->frame ? -1 : one->frame > other->frame;
}

/* Pairs --key with --scribbles and --arrows, in the order in which they were given. */
static bool
take_keys (CliMotion *motion)
{
  const CliOptions *o = motion->options;
  guint             n = g_strv_length (o->keys);

  motion->key    = g_new0 (CliKey, n);
  motion->n_keys = n;
  for (guint i = 0; i < n; i++)
    {
      gint64 number;

      if (!g_ascii_string_to_signed (o->keys[i], 10, 0, G_MAXINT, &number, NULL) ||
          (motion->key[i].frame = cli_sequence_index (&motion->frames, (int) number)) == SIZE_MAX)
        return cli_error ("--key %s: no frame has this number. The frames are %d to %d.", o->keys[i],
                          motion->frames.frame[0].number, motion->frames.frame[motion->frames.n - 1].number);
      motion->key[i].scribbles = o->key_scribbles[i];
      motion->key[i].arrows    = o->key_arrows && i < g_strv_length (o->key_arrows) ? o->key_arrows[i] : NULL;
    }
  qsort (motion->key, n, sizeof *motion->key, compare_keys);
  for (guint i = 1; i < n; i++)
    if (motion->key[i].frame == motion->key[i - 1].frame)
      return cli_error ("--key %d is given twice.", motion->frames.frame[motion->key[i].frame].number);
  return true;
}

/* ------------------------------------------------------------------ chains */

static void
add_chain (Work *w, size_t key, size_t last, int step)
{
  w->chain = g_renew (Chain, w->chain, w->n_chains + 1);
  w->chain[w->n_chains++] = (Chain) { key, last, step };
}

static void
plan_chains (Work *w)
{
  const CliMotion *motion = w->motion;

  for (size_t k = 0; k < motion->n_keys; k++)
    {
      size_t here = motion->key[k].frame, before = k ? motion->key[k - 1].frame : 0;
      size_t after = k + 1 < motion->n_keys ? motion->key[k + 1].frame : motion->frames.n - 1;
      size_t first = k ? before + (here - before) / 2 + 1 : 0;
      size_t last  = k + 1 < motion->n_keys ? here + (after - here) / 2 : after;

      add_chain (w, k, here, 0);
      if (first < here)
        add_chain (w, k, first, -1);
      if (last > here)
        add_chain (w, k, last, 1);
    }
}

static void
count_frame (Work *w)
{
  int done = g_atomic_int_add (&w->done, 1) + 1;

  w->run->host.progress (w->run, (double) done / (double) w->motion->frames.n);
}

/* Removes what a run that was killed left of a frame; no other chain writes there. */
static void
remove_unfinished (const Work *w, size_t frame)
{
  const char *results[] = { "labels", "levels", "depth", "state" };

  for (size_t i = 0; i < G_N_ELEMENTS (results); i++)
    if (strcmp (results[i], "depth") || w->motion->options->depth_dir)
      {
        char *path = cli_frame_path (w->motion, results[i], frame);

        cli_remove_unfinished (path);
        g_free (path);
      }
}

/* Makes all frames of a chain; false after a message, or if the run is cancelled. */
static bool
run_chain (Work *w, const Chain *chain)
{
  const CliKey *key = &w->motion->key[chain->key];
  CliFrameState state;
  bool          good = cli_frame_of_key (w->motion, key, &state);

  if (good && !chain->step)
    {
      remove_unfinished (w, key->frame);
      good = cli_frame_write (w->motion, &w->host, &state);
      count_frame (w);
    }
  for (size_t frame = key->frame; good && frame != chain->last && !g_atomic_int_get (&w->failed);)
    {
      bool made;

      frame = chain->step > 0 ? frame + 1 : frame - 1;
      remove_unfinished (w, frame);
      good  = !cli_run_cancelled () && cli_frame_next (w->motion, &w->host, frame, &state, &made) &&
              (!made || cli_frame_write (w->motion, &w->host, &state));
      count_frame (w);
    }
  cli_frame_clear (&state);
  return good;
}

static void
run_one (gpointer item, gpointer data)
{
  Work *w = data;

  if (!run_chain (w, item))
    g_atomic_int_set (&w->failed, 1);
}

static bool
keep_going (void *data, double done)
{
  (void) data;
  (void) done;
  return !cli_run_cancelled ();
}

/* How many chains to run at a time: those of a key alone are short, and give no other processor work for long. */
static int
jobs_for (const Work *w, size_t first, size_t end)
{
  int most = w->motion->options->jobs ? w->motion->options->jobs : (int) g_get_num_processors (), long_ones = 0;

  for (size_t i = first; i < end; i++)
    long_ones += w->chain[i].step != 0;
  return MIN (most, long_ones);
}

/* Runs the chains, or the one that --part names: several at a time, or else one by one with all threads. */
static bool
run_chains (Work *w)
{
  const CliOptions *o = w->motion->options;
  size_t            first = o->part ? (size_t) o->part - 1 : 0, end = o->part ? (size_t) o->part : w->n_chains;
  int               jobs = jobs_for (w, first, end);

  w->host = (CeldHost) { keep_going, jobs > 1 ? NULL : w->run->host.each, w->run };
  cli_run_stage (w->run, "frames");
  if (jobs > 1)
    {
      GThreadPool *pool = g_thread_pool_new (run_one, w, jobs, TRUE, NULL);

      for (size_t i = first; i < end; i++)
        g_thread_pool_push (pool, &w->chain[i], NULL);
      g_thread_pool_free (pool, FALSE, TRUE);
    }
  else
    for (size_t i = first; i < end && !w->failed; i++)
      run_one (&w->chain[i], w);
  return cli_run_finish (w->run, CELD_OK) && !w->failed;
}

/* ------------------------------------------------------------------ outputs */

static bool
make_folder (const char *path)
{
  return !path || !g_mkdir_with_parents (path, 0777) ||
         cli_error ("Cannot make the folder \"%s\": %s.", path, g_strerror (errno));
}

static bool
write_clip (const CliMotion *motion)
{
  CliClip clip = { .frame = g_new0 (CliClipFrame, motion->frames.n), .n = motion->frames.n,
                   .relations = g_build_filename (motion->options->labels_dir, "relations.txt", NULL) };
  bool    good;

  cli_remove_unfinished (clip.relations);
  good = cli_write_text (clip.relations, motion->relations);
  for (size_t i = 0; i < clip.n; i++)
    clip.frame[i] = (CliClipFrame) {
      motion->frames.frame[i].number, g_strdup (motion->frames.frame[i].path), cli_frame_path (motion, "labels", i),
      cli_frame_path (motion, "levels", i), motion->options->depth_dir ? cli_frame_path (motion, "depth", i) : NULL };
  good = good && cli_clip_write (motion->options->labels_dir, &clip);
  cli_clip_clear (&clip);
  return good;
}

/* ------------------------------------------------------------------ a farm */

/* Writes a script for Slurm: an array of jobs, one for each chain, and the same command without --part to end it. A job
 * has not failed if relations contradict each other, status 3. */
static bool
write_slurm (const Work *w, const char *path)
{
  GString *text = g_string_new ("#!/bin/sh\n"
                                "# Run this with sh. It makes the chains of a clip as an array of jobs, and then the\n"
                                "# description of the clip and the review. What a job says is in a log beside this file.\n");
  char    *folder = g_get_current_dir (), *quoted_folder = g_shell_quote (folder);
  bool     good;

  g_string_append_printf (text, "log=$(realpath \"$0\") && cd %s || exit 1\n", quoted_folder);
  g_string_append (text, "command='");
  for (char **word = w->motion->options->command_line; *word; word++)
    {
      char  *quoted = g_shell_quote (*word);
      char **parts = g_strsplit (quoted, "'", -1), *inner = g_strjoinv ("'\\''", parts);

      g_string_append_printf (text, "%s%s", word == w->motion->options->command_line ? "" : " ", inner);
      g_free (quoted);
      g_strfreev (parts);
      g_free (inner);
    }
  g_string_append_printf (text, "'\n"
                                "array=$(sbatch --parsable --array=1-%zu --job-name=celdepth --output=\"$log-%%a.log\" \\\n"
                                "  --wrap \"$command --part \\$SLURM_ARRAY_TASK_ID --quiet || [ \\$? = 3 ]\") || exit 1\n"
                                "sbatch --parsable --dependency=afterok:$array --kill-on-invalid-dep=yes \\\n"
                                "  --job-name=celdepth-end --output=\"$log-end.log\" --wrap \"$command --quiet\"\n",
                          w->n_chains);
  good = cli_write_text (path, text->str);
  g_string_free (text, TRUE);
  g_free (folder);
  g_free (quoted_folder);
  return good;
}

/* ------------------------------------------------------------------ the command */

static bool
propagate (const CliOptions *options, CliMotion *motion, CliRun *run)
{
  Work w = { .motion = motion, .run = run };
  bool good = cli_sequence_find (options->inputs, g_strv_length (options->inputs), &motion->frames) &&
              take_keys (motion);

  if (good)
    plan_chains (&w);
  if (good && options->part > (int) w.n_chains)
    good = cli_error ("--part cannot be %d: the clip has %zu parts.", options->part, w.n_chains);
  if (good && options->emit_slurm)
    good = write_slurm (&w, options->emit_slurm);
  else if (good)
    good = cli_keys_read (motion, run) &&
           run_chains (&w) &&
           (options->part ||
            (write_clip (motion) && (!options->review || cli_review_write (options->review, motion))));
  g_free (w.chain);
  return good;
}

static int
run_propagate (const CliOptions *options)
{
  CliMotion motion = { .options = options };
  CliRun    run;
  int       code = CLI_FAILED;

  cli_run_begin (&run, options->quiet);
  if (propagate (options, &motion, &run))
    code = motion.order.n_cycles ? CLI_CONTRADICTED : CLI_DONE;
  cli_keys_clear (&motion);
  cli_sequence_clear (&motion.frames);
  cli_run_end (&run);
  return code;
}

static bool
check (CliOptions *options)
{
  guint keys = options->keys ? g_strv_length (options->keys) : 0;

  if (!keys)
    return cli_error ("--key is missing: the number of a frame with --scribbles.");
  if (!options->key_scribbles || g_strv_length (options->key_scribbles) != keys)
    return cli_error ("Give one --scribbles for each --key, in the same order.");
  if (options->key_arrows && g_strv_length (options->key_arrows) > keys)
    return cli_error ("There are more --arrows than --key.");
  if (!options->labels_dir)
    return cli_error ("--labels-dir is missing.");
  return make_folder (options->labels_dir) && make_folder (options->depth_dir);
}

const CliCommand cli_propagate_command = {
  .name     = "propagate",
  .step     = CLI_PROPAGATE,
  .input    = "FRAMES...",
  .summary  = "Carries scribbles, regions and levels from key frames to all frames of a clip.",
  .examples = "  celdepth propagate walk_###.png --key 0 --scribbles strokes.png --arrows arrows.png \\\n"
              "      --labels-dir walk --depth-dir walk --report review.json\n"
              "  celdepth propagate frames --key 1 --scribbles s1.png --key 24 --scribbles s24.png \\\n"
              "      --relations-file order.txt --labels-dir clip\n"
              "  celdepth shade --clip clip --shaded lit.png",
  .settings = "ink ink-threshold method close-gaps keep-necks hardness arrow-style on-cycle encoding near-level "
              "far-level expansion tolerance",
  .output   = "labels-dir",
  .check    = check,
  .run      = run_propagate,
};
