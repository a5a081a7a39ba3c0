/* Sets the input of a sub-command in a session.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#include "cli.h"

static bool
load_hint (CeldSession *session, const CliOptions *options, const CliLayers *layers)
{
  CeldPlane hint = { 0 };
  bool      good = cli_hint_read (options->depth_hint, layers, &hint) &&
                   cli_check (celd_session_set_depth_hint (session, &hint));

  g_free (hint.data);
  return good;
}

bool
cli_session_load (CeldSession *session, const CliOptions *options, CliLayers *layers)
{
  char         *text = cli_relations_text (options);
  CeldTextError error;
  CeldPlane     ink;
  bool          good = text &&
                       cli_check_text (celd_session_set_relations (session, text, &error),
                                       cli_relations_name (options), &error) &&
                       cli_check_text (celd_session_set_arrow_path (session, options->arrow_path, &error),
                                       "Arrow path", &error) &&
                       cli_layers_read (options->input, options,
                                        CLI_SCRIBBLES | CLI_ARROWS | CLI_CONTOURS | CLI_CORRECTIONS | CLI_HIDDEN,
                                        layers) &&
                       cli_check_not_exchanged (options, layers) &&
                       cli_check (celd_session_set_settings (session, &options->settings)) &&
                       cli_check (celd_session_set_drawing (session, &layers->drawing));

  if (good && layers->scribbles.data)
    good = cli_check (celd_session_set_scribbles (session, &layers->scribbles));
  if (good && layers->arrows.data)
    good = cli_check (celd_session_set_arrows (session, &layers->arrows));
  if (good && layers->contours.data)
    good = cli_check (celd_session_set_contours (session, &layers->contours));
  if (good && options->depth_hint)
    good = load_hint (session, options, layers);
  if (good && layers->corrections.data)
    good = cli_check (celd_session_set_corrections (session, &layers->corrections));
  if (good && layers->hidden.data)
    good = cli_check (celd_session_set_hidden (session, &layers->hidden));
  if (good && !options->settings.flats)
    good = cli_check (celd_session_ink (session, NULL, &ink, NULL)) && cli_check_lines (options->input, &ink);
  g_free (text);
  return good;
}
