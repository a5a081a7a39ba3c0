/* celdepth relief: heights and meshes from levels.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

/* The settings with the kind of mesh that the file needs: a closed solid for STL, for printing, and else a surface. */
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
  if (status == CELD_BAD_VALUE) /* with valid settings: the cuts alone have too many vertices */
    {
      cli_run_stage (run, NULL);
      return cli_error ("The outlines alone have more than %.0f vertices: increase --most-vertices.",
                        (double) s.most_vertices);
    }
  good = cli_run_finish (run, status) && cli_art_read (options->drawing, options->colours, false, &layers, &art) &&
         cli_write_mesh (options->mesh, &mesh, &art);
  if (good && !options->quiet && mesh.error > 1.01 * (double) s.mesh_error)
    cli_say ("With %.0f vertices at most, the mesh deviates by up to %.1f pixels from the heights; increase "
             "--most-vertices to allow more.", (double) s.most_vertices, mesh.error);
  celd_relief_mesh_clear (&mesh);
  cli_layers_clear (&layers);
  g_free (art.data);
  return good;
}

/* Reads smooth depth if --depth is given. */
static bool
read_depth (const CliOptions *options, const CeldPlane *levels, CeldPlane *depth)
{
  if (!options->smooth_depth)
    return true;
  if (!cli_read_levels (options->smooth_depth, depth))
    return false;
  return (depth->width == levels->width && depth->height == levels->height) ||
         cli_error ("\"%s\" has %d x %d pixels, but \"%s\" has %d x %d; give both the same size.",
                    options->smooth_depth, depth->width, depth->height, options->input, levels->width, levels->height);
}

static int
run_relief (const CliOptions *options)
{
  CliStep    step;
  CeldPlane  depth = { 0 };
  CeldRelief relief = { 0 };
  bool       good = cli_step_begin (options, &step) && read_depth (options, &step.levels, &depth);

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
  return cli_step_end (&step, good);
}

const CliCommand cli_relief_command = {
  .name     = "relief",
  .step     = CLI_RELIEF,
  .input    = "LEVELS",
  .summary  = "Makes rounded heights of the parts of a drawing, or a mesh to view or to print.",
  .examples = "  celdepth relief levels.npy --drawing bee.png --depth depth.npy --height height.exr\n"
              "  celdepth relief levels.npy --drawing bee.png --colours art.png --mesh bee.glb\n"
              "  celdepth relief levels.npy --drawing bee.png --mesh bee.stl --bulge 0.3 --mesh-size 80",
  .settings = "ink ink-threshold tolerance bulge from=relief-from relief-depth mesh-kind=mesh mesh-size mesh-plate "
              "mesh-error most-vertices",
  .output   = "mesh",
  .run      = run_relief,
};
