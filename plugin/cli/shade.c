/* celdepth shade: normals and light from levels, also of a sheet of sprites, and maps for game engines.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

/* Input and results; data NULL: not given, or not asked for. */
typedef struct
{
  CeldPlane   levels, depth;
  CliLayers   layers;
  CeldPaint   hints;
  CeldColours art, matcap;
  CeldVectors normals;
  CeldPlane   ink, borders, shading, gloss, occlusion;
  CeldColours tone;
  CliMaps     maps;
} Shade;

/* ------------------------------------------------------------------ options */

static bool
check (CliOptions *options)
{
  const char *grid = options->grid;

  options->grid_columns = options->grid_rows = 1;
  if (grid && !(cli_number_read (&grid, 1, CELD_MAX_SIDE, &options->grid_columns) && *grid++ == 'x' &&
                cli_number_read (&grid, 1, CELD_MAX_SIDE, &options->grid_rows) && !*grid))
    return cli_error ("--grid cannot be '%s': the value must be columns and rows, such as 8x4.", options->grid);
  if (!cli_maps_check (options))
    return false;
  if (options->matcap)
    options->settings.light_model = CELD_MODEL_MATCAP;
  return options->settings.light_model != CELD_MODEL_MATCAP || options->matcap ||
         cli_error ("--light-model matcap needs --matcap.");
}

/* ------------------------------------------------------------------ reading */

static bool
read_depth (const CliOptions *options, Shade *s)
{
  return !options->smooth_depth || (cli_hint_read (options->smooth_depth, &s->layers, &s->depth) &&
                                    cli_check_depth (options->smooth_depth, &s->depth));
}

static bool
read_hints (const CliOptions *options, Shade *s)
{
  return !options->hints || (cli_layer_read (options->hints, "hints", &s->layers, &s->hints) &&
                             cli_check_strokes (options->hints, "hints", &s->hints));
}

/* Reads the art to light: that of --colours, or else the drawing. */
static bool
read_art (const CliOptions *options, Shade *s)
{
  if (!options->shaded && !options->maps)
    return true;
  if (!options->colours)
    return cli_art_read (options, options->drawing, NULL, true, &s->layers, &s->art);
  return cli_art_read (options, options->colours, options->colours, true, &s->layers, &s->art);
}

static bool
check_grid (const CliOptions *options, const CeldPlane *levels)
{
  return (levels->width % options->grid_columns == 0 && levels->height % options->grid_rows == 0) ||
         cli_error ("\"%s\" has %d x %d pixels, which cannot be divided into %d x %d equal cells.", options->input,
                    levels->width, levels->height, options->grid_columns, options->grid_rows);
}

static bool
read_all (const CliOptions *options, Shade *s)
{
  if (!cli_read_levels (options->input, &s->levels) || !cli_check_levels (options->input, &s->levels) ||
      !check_grid (options, &s->levels))
    return false;
  s->layers.width  = s->levels.width;
  s->layers.height = s->levels.height;
  return cli_layers_read (options->drawing, options, CLI_CONTOURS, &s->layers) &&
         cli_check_not_exchanged (options, &s->levels, &s->layers) && read_depth (options, s) &&
         read_hints (options, s) && read_art (options, s) &&
         (!options->matcap || (cli_read_colours (options->matcap, &s->matcap) &&
                               (options->quiet || cli_warn_of_matcap (options->matcap, &s->matcap))));
}

/* ------------------------------------------------------------------ results */

static bool
new_results (const CliOptions *options, Shade *s)
{
  int  w = s->levels.width, h = s->levels.height;
  bool grey = options->shading && !options->matcap, good = cli_plane_new (w, h, &s->ink);
  bool lit = options->shaded || options->tone || options->rim || (options->shading && !grey);

  s->normals = (CeldVectors) { w, h, (size_t) w, g_try_new (float, 3 * (gsize) w * (gsize) h) };
  good       = good && (!s->layers.contours.data || cli_plane_new (w, h, &s->borders));
  good       = good && cli_check (s->normals.data ? CELD_OK : CELD_NO_MEMORY);
  good       = good && (!grey || cli_plane_new (w, h, &s->shading));
  good       = good && (!lit || (cli_colours_new (w, h, &s->tone) && cli_plane_new (w, h, &s->gloss)));
  good       = good && (!(options->occlusion || options->maps) || cli_plane_new (w, h, &s->occlusion));
  return good && (!options->maps || cli_maps_new (w, h, &s->maps));
}

