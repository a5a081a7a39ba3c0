/* What popup makes of depth in the same run: the drawing with light or with shadows, its layers, and views for two
 * eyes.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

#include <string.h>

/* A copy of the art; free data with g_free. */
static bool
copy_art (const CeldColours *art, CeldColours *copy)
{
  if (!cli_colours_new (art->width, art->height, copy))
    return false;
  memcpy (copy->data, art->data, 4 * sizeof *art->data * art->stride * (size_t) art->height);
  return true;
}

/* ------------------------------------------------------------------ light and shadows */

static CeldStatus
light (CeldSession *session, const CliOptions *options, CliRun *run, CeldColours *lit)
{
  CeldPlane   ink, levels, gloss = { 0 };
  CeldVectors normals;
  CeldColours tone = { 0 };
  CeldStatus  status = celd_session_normals (session, &run->host, &normals, NULL);

  if (status == CELD_OK)
    status = celd_session_ink (session, &run->host, &ink, NULL);
  if (status == CELD_OK)
    status = celd_session_levels (session, &run->host, &levels, NULL);
  if (status == CELD_OK && !(cli_colours_new (lit->width, lit->height, &tone) &&
                             cli_plane_new (lit->width, lit->height, &gloss)))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_light (&normals, &ink, &levels, NULL, &options->settings, &run->host, &tone, &gloss);
  if (status == CELD_OK)
    status = celd_light_colours (&tone, &gloss, lit);
  g_free (tone.data);
  g_free (gloss.data);
  return status;
}

static CeldStatus
enhance (CeldSession *session, const CliOptions *options, CliRun *run, CeldColours *enhanced)
{
  CeldPlane  levels, change = { 0 };
  CeldStatus status = celd_session_levels (session, &run->host, &levels, NULL);

  if (status == CELD_OK && !cli_plane_new (enhanced->width, enhanced->height, &change))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK)
    status = celd_enhance (&levels, &options->settings, &run->host, &change);
  if (status == CELD_OK)
    status = celd_enhance_colours (&change, enhanced);
  g_free (change.data);
  return status;
}

/* Writes the art as `change` leaves it. */
static bool
write_changed (const char *path, const char *stage, CeldSession *session, const CliOptions *options,
               const CeldColours *art, CliRun *run,
               CeldStatus (*change) (CeldSession *session, const CliOptions *options, CliRun *run, CeldColours *art))
{
  CeldColours changed = { 0 };
  bool        good = copy_art (art, &changed);

  cli_run_stage (run, stage);
  good = good && cli_run_finish (run, change (session, options, run, &changed)) && cli_write_colours (path, &changed);
  g_free (changed.data);
  return good;
}

/* ------------------------------------------------------------------ layers and views */

static bool
write_layers (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  bool        linear = cli_layers_are_linear (options->layers, options->compositing);
  CeldLayers *layers = NULL;
  CeldColours copy = { 0 };
  bool        good = copy_art (art, &copy);

  if (good && !linear)
    cli_convert_light (true, false, copy.width, copy.height, copy.data);
  good = good && cli_layers_write (options->layers, session, linear, &copy, run, &layers);
  celd_layers_free (layers);
  g_free (copy.data);
  return good;
}

/* Views need completed layers, whatever those of --layers are. */
static bool
write_views (CeldSession *session, const CliOptions *options, CeldSettings settings, const CeldColours *art,
             CliRun *run)
{
  CliScene    scene = { .session = session, .settings = &options->settings, .run = run };
  CeldColours copy = { 0 };
  bool        good;

  settings.complete = true;
  good = cli_check (celd_session_set_settings (session, &settings)) && copy_art (art, &copy) &&
         cli_scene_make (&copy, &scene) && cli_views_write (options, &scene);
  g_free (copy.data);
  scene.session = NULL; /* it is not the scene's */
  cli_scene_clear (&scene);
  return good;
}

/* Levels of pictures that are shown are in [0,1], whatever --encoding is. */
bool
cli_uses_write (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  CeldSettings usual = celd_settings (), settings = options->settings;

  settings.encoding   = usual.encoding;
  settings.near_level = usual.near_level;
  settings.far_level  = usual.far_level;
  return cli_check (celd_session_set_settings (session, &settings)) &&
         (!options->shaded ||
          write_changed (options->shaded, "light", session, options, art, run, light)) &&
         (!options->enhanced ||
          write_changed (options->enhanced, "shadows", session, options, art, run, enhance)) &&
         (!options->layers || write_layers (session, options, art, run)) &&
         (!(options->left || options->right || options->stereo) ||
          write_views (session, options, settings, art, run));
}
