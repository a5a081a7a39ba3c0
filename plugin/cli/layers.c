/* celdepth layers: cuts a drawing into one layer for each region.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <string.h>

/* ------------------------------------------------------------------ names */

char *
cli_layer_name (const CeldPalette *palette, uint32_t label)
{
  char name[40];

  celd_label_name (palette, label, name, sizeof name);
  return g_strdup (name);
}

/* ------------------------------------------------------------------ writing */

typedef struct
{
  const CeldLayers *layers;
  CliRun           *run;
  bool              encode;    /* are colours linear light, and stored encoded? */
} Painter;

static bool
paint (void *host, size_t layer, float *rgba)
{
  const Painter  *painter = host;
  const CeldRect *box = &celd_layers_item (painter->layers, layer)->box;

  celd_layers_paint (painter->layers, layer, rgba);
  cli_convert_light (painter->encode, false, box->width, box->height, rgba);
  return painter->run->host.progress (painter->run->host.data,
                                      (double) layer / (double) celd_layers_count (painter->layers));
}

uint32_t
cli_page_of (const CeldPalette *palette)
{
  for (size_t k = 0; k < palette->n; k++)
    if (palette->item[k].background)
      return (uint32_t) k + 1;
  return 0;
}

/* Describes the layers for a file; the names end with g_free. */
static CeldStatus
describe (const CeldLayers *layers, const CeldPalette *palette, CeldIoLayer *item, char **name)
{
  size_t     n = celd_layers_count (layers);
  CeldJoint *joint = g_new0 (CeldJoint, n);
  CeldStatus status = celd_layers_joints (layers, cli_page_of (palette), joint);

  for (size_t i = 0; i < n; i++)
    {
      const CeldLayer  *layer = celd_layers_item (layers, i);
      const CeldRegion *region = &palette->item[layer->label - 1];

      name[i] = cli_layer_name (palette, layer->label);
      item[i] = (CeldIoLayer) { .name = name[i], .box = layer->box, .label = layer->label, .level = layer->level,
                                .background = region->background, .joint = joint[i] };
      memcpy (item[i].colour, region->colour, sizeof item[i].colour);
    }
  g_free (joint);
  return status;
}

static bool
write_stack (const char *path, const CeldLayers *layers, const CeldPalette *palette, bool encode, CeldColours *art,
             CliRun *run)
{
  size_t       n = celd_layers_count (layers);
  CeldIoLayer *item = g_new (CeldIoLayer, n);
  char       **name = g_new0 (char *, n + 1);
  Painter      painter = { layers, run, encode };
  CeldIoStack  stack = { art->width, art->height, item, n, art->data, paint, &painter };
  CeldIoError  error;
  bool         good = cli_check (describe (layers, palette, item, name));

  cli_run_stage (run, "writing");
  cli_convert_light (encode, false, art->width, art->height, art->data);
  if (good && !celd_io_write_layers (path, &stack, &error))
    good = error.text[0] ? cli_error ("%s", error.text) : cli_check (CELD_CANCELLED);
  cli_run_stage (run, NULL);
  g_strfreev (name);
  g_free (item);
  return good;
}

bool
cli_layers_are_linear (const char *path, const char *compositing)
{
  return celd_io_stack_kind (path) == CELD_IO_EXR_PARTS || (compositing && !strcmp (compositing, "linear"));
}

bool
cli_layers_write (const char *path, CeldSession *session, bool linear, CeldColours *art, CliRun *run,
                  CeldLayers **layers)
{
  bool       exr = celd_io_stack_kind (path) == CELD_IO_EXR_PARTS;
  CeldStore  store = exr ? CELD_STORE_FLOAT : linear ? CELD_STORE_8_BIT_SRGB : CELD_STORE_8_BIT;
  CeldStatus status;

  cli_run_stage (run, "layers");
  status = celd_session_layers (session, art, store, &run->host, layers);
  return cli_run_finish (run, status) &&
         write_stack (path, *layers, celd_session_palette (session), linear && !exr, art, run);
}

/* ------------------------------------------------------------------ the command */

/* Labels and order first, so that each has its own time and progress bar. */
static bool
make (CeldSession *session, CliRun *run, const CeldOrder **order)
{
  CeldLabels labels;
  CeldStatus status;

  cli_run_stage (run, "labels");
  status = celd_session_labels (session, &run->host, &labels, NULL);
  cli_run_stage (run, "order");
  if (status == CELD_OK)
    status = celd_session_order (session, &run->host, order);
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
  bool             linear = cli_layers_are_linear (options->output, options->compositing);
  CliRun           run;
  int              code = CLI_FAILED;
  bool             good;

  cli_run_begin (&run, options, "reading labels order layers writing");
  cli_run_stage (&run, "reading");
  good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (session, options, &input) &&
         cli_art_read (options, options->input, options->colours, linear, &input, &art);
  cli_layers_clear (&input);
  good = good && make (session, &run, &order) &&
         cli_layers_write (options->output, session, linear, &art, &run, &layers);
  if (good)
    code = finish (session, options, &run, order, &art, layers);
  cli_run_end (&run);
  celd_layers_free (layers);
  celd_session_free (session);
  g_free (art.data);
  return code;
}

bool
cli_compositing_check (CliOptions *options)
{
  const char *wanted = options->compositing;
  const char *output = options->output ? options->output : options->composed ? options->composed : options->layers;

  if (wanted && strcmp (wanted, "encoded") && strcmp (wanted, "linear"))
    return cli_error ("--compositing must be encoded or linear, not '%s'.", wanted);
  if (wanted && !strcmp (wanted, "encoded") && output &&
      celd_io_stack_kind (output) == CELD_IO_EXR_PARTS)
    return cli_error ("--compositing encoded cannot be used with .exr, whose colours are linear light.");
  return true;
}

static bool
check (CliOptions *options)
{
  return cli_compositing_check (options) &&
         (!options->hidden || options->settings.complete ||
          cli_error ("--hidden needs --complete yes: other layers have nothing that is hidden."));
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