static void
clear (Shade *s)
{
  float *all[] = { s->levels.data, s->depth.data, s->art.data, s->matcap.data, s->normals.data, s->ink.data,
                   s->borders.data, s->shading.data, s->gloss.data, s->occlusion.data, s->tone.data };

  for (size_t i = 0; i < G_N_ELEMENTS (all); i++)
    g_free (all[i]);
  cli_maps_clear (&s->maps);
  g_free (s->hints.data);
  cli_layers_clear (&s->layers);
}

/* ------------------------------------------------------------------ one cell */

#define CROP(view, cell, channels) \
  do \
    if ((view)->data) \
      { \
        (view)->data  += (size_t) (channels) * ((size_t) (cell)->y * (view)->stride + (size_t) (cell)->x); \
        (view)->width  = (cell)->width; \
        (view)->height = (cell)->height; \
      } \
  while (0)

static Shade
crop (const Shade *whole, const CeldRect *cell)
{
  Shade s = *whole;

  CROP (&s.levels, cell, 1);
  CROP (&s.depth, cell, 1);
  CROP (&s.layers.drawing.luma, cell, 1);
  CROP (&s.layers.drawing.alpha, cell, 1);
  CROP (&s.layers.contours, cell, 4);
  CROP (&s.hints, cell, 4);
  CROP (&s.art, cell, 4);
  CROP (&s.normals, cell, 3);
  CROP (&s.ink, cell, 1);
  CROP (&s.borders, cell, 1);
  CROP (&s.shading, cell, 1);
  CROP (&s.gloss, cell, 1);
  CROP (&s.occlusion, cell, 1);
  CROP (&s.tone, cell, 4);
  for (int map = 0; map < CLI_MAPS; map++)
    CROP (&s.maps.map[map], cell, 4);
  return s;
}

static CeldStatus
make_ink (const CeldSettings *settings, const CeldHost *host, Shade *s)
{
  CeldDrawing *drawing = &s->layers.drawing;
  CeldStatus   status = CELD_OK;

  if (s->layers.contours.data)
    status = celd_contours_bake (drawing, &s->layers.contours, CELD_FOR_DEPTH, settings->ink, host, drawing);
  if (status == CELD_OK)
    status = celd_ink (drawing, settings->ink, host, &s->ink);
  if (status == CELD_OK && s->borders.data)
    status = celd_contours_bake (drawing, &s->layers.contours, CELD_FOR_SEGMENTATION, settings->ink, host, drawing);
  return status == CELD_OK && s->borders.data ? celd_ink (drawing, settings->ink, host, &s->borders) : status;
}

static CeldStatus
shade_cell (const CliOptions *options, const CeldHost *host, Shade *s)
{
  const CeldSettings *settings = &options->settings;
  CeldStatus          status = make_ink (settings, host, s);

  if (status == CELD_OK)
    status = celd_normals_hinted (&s->ink, s->borders.data ? &s->borders : NULL, &s->levels,
                                  s->depth.data ? &s->depth : NULL, s->hints.data ? &s->hints : NULL, settings, host,
                                  &s->normals);
  if (status == CELD_OK && s->shading.data)
    status = celd_shade (&s->normals, settings, &s->shading);
  if (status == CELD_OK && s->tone.data)
    status = celd_light (&s->normals, &s->ink, &s->levels, s->matcap.data ? &s->matcap : NULL, settings, host, &s->tone,
                         &s->gloss);
  if (status == CELD_OK && s->occlusion.data)
    status = celd_occlusion (&s->levels, settings, host, &s->occlusion);
  if (status == CELD_OK && options->directx)
    cli_normals_down (&s->normals);
  return status == CELD_OK && options->maps
           ? cli_maps_make (options, &s->art, &s->normals, &s->occlusion, host, &s->maps) : status;
}

/* Shades each cell by itself. */
static bool
shade_cells (const CliOptions *options, CliRun *run, const Shade *s)
{
  CeldRect   cell = { 0, 0, s->levels.width / options->grid_columns, s->levels.height / options->grid_rows };
  bool       one = options->grid_columns * options->grid_rows == 1;
  CeldHost   quiet = { NULL, run->host.each, run->host.data };
  CeldStatus status = CELD_OK;

  cli_run_stage (run, "shade");
  for (cell.y = 0; cell.y < s->levels.height && status == CELD_OK; cell.y += cell.height)
    for (cell.x = 0; cell.x < s->levels.width && status == CELD_OK; cell.x += cell.width)
      {
        Shade part = crop (s, &cell);

        status = cli_run_cancelled () ? CELD_CANCELLED : shade_cell (options, one ? &run->host : &quiet, &part);
      }
  return cli_run_finish (run, status);
}

