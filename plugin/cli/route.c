/* Shared by popup and segment: makes the results of a session, and writes them to files.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"
#include "watch.h"

/* Results of the session, borrowed; data NULL: not asked for. */
typedef struct
{
  CeldLabels           labels;
  const CeldClosures  *closures;
  const CeldRelations *suggestions;
  const CeldOrder     *order;
  CeldPlane            unexpanded, levels, depth, shading;
  CeldVectors          normals;
} Results;

/* Makes the results one by one, so that each has its own time and progress bar. */
static CeldStatus
make (CeldSession *session, const CliOptions *options, bool whole_route, CliRun *run, Results *results)
{
  CeldPlane  ink;
  CeldStatus status;

  cli_run_stage (run, "ink");
  status = celd_session_ink (session, &run->host, &ink, NULL);
  cli_run_stage (run, "labels");
  if (status == CELD_OK)
    status = celd_session_labels (session, &run->host, &results->labels, NULL);
  if (status == CELD_OK)
    status = celd_session_closures (session, &run->host, &results->closures);
  if (status == CELD_OK && (options->suggestions || options->suggested_arrows || options->settings.suggest))
    status = celd_session_suggestions (session, &run->host, &results->suggestions);
  if (status != CELD_OK || !whole_route)
    return status;
  cli_run_stage (run, "order");
  status = celd_session_order (session, &run->host, &results->order);
  if (status == CELD_OK && options->unexpanded)
    status = celd_session_unexpanded_levels (session, &run->host, &results->unexpanded, NULL);
  if (options->levels || options->depth || options->normals || options->shading)
    cli_run_stage (run, "levels");
  if (status == CELD_OK && options->levels)
    status = celd_session_levels (session, &run->host, &results->levels, NULL);
  if (options->depth)
    cli_run_stage (run, "depth");
  if (status == CELD_OK && options->depth)
    status = celd_session_depth (session, &run->host, &results->depth, NULL);
  if (options->normals || options->shading)
    cli_run_stage (run, "normals");
  if (status == CELD_OK && options->normals)
    status = celd_session_normals (session, &run->host, &results->normals, NULL);
  if (status == CELD_OK && options->shading)
    status = celd_session_shading (session, &run->host, &results->shading, NULL);
  return status;
}

/* Paints a layer of the drawing's size and writes it. */
static bool
write_layer (CeldSession *session, const char *path, const Results *results,
             CeldStatus (*make_layer) (CeldSession *session, const CeldHost *host, CeldPaint *paint))
{
  int       w = results->labels.width, h = results->labels.height;
  CeldPaint paint = { w, h, (size_t) w, g_try_new (uint8_t, 4 * (gsize) w * (gsize) h) };
  bool      good = cli_check (paint.data ? make_layer (session, NULL, &paint) : CELD_NO_MEMORY) &&
                   cli_write_layer (path, &paint);

  g_free (paint.data);
  return good;
}

/* The session keeps its normals, so that a copy is changed. */
static bool
write_normals (const CliOptions *options, const CeldVectors *normals)
{
  CeldVectors copy;
  bool        good;

  if (!options->directx)
    return cli_write_normals (options->normals, normals);
  good = cli_check (cli_normals_copy (normals, &copy) ? CELD_OK : CELD_NO_MEMORY);
  if (good)
    {
      cli_normals_down (&copy);
      good = cli_write_normals (options->normals, &copy);
    }
  g_free (copy.data);
  return good;
}

static bool
write_results (CeldSession *session, const CliOptions *options, const Results *results)
{
  bool  ranks = options->settings.encoding == CELD_ENCODING_RANK && results->order && results->order->levels > 1;
  float nearest = ranks ? celd_order_value (results->order, results->order->levels - 1, &options->settings) : 1;

  return (!options->labels  || cli_write_labels (options->labels, &results->labels, celd_session_palette (session))) &&
         (!options->closures ||
          write_layer (session, options->closures, results, celd_session_paint_closures)) &&
         (!options->suggestions || cli_write_relations (options->suggestions, results->suggestions)) &&
         (!options->suggested_arrows ||
          write_layer (session, options->suggested_arrows, results, celd_session_paint_suggestions)) &&
         (!options->unexpanded   || cli_write_depth (options->unexpanded, &results->unexpanded, nearest)) &&
         (!options->levels  || cli_write_depth (options->levels, &results->levels, nearest)) &&
         (!options->depth   || cli_write_depth (options->depth, &results->depth, nearest)) &&
         (!options->normals || write_normals (options, &results->normals)) &&
         (!options->shading || cli_write_shading (options->shading, &results->shading));
}

