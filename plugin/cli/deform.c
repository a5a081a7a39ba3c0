/* celdepth deform: takes places of a drawing elsewhere, and its parts along as rigidly as possible, in the order of
 * depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <string.h>

typedef struct
{
  const CliOptions *options;
  CliRun            run;
  CeldSession      *session;
  const CeldOrder  *order;
  int               width, height;
  CliHandleKeys     keys;       /* of a motion; one for a picture */
  CeldPuppet       *puppet;
  CeldPoseReport    worst;      /* of all frames */
} Deformation;

/* ------------------------------------------------------------------ the puppet */

static bool
make_puppet (Deformation *d, const CeldColours *art)
{
  CeldLabels labels;
  CeldStatus status;

  cli_run_stage (&d->run, "labels");
  status = celd_session_labels (d->session, &d->run.host, &labels, NULL);
  cli_run_stage (&d->run, "order");
  if (status == CELD_OK)
    status = celd_session_order (d->session, &d->run.host, &d->order);
  cli_run_stage (&d->run, "lattice");
  if (status == CELD_OK)
    status = celd_session_puppet (d->session, art, &d->run.host, &d->puppet);
  return cli_run_finish (&d->run, status);
}

/* ------------------------------------------------------------------ input */

/* Whether the output has a layer for each region. */
static bool
has_layers (const CliOptions *options)
{
  CeldIoStackKind kind = celd_io_stack_kind (options->deformed);

  return kind == CELD_IO_OPEN_RASTER || kind == CELD_IO_PSD;
}

/* Layers have the colours in which they will be composited; all else is linear light. */
static bool
is_linear (const CliOptions *options)
{
  return !has_layers (options) || (options->compositing && !strcmp (options->compositing, "linear"));
}

/* Makes the keys of a motion from rest to the handles. */
static bool
keys_of_handles (Deformation *d, CliLayers *input)
{
  CeldHandleKey *end;
  CeldHandles    rest = { 0 };

  d->keys = (CliHandleKeys) { g_new0 (CeldHandleKey, 2), 2 };
  end        = &d->keys.item[1];
  end->frame = d->options->frames - 1;
  if (!cli_handles_read (d->options, input, &d->run, &end->handles))
    return false;
  if (!cli_check (celd_handles_between (end, 1, 0, &rest)))
    return false;
  for (size_t i = 0; i < rest.n; i++)
    rest.item[i] = (CeldHandle) { rest.item[i].x, rest.item[i].y, rest.item[i].x, rest.item[i].y, 0 };
  d->keys.item[0].handles = rest;
  return end->handles.n ||
         cli_error ("There are no handles: give --handles, --handles-file, --handles-layer or --keys.");
}