/* ------------------------------------------------------------------ writing */

/* Writes lit art, or light on white. */
static bool
write_lit (const char *path, const CeldColours *tone, const CeldPlane *gloss, CeldColours *on)
{
  return cli_check (celd_light_colours (tone, gloss, on)) && cli_write_colours (path, on);
}

bool
cli_light_write (const CliOptions *options, const CeldColours *tone, const CeldPlane *gloss, CeldColours *art)
{
  CeldColours layer = { 0 };
  bool        good = (!options->shaded || write_lit (options->shaded, tone, gloss, art)) &&
                     (!options->tone || cli_write_colours (options->tone, tone));

  if (good && options->rim)
    good = cli_colours_new (tone->width, tone->height, &layer) && cli_check (celd_light_layer (gloss, &layer)) &&
           cli_write_colours (options->rim, &layer);
  g_free (layer.data);
  return good;
}

/* Shading in the colours of a matcap. */
static bool
write_coloured_shading (const CliOptions *options, const Shade *s)
{
  CeldColours white = { 0 };
  size_t      n = 4 * (size_t) s->levels.width * (size_t) s->levels.height;
  bool        good = cli_colours_new (s->levels.width, s->levels.height, &white);

  for (size_t i = 0; i < n && good; i++)
    white.data[i] = 1;
  good = good && write_lit (options->shading, &s->tone, &s->gloss, &white);
  g_free (white.data);
  return good;
}

static bool
write_all (const CliOptions *options, Shade *s)
{
  return (!options->normals || cli_write_normals (options->normals, &s->normals)) &&
         (!s->shading.data || cli_write_shading (options->shading, &s->shading)) &&
         (!s->tone.data || cli_light_write (options, &s->tone, &s->gloss, &s->art)) &&
         (!(options->shading && options->matcap) || write_coloured_shading (options, s)) &&
         (!options->occlusion || cli_write_values (options->occlusion, &s->occlusion)) &&
         (!options->maps || cli_maps_write (options->maps, &s->maps));
}

/* Whether levels and depth are no drawings; warns of hints that look like one, since paint may cover all lines. */
static bool
check_no_drawings (const CliOptions *options, const Shade *s)
{
  CeldLayerLines lines = CELD_LAYER_WITHOUT_LINES;

  if (!cli_check_no_lines (options->input, &s->levels, options->drawing, &s->ink) ||
      (s->depth.data && !cli_check_no_lines (options->smooth_depth, &s->depth, options->drawing, &s->ink)) ||
      (s->hints.data && !cli_check (celd_layer_lines (&s->hints, &s->ink, &lines))) ||
      !cli_check_steps (options->input, &s->levels, options, &s->layers, options->drawing, &s->ink))
    return false;
  if (lines != CELD_LAYER_WITHOUT_LINES && !options->quiet)
    cli_say ("\"%s\" has the lines of \"%s\", as if it were the drawing: hints are paint beside lines.", options->hints,
             options->drawing);
  return true;
}

static int
run_shade (const CliOptions *options)
{
  Shade  s = { 0 };
  CliRun run;
  bool   good;

  cli_run_begin (&run, options, "reading shade writing");
  good = read_all (options, &s) && new_results (options, &s) && shade_cells (options, &run, &s) &&
         cli_check_lines (options->drawing, &s.ink) &&
         check_no_drawings (options, &s);
  if (good && !options->quiet)
    cli_warn_if_flat (options->input, &s.levels);
  good = good && write_all (options, &s);
  clear (&s);
  cli_run_end (&run);
  return good ? CLI_DONE : CLI_FAILED;
}

const CliCommand cli_shade_command = {
  .name     = "shade",
  .step     = CLI_SHADE,
  .input    = "LEVELS",
  .summary  = "Computes normals that bend at contours, and shades them.",
  .examples = "  celdepth shade levels.npy --drawing bee.png --normals normals.png --shading shading.png \\\n"
              "      --light-azimuth 45\n"
              "  celdepth shade levels.npy --drawing bee.png --colours colours.png --shaded bee-lit.png \\\n"
              "      --light-model toon --specular 0.4 --rim-light 0.3\n"
              "  celdepth shade levels.npy --drawing walk.png --maps walk.png --grid 8x1",
  .settings = "ink ink-threshold hold-gaps bulge bevel creases frame-outline light-model toon-steps light-background "
              "light light-azimuth light-elevation ambient light-x light-y light-height specular shininess rim-light "
              "rim-power shadow-size shadow-strength",
  .output   = "shading",
  .check    = check,
  .run      = run_shade,
};
