/* Functions that the files of the options share.
 *
 * SPDX-License-Identifier: LGPL-3.0-or-later
 */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "cli.h"

#define GIVES_LABELS   (CLI_POPUP | CLI_SEGMENT)
#define FROM_THE_SIDE  (CLI_STEREO | CLI_WIGGLE)
#define MADE_OF_LABELS (GIVES_LABELS | CLI_LAYERS | FROM_THE_SIDE | CLI_DEFORM)
#define WITH_LAYERS    (MADE_OF_LABELS | CLI_EXACT | CLI_RELIEF)
#define OF_LEVELS      (CLI_EXPAND | CLI_SMOOTH | CLI_SHADE)
#define WITH_PARTS     (WITH_LAYERS | CLI_REGISTER)
#define WITH_INK       (WITH_PARTS | CLI_ORDER | OF_LEVELS)

/* ------------------------------------------------------------------ options-files.c */

/* Appends a GOptionEntry for each file of a command. */
void cli_files_append (const CliCommand *command, CliOptions *options, GArray *entries);
/* Whether required files are given, and outputs have different names with endings that can be written. */
bool cli_files_check (const CliCommand *command, CliOptions *options);
/* Whether the outputs can be written there, which is checked before the work begins. */
bool cli_files_check_places (CliOptions *options);
void cli_files_clear (CliOptions *options);
/* Copies all names for one frame of a clip: those of outputs with its number, and those of inputs if they have a #. */
void cli_files_number (const CliOptions *all, int number, CliOptions *frame);

/* The settings of sub-commands that make regions, and in addition of those that make views. */
#define CLI_SETTINGS_OF_LABELS \
  "ink ink-threshold method close-gaps keep-necks hardness +flats background background-colour seeds same-colour " \
  "arrow-style"
#define CLI_SETTINGS_OF_SCENES " on-cycle suggest expansion margin anchors hold-rest hold-gaps"

/* ------------------------------------------------------------------ options-settings.c */

/* Appends a GOptionEntry for each setting of a command; its data are the CliOptions. */
void cli_settings_append (const CliCommand *command, CliOptions *options, GArray *entries);
void cli_settings_clear (CliOptions *options);

/* ------------------------------------------------------------------ options-clip.c */

/* Appends the options of propagate that may be repeated. */
void cli_clip_options_append (CliOptions *options, GArray *entries);
/* Keeps the command line for scripts, before it is parsed. */
void cli_command_line_keep   (int argc, char **argv, CliOptions *options);
void cli_clip_options_clear  (CliOptions *options);

/* ------------------------------------------------------------------ options-counts.c */

/* Appends a GOptionEntry for each whole number of a command; its data are the CliOptions. */
void cli_counts_append   (const CliCommand *command, GArray *entries);
/* Sets those that were not given. */
void cli_counts_complete (CliOptions *options);

#endif
