/* celdepth propagate: carries the labels of key frames to all frames of a clip.
 *
 * From a key one chain goes to later frames and one to earlier ones, up to the next key; chains do not depend on each
 * other, so they run at the same time.  Frames between two keys then have two sides, which are blended.  The parts of a
 * clip, each a job of a farm, are keys, what is between two of them, and what is before the first and after the last.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "outputs.h"
#include "propagate.h"

#include <stdlib.h>
#include <string.h>

/* A chain makes frames of a key, or sides of them between two keys: by `step`, 1 or -1, up to `last`; by 0 the key
 * alone. */
typedef struct { size_t part; const CliKey *key; size_t last; int step; bool between; } Chain;
/* Blends a frame between a key and the one after it. */
typedef struct { size_t part; const CliKey *key; size_t frame; } Blend;

typedef struct
{
  CliMotion *motion;
  CliRun    *run;
  size_t     n_parts;
  GArray    *chains, *blends;
  CeldHost   host;                /* of a frame: threads, and cancelling */
  int        done, planned;       /* steps: frames, sides, and frames that are blended */
  int        failed;              /* whether a chain or a blend has failed */
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

/* ------------------------------------------------------------------ the plan */

static void
add_chain (Work *w, const CliKey *key, size_t last, int step, bool between)
{
  Chain chain = { w->n_parts, key, last, step, between };

  g_array_append_val (w->chains, chain);
  w->planned += step ? abs ((int) last - (int) key->frame) : 1;
}

/* What is between a key and the one after it. */
static void
add_between (Work *w, const CliKey *key)
{
  if (key[1].frame - key->frame < 2)
    return;
  w->n_parts++;
  add_chain (w, key, key[1].frame - 1, 1, true);
  add_chain (w, key + 1, key->frame + 1, -1, true);
  for (size_t frame = key->frame + 1; frame < key[1].frame; frame++)
    {
      Blend blend = { w->n_parts, key, frame };

      g_array_append_val (w->blends, blend);
      w->planned++;
    }
}

static void
plan (Work *w)
{
  const CliMotion *motion = w->motion;
  const CliKey    *first = motion->key, *last = motion->key + motion->n_keys - 1;

  for (const CliKey *key = first; key <= last; key++)
    {
      w->n_parts++;
      add_chain (w, key, key->frame, 0, false);
      if (key < last)
        add_between (w, key);
    }
  if (first->frame > 0)
    {
      w->n_parts++;
      add_chain (w, first, 0, -1, false);
    }
  if (last->frame < motion->frames.n - 1)
    {
      w->n_parts++;
      add_chain (w, last, motion->frames.n - 1, 1, false);
    }
}

/* ------------------------------------------------------------------ running them */

static void
count_step (Work *w)
{
  int done = g_atomic_int_add (&w->done, 1) + 1;

  w->run->host.progress (w->run, (double) done / (double) w->planned);
}

/* Makes all frames or sides of a chain; false after a message, or if the run is cancelled. */
static bool
run_chain (Work *w, const Chain *chain)
{
  const CliKey *key = chain->key, *side = chain->between ? key : NULL;
  CliFrameState state;
  bool          good = cli_frame_of_key (w->motion, key, side, &state);

  if (good && !chain->step)
    {
      cli_frame_remove_unfinished (w->motion, key->frame, NULL);
      good = cli_frame_write (w->motion, &w->host, &state);
      count_step (w);
    }
  for (size_t frame = key->frame; good && frame != chain->last && !g_atomic_int_get (&w->failed);)
    {
      bool made;

      frame = chain->step > 0 ? frame + 1 : frame - 1;
      cli_frame_remove_unfinished (w->motion, frame, side);
      good  = !cli_run_cancelled () && cli_frame_next (w->motion, &w->host, frame, &state, &made) &&
              (!made || cli_frame_write (w->motion, &w->host, &state));
      count_step (w);
    }
  cli_frame_clear (&state);
  return good;
}

static void
run_chain_of (gpointer chain, gpointer work)
{
  Work *w = work;

  if (!run_chain (w, chain))
    g_atomic_int_set (&w->failed, 1);
}

static void
run_blend_of (gpointer item, gpointer work)
{
  Work        *w = work;
  const Blend *blend = item;

  if (g_atomic_int_get (&w->failed))
    return;
  cli_frame_remove_unfinished (w->motion, blend->frame, NULL);
  if (cli_run_cancelled () || !cli_frame_blend (w->motion, &w->host, blend->frame, blend->key))
    g_atomic_int_set (&w->failed, 1);
  count_step (w);
}

static bool
keep_going (void *data, double done)
{
  (void) data;
  (void) done;
  return !cli_run_cancelled ();
}

/* Runs tasks that do not depend on each other: `at_once` at a time, or else one by one with all threads. */
static void
run_tasks (Work *w, const GPtrArray *tasks, int at_once, GFunc run)
{
  int jobs = MIN (w->motion->options->jobs ? w->motion->options->jobs : (int) g_get_num_processors (), at_once);

  w->host = (CeldHost) { keep_going, jobs > 1 ? NULL : w->run->host.each, w->run };
  if (jobs > 1)
    {
      GThreadPool *pool = g_thread_pool_new (run, w, jobs, TRUE, NULL);

      for (guint i = 0; i < tasks->len; i++)
        g_thread_pool_push (pool, tasks->pdata[i], NULL);
      g_thread_pool_free (pool, FALSE, TRUE);
    }
  else
    for (guint i = 0; i < tasks->len; i++)
      run (tasks->pdata[i], w);
}

/* Runs all parts, or the one that --part names. */
static bool
run_parts (Work *w)
{
  size_t     part = (size_t) w->motion->options->part;
  GPtrArray *chains = g_ptr_array_new (), *blends = g_ptr_array_new ();
  int        long_chains = 0; /* those of a key alone are short, and give no other processor work for long */

  for (guint i = 0; i < w->chains->len; i++)
    {
      Chain *chain = &g_array_index (w->chains, Chain, i);

      if (part && chain->part != part)
        continue;
      g_ptr_array_add (chains, chain);
      long_chains += chain->step != 0;
    }
  for (guint i = 0; i < w->blends->len; i++)
    if (!part || g_array_index (w->blends, Blend, i).part == part)
      g_ptr_array_add (blends, &g_array_index (w->blends, Blend, i));
  cli_run_stage (w->run, "frames");
  run_tasks (w, chains, long_chains, run_chain_of);
  run_tasks (w, blends, (int) blends->len, run_blend_of);
  g_ptr_array_free (chains, TRUE);
  g_ptr_array_free (blends, TRUE);
  if (!cli_run_finish (w->run, CELD_OK) || w->failed)
    return false;
  if (!w->motion->options->quiet)
    cli_say_blank (w->motion);
  return true;
}

/* ------------------------------------------------------------------ outputs */

/* Whether a result of the clip would replace a frame or another file that is read. */
static bool
check_outputs (const CliMotion *motion)
{
  const CliOptions *o = motion->options;
  char             *relations = g_build_filename (o->labels_dir, "relations.txt", NULL);
  char             *description = g_build_filename (o->labels_dir, CLI_CLIP_FILE, NULL);
  CliTouched        touched;
  bool              good;

  cli_touched_begin (&touched);
  cli_touched_reads_all (&touched, o);
  for (size_t i = 0; i < motion->frames.n; i++)
    cli_touched_reads (&touched, NULL, motion->frames.frame[i].path);
  good = cli_touched_writes_all (&touched, o) && cli_touched_writes (&touched, "labels-dir", relations) &&
         cli_touched_writes (&touched, "labels-dir", description);
  for (size_t i = 0; i < motion->frames.n && good; i++)
    good = cli_frame_touches (motion, i, &touched);
  cli_touched_end (&touched);
  g_free (relations);
  g_free (description);
  return good;
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
      motion->frames.frame[i].number, g_strdup (motion->frames.frame[i].path), cli_frame_path (motion, "labels", i, NULL),
      cli_frame_path (motion, "levels", i, NULL),
      motion->options->depth_dir ? cli_frame_path (motion, "depth", i, NULL) : NULL };
  good = good && cli_clip_write (motion->options->labels_dir, &clip);
  cli_clip_clear (&clip);
  return good;
}