static bool
read_input (Deformation *d)
{
  const CliOptions *options = d->options;
  CliLayers         input = { 0 };
  CeldColours       art = { 0 };
  bool              good;

  good = cli_check (d->session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (d->session, options, &input) &&
         (options->handle_keys ? cli_handle_keys_read (options->handle_keys, &d->keys) : keys_of_handles (d, &input)) &&
         cli_art_read (options, options->input, options->colours, is_linear (options), &input, &art);
  d->width  = input.width;
  d->height = input.height;
  good = good && make_puppet (d, &art);
  cli_layers_clear (&input);
  g_free (art.data);
  return good;
}

/* ------------------------------------------------------------------ pictures */

/* Poses the puppet for a frame. */
static CeldStatus
pose (Deformation *d, int frame)
{
  CeldHost       quiet = { NULL, d->run.host.each, d->run.host.data };
  CeldHandles    handles = { 0 };
  CeldPoseReport report = { 0 };
  CeldStatus     status = celd_handles_between (d->keys.item, d->keys.n, frame, &handles);

  if (status == CELD_OK)
    status = celd_puppet_pose (d->puppet, handles.item, handles.n, &quiet, &report);
  celd_handles_clear (&handles);
  celd_pose_worst (&report, &d->worst);
  return status;
}

static bool
paint (void *host, size_t frame, float *rgba)
{
  Deformation *d = host;
  CeldHost     quiet = { NULL, d->run.host.each, d->run.host.data };
  CeldColours  picture = { d->width, d->height, (size_t) d->width, rgba };

  return d->run.host.progress (d->run.host.data, (double) frame / d->options->frames) &&
         pose (d, (int) frame) == CELD_OK && celd_puppet_draw (d->puppet, &quiet, &picture, NULL) == CELD_OK;
}

static bool
write_motion (Deformation *d)
{
  CeldIoFrames frames = { d->width, d->height, (size_t) d->options->frames, d->options->fps, d->options->size, paint,
                          d };
  CeldIoError  error;

  return celd_io_write_frames (d->options->deformed, &frames, &error) ||
         (error.text[0] ? cli_error ("%s", error.text)
                        : cli_check (cli_run_cancelled () ? CELD_CANCELLED : CELD_NO_MEMORY));
}

/* Writes the picture or its layers. */
static bool
write_art (Deformation *d, CeldColours *picture)
{
  const CliOptions *options = d->options;

  if (!has_layers (options))
    return cli_write_colours (options->deformed, picture);
  return cli_deformed_layers_write (options->deformed, d->puppet, celd_session_palette (d->session),
                                    is_linear (options), picture, &d->run);
}

/* Writes the last frame, and its levels in the encoding of the settings. */
static bool
write_picture (Deformation *d)
{
  const CliOptions *options = d->options;
  CeldColours       picture = { 0 };
  CeldPlane         levels = { 0 };
  bool              good = cli_colours_new (d->width, d->height, &picture) &&
                           (!options->levels || cli_plane_new (d->width, d->height, &levels)) &&
                           cli_check (pose (d, d->keys.item[d->keys.n - 1].frame)) &&
                           cli_check (celd_puppet_draw (d->puppet, &d->run.host, &picture,
                                                        options->levels ? &levels : NULL));

  for (size_t p = 0; good && options->levels && p < (size_t) d->width * (size_t) d->height; p++)
    levels.data[p] = celd_encode_level (levels.data[p], d->order->levels, &options->settings);
  good = good && (cli_is_motion (options->deformed) || write_art (d, &picture)) &&
         (!options->levels || cli_write_depth (options->levels, &levels, cli_nearest_level (&levels)));
  g_free (picture.data);
  g_free (levels.data);
  return good;
}

/* ------------------------------------------------------------------ the command */

static void
say_pose (const CeldPoseReport *report)
{
  char text[1000];

  celd_pose_text (report, cli_in_language, text, sizeof text);
  if (text[0])
    cli_say ("%s", text);
}

static int
finish (const Deformation *d)
{
  if (!d->options->quiet)
    say_pose (&d->worst);
  return cli_finish (d->options, &(CliReport) {
    .command   = "deform",
    .width     = d->width,
    .height    = d->height,
    .palette   = celd_session_palette (d->session),
    .relations = celd_session_relations (d->session),
    .order     = d->order,
    .problems  = celd_session_problems (d->session),
    .settings  = &d->options->settings,
    .timings   = d->run.timings,
  });
}

static int
run_deform (const CliOptions *options)
{
  Deformation d = { .options = options, .session = celd_session_new () };
  bool        moves = cli_is_motion (options->deformed);
  int         code = CLI_FAILED;

  cli_run_begin (&d.run, options, "reading labels order lattice deformation");
  cli_run_stage (&d.run, "reading");
  if (read_input (&d))
    {
      cli_run_stage (&d.run, "deformation");
      if ((!moves || write_motion (&d)) && ((moves && !options->levels) || write_picture (&d)))
        {
          cli_run_stage (&d.run, NULL);
          code = finish (&d);
        }
    }
  cli_handle_keys_clear (&d.keys);
  celd_puppet_free (d.puppet);
  celd_session_free (d.session);
  cli_run_end (&d.run);
  return code;
}

static bool
check (CliOptions *options)
{
  if (options->handle_keys && (options->handles || options->handles_file || options->handles_layer))
    return cli_error ("Give either --keys or handles.");
  return cli_compositing_check (options);
}

const CliCommand cli_deform_command = {
  .name     = "deform",
  .step     = CLI_DEFORM,
  .input    = "DRAWING|LAYERED",
  .summary  = "Moves parts of a drawing by handles, in front of others or behind them.",
  .examples = "  celdepth deform bee.png --scribbles strokes.png --arrows arrows.png \\\n"
              "      --handles '120,80 -> 200,60; 300,400' --output moved.png\n"
              "  celdepth deform page.psd --handles-layer handles.png --output moved.ora\n"
              "  celdepth deform page.psd --keys handles.json --frames 24 --output wave.gif",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle suggest expansion margin hold-gaps cell-size",
  .output   = "output",
  .check    = check,
  .run      = run_deform,
};
