/* celdepth order: the depth order of regions.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

/* Input and results. */
typedef struct
{
  CliLayers     layers;
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
                       cli_check_relations (celd_relations_parse (text, &o->relations, &error), options, &error) &&
                       cli_check_text (celd_arrow_path_parse (path, &o->relations, &error), "--arrow-path", &error) &&
                       cli_regions_read (options->input, &o->layers, &o->labels, &o->palette) &&
                       cli_layers_read (options->drawing, options, CLI_ARROWS | CLI_CONTOURS, &o->layers) &&
                       (!options->depth_hint ||
                        (cli_hint_read (options->depth_hint, &o->layers, &o->hint) &&
                         cli_check_hint (options->depth_hint, &o->hint, options->quiet)));

  g_free (text);
  if (!options->drawing)
    return good && (options->quiet || cli_warn_of_regions (options->input, &o->labels));
  return good && cli_make_ink (&o->layers, CELD_FOR_SEGMENTATION, options, &o->run, &o->ink) &&
         cli_check_lines (options->drawing, &o->ink) &&
         cli_check_regions_of (options->input, &o->labels, &o->palette, options->drawing, &o->ink, options->quiet) &&
         cli_check_region_steps (options->input, &o->labels, options, &o->layers, options->drawing, &o->ink) &&
         (!o->hint.data || options->quiet ||
          cli_warn_of_lines (options->depth_hint, &o->hint, options->drawing, &o->ink));
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
    status = celd_suggest (&o->labels, &o->palette, ink, o->hint.data ? &o->hint : NULL, host, &o->suggestions);
  if (status == CELD_OK)
    status = celd_order_suggested (&o->labels, &o->palette, &o->relations, &o->suggestions, ink, settings, host,
                                   &o->relations, &o->order, &o->problems);
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
  good = good && cli_write_depth (options->unexpanded, &levels,
                                  ranks ? celd_order_value (&o->order, o->order.levels - 1, settings) : 1);
  g_free (levels.data);
  return good && (!options->suggestions || cli_write_relations (options->suggestions, &o->suggestions));
}

static int
tell_ordering (const CliOptions *options, const Ordering *o)
{
  return cli_finish (options, &(CliReport) {
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

static int
run_order (const CliOptions *options)
{
  Ordering o = { 0 };
  int      code = CLI_FAILED;
  bool     good;

  cli_run_begin (&o.run, options, "reading ink order writing");
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

const CliCommand cli_order_command = {
  .name     = "order",
  .step     = CLI_ORDER,
  .input    = "LABELS",
  .summary  = "Orders regions by depth. Contours stay where the segmentation put them.",
  .examples = "  celdepth order flat.png --arrows arrows.png --drawing bee.png --unexpanded-levels flat-levels.npy\n"
              "  celdepth order flat.png --relations '120,80 > 300,90; 300,90 > 10,10' \\\n"
              "      --unexpanded-levels flat-levels.npy",
  .settings = "ink background background-colour same-colour arrow-style on-cycle suggest encoding near-level far-level",
  .output   = "unexpanded-levels",
  .run      = run_order,
};
