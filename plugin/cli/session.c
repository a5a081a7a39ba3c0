/* Sets the input of a sub-command in a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static bool
load_hint (CeldSession *session, const CliOptions *options, const CliLayers *layers)
{
  CeldPlane hint = { 0 }, ink;
  bool      good = cli_hint_read (options->depth_hint, layers, &hint) &&
                   cli_check_hint (options->depth_hint, &hint, options->quiet) &&
                   cli_check (celd_session_set_depth_hint (session, &hint));

  if (good && !options->quiet)
    good = cli_check (celd_session_ink (session, NULL, &ink, NULL)) &&
           cli_warn_of_lines (options->depth_hint, &hint, options->input, &ink);
  g_free (hint.data);
  return good;
}

/* Sets a layer, or removes one of an earlier run that is not there any more. */
static bool
load_layer (CeldSession *session, const CeldPaint *layer,
            CeldStatus (*set) (CeldSession *session, const CeldPaint *paint))
{
  return cli_check (set (session, layer->data ? layer : NULL));
}

bool
cli_session_load (CeldSession *session, const CliOptions *options, CliLayers *layers)
{
  char         *text = cli_relations_text (options);
  CeldTextError error;
  CeldPlane     ink;
  bool          good = text &&
                       cli_check_relations (celd_session_set_relations (session, text, &error), options, &error) &&
                       cli_check_text (celd_session_set_arrow_path (session, options->arrow_path, &error),
                                       "--arrow-path", &error) &&
                       cli_layers_read (options->input, options,
                                        CLI_SCRIBBLES | CLI_ARROWS | CLI_CONTOURS | CLI_CORRECTIONS | CLI_HIDDEN,
                                        layers) &&
                       cli_check_not_mixed_up (options, layers) &&
                       (!layers->scribbles.data || options->settings.flats ||
                        cli_check_scribbles (options->scribbles ? options->scribbles : options->input,
                                             &layers->scribbles)) &&
                       cli_check (celd_session_set_settings (session, &options->settings)) &&
                       cli_check (celd_session_set_drawing (session, &layers->drawing));

  good = good && load_layer (session, &layers->colours, celd_session_set_colours) &&
         load_layer (session, &layers->scribbles, celd_session_set_scribbles) &&
         load_layer (session, &layers->arrows, celd_session_set_arrows) &&
         load_layer (session, &layers->contours, celd_session_set_contours) &&
         load_layer (session, &layers->corrections, celd_session_set_corrections) &&
         load_layer (session, &layers->hidden, celd_session_set_hidden);
  if (good && !options->settings.flats)
    good = cli_check (celd_session_ink (session, NULL, &ink, NULL)) && cli_check_lines (options->input, &ink) &&
           cli_check_no_drawings (options, layers, &ink);
  if (good && !options->quiet)
    cli_warn_of_blank_scribbles (options, layers);
  good = good && (!options->depth_hint || load_hint (session, options, layers));
  g_free (text);
  return good;
}
