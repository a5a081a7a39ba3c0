/* Single steps, on pictures that earlier steps wrote.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

/* ------------------------------------------------------------------ shared */

/* Ink of the drawing for one purpose, with virtual contours. */
static bool
make_ink (CliLayers *layers, CeldPurpose purpose, const CliOptions *options, CliRun *run, CeldPlane *ink)
{
  CeldDrawing *drawing = &layers->drawing;
  CeldInkMode  mode = options->settings.ink;
  CeldStatus   status = CELD_OK;

  if (!cli_plane_new (drawing->luma.width, drawing->luma.height, ink))
    return false;
  cli_run_stage (run, "ink");
  if (layers->contours.data)
    status = celd_contours_bake (drawing, &layers->contours, purpose, mode, &run->host, drawing);
  if (status == CELD_OK)
    status = celd_ink (drawing, mode, &run->host, ink);
  return cli_run_finish (run, status);
}

/* Levels and the ink of their drawing: what expand and smooth start from. */
typedef struct
{
  CeldPlane levels, ink;
  CliLayers layers;
  CliRun    run;
} Step;

static bool
begin_step (const CliOptions *options, Step *step)
{
  *step = (Step) { 0 };
  cli_run_begin (&step->run, options->quiet);
  if (!cli_read_levels (options->input, &step->levels))
    return false;
  step->layers.width  = step->levels.width;
  step->layers.height = step->levels.height;
  return cli_layers_read (options->drawing, options, CLI_CONTOURS, &step->layers) &&
         make_ink (&step->layers, CELD_FOR_DEPTH, options, &step->run, &step->ink);
}

static int
end_step (Step *step, bool good)
{
  g_free (step->levels.data);
  g_free (step->ink.data);
  cli_layers_clear (&step->layers);
  cli_run_end (&step->run);
  return good ? CLI_DONE : CLI_FAILED;
}

/* The near end of levels whose encoding is not known: 1, or the largest rank. */
static float
nearest_level (const CeldPlane *levels)
{
  float nearest = 1;

  for (size_t i = 0; i < (size_t) levels->width * (size_t) levels->height; i++)
    nearest = MAX (nearest, levels->data[i]);
  return nearest;
}

/* ------------------------------------------------------------------ order */

/* What order works on. */
typedef struct
{
  CliLayers     layers;
  CeldPaint     paint;
  CeldLabels    labels;
  CeldPlane     ink, hint;
  CeldPalette   palette;
  CeldRelations relations, suggestions;
  CeldOrder     order;
  CeldProblems  problems;
  CliRun        run;
} Ordering;

static bool
load_ordering (const CliOptions *options, Ordering *o)
{
  char         *text = cli_relations_text (options);
  CeldTextError error;
  const char   *path = options->arrow_path ? options->arrow_path : "";
  bool          good = text &&
                       cli_check_text (celd_relations_parse (text, &o->relations, &error),
                                       cli_relations_name (options), &error) &&
                       cli_check_text (celd_arrow_path_parse (path, &o->relations, &error), "Arrow path", &error) &&
                       cli_layer_read (options->input, "labels", &o->layers, &o->paint) &&
                       cli_layers_read (options->drawing, options, CLI_ARROWS | CLI_CONTOURS, &o->layers) &&
                       (!options->depth_hint || cli_hint_read (options->depth_hint, &o->layers, &o->hint)) &&
                       cli_labels_new (o->paint.width, o->paint.height, &o->labels) &&
                       cli_check (celd_labels_read (&o->paint, &o->labels, &o->palette));

  g_free (text);
  return good && (!options->drawing || make_ink (&o->layers, CELD_FOR_SEGMENTATION, options, &o->run, &o->ink));
}

/* What the drawing suggests, and depth from elsewhere, and if that is to count, behind the relations. */
static CeldStatus
make_suggestions (const CeldPlane *ink, const CeldSettings *settings, Ordering *o)
{
  const CeldHost *host = &o->run.host;
  CeldStatus     status = celd_suggest (&o->labels, &o->palette, ink, host, &o->suggestions);

  if (status == CELD_OK && o->hint.data)
    status = celd_suggest_from_depth (&o->labels, &o->palette, ink, &o->hint, host, &o->suggestions);
  if (status == CELD_OK && settings->suggest)
    status = celd_suggestions_join (&o->labels, &o->palette, &o->relations, &o->suggestions, settings, ink, host,
                                    &o->relations);
  return status;
}

