/* Shared by stereo and wiggle: makes a scene of completed layers, and writes its views.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <string.h>

/* ------------------------------------------------------------------ the scene */

static CeldStatus
copy_depth (CliRun *run, CliScene *s)
{
  CeldPlane  depth;
  CeldStatus status = celd_session_depth (s->session, &run->host, &depth, NULL);

  if (status != CELD_OK)
    return status;
  s->depth = (CeldPlane) { depth.width, depth.height, (size_t) depth.width,
                           g_try_new (float, (gsize) depth.width * (gsize) depth.height) };
  for (int y = 0; s->depth.data && y < depth.height; y++)
    memcpy (s->depth.data + (size_t) y * s->depth.stride, depth.data + (size_t) y * depth.stride,
            s->depth.stride * sizeof *depth.data);
  return s->depth.data ? CELD_OK : CELD_NO_MEMORY;
}

/* Keeps what the report says, and frees all else of the session. */
static void
drop_pictures (CliScene *s)
{
  s->relations = celd_session_relations (s->session);
  s->problems  = celd_session_problems (s->session);
  celd_session_drop_pictures (s->session);
}

bool
cli_scene_make (CeldColours *art, CliScene *s)
{
  CliRun       *run = s->run;
  CeldOwnership own;
  CeldLabels    labels;
  CeldStatus    status;

  cli_run_stage (run, "labels");
  status = celd_session_labels (s->session, &run->host, &labels, NULL);
  cli_run_stage (run, "order");
  if (status == CELD_OK)
    status = celd_session_order (s->session, &run->host, &s->order);
  cli_run_stage (run, "depth");
  if (status == CELD_OK)
    status = copy_depth (run, s);
  cli_run_stage (run, "layers");
  if (status == CELD_OK)
    status = celd_session_layers (s->session, art, CELD_STORE_FLOAT, &run->host, &s->layers);
  g_clear_pointer (&art->data, g_free);
  cli_run_stage (run, "scene");
  if (status == CELD_OK)
    status = celd_session_ownership (s->session, &run->host, &own, NULL);
  if (status == CELD_OK)
    status = celd_scene_of_layers (s->layers, &own, &s->depth, &run->host, &s->scene);
  return cli_run_finish (run, status);
}

/* Layers are always completed, since others leave holes in views. */
bool
cli_scene_new (const CliOptions *options, CliRun *run, CliScene *s)
{
  CliOptions  whole = *options;
  CliLayers   input = { 0 };
  CeldColours art = { 0 };
  bool        good;

  whole.settings.complete = true;
  *s   = (CliScene) { .session = celd_session_new (), .settings = &options->settings, .run = run };
  cli_run_stage (run, "reading");
  good = cli_check (s->session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (s->session, &whole, &input);
  good = good && cli_art_read (options, options->input, options->colours, true, &input, &art);
  cli_layers_clear (&input);
  good = good && cli_scene_make (&art, s);
  if (good)
    drop_pictures (s);
  g_free (art.data);
  return good;
}

int
cli_scene_finish (const CliOptions *options, const char *command, const CliScene *s)
{
  return cli_finish (options, &(CliReport) {
    .command   = command,
    .width     = s->depth.width,
    .height    = s->depth.height,
    .palette   = celd_session_palette (s->session),
    .relations = s->relations,
    .order     = s->order,
    .problems  = s->problems,
    .settings  = &options->settings,
    .timings   = s->run->timings,
  });
}

void
cli_scene_release (CliScene *s)
{
  celd_scene_free (s->scene);
  celd_layers_free (s->layers);
  s->scene  = NULL;
  s->layers = NULL;
}

void
cli_scene_clear (CliScene *s)
{
  cli_scene_release (s);
  g_free (s->depth.data);
  celd_session_free (s->session);
}

/* ------------------------------------------------------------------ views */

typedef struct { const CliScene *scene; CeldCamera (*camera) (const CliScene *s, int frame); int frames; } Frames;

static bool
paint (void *host, size_t frame, float *rgba)
{
  const Frames   *f = host;
  const CliScene *s = f->scene;
  CeldColours     view = { s->depth.width, s->depth.height, (size_t) s->depth.width, rgba };
  CeldHost        quiet = { NULL, s->run->host.each, s->run->host.data };
  bool            going = s->run->host.progress (s->run->host.data, (double) frame / f->frames);

  return going && celd_scene_view (s->scene, f->camera (s, (int) frame), s->settings, &quiet, &view) == CELD_OK;
}

bool
cli_scene_write (const char *path, const CliScene *s, CeldCamera (*camera) (const CliScene *s, int frame), int frames,
                 const CliOptions *options)
{
  Frames       f = { s, camera, frames };
  CeldIoFrames out = { s->depth.width, s->depth.height, (size_t) frames, options->fps, options->size,
                       paint, &f };
  CeldIoError  error;
  bool         good;

  cli_run_stage (s->run, "views");
  good = celd_io_write_frames (path, &out, &error);
  cli_run_stage (s->run, NULL);
  return good || (error.text[0] ? cli_error ("%s", error.text)
                                : cli_check (cli_run_cancelled () ? CELD_CANCELLED : CELD_NO_MEMORY));
}
