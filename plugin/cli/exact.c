/* celdepth exact: exact depth by the quadratic program of eq. (1) and (2), with a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static bool
make (CeldSession *session, CliRun *run, CeldPlane *depth)
{
  CeldPlane  ink;
  CeldStatus status;

  cli_run_stage (run, "ink");
  status = celd_session_ink (session, &run->host, &ink, NULL);
  cli_run_stage (run, "depth");
  if (status == CELD_OK)
    status = celd_session_exact (session, &run->host, depth, NULL);
  return cli_run_finish (run, status);
}

/* The nearest depth in the encoding of the settings. */
static float
nearest_depth (const CeldPlane *depth, CeldEncoding encoding)
{
  float nearest = 0;

  for (size_t i = 0; encoding == CELD_ENCODING_RANK && i < (size_t) depth->width * (size_t) depth->height; i++)
    nearest = MAX (nearest, depth->data[i]);
  return nearest > 0 ? nearest : 1;
}

static int
finish (CeldSession *session, const CliOptions *options, const CliRun *run, const CeldPlane *depth,
      const CeldOrder *cycles)
{
  return cli_finish (options, &(CliReport) {
    .command   = "exact",
    .width     = depth->width,
    .height    = depth->height,
    .palette   = celd_session_exact_palette (session),
    .relations = celd_session_relations (session),
    .order     = cycles,
    .problems  = celd_session_problems (session),
    .exact     = celd_session_exact_report (session),
    .settings  = &options->settings,
    .timings   = run->timings,
  });
}

static int
run_exact (const CliOptions *options)
{
  CeldSession *session = celd_session_new ();
  CliLayers    layers = { 0 };
  CeldPlane    depth;
  CeldOrder    cycles = { 0 };
  CliRun       run;
  int          code = CLI_FAILED;
  bool         good;

  cli_run_begin (&run, options, "reading ink depth writing");
  cli_run_stage (&run, "reading");
  good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (session, options, &layers);
  cli_layers_clear (&layers);
  good = good && make (session, &run, &depth);
  if (good)
    {
      cycles.cycle    = celd_session_exact_report (session)->cycle;
      cycles.n_cycles = celd_session_exact_report (session)->n_cycles;
      cycles.scc      = celd_session_exact_report (session)->scc;
      cycles.n_sccs   = celd_session_exact_report (session)->n_sccs;
      if (cli_write_depth (options->depth, &depth, nearest_depth (&depth, options->settings.encoding)))
        code = finish (session, options, &run, &depth, &cycles);
    }
  cli_run_end (&run);
  celd_session_free (session);
  return code;
}

const CliCommand cli_exact_command = {
  .name     = "exact",
  .step     = CLI_EXACT,
  .input    = "DRAWING|LAYERED",
  .summary  = "Finds the smoothest depth that satisfies every relation, by quadratic programming.",
  .examples = "  celdepth exact bee.png --scribbles strokes.png --arrows arrows.png --depth depth.exr\n"
              "  celdepth exact bee.png --relations '120,80 > 300,90 +2; 300,90 = 10,10' --depth depth.npy \\\n"
              "      --encoding rank --report report.json",
  .settings = "ink flats background background-colour same-colour arrow-style on-cycle encoding near-level far-level "
              "hold-gaps tolerance contrast weight-floor",
  .output   = "depth",
  .run      = run_exact,
};
