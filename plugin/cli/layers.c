/* celdepth layers: cuts a drawing into one layer for each region.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <babl/babl.h>
#include <string.h>

/* ------------------------------------------------------------------ names */

static bool
same_colour (const CeldPalette *palette, size_t a, size_t b)
{
  return !memcmp (palette->item[a].colour, palette->item[b].colour, sizeof palette->item[a].colour);
}

/* The name of a label's layer: its colour, and its number if several labels have that colour. */
static char *
name_of (const CeldPalette *palette, uint32_t label)
{
  const uint8_t *c = palette->item[label - 1].colour;
  size_t         alike = 0;

  if (!c[3])
    return g_strdup ("background");
  for (size_t i = 0; i < palette->n; i++)
    alike += same_colour (palette, i, label - 1);
  return alike > 1 ? g_strdup_printf ("#%02x%02x%02x label %u", c[0], c[1], c[2], label)
                   : g_strdup_printf ("#%02x%02x%02x", c[0], c[1], c[2]);
}

/* ------------------------------------------------------------------ writing */

typedef struct
{
  const CeldLayers *layers;
  CliRun           *run;
  const Babl       *fish;      /* converts from the colours of compositing to those of storing; NULL: they are equal */
} Painter;

static bool
paint (void *host, size_t layer, float *rgba)
{
  const Painter  *painter = host;
  const CeldRect *box = &celd_layers_item (painter->layers, layer)->box;

  celd_layers_paint (painter->layers, layer, rgba);
  for (int y = 0; painter->fish && y < box->height; y++)
    {
      float *row = rgba + 4 * (size_t) y * (size_t) box->width;

      babl_process (painter->fish, row, row, box->width);
    }
  return painter->run->host.progress (painter->run->host.data,
                                      (double) layer / (double) celd_layers_count (painter->layers));
}

static bool
write_layers (const char *path, const CeldLayers *layers, const CeldPalette *palette, bool encode, CeldColours *art,
              CliRun *run)
{
  size_t       n = celd_layers_count (layers);
  CeldIoLayer *item = g_new (CeldIoLayer, n);
  char       **name = g_new0 (char *, n + 1);
  Painter      painter = { layers, run, NULL };
  CeldIoStack  stack = { art->width, art->height, item, n, art->data, paint, &painter };
  CeldIoError  error;
  bool         good;

  for (size_t i = 0; i < n; i++)
    {
      name[i] = name_of (palette, celd_layers_item (layers, i)->label);
      item[i] = (CeldIoLayer) { name[i], celd_layers_item (layers, i)->box };
    }
  cli_run_stage (run, "writing");
  if (encode)
    {
      painter.fish = babl_fish (babl_format ("RGBA float"), babl_format ("R'G'B'A float"));
      for (int y = 0; y < art->height; y++)
        babl_process (painter.fish, art->data + 4 * (size_t) y * art->stride,
                      art->data + 4 * (size_t) y * art->stride, art->width);
    }
  good = celd_io_write_layers (path, &stack, &error);
  cli_run_stage (run, NULL);
  if (!good)
    good = error.text[0] ? cli_error ("%s", error.text) : cli_check (CELD_CANCELLED);
  g_strfreev (name);
  g_free (item);
  return good;
}

/* ------------------------------------------------------------------ the command */

static bool
make (CeldSession *session, const CeldColours *art, CeldStore store, CliRun *run, const CeldOrder **order,
      CeldLayers **layers)
{
  CeldLabels labels;
  CeldStatus status;

  cli_run_stage (run, "labels");
  status = celd_session_labels (session, &run->host, &labels, NULL);
  cli_run_stage (run, "order");
  if (status == CELD_OK)
    status = celd_session_order (session, &run->host, order);
  cli_run_stage (run, "layers");
  if (status == CELD_OK)
    status = celd_session_layers (session, art, store, &run->host, layers);
  return cli_run_finish (run, status);
}

static int
finish (CeldSession *session, const CliOptions *options, const CliRun *run, const CeldOrder *order,
      const CeldColours *art, const CeldLayers *layers)
{
  return cli_finish (options, &(CliReport) {
    .command   = "layers",
    .width     = art->width,
    .height    = art->height,
    .palette   = celd_session_palette (session),
    .relations = celd_session_relations (session),
    .order     = order,
    .problems  = celd_session_problems (session),
    .layers    = layers,
    .settings  = &options->settings,
    .timings   = run->timings,
  });
}

static int
run_layers (const CliOptions *options)
{
  CeldSession     *session = celd_session_new ();
  CliLayers        input = { 0 };
  CeldColours      art = { 0 };
  CeldLayers      *layers = NULL;
  const CeldOrder *order = NULL;
  bool             exr = celd_io_stack_kind (options->output) == CELD_IO_EXR_PARTS;
  bool             linear = exr || (options->light && !strcmp (options->light, "linear"));
  CeldStore        store = exr ? CELD_STORE_FLOAT : linear ? CELD_STORE_8_BIT_SRGB : CELD_STORE_8_BIT;
  CliRun           run;
  int              code = CLI_FAILED;
  bool             good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) &&
                          cli_session_load (session, options, &input) &&
                          cli_art_read (options->input, options->colours, linear, &input, &art);

  cli_layers_clear (&input);
  cli_run_begin (&run, options->quiet);
  good = good && make (session, &art, store, &run, &order, &layers) &&
         write_layers (options->output, layers, celd_session_palette (session), linear && !exr, &art, &run);
  if (good)
    code = finish (session, options, &run, order, &art, layers);
  cli_run_end (&run);
  celd_layers_free (layers);
  celd_session_free (session);
  g_free (art.data);
  return code;
}

static bool
check (CliOptions *options)
{
  const char *light = options->light;

  if (light && strcmp (light, "encoded") && strcmp (light, "linear"))
    return cli_error ("--light cannot be '%s': the value must be encoded|linear.", light);
  if (light && !strcmp (light, "encoded") && options->output &&
      celd_io_stack_kind (options->output) == CELD_IO_EXR_PARTS)
    return cli_error ("--light encoded cannot be used with .exr, whose colours are linear light.");
  return true;
}

const CliCommand cli_layers_command = {
  .name     = "layers",
  .step     = CLI_LAYERS,
  .input    = "DRAWING|LAYERED",
  .summary  = "Cuts a drawing into one layer per region, each with its own ink, in the order of depth.",
  .examples = "  celdepth layers bee.png --scribbles strokes.png --arrows arrows.png --output bee.ora\n"
              "  celdepth layers bee.png --scribbles strokes.png --relations '120,80 > 300,90' --complete yes \\\n"
              "      --colours painted.png --output bee.exr --report report.json\n"
              "  celdepth layers page.psd --output layers      (a folder of PNG files)",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle suggest expansion complete",
  .output   = "output",
  .check    = check,
  .run      = run_layers,
};