/* ------------------------------------------------------------------ a farm */

/* Writes a script for Slurm: an array of jobs, one for each part, and the same command without --part to end it. A job
 * has not failed if relations contradict each other, status 3. */
static bool
write_slurm (const Work *w, const char *path)
{
  GString *text = g_string_new ("#!/bin/sh\n"
                                "# Run this with sh. It makes the parts of a clip as an array of jobs, and then the\n"
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
                          w->n_parts);
  good = cli_write_text (path, text->str);
  g_string_free (text, TRUE);
  g_free (folder);
  g_free (quoted_folder);
  return good;
}

/* ------------------------------------------------------------------ the command */

static bool
make_folders (const CliOptions *options)
{
  int made;

  return cli_outputs_make_folder (options->labels_dir, &made) && cli_outputs_make_folder (options->depth_dir, &made);
}

/* The exit code; that of contradictions is found by the caller. */
static int
propagate (const CliOptions *options, CliMotion *motion, CliRun *run)
{
  Work w = { .motion = motion, .run = run, .chains = g_array_new (FALSE, FALSE, sizeof (Chain)),
             .blends = g_array_new (FALSE, FALSE, sizeof (Blend)) };
  bool good = cli_sequence_find (options->inputs, g_strv_length (options->inputs), &motion->frames) &&
              take_keys (motion);
  int  code = good && !check_outputs (motion) ? CLI_USAGE : CLI_FAILED;

  good = good && code == CLI_FAILED;
  if (good)
    plan (&w);
  if (good && options->part > (int) w.n_parts)
    good = cli_error ("--part cannot be %d: the clip has %zu parts.", options->part, w.n_parts);
  if (good && options->emit_slurm)
    good = make_folders (options) && write_slurm (&w, options->emit_slurm);
  else if (good)
    good = cli_keys_read (motion, run) && make_folders (options) &&
           run_parts (&w) &&
           (options->part ||
            (write_clip (motion) && (!options->review || cli_review_write (options->review, motion))));
  g_array_free (w.chains, TRUE);
  g_array_free (w.blends, TRUE);
  return good ? CLI_DONE : code;
}

static int
run_propagate (const CliOptions *options)
{
  CliMotion motion = { .options = options };
  CliRun    run;
  int       code;
  GString  *stages = g_string_new (NULL);

  for (char **key = options->keys; key && *key; key++)
    g_string_append (stages, "keys ");
  g_string_append_printf (stages, "frames*%u", g_strv_length (options->inputs));
  cli_run_begin (&run, options, stages->str);
  g_string_free (stages, TRUE);
  code = propagate (options, &motion, &run);
  if (code == CLI_DONE && motion.order.n_cycles)
    {
      cli_say_cycles (options, &motion.order, &motion.list);
      code = CLI_CONTRADICTED;
    }
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
  for (guint i = 0; i < keys; i++)
    if (!options->key_scribbles[i][0])
      return cli_error ("--scribbles needs a value: --scribbles PICTURE.");
  if (options->key_arrows && g_strv_length (options->key_arrows) > keys)
    return cli_error ("There are more --arrows than --key.");
  if (!options->labels_dir)
    return cli_error ("--labels-dir is missing.");
  return true;
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
