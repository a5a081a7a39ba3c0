/* What popup makes of depth in the same run: the drawing with light or with shadows, maps, its layers, a model, and
 * views.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

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

/* How the drawing is lit, of the levels' size; the caller frees data with g_free in either case. */
static CeldStatus
make_light (CeldSession *session, const CliOptions *options, const CeldPlane *levels, CliRun *run, CeldColours *tone,
            CeldPlane *gloss)
{
  CeldPlane   ink;
  CeldVectors normals;
  CeldStatus  status = celd_session_normals (session, &run->host, &normals, NULL);

  if (status == CELD_OK)
    status = celd_session_ink (session, &run->host, &ink, NULL);
  if (status == CELD_OK && !(cli_colours_new (levels->width, levels->height, tone) &&
                             cli_plane_new (levels->width, levels->height, gloss)))
    status = CELD_NO_MEMORY;
  return status == CELD_OK ? celd_light (&normals, &ink, levels, NULL, &options->settings, &run->host, tone, gloss)
                           : status;
}

static bool
write_light (CeldSession *session, const CliOptions *options, const CeldPlane *levels, const CeldColours *art,
             CliRun *run)
{
  CeldColours lit = { 0 }, tone = { 0 };
  CeldPlane   gloss = { 0 };
  bool        good;

  cli_run_stage (run, "light");
  good = (!options->shaded || copy_art (art, &lit)) &&
         cli_run_finish (run, make_light (session, options, levels, run, &tone, &gloss)) &&
         cli_light_write (options, &tone, &gloss, &lit);
  g_free (lit.data);
  g_free (tone.data);
  g_free (gloss.data);
  return good;
}

static bool
write_occlusion (const CliOptions *options, const CeldPlane *levels, CliRun *run)
{
  CeldPlane occlusion = { 0 };
  bool      good = cli_plane_new (levels->width, levels->height, &occlusion);

  cli_run_stage (run, "occlusion");
  good = good && cli_run_finish (run, celd_occlusion (levels, &options->settings, &run->host, &occlusion)) &&
         cli_write_values (options->occlusion, &occlusion);
  g_free (occlusion.data);
  return good;
}

/* Normals are copied, since the session keeps its own. */
static CeldStatus
make_maps (CeldSession *session, const CliOptions *options, const CeldPlane *levels, const CeldColours *art, CliRun *run,
           CeldPlane *occlusion, CeldVectors *normals, CliMaps *maps)
{
  CeldVectors own;
  CeldHost    quiet = { NULL, run->host.each, run->host.data };
  CeldStatus  status = celd_session_normals (session, &run->host, &own, NULL);

  if (status == CELD_OK)
    status = celd_occlusion (levels, &options->settings, &run->host, occlusion);
  if (status == CELD_OK && !cli_normals_copy (&own, normals))
    status = CELD_NO_MEMORY;
  if (status == CELD_OK && options->directx)
    cli_normals_down (normals);
  return status == CELD_OK ? cli_maps_make (options, art, normals, occlusion, &quiet, maps) : status;
}

static bool
write_maps (CeldSession *session, const CliOptions *options, const CeldPlane *levels, const CeldColours *art,
            CliRun *run)
{
  CeldPlane   occlusion = { 0 };
  CeldVectors normals = { 0 };
  CliMaps     maps = { 0 };
  bool        good = cli_plane_new (levels->width, levels->height, &occlusion) &&
                     cli_maps_new (levels->width, levels->height, &maps);

  cli_run_stage (run, "maps");
  good = good &&
         cli_run_finish (run, make_maps (session, options, levels, art, run, &occlusion, &normals, &maps)) &&
         cli_maps_write (options->maps, &maps);
  g_free (occlusion.data);
  g_free (normals.data);
  cli_maps_clear (&maps);
  return good;
}

static bool
write_shadows (const CliOptions *options, const CeldPlane *levels, const CeldColours *art, CliRun *run)
{
  CeldColours enhanced = { 0 };
  CeldPlane   change = { 0 };
  bool        good = (!options->enhanced || copy_art (art, &enhanced)) &&
                     cli_plane_new (levels->width, levels->height, &change);

  cli_run_stage (run, "shadows");
  good = good && cli_run_finish (run, celd_enhance (levels, &options->settings, &run->host, &change)) &&
         cli_shadows_write (options, levels, &change, &enhanced);
  g_free (enhanced.data);
  g_free (change.data);
  return good;
}

static bool
write_light_and_shadows (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  bool      lit = options->shaded || options->tone || options->rim;
  bool      shadows = options->enhanced || options->shadow || options->view;
  CeldPlane levels;

  if (!lit && !shadows && !options->occlusion && !options->maps)
    return true;
  return cli_run_finish (run, celd_session_levels (session, &run->host, &levels, NULL)) &&
         (!lit || write_light (session, options, &levels, art, run)) &&
         (!options->occlusion || write_occlusion (options, &levels, run)) &&
         (!options->maps || write_maps (session, options, &levels, art, run)) &&
         (!shadows || write_shadows (options, &levels, art, run));
}

/* ------------------------------------------------------------------ layers, models and views */

/* The same with encoded colours, unless linear ones are wanted. */
static bool
convert_art (const CeldColours *art, bool linear, CeldColours *copy)
{
  if (!copy_art (art, copy))
    return false;
  if (!linear)
    cli_convert_light (true, false, copy->width, copy->height, copy->data);
  return true;
}

static bool
write_layers (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  bool        linear = cli_layers_are_linear (options->layers, options->compositing);
  CeldLayers *layers = NULL;
  CeldColours copy = { 0 };
  bool        good = convert_art (art, linear, &copy);

  good = good && cli_layers_write (options->layers, session, linear, &copy, run, &layers);
  celd_layers_free (layers);
  g_free (copy.data);
  return good;
}

/* Settings of a model depend on the kind of file, too. */
static bool
write_relief (CeldSession *session, const CliOptions *options, CeldSettings settings, const CeldColours *art,
              CliRun *run)
{
  CeldColours copy = { 0 };
  bool        good;

  settings.mesh_kind = cli_model_settings (options).mesh_kind;
  good = cli_check (celd_session_set_settings (session, &settings)) &&
         (!options->mesh || convert_art (art, false, &copy)) && cli_relief_write (session, options, &copy, run);
  g_free (copy.data);
  return good;
}

/* Motion alone has to show depth, unless the artist says by how much views differ. */
static bool
write_wiggle (const CliOptions *options, CliScene *scene)
{
  CeldSettings settings = options->settings;

  if (!cli_setting_given (options, "disparity"))
    settings.disparity = CLI_WIGGLE_DISPARITY;
  scene->settings = &settings;
  return cli_wiggle_write (options, scene);
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
         cli_scene_make (&copy, &scene) && cli_views_write (options, &scene) &&
         (!options->wiggle || write_wiggle (options, &scene));
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
         write_light_and_shadows (session, options, art, run) &&
         (!options->layers || write_layers (session, options, art, run)) &&
         (!(options->height || options->mesh) || write_relief (session, options, settings, art, run)) &&
         (!(cli_views_wanted (options) || options->wiggle) || write_views (session, options, settings, art, run));
}
