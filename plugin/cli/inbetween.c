/* celdepth inbetween: draws what is between two key drawings, parts as rigid as possible and in the order of depth.
 *
 * The regions of the first drawing are those of its scribbles; those of the second one, too, or they are propagated
 * from the first.  One order holds for both.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"
#include "propagate.h"

#include <string.h>

typedef struct
{
  const CliOptions *options;
  CliRun            run;
  CliMotion         motion;      /* a clip of the two drawings */
  CeldPlane         ink[2];
  CeldLabels        labels[2];
  CeldLayers       *layers[2];
  CeldInbetween    *between;
} Between;

/* ------------------------------------------------------------------ keys */

/* Makes a clip of the two drawings, whose keys are those that have scribbles. */
static void
plan_motion (Between *b)
{
  const CliOptions *o = b->options;
  CliMotion        *motion = &b->motion;

  motion->options  = o;
  motion->frames.n = 2;
  motion->frames.frame = g_new0 (CliFrame, 2);
  for (int s = 0; s < 2; s++)
    motion->frames.frame[s] = (CliFrame) { g_strdup (s ? o->target : o->input), s, 0 };
  motion->n_keys = o->second_scribbles ? 2 : 1;
  motion->key    = g_new0 (CliKey, motion->n_keys);
  motion->key[0] = (CliKey) { .frame = 0, .scribbles = o->scribbles, .arrows = o->arrows };
  if (o->second_scribbles)
    motion->key[1] = (CliKey) { .frame = 1, .scribbles = o->second_scribbles, .arrows = o->second_arrows,
                                .bare = true };
}

/* Says which regions were not found in the second drawing, or are unsure there; false with a message. */
static bool
say_unsure (const Between *b, const CeldPlane *certainty)
{
  CliFrameState state = { .ink = b->ink[1], .certainty = 1, .notes = cli_notes_new () };
  bool          good = cli_frame_take_notes (&b->motion, &b->labels[0], &b->labels[1], certainty, &state);

  for (guint i = 0; i < state.notes->len; i++)
    {
      const CeldRegionNote *note = &g_array_index (state.notes, CeldRegionNote, i);
      const uint8_t       *c = b->motion.palette.item[note->label - 1].colour;

      if (note->label == b->motion.background)
        continue;
      cli_say ("Region #%02x%02x%02x %s (%d, %d) in \"%s\". If frames are wrong, give --scribbles-b.", c[0], c[1], c[2],
               note->change == CELD_REGION_GONE ? "was not found; it was at" : "is unsure round", note->x, note->y,
               note->change == CELD_REGION_GONE ? b->options->input : b->options->target);
    }
  state.ink = (CeldPlane) { 0 }; /* borrowed */
  cli_frame_clear (&state);
  return good;
}

/* Propagates the regions of the first drawing to the second one. */
static bool
carry_labels (Between *b)
{
  const CliMotion *motion = &b->motion;
  CeldPlane        certainty = { 0 };
  bool             good;

  cli_run_stage (&b->run, "propagation");
  good = cli_frame_ink (motion, &b->run.host, 1, &b->ink[1]) && cli_check_lines (b->options->target, &b->ink[1]) &&
         cli_labels_new (motion->width, motion->height, &b->labels[1]) &&
         cli_plane_new (motion->width, motion->height, &certainty) &&
         cli_run_finish (&b->run, cli_frame_carry (motion, &b->run.host, &b->ink[0], &b->labels[0], &b->ink[1],
                                                   &b->labels[1], &certainty));
  if (good && !b->options->quiet)
    good = say_unsure (b, &certainty);
  g_free (certainty.data);
  return good;
}

static bool
read_keys (Between *b)
{
  plan_motion (b);
  if (!cli_keys_read (&b->motion, &b->run))
    return false;
  for (size_t s = 0; s < b->motion.n_keys; s++)
    {
      b->ink[s]    = b->motion.key[s].ink;
      b->labels[s] = b->motion.key[s].labels;
      b->motion.key[s].ink    = (CeldPlane) { 0 };
      b->motion.key[s].labels = (CeldLabels) { 0 };
    }
  return b->motion.n_keys == 2 || carry_labels (b);
}

/* ------------------------------------------------------------------ layers */

static bool
ownership_new (int width, int height, CeldOwnership *own)
{
  return cli_labels_new (width, height, &own->owner) && cli_labels_new (width, height, &own->under) &&
         cli_plane_new (width, height, &own->coverage);
}

static void
ownership_clear (CeldOwnership *own)
{
  g_free (own->owner.data);
  g_free (own->under.data);
  g_free (own->coverage.data);
}

/* Cuts one drawing, or its colours, into completed layers. */
static bool
cut_layers (Between *b, int s)
{
  const CliOptions *o = b->options;
  const CliMotion  *motion = &b->motion;
  CliLayers         size = { .width = motion->width, .height = motion->height };
  CeldOwnership     own = { .owner = { .data = NULL } };
  CeldSheets       *sheets = NULL;
  CeldColours       art = { 0 };
  CeldStatus        status;
  bool              good = ownership_new (motion->width, motion->height, &own) &&
                           cli_art_read (o, motion->frames.frame[s].path, s ? o->second_colours : o->colours, true,
                                         &size, &art);

  if (good)
    {
      status = celd_own (&b->ink[s], NULL, &b->labels[s], motion->order.level, motion->order.n, NULL, o->settings.expansion,
                         &b->run.host, &own);
      if (status == CELD_OK)
        status = celd_sheets (&b->ink[s], &own, NULL, &motion->order, motion->background, &o->settings, &b->run.host,
                              &sheets);
      if (status == CELD_OK)
        status = celd_layers_cut (&b->ink[s], &own, motion->order.level, motion->order.n, &art, sheets,
                                  CELD_STORE_FLOAT, &b->run.host, &b->layers[s]);
      good = cli_run_finish (&b->run, status);
    }
  celd_sheets_free (sheets);
  ownership_clear (&own);
  g_free (art.data);
  return good;
}