static int
finish (CeldSession *session, const char *command, const CliOptions *options, const CliRun *run, const Results *results)
{
  return cli_finish (options, &(CliReport) {
    .command   = command,
    .width     = results->labels.width,
    .height    = results->labels.height,
    .palette   = celd_session_palette (session),
    .relations = celd_session_relations (session),
    .suggestions = results->suggestions,
    .order     = results->order,
    .problems  = celd_session_problems (session),
    .closures  = results->closures,
    .settings  = &options->settings,
    .timings   = run->timings,
  });
}

/* Whether results show the drawing itself. */
static bool
needs_art (const CliOptions *options)
{
  return options->shaded || options->enhanced || options->maps || options->layers || options->mesh ||
         cli_views_wanted (options) || options->wiggle;
}

/* The stages of the results that are asked for. */
static char *
plan (const CliOptions *o, bool whole_route)
{
  char *views, *stages;

  if (!whole_route)
    return g_strdup ("reading ink labels writing");
  views  = cli_views_wanted (o) || o->wiggle ? cli_views_stages (o) : NULL;
  stages = g_strconcat ("reading ink labels order", o->levels || o->depth || o->normals || o->shading ? " levels" : "",
                        o->depth ? " depth" : "", o->normals || o->shading ? " normals" : "", " writing",
                        o->shaded || o->tone || o->rim ? " light" : "", o->occlusion ? " occlusion" : "",
                        o->maps ? " maps" : "", o->enhanced || o->shadow || o->view ? " shadows" : "",
                        o->layers ? " layers writing" : "", o->height || o->mesh ? " relief mesh" : "",
                        views ? " depth layers scene" : "", views, NULL);
  g_free (views);
  return stages;
}

/* What a run is made of: the session keeps its results for the next one. */
typedef struct { CeldSession *session; const CliOptions *options; const char *command; bool whole_route; } Route;

/* Reads the input, makes the results that are not there, and writes all; the exit code. */
static int
run_route (void *data)
{
  const Route      *route = data;
  CeldSession      *session = route->session;
  const CliOptions *options = route->options;
  CliLayers         layers = { 0 };
  CeldColours       art = { 0 };
  Results           results = { 0 };
  CliRun            run;
  int               code = CLI_FAILED;
  char             *stages = plan (options, route->whole_route);
  bool              good;

  cli_run_begin (&run, options, stages);
  cli_run_stage (&run, "reading");
  good = cli_session_load (session, options, &layers);
  if (good && needs_art (options))
    good = cli_art_read (options, options->input, options->colours, true, &layers, &art);
  cli_layers_clear (&layers);
  good = good && cli_run_finish (&run, make (session, options, route->whole_route, &run, &results));
  cli_run_stage (&run, "writing");
  if (good && write_results (session, options, &results) &&
      (!route->whole_route || cli_uses_write (session, options, &art, &run)))
    {
      cli_say_kept (true);
      code = finish (session, route->command, options, &run, &results);
    }
  cli_run_end (&run);
  g_free (art.data);
  g_free (stages);
  return code;
}

int
cli_run_route (const CliOptions *options, const char *command, bool whole_route)
{
  Route route = { celd_session_new (), options, command, whole_route };
  int   code = CLI_FAILED;

  if (cli_check (route.session ? CELD_OK : CELD_NO_MEMORY))
    code = options->watch ? cli_watch (options, run_route, &route) : run_route (&route);
  celd_session_free (route.session);
  return code;
}
