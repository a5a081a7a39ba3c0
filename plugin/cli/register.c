/* celdepth register: where each part of a drawing is in another one.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

#include <string.h>

/* The parts that move, and what the answer is made of. */
typedef struct
{
  const CliOptions *options;
  CliRun            run;
  CeldSession      *session;    /* with scribbles, arrows or relations */
  CliLayers         source, target;
  CeldPlane         ink[2];     /* of the two drawings */
  CeldLattice      *lattice;
} Registration;

/* ------------------------------------------------------------------ the lattice */

static bool
has_layers (const CliOptions *options, const CliLayers *layers)
{
  return layers->scribbles.data || layers->arrows.data || options->relations || options->relations_file ||
         options->arrow_path;
}

static CeldStatus
find_cracks (Registration *r, const CeldLabels *labels, const CeldPalette *palette, CeldCracks *cracks)
{
  return celd_cracks_find (labels, palette, celd_session_relations (r->session), &r->ink[0], cracks);
}

/* The lattice of the session's labels and order. */
static CeldStatus
lattice_of_session (Registration *r)
{
  CeldOwnership      own;
  CeldLabels         labels;
  const CeldOrder   *order;
  const CeldPalette *palette;
  CeldCracks         cracks = { 0 };
  CeldStatus         status = celd_session_labels (r->session, &r->run.host, &labels, NULL);

  palette = celd_session_palette (r->session);
  cli_run_stage (&r->run, "order");
  if (status == CELD_OK)
    status = celd_session_order (r->session, &r->run.host, &order);
  if (status == CELD_OK)
    status = find_cracks (r, &labels, palette, &cracks);
  cli_run_stage (&r->run, "lattice");
  if (status == CELD_OK)
    status = celd_session_ownership (r->session, &r->run.host, &own, NULL);
  if (status == CELD_OK)
    {
      CeldMovingParts parts = { .labels = &own.owner, .level = order->level, .n = order->n, .crack = cracks.item,
                                .n_cracks = cracks.n };

      for (size_t k = 0; k < palette->n; k++)
        if (palette->item[k].background)
          parts.background = (uint32_t) k + 1;
      status = celd_lattice_new (&r->ink[0], &parts, &r->options->settings, &r->run.host, &r->lattice);
    }
  celd_cracks_clear (&cracks);
  return status;
}

/* Whether a step succeeded; there is nothing to go by where a drawing is blank. */
static bool
check_moved (Registration *r, CeldStatus status)
{
  if (status != CELD_NOTHING_TO_GO_BY)
    return cli_run_finish (&r->run, status);
  cli_run_stage (&r->run, NULL);
  return cli_error ("\"%s\" is blank: give two drawings with lines, such as two frames of a clip.",
                    celd_ink_has_lines (&r->ink[0]) ? r->options->target : r->options->input);
}

static bool
lattice_of_levels (Registration *r)
{
  CeldPlane   levels = { 0 };
  CeldLabels  regions = { 0 };
  CeldPalette palette = { 0 };
  bool        good = cli_read_levels (r->options->source_levels, &levels) &&
                     cli_check_levels (r->options->source_levels, &levels) &&
                     (!r->options->regions ||
                      (cli_regions_read (r->options->regions, &r->source, &regions, &palette) &&
                       cli_check_regions_of (r->options->regions, &regions, &palette, r->options->input, &r->ink[0],
                                             r->options->quiet) &&
                       cli_check_region_steps (r->options->regions, &regions, r->options, &r->source, r->options->input,
                                               &r->ink[0])));

  cli_run_stage (&r->run, "lattice");
  if (good && (levels.width != r->source.width || levels.height != r->source.height))
    good = cli_error ("\"%s\" has %d x %d pixels, but \"%s\" has %d x %d; give both the same size.",
                      r->options->source_levels, levels.width, levels.height, r->options->input, r->source.width,
                      r->source.height);
  good = good && cli_check_no_lines (r->options->source_levels, &levels, r->options->input, &r->ink[0]) &&
         cli_check_steps (r->options->source_levels, &levels, r->options, &r->source, r->options->input, &r->ink[0]) &&
         check_moved (r, celd_lattice_of_levels (&r->ink[0], &levels, regions.data ? &regions : NULL,
                                                         &r->options->settings, &r->run.host, &r->lattice));
  g_free (levels.data);
  g_free (regions.data);
  celd_palette_clear (&palette);
  return good;
}

/* One part, all that is no paper around, if nothing is known of parts. */
static bool
make_lattice (Registration *r)
{
  CeldStatus status;

  if (r->options->source_levels)
    return lattice_of_levels (r);
  cli_run_stage (&r->run, "labels");
  status = has_layers (r->options, &r->source)
             ? lattice_of_session (r)
             : celd_lattice_new (&r->ink[0], NULL, &r->options->settings, &r->run.host, &r->lattice);
  return has_layers (r->options, &r->source) ? cli_run_finish (&r->run, status) : check_moved (r, status);
}

