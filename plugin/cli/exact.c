/* celdepth exact: depth by the exact quadratic program, through a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static CeldStatus
make (CeldSession *session, CliRun *run, CeldPlane *depth)
{
  CeldPlane  ink;
  CeldStatus status;

  cli_run_stage (run, "ink");
  status = celd_session_ink (session, &run->run, &ink, NULL);
  cli_run_stage (run, "depth");
  if (status == CELD_OK)
    status = celd_session_exact (session, &run->run, depth, NULL);
  cli_run_stage (run, NULL);
  return status == CELD_OK && cli_run_cancelled () ? CELD_CANCELLED : status;
}

/* The near end of the depth as it was encoded. */
static float
nearest_depth (const CeldPlane *depth, CeldEncoding encoding)
{
  float nearest = 0;

  for (size_t i = 0; encoding == CELD_ENCODING_RANK && i < (size_t) depth->width * (size_t) depth->height; i++)
    nearest = MAX (nearest, depth->data[i]);
  return nearest > 0 ? nearest : 1;
}

static bool
write_report (CeldSession *session, const CliOptions *options, const CliRun *run, const CeldPlane *depth,
              const CeldOrder *cycles)
{
  return !options->report || cli_report_write (options->report, &(CliReport) {
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

int
cli_exact (const CliOptions *options)
{
  CeldSession *session = celd_session_new ();
  CliLayers    layers = { 0 };
  CeldPlane    depth;
  CeldOrder    cycles = { 0 };
  CliRun       run;
  int          code = CLI_FAILED;
  bool         good = cli_check (session ? CELD_OK : CELD_NO_MEMORY) && cli_session_load (session, options, &layers);

  cli_layers_clear (&layers);
  cli_run_begin (&run, options->quiet);
  good = good && cli_check (make (session, &run, &depth));
  if (good)
    {
      cycles.cycle    = celd_session_exact_report (session)->cycle;
      cycles.n_cycles = celd_session_exact_report (session)->n_cycles;
      cycles.knot     = celd_session_exact_report (session)->knot;
      cycles.n_knots  = celd_session_exact_report (session)->n_knots;
      good = cli_write_depth (options->depth, &depth, nearest_depth (&depth, options->settings.encoding)) &&
             write_report (session, options, &run, &depth, &cycles);
    }
  if (good)
    {
      code = cycles.n_cycles ? CLI_CONTRADICTED : CLI_DONE;
      cli_say_cycles (&cycles, celd_session_relations (session));
      if (!options->quiet)
        cli_say_problems (celd_session_problems (session), celd_session_exact_palette (session),
                          celd_session_relations (session));
    }
  cli_run_end (&run);
  celd_session_free (session);
  return code;
}
