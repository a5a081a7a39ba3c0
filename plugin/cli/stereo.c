/* celdepth stereo: what two eyes see, from completed layers and smooth depth.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

typedef struct { CeldOwnership own; CeldPlane depth; CeldLayers *layers; CeldScene *scene; CeldColours view[2]; } Stereo;

static CeldStatus
make_layers (CeldSession *session, const CeldColours *art, CliRun *run, Stereo *s)
{
  CeldLabels labels;
  CeldStatus status;

  cli_run_stage (run, "labels");
  status = celd_session_labels (session, &run->run, &labels, NULL);
  cli_run_stage (run, "depth");
  if (status == CELD_OK)
    status = celd_session_depth (session, &run->run, &s->depth, NULL);
  cli_run_stage (run, "layers");
  if (status == CELD_OK)
    status = celd_session_layers (session, art, 0, &run->run, &s->layers);
  if (status == CELD_OK)
    status = celd_session_ownership (session, &run->run, &s->own, NULL);
  if (status == CELD_OK)
    status = celd_scene_of_layers (s->layers, &s->own, &s->depth, &run->run, &s->scene);
  return status;
}

static CeldStatus
make_views (const CeldSettings *settings, CliRun *run, Stereo *s)
{
  CeldStatus status = CELD_OK;

  for (int i = 0; i < 2 && status == CELD_OK; i++)
    {
      cli_run_stage (run, i ? "right" : "left");
      status = celd_scene_view (s->scene, celd_camera_eye (i ? 1 : -1), settings, &run->run, &s->view[i]);
    }
  cli_run_stage (run, NULL);
  return status == CELD_OK && cli_run_cancelled () ? CELD_CANCELLED : status;
}

static bool
write_joined (const CliOptions *options, const Stereo *s)
{
  int         width = s->view[0].width, height = s->view[0].height;
  CeldColours joined = { 0 };
  bool        good;

  celd_stereo_size (options->settings.stereo, &width, &height);
  good = cli_colours_new (width, height, &joined) &&
         cli_check (celd_stereo_join (&s->view[0], &s->view[1], options->settings.stereo, &joined)) &&
         cli_write_colours (options->stereo, &joined);
  g_free (joined.data);
  return good;
}

/* What strains the eyes. */
static void
say_comfort (const CeldPlane *depth, const CeldSettings *settings)
{
  CeldComfort comfort;
  char        text[800];

  if (celd_stereo_comfort (depth, settings, &comfort) != CELD_OK)
    return;
  celd_comfort_text (&comfort, settings, text, sizeof text);
  if (text[0])
    cli_say ("%s", text);
}

/* Options that make layers whole: else there would be holes. */
static CliOptions
with_completion (const CliOptions *options)
{
  CliOptions o = *options;

  o.settings.complete = true;
  return o;
}

int
cli_stereo (const CliOptions *options)
{
  CliOptions   whole = with_completion (options);
  CeldSession *session = celd_session_new ();
  CliLayers    input = { 0 };
  CeldColours  art = { 0 };
  Stereo       s = { 0 };
  CliRun       run;
  int          code = CLI_FAILED;
  bool         good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (session, &whole, &input) &&
                      cli_art_read (options->input, options->colours, true, &input, &art);

  cli_layers_clear (&input);
  cli_run_begin (&run, options->quiet);
  good = good && cli_check (make_layers (session, &art, &run, &s)) &&
         cli_colours_new (art.width, art.height, &s.view[0]) && cli_colours_new (art.width, art.height, &s.view[1]) &&
         cli_check (make_views (&options->settings, &run, &s)) &&
         (!options->left || cli_write_colours (options->left, &s.view[0])) &&
         (!options->right || cli_write_colours (options->right, &s.view[1])) &&
         (!options->stereo || write_joined (options, &s));
  if (good)
    {
      const CeldOrder *order = NULL;

      code = celd_session_order (session, NULL, &order) == CELD_OK && order->n_cycles ? CLI_CONTRADICTED : CLI_DONE;
      if (code == CLI_CONTRADICTED)
        cli_say_cycles (order, celd_session_relations (session));
      if (!options->quiet)
        {
          say_comfort (&s.depth, &options->settings);
          cli_say_problems (celd_session_problems (session), celd_session_palette (session),
                            celd_session_relations (session));
        }
    }
  cli_run_end (&run);
  celd_layers_free (s.layers);
  celd_scene_free (s.scene);
  celd_session_free (session);
  g_free (s.view[0].data);
  g_free (s.view[1].data);
  g_free (art.data);
  return code;
}