static bool
make_between (Between *b)
{
  CeldKey key[2];

  for (int s = 0; s < 2; s++)
    {
      cli_run_stage (&b->run, "layers");
      if (!cut_layers (b, s))
        return false;
      key[s] = (CeldKey) { b->layers[s], &b->ink[s], b->motion.background };
    }
  cli_run_stage (&b->run, "registration");
  return cli_run_finish (&b->run, celd_inbetween_new (key, &b->options->settings, &b->run.host, &b->between));
}

/* ------------------------------------------------------------------ pictures */

static CeldStatus
draw (Between *b, size_t frame, CeldColours *picture)
{
  CeldHost quiet = { NULL, b->run.host.each, b->run.host.data };

  return celd_inbetween_draw (b->between, (double) frame / (b->options->frames + 1), &quiet, picture);
}

static bool
paint (void *data, size_t frame, float *rgba)
{
  Between    *b = data;
  CeldColours picture = { b->motion.width, b->motion.height, (size_t) b->motion.width, rgba };

  return b->run.host.progress (b->run.host.data, (double) frame / (b->options->frames + 2)) &&
         draw (b, frame, &picture) == CELD_OK;
}

/* Writes keys and in-betweens as one animation. */
static bool
write_motion (Between *b)
{
  const CliOptions *o = b->options;
  CeldIoFrames      frames = { b->motion.width, b->motion.height, (size_t) o->frames + 2, o->fps, o->size, paint, b };
  CeldIoError       error;

  return celd_io_write_frames (o->between, &frames, &error) ||
         (error.text[0] ? cli_error ("%s", error.text)
                        : cli_check (cli_run_cancelled () ? CELD_CANCELLED : CELD_NO_MEMORY));
}

/* Writes the in-betweens, each as a picture; the name of one alone needs no number. */
static bool
write_pictures (Between *b)
{
  const CliOptions *o = b->options;
  CeldColours       picture = { 0 };
  bool              good = cli_colours_new (b->motion.width, b->motion.height, &picture);

  for (int frame = 1; good && frame <= o->frames; frame++)
    {
      char *name = o->frames == 1 && !strchr (o->between, '#') ? g_strdup (o->between)
                                                               : cli_file_numbered (o->between, frame);

      good = cli_run_finish (&b->run, b->run.host.progress (b->run.host.data, (double) frame / o->frames)
                                        ? draw (b, (size_t) frame, &picture) : CELD_CANCELLED) &&
             cli_write_colours (name, &picture);
      g_free (name);
    }
  g_free (picture.data);
  return good;
}

/* ------------------------------------------------------------------ the command */

static void
clear (Between *b)
{
  celd_inbetween_free (b->between);
  for (int s = 0; s < 2; s++)
    {
      celd_layers_free (b->layers[s]);
      g_free (b->ink[s].data);
      g_free (b->labels[s].data);
    }
  cli_keys_clear (&b->motion);
  cli_sequence_clear (&b->motion.frames);
  cli_run_end (&b->run);
}

/* Prints contradictions; the exit code. */
static int
finish (const Between *b)
{
  return cli_finish (b->options, &(CliReport) {
    .command   = "inbetween",
    .width     = b->motion.width,
    .height    = b->motion.height,
    .palette   = &b->motion.palette,
    .relations = &b->motion.list,
    .order     = &b->motion.order,
    .settings  = &b->options->settings,
    .timings   = b->run.timings,
  });
}

static int
run_inbetween (const CliOptions *options)
{
  Between b = { .options = options };
  int     code = CLI_FAILED;

  cli_run_begin (&b.run, options, "keys keys propagation layers layers registration drawing");
  if (read_keys (&b) && make_between (&b))
    {
      cli_run_stage (&b.run, "drawing");
      if (cli_is_motion (options->between) ? write_motion (&b) : write_pictures (&b))
        {
          cli_run_stage (&b.run, NULL);
          code = finish (&b);
        }
    }
  clear (&b);
  return code;
}

static bool
check (CliOptions *options)
{
  return options->second_scribbles || !options->second_arrows || cli_error ("--arrows-b needs --scribbles-b.");
}

const CliCommand cli_inbetween_command = {
  .name     = "inbetween",
  .step     = CLI_INBETWEEN,
  .input    = "FIRST",
  .second   = "SECOND",
  .summary  = "Draws what is between two drawings, parts as rigid as possible.",
  .examples = "  celdepth inbetween wave1.png wave9.png --scribbles strokes.png --arrows arrows.png -n 7 \\\n"
              "      --output between_###.png\n"
              "  celdepth inbetween wave1.png wave9.png --scribbles strokes1.png --scribbles-b strokes9.png \\\n"
              "      --relations '#ff0000 > #0000ff' -n 7 --output wave.gif",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle expansion cell-size stiffness",
  .output   = "output",
  .check    = check,
  .run      = run_inbetween,
};