static CeldStatus
make_order (const CliOptions *options, Ordering *o)
{
  const CeldSettings *settings = &options->settings;
  const CeldPlane    *ink = o->ink.data ? &o->ink : NULL;
  const CeldHost     *host = &o->run.host;
  CeldStatus          status = celd_background_mark (&o->labels, ink, settings, &o->palette);

  if (status == CELD_OK && settings->same_colour == CELD_SAME_COLOUR_SEPARATE)
    status = celd_separate (host, &o->labels, &o->palette);
  if (status == CELD_OK && o->layers.arrows.data)
    status = celd_arrows_read (&o->layers.arrows, settings->arrow_style, host, &o->relations, &o->problems);
  if (status == CELD_OK && (options->suggestions || settings->suggest))
    status = make_suggestions (ink, settings, o);
  if (status == CELD_OK)
    status = celd_order (&o->labels, &o->palette, &o->relations, ink, settings, host, &o->order, &o->problems);
  return status;
}

static bool
write_ordering (const CliOptions *options, const Ordering *o)
{
  const CeldSettings *settings = &options->settings;
  bool                ranks = settings->encoding == CELD_ENCODING_RANK && o->order.levels > 1;
  CeldPlane           levels;
  bool                good = cli_plane_new (o->labels.width, o->labels.height, &levels);

  for (size_t i = 0; good && i < (size_t) levels.width * (size_t) levels.height; i++)
    levels.data[i] = celd_order_value (&o->order, o->order.level[o->labels.data[i] - 1], settings);
  good = good && cli_write_depth (options->levels, &levels,
                                  ranks ? celd_order_value (&o->order, o->order.levels - 1, settings) : 1);
  g_free (levels.data);
  return good && (!options->suggestions || cli_write_relations (options->suggestions, &o->suggestions));
}

static int
tell_ordering (const CliOptions *options, const Ordering *o)
{
  return cli_tell (options, &(CliReport) {
    .command   = "order",
    .width     = o->labels.width,
    .height    = o->labels.height,
    .palette   = &o->palette,
    .relations = &o->relations,
    .suggestions = options->suggestions || options->settings.suggest ? &o->suggestions : NULL,
    .order     = &o->order,
    .problems  = &o->problems,
    .settings  = &options->settings,
    .timings   = o->run.timings,
  });
}

static void
clear_ordering (Ordering *o)
{
  cli_layers_clear (&o->layers);
  g_free (o->paint.data);
  g_free (o->labels.data);
  g_free (o->ink.data);
  g_free (o->hint.data);
  celd_palette_clear (&o->palette);
  celd_relations_clear (&o->relations);
  celd_relations_clear (&o->suggestions);
  celd_order_clear (&o->order);
  celd_problems_clear (&o->problems);
  cli_run_end (&o->run);
}

int
cli_order (const CliOptions *options)
{
  Ordering o = { 0 };
  int      code = CLI_FAILED;
  bool     good;

  cli_run_begin (&o.run, options->quiet);
  good = load_ordering (options, &o);
  if (good)
    {
      cli_run_stage (&o.run, "order");
      good = cli_run_finish (&o.run, make_order (options, &o));
    }
  if (good && write_ordering (options, &o))
    code = tell_ordering (options, &o);
  clear_ordering (&o);
  return code;
}

/* ------------------------------------------------------------------ expand */

/* Flat colours, as segment writes them. */
static bool
read_regions (const char *path, CliLayers *layers, CeldLabels *regions)
{
  CeldPaint   paint = { 0 };
  CeldPalette palette = { 0 };
  bool        good = cli_layer_read (path, "labels", layers, &paint) &&
                     cli_labels_new (paint.width, paint.height, regions) &&
                     cli_check (celd_labels_read (&paint, regions, &palette));

  g_free (paint.data);
  celd_palette_clear (&palette);
  return good;
}

int
cli_expand (const CliOptions *options)
{
  Step       step;
  CeldLabels regions = { 0 };
  bool       good = begin_step (options, &step) &&
                    (!options->regions || read_regions (options->regions, &step.layers, &regions));

  if (good)
    {
      cli_run_stage (&step.run, "levels");
      good = cli_run_finish (&step.run, celd_expand_levels (&step.ink, &step.levels, regions.data ? &regions : NULL,
                                                            NULL, options->settings.expansion, &step.run.host,
                                                            &step.levels)) &&
             cli_write_depth (options->levels, &step.levels, nearest_level (&step.levels));
    }
  g_free (regions.data);
  return end_step (&step, good);
}

/* ------------------------------------------------------------------ smooth */

