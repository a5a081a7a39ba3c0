/* celdepth relief: heights and meshes, of a drawing with its layers or from levels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "options.h"

static bool
wants_parts (const CliOptions *options)
{
  return options->mesh && options->settings.mesh_kind != CELD_MESH_HEIGHTFIELD;
}

static bool
wants_heights (const CliOptions *options)
{
  return options->height || (options->mesh && !wants_parts (options));
}

/* ------------------------------------------------------------------ heights */

/* Whether making meshes succeeded; if not, prints why.  Says where the error had to be increased. */
static bool
finish_mesh (const CliOptions *options, CliRun *run, CeldStatus status, double error)
{
  if (status == CELD_BAD_VALUE) /* with valid settings: the outlines alone have too many vertices */
    {
      cli_run_stage (run, NULL);
      return cli_error ("The outlines alone have more than %.0f vertices: increase --most-vertices.",
                        (double) options->settings.most_vertices);
    }
  if (status == CELD_BAD_SIZE) /* of layers that agree: a part has no room in the texture */
    {
      cli_run_stage (run, NULL);
      return cli_error ("A part is too large for a mesh: its texture has up to %d pixels a side, some of them around "
                        "the part. Make the drawing smaller.", CELD_MAX_SIDE);
    }
  if (!cli_run_finish (run, status))
    return false;
  if (!options->quiet && error > 1.01 * (double) options->settings.mesh_error)
    cli_say ("With %.0f vertices at most, the mesh deviates by up to %.1f pixels from the heights; increase "
             "--most-vertices to allow more.", (double) options->settings.most_vertices, error);
  return true;
}

/* Writes one surface: closed for STL, for printing, and else open. */
static bool
write_surface (const CliOptions *options, const CeldRelief *relief, const CeldColours *art, CliRun *run)
{
  CeldSettings   s = options->settings;
  CeldReliefMesh mesh = { 0 };
  CeldStatus     status;
  bool           good;

  s.mesh_kind = celd_io_mesh_kind (options->mesh) == CELD_IO_STL ? CELD_MESH_SOLID : CELD_MESH_SURFACE;
  cli_run_stage (run, "mesh");
  status = celd_relief_mesh (relief, &s, &run->host, &mesh);
  good   = finish_mesh (options, run, status, mesh.error) &&
           cli_write_meshes (options->mesh, &(CeldIoMesh) { "relief", &mesh }, 1, art);
  celd_relief_mesh_clear (&mesh);
  return good;
}

static bool
write_relief (const CliOptions *options, const CeldRelief *relief, const CeldColours *art, CliRun *run)
{
  CeldPlane heights = { relief->width, relief->height, (size_t) relief->width, relief->z };

  return (!options->height || cli_write_heights (options->height, &heights)) &&
         (!options->mesh || wants_parts (options) || write_surface (options, relief, art, run));
}

/* ------------------------------------------------------------------ of levels */

/* Reads smooth depth if it is given. */
static bool
read_depth (const CliOptions *options, const CliStep *step, CeldPlane *depth)
{
  const CeldPlane *levels = &step->levels;

  if (!options->smooth_depth)
    return true;
  if (!cli_read_levels (options->smooth_depth, depth) || !cli_check_depth (options->smooth_depth, depth))
    return false;
  if (depth->width != levels->width || depth->height != levels->height)
    return cli_error ("\"%s\" has %d x %d pixels, but \"%s\" has %d x %d; give both the same size.",
                      options->smooth_depth, depth->width, depth->height, options->input, levels->width,
                      levels->height);
  return cli_check_no_lines (options->smooth_depth, depth, options->drawing, &step->ink);
}

static bool
relief_of_levels (const CliOptions *options, const CeldColours *art, CliStep *step)
{
  CeldPlane  depth = { 0 };
  CeldRelief relief = { 0 };
  bool       good = read_depth (options, step, &depth);

  if (good)
    {
      cli_run_stage (&step->run, "relief");
      good = cli_run_finish (&step->run, celd_relief (&step->ink, cli_step_borders (step), &step->levels,
                                                      depth.data ? &depth : NULL, &options->settings,
                                                      &step->run.host, &relief)) &&
             write_relief (options, &relief, art, &step->run);
    }
  g_free (depth.data);
  celd_relief_clear (&relief);
  return good;
}

static bool
model_of_levels (const CliOptions *options, const CeldColours *art, CliStep *step)
{
  CeldLabels  regions = { 0 };
  CeldPalette palette = { 0 };
  CeldModel   model = { 0 };
  CeldStatus  status;
  bool        good = !options->regions || cli_step_regions (options, step, &regions, &palette);

  if (good)
    {
      const CeldLabels  *known = regions.data ? &regions : NULL;
      CeldSettings       settings = cli_model_settings (options);

      cli_run_stage (&step->run, "mesh");
      status = known ? celd_flatten_levels (known, palette.n, &step->levels) : CELD_OK;
      if (status == CELD_OK)
        status = celd_model_of_levels (&step->ink, cli_step_borders (step), &step->levels, known, art, &settings,
                                       &step->run.host, &model);
      good = finish_mesh (options, &step->run, status, model.error) &&
             cli_model_write (options->mesh, &model, cli_model_names_of_regions (&step->levels, known, &palette));
    }
  g_free (regions.data);
  celd_palette_clear (&palette);
  celd_model_clear (&model);
  return good;
}