/* ------------------------------------------------------------------ results */

static bool
write_displacement (Registration *r)
{
  int        w = r->source.width, h = r->source.height;
  CeldShifts shifts = { w, h, (size_t) w, g_try_new (float, 2 * (size_t) w * (size_t) h) };
  bool       good = cli_check (shifts.data ? celd_lattice_displacement (r->lattice, &shifts) : CELD_NO_MEMORY) &&
                    cli_write_shifts (r->options->displacement, &shifts);

  g_free (shifts.data);
  return good;
}

static bool
write_warped (Registration *r)
{
  CeldColours art = { 0 }, warped = { 0 };
  bool        good = cli_art_read (r->options, r->options->input, r->options->colours, true, &r->source, &art) &&
                     cli_colours_new (art.width, art.height, &warped) &&
                     cli_check (celd_lattice_warp (r->lattice, &art, &warped)) &&
                     cli_write_colours (r->options->warped, &warped);

  g_free (art.data);
  g_free (warped.data);
  return good;
}

static bool
move_lattice (Registration *r)
{
  CeldPlane confidence = { 0 };
  bool      good = cli_plane_new (r->source.width, r->source.height, &confidence);

  cli_run_stage (&r->run, "registration");
  good = good && check_moved (r, celd_register (&r->ink[0], &r->ink[1], &r->options->settings, &r->run.host,
                                                r->lattice, &confidence));
  good = good && (!r->options->confidence || cli_write_values (r->options->confidence, &confidence));
  g_free (confidence.data);
  return good;
}

/* ------------------------------------------------------------------ the command */

/* Reads both drawings, and makes their ink. */
static bool
read_drawings (Registration *r)
{
  CliOptions plain = { .settings = r->options->settings };

  if (!cli_session_load (r->session, r->options, &r->source))
    return false;
  r->target.width  = r->source.width;
  r->target.height = r->source.height;
  return cli_layers_read (r->options->target, &plain, CLI_DRAWING, &r->target) &&
         cli_check_alike (r->options, &r->source, &r->target) &&
         cli_make_ink (&r->source, CELD_FOR_DEPTH, r->options, &r->run, &r->ink[0]) &&
         cli_make_ink (&r->target, CELD_FOR_DEPTH, r->options, &r->run, &r->ink[1]) &&
         (r->options->settings.flats || cli_check_lines (r->options->target, &r->ink[1]));
}

static int
finish (Registration *r)
{
  const CeldOrder *order = NULL;

  if (r->options->source_levels || !has_layers (r->options, &r->source) ||
      celd_session_order (r->session, &r->run.host, &order) != CELD_OK)
    return CLI_DONE;
  return cli_finish (r->options, &(CliReport) {
    .command   = "register",
    .width     = r->source.width,
    .height    = r->source.height,
    .palette   = celd_session_palette (r->session),
    .relations = celd_session_relations (r->session),
    .order     = order,
    .problems  = celd_session_problems (r->session),
    .settings  = &r->options->settings,
    .timings   = r->run.timings,
  });
}

static int
run_register (const CliOptions *options)
{
  Registration r = { .options = options, .session = celd_session_new () };
  int          code = CLI_FAILED;

  cli_run_begin (&r.run, options, "reading labels order lattice registration writing");
  if (cli_check (r.session ? CELD_OK : CELD_NO_MEMORY) && read_drawings (&r) && make_lattice (&r) &&
      move_lattice (&r) && (!options->displacement || write_displacement (&r)) &&
      (!options->warped || write_warped (&r)))
    code = finish (&r);
  celd_session_free (r.session);
  celd_lattice_free (r.lattice);
  cli_layers_clear (&r.source);
  cli_layers_clear (&r.target);
  g_free (r.ink[0].data);
  g_free (r.ink[1].data);
  cli_run_end (&r.run);
  return code;
}

static bool
check (CliOptions *options)
{
  if (options->displacement && cli_is_png (options->displacement))
    return cli_error ("--displacement %s: the name must end in .npy, .exr or .tif.", options->displacement);
  return true;
}

const CliCommand cli_register_command = {
  .name     = "register",
  .step     = CLI_REGISTER,
  .input    = "DRAWING|LAYERED",
  .second   = "TARGET",
  .summary  = "Finds where each part of a drawing is in the next one.",
  .examples = "  celdepth register walk1.png walk2.png --displacement moved.npy --confidence sure.png\n"
              "  celdepth register walk1.png walk2.png --scribbles strokes.png --arrows arrows.png \\\n"
              "      --warped moved.png\n"
              "  celdepth register walk1.png walk2.png --source-levels levels.npy --displacement moved.exr",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle expansion cell-size stiffness",
  .output   = "displacement",
  .check    = check,
  .run      = run_register,
};