/* Pixels that are painted keep their level. */
static bool
read_anchors (const CliOptions *options, CliLayers *layers, CeldMask *anchors)
{
  CeldPaint   paint = { 0 };
  CeldLabels  seeds = { 0 };
  CeldPalette palette = { 0 };
  size_t      n = (size_t) layers->width * (size_t) layers->height;
  bool        good = cli_layer_read (options->anchors, "scribbles", layers, &paint) &&
                     cli_labels_new (paint.width, paint.height, &seeds) &&
                     cli_check (celd_scribbles_read (&paint, &options->settings, NULL, &seeds, &palette));

  *anchors = (CeldMask) { layers->width, layers->height, (size_t) layers->width, good ? g_try_new (uint8_t, n) : NULL };
  for (size_t i = 0; anchors->data && i < n; i++)
    anchors->data[i] = seeds.data[i] != 0;
  g_free (paint.data);
  g_free (seeds.data);
  celd_palette_clear (&palette);
  return good && (anchors->data || cli_check (CELD_NO_MEMORY));
}

int
cli_smooth (const CliOptions *options)
{
  Step      step;
  CeldMask  anchors = { 0 };
  CeldSolve solve = { 0 };
  bool      good = begin_step (options, &step) && (!options->anchors || read_anchors (options, &step.layers, &anchors));

  if (good)
    {
      float nearest = nearest_level (&step.levels);

      cli_run_stage (&step.run, "depth");
      good = cli_run_finish (&step.run, celd_smooth (&step.ink, &step.levels, anchors.data ? &anchors : NULL,
                                                     &options->settings, &step.run.host, &step.levels, &solve)) &&
             cli_write_depth (options->depth, &step.levels, nearest);
    }
  if (good && !solve.converged && !options->quiet)
    {
      CeldProblem problem = { .kind = CELD_PROBLEM_NOT_CONVERGED, .relation = CELD_NO_INDEX };

      cli_say_problems (&(CeldProblems) { &problem, 1 }, NULL, NULL);
    }
  g_free (anchors.data);
  return end_step (&step, good);
}

/* ------------------------------------------------------------------ relief */

/* A surface, or what stands up on a printer. */
static CeldSettings
mesh_settings (const CliOptions *options)
{
  CeldSettings s = options->settings;

  if (s.mesh == CELD_MESH_AUTO)
    s.mesh = celd_io_mesh_kind (options->mesh) == CELD_IO_STL ? CELD_MESH_SOLID : CELD_MESH_SURFACE;
  return s;
}

static bool
make_mesh (const CliOptions *options, const CeldRelief *relief, CliRun *run)
{
  CeldSettings   s = mesh_settings (options);
  CeldReliefMesh mesh = { 0 };
  CeldColours    art = { 0 };
  CliLayers      layers = { .width = relief->width, .height = relief->height };
  CeldStatus     status;
  bool           good;

  cli_run_stage (run, "mesh");
  status = celd_relief_mesh (relief, &s, &run->host, &mesh);
  if (status == CELD_BAD_VALUE) /* the settings are good */
    {
      cli_run_stage (run, NULL);
      return cli_error ("The borders alone have more than %.0f vertices: raise --most-vertices.",
                        (double) s.most_vertices);
    }
  good = cli_run_finish (run, status) && cli_art_read (options->drawing, options->colours, false, &layers, &art) &&
         cli_write_mesh (options->mesh, &mesh, &art);
  if (good && !options->quiet && mesh.error > 1.01 * (double) s.mesh_error)
    cli_say ("To have no more than %.0f vertices the mesh is up to %.1f pixels from the heights; --most-vertices "
             "allows more.", (double) s.most_vertices, mesh.error);
  celd_relief_mesh_clear (&mesh);
  cli_layers_clear (&layers);
  g_free (art.data);
  return good;
}

/* Smooth depth, if it is given. */
static bool
read_depth (const CliOptions *options, const CeldPlane *levels, CeldPlane *depth)
{
  if (!options->smooth_depth)
    return true;
  if (!cli_read_levels (options->smooth_depth, depth))
    return false;
  return (depth->width == levels->width && depth->height == levels->height) ||
         cli_error ("%s is %d x %d, but %s is %d x %d.", options->smooth_depth, depth->width, depth->height,
                    options->input, levels->width, levels->height);
}

int
cli_relief (const CliOptions *options)
{
  Step       step;
  CeldPlane  depth = { 0 };
  CeldRelief relief = { 0 };
  bool       good = begin_step (options, &step) && read_depth (options, &step.levels, &depth);

  if (good)
    {
      cli_run_stage (&step.run, "relief");
      good = cli_run_finish (&step.run, celd_relief (&step.ink, &step.levels, depth.data ? &depth : NULL,
                                                     &options->settings, &step.run.host, &relief));
    }
  if (good && options->height)
    good = cli_write_heights (options->height, &(CeldPlane) { relief.width, relief.height, (size_t) relief.width,
                                                              relief.z });
  if (good && options->mesh)
    good = make_mesh (options, &relief, &step.run);
  g_free (depth.data);
  celd_relief_clear (&relief);
  return end_step (&step, good);
}