static int
run_on_levels (const CliOptions *options)
{
  CliStep     step;
  CeldColours art = { 0 };
  bool        good = cli_step_begin (options, &step) &&
                     (!options->mesh || cli_art_read (options, options->drawing, options->colours, false, &step.layers,
                                                      &art)) &&
                     (!wants_heights (options) || relief_of_levels (options, &art, &step)) &&
                     (!wants_parts (options) || model_of_levels (options, &art, &step));

  g_free (art.data);
  return cli_step_end (&step, good);
}

/* ------------------------------------------------------------------ of a drawing with its layers */

static CeldStatus
make_order (CeldSession *session, CliRun *run, CeldLabels *labels, const CeldOrder **order)
{
  CeldStatus status;

  cli_run_stage (run, "labels");
  status = celd_session_labels (session, &run->host, labels, NULL);
  cli_run_stage (run, "order");
  if (status == CELD_OK)
    status = celd_session_order (session, &run->host, order);
  return status;
}

static bool
relief_of_session (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  CeldRelief relief = { 0 };
  bool       good;

  cli_run_stage (run, "relief");
  good = cli_run_finish (run, celd_session_relief (session, &run->host, &relief)) &&
         write_relief (options, &relief, art, run);
  celd_relief_clear (&relief);
  return good;
}

static bool
model_of_session (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  CeldModel  model = { 0 };
  CeldStatus status;
  bool       good;

  cli_run_stage (run, "mesh");
  status = celd_session_model (session, art, &run->host, &model);
  good   = finish_mesh (options, run, status, model.error) &&
           cli_model_write (options->mesh, &model, cli_model_names (celd_session_palette (session)));
  celd_model_clear (&model);
  return good;
}

bool
cli_relief_write (CeldSession *session, const CliOptions *options, const CeldColours *art, CliRun *run)
{
  return (!wants_heights (options) || relief_of_session (session, options, art, run)) &&
         (!wants_parts (options) || model_of_session (session, options, art, run));
}

static int
finish (CeldSession *session, const CliOptions *options, const CliRun *run, const CeldLabels *labels,
        const CeldOrder *order)
{
  return cli_finish (options, &(CliReport) {
    .command   = "relief",
    .width     = labels->width,
    .height    = labels->height,
    .palette   = celd_session_palette (session),
    .relations = celd_session_relations (session),
    .order     = order,
    .problems  = celd_session_problems (session),
    .settings  = &options->settings,
    .timings   = run->timings,
  });
}

static int
run_on_drawing (const CliOptions *options)
{
  CeldSession     *session = celd_session_new ();
  CliOptions       whole = *options;
  CliLayers        input = { 0 };
  CeldColours      art = { 0 };
  CliRun           run;
  CeldLabels       labels;
  const CeldOrder *order = NULL;
  int              code = CLI_FAILED;
  bool             good;

  whole.settings = cli_model_settings (options);
  cli_run_begin (&run, options, "reading labels order relief mesh writing");
  cli_run_stage (&run, "reading");
  good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (session, &whole, &input) &&
         (!options->mesh || cli_art_read (options, options->input, options->colours, false, &input, &art));
  if (good && cli_run_finish (&run, make_order (session, &run, &labels, &order)) &&
      cli_relief_write (session, options, &art, &run))
    code = finish (session, options, &run, &labels, order);
  cli_run_end (&run);
  g_free (art.data);
  cli_layers_clear (&input);
  celd_session_free (session);
  return code;
}

/* ------------------------------------------------------------------ the command */

static int
run_relief (const CliOptions *options)
{
  return options->drawing ? run_on_levels (options) : run_on_drawing (options);
}

static bool
check (CliOptions *options)
{
  bool painted = options->scribbles || options->arrows || options->relations || options->relations_file ||
                 options->arrow_path || options->corrections || options->hidden ||
                 options->report;

  if (options->drawing && painted)
    return cli_error ("With --drawing the input is levels: give scribbles, arrows, relations, corrections, what is "
                      "hidden and a report with the drawing as input, without --drawing.");
  if (!options->drawing && (options->regions || options->smooth_depth))
    return cli_error ("--regions and --smooth-depth need levels as input, and their --drawing.");
  return true;
}

const CliCommand cli_relief_command = {
  .name     = "relief",
  .step     = CLI_RELIEF,
  .input    = "DRAWING|LAYERED|LEVELS",
  .summary  = "Makes a model of the parts of a drawing to view or to print, or rounded heights.",
  .examples = "  celdepth relief bee.png --scribbles strokes.png --arrows arrows.png --mesh bee.glb\n"
              "  celdepth relief page.psd --mesh page.stl --mesh-size 80\n"
              "  celdepth relief levels.npy --drawing bee.png --regions flat.png --colours art.png --mesh bee.glb\n"
              "  celdepth relief levels.npy --drawing bee.png --smooth-depth depth.npy --height height.exr",
  .settings = CLI_SETTINGS_OF_LABELS " on-cycle suggest expansion hold-gaps tolerance relief-bulge relief-from "
              "relief-depth mesh-kind mesh-size mesh-plate mesh-error most-vertices",
  .output   = "mesh",
  .check    = check,
  .run      = run_relief,
};
